//! Uncertainty of poses relative to one of them.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use periplus_geometry::Pose2;
use periplus_scan_matching::Symmetric3;

use crate::graph::Graph;

/// A pose as seen from the one that was asked about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RelativeUncertainty {
    pub(crate) keyframe: usize,
    /// Covariance of `start_from_keyframe`; errors are a shift along the axes of the start and a turn.
    pub(crate) covariance: Symmetric3,
}

impl RelativeUncertainty {
    /// One standard deviation of the position along its worst direction \[m\].
    pub(crate) fn shift_m(&self) -> f64 {
        self.covariance.largest_shift().sqrt()
    }

    /// One standard deviation of the heading \[rad\].
    pub(crate) fn turn_rad(&self) -> f64 {
        self.covariance.tt.sqrt()
    }
}

/// A turn counts as the shift at the end of an arm of this length \[m\], to weigh paths.
const ARM_M: f64 = 3.0;

/// All poses that some path of edges leads to with less than `most_m` of uncertainty, the surest
/// first. The covariance is the one along the best single path: more paths together know more, so it
/// is never too small. The estimate costs a walk and no inverse of the whole graph.
///
/// Source: Olson 2008, "Robust and efficient robotic mapping", section on Dijkstra projections.
pub(crate) fn uncertainties_from(
    graph: &Graph,
    start: usize,
    most_m: f64,
) -> Vec<RelativeUncertainty> {
    within(graph, start, most_m, f64::INFINITY)
}

/// Like [`uncertainties_from`], over paths that stay within `reach_m` of the start in a straight line.
pub(crate) fn within(
    graph: &Graph,
    start: usize,
    most_m: f64,
    reach_m: f64,
) -> Vec<RelativeUncertainty> {
    let mut settled = vec![false; graph.poses.len()];
    let mut heap = BinaryHeap::new();
    let mut found = Vec::new();
    let start_from_map = graph.poses[start].inverse();
    heap.push(Entry {
        size: 0.0,
        uncertainty: RelativeUncertainty { keyframe: start, covariance: Symmetric3::ZERO },
    });
    while let Some(Entry { uncertainty, .. }) = heap.pop() {
        if std::mem::replace(&mut settled[uncertainty.keyframe], true) {
            continue;
        }
        found.push(uncertainty);
        let start_from_here = start_from_map * graph.poses[uncertainty.keyframe];
        let here_from_map = graph.poses[uncertainty.keyframe].inverse();
        for &index in &graph.at[uncertainty.keyframe] {
            let edge = &graph.edges[index as usize];
            if edge.weight < 0.5 {
                continue;
            }
            let [there, back] = &edge.covariances;
            let (next, covariance) = if edge.from == uncertainty.keyframe {
                (edge.to, there)
            } else {
                (edge.from, back)
            };
            let away = start_from_map * graph.poses[next];
            if settled[next] || libm::hypot(away.x_m, away.y_m) > reach_m {
                continue;
            }
            let here_from_next = here_from_map * graph.poses[next];
            let covariance =
                uncertainty.covariance.compounded(start_from_here, here_from_next, covariance);
            let size = covariance.largest_shift() + ARM_M * ARM_M * covariance.tt;
            if size < most_m * most_m {
                heap.push(Entry {
                    size,
                    uncertainty: RelativeUncertainty { keyframe: next, covariance },
                });
            }
        }
    }
    found
}

/// The covariance of `b_from_a` from that of `a_from_b`.
pub(crate) fn reversed(covariance: &Symmetric3, a_from_b: Pose2) -> Symmetric3 {
    // A turn of a about its own origin moves it, as seen from b, at right angles to the line between.
    let around = Symmetric3 { xt: -covariance.xt, yt: -covariance.yt, ..*covariance };
    let turned = around.turned(-a_from_b.yaw_rad);
    let b_from_a = a_from_b.inverse();
    let across = [b_from_a.y_m, -b_from_a.x_m];
    let Symmetric3 { xx, xy, xt, yy, yt, tt } = turned;
    Symmetric3 {
        xx: xx + 2.0 * across[0] * xt + across[0] * across[0] * tt,
        xy: xy + across[0] * yt + across[1] * xt + across[0] * across[1] * tt,
        xt: -(xt + across[0] * tt),
        yy: yy + 2.0 * across[1] * yt + across[1] * across[1] * tt,
        yt: -(yt + across[1] * tt),
        tt,
    }
}

struct Entry {
    size: f64,
    uncertainty: RelativeUncertainty,
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        // The heap gives the largest first, and we want the smallest.
        other
            .size
            .total_cmp(&self.size)
            .then(other.uncertainty.keyframe.cmp(&self.uncertainty.keyframe))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Covariances by moving the ends a little, many times.
    #[test]
    fn a_reversed_pose_is_as_uncertain_as_its_samples() {
        let pose = Pose2::new(3.0, -1.0, 0.8);
        let shape = Symmetric3 { xx: 0.04, xy: 0.01, xt: 0.002, yy: 0.02, yt: -0.003, tt: 0.01 };
        // Columns of a square root of it, by sampling along its axes instead: finite differences.
        let jacobian = |k: usize| {
            let step = 1e-6;
            let mut moved = pose;
            match k {
                0 => moved.x_m += step,
                1 => moved.y_m += step,
                _ => moved.yaw_rad += step,
            }
            let (a, b) = (moved.inverse(), pose.inverse());
            [(a.x_m - b.x_m) / step, (a.y_m - b.y_m) / step, (a.yaw_rad - b.yaw_rad) / step]
        };
        let columns = [jacobian(0), jacobian(1), jacobian(2)];
        let full = [
            [shape.xx, shape.xy, shape.xt],
            [shape.xy, shape.yy, shape.yt],
            [shape.xt, shape.yt, shape.tt],
        ];
        let entry = |i: usize, j: usize| -> f64 {
            (0..3)
                .map(|a| (0..3).map(|b| columns[a][i] * full[a][b] * columns[b][j]).sum::<f64>())
                .sum()
        };
        let found = reversed(&shape, pose);
        let parts = [
            (found.xx, entry(0, 0)),
            (found.xy, entry(0, 1)),
            (found.xt, entry(0, 2)),
            (found.yy, entry(1, 1)),
            (found.yt, entry(1, 2)),
            (found.tt, entry(2, 2)),
        ];
        for (found, right) in parts {
            assert!((found - right).abs() < 1e-6, "{parts:?}");
        }
    }
}
