//! What sensors say.

use periplus_base::{DVec3, Pose};
use periplus_costmap::layers::probability;
use periplus_costmap::{Beams, Projector, Source, tables};

use super::super::Setting;
use super::{number, truth, values_of};
use crate::{Case, Differences, Reader, Unreadable};

fn nanoseconds(reader: &Reader<'_>) -> Result<i64, Unreadable> {
    Ok((reader.number()? * 1e9).round() as i64)
}

/// Kind `observation_buffer`: whether a source is current, and what it keeps.
pub(in super::super) fn check_buffer(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut source = Source::new("source", values_of(&tables::SOURCE, Some(&given))?);
    for name in ["observation_keep_time", "persistence"] {
        if let Some(time) = given.find(name) {
            source.settings.persistence_ns = nanoseconds(&time)?;
        }
    }
    let mut times = Vec::new();
    if let Some(time) = given.find("cloud_received_at") {
        times.push(nanoseconds(&time)?);
    }
    for name in ["clouds", "cloud_times", "stamps", "clouds_received_at"] {
        if let Some(clouds) = given.find(name) {
            times.extend(clouds.each(|cloud| match cloud.find("stamp") {
                Some(stamp) => nanoseconds(&stamp),
                None => nanoseconds(cloud),
            })?);
        }
    }
    for time_ns in times {
        let origin = DVec3::ZERO;
        source.insert(time_ns, time_ns, Pose::IDENTITY, origin, [[0.0, 0.0, 0.0]]);
    }
    let queries = given.get("query_times")?.each(nanoseconds)?;
    if let Some(current) = expect.find("current") {
        for (time_ns, expected) in queries.iter().zip(current.each(Reader::truth)?) {
            let what = format!("current at {time_ns} ns");
            differences.same(what, &source.is_current(*time_ns), &expected);
        }
    }
    for name in ["count", "counts", "observations"] {
        let Some(counts) = expect.find(name) else { continue };
        for (time_ns, expected) in queries.iter().zip(counts.each(Reader::count)?) {
            source.purge(*time_ns);
            let what = format!("observations at {time_ns} ns");
            differences.same(what, &source.observations().count(), &expected);
        }
    }
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
    let single = |name: &str| Ok(scan.get(name)?.number()? as f32);
    let beams = Beams {
        angle_min_rad: single("angle_min")?,
        angle_increment_rad: single("angle_increment")?,
        range_min_m: single("range_min")?,
        range_max_m: single("range_max")?,
    };
    let ranges: Vec<f32> = scan.get("ranges")?.numbers()?.iter().map(|it| *it as f32).collect();
    let inf_is_valid = truth(&given, "inf_is_valid", false)?;
    let mut projector = Projector::default();
    let points: Vec<_> = projector.points(beams, &ranges, inf_is_valid).collect();
    for name in ["count", "point_count"] {
        if let Some(count) = expect.find(name) {
            differences.same("points", &points.len(), &count.count()?);
        }
    }
    for name in ["points", "xy"] {
        let Some(expected) = expect.find(name) else { continue };
        let expected = expected.each(Reader::numbers)?;
        differences.same("points", &points.len(), &expected.len());
        for (at, (got, expected)) in points.iter().zip(&expected).enumerate() {
            let got: Vec<f64> = got.iter().map(|at| f64::from(*at)).collect();
            // Heights may be left out. Points have single precision.
            for (got, expected) in got.iter().zip(expected) {
                let tolerance = case.tolerance.unwrap_or(1e-5);
                differences.near_by(format_args!("point {at}"), *got, *expected, tolerance);
            }
        }
    }
    if let Some(kept) = expect.find("kept_indices").or(expect.find("kept")) {
        let is_kept = |range: f32| {
            let mut one = Projector::default();
            one.points(beams, &[range], inf_is_valid).next().is_some()
        };
        let got: Vec<usize> = (0..ranges.len()).filter(|at| is_kept(ranges[*at])).collect();
        differences.same("beams with a point", &got, &kept.each(Reader::count)?);
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
    let phi_m = match given.find("phi_v") {
        Some(phi) => phi.number()?,
        None => number(&given, "phi", 1.2)?,
    };
    let half_rad = match given.find("max_angle") {
        Some(angle) => angle.number()?,
        None => given.get("field_of_view").or(given.get("fov"))?.number()? / 2.0,
    };
    let resolution_m = given.get("resolution")?.number()?;
    let samples = ["samples", "points", "inputs", "queries"].iter().find_map(|it| given.find(it));
    let samples = samples.ok_or_else(|| given.unreadable("one that has `samples`"))?.list()?;
    let expected = ["probability", "p", "prob", "values", "sensor_model"]
        .iter()
        .find_map(|name| expect.find(name))
        .ok_or_else(|| expect.unreadable("one that has `probability`"))?
        .numbers()?;
    differences.same("samples", &samples.len(), &expected.len());
    for (sample, expected) in samples.iter().zip(expected) {
        let [range_m, distance_m, angle_rad] = match sample.numbers() {
            Ok(numbers) => match *numbers.as_slice() {
                [range_m, distance_m, angle_rad] => [range_m, distance_m, angle_rad],
                [distance_m, angle_rad] => {
                    [given.get("range").or(given.get("r"))?.number()?, distance_m, angle_rad]
                }
                _ => return Err(sample.unreadable("range, distance and angle")),
            },
            Err(_) => [
                sample.get("r").or(sample.get("range"))?.number()?,
                sample.get("phi").or(sample.get("distance"))?.number()?,
                sample.get("theta").or(sample.get("angle"))?.number()?,
            ],
        };
        let got = probability(range_m, distance_m, angle_rad, half_rad, phi_m, resolution_m);
        differences.near(format_args!("probability of {}", sample.value()), got, expected);
    }
    Ok(())
}
