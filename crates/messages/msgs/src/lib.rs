//! ROS messages.
//!
//! One module for each package contains plain structs generated from the texts in `interfaces/`. Each is a
//! [`Message`] with a type name, type hash and schema text, and converts to and from CDR (the format of DDS
//! and bags), the format of ROS 1 and JSON:
//!
//! ```
//! use periplus_msgs::{Message, geometry_msgs::Twist};
//!
//! let mut twist = Twist::default();
//! twist.linear.x = 0.5;
//! let bytes = twist.to_cdr()?;
//! assert_eq!(bytes.len(), 4 + 48);
//! assert_eq!(Twist::decode_cdr(&bytes)?, twist);
//! assert_eq!(Twist::TYPE_NAME, "geometry_msgs/msg/Twist");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Types known only at run time are [`Layout`]s of a [`TypeRegistry`]; a [`DynamicMessage`] is a value of
//! such a type.

mod binary;
mod codec;
mod description;
mod dynamic;
mod error;
mod generated;
mod json;
mod macros;
mod message;
mod number;
mod releases;
mod time;
mod wire;
mod yaml;

pub use binary::{Encapsulation, Format, decode, encode, recode};
pub use codec::{Codec, WideString};
pub use dynamic::{
    Adaptation, DynamicMessage, Layout, Part, RecodeError, Recoding, TypeRegistry, Value,
};
pub use error::{DecodeError, EncodeError, Problem};
pub use generated::*;
pub use json::{from_json, to_json};
pub use message::{Action, Message, Service};
pub use number::{Number, NumberKind, NumberVec, Numbers, NumbersMut};
pub use releases::{Nav2Action, Nav2Service, ReleaseForm};
pub use wire::{Count, Sink, Source};
pub use yaml::YamlStyle;

#[doc(hidden)]
pub use codec::{plain, read_field, write_field};
