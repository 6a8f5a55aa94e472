//! Devices of a simulated robot as nodes on the graph.
//!
//! Each sensor and each plugin becomes a [`Device`]: it reads commands from topics, commands joints,
//! measures, and publishes. The computations are in `physics` and `sensors`; this crate defines node
//! names, topics, rates and messages.

mod build;
mod device;
mod device_context;
pub mod drives;
mod naming;
mod sensors;
pub mod states;
mod views;

pub use build::{devices, world_devices};
pub use device::{Device, SenseContext, SensorMount, StepInterval};
pub use device_context::DeviceContext;
pub use naming::{device_node, gz_topic, plugin_node, publisher_qos, subscription_qos};
pub use views::Views;
