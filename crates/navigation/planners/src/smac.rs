//! Smac planners: A* on cells, and Hybrid-A* on cells and headings.
//!
//! Source of the rules: `nav2_smac_planner`; D. Dolgov et al., "Practical search techniques in path planning
//! for autonomous driving", 2008.

mod analytic;
mod collision;
mod curve;
mod distance_table;
mod dubins;
mod graph;
mod headings;
mod hybrid;
mod lattice;
mod motions;
mod obstacle_heuristic;
mod path_smoothing;
mod plane;
mod primitives;
mod reeds_shepp;
mod search;

pub use hybrid::{GoalHeadingMode, SmacHybridPlanner};
pub use lattice::{Lattice, LatticeError, LatticePrimitive};
pub use plane::Smac2dPlanner;
pub use primitives::{
    MotionPrimitive, PrimitiveSet, SmacMotionModel, StepPenalties, TurnDirection,
};
