//! Discovery of participants and endpoints.

use std::ffi::{CStr, c_char};

use crate::error::check;
use crate::participant::{Entity, Participant};
use crate::{DdsQos, Error, Guid, Vendor, ffi};

/// Kind of entities to discover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltinTopic {
    /// Participants.
    Participants,
    /// Writers.
    Writers,
    /// Readers.
    Readers,
}

/// A discovery sample: an entity appeared, changed or disappeared. Own entities are included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiscoverySample {
    /// GUID of the entity.
    pub guid: Guid,
    /// GUID of its participant.
    pub participant: Guid,
    /// False if it disappeared; then only the GUIDs are known.
    pub is_alive: bool,
    /// DDS vendor.
    pub vendor: Vendor,
    /// Topic name; empty for participants.
    pub topic: String,
    /// Type name; empty for participants.
    pub type_name: String,
    /// QoS offered or requested.
    pub qos: DdsQos,
    /// Its `USER_DATA`.
    pub user_data: Vec<u8>,
}

/// Reader of the discovery topics of DDS.
pub struct Discovery {
    reader: Entity,
    kind: BuiltinTopic,
    _participant: Participant,
}

impl Discovery {
    pub(crate) fn new(participant: Participant, kind: BuiltinTopic) -> Result<Self, Error> {
        // SAFETY: the arguments are numbers.
        let code = unsafe { ffi::pp_discovery(participant.0.entity, kind as i32) };
        let reader = Entity(check(code, || "create a discovery reader".to_owned())?);
        Ok(Self { reader, kind, _participant: participant })
    }

    /// Returns the next discovery sample.
    ///
    /// # Errors
    /// When memory is exhausted.
    pub fn take(&self) -> Result<Option<DiscoverySample>, Error> {
        let mut found = std::mem::MaybeUninit::<ffi::Found>::zeroed();
        let reader = self.reader.0;
        // SAFETY: the function writes one such structure.
        let code = unsafe { ffi::pp_discovery_take(reader, self.kind as i32, found.as_mut_ptr()) };
        if check(code, || "take a discovery sample".to_owned())? == 0 {
            return Ok(None);
        }
        // SAFETY: all zeros is a valid value, and so is what the function wrote.
        let mut found = unsafe { found.assume_init() };
        let user_data = if found.user_data.is_null() {
            Vec::new()
        } else {
            // SAFETY: the bytes are valid until the sample is returned.
            unsafe { std::slice::from_raw_parts(found.user_data, found.user_data_size) }.to_vec()
        };
        let told = DiscoverySample {
            guid: Guid(found.guid),
            participant: Guid(found.participant),
            is_alive: found.is_alive != 0,
            vendor: Vendor(found.vendor),
            // SAFETY: the string is valid until the sample is returned.
            topic: unsafe { text(found.topic) },
            // SAFETY: as above.
            type_name: unsafe { text(found.type_name) },
            qos: DdsQos::from_ffi(&found.qos),
            user_data,
        };
        // SAFETY: returns the taken sample, once.
        unsafe { ffi::pp_discovery_return(reader, &raw mut found) };
        Ok(Some(told))
    }

    pub(crate) fn entity(&self) -> i32 {
        self.reader.0
    }
}

/// # Safety
/// `text` is null or a string that ends with a zero.
unsafe fn text(text: *const c_char) -> String {
    if text.is_null() {
        return String::new();
    }
    // SAFETY: guaranteed by the caller.
    unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
}
