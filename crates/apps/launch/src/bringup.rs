//! Execution of plans.
//!
//! [`LaunchRunner`] executes a [`crate::LaunchPlan`] step by step. Known ROS programs become built-in nodes on
//! one graph ([`table`] lists them); Gazebo becomes a [`periplus_sim::Simulation`] that the caller
//! creates from [`LaunchRunner::world`]. Users' own nodes in Python run in processes that
//! [`PythonInterpreter`] starts, in step with the simulation if there is a [`Lockstep`]. Other programs run
//! if the machine has them. Missing ones are reported, and the rest runs.

mod bridge;
mod catalogue;
mod environment;
mod guard;
mod includes;
mod lockstep;
mod make;
mod move_base;
mod navigation;
mod node_logs;
mod parameters;
mod parts;
mod preparation;
mod preview;
#[cfg(any(windows, test))]
mod process_tree;
mod processes;
mod python;
mod report;
mod runner;
mod tasks;
mod transform;
mod words;
mod world;
mod xacro;

pub use catalogue::table;
pub use environment::Environment;
pub use guard::{GUARD_VERB, guard};
pub use includes::{REPLACED_LAUNCH_FILES, has_replacement};
pub use lockstep::Lockstep;
pub use processes::LaunchProcesses;
pub use python::{
    INTERPRETER_VARIABLE, NoInterpreter, PythonInterpreter, PythonNode, is_built_in, is_python_file,
};
pub use report::{LaunchLog, PartOutcome, PartOutcomeKind, PartReport};
pub use runner::{LaunchRunner, Settings};
pub use world::WorldRequest;
pub use xacro::{Xacro, xacro};
