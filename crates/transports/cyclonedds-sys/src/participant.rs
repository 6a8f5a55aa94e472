//! Participants.

use std::ffi::CString;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use crate::discovery::{BuiltinTopic, Discovery};
use crate::error::check;
use crate::reader::DataReader;
use crate::waitset::Waitset;
use crate::writer::DataWriter;
use crate::{DdsQos, Error, Guid, ParticipantConfig, ffi};

/// An entity of Cyclone, deleted when this is dropped.
pub(crate) struct Entity(pub(crate) i32);

impl Drop for Entity {
    fn drop(&mut self) {
        // SAFETY: a number; a stale one is rejected.
        let _ = unsafe { ffi::pp_delete(self.0) };
    }
}

/// A participant of a domain with its own sockets and threads: two participants of one program
/// communicate over the network, as those of two programs do. This is a handle: clones refer to the
/// same participant, and everything created from it keeps it alive.
#[derive(Clone)]
pub struct Participant(pub(crate) Arc<Core>);

pub(crate) struct Core {
    pub(crate) entity: i32,
    guid: Guid,
    /// Deleted with the participant.
    _domain: Entity,
}

impl Participant {
    /// Joins a domain. `user_data` is visible to other participants.
    ///
    /// # Errors
    /// When there is no such network, no free port, or the configuration is invalid.
    pub fn open(config: &ParticipantConfig, user_data: &[u8]) -> Result<Self, Error> {
        // Domain ids are unique within a process in Cyclone; the id on the wire is part of the
        // configuration.
        static NEXT: AtomicU32 = AtomicU32::new(1);
        ffi::init();
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let what = || format!("join domain {}", config.domain_id);
        // SAFETY: the function only reads.
        let has_network = unsafe { ffi::pp_has_network() } != 0;
        let xml = text(&config.xml(has_network), what)?;
        // SAFETY: a live string.
        let domain = Entity(check(unsafe { ffi::pp_domain(number, xml.as_ptr()) }, what)?);
        // SAFETY: live bytes of this size.
        let code = unsafe { ffi::pp_participant(number, user_data.as_ptr(), user_data.len()) };
        let entity = check(code, what)?;
        Ok(Self(Arc::new(Core { entity, guid: guid(entity)?, _domain: domain })))
    }

    /// GUID of the participant.
    #[must_use]
    pub fn guid(&self) -> Guid {
        self.0.guid
    }

    /// Creates a writer.
    ///
    /// # Errors
    /// When a name is not valid or the QoS is inconsistent.
    pub fn writer(
        &self,
        topic: &str,
        type_name: &str,
        qos: &DdsQos,
        user_data: &[u8],
    ) -> Result<DataWriter, Error> {
        let made = self.endpoint(topic, type_name, qos, user_data, ffi::pp_writer)?;
        Ok(DataWriter::new(made, self.clone()))
    }

    /// Creates a reader.
    ///
    /// # Errors
    /// As [`Participant::writer`].
    pub fn reader(
        &self,
        topic: &str,
        type_name: &str,
        qos: &DdsQos,
        user_data: &[u8],
    ) -> Result<DataReader, Error> {
        let made = self.endpoint(topic, type_name, qos, user_data, ffi::pp_reader)?;
        Ok(DataReader::new(made, self.clone()))
    }

    fn endpoint(
        &self,
        topic: &str,
        type_name: &str,
        qos: &DdsQos,
        user_data: &[u8],
        make: unsafe extern "C" fn(i32, i32, *const ffi::Qos, *const u8, usize) -> i32,
    ) -> Result<Endpoint, Error> {
        let what = || format!("create an endpoint of the topic `{topic}` of type `{type_name}`");
        let (name, type_name) = (text(topic, what)?, text(type_name, what)?);
        // SAFETY: live strings.
        let code = unsafe { ffi::pp_topic(self.0.entity, name.as_ptr(), type_name.as_ptr()) };
        let topic = Entity(check(code, what)?);
        let qos = qos.to_ffi();
        let (data, size) = (user_data.as_ptr(), user_data.len());
        // SAFETY: live data of these sizes.
        let code = unsafe { make(self.0.entity, topic.0, &raw const qos, data, size) };
        let entity = Entity(check(code, what)?);
        Ok(Endpoint { guid: guid(entity.0)?, entity, _topic: topic })
    }

    /// Creates a reader of discovery.
    ///
    /// # Errors
    /// When memory is exhausted.
    pub fn discovery(&self, kind: BuiltinTopic) -> Result<Discovery, Error> {
        Discovery::new(self.clone(), kind)
    }

    /// Creates a waitset.
    ///
    /// # Errors
    /// When memory is exhausted.
    pub fn waitset(&self) -> Result<Waitset, Error> {
        Waitset::new(self.clone())
    }
}

/// A writer or reader, dropped before its topic.
pub(crate) struct Endpoint {
    pub(crate) guid: Guid,
    pub(crate) entity: Entity,
    _topic: Entity,
}

fn guid(entity: i32) -> Result<Guid, Error> {
    let mut guid = Guid::default();
    // SAFETY: the function writes sixteen bytes.
    let code = unsafe { ffi::pp_guid(entity, guid.0.as_mut_ptr()) };
    check(code, || "get the GUID of an entity".to_owned())?;
    Ok(guid)
}

fn text(text: &str, what: impl FnOnce() -> String) -> Result<CString, Error> {
    CString::new(text).map_err(|_| Error::new(what(), "a text has a zero byte"))
}
