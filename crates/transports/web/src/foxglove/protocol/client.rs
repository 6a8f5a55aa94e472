//! What clients say.

use std::fmt;

use serde::Deserialize;
use serde_json::Value;

/// A client's message in JSON.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "op", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum ClientText {
    /// It wants to hear channels.
    Subscribe {
        /// Which, and under which numbers of its own.
        subscriptions: Vec<Subscription>,
    },
    /// It no longer wants to.
    Unsubscribe {
        /// Its own numbers.
        subscription_ids: Vec<u32>,
    },
    /// It is going to publish.
    Advertise {
        /// Where.
        channels: Vec<ClientChannel>,
    },
    /// It no longer publishes.
    Unadvertise {
        /// Its own numbers of the channels.
        channel_ids: Vec<u32>,
    },
    /// It asks for values of parameters.
    GetParameters {
        /// Of which; all if there are none.
        parameter_names: Vec<String>,
        /// What the answer is to be called.
        #[serde(default)]
        id: Option<String>,
    },
    /// It sets parameters.
    SetParameters {
        /// To what.
        parameters: Vec<ParameterText>,
        /// What the answer is to be called; without it none is wanted.
        #[serde(default)]
        id: Option<String>,
    },
    /// It wants to hear of changes of parameters.
    SubscribeParameterUpdates {
        /// Of which; of all if there are none.
        parameter_names: Vec<String>,
    },
    /// It no longer wants to.
    UnsubscribeParameterUpdates {
        /// Of which.
        parameter_names: Vec<String>,
    },
    /// It wants to know who publishes, subscribes and serves what.
    SubscribeConnectionGraph,
    /// It no longer wants to.
    UnsubscribeConnectionGraph,
    /// It wants two ends to be made to fit, by making that of this program anew. Not part of
    /// Foxglove's protocol.
    RepairQos {
        /// What the answer is to be called.
        id: u32,
        /// The topic.
        topic: String,
        /// Full name of the node that publishes.
        publisher: String,
        /// Full name of the node that subscribes.
        subscription: String,
    },
    /// It wants a file.
    FetchAsset {
        /// Where it is.
        uri: String,
        /// What the answer is to be called.
        request_id: u32,
    },
}

/// A channel that a client wants to hear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Subscription {
    /// The client's own number for it.
    pub id: u32,
    /// The server's number of the channel.
    pub channel_id: u32,
}

/// A channel that a client publishes.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ClientChannel {
    /// The client's own number for it.
    pub id: u32,
    /// The topic.
    pub topic: String,
    /// How messages are coded.
    pub encoding: String,
    /// The type of messages.
    pub schema_name: String,
}

/// A parameter and its value.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct ParameterText {
    /// Its name.
    pub name: String,
    /// Its value; none deletes it.
    #[serde(default)]
    pub value: Option<Value>,
    /// What JSON cannot tell: `byte_array`, `float64`, `float64_array`.
    #[serde(default, rename = "type")]
    pub kind: Option<String>,
}

/// A client's message in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClientBinary<'a> {
    /// A message on a channel of its own.
    Message {
        /// Its own number of the channel.
        channel_id: u32,
        /// The message.
        payload: &'a [u8],
    },
    /// A call of a service.
    Call {
        /// The server's number of the service.
        service_id: u32,
        /// What the answer is to be called.
        call_id: u32,
        /// How the question is coded.
        encoding: &'a str,
        /// The question.
        payload: &'a [u8],
    },
}

/// A message that is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Malformed(pub String);

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Malformed {}

impl ClientText {
    /// Reads a message.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(text: &str) -> Result<Self, Malformed> {
        serde_json::from_str(text).map_err(|error| Malformed(format!("a message is none: {error}")))
    }
}

impl<'a> ClientBinary<'a> {
    /// Reads a message.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(bytes: &'a [u8]) -> Result<Self, Malformed> {
        let short = || Malformed("a message in bytes ends too early".to_owned());
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
                    .map_err(|_| Malformed("the name of an encoding is no text".to_owned()))?;
                Ok(Self::Call { service_id, call_id, encoding, payload })
            }
            _ => Err(Malformed(format!(
                "nothing is known of messages in bytes that begin with {op}"
            ))),
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
        let subscriptions = vec![Subscription { id: 1, channel_id: 2 }];
        assert_eq!(read, Ok(ClientText::Subscribe { subscriptions }));
        let read = ClientText::read(r#"{"op":"subscribeConnectionGraph"}"#);
        assert_eq!(read, Ok(ClientText::SubscribeConnectionGraph));
        let read = ClientText::read(r#"{"op":"fetchAsset","uri":"package://a/b","requestId":7}"#);
        assert_eq!(read, Ok(ClientText::FetchAsset { uri: "package://a/b".into(), request_id: 7 }));
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
        let mut call = vec![2, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0];
        call.extend(b"cdr\x01");
        let expected =
            ClientBinary::Call { service_id: 1, call_id: 2, encoding: "cdr", payload: &[1] };
        assert_eq!(ClientBinary::read(&call), Ok(expected));
    }
}
