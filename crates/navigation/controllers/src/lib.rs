//! Path-following controllers with the behaviour of Nav2, and the checkers of goal and progress.
//!
//! A [`Controller`] gets the robot's pose, velocity, local costmap and plan as arguments and returns a velocity;
//! it has no clock and no inputs. [`create_controller`] creates one from the name of its class and its parameters.
//!
//! ```
//! use periplus_controllers::{ControlInput, GoalTolerance, PluginSetup, create_controller};
//! use periplus_costmap::{Costmap, CostmapView, Footprint};
//! use periplus_diagnostics::Diagnostics;
//! # use periplus_geometry::{Pose2, Twist2};
//! # use periplus_grid::GridInfo;
//!
//! let class = "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController";
//! let setup = PluginSetup::new("FollowPath");
//! let mut controller = create_controller(class, &setup, &mut Diagnostics::new()).expect("a class");
//! let plan = [Pose2::IDENTITY, Pose2::new(1.0, 0.0, 0.0), Pose2::new(1.0, 2.0, 0.0)];
//! controller.set_plan(&plan);
//! # let info = GridInfo::new(0.05, 120, 120, Pose2::new(-3.0, -3.0, 0.0))?;
//! # let (costs, footprint) = (Costmap::new(info, 0), Footprint::circle(0.2));
//! # let (is_circular, tracks_unknown, inflation) = (true, true, None);
//! let costmap = CostmapView { costs: &costs, footprint: &footprint, is_circular, tracks_unknown, inflation };
//! # let (pose, velocity, goal) = (Pose2::IDENTITY, Twist2::ZERO, plan[2]);
//! # let (time_ns, tolerance, is_position_reached) = (0, GoalTolerance::default(), false);
//! let input =
//!     ControlInput { time_ns, pose, velocity, costmap, plan: &plan, goal, tolerance, is_position_reached };
//! assert_eq!(controller.compute_velocity(&input)?, Twist2::new(0.5, 0.0, 0.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A cycle of a controller server is: [`PathHandler::local_plan`], [`GoalChecker::check`], [`ProgressChecker::check`],
//! [`Controller::compute_velocity`]. When there is no velocity, the error names the reason, with the cell of the costmap
//! if it is one ([`ControlReport::blocked`]). Parameters that cannot work together are reported by [`consistency`].
//!
//! Source of the rules: `nav2_controller` and the packages of the controllers (humble, jazzy, main 2026-08), and
//! `ros-planning/navigation` (noetic), reimplemented; `Nav2Release` selects the release where they differ.

mod collision;
pub mod consistency;
mod controller;
pub mod dwb;
mod factory;
pub mod goal_checker;
pub mod graceful;
pub mod mppi;
mod parameters;
pub mod path;
mod path_handler;
mod progress_checker;
pub mod ros1;
mod rotation_shim;
pub mod rpp;
mod setup;

pub use collision::{BlockedCell, footprint_collision};
pub use controller::{
    ControlError, ControlInput, ControlReport, Controller, GoalTolerance, SamplingReport,
};
pub use factory::{
    controller_classes, create_controller, create_goal_checker, create_path_handler,
};
pub use goal_checker::{GoalChecker, GoalQuery, GoalStatus};
pub use parameters::{GivenParameters, ParameterChange, ParameterGroup, ParameterRefusal};
pub use path_handler::{FEASIBLE_PATH_HANDLER, FeasiblePathParams, PathHandler, PathRules};
pub use progress_checker::{
    POSE_PROGRESS_CHECKER, PoseProgressParams, ProgressChecker, ProgressFailure,
    SIMPLE_PROGRESS_CHECKER, SimpleProgressParams,
};
pub use rotation_shim::{ROTATION_SHIM, RotationShim, RotationShimParams};
pub use setup::PluginSetup;
