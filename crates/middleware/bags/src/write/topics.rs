//! Topics of a file and their types.

use std::collections::BTreeMap;

use periplus_msgs::Message;

use super::WriteError;
use crate::record::{Channel, Schema};
use crate::{BagTopic, QosProfile, Style, TopicInformation, qos};

/// A topic to record.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topic {
    /// Full name, such as `/scan`.
    pub name: String,
    /// Full type name, such as `sensor_msgs/msg/LaserScan`.
    pub type_name: String,
    /// Schema of the type, in `ros2msg` encoding.
    pub schema_text: String,
    /// Type hash; may be empty.
    pub type_hash: String,
    /// QoS offered by each of its publishers.
    pub qos: Vec<QosProfile>,
}

impl Topic {
    /// A topic of a known type.
    #[must_use]
    pub fn of<T: Message>(name: impl Into<String>, qos: &[QosProfile]) -> Self {
        Self {
            name: name.into(),
            type_name: T::TYPE_NAME.into(),
            schema_text: T::schema_text().into(),
            type_hash: T::TYPE_HASH.into(),
            qos: qos.to_vec(),
        }
    }
}

/// Id of a topic of a [`super::Writer`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TopicId(u16);

/// Channel and sequence number of a message.
pub(super) struct Counted {
    pub(super) id: u16,
    pub(super) sequence: u32,
}

#[derive(Debug, Default)]
pub(super) struct Topics {
    pub(super) schemas: Vec<Schema>,
    pub(super) channels: Vec<Channel>,
    pub(super) infos: Vec<TopicInformation>,
    by_name: BTreeMap<(String, String), u16>,
}

impl Topics {
    pub(super) fn add(
        &mut self,
        topic: Topic,
        style: Style,
        preamble: &mut Vec<u8>,
    ) -> Result<TopicId, WriteError> {
        for text in [&topic.name, &topic.type_name, &topic.schema_text, &topic.type_hash] {
            if u32::try_from(text.len()).is_err() {
                return Err(WriteError::TooLong("a name or type".into()));
            }
        }
        let info = TopicInformation {
            name: topic.name,
            type_name: topic.type_name,
            type_hash: topic.type_hash,
            encoding: "cdr".into(),
            qos: topic.qos,
            messages: 0,
        };
        let metadata = BTreeMap::from([
            ("offered_qos_profiles".to_owned(), info.qos_text(style)),
            ("topic_type_hash".to_owned(), info.type_hash.clone()),
        ]);
        self.insert(info, "ros2msg", topic.schema_text.into_bytes(), metadata, preamble)
    }

    /// Adds a topic of another file, in any encoding.
    pub(super) fn copy(
        &mut self,
        topic: &BagTopic,
        preamble: &mut Vec<u8>,
    ) -> Result<TopicId, WriteError> {
        let about = |key: &str| topic.metadata.get(key).map_or("", String::as_str);
        let info = TopicInformation {
            name: topic.name.clone(),
            type_name: topic.type_name.clone(),
            type_hash: about("topic_type_hash").into(),
            encoding: topic.encoding.clone(),
            qos: qos::from_text(about("offered_qos_profiles")),
            messages: 0,
        };
        let metadata = topic.metadata.clone();
        self.insert(info, &topic.schema_encoding, topic.schema.clone(), metadata, preamble)
    }

    fn insert(
        &mut self,
        info: TopicInformation,
        schema_encoding: &str,
        data: Vec<u8>,
        metadata: BTreeMap<String, String>,
        preamble: &mut Vec<u8>,
    ) -> Result<TopicId, WriteError> {
        let key = (info.name.clone(), info.type_name.clone());
        if let Some(&id) = self.by_name.get(&key) {
            return Ok(TopicId(id));
        }
        // Schema id 0 is reserved; channel ids start at 1 as well, as in rosbag2.
        let number = |count: usize| u16::try_from(count + 1).map_err(|_| WriteError::TooManyTopics);
        let id = number(self.channels.len())?;
        let schema = self
            .schemas
            .iter()
            .find(|schema| schema.name == info.type_name && schema.data == data)
            .map(|schema| schema.id);
        let schema = if let Some(schema) = schema {
            schema
        } else {
            let id = number(self.schemas.len())?;
            let encoding = schema_encoding.to_owned();
            let schema = Schema { id, name: info.type_name.clone(), encoding, data };
            schema.put(preamble);
            self.schemas.push(schema);
            id
        };
        let (topic, encoding) = (info.name.clone(), info.encoding.clone());
        let channel = Channel { id, schema, topic, encoding, metadata };
        channel.put(preamble);
        self.channels.push(channel);
        self.infos.push(info);
        self.by_name.insert(key, id);
        Ok(TopicId(id))
    }

    /// Counts a message.
    pub(super) fn count(&mut self, topic: TopicId) -> Result<Counted, WriteError> {
        let info = usize::from(topic.0).checked_sub(1).and_then(|index| self.infos.get_mut(index));
        let info = info.ok_or(WriteError::UnknownTopic)?;
        info.messages += 1;
        #[expect(clippy::cast_possible_truncation, reason = "sequence numbers wrap around")]
        let sequence = info.messages as u32;
        Ok(Counted { id: topic.0, sequence })
    }
}
