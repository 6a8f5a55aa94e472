//! Readers.

use crate::error::check;
use crate::participant::{Endpoint, Participant};
use crate::{Error, Guid, SampleIdentity, Vendor, ffi};

/// A received sample.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DdsSample {
    /// CDR with the four-byte encapsulation header, and up to three bytes of padding.
    pub bytes: Vec<u8>,
    /// Source time stamp since 1970 \[ns\].
    pub time_ns: i64,
    /// Identity of the sample; none if it was not received in a packet.
    pub source: Option<SampleIdentity>,
    /// DDS vendor of the sender.
    pub vendor: Vendor,
    /// Identity of the related request (Fast DDS).
    pub related: Option<SampleIdentity>,
}

/// Reader of a topic.
pub struct DataReader {
    endpoint: Endpoint,
    participant: Participant,
}

impl DataReader {
    pub(crate) fn new(endpoint: Endpoint, participant: Participant) -> Self {
        Self { endpoint, participant }
    }

    /// GUID of the reader.
    #[must_use]
    pub fn guid(&self) -> Guid {
        self.endpoint.guid
    }

    /// Takes the oldest sample.
    ///
    /// # Errors
    /// When memory is exhausted.
    pub fn take(&self) -> Result<Option<DdsSample>, Error> {
        loop {
            let mut taken = std::mem::MaybeUninit::<ffi::Sample>::zeroed();
            // SAFETY: the function writes one such structure.
            let code = unsafe { ffi::pp_take(self.endpoint.entity.0, taken.as_mut_ptr()) };
            if check(code, || "take a sample".to_owned())? == 0 {
                return Ok(None);
            }
            // SAFETY: all zeros is a valid value, and so is what the function wrote.
            let taken = unsafe { taken.assume_init() };
            // A sample without data reports that a writer left.
            if taken.is_data == 0 {
                continue;
            }
            let identity = |one: ffi::Identity| SampleIdentity {
                writer: Guid(one.guid),
                sequence: one.sequence,
            };
            return Ok(Some(DdsSample {
                // SAFETY: allocated for this sample, completely written, and owned by it.
                bytes: unsafe { ffi::buffer(taken.bytes, taken.size) },
                time_ns: taken.time_ns,
                source: (taken.has_writer != 0).then(|| identity(taken.writer)),
                vendor: Vendor(taken.vendor),
                related: (taken.has_related != 0).then(|| identity(taken.related)),
            }));
        }
    }

    /// Number of matched writers.
    #[must_use]
    pub fn writers(&self) -> usize {
        // SAFETY: a number.
        let count = unsafe { ffi::pp_matched(self.endpoint.entity.0, 0) };
        usize::try_from(count).unwrap_or(0)
    }

    /// Participant of the reader.
    #[must_use]
    pub fn participant(&self) -> &Participant {
        &self.participant
    }

    pub(crate) fn entity(&self) -> i32 {
        self.endpoint.entity.0
    }
}
