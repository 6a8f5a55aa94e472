//! The simulator plugins we know, their parameters, and what people get wrong about them.
//!
//! Three generations of plugins share the world: those of Gazebo Classic with ROS 1, with ROS 2,
//! and the systems of today's Gazebo. [`recognise`] tells which one a `<plugin>` means,
//! [`interpret`] reads its parameters, and [`lint`] says what would silently not work.

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
