//! The parts of a simulated robot as nodes on the graph.
//!
//! Each sensor and each plugin that does something becomes a [`Device`]: it reads commands from
//! topics, tells joints what to do, measures, and publishes. What it computes is in `dynamics` and
//! `sensors`; here is only who is told, under which name, how often, in which message.

mod build;
mod device;
pub mod drives;
mod naming;
mod sensors;
mod setting;
pub mod states;
mod views;

pub use build::{devices, world_devices};
pub use device::{Device, Moment, SensorMount, Span};
pub use naming::{gz_topic, node_of, plain_node, publisher_qos, subscription_qos};
pub use setting::Setting;
pub use views::Views;
