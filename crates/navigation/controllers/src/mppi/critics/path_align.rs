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
        let find =
            if context.release == Nav2Release::Humble { find_point_humble } else { find_point };
        let path = context.path;
        let travelled = &path.travelled[..reached];
        // A point in an obstacle counts neither as distance nor as point.
        let points: Vec<PathPoint> = (0..reached)
            .map(|index| PathPoint {
                x: path.x[index],
                y: path.y[index],
                yaw: path.yaw[index],
                weight: if context.is_valid(index) { 1.0 } else { 0.0 },
            })
            .collect();
        for (block, costs) in costs.iter_mut().enumerate() {
            let (x, y) = (samples.x.block(block), samples.y.block(block));
            let yaw = samples.yaw.block(block);
            let (mut total, mut count, mut driven) = (ZEROS, ZEROS, ZEROS);
            let mut nearest = [0; LANES];
            for at in (self.point_step..samples.steps).step_by(self.point_step) {
                let before = at - self.point_step;
                for lane in 0..LANES {
                    let (dx, dy) = (x[at][lane] - x[before][lane], y[at][lane] - y[before][lane]);
                    driven[lane] += length(dx, dy);
                }
                let mut aims = [PathPoint::default(); LANES];
                for lane in 0..LANES {
                    nearest[lane] = find(travelled, driven[lane], nearest[lane]);
                    aims[lane] = points.get(nearest[lane]).copied().unwrap_or_default();
                }
                for lane in 0..LANES {
                    let (dx, dy) = (aims[lane].x - x[at][lane], aims[lane].y - y[at][lane]);
                    let mut square = dx * dx + dy * dy;
                    if self.uses_headings {
                        let turn = normalize_angle(yaw[at][lane] - aims[lane].yaw);
                        square += turn * turn;
                    }
                    total[lane] += aims[lane].weight * square.sqrt();
                    count[lane] += aims[lane].weight;
                }
            }
            let mut measures = ZEROS;
            for lane in 0..LANES {
                let count = count[lane];
                measures[lane] = total[lane] / if count > 0.0 { count } else { 1.0 };
            }
            self.weighting.add(costs, &measures);
        }
    }
}

#[derive(Clone, Copy, Default)]
struct PathPoint {
    x: f32,
    y: f32,
    yaw: f32,
    weight: f32,
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

/// Index of the point nearest to a distance from the start, not before `from`.
#[inline(always)]
fn find_point(travelled: &[f32], distance: f32, from: usize) -> usize {
    let mut before = travelled.get(from).copied().unwrap_or(0.0);
    for (index, at) in travelled.iter().enumerate().skip(from + 1) {
        if *at > distance {
            return if distance - before < at - distance { index - 1 } else { index };
        }
        before = *at;
    }
    travelled.len().saturating_sub(1)
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
        let check = |distance, from, expected| {
            assert_eq!(find_point(&travelled, distance, from), expected, "{distance} from {from}");
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
