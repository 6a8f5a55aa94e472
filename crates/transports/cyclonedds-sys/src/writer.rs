//! Writers.

use std::ffi::c_void;
use std::sync::{Mutex, PoisonError};

use crate::error::check;
use crate::participant::{Endpoint, Participant};
use crate::{Error, Guid, SampleIdentity, ffi};

/// Owner of the bytes of a sample. They are sent without a copy, now and for retransmission.
pub trait Bytes: Send + Sync + 'static {
    /// The bytes: CDR with the four-byte encapsulation header.
    fn bytes(&self) -> &[u8];
}

impl Bytes for Vec<u8> {
    fn bytes(&self) -> &[u8] {
        self
    }
}

/// Writer of a topic.
pub struct DataWriter {
    endpoint: Endpoint,
    writing: Mutex<()>,
    participant: Participant,
}

impl DataWriter {
    pub(crate) fn new(endpoint: Endpoint, participant: Participant) -> Self {
        Self { endpoint, writing: Mutex::default(), participant }
    }

    /// GUID of the writer.
    #[must_use]
    pub fn guid(&self) -> Guid {
        self.endpoint.guid
    }

    /// Writes a sample and returns its sequence number. `related` is the identity of the request
    /// that it answers, used by Fast DDS only. A reliable writer blocks on slow readers according
    /// to its QoS.
    ///
    /// # Errors
    /// When the blocking time has passed, or the bytes are not a sample.
    pub fn write(&self, bytes: impl Bytes, related: Option<SampleIdentity>) -> Result<i64, Error> {
        self.put(bytes, related, true)
    }

    /// Writes a sample as [`DataWriter::write`], without blocking on slow readers.
    ///
    /// # Errors
    /// When there is no buffer space, which is a timeout; otherwise as [`DataWriter::write`].
    pub fn write_at_once(&self, bytes: impl Bytes) -> Result<i64, Error> {
        self.put(bytes, None, false)
    }

    /// Writes a sample for the readers of one participant and returns its sequence number; none if
    /// that participant has no matched reader. Other readers do not get it.
    ///
    /// # Errors
    /// As [`DataWriter::write`].
    pub fn write_to(
        &self,
        participant: Guid,
        bytes: impl Bytes,
        related: Option<SampleIdentity>,
    ) -> Result<Option<i64>, Error> {
        let prefix = participant.0;
        self.hand_over(bytes, related, |bytes, size, owner, related, sequence| {
            // SAFETY: the bytes live as long as their owner, which C owns from here on; the GUID is
            // longer than the prefix that is read.
            unsafe {
                ffi::pp_send_to(
                    self.endpoint.entity.0,
                    bytes,
                    size,
                    owner,
                    related,
                    prefix.as_ptr(),
                    sequence,
                )
            }
        })
        .map(|(is_sent, sequence)| (is_sent != 0).then_some(sequence))
    }

    /// True if a reader of that participant is matched.
    #[must_use]
    pub fn reaches(&self, participant: Guid) -> bool {
        // SAFETY: a number, and a GUID that is longer than the prefix that is read.
        unsafe { ffi::pp_reaches(self.endpoint.entity.0, participant.0.as_ptr()) > 0 }
    }

    fn put(
        &self,
        bytes: impl Bytes,
        related: Option<SampleIdentity>,
        waits: bool,
    ) -> Result<i64, Error> {
        self.hand_over(bytes, related, |bytes, size, owner, related, sequence| {
            // SAFETY: the bytes live as long as their owner, which C owns from here on.
            unsafe {
                ffi::pp_write(
                    self.endpoint.entity.0,
                    bytes,
                    size,
                    owner,
                    related,
                    waits.into(),
                    sequence,
                )
            }
        })
        .map(|(_, sequence)| sequence)
    }

    /// Passes the bytes and their owner to a C function that writes them; returns its result and
    /// the sequence number.
    fn hand_over(
        &self,
        bytes: impl Bytes,
        related: Option<SampleIdentity>,
        write: impl FnOnce(*const u8, usize, *mut c_void, *const ffi::Identity, *mut i64) -> i32,
    ) -> Result<(i32, i64), Error> {
        let owner: ffi::Owner = Box::new(bytes);
        let what = || "write a sample".to_owned();
        let size = owner.bytes().len();
        if size < 4 || u32::try_from(size).is_err() {
            let why = format!("a sample has 4 to 4294967295 bytes, not {size}");
            return Err(Error::new(what(), why));
        }
        let related =
            related.map(|one| ffi::Identity { guid: one.writer.0, sequence: one.sequence });
        let related = related.as_ref().map_or(std::ptr::null(), std::ptr::from_ref);
        let mut sequence = 0;
        let _writing = self.writing.lock().unwrap_or_else(PoisonError::into_inner);
        let owner = Box::into_raw(Box::new(owner));
        // SAFETY: just created and only read; the box does not move until C returns it.
        let bytes = unsafe { (*owner).bytes() };
        let size = size.min(bytes.len());
        let code = write(bytes.as_ptr(), size, owner.cast(), related, &raw mut sequence);
        Ok((check(code, what)?, sequence))
    }

    /// Number of matched readers.
    #[must_use]
    pub fn readers(&self) -> usize {
        // SAFETY: a number.
        let count = unsafe { ffi::pp_matched(self.endpoint.entity.0, 1) };
        usize::try_from(count).unwrap_or(0)
    }

    /// Waits until all matched readers have acknowledged all samples, at most for the timeout; true
    /// if they have.
    #[must_use]
    pub fn wait_acknowledged(&self, timeout_ns: i64) -> bool {
        // SAFETY: a number.
        unsafe { ffi::pp_wait_acknowledged(self.endpoint.entity.0, timeout_ns.max(0)) >= 0 }
    }

    /// Asserts liveliness without a sample.
    pub fn assert_liveliness(&self) {
        // SAFETY: a number.
        let _ = unsafe { ffi::pp_assert_liveliness(self.endpoint.entity.0) };
    }

    /// Participant of the writer.
    #[must_use]
    pub fn participant(&self) -> &Participant {
        &self.participant
    }

    pub(crate) fn entity(&self) -> i32 {
        self.endpoint.entity.0
    }
}
