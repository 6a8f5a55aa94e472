//! Devices of a simulated robot as nodes on the graph.
//!
//! Each sensor and each plugin becomes a [`Device`]: it reads commands from topics, commands joints,
//! measures, and publishes. The computations are in `physics` and `sensors`; this crate defines node
//! names, topics, rates and messages.
//!
//! ```
//! use periplus_diagnostics::{Diagnostics, Origin};
//! use periplus_graph::Graph;
//! use periplus_scene::{Element, Plugin, World};
//! use periplus_sim_nodes::world_devices;
//!
//! let topic = |name| {
//!     let element = Element::new(name).with_attribute("type", "gz.msgs.Empty");
//!     element.with_attribute("topic", format!("/{name}"))
//! };
//! let (name, filename) = ("start".into(), "gz-sim-triggered-publisher-system".into());
//! let content = vec![topic("input"), topic("output")];
//! let mut world = World::empty("room");
//! world.plugins.push(Plugin { name, filename, content, origin: Origin::default() });
//! let devices = world_devices(&Graph::new(), &world, &[], &mut Diagnostics::new());
//! assert_eq!(devices.len(), 1);
//! ```

mod build;
mod buildings;
mod control;
mod device;
mod device_context;
pub mod drives;
mod fleet_path;
mod naming;
mod sensors;
pub mod states;
mod views;

pub use build::{devices, world_devices};
pub use buildings::{BuildingFloor, floors_of};
pub use control::{NoParameterFiles, ParameterFiles};
pub use device::{Device, DeviceState, SenseContext, SensorMount, StepInterval};
pub use device_context::DeviceContext;
pub use fleet_path::{FleetPathError, fleet_path_from, fleet_point_distance_m};
pub use naming::{device_node, gz_topic, plugin_node, publisher_qos, subscription_qos};
pub use views::{FigureId, SceneRef, Views, ViewsState};
