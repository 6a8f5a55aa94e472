//! The part of the plan that the samples are compared with.
//!
//! Source: `nav2_mppi_controller` `tools/utils.hpp` (`findPathFurthestReachedPoint`, `findPathCosts`).

use periplus_costmap::{Nav2Release, cost};

use super::cost_grid::CostGrid;
use super::lanes::{LANES, Row, ZEROS};
use super::samples::Samples;

/// Points of the plan, as a structure of arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LocalPath {
    /// Position \[m\].
    pub(crate) x: Vec<f32>,
    /// Position \[m\].
    pub(crate) y: Vec<f32>,
    /// Heading \[rad\].
    pub(crate) yaw: Vec<f32>,
    /// Distance along the path from its start \[m\].
    pub(crate) travelled: Vec<f32>,
    /// Length \[m\].
    pub(crate) length: f32,
}

impl LocalPath {
    /// Creates a path from poses: x \[m\], y \[m\], yaw \[rad\].
    pub(crate) fn new(poses: impl IntoIterator<Item = [f32; 3]>) -> Self {
        let mut path = Self::default();
        for [x, y, yaw] in poses {
            if let (Some(last_x), Some(last_y)) = (path.x.last(), path.y.last()) {
                let (dx, dy) = (x - last_x, y - last_y);
                path.length += (dx * dx + dy * dy).sqrt();
            }
            path.x.push(x);
            path.y.push(y);
            path.yaw.push(yaw);
            path.travelled.push(path.length);
        }
        path
    }

    /// Number of points.
    pub(crate) fn len(&self) -> usize {
        self.x.len()
    }

    /// Index of the last point.
    pub(crate) fn last(&self) -> usize {
        self.len().saturating_sub(1)
    }

    /// Pose of a point: x, y, yaw; that of the last point beyond the end.
    pub(crate) fn pose(&self, index: usize) -> [f32; 3] {
        let index = index.min(self.last());
        let value = |values: &Vec<f32>| values.get(index).copied().unwrap_or(0.0);
        [value(&self.x), value(&self.y), value(&self.yaw)]
    }

    /// Returns for each point but the last if a robot could be there: it is on the costmap and not in an
    /// obstacle. Unknown cells count as free if the costmap distinguishes them.
    pub(crate) fn find_valid(&self, grid: &CostGrid) -> Vec<bool> {
        let is_valid = |index: usize| match grid.find(self.x[index], self.y[index]) {
            None | Some(cost::INSCRIBED | cost::LETHAL) => false,
            Some(cost::UNKNOWN) => grid.tracks_unknown,
            Some(_) => true,
        };
        (0..self.last()).map(is_valid).collect()
    }

    /// Index of the furthest point that is the nearest to the end of a sample.
    pub(crate) fn find_furthest(
        &self,
        samples: &Samples,
        release: Nav2Release,
        step_s: f32,
    ) -> usize {
        let mut furthest = 0;
        for block in 0..samples.blocks() {
            let last = samples.steps.saturating_sub(1);
            let (Some(x), Some(y)) =
                (samples.x.block(block).get(last), samples.y.block(block).get(last))
            else {
                break;
            };
            let count = samples.in_block(block);
            if release == Nav2Release::Main {
                let driven = lengths(samples, block, step_s);
                furthest = self.furthest_within(x, y, &driven, count, furthest);
            } else {
                let from = if release == Nav2Release::Humble { 0 } else { furthest };
                furthest = furthest.max(self.furthest_from(x, y, count, from, furthest));
            }
        }
        furthest
    }

    /// Furthest nearest point among those from `from`; samples that cannot be beyond `furthest` are skipped
    /// where the result does not depend on them.
    fn furthest_from(&self, x: &Row, y: &Row, count: usize, from: usize, furthest: usize) -> usize {
        let mut best = furthest;
        for lane in 0..count {
            // Outside of Humble the search starts at the furthest point so far.
            let start = if from == 0 { 0 } else { best };
            best = best.max(self.nearest(x[lane], y[lane], start, self.last()));
            if best == self.last() {
                break;
            }
        }
        best
    }

    /// Furthest nearest point, each within the distance that the sample has driven (main).
    fn furthest_within(
        &self,
        x: &Row,
        y: &Row,
        driven: &Row,
        count: usize,
        furthest: usize,
    ) -> usize {
        let mut best = furthest;
        for lane in 0..count {
            if best == self.last() {
                break;
            }
            let reach = self.travelled.partition_point(|travelled| *travelled < driven[lane]);
            let reach = reach.min(self.last());
            if reach > best {
                best = best.max(self.nearest(x[lane], y[lane], 0, reach));
            }
        }
        best
    }

    /// Index of the point nearest to a position, the first of several, from `first` to `last`.
    fn nearest(&self, x: f32, y: f32, first: usize, last: usize) -> usize {
        let (mut nearest, mut lowest) = (first, f32::INFINITY);
        let points = self.x[first..=last].iter().zip(&self.y[first..=last]);
        for (index, (px, py)) in points.enumerate() {
            let (dx, dy) = (px - x, py - y);
            let square = dx * dx + dy * dy;
            if square < lowest {
                (nearest, lowest) = (first + index, square);
            }
        }
        nearest
    }
}

/// Distances driven by the samples of a block between their first and last point \[m\].
fn lengths(samples: &Samples, block: usize, step_s: f32) -> Row {
    let vx = samples.vx.velocities.block(block);
    let vy = samples.vy.velocities.block(block);
    let mut total = ZEROS;
    for (step, forwards) in vx.iter().enumerate().skip(1) {
        if let Some(sideways) = vy.get(step) {
            for lane in 0..LANES {
                let square = forwards[lane] * forwards[lane] + sideways[lane] * sideways[lane];
                total[lane] += square.sqrt();
            }
        } else {
            for lane in 0..LANES {
                total[lane] += forwards[lane].abs();
            }
        }
    }
    total.map(|speeds| speeds * step_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight() -> LocalPath {
        LocalPath::new((0..10).map(|i| [0.1 * i as f32, 0.0, 0.0]))
    }

    /// One sample that ends at a position after a drive with 1 m/s for 0.1 s a step.
    fn check(release: Nav2Release, ends: &[[f32; 2]], steps: usize, expected: usize) {
        let mut samples = Samples::new(ends.len(), steps, false);
        for (sample, [x, y]) in ends.iter().enumerate() {
            samples.x.set(sample, steps - 1, *x);
            samples.y.set(sample, steps - 1, *y);
            for step in 0..steps {
                samples.vx.velocities.set(sample, step, -1.0);
            }
        }
        assert_eq!(straight().find_furthest(&samples, release, 0.1), expected, "{release}");
    }

    #[test]
    fn the_furthest_point_is_that_of_any_sample() {
        for release in Nav2Release::ALL {
            check(release, &[[0.12, 0.3]], 9, 1);
            check(release, &[[0.12, 0.3], [0.52, 0.1], [0.0, 0.0]], 9, 5);
            check(release, &[[9.0, 9.0]], 20, 9);
        }
    }

    #[test]
    fn on_main_a_sample_reaches_no_further_than_it_drives() {
        check(Nav2Release::Main, &[[0.8, 0.0]], 4, 3);
        check(Nav2Release::Jazzy, &[[0.8, 0.0]], 4, 8);
    }

    #[test]
    fn a_path_has_lengths() {
        let path = LocalPath::new([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0], [3.0, 5.0, 1.0]]);
        assert_eq!((path.travelled.as_slice(), path.length), ([0.0, 5.0, 6.0].as_slice(), 6.0));
        assert_eq!(path.pose(7), [3.0, 5.0, 1.0]);
    }
}
