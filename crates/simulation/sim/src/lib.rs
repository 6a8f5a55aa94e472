//! Step-by-step simulation of a world with its robots.
//!
//! [`compose`] reads files, [`Simulation`] creates nodes for their contents and steps them, [`Run`]
//! runs them at a real-time factor. A [`SimulationRecorder`] writes published messages to a bag, a [`Driver`]
//! plays velocity commands, [`Services`] let clients change the world.

mod compose;
mod compute_topics;
mod default_world;
mod drive;
mod files;
mod pace;
mod profile;
mod record;
mod run;
pub mod script;
mod services;
mod simulation;
mod truth_map;

pub use compose::{
    Composition, ModelInstance, PlacementPose, RobotPlacement, compose, compose_plain,
};
pub use compute_topics::compute_topics;
pub use drive::{DriveError, Driver, ScriptFindings, VelocityTopic, velocity_topics};
pub use files::AssetFiles;
pub use pace::RealTimePacer;
pub use periplus_physics::limits::STEP_RANGE_S;
pub use periplus_physics::{Diverged, PhysicsMode};
pub use periplus_sensors::Quirks;
pub use profile::{Work, WorkProfile};
pub use record::{RecordError, RecordingSummary, SimulationRecorder, TopicFilter};
pub use run::{Run, RunProgress, Tick};
pub use services::{
    GazeboAnswer, GazeboPublisher, GazeboRequestQueue, GazeboService, GazeboTopic, InsertionResult,
    InsertionSource, ModelInsertion, Search, Services, SpawnError, gazebo_topic,
};
pub use simulation::{Options, Simulation};
