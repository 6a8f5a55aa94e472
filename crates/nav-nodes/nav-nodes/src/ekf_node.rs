//! Node of the extended Kalman filter in [`periplus_ekf`].
//!
//! An [`EkfNode`] is the `ekf_node` of `robot_localization`: it subscribes to odometry, IMU, poses
//! and velocities on the topics of its parameters, and publishes `odometry/filtered`,
//! `accel/filtered` and the transform from the world frame to the base frame; with the map as world
//! frame, the transform from map to odom.
//!
//! Source of names and QoS: `robot_localization/src/ros_filter.cpp` (rolling, 2026).

mod inputs;
mod messages;
mod node;
mod outputs;

pub use node::EkfNode;
