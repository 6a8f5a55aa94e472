//! Fast reading of costs at many points.
//!
//! The costs of the costmap are copied once a cycle into a grid with a border of unknown cells, so that a
//! point outside needs no test.

use periplus_costmap::{CostmapView, InflationLaw, cost};
use periplus_grid::Line;

use super::lane_math::{floor, sin_cos, to_integer};
use super::lanes::{LANES, Row, max, min};

/// Maximum cells along a side; larger costmaps are cut off.
const MAX_SIDE_CELLS: usize = 1 << 21;

/// Copy of a costmap with the shape of the robot.
#[derive(Clone, Debug)]
pub(crate) struct CostGrid {
    /// Costs with a border of unknown cells.
    cells: Vec<u8>,
    /// Columns, with the border.
    stride: usize,
    width: usize,
    height: usize,
    origin_x: f32,
    origin_y: f32,
    resolution: f32,
    /// True if unknown cells are not obstacles.
    pub(crate) tracks_unknown: bool,
    /// True if the robot is given by a radius.
    pub(crate) is_circular: bool,
    /// Inflation of the costmap.
    pub(crate) inflation: Option<InflationLaw>,
    /// Radius of the circle within the robot \[m\].
    pub(crate) inscribed_m: f64,
    /// Radius of the circle around the robot \[m\].
    pub(crate) circumscribed_m: f64,
    corners: Vec<[f32; 2]>,
}

impl Default for CostGrid {
    fn default() -> Self {
        Self {
            cells: vec![cost::UNKNOWN; 4],
            stride: 2,
            width: 0,
            height: 0,
            origin_x: 0.0,
            origin_y: 0.0,
            resolution: 1.0,
            tracks_unknown: false,
            is_circular: true,
            inflation: None,
            inscribed_m: 0.0,
            circumscribed_m: 0.0,
            corners: Vec::new(),
        }
    }
}

impl CostGrid {
    /// Copies a costmap. Positions are relative to an anchor in its frame \[m\].
    pub(crate) fn copy(&mut self, view: &CostmapView<'_>, [anchor_x, anchor_y]: [f64; 2]) {
        let info = view.costs.info();
        self.width = info.width.min(MAX_SIDE_CELLS);
        self.height = info.height.min(MAX_SIDE_CELLS);
        self.stride = self.width + 2;
        self.cells.clear();
        self.cells.resize(self.stride, cost::UNKNOWN);
        for row in view.costs.costs().chunks_exact(info.width.max(1)).take(self.height) {
            self.cells.push(cost::UNKNOWN);
            self.cells.extend_from_slice(&row[..self.width]);
            self.cells.push(cost::UNKNOWN);
        }
        self.cells.resize(self.stride * (self.height + 2), cost::UNKNOWN);
        self.origin_x = (info.origin.x_m - anchor_x) as f32;
        self.origin_y = (info.origin.y_m - anchor_y) as f32;
        self.resolution = info.resolution_m as f32;
        self.tracks_unknown = view.tracks_unknown;
        self.is_circular = view.is_circular;
        self.inflation = view.inflation;
        self.inscribed_m = view.footprint.inscribed_radius_m;
        self.circumscribed_m = view.footprint.circumscribed_radius_m;
        self.corners.clear();
        self.corners.extend(view.footprint.points().iter().map(|[x, y]| [*x as f32, *y as f32]));
    }

    /// Costs at the positions of a row; unknown outside.
    #[inline(always)]
    pub(crate) fn costs(&self, x: &Row, y: &Row) -> [u8; LANES] {
        let (width, height) = (self.width as f32, self.height as f32);
        let (mut columns, mut rows) = ([0_i32; LANES], [0_i32; LANES]);
        for lane in 0..LANES {
            let column = (x[lane] - self.origin_x) / self.resolution;
            let row = (y[lane] - self.origin_y) / self.resolution;
            columns[lane] = to_integer(floor(min(max(column, -1.0), width)));
            rows[lane] = to_integer(floor(min(max(row, -1.0), height)));
        }
        let mut costs = [cost::UNKNOWN; LANES];
        for lane in 0..LANES {
            let index = (rows[lane] + 1) as usize * self.stride + (columns[lane] + 1) as usize;
            costs[lane] = self.cells.get(index).copied().unwrap_or(cost::UNKNOWN);
        }
        costs
    }

    /// Cost at a position; none outside.
    pub(crate) fn find(&self, x: f32, y: f32) -> Option<u8> {
        let (column, row) = self.cell(x, y)?;
        self.cells.get((row + 1) * self.stride + column + 1).copied()
    }

    /// Cell of a position; none outside.
    fn cell(&self, x: f32, y: f32) -> Option<(usize, usize)> {
        let (column, row) =
            ((x - self.origin_x) / self.resolution, (y - self.origin_y) / self.resolution);
        let is_inside =
            column >= 0.0 && row >= 0.0 && column < self.width as f32 && row < self.height as f32;
        is_inside.then_some((column as usize, row as usize))
    }

    /// Highest cost along the outline of the robot at a pose; lethal if a corner is outside.
    pub(crate) fn footprint_cost(&self, x: f32, y: f32, yaw: f32) -> u8 {
        let (sine, cosine) = sin_cos(yaw);
        let place = |[across_x, across_y]: &[f32; 2]| {
            self.cell(
                x + (across_x * cosine - across_y * sine),
                y + (across_x * sine + across_y * cosine),
            )
        };
        let Some(last) = self.corners.last().and_then(place) else { return cost::LETHAL };
        let mut start = last;
        let mut highest = cost::FREE;
        for corner in &self.corners {
            let Some(end) = place(corner) else { return cost::LETHAL };
            for (column, row) in Line::between(start, end) {
                let cost = self.cells[(row + 1) * self.stride + column + 1];
                if cost == cost::LETHAL {
                    return cost;
                }
                highest = highest.max(cost);
            }
            start = end;
        }
        highest
    }

    /// Cost from which the outline of the robot may touch an obstacle; below 1 if it is unknown, so that the
    /// outline is always tested. `needs_radius` demands that the inflation covers the robot.
    pub(crate) fn circumscribed_cost(&self, needs_radius: bool) -> f32 {
        let Some(law) = self.inflation else { return -1.0 };
        let distance_m = self.circumscribed_m;
        if needs_radius && law.radius_m < distance_m {
            return 0.0;
        }
        if distance_m <= 0.0 {
            f32::from(cost::LETHAL)
        } else if distance_m <= self.inscribed_m {
            f32::from(cost::INSCRIBED)
        } else {
            let decay = libm::exp(-law.scaling_per_m * (distance_m - self.inscribed_m));
            f32::from((f64::from(cost::MAX_NON_OBSTACLE) * decay) as u8)
        }
    }

    /// Position of the lethal cell nearest to a point.
    pub(crate) fn nearest_obstacle(&self, x: f32, y: f32) -> Option<[f32; 2]> {
        let centre = |index: usize| {
            let (column, row) = (index % self.stride, index / self.stride);
            // The border is one cell wide.
            [
                self.origin_x + (column as f32 - 0.5) * self.resolution,
                self.origin_y + (row as f32 - 0.5) * self.resolution,
            ]
        };
        let cells = self.cells.iter().enumerate().filter(|(_, cost)| **cost == cost::LETHAL);
        let square = |[cx, cy]: &[f32; 2]| (cx - x) * (cx - x) + (cy - y) * (cy - y);
        cells.map(|(index, _)| centre(index)).min_by(|a, b| square(a).total_cmp(&square(b)))
    }
}

#[cfg(test)]
mod tests {
    use periplus_costmap::{Costmap, Footprint};
    use periplus_geometry::Pose2;
    use periplus_grid::GridInfo;
    use proptest::prelude::*;

    use super::*;

    /// 8 by 6 cells of 0.1 m from (1, 2), each with its own cost.
    fn costmap() -> Costmap {
        let info = GridInfo::new(0.1, 8, 6, Pose2::new(1.0, 2.0, 0.0)).unwrap();
        let mut costmap = Costmap::new(info, 0);
        for (index, cost) in costmap.costs_mut().iter_mut().enumerate() {
            *cost = index as u8 * 4;
        }
        costmap
    }

    fn grid(costmap: &Costmap, footprint: &Footprint, anchor: [f64; 2]) -> CostGrid {
        let view = CostmapView {
            costs: costmap,
            footprint,
            is_circular: false,
            tracks_unknown: true,
            inflation: None,
        };
        let mut grid = CostGrid::default();
        grid.copy(&view, anchor);
        grid
    }

    proptest! {
        #[test]
        fn costs_are_those_of_the_costmap(
            points in proptest::collection::vec((0.0_f32..3.0, 1.0_f32..4.0), LANES), far: bool
        ) {
            let costmap = costmap();
            let footprint = Footprint::default();
            let anchor = if far { [0.5, 0.25] } else { [0.0; 2] };
            let grid = grid(&costmap, &footprint, anchor);
            let x: Row = std::array::from_fn(|lane| points[lane].0 - anchor[0] as f32);
            let y: Row = std::array::from_fn(|lane| points[lane].1 - anchor[1] as f32);
            for (lane, cost) in grid.costs(&x, &y).into_iter().enumerate() {
                let exact = costmap.cost_at(f64::from(points[lane].0), f64::from(points[lane].1));
                let edge = |at: f32| (at * 10.0 - (at * 10.0).round()).abs() < 1e-4;
                if !edge(points[lane].0) && !edge(points[lane].1) {
                    prop_assert_eq!(cost, exact.unwrap_or(255));
                    prop_assert_eq!(grid.find(x[lane], y[lane]), exact);
                }
            }
        }

        #[test]
        fn footprints_cost_what_the_costmap_says(x in 1.0_f64..1.8, y in 2.0_f64..2.6, yaw in -4.0_f64..4.0) {
            let costmap = costmap();
            let footprint = Footprint::read("[[0.12, 0.08], [0.12, -0.08], [-0.12, -0.08], [-0.12, 0.08]]").unwrap();
            let grid = grid(&costmap, &footprint, [0.0; 2]);
            let pose = Pose2::new(x, y, yaw);
            let edge = |at: f64| (at * 10.0 - libm::round(at * 10.0)).abs() < 1e-4;
            if footprint.placed(pose).iter().flatten().all(|at| !edge(*at)) {
                let cost = grid.footprint_cost(x as f32, y as f32, yaw as f32);
                prop_assert_eq!(cost, footprint.cost(&costmap, pose));
            }
        }
    }

    #[test]
    fn the_cost_at_the_circumscribed_radius_follows_from_the_inflation() {
        let costmap = costmap();
        let footprint = Footprint::circle(0.2);
        let mut grid = grid(&costmap, &footprint, [0.0; 2]);
        grid.inscribed_m = 0.2;
        grid.circumscribed_m = 0.5;
        assert_eq!(grid.circumscribed_cost(true), -1.0);
        grid.inflation = Some(InflationLaw { radius_m: 0.4, scaling_per_m: 1.0 });
        assert_eq!(grid.circumscribed_cost(true), 0.0);
        // 252 exp(-0.3) = 186.7
        assert_eq!(grid.circumscribed_cost(false), 186.0);
    }

    #[test]
    fn the_nearest_obstacle_is_found() {
        let mut costmap = costmap();
        costmap.fill(0);
        costmap.set((3, 1), 254);
        costmap.set((7, 5), 254);
        let grid = grid(&costmap, &Footprint::default(), [0.0; 2]);
        let [x, y] = grid.nearest_obstacle(1.1, 2.1).unwrap();
        assert!((x - 1.35).abs() < 1e-5 && (y - 2.15).abs() < 1e-5, "{x} {y}");
    }
}
