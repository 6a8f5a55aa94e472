//! Messages of Gazebo Transport.
//!
//! Each message is a plain struct that converts to and from protobuf ([`Message`]) and to and from protobuf
//! text, the format of `gz topic -e` and `gz topic -p`. [`AsRos`] converts to and from ROS messages by the
//! rules of `ros_gz_bridge`; [`each_pair`] lists all pairs of types.
//!
//! ```
//! use periplus_gz_msgs::{AsRos, Message, Twist, Vector3d};
//! use periplus_msgs::geometry_msgs;
//!
//! let twist = Twist { linear: Some(Vector3d::new(0.5, 0.0, 0.0)), ..Twist::default() };
//! let bytes = twist.encode();
//! assert_eq!(Twist::decode(&bytes)?, twist);
//! let ros: Option<geometry_msgs::Twist> = twist.to_ros();
//! assert_eq!(ros.map(|twist| twist.linear.x), Some(0.5));
//! assert_eq!(twist.text(), "linear {\n  x: 0.5\n}\n");
//! # Ok::<(), periplus_gz_msgs::DecodeError>(())
//! ```
//!
//! Names and numbers of fields are those of `gz-msgs` 10 (Harmonic). They are the same in all releases,
//! except in `IMU`: see [`ImuFortress`].

mod field;
mod message;
mod messages;
mod names;
mod protobuf;
mod ros;
mod text;

pub use message::Message;
pub use messages::*;
pub use names::{Dialect, bare_name};
pub use protobuf::DecodeError;
pub use ros::{AsRos, Pairs, each_pair};
pub use text::{TextError, text_of};
