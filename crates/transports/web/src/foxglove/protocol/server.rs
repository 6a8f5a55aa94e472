//! What servers say.

use std::collections::{BTreeMap, BTreeSet};

use periplus_msgs::TypeRegistry;
use serde::Serialize;
use serde_json::{Value, json};

use crate::foxglove::frame::Frame;

/// What is done here beyond channels.
const CAPABILITIES: [&str; 7] = [
    "clientPublish",
    "parameters",
    "parametersSubscribe",
    "time",
    "services",
    "assets",
    "connectionGraph",
];

/// How bad something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// It is not.
    Info = 0,
    /// Something may not be as wanted.
    Warning = 1,
    /// Something was not done.
    Error = 2,
}

/// A channel, as it is announced.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ChannelText<'a> {
    /// Its number.
    pub id: u32,
    /// The topic.
    pub topic: &'a str,
    /// How messages are coded.
    pub encoding: &'static str,
    /// The type of messages.
    pub schema_name: &'a str,
    /// The text of the type, with all that it refers to.
    pub schema: &'a str,
    /// Which kind of text that is.
    pub schema_encoding: &'static str,
}

/// A service, as it is announced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceText<'a> {
    /// Its number.
    pub id: u32,
    /// Its name.
    pub name: &'a str,
    /// Its type.
    pub type_name: &'a str,
}

/// The text of a message's type with all that it refers to; empty where it is not known.
#[must_use]
pub fn schema_of(type_name: &str) -> &'static str {
    TypeRegistry::builtin().schema_text(type_name).unwrap_or_default()
}

fn text(value: &Value) -> Frame {
    Frame::text(value.to_string())
}

/// The first message: who speaks.
#[must_use]
pub fn server_info(name: &str, session_id: &str, metadata: &BTreeMap<String, String>) -> Frame {
    text(&json!({
        "op": "serverInfo",
        "name": name,
        "capabilities": CAPABILITIES,
        "supportedEncodings": ["cdr"],
        "metadata": metadata,
        "sessionId": session_id,
    }))
}

/// Something for a person to read. `id` names it, to be taken back.
#[must_use]
pub fn status(level: Level, message: &str, id: Option<&str>) -> Frame {
    let mut value = json!({"op": "status", "level": level as u8, "message": message});
    if let Some(id) = id {
        value["id"] = id.into();
    }
    text(&value)
}

/// That something which was said no longer holds.
#[must_use]
pub fn remove_status(ids: &[&str]) -> Frame {
    text(&json!({"op": "removeStatus", "statusIds": ids}))
}

/// New channels.
#[must_use]
pub fn advertise(channels: &[ChannelText<'_>]) -> Frame {
    text(&json!({"op": "advertise", "channels": channels}))
}

/// Channels that are gone.
#[must_use]
pub fn unadvertise(ids: &[u32]) -> Frame {
    text(&json!({"op": "unadvertise", "channelIds": ids}))
}

/// New services. The texts of questions and answers come in the form of today and in that of old
/// clients.
#[must_use]
pub fn advertise_services(services: &[ServiceText<'_>]) -> Frame {
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

/// Services that are gone.
#[must_use]
pub fn unadvertise_services(ids: &[u32]) -> Frame {
    text(&json!({"op": "unadvertiseServices", "serviceIds": ids}))
}

/// Values of parameters: name, value, and what JSON cannot tell of its type.
#[must_use]
pub fn parameters(values: &[(String, Value, Option<&'static str>)], id: Option<&str>) -> Frame {
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

/// Who publishes, subscribes and serves, by name of the topic or service: what is new or other, and
/// what is gone.
#[derive(Clone, Copy, Debug)]
pub struct ConnectionGraph<'a> {
    /// Nodes that publish a topic.
    pub published: &'a BTreeMap<String, BTreeSet<String>>,
    /// Nodes that subscribe to a topic.
    pub subscribed: &'a BTreeMap<String, BTreeSet<String>>,
    /// Nodes that answer a service.
    pub served: &'a BTreeMap<String, BTreeSet<String>>,
    /// Topics that are gone.
    pub gone_topics: &'a [String],
    /// Services that are gone.
    pub gone_services: &'a [String],
    /// All ends that do not fit, where they are others than before. Not part of Foxglove's protocol.
    pub mismatches: Option<&'a Vec<MismatchText>>,
}

/// Two ends of a topic between which nothing flows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MismatchText {
    /// The topic.
    pub topic: String,
    /// Who publishes.
    pub publisher: PartyText,
    /// Who subscribes.
    pub subscription: PartyText,
    /// Where the offer is too weak.
    pub policies: Vec<PolicyText>,
    /// Which end can be made anew here: `publisher` or `subscription`.
    pub repair: Option<&'static str>,
    /// What to change, in words.
    pub advice: String,
}

/// A node with an end that does not fit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PartyText {
    /// Its full name.
    pub node: String,
    /// Whether it is part of this program.
    pub is_ours: bool,
}

/// A policy in which an offer is too weak, as ROS spells it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PolicyText {
    /// Which.
    pub policy: String,
    /// What the publisher offers.
    pub offered: String,
    /// What the subscription asks for.
    pub asked: String,
}

/// Who publishes, subscribes and serves.
#[must_use]
pub fn connection_graph(graph: &ConnectionGraph<'_>) -> Frame {
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

/// What became of the wish that two ends be made to fit. Not part of Foxglove's protocol; only who
/// wishes hears it.
#[must_use]
pub fn repair_result(id: u32, outcome: &Result<String, String>) -> Frame {
    let (Ok(message) | Err(message)) = outcome;
    let is_repaired = outcome.is_ok();
    text(&json!({
        "op": "repairQosResult", "id": id, "isRepaired": is_repaired, "message": message,
    }))
}

/// What stands before a message of a channel: to which subscription, and when it was published.
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
pub fn time(time_ns: i64) -> Frame {
    let mut bytes = vec![2];
    bytes.extend(u64::try_from(time_ns).unwrap_or(0).to_le_bytes());
    Frame::binary(bytes)
}

/// The answer of a service.
#[must_use]
pub fn service_answer(service_id: u32, call_id: u32, cdr: &[u8]) -> Frame {
    const ENCODING: &[u8] = b"cdr";
    let mut bytes = Vec::with_capacity(16 + cdr.len());
    bytes.push(3);
    bytes.extend(service_id.to_le_bytes());
    bytes.extend(call_id.to_le_bytes());
    bytes.extend((ENCODING.len() as u32).to_le_bytes());
    bytes.extend(ENCODING);
    bytes.extend(cdr);
    Frame::binary(bytes)
}

/// That a call has no answer, and why.
#[must_use]
pub fn service_failure(service_id: u32, call_id: u32, why: &str) -> Frame {
    text(&json!({
        "op": "serviceCallFailure", "serviceId": service_id, "callId": call_id, "message": why,
    }))
}

/// What became of a wish for a file.
pub type AssetAnswer = Result<Vec<u8>, String>;

/// A file, or why there is none.
#[must_use]
pub fn asset(request_id: u32, answer: &AssetAnswer) -> Frame {
    let (status, why, data) = match answer {
        Ok(data) => (0, "", data.as_slice()),
        Err(why) => (1, why.as_str(), &[][..]),
    };
    let mut bytes = Vec::with_capacity(10 + why.len() + data.len());
    bytes.push(4);
    bytes.extend(request_id.to_le_bytes());
    bytes.push(status);
    bytes.extend(u32::try_from(why.len()).unwrap_or(0).to_le_bytes());
    bytes.extend(why.as_bytes());
    bytes.extend(data);
    Frame::binary(bytes)
}
