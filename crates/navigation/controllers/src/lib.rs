//! Path-following controllers with the behaviour of Nav2, and the checkers of goal and progress.
//!
//! A [`Controller`] gets the robot's pose, velocity, local costmap and plan as arguments and returns a velocity;
//! it has no clock and no inputs. [`create_controller`] creates one from the name of its class and its parameters. A
//! cycle of a controller server is: [`PathHandler::local_plan`], [`GoalChecker::check`], [`ProgressChecker::check`],
//! [`Controller::compute_velocity`].

mod collision;
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
