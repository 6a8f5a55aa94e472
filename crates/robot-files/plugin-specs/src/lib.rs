//! Known simulator plugins, their parameters, and checks for common mistakes.
//!
//! Plugins come from three generations: Gazebo Classic with ROS 1, Gazebo Classic with ROS 2, and systems
//! of current Gazebo. [`recognise`] identifies a `<plugin>`, [`interpret`] reads its parameters, and
//! [`lint`] reports settings that would silently have no effect.

mod context;
mod interpret;
mod known;
mod library;
mod lint;
mod recognise;
mod renamed;
mod ros;
mod tables;
mod topics;

pub use context::{Context, Place, Site, model_sites, sites, world_sites};
pub use interpret::{Interpreted, interpret};
pub use known::{Family, Flow, Known, Role, Support, Topic};
pub use library::library_id;
pub use lint::lint;
pub use recognise::recognise;
pub use ros::{Qos, Remapping, RosParameter, RosSettings, TopicQos};
pub use tables::known;
pub use topics::{Resolved, topics};

#[cfg(test)]
mod fixture;
