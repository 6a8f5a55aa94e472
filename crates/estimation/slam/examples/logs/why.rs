//! The relations that carry the error of a map.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use periplus_slam::{Miss, Stamped};

/// A few lines on which relations carry the error.
pub(crate) fn why(missed: &[Miss], scans: &[Stamped], between: &[Stamped]) -> String {
    let mut text = String::new();
    let whole: f64 = missed.iter().map(|it| it.shift_m).sum();
    let count = missed.len().max(1) as f64;
    let _ = writeln!(text, "    the mean is {:.4} m; of it come, from relations", whole / count);
    let part = |name: &str, takes: &dyn Fn(&Miss) -> bool| {
        let taken: Vec<&Miss> = missed.iter().filter(|it| takes(it)).collect();
        let sum: f64 = taken.iter().map(|it| it.shift_m).sum();
        format!(
            "      {name:<34} {:.4} m: {:>5} of mean {:.4} m, {:.2} deg\n",
            sum / count,
            taken.len(),
            sum / taken.len().max(1) as f64,
            taken.iter().map(|it| it.turn_rad.to_degrees()).sum::<f64>()
                / taken.len().max(1) as f64
        )
    };
    let turn = |it: &Miss| it.relation.from_from_to.yaw_rad.abs();
    text += &part("off by less than 0.05 m", &|it| it.shift_m < 0.05);
    text += &part("off by 0.05 to 0.15 m", &|it| (0.05..0.15).contains(&it.shift_m));
    text += &part("off by more than 0.15 m", &|it| it.shift_m >= 0.15);
    text += &part("local, turning less than 10 deg", &|it| it.is_local && turn(it) < 0.1745);
    text += &part("local, turning more", &|it| it.is_local && turn(it) >= 0.1745);
    text += &part("loops", &|it| !it.is_local);
    text += &part("both ends at scans", &|it| it.beside_s <= 0.005);
    text += &part("an end up to 0.5 s beside a scan", &|it| (0.005..0.5).contains(&it.beside_s));
    text += &part("an end farther from any scan", &|it| it.beside_s >= 0.5);
    // Delayed lines are stamped when they were written, many at once; a stamp does not identify one of
    // them.
    let mut lines: Vec<f64> = between.iter().chain(scans).map(|it| it.0).collect();
    lines.sort_by(f64::total_cmp);
    let is_held_up = |time_s: f64| {
        let (first, last) = (
            lines.partition_point(|it| *it < time_s - 0.02),
            lines.partition_point(|it| *it <= time_s + 0.02),
        );
        let gap_s = |a: usize, b: usize| match (lines.get(a), lines.get(b)) {
            (Some(a), Some(b)) => b - a,
            _ => 0.0,
        };
        last - first >= 4
            || gap_s(first.wrapping_sub(1), first) > 1.5
            || gap_s(last.wrapping_sub(1), last) > 1.5
    };
    let ends = |it: &Miss| [it.relation.from_s, it.relation.to_s];
    text +=
        &part("an end where the logger was held up", &|it| ends(it).into_iter().any(is_held_up));
    text += &part("none there", &|it| !ends(it).into_iter().any(is_held_up));
    text += &part("asking for more than 2 m/s", &|it| {
        let way = it.relation.from_from_to;
        let seconds = (it.relation.to_s - it.relation.from_s).abs();
        libm::hypot(way.x_m, way.y_m) > 0.1 + 2.0 * seconds
    });
    // One bad stamp spoils all relations at it.
    let mut stamps: BTreeMap<i64, (f64, usize)> = BTreeMap::new();
    for it in missed {
        for stamp in [it.relation.from_s, it.relation.to_s] {
            let sum = stamps.entry((stamp * 1e3) as i64).or_default();
            *sum = (sum.0 + it.shift_m, sum.1 + 1);
        }
    }
    let mut worst: Vec<(i64, f64, usize)> = stamps
        .into_iter()
        .map(|(stamp, (sum, count))| (stamp, sum / count as f64, count))
        .collect();
    worst.retain(|it| it.2 >= 3);
    worst.sort_by(|a, b| b.1.total_cmp(&a.1));
    let bad: Vec<i64> = worst.iter().take(20).map(|it| it.0).collect();
    for (stamp, mean_m, count) in worst.iter().take(5) {
        let _ = writeln!(
            text,
            "      at {:.3} s {count} relations are off by {mean_m:.3} m",
            *stamp as f64 * 1e-3
        );
    }
    text += &part("at the 20 worst stamps", &|it| {
        [it.relation.from_s, it.relation.to_s].iter().any(|it| bad.contains(&((it * 1e3) as i64)))
    });
    text
}
