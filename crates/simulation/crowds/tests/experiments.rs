//! The published experiments in short: one seed, few widths and densities. `cargo xtask crowds` prints all of them.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use periplus_crowds::experiments::{
    bottleneck, chattaraj_speed_m_per_s, lanes, plane_speed_m_per_s, seyfried_speed_m_per_s,
    single_file, weidmann_speed_m_per_s,
};
use periplus_crowds::{OrcaParams, SocialForceParams, SteeringModel};

fn each(check: impl Fn(SteeringModel)) {
    for name in SteeringModel::NAMES {
        check(SteeringModel::named(name).unwrap());
    }
}

/// Between the flow of handbooks (1.3 per m and s, SFPE) and a quarter above that of Seyfried et al. 2009 (1.9).
#[test]
fn the_flow_through_a_bottleneck_grows_with_its_width() {
    each(|model| {
        let [narrow, wide] = [1.0, 2.0].map(|width_m| bottleneck(model, width_m, 60, 1).unwrap());
        for run in [narrow, wide] {
            assert_eq!(run.passed, 60, "{}: {run:?}", model.name());
            let flow = run.specific_flow_per_m_s;
            assert!((1.3..2.4).contains(&flow), "{}: {run:?}", model.name());
        }
        assert!(wide.flow_per_s > 1.6 * narrow.flow_per_s, "{narrow:?} {wide:?}");
    });
}

/// Between the German and the Indian participants, up to 0.05 m/s.
#[test]
fn the_speed_in_a_single_file_falls_with_the_density() {
    each(|model| {
        for people in [15, 20, 30] {
            let run = single_file(model, people, 1).unwrap();
            let low = seyfried_speed_m_per_s(run.density_per_m) - 0.05;
            let high = chattaraj_speed_m_per_s(run.density_per_m) + 0.05;
            assert!((low..high).contains(&run.speed_m_per_s), "{}: {run:?}", model.name());
            assert_eq!(run.overtakings, 0);
        }
    });
}

/// Within 0.26 m/s of the curve of Weidmann, the deviation of free speeds.
#[test]
fn the_speed_in_the_plane_falls_with_the_density() {
    each(|model| {
        for density in [1.0, 2.0, 3.0] {
            let speed = plane_speed_m_per_s(model, density, 1).unwrap();
            let published = weidmann_speed_m_per_s(density);
            assert!((speed - published).abs() < 0.26, "{}: {density}: {speed}", model.name());
        }
    });
}

#[test]
fn two_directions_segregate_into_lanes() {
    each(|model| {
        let run = lanes(model, 1.0, 60.0, 1).unwrap();
        assert!(run.order_at_start < 0.2, "{}: {run:?}", model.name());
        assert!(run.order_at_end > 0.4 && run.speed_m_per_s > 1.0, "{}: {run:?}", model.name());
    });
}

/// The reason for the headway: the models of the papers keep their free speed in a dense stream.
#[test]
fn without_a_headway_a_dense_stream_is_too_fast() {
    let forces = SocialForceParams { headway: None, ..SocialForceParams::default() };
    let orca = OrcaParams { headway: None, ..OrcaParams::default() };
    for model in [SteeringModel::SocialForce(forces), SteeringModel::Orca(orca)] {
        let speed = plane_speed_m_per_s(model, 2.0, 1).unwrap();
        assert!(speed > weidmann_speed_m_per_s(2.0) + 0.26, "{}: {speed}", model.name());
    }
}
