//! `service_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/service_msgs`
//! instead.

crate::message! {
    /// What happened to a call of a service.
    "service_msgs/msg/ServiceEventInfo" "RIHS01_41bcbbe07a75c9b52bc96bfd5c24d7f0fc0a08c0cb7921b3373c5732345a6f45"
    ServiceEventInfo {
        /// event_type
        event_type: u8,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
        /// client_gid
        client_gid: [u8; 16],
        /// sequence_number
        sequence_number: i64,
    }
    /// REQUEST_SENT
    REQUEST_SENT: u8 = 0;
    /// REQUEST_RECEIVED
    REQUEST_RECEIVED: u8 = 1;
    /// RESPONSE_SENT
    RESPONSE_SENT: u8 = 2;
    /// RESPONSE_RECEIVED
    RESPONSE_RECEIVED: u8 = 3;
}
