//! Who else is there.

use std::ffi::{CStr, c_char};

use crate::error::check;
use crate::participant::{Entity, Participant};
use crate::{Error, Guid, Qos, Vendor, ffi};

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Participants.
    Participants,
    /// Writers.
    Writers,
    /// Readers.
    Readers,
}

/// One that came, changed or went. Own ones are told too.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// Its name in the network.
    pub guid: Guid,
    /// Whose it is.
    pub participant: Guid,
    /// Whether it is there; of one that went only the names are known.
    pub is_alive: bool,
    /// Who made its DDS.
    pub vendor: Vendor,
    /// The topic; empty for participants.
    pub topic: String,
    /// Its type; empty for participants.
    pub type_name: String,
    /// What it offers or asks for.
    pub qos: Qos,
    /// What it says of itself.
    pub user_data: Vec<u8>,
}

/// Tells who else is there.
pub struct Discovery {
    reader: Entity,
    kind: Kind,
    _participant: Participant,
}

impl Discovery {
    pub(crate) fn new(participant: Participant, kind: Kind) -> Result<Self, Error> {
        // SAFETY: numbers.
        let code = unsafe { ffi::pp_discovery(participant.0.entity, kind as i32) };
        let reader = Entity(check(code, || "to look for others".to_owned())?);
        Ok(Self { reader, kind, _participant: participant })
    }

    /// The next that came, changed or went.
    ///
    /// # Errors
    /// When memory is short.
    pub fn take(&self) -> Result<Option<Found>, Error> {
        let mut found = std::mem::MaybeUninit::<ffi::Found>::zeroed();
        let reader = self.reader.0;
        // SAFETY: it writes one such structure.
        let code = unsafe { ffi::pp_discovery_take(reader, self.kind as i32, found.as_mut_ptr()) };
        if check(code, || "to look for others".to_owned())? == 0 {
            return Ok(None);
        }
        // SAFETY: all zeros is a value of it, and so is what was written.
        let mut found = unsafe { found.assume_init() };
        let user_data = if found.user_data.is_null() {
            Vec::new()
        } else {
            // SAFETY: so many bytes stand there until they are given back.
            unsafe { std::slice::from_raw_parts(found.user_data, found.user_data_size) }.to_vec()
        };
        let told = Found {
            guid: Guid(found.guid),
            participant: Guid(found.participant),
            is_alive: found.is_alive != 0,
            vendor: Vendor(found.vendor),
            // SAFETY: strings until they are given back.
            topic: unsafe { text(found.topic) },
            // SAFETY: as above.
            type_name: unsafe { text(found.type_name) },
            qos: Qos::from_ffi(&found.qos),
            user_data,
        };
        // SAFETY: what was taken, once.
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
    // SAFETY: as the caller says.
    unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
}
