//! Messages from clients.

use std::fmt;

use serde::Deserialize;
use serde_json::Value;

use super::recordings::ReplayRequest;

/// A JSON message from a client.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "op", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum ClientText {
    /// Subscribes to channels.
    Subscribe {
        /// Channels with the client's subscription ids.
        subscriptions: Vec<ChannelSubscription>,
    },
    /// Ends subscriptions.
    Unsubscribe {
        /// Subscription ids.
        subscription_ids: Vec<u32>,
    },
    /// Advertises client channels.
    Advertise {
        /// Channels.
        channels: Vec<ClientChannel>,
    },
    /// Ends client channels.
    Unadvertise {
        /// Channel ids of the client.
        channel_ids: Vec<u32>,
    },
    /// Requests parameter values.
    GetParameters {
        /// Names; empty for all.
        parameter_names: Vec<String>,
        /// Id of the response.
        #[serde(default)]
        id: Option<String>,
    },
    /// Sets parameters.
    SetParameters {
        /// New values.
        parameters: Vec<ParameterText>,
        /// Id of the response; none for no response.
        #[serde(default)]
        id: Option<String>,
    },
    /// Subscribes to parameter updates.
    SubscribeParameterUpdates {
        /// Names; empty for all.
        parameter_names: Vec<String>,
    },
    /// Ends the subscription to parameter updates.
    UnsubscribeParameterUpdates {
        /// Names.
        parameter_names: Vec<String>,
    },
    /// Subscribes to the connection graph.
    SubscribeConnectionGraph,
    /// Ends the subscription to the connection graph.
    UnsubscribeConnectionGraph,
    /// Makes an incompatible pair compatible by changing the local endpoint. Extension of
    /// Foxglove's protocol.
    RepairQos {
        /// Id of the response.
        id: u32,
        /// Name of the topic.
        topic: String,
        /// Full name of the publishing node.
        publisher: String,
        /// Full name of the subscribing node.
        subscription: String,
    },
    /// Requests a file.
    FetchAsset {
        /// URI of the file.
        uri: String,
        /// Id of the response.
        request_id: u32,
    },
    /// Requests the triangles of a mesh file. Extension of Foxglove's protocol.
    FetchMesh {
        /// URI of the file.
        uri: String,
        /// Id of the response.
        request_id: u32,
    },
    /// Requests the definition of a message type, or the names of all types. Extension of Foxglove's
    /// protocol.
    FetchSchema {
        /// Id of the response.
        request_id: u32,
        /// Full name of the type; empty for the names.
        schema_name: String,
    },
    /// A request about recordings. Extension of Foxglove's protocol.
    #[serde(skip)]
    Recording(ReplayRequest),
}

/// A subscription to a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ChannelSubscription {
    /// Subscription id of the client.
    pub id: u32,
    /// Channel id of the server.
    pub channel_id: u32,
}

/// A channel that a client publishes.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ClientChannel {
    /// Channel id of the client.
    pub id: u32,
    /// Topic.
    pub topic: String,
    /// Message encoding.
    pub encoding: String,
    /// Message type.
    pub schema_name: String,
    /// True to keep the last message for late subscribers. Extension of Foxglove's protocol.
    #[serde(default)]
    pub is_latched: bool,
}

/// A parameter with its value.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct ParameterText {
    /// Its name.
    pub name: String,
    /// Value; none deletes the parameter.
    #[serde(default)]
    pub value: Option<Value>,
    /// Type where JSON is ambiguous: `byte_array`, `float64`, `float64_array`.
    #[serde(default, rename = "type")]
    pub kind: Option<String>,
}

/// A binary message from a client.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClientBinary<'a> {
    /// A message on a client channel.
    Message {
        /// Channel id of the client.
        channel_id: u32,
        /// The message.
        payload: &'a [u8],
    },
    /// A service call.
    Call {
        /// Service id of the server.
        service_id: u32,
        /// Id of the response.
        call_id: u32,
        /// Encoding of the request.
        encoding: &'a str,
        /// The request.
        payload: &'a [u8],
    },
    /// Bytes of an upload. Extension of Foxglove's protocol.
    Upload {
        /// Upload.
        upload: u32,
        /// The next bytes of its files.
        bytes: &'a [u8],
    },
}

/// Opcode of bytes of an upload.
const UPLOAD: u8 = 0x11;

/// A malformed message, with the cause.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Malformed(pub String);

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Malformed {}

impl ClientText {
    /// Parses a message.
    ///
    /// # Errors
    /// The cause, when the message is malformed.
    pub fn read(text: &str) -> Result<Self, Malformed> {
        /// The opcode of any message.
        #[derive(Deserialize)]
        struct Opcode {
            op: String,
        }
        let malformed =
            |error: serde_json::Error| Malformed(format!("a message is malformed: {error}"));
        let Opcode { op } = serde_json::from_str(text).map_err(malformed)?;
        if ReplayRequest::OPS.contains(&op.as_str()) {
            return serde_json::from_str(text).map(Self::Recording).map_err(malformed);
        }
        serde_json::from_str(text).map_err(malformed)
    }
}

impl<'a> ClientBinary<'a> {
    /// Parses a message.
    ///
    /// # Errors
    /// The cause, when the message is malformed.
    pub fn read(bytes: &'a [u8]) -> Result<Self, Malformed> {
        let short = || Malformed("a binary message is too short".to_owned());
        let (op, mut rest) = bytes.split_first().ok_or_else(short)?;
        let mut number = || {
            let (four, after) = rest.split_first_chunk::<4>()?;
            rest = after;
            Some(u32::from_le_bytes(*four))
        };
        match op {
            1 => {
                let channel_id = number().ok_or_else(short)?;
                Ok(Self::Message { channel_id, payload: rest })
            }
            2 => {
                let service_id = number().ok_or_else(short)?;
                let call_id = number().ok_or_else(short)?;
                let length = number().ok_or_else(short)? as usize;
                let (encoding, payload) = rest.split_at_checked(length).ok_or_else(short)?;
                let encoding = std::str::from_utf8(encoding)
                    .map_err(|_| Malformed("the name of an encoding is not UTF-8".to_owned()))?;
                Ok(Self::Call { service_id, call_id, encoding, payload })
            }
            &UPLOAD => {
                let upload = number().ok_or_else(short)?;
                Ok(Self::Upload { upload, bytes: rest })
            }
            _ => Err(Malformed(format!("unknown opcode {op} of a binary message"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_clients_say_is_read() {
        let read =
            ClientText::read(r#"{"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]}"#);
        let subscriptions = vec![ChannelSubscription { id: 1, channel_id: 2 }];
        assert_eq!(read, Ok(ClientText::Subscribe { subscriptions }));
        let read = ClientText::read(r#"{"op":"subscribeConnectionGraph"}"#);
        assert_eq!(read, Ok(ClientText::SubscribeConnectionGraph));
        let read = ClientText::read(r#"{"op":"fetchMarks","requestId":3,"recording":1}"#);
        let marks = ReplayRequest::FetchMarks { request_id: 3, recording: 1 };
        assert_eq!(read, Ok(ClientText::Recording(marks)));
        let read = ClientText::read(r#"{"op":"fetchAsset","uri":"package://a/b","requestId":7}"#);
        assert_eq!(read, Ok(ClientText::FetchAsset { uri: "package://a/b".into(), request_id: 7 }));
        let read = ClientText::read(r#"{"op":"fetchMesh","uri":"package://a/b","requestId":8}"#);
        assert_eq!(read, Ok(ClientText::FetchMesh { uri: "package://a/b".into(), request_id: 8 }));
    }

    #[test]
    fn what_is_nothing_is_said_to_be_nothing() {
        for text in ["", "{}", "[1]", r#"{"op":"dance"}"#, r#"{"op":"subscribe"}"#] {
            assert!(ClientText::read(text).is_err(), "{text}");
        }
        for bytes in
            [&[][..], &[1, 0, 0], &[3], &[2, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 1]]
        {
            assert!(ClientBinary::read(bytes).is_err(), "{bytes:?}");
        }
    }

    #[test]
    fn bytes_are_taken_apart() {
        let read = ClientBinary::read(&[1, 5, 0, 0, 0, 9, 9]);
        assert_eq!(read, Ok(ClientBinary::Message { channel_id: 5, payload: &[9, 9] }));
        let read = ClientBinary::read(&[0x11, 5, 0, 0, 0, 9]);
        assert_eq!(read, Ok(ClientBinary::Upload { upload: 5, bytes: &[9] }));
        let mut call = vec![2, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0];
        call.extend(b"cdr\x01");
        let expected =
            ClientBinary::Call { service_id: 1, call_id: 2, encoding: "cdr", payload: &[1] };
        assert_eq!(ClientBinary::read(&call), Ok(expected));
    }
}
