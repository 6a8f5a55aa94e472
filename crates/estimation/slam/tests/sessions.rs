//! Sessions: saved, read, gone on with; damaged ones refused.

mod worlds;

use periplus_geometry::Pose2;
use periplus_slam::{Settings, Slam};
use worlds::{Moment, ROBOT, World};

/// Two rounds through a ring of corridors.
fn moments() -> Vec<Moment> {
    let world = World::ring(12.0, 8.0, 2.4, 1);
    let mut corners = vec![(4.0, 0.0)];
    for _ in 0..2 {
        corners.extend([(12.0, 0.0), (12.0, 8.0), (0.0, 8.0), (0.0, 0.0), (4.0, 0.0)]);
    }
    world.drive(&corners, 0.5, &ROBOT, 1)
}

fn add(slam: &mut Slam, moments: &[Moment]) {
    for moment in moments {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
    }
}

/// Compares an uninterrupted run with one that is saved and resumed at these fractions of the path.
fn check(settings: &Settings, parts: &[f64]) {
    let moments = moments();
    let mut whole = Slam::new(settings.clone());
    add(&mut whole, &moments);
    let saved_whole = whole.save();
    assert!(whole.counts().searches > 0 && whole.counts().proximity > 0, "{:?}", whole.counts());
    whole.finish();
    for part in parts {
        let stop = (part * moments.len() as f64) as usize;
        let mut first = Slam::new(settings.clone());
        add(&mut first, &moments[..stop]);
        let saved = first.save();
        let mut second = Slam::resume(&saved, settings.clone()).expect("a session");
        assert_eq!(second.save(), saved, "what was read is what was written");
        drop(first);
        add(&mut second, &moments[stop..]);
        assert!(second.save() == saved_whole, "stopped at {stop}: something else came of it");
        second.finish();
        assert_eq!(second.trajectory(), whole.trajectory());
        assert_eq!(second.closures(), whole.closures());
        assert_eq!(second.map(), whole.map());
    }
}

#[test]
fn going_on_is_as_never_having_stopped() {
    check(&Settings::default(), &[0.0, 0.3, 0.6]);
}

#[test]
fn work_that_waits_goes_on_too() {
    // With queued searches and an optimization in progress.
    let settings = Settings { slices_per_scan: 2, ..Settings::default() };
    check(&settings, &[0.53, 0.57, 0.63, 0.7]);
}

#[test]
fn bytes_that_are_no_session_are_refused_with_a_reason() {
    let mut slam = Slam::new(Settings::default());
    add(&mut slam, &moments()[..12]);
    let saved = slam.save();
    let refused = |bytes: &[u8]| {
        let error = Slam::resume(bytes, Settings::default()).err();
        error.expect("this is no session").to_string()
    };
    assert!(refused(b"P5 20 20 255").contains("slam_toolbox"));
    assert!(refused(&saved[..saved.len() - 9]).contains("checksum"));
    let mut flipped = saved.clone();
    flipped[saved.len() / 2] ^= 4;
    assert!(refused(&flipped).contains("checksum"));
    let mut newer = saved;
    newer[8] = 9;
    assert!(refused(&newer).contains("version 9"));
}

/// Every byte of the body set to other values, with a checksum that is right: no panic, and what is
/// taken can be gone on with.
#[test]
fn hostile_bytes_never_panic() {
    let moments = moments();
    let mut slam = Slam::new(Settings { drawn_beams: 3, ..Settings::default() });
    add(&mut slam, &moments[..3]);
    let saved = slam.save();
    let body = 12..saved.len() - 4;
    let mut taken = 0;
    for at in body.clone().step_by(23).chain(body.rev().take(600)) {
        for value in [0, 1, 0x7f, 0xff] {
            let mut hostile = saved.clone();
            hostile[at] = value;
            let end = hostile.len() - 4;
            let sum = crc32fast::hash(&hostile[..end]);
            hostile[end..].copy_from_slice(&sum.to_le_bytes());
            if let Ok(mut slam) = Slam::resume(&hostile, Settings::default()) {
                taken += 1;
                if taken % 40 == 0 {
                    let again = slam.save();
                    let read = Slam::resume(&again, Settings::default()).expect("a session");
                    assert!(read.save() == again, "byte {at} as {value}");
                    add(&mut slam, &moments[4..6]);
                }
            }
        }
    }
    assert!(taken > 100, "{taken}: most numbers of a session may be others");
}

/// Squared distances as g2o computes them from its text are those of this engine.
#[test]
fn g2o_reads_the_same_graph() {
    let moments = moments();
    let mut slam = Slam::new(Settings::default());
    add(&mut slam, &moments);
    let text = slam.to_g2o();
    let numbers = |line: &str| -> Vec<f64> {
        line.split_whitespace().skip(1).map(|word| word.parse().unwrap()).collect()
    };
    let of = |kind: &str| -> Vec<Vec<f64>> {
        text.lines().filter(|line| line.starts_with(kind)).map(numbers).collect()
    };
    let poses: Vec<Pose2> =
        of("VERTEX_SE2 ").iter().map(|it| Pose2::new(it[1], it[2], it[3])).collect();
    let edges = of("EDGE_SE2 ");
    assert_eq!(poses.len(), slam.kept().len());
    assert!(edges.len() > poses.len(), "a chain and ties");
    assert_eq!(text.lines().filter(|line| *line == "FIX 0").count(), 1);
    let mut chi2 = 0.0;
    for edge in &edges {
        let measured = Pose2::new(edge[2], edge[3], edge[4]);
        let found = poses[edge[0] as usize].inverse() * poses[edge[1] as usize];
        // g2o: the error is `measured⁻¹ · found`.
        let error = (measured.inverse() * found).normalized();
        let e = [error.x_m, error.y_m, error.yaw_rad];
        let [xx, xy, xt, yy, yt, tt] = [edge[5], edge[6], edge[7], edge[8], edge[9], edge[10]];
        let rows = [[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]];
        for i in 0..3 {
            chi2 += (0..3).map(|j| e[i] * rows[i][j] * e[j]).sum::<f64>();
        }
    }
    let own = slam.chi2();
    assert!((chi2 - own).abs() < 1e-6 * own.max(1.0), "{chi2} {own}");
}
