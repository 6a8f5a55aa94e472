//! DDS, the protocol of ROS 2, by Eclipse Cyclone DDS (C, built in).
//!
//! Samples are opaque bytes. A [`Participant`] creates a [`DataWriter`] for outgoing and a [`DataReader`]
//! for incoming samples; [`Discovery`] reports remote participants and endpoints; a [`Waitset`]
//! lets a thread sleep until something happens.
//!
//! ```no_run
//! use periplus_cyclonedds_sys::{ParticipantConfig, Participant, DdsQos};
//!
//! let participant = Participant::open(&ParticipantConfig::default(), b"")?;
//! let writer =
//!     participant.writer("rt/chatter", "std_msgs::msg::dds_::String_", &DdsQos::default(), b"")?;
//! writer.write(vec![0, 1, 0, 0, 3, 0, 0, 0, b'h', b'i', 0], None)?;
//! # Ok::<(), periplus_cyclonedds_sys::Error>(())
//! ```
//!
//! C contains the code that depends on Cyclone's structures (`c/shim.c`, `c/blob.c`); the interface
//! is in `ffi.rs`. Cyclone's entities are numbers that it checks, so that a stale one is an error
//! and nothing worse.

#![allow(unsafe_code, reason = "calls of C; each states why it is sound")]

mod config;
mod discovery;
mod error;
mod ffi;
mod log;
mod participant;
mod qos;
mod reader;
mod waitset;
mod writer;

pub use config::{NetworkSelection, ParticipantConfig};
pub use discovery::{BuiltinTopic, Discovery, DiscoverySample};
pub use error::Error;
pub use log::{LogLine, take_log};
pub use participant::Participant;
pub use qos::{DdsDurability, DdsLiveliness, DdsQos};
pub use reader::{DataReader, DdsSample};
pub use waitset::{WaitToken, Waitset, Waker};
pub use writer::{Bytes, DataWriter};

/// GUID of a participant, writer or reader, unique in the network, in the byte order of the wire.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Guid(pub [u8; 16]);

impl std::fmt::Display for Guid {
    /// Formats the GUID as `ros2 topic info -v` does: pairs of digits separated by dots.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (place, byte) in self.0.iter().enumerate() {
            let dot = if place == 0 { "" } else { "." };
            write!(f, "{dot}{byte:02x}")?;
        }
        Ok(())
    }
}

impl Guid {
    /// GUID of its participant.
    #[must_use]
    pub fn participant(self) -> Self {
        let mut guid = self.0;
        guid[12..].copy_from_slice(&[0, 0, 1, 0xc1]);
        Self(guid)
    }
}

/// Identity of a sample: writer and sequence number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SampleIdentity {
    /// The writer.
    pub writer: Guid,
    /// The sequence number.
    pub sequence: i64,
}

/// DDS vendor id of a participant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Vendor(pub [u8; 2]);

impl Vendor {
    /// Eclipse Cyclone DDS.
    pub const CYCLONE: Self = Self([1, 0x10]);
    /// eProsima Fast DDS.
    pub const FAST: Self = Self([1, 0x0f]);
}
