//! Messages of the protocol as plain data, without state.

mod client;
mod recordings;
mod server;

pub use client::{
    ChannelSubscription, ClientBinary, ClientChannel, ClientText, Malformed, ParameterText,
};
pub use recordings::{
    MarkText, OriginText, RecordingText, ReplayRequest, StoredMessages, TimeNs, TopicNeed,
    TopicText, UploadFile,
};
pub(crate) use recordings::{
    density, difference, fetch_failure, file_head, file_part, job_parameters, marks, recordings,
    report, series, upload_progress, upload_started,
};
pub use server::{
    AssetAnswer, AssetError, ChannelText, ConnectionGraph, MismatchText, PartyText, PolicyText,
    QosRepairError, ServiceText, StatusLevel, advertise, advertise_services, asset,
    connection_graph, message_head, parameters, remove_status, repair_result, schema, schema_of,
    server_info, service_answer, service_failure, status, time, unadvertise, unadvertise_services,
};

/// WebSocket subprotocols in order of preference: the name in the protocol's document, and that of
/// Foxglove's SDK, which is the same protocol.
pub const SUBPROTOCOLS: [&str; 2] = ["foxglove.websocket.v1", "foxglove.sdk.v1"];
