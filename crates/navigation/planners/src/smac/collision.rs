//! Collision checks of poses on a costmap.
//!
//! Source of the rules: `nav2_smac_planner/src/collision_checker.cpp`. Poses are checked in the cell that
//! contains them; Nav2 looks half a cell further up and to the right.

use periplus_costmap::cost::{INSCRIBED, LETHAL, UNKNOWN};
use periplus_costmap::footprint::outline_cost;
use periplus_costmap::{Costmap, CostmapView};
use periplus_geometry::Pose2;

use super::headings::Headings;

/// Checker of poses.
#[derive(Debug)]
pub(crate) struct CollisionChecker<'a> {
    map: &'a Costmap,
    allow_unknown: bool,
    headings: &'a Headings,
    shape: Shape,
}

#[derive(Debug)]
enum Shape {
    /// The cost at the centre decides.
    Circle,
    /// The outline decides where the centre is within the circumscribed radius of an obstacle.
    Footprint {
        /// Cost from which the outline is checked; 0 to check it always.
        possible_cost: u8,
        /// Corners by heading \[m\], relative to the base.
        corners: Vec<Vec<[f64; 2]>>,
    },
}

/// Returns the cost of the inflation at the circumscribed radius of the robot: with a lower cost at its
/// centre the robot is free in any orientation. 0 where the inflation does not reach that far.
///
/// Source: `findCircumscribedCost` in `nav2_smac_planner/utils.hpp`.
pub(crate) fn circumscribed_cost(view: &CostmapView<'_>) -> u8 {
    let radius_m = view.footprint.circumscribed_radius_m;
    let Some(law) = view.inflation.filter(|law| law.radius_m >= radius_m) else { return 0 };
    let beyond_m = radius_m - view.footprint.inscribed_radius_m;
    if beyond_m <= 0.0 {
        return INSCRIBED;
    }
    (f64::from(INSCRIBED - 1) * libm::exp(-law.scaling_per_m * beyond_m)) as u8
}

impl<'a> CollisionChecker<'a> {
    /// Creates a checker for a number of headings on a costmap, which may be a coarser copy of the view's.
    pub(crate) fn new(
        view: &CostmapView<'_>,
        map: &'a Costmap,
        headings: &'a Headings,
        allow_unknown: bool,
    ) -> Self {
        let shape = if view.is_circular || view.footprint.points().len() < 3 {
            Shape::Circle
        } else {
            let rotated = |bin: usize| {
                let (sine, cosine) = libm::sincos(headings.angle_rad(bin));
                let rotate = |[x, y]: &[f64; 2]| [x * cosine - y * sine, x * sine + y * cosine];
                view.footprint.points().iter().map(rotate).collect()
            };
            let corners = (0..headings.count()).map(rotated).collect();
            Shape::Footprint { possible_cost: circumscribed_cost(view), corners }
        };
        Self { map, allow_unknown, headings, shape }
    }

    /// Returns the cost at the centre of a robot at a pose \[cells, bins\]; none if it collides.
    pub(crate) fn free_cost(&self, x: f64, y: f64, bin: usize) -> Option<u8> {
        let info = self.map.info();
        let is_inside = x >= 0.0 && y >= 0.0 && x < info.width as f64 && y < info.height as f64;
        let cell = is_inside.then_some((x as usize, y as usize))?;
        let cost = self.map.cost(cell)?;
        match &self.shape {
            Shape::Circle => {}
            Shape::Footprint { possible_cost, .. } if cost < *possible_cost => {
                return Some(cost);
            }
            Shape::Footprint { corners, .. } => {
                let is_centre_free =
                    if cost == UNKNOWN { self.allow_unknown } else { cost < INSCRIBED };
                if !is_centre_free || !self.is_outline_free(corners.get(bin)?, x, y) {
                    return None;
                }
            }
        }
        let is_free = if cost == UNKNOWN { self.allow_unknown } else { cost < INSCRIBED };
        is_free.then_some(cost)
    }

    /// Like [`Self::free_cost`], with a yaw instead of a bin \[cells, rad\].
    pub(crate) fn free_cost_at(&self, pose: Pose2) -> Option<u8> {
        self.free_cost(pose.x_m, pose.y_m, self.headings.nearest(pose.yaw_rad))
    }

    fn is_outline_free(&self, corners: &[[f64; 2]], x: f64, y: f64) -> bool {
        let (x_m, y_m) = self.map.info().point_at(x, y);
        let placed: Vec<[f64; 2]> = corners.iter().map(|[dx, dy]| [x_m + dx, y_m + dy]).collect();
        match outline_cost(self.map, &placed) {
            UNKNOWN => self.allow_unknown,
            cost => cost < LETHAL,
        }
    }
}

/// Copies a costmap to cells that are larger by a factor; each gets the highest cost of its parts.
///
/// Source: `nav2_smac_planner/src/costmap_downsampler.cpp`.
pub(crate) fn downsampled(map: &Costmap, factor: usize) -> Costmap {
    let info = *map.info();
    let (width, height) = (info.width.div_ceil(factor), info.height.div_ceil(factor));
    let resolution_m = info.resolution_m * factor as f64;
    let coarse = periplus_grid::GridInfo { resolution_m, width, height, ..info };
    let mut copy = Costmap::new(coarse, 0);
    for row in 0..info.height {
        let from = &map.costs()[row * info.width..][..info.width];
        let to = &mut copy.costs_mut()[row / factor * width..][..width];
        for (to, part) in to.iter_mut().zip(from.chunks(factor)) {
            *to = part.iter().copied().fold(*to, u8::max);
        }
    }
    copy
}

#[cfg(test)]
mod tests {
    use periplus_grid::GridInfo;

    use super::*;

    #[test]
    fn coarse_cells_have_the_highest_cost() {
        let info = GridInfo::new(0.5, 3, 2, Pose2::IDENTITY).unwrap();
        let mut map = Costmap::new(info, 1);
        map.set((2, 1), 9);
        let coarse = downsampled(&map, 2);
        assert_eq!((coarse.costs(), coarse.resolution_m()), (&[1, 9][..], 1.0));
    }
}
