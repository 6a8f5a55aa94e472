//! Taking.

use crate::error::check;
use crate::participant::{Endpoint, Participant};
use crate::{Error, Guid, Identity, Vendor, ffi};

/// What arrived.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sample {
    /// CDR with the four bytes in front, and up to three behind that mean nothing.
    pub bytes: Vec<u8>,
    /// When it was written, as the writer says, since 1970 \[ns\].
    pub time_ns: i64,
    /// Who wrote it, and its number there; none if it did not come in a packet.
    pub source: Option<Identity>,
    /// Who made the DDS that sent it.
    pub vendor: Vendor,
    /// The sample that it answers, as Fast DDS says.
    pub related: Option<Identity>,
}

/// Takes samples of one topic.
pub struct Reader {
    endpoint: Endpoint,
    participant: Participant,
}

impl Reader {
    pub(crate) fn new(endpoint: Endpoint, participant: Participant) -> Self {
        Self { endpoint, participant }
    }

    /// Its name in the network.
    #[must_use]
    pub fn guid(&self) -> Guid {
        self.endpoint.guid
    }

    /// The oldest sample that waits.
    ///
    /// # Errors
    /// When memory is short.
    pub fn take(&self) -> Result<Option<Sample>, Error> {
        loop {
            let mut taken = std::mem::MaybeUninit::<ffi::Sample>::zeroed();
            // SAFETY: it writes one such structure.
            let code = unsafe { ffi::pp_take(self.endpoint.entity.0, taken.as_mut_ptr()) };
            if check(code, || "to take a sample".to_owned())? == 0 {
                return Ok(None);
            }
            // SAFETY: all zeros is a value of it, and so is what was written.
            let taken = unsafe { taken.assume_init() };
            // What is no data tells that a writer went.
            if taken.is_data == 0 {
                continue;
            }
            let identity =
                |one: ffi::Identity| Identity { writer: Guid(one.guid), sequence: one.sequence };
            return Ok(Some(Sample {
                // SAFETY: made for it, filled, and given away.
                bytes: unsafe { ffi::buffer(taken.bytes, taken.size) },
                time_ns: taken.time_ns,
                source: (taken.has_writer != 0).then(|| identity(taken.writer)),
                vendor: Vendor(taken.vendor),
                related: (taken.has_related != 0).then(|| identity(taken.related)),
            }));
        }
    }

    /// How many writers are matched now.
    #[must_use]
    pub fn writers(&self) -> usize {
        // SAFETY: a number.
        let count = unsafe { ffi::pp_matched(self.endpoint.entity.0, 0) };
        usize::try_from(count).unwrap_or(0)
    }

    /// Whose it is.
    #[must_use]
    pub fn participant(&self) -> &Participant {
        &self.participant
    }

    pub(crate) fn entity(&self) -> i32 {
        self.endpoint.entity.0
    }
}
