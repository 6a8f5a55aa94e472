//! Typical range of the scans: lengths that suit corridors are too short where the next wall is 30 m away.

use crate::keyframe::Keyframe;

/// Scans before, and how many of them are asked.
const RECENT_SCANS: usize = 320;
const SAMPLE_INTERVAL_SCANS: usize = 10;
/// Typical range up to which indoor lengths apply \[m\], and maximum factor beyond it.
const INDOORS_M: f32 = 12.0;
const MAX_SCALE_FACTOR: f64 = 3.0;
/// Quantile of the point ranges of a scan.
const RANGE_QUANTILE_RATIO: f64 = 0.75;

/// Ratio of the typical range to the indoor one: the median, over the path before a keyframe, of the range
/// within which three quarters of the points of a scan are.
pub(super) fn scale(keyframes: &[Keyframe], last: usize) -> f64 {
    let first = last.saturating_sub(RECENT_SCANS);
    let ranges =
        keyframes[first..=last].iter().rev().step_by(SAMPLE_INTERVAL_SCANS).filter_map(range_m);
    let typical_m = nth(ranges.collect(), 0.5).unwrap_or(0.0);
    f64::from(typical_m / INDOORS_M).clamp(1.0, MAX_SCALE_FACTOR)
}

fn range_m(keyframe: &Keyframe) -> Option<f32> {
    let cloud = keyframe.cloud();
    let [x, y] = cloud.origin();
    let ranges = cloud.points().iter().map(|p| libm::hypotf(p.x - x, p.y - y));
    nth(ranges.collect(), RANGE_QUANTILE_RATIO)
}

fn nth(mut values: Vec<f32>, part: f64) -> Option<f32> {
    let at = (values.len() as f64 * part) as usize;
    (at < values.len()).then(|| *values.select_nth_unstable_by(at, f32::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use periplus_scan_matching::{Cloud, CloudSettings};

    use super::*;

    /// Keyframes in a round room.
    fn round(radius_m: f32, count: usize) -> Vec<Keyframe> {
        let beam = |index: u16| {
            let (s, c) = libm::sincosf(0.01 * f32::from(index));
            Some([radius_m * c, radius_m * s])
        };
        let cloud = Cloud::new((0..300).map(beam), [0.0; 2], 0.01, &CloudSettings::default());
        vec![Keyframe::new(&cloud, None, 0.0); count]
    }

    #[test]
    fn lengths_grow_with_what_is_seen_most_of_the_way() {
        let check = |mut keyframes: Vec<Keyframe>, then: Vec<Keyframe>, wanted: f64| {
            keyframes.extend(then);
            let found = scale(&keyframes, keyframes.len() - 1);
            assert!((found - wanted).abs() < 0.01, "{found}");
        };
        check(round(4.0, 50), Vec::new(), 1.0);
        check(round(24.0, 50), Vec::new(), 2.0);
        check(round(80.0, 50), Vec::new(), 3.0);
        // A gate that is passed changes nothing; a house that is left does.
        check(round(24.0, 200), round(4.0, 90), 2.0);
        check(round(4.0, 200), round(24.0, 250), 2.0);
    }
}
