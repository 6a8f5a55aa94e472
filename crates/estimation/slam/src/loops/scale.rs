//! How far scans see: lengths that suit corridors are too short where the next wall is 30 m away.

use crate::keyframe::Keyframe;

/// Scans before, and how many of them are asked.
const BEFORE: usize = 320;
const EVERY: usize = 10;
/// Up to this typical range lengths are those of corridors and halls \[m\]; beyond they grow with it, up
/// to so many times.
const INDOORS_M: f32 = 12.0;
const MOST: f64 = 3.0;
/// Of each scan this part of the points is nearer.
const PART: f64 = 0.75;

/// How many times as far as indoors scans typically see on the way up to a kept one: the median, over the
/// way before, of the range that three quarters of the points of a scan keep to.
pub(super) fn scale(keyframes: &[Keyframe], last: usize) -> f64 {
    let first = last.saturating_sub(BEFORE);
    let ranges = keyframes[first..=last].iter().rev().step_by(EVERY).filter_map(range_m);
    let typical_m = nth(ranges.collect(), 0.5).unwrap_or(0.0);
    f64::from(typical_m / INDOORS_M).clamp(1.0, MOST)
}

fn range_m(keyframe: &Keyframe) -> Option<f32> {
    let cloud = keyframe.cloud();
    let [x, y] = cloud.origin();
    nth(cloud.points().iter().map(|p| (p.x - x).hypot(p.y - y)).collect(), PART)
}

fn nth(mut values: Vec<f32>, part: f64) -> Option<f32> {
    let at = (values.len() as f64 * part) as usize;
    (at < values.len()).then(|| *values.select_nth_unstable_by(at, f32::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use periplus_scan_matching::{Cloud, CloudSettings};

    use super::*;

    /// So many scans of a round wall.
    fn round(radius_m: f32, count: usize) -> Vec<Keyframe> {
        let beam = |index: u16| {
            let (s, c) = (0.01 * f32::from(index)).sin_cos();
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
