//! Messages of the protocol as plain data, without state.

mod client;
mod server;

pub use client::{ClientBinary, ClientChannel, ClientText, Malformed, ParameterText, Subscription};
pub use server::{
    AssetAnswer, ChannelText, ConnectionGraph, Level, MismatchText, PartyText, PolicyText,
    ServiceText, advertise, advertise_services, asset, connection_graph, message_head, parameters,
    remove_status, repair_result, schema_of, server_info, service_answer, service_failure, status,
    time, unadvertise, unadvertise_services,
};

/// WebSocket subprotocols in order of preference: the name in the protocol's document, and that of
/// Foxglove's SDK, which is the same protocol.
pub const SUBPROTOCOLS: [&str; 2] = ["foxglove.websocket.v1", "foxglove.sdk.v1"];
