//! Read access to a costmap for planners and controllers.

use std::any::Any;

use crate::layers::InflationLayer;
use crate::{Costmap, Footprint, Layer, LayeredCostmap};

/// Inflation of a costmap: the law by which costs fall with the distance from obstacles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InflationLaw {
    /// Distance beyond which costs are free \[m\].
    pub radius_m: f64,
    /// Rate of the exponential decay \[1/m\].
    pub scaling_per_m: f64,
}

/// Read access to a costmap together with the shape of the robot, for planners and controllers.
#[derive(Clone, Copy, Debug)]
pub struct CostmapView<'a> {
    /// Costs.
    pub costs: &'a Costmap,
    /// Padded footprint of the robot.
    pub footprint: &'a Footprint,
    /// True if the robot is given by a radius: the cost of its centre then decides about collisions.
    pub is_circular: bool,
    /// True if unobserved cells are unknown, false if they are free.
    pub tracks_unknown: bool,
    /// Inflation; none without an inflation layer.
    pub inflation: Option<InflationLaw>,
}

impl LayeredCostmap {
    /// Returns read access to the costs, for planners and controllers. `is_circular` is true if the robot is
    /// given by `robot_radius`.
    #[must_use]
    pub fn view(&self, is_circular: bool) -> CostmapView<'_> {
        let inflation =
            |layer: &dyn Layer| (layer as &dyn Any).downcast_ref().map(InflationLayer::law);
        CostmapView {
            costs: self.costmap(),
            footprint: self.footprint(),
            is_circular,
            tracks_unknown: self.frame().tracks_unknown,
            inflation: self.all().find_map(inflation),
        }
    }
}
