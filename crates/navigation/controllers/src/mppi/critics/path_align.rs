//! `PathAlignCritic`: distance to the path, point by point.

use periplus_costmap::Nav2Release;

use super::{CriticContext, Weighting, length};
use crate::mppi::lane_math::normalize_angle;
use crate::mppi::lanes::{LANES, Row, ZEROS};
use crate::mppi::params::PathAlignParams;
use crate::mppi::samples::Samples;

/// Number of occupied path points that never switch the critic off.
const MIN_OCCUPIED_POINTS: usize = 2;

/// Mean distance of a trajectory's points to those points of the path that are as far from the start.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathAlignCritic {
    pub(super) weighting: Weighting,
    max_occupancy_ratio: f32,
    min_reached_points: usize,
    pub(super) point_step: usize,
    threshold: f32,
    pub(super) uses_headings: bool,
}

impl PathAlignCritic {
    pub(crate) fn new(params: &PathAlignParams) -> Self {
        Self {
            weighting: Weighting::new(&params.common, params.weight),
            max_occupancy_ratio: params.max_occupancy_ratio as f32,
            min_reached_points: params.min_reached_points,
            point_step: params.point_step,
            threshold: params.threshold_m as f32,
            uses_headings: params.uses_headings,
        }
    }

    /// Returns the number of path points to compare with; none if the critic does not apply.
    pub(super) fn reached(&self, context: &CriticContext<'_>, samples: &Samples) -> Option<usize> {
        if !self.weighting.is_enabled || context.is_goal_within(self.threshold) {
            return None;
        }
        let furthest = context.furthest(samples);
        if furthest < self.min_reached_points || furthest == 0 {
            return None;
        }
        let first =
            if context.release == Nav2Release::Humble { nearest(context, samples) } else { 0 };
        (!self.is_occupied(context, first, furthest)).then_some(furthest)
    }

    /// Returns true if too many of the path's points are in obstacles.
    fn is_occupied(&self, context: &CriticContext<'_>, first: usize, end: usize) -> bool {
        let range = end as f32 - first as f32;
        let mut occupied = 0;
        for index in first..end {
            occupied += usize::from(!context.is_valid(index));
            if occupied as f32 / range > self.max_occupancy_ratio && occupied > MIN_OCCUPIED_POINTS
            {
                return true;
            }
        }
        false
    }

    pub(crate) fn score(&self, context: &CriticContext<'_>, samples: &Samples, costs: &mut [Row]) {
        let Some(reached) = self.reached(context, samples) else { return };
        let path = ReachedPath::new(context, reached);
        let travelled = &context.path.travelled[..reached];
        for (block, costs) in costs.iter_mut().enumerate() {
            let distances = if context.release == Nav2Release::Humble {
                let find = |driven, from| find_point_humble(travelled, driven, from);
                self.distances(samples, block, &path, find)
            } else {
                let find = |driven, from| path.find(driven, from);
                self.distances(samples, block, &path, find)
            };
            self.weighting.add(costs, &distances);
        }
    }

    /// Mean distances of a block's samples to the points of the path. `find` returns the index of the point at a
    /// distance from the start, from the index before.
    #[inline(always)]
    fn distances(
        &self,
        samples: &Samples,
        block: usize,
        path: &ReachedPath<'_>,
        find: impl Fn(f32, usize) -> usize,
    ) -> Row {
        let (x, y) = (samples.x.block(block), samples.y.block(block));
        let yaw = samples.yaw.block(block);
        let (mut total, mut count, mut driven) = (ZEROS, ZEROS, ZEROS);
        let mut nearest = [0; LANES];
        for at in (self.point_step..samples.steps).step_by(self.point_step) {
            let (last_x, last_y) = (&x[at - self.point_step], &y[at - self.point_step]);
            let (x, y, yaw) = (&x[at], &y[at], &yaw[at]);
            for lane in 0..LANES {
                driven[lane] += length(x[lane] - last_x[lane], y[lane] - last_y[lane]);
            }
            let (mut aim_x, mut aim_y, mut aim_yaw, mut weight) = (ZEROS, ZEROS, ZEROS, ZEROS);
            for lane in 0..LANES {
                let index = find(driven[lane], nearest[lane]).min(path.weight.len() - 1);
                nearest[lane] = index;
                (aim_x[lane], aim_y[lane]) = (path.x[index], path.y[index]);
                (aim_yaw[lane], weight[lane]) = (path.yaw[index], path.weight[index]);
            }
            let turn_factor = if self.uses_headings { 1.0 } else { 0.0 };
            for lane in 0..LANES {
                let (dx, dy) = (aim_x[lane] - x[lane], aim_y[lane] - y[lane]);
                let turn = turn_factor * normalize_angle(yaw[lane] - aim_yaw[lane]);
                total[lane] += weight[lane] * (dx * dx + dy * dy + turn * turn).sqrt();
                count[lane] += weight[lane];
            }
        }
        let mut means = ZEROS;
        for lane in 0..LANES {
            means[lane] = total[lane] / if count[lane] > 0.0 { count[lane] } else { 1.0 };
        }
        means
    }
}

/// The part of the path that samples reach.
struct ReachedPath<'a> {
    x: &'a [f32],
    y: &'a [f32],
    yaw: &'a [f32],
    /// 1 for free points, and 0 for points in an obstacle, which do not count.
    weight: Vec<f32>,
    /// Distances from the start halfway to the next point \[m\]; infinite for the last point.
    halfway: Vec<f32>,
}

impl<'a> ReachedPath<'a> {
    fn new(context: &CriticContext<'a>, reached: usize) -> Self {
        let path = context.path;
        let travelled = &path.travelled[..reached];
        let middles = travelled.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        Self {
            x: &path.x[..reached],
            y: &path.y[..reached],
            yaw: &path.yaw[..reached],
            weight: (0..reached).map(|index| f32::from(context.is_valid(index))).collect(),
            halfway: middles.chain([f32::INFINITY]).collect(),
        }
    }

    /// Index of the point nearest to a distance from the start, not before `from`.
    #[inline(always)]
    fn find(&self, driven: f32, from: usize) -> usize {
        let mut index = from;
        while self.halfway.get(index).is_some_and(|halfway| *halfway <= driven) {
            index += 1;
        }
        index
    }
}

/// Index of the path point nearest to the first points of the samples (Humble).
fn nearest(context: &CriticContext<'_>, samples: &Samples) -> usize {
    let (x, y) = (samples.x.at(0, 0), samples.y.at(0, 0));
    let square = |index: &usize| {
        let (dx, dy) = (context.path.x[*index] - x, context.path.y[*index] - y);
        dx * dx + dy * dy
    };
    (0..context.path.len()).min_by(|a, b| square(a).total_cmp(&square(b))).unwrap_or(0)
}

/// Index of the point as Humble finds it: back at the start where the point before has not been passed yet.
fn find_point_humble(travelled: &[f32], distance: f32, from: usize) -> usize {
    let index = from + travelled[from.min(travelled.len())..].partition_point(|at| *at < distance);
    if index == from {
        return 0;
    }
    match travelled.get(index) {
        None => travelled.len() - 1,
        Some(at) if distance - travelled[index - 1] < at - distance => index - 1,
        Some(_) => index,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn path_points_are_found_by_distance() {
        let travelled = [0.0, 1.0, 2.0, 4.0];
        let path = ReachedPath {
            x: &travelled,
            y: &travelled,
            yaw: &travelled,
            weight: vec![1.0; 4],
            halfway: vec![0.5, 1.5, 3.0, f32::INFINITY],
        };
        let check = |distance, from, expected| {
            assert_eq!(path.find(distance, from), expected, "{distance} from {from}");
        };
        check(0.0, 0, 0);
        check(0.4, 0, 0);
        check(0.5, 0, 1);
        check(1.4, 0, 1);
        check(1.4, 1, 1);
        check(2.9, 1, 2);
        check(3.0, 1, 3);
        check(9.0, 2, 3);
        check(1.6, 2, 2);
        assert_eq!(find_point_humble(&travelled, 1.4, 0), 1);
        assert_eq!(find_point_humble(&travelled, 1.6, 2), 0);
        assert_eq!(find_point_humble(&travelled, 9.0, 2), 3);
    }
}
