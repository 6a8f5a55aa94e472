//! The filter of [`periplus_ekf`] as a node on the graph.
//!
//! An [`EkfNode`] is what `ekf_node` of `robot_localization` is: it hears wheels, IMU, poses and
//! velocities on the topics of its parameters, and tells `odometry/filtered`, `accel/filtered` and the
//! transform from the world to the robot; where the world is the map, that from the map to odometry.
//!
//! Source of names and QoS: `robot_localization/src/ros_filter.cpp` (rolling, 2026).

mod inputs;
mod messages;
mod node;
mod outputs;

pub use node::EkfNode;
