//! Known simulator plugins, their parameters, and checks for common mistakes.
//!
//! Plugins come from three generations: Gazebo Classic with ROS 1, Gazebo Classic with ROS 2, and systems
//! of current Gazebo. [`recognise`] identifies a `<plugin>`, [`interpret`] reads its parameters, and
//! [`lint`] reports settings that would silently have no effect.
//!
//! ```
//! use periplus_diagnostics::Diagnostics;
//! use periplus_plugin_specs::{Family, PluginContext, interpret};
//! use periplus_scene::{Element, Origin, Plugin};
//!
//! let plugin = Plugin {
//!     name: "drive".into(),
//!     filename: "libgazebo_ros_diff_drive.so".into(),
//!     content: vec![Element::new("wheel_separation").with_text("0.4")],
//!     origin: Origin::default(),
//! };
//! let drive = interpret(&plugin, &PluginContext::NOWHERE, &mut Diagnostics::new());
//! let drive = drive.expect("a known plugin");
//! assert_eq!(drive.known.family, Family::ClassicRos2);
//! assert_eq!(drive.values.number("wheel_separation"), Some(0.4));
//! ```

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
