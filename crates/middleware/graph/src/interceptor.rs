//! Interceptors of messages between a publisher and its subscribers.

use std::sync::Arc;

use periplus_msgs::{DecodeError, EncodeError, Message};

use crate::info::TopicInfo;
use crate::payload::Payload;
use crate::publisher_core::PublisherCore;
use crate::sample::EndpointId;

/// Decides what becomes of published messages, as a faulty driver or network does: it forwards, changes, delays,
/// repeats or drops them. Recorders and transports receive what is forwarded, as subscribers do.
pub trait Interceptor: Send + Sync {
    /// Returns true to intercept this topic. Called whenever the endpoints of the topic change; it must not call the
    /// graph.
    fn wants(&self, topic: &TopicInfo) -> bool;

    /// Takes a message. A message that is dropped here reaches no subscriber. Called by the publishing thread.
    fn intercept(&self, message: InterceptedMessage);
}

/// A published message that no subscriber has received yet. Clones share its content.
#[derive(Clone)]
pub struct InterceptedMessage {
    pub(crate) publisher: Arc<PublisherCore>,
    pub(crate) info: Arc<TopicInfo>,
    pub(crate) payload: Arc<Payload>,
}

impl InterceptedMessage {
    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.publisher.topic.name
    }

    /// Name of the type, such as `sensor_msgs/msg/LaserScan`.
    #[must_use]
    pub fn type_name(&self) -> &str {
        &self.info.type_name
    }

    /// The publisher.
    #[must_use]
    pub fn publisher(&self) -> EndpointId {
        self.publisher.id
    }

    /// Returns the message as a value.
    ///
    /// # Errors
    /// When the bytes of a transport or a bag cannot be decoded as this type.
    pub fn message<T: Message>(&self) -> Result<Arc<T>, DecodeError> {
        self.payload.message()
    }

    /// Returns the message as CDR, with the four-byte encapsulation header.
    ///
    /// # Errors
    /// When a string or list is longer than its type allows.
    pub fn cdr(&self) -> Result<&[u8], EncodeError> {
        self.payload.cdr()
    }

    /// Returns the same message with another content of its type.
    #[must_use]
    pub fn with_message<T: Message>(&self, message: T) -> Self {
        Self { payload: Arc::new(Payload::typed(Arc::new(message))), ..self.clone() }
    }

    /// Returns the same message with another content as CDR, with the four-byte encapsulation header.
    #[must_use]
    pub fn with_cdr(&self, cdr: Vec<u8>) -> Self {
        Self { payload: Arc::new(Payload::raw(cdr)), ..self.clone() }
    }

    /// Delivers the message to all subscribers now; a second call delivers it twice. The time of publication is the
    /// present time of the graph.
    pub fn forward(&self) {
        self.publisher.send(self.payload.clone());
    }
}

impl std::fmt::Debug for InterceptedMessage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("InterceptedMessage")
            .field("topic", &self.topic())
            .field("type_name", &self.type_name())
            .finish_non_exhaustive()
    }
}
