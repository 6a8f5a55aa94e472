//! Messages to clients.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use periplus_msgs::TypeRegistry;
use serde::Serialize;
use serde_json::{Value, json};

use crate::foxglove::frame::WebSocketFrame;

/// Capabilities beyond channels.
const CAPABILITIES: [&str; 7] = [
    "clientPublish",
    "parameters",
    "parametersSubscribe",
    "time",
    "services",
    "assets",
    "connectionGraph",
];

/// Capability of a server that sends the triangles of mesh files. Extension of Foxglove's protocol.
const MESHES: &str = "meshes";

/// Capability of a server with recordings. Extension of Foxglove's protocol.
const RECORDINGS: &str = "recordings";

/// Severity of a status message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatusLevel {
    /// Information.
    Info = 0,
    /// Something may be wrong.
    Warning = 1,
    /// A request failed.
    Error = 2,
}

/// An announced channel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ChannelText<'a> {
    /// Channel id.
    pub id: u32,
    /// The topic.
    pub topic: &'a str,
    /// Message encoding.
    pub encoding: &'static str,
    /// Message type.
    pub schema_name: &'a str,
    /// Definition of the type with all types that it refers to.
    pub schema: &'a str,
    /// Encoding of the schema.
    pub schema_encoding: &'static str,
}

/// An announced service.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceText<'a> {
    /// Service id.
    pub id: u32,
    /// Its name.
    pub name: &'a str,
    /// Its type.
    pub type_name: &'a str,
}

/// Definition of a message type with all types that it refers to; empty if unknown.
#[must_use]
pub fn schema_of(type_name: &str) -> &'static str {
    TypeRegistry::builtin().schema_text(type_name).unwrap_or_default()
}

fn text(value: &Value) -> WebSocketFrame {
    WebSocketFrame::text(value.to_string())
}

/// The first message: name and capabilities of the server.
#[must_use]
pub fn server_info(
    name: &str,
    session_id: &str,
    metadata: &BTreeMap<String, String>,
    has_recordings: bool,
) -> WebSocketFrame {
    let recordings = has_recordings.then_some(RECORDINGS);
    let capabilities: Vec<&str> =
        CAPABILITIES.into_iter().chain([MESHES]).chain(recordings).collect();
    text(&json!({
        "op": "serverInfo",
        "name": name,
        "capabilities": capabilities,
        "supportedEncodings": ["cdr"],
        "metadata": metadata,
        "sessionId": session_id,
    }))
}

/// A status message for the user. `id` allows removing it.
#[must_use]
pub fn status(level: StatusLevel, message: &str, id: Option<&str>) -> WebSocketFrame {
    let mut value = json!({"op": "status", "level": level as u8, "message": message});
    if let Some(id) = id {
        value["id"] = id.into();
    }
    text(&value)
}

/// Removes status messages.
#[must_use]
pub fn remove_status(ids: &[&str]) -> WebSocketFrame {
    text(&json!({"op": "removeStatus", "statusIds": ids}))
}

/// Announces channels.
#[must_use]
pub fn advertise(channels: &[ChannelText<'_>]) -> WebSocketFrame {
    text(&json!({"op": "advertise", "channels": channels}))
}

/// Removes channels.
#[must_use]
pub fn unadvertise(ids: &[u32]) -> WebSocketFrame {
    text(&json!({"op": "unadvertise", "channelIds": ids}))
}

/// Announces services, with request and response schemas in the current form and in that of old
/// clients.
#[must_use]
pub fn advertise_services(services: &[ServiceText<'_>]) -> WebSocketFrame {
    let one = |service: &ServiceText<'_>| {
        let side = |suffix: &str| {
            let name = format!("{}{suffix}", service.type_name);
            json!({
                "encoding": "cdr",
                "schemaName": name,
                "schemaEncoding": "ros2msg",
                "schema": schema_of(&name),
            })
        };
        let (request, response) = (side("_Request"), side("_Response"));
        json!({
            "id": service.id,
            "name": service.name,
            "type": service.type_name,
            "requestSchema": request["schema"],
            "responseSchema": response["schema"],
            "request": request,
            "response": response,
        })
    };
    let services: Vec<Value> = services.iter().map(one).collect();
    text(&json!({"op": "advertiseServices", "services": services}))
}

/// Removes services.
#[must_use]
pub fn unadvertise_services(ids: &[u32]) -> WebSocketFrame {
    text(&json!({"op": "unadvertiseServices", "serviceIds": ids}))
}

/// Parameter values: name, value, and the type where JSON is ambiguous.
#[must_use]
pub fn parameters(
    values: &[(String, Value, Option<&'static str>)],
    id: Option<&str>,
) -> WebSocketFrame {
    let one = |(name, value, kind): &(String, Value, Option<&'static str>)| {
        let mut one = json!({"name": name, "value": value});
        if let Some(kind) = kind {
            one["type"] = (*kind).into();
        }
        one
    };
    let values: Vec<Value> = values.iter().map(one).collect();
    let mut value = json!({"op": "parameterValues", "parameters": values});
    if let Some(id) = id {
        value["id"] = id.into();
    }
    text(&value)
}

/// Changes of the connection graph: publishers, subscribers and servers by topic or service.
#[derive(Clone, Copy, Debug)]
pub struct ConnectionGraph<'a> {
    /// Nodes that publish a topic.
    pub published: &'a BTreeMap<String, BTreeSet<String>>,
    /// Nodes that subscribe to a topic.
    pub subscribed: &'a BTreeMap<String, BTreeSet<String>>,
    /// Nodes that serve a service.
    pub served: &'a BTreeMap<String, BTreeSet<String>>,
    /// Removed topics.
    pub gone_topics: &'a [String],
    /// Removed services.
    pub gone_services: &'a [String],
    /// All incompatible pairs, if they have changed. Extension of Foxglove's protocol.
    pub mismatches: Option<&'a Vec<MismatchText>>,
}

/// Two endpoints of a topic with incompatible QoS.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MismatchText {
    /// The topic.
    pub topic: String,
    /// The publisher.
    pub publisher: PartyText,
    /// The subscription.
    pub subscription: PartyText,
    /// Policies in which the offer is too weak.
    pub policies: Vec<PolicyText>,
    /// Endpoint that can be repaired here: `publisher` or `subscription`.
    pub repair: Option<&'static str>,
    /// The change to make, as text.
    pub advice: String,
}

/// A node with an incompatible endpoint.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PartyText {
    /// Full name.
    pub node: String,
    /// True if it is part of this program.
    pub is_ours: bool,
}

/// A policy in which an offer is too weak, in the spelling of ROS.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PolicyText {
    /// The policy.
    pub policy: String,
    /// The offered value.
    pub offered: String,
    /// The requested value.
    pub asked: String,
}

/// Encodes the connection graph.
#[must_use]
pub fn connection_graph(graph: &ConnectionGraph<'_>) -> WebSocketFrame {
    let list = |map: &BTreeMap<String, BTreeSet<String>>, key: &str| -> Vec<Value> {
        map.iter().map(|(name, ids)| json!({"name": name, key: ids})).collect()
    };
    let mut value = json!({
        "op": "connectionGraphUpdate",
        "publishedTopics": list(graph.published, "publisherIds"),
        "subscribedTopics": list(graph.subscribed, "subscriberIds"),
        "advertisedServices": list(graph.served, "providerIds"),
        "removedTopics": graph.gone_topics,
        "removedServices": graph.gone_services,
    });
    if let Some(mismatches) = graph.mismatches {
        value["mismatches"] = json!(mismatches);
    }
    text(&value)
}

/// Reason for which endpoints with incompatible QoS were not repaired.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum QosRepairError {
    /// The endpoints are compatible, or one of them was removed.
    Compatible {
        /// Topic.
        topic: String,
        /// Node of the publisher.
        publisher: String,
        /// Node of the subscription.
        subscription: String,
    },
    /// Neither endpoint is part of this program; with advice.
    Foreign(String),
}

impl fmt::Display for QosRepairError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Compatible { topic, publisher, subscription } => write!(
                f,
                "`{publisher}` and `{subscription}` are compatible on `{topic}`, or one of them was \
                 removed"
            ),
            Self::Foreign(advice) => write!(f, "neither end is part of this program: {advice}"),
        }
    }
}

impl std::error::Error for QosRepairError {}

/// Result of [`ClientText::RepairQos`](super::ClientText::RepairQos), sent to the requesting client
/// only. Extension of Foxglove's protocol.
#[must_use]
pub fn repair_result(id: u32, outcome: &Result<String, QosRepairError>) -> WebSocketFrame {
    let is_repaired = outcome.is_ok();
    let message = match outcome {
        Ok(message) => message.clone(),
        Err(error) => error.to_string(),
    };
    text(&json!({
        "op": "repairQosResult", "id": id, "isRepaired": is_repaired, "message": message,
    }))
}

/// Definition of a type, null if it is unknown, and the names of types that were requested. Extension of
/// Foxglove's protocol.
#[must_use]
pub fn schema(
    request_id: u32,
    schema_name: &str,
    schema: Option<&str>,
    names: &[&str],
) -> WebSocketFrame {
    text(&json!({
        "op": "schema", "requestId": request_id, "schemaName": schema_name, "schema": schema,
        "names": names,
    }))
}

/// Header of a message on a channel: subscription id and time of publication.
#[must_use]
pub fn message_head(subscription_id: u32, time_ns: i64) -> Vec<u8> {
    let mut head = Vec::with_capacity(13);
    head.push(1);
    head.extend(subscription_id.to_le_bytes());
    head.extend(u64::try_from(time_ns).unwrap_or(0).to_le_bytes());
    head
}

/// The time.
#[must_use]
pub fn time(time_ns: i64) -> WebSocketFrame {
    let mut bytes = vec![2];
    bytes.extend(u64::try_from(time_ns).unwrap_or(0).to_le_bytes());
    WebSocketFrame::binary(bytes)
}

/// Response of a service.
#[must_use]
pub fn service_answer(service_id: u32, call_id: u32, cdr: &[u8]) -> WebSocketFrame {
    const ENCODING: &[u8] = b"cdr";
    let mut bytes = Vec::with_capacity(16 + cdr.len());
    bytes.push(3);
    bytes.extend(service_id.to_le_bytes());
    bytes.extend(call_id.to_le_bytes());
    bytes.extend((ENCODING.len() as u32).to_le_bytes());
    bytes.extend(ENCODING);
    bytes.extend(cdr);
    WebSocketFrame::binary(bytes)
}

/// Failure of a service call, with the reason.
#[must_use]
pub fn service_failure(service_id: u32, call_id: u32, why: &str) -> WebSocketFrame {
    text(&json!({
        "op": "serviceCallFailure", "serviceId": service_id, "callId": call_id, "message": why,
    }))
}

/// Reason for which a file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AssetError {
    reason: String,
}

impl From<String> for AssetError {
    fn from(reason: String) -> Self {
        Self { reason }
    }
}

impl From<&str> for AssetError {
    fn from(reason: &str) -> Self {
        Self { reason: reason.to_owned() }
    }
}

impl fmt::Display for AssetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for AssetError {}

/// A file, or the reason for which it cannot be read.
pub type AssetAnswer = Result<Vec<u8>, AssetError>;

/// Encodes a file or the reason of failure.
#[must_use]
pub fn asset(request_id: u32, answer: &AssetAnswer) -> WebSocketFrame {
    let (status, why, data) = match answer {
        Ok(data) => (0, "", data.as_slice()),
        Err(error) => (1, error.reason.as_str(), &[][..]),
    };
    let mut bytes = Vec::with_capacity(10 + why.len() + data.len());
    bytes.push(4);
    bytes.extend(request_id.to_le_bytes());
    bytes.push(status);
    bytes.extend(u32::try_from(why.len()).unwrap_or(0).to_le_bytes());
    bytes.extend(why.as_bytes());
    bytes.extend(data);
    WebSocketFrame::binary(bytes)
}
