//! A world with its robots, run step by step.
//!
//! [`compose`] reads files, [`Simulation`] makes nodes of what is in them and steps them, [`Run`]
//! goes on until it is time, at the pace that is asked for. A [`Recorder`] writes what is published
//! into a bag, a [`Driver`] drives without a person, [`Services`] let others change the world.

mod compose;
mod drive;
mod files;
mod ground;
mod hear;
mod pace;
mod record;
mod run;
pub mod script;
mod services;
mod shares;
mod simulation;
mod slice;

pub use compose::{Composition, Member, Placement, Standing, compose, compose_plain};
pub use drive::{DriveError, Driver, ScriptFindings, VelocityTopic, velocity_topics};
pub use files::ShapeFiles;
pub use hear::hear;
pub use pace::Pace;
pub use periplus_physics::limits::STEP_RANGE_S;
pub use periplus_physics::{Diverged, PhysicsMode};
pub use periplus_sensors::Quirks;
pub use record::{RecordError, Recorder, Recording, Wanted};
pub use run::{Progress, Run, Tick};
pub use services::{
    Arrival, ArrivalFrom, Arrived, GazeboAnswer, GazeboDesk, GazeboOutlet, GazeboService,
    GazeboTopic, Search, Services, gazebo_topic,
};
pub use shares::{Shares, Work};
pub use simulation::{Options, Simulation};
