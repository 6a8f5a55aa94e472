//! Discovery messages of Gazebo Transport.

use super::Header;
use crate::message::{kinds, messages};

messages! {
    /// Announcement of a process or of its publishers and services.
    Discovery {
        1 header: Option<Header>,
        2 version: u32,
        3 process_uuid: String,
        4 r#type: DiscoveryKind,
        5 flags: Option<DiscoveryFlags>,
        6 sub: Option<DiscoverySubscriber>,
        7 r#pub: Option<DiscoveryPublisher>,
    }
    /// Relay flags.
    DiscoveryFlags = "Discovery.Flags" { 1 relay: bool, 2 no_relay: bool }
    /// Topic that a subscriber searches.
    DiscoverySubscriber = "Discovery.Subscriber" { 1 topic: String }
    /// Publisher of a topic or provider of a service.
    DiscoveryPublisher = "Discovery.Publisher" {
        1 topic: String,
        2 address: String,
        3 process_uuid: String,
        4 node_uuid: String,
        5 scope: DiscoveryScope,
        6 msg_pub: Option<MessagePublisher>,
        7 srv_pub: Option<ServicePublisher>,
    }
    /// Publisher of messages.
    MessagePublisher = "Discovery.Publisher.MessagePublisher" {
        1 ctrl: String,
        2 msg_type: String,
        3 throttled: bool,
        4 msgs_per_sec: u64,
    }
    /// Provider of a service.
    ServicePublisher = "Discovery.Publisher.ServicePublisher" {
        1 socket_id: String,
        2 request_type: String,
        3 response_type: String,
    }
}

kinds! {
    /// Type of a discovery message.
    DiscoveryKind {
        UNINITIALIZED = 0, ADVERTISE = 1, SUBSCRIBE = 2, UNADVERTISE = 3, HEARTBEAT = 4, BYE = 5,
        NEW_CONNECTION = 6, END_CONNECTION = 7, SUBSCRIBERS_REQ = 8, SUBSCRIBERS_REP = 9,
    }
    /// Scope of an announcement.
    DiscoveryScope { PROCESS = 0, HOST = 1, ALL = 2 }
}
