//! Nodes of `nav2_collision_monitor`: the monitor, which reduces velocity commands near obstacles, and
//! the detector, which only reports zones with points.
//!
//! The monitor works on each command. An enabled source whose data is older than its timeout stops the
//! robot (not in Humble). Two things differ from Nav2: a range sensor that sees nothing
//! (a reading beyond its maximum) is a valid source without points, and transforms are not waited for:
//! the newest one is used if it is not older than `transform_tolerance`.
//!
//! Source: `collision_monitor_node.cpp`, `collision_detector_node.cpp`, `source.cpp` and its kinds
//! (humble to main).

mod config;
mod detector;
mod exclusions;
mod markers;
mod monitor;
mod perception;
mod sources;
mod zones;

pub use config::{MonitorConfig, MonitorSourceConfig, MonitorZoneConfig};
pub use detector::CollisionDetectorNode;
pub use monitor::CollisionMonitorNode;
