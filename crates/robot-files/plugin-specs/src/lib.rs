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

pub use context::{PluginContext, PluginParent, PluginSite, model_sites, sites, world_sites};
pub use interpret::{InterpretedPlugin, interpret};
pub use known::{Family, PluginSpec, PluginTopic, Role, Support, TopicDirection};
pub use library::library_id;
pub use lint::lint;
pub use recognise::recognise;
pub use ros::{QosPolicies, Remapping, RosParameter, RosSettings, TopicQos};
pub use tables::known;
pub use topics::{ResolvedTopic, topics};

#[cfg(test)]
mod fixture;
