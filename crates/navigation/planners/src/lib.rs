//! Global path planners and path smoothers with the behaviour of Nav2.
//!
//! A [`Planner`] gets a costmap, a start and a goal and returns a path, or the reason why there is none: the
//! error code of Nav2, the blocking cell with its cost, and the nearest position that can be reached.
//! Planners are created by the class of their plugin and its parameters, see [`PlannerKind`].
//!
//! ```
//! use periplus_costmap::{Costmap, CostmapView, Footprint};
//! use periplus_geometry::Pose2;
//! use periplus_planners::{NavFnPlanner, PlanRequest, Planner};
//! # let info = periplus_grid::GridInfo::new(0.1, 60, 40, Pose2::IDENTITY)?;
//!
//! let (costs, footprint) = (Costmap::new(info, 0), Footprint::circle(0.2));
//! let costmap = CostmapView {
//!     costs: &costs, footprint: &footprint, is_circular: true, tracks_unknown: true, inflation: None,
//! };
//! let (start, goal) = (Pose2::new(1.0, 1.0, 0.0), Pose2::new(5.0, 3.0, 1.5));
//! let (is_cancelled, is_out_of_time) = (&mut || false, &mut || false);
//! let request = PlanRequest { costmap, start, goal, is_cancelled, is_out_of_time };
//! let plan = NavFnPlanner::default().plan(request)?;
//! assert!(plan.length_m() < 4.6 && plan.poses.last() == Some(&goal));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cell_index;
mod error;
mod factory;
mod navfn;
mod obstruction;
mod open_list;
mod outside;
mod parameters;
mod planner;
mod poses;
mod smac;
mod smoothing;
pub mod tables;
mod theta_star;

pub use error::{
    BlockedPart, BlockingCell, ParameterRejected, PlanError, PlanErrorKind, PlanObstruction,
    ReachablePose,
};
pub use factory::{PlannerKind, SmootherKind, UnknownClass};
pub use navfn::{
    NavFnMethod, NavFnPlanner, PotentialField, Propagation, PropagationCancelled, navfn_cell_of,
    navfn_point_of,
};
pub use planner::{PlanRequest, PlannedPath, Planner};
pub use smac::{
    GoalHeadingMode, Lattice, LatticeError, LatticePrimitive, MotionPrimitive, PrimitiveSet,
    Smac2dPlanner, SmacHybridPlanner, SmacMotionModel, StepPenalties, TurnDirection,
};
pub use smoothing::{
    SavitzkyGolaySmoother, SimpleSmoother, SmoothError, SmoothErrorKind, SmoothRequest, Smoother,
    first_collision,
};
pub use theta_star::ThetaStarPlanner;
