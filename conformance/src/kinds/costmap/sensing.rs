//! Sensor messages.

use periplus_costmap::layers::probability;
use periplus_costmap::{ObservationSource, Projector, ScanGeometry, tables};
use periplus_geometry::{DVec3, Pose};

use serde_json::{Value, json};

use super::super::Setting;
use super::{compat_of, truth, values_among};
use crate::{Case, CaseReader, Differences, Unreadable, numbers};

fn nanoseconds(reader: &CaseReader<'_>) -> Result<i64, Unreadable> {
    Ok((reader.number()? * 1e9).round() as i64)
}

/// Kind `observation_buffer`: whether a source is current, and what it keeps.
pub(in super::super) fn check_buffer(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut source = ObservationSource::new("source", values_among(&tables::SOURCE, &given)?)
        .with_compat(compat_of(distro)?);
    for name in ["observation_keep_time", "persistence"] {
        if let Some(time) = given.find(name) {
            source.settings.persistence_ns = nanoseconds(&time)?;
        }
    }
    let mut times: Vec<(i64, i64)> = Vec::new();
    let at = |stamp_ns: i64| (stamp_ns, stamp_ns);
    if let Some(time) = given.find("cloud_received_at") {
        times.push(at(nanoseconds(&time)?));
    }
    for name in ["clouds", "cloud_times", "stamps", "clouds_received_at"] {
        if let Some(clouds) = given.find(name) {
            times.extend(clouds.each(|cloud| match cloud.find("stamp") {
                Some(stamp) => {
                    let stamp_ns = nanoseconds(&stamp)?;
                    let received = cloud.find_any(&["received_at", "received", "now"]);
                    let received_ns = received.map_or(Ok(stamp_ns), |it| nanoseconds(&it))?;
                    Ok((received_ns, stamp_ns))
                }
                None => nanoseconds(cloud).map(at),
            })?);
        }
    }
    for (received_ns, stamp_ns) in times {
        let origin = DVec3::ZERO;
        source.insert(received_ns, stamp_ns, Pose::IDENTITY, origin, [[0.0, 0.0, 0.0]]);
    }
    let queries = given.get("query_times")?.each(nanoseconds)?;
    let (mut current, mut counts, mut kept) = (Vec::new(), Vec::new(), Vec::new());
    for time_ns in queries {
        current.push(source.is_current(time_ns));
        source.purge(time_ns);
        counts.push(source.observations().count());
        let stamps = source.observations().map(|seen| seen.time_ns as f64 / 1e9);
        kept.push(numbers(stamps));
    }
    differences.compare_members(
        &[
            (&["current"], json!(current)),
            (&["count", "counts", "observations"], json!(counts)),
            (&["kept_stamps", "stamps"], Value::Array(kept)),
        ],
        &expect,
    );
    Ok(())
}

/// Kind `laser_projection`: which ranges have points, and where.
pub(in super::super) fn check_projection(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let scan = given.find("scan").unwrap_or(given.clone());
    // What a scan has besides, which has no influence on its points.
    for name in ["angle_max", "time_increment", "scan_time", "intensities"] {
        if let Some(besides) = scan.find(name) {
            besides.skip();
        }
    }
    let single = |name: &str| Ok(scan.get(name)?.number()? as f32);
    let beams = ScanGeometry {
        angle_min_rad: single("angle_min")?,
        angle_increment_rad: single("angle_increment")?,
        range_min_m: single("range_min")?,
        range_max_m: single("range_max")?,
    };
    let ranges: Vec<f32> = scan.get("ranges")?.numbers()?.iter().map(|it| *it as f32).collect();
    let inf_is_valid = truth(&given, "inf_is_valid", false)?;
    let mut projector = Projector::default();
    let points: Vec<_> = projector.points(beams, &ranges, inf_is_valid).collect();
    let is_kept = |range: f32| {
        let mut one = Projector::default();
        one.points(beams, &[range], inf_is_valid).next().is_some()
    };
    let kept: Vec<usize> = (0..ranges.len()).filter(|at| is_kept(ranges[*at])).collect();
    for (name, expected) in expect.members()? {
        match name {
            "count" | "point_count" => {
                differences.compare(name, &json!(points.len()), &expected);
            }
            // Heights may be left out. Points have single precision.
            "points" | "xy" => {
                let wanted = expected.list()?;
                let counts: Vec<usize> = wanted
                    .iter()
                    .map(|it| it.list().map(|it| it.len()))
                    .collect::<Result<_, _>>()?;
                let got: Value = points
                    .iter()
                    .enumerate()
                    .map(|(at, point)| {
                        let count = counts.get(at).copied().unwrap_or(3).clamp(2, 3);
                        numbers(point.iter().take(count).map(|at| f64::from(*at)))
                    })
                    .collect();
                differences.compare_by(name, &got, &expected, case.tolerance.unwrap_or(1e-5));
            }
            "kept_indices" | "kept" => differences.compare(name, &json!(kept), &expected),
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    Ok(())
}

/// Kind `range_sensor_model`: probabilities.
pub(in super::super) fn check_range_model(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    // Parameters of the layer that have no influence on its model may be listed.
    values_among(&tables::RANGE, &given)?;
    let phi_m = given.find_any(&["phi_v", "phi"]).map_or(Ok(1.2), |it| it.number())?;
    let half_rad = match given.find("max_angle") {
        Some(angle) => angle.number()?,
        None => given.get_any(&["field_of_view", "fov"])?.number()? / 2.0,
    };
    let resolution_m = given.get("resolution")?.number()?;
    let samples = given.get_any(&["samples", "points", "inputs", "queries"])?.list()?;
    let mut got = Vec::new();
    for sample in &samples {
        let [range_m, distance_m, angle_rad] = match sample.numbers() {
            Ok(numbers) => match *numbers.as_slice() {
                [range_m, distance_m, angle_rad] => [range_m, distance_m, angle_rad],
                [distance_m, angle_rad] => {
                    [given.get_any(&["range", "r"])?.number()?, distance_m, angle_rad]
                }
                _ => return Err(sample.unreadable("range, distance and angle")),
            },
            Err(_) => [
                sample.get_any(&["r", "range"])?.number()?,
                sample.get_any(&["phi", "distance"])?.number()?,
                sample.get_any(&["theta", "angle"])?.number()?,
            ],
        };
        got.push(probability(range_m, distance_m, angle_rad, half_rad, phi_m, resolution_m));
    }
    let names: &[&str] = &["probability", "p", "prob", "values", "sensor_model"];
    differences.compare_members(&[(names, numbers(got))], &expect);
    Ok(())
}
