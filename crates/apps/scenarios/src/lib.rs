//! Scenarios: a world, a robot, nodes, events, faults and assertions in a YAML file.
//!
//! [`Scenario::read`] reads a file and reports mistakes with their positions; [`run()`] runs it in lockstep, in one
//! process and without a wall clock, so that the same scenario gives the same [`ScenarioReport`] in every run. The
//! declarations in [`tables`] are also the JSON schema ([`json_schema`]) and the documentation
//! ([`reference_markdown`]).
//!
//! ```yaml
//! world: worlds/house.sdf
//! robot: {file: robot.urdf.xacro, pose: [0, 0, 0]}
//! nodes: [slam, navigation]
//! timeout: 60
//! events:
//!   - goal: [3, 0, 0]
//!   - {at: 5, fault: {dropout: {topic: /scan, probability: 0.5, until: 3}}}
//! assertions:
//!   - reached: {within: 0.3}
//!   - no_collision
//!   - rate: {topic: /scan, hz: 10}
//! ```

mod artifacts;
mod checks;
mod error;
mod file;
mod junit;
mod reference;
mod report;
mod run;
mod schema;
mod summary;
pub mod tables;
mod variables;

pub use error::ScenarioError;
pub use file::{
    EventAction, EventTrigger, Scenario, ScenarioAssertion, ScenarioEvent, ScenarioFileError,
    ScenarioFolders, ScenarioNodes, ScenarioRobot, below_root,
};
pub use junit::junit_xml;
pub use reference::reference_markdown;
pub use report::{AssertionReport, GoalEnd, RunOutcome, ScenarioReport};
pub use run::{ScenarioInspection, ScenarioRunOptions, inspect, run};
pub use schema::json_schema;
pub use summary::github_summary;
pub use variables::Variables;
