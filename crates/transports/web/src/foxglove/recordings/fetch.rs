//! Answer of a fetch.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::foxglove::frame::WebSocketFrame;
use crate::foxglove::outbox::{Outbox, Room};
use crate::foxglove::protocol::{self, StoredMessages};

/// Size of a frame of messages at which it is sent \[bytes\].
const FRAME_BYTES: usize = 1 << 20;

/// Maximum size of queued responses of a client at which a fetch goes on \[bytes\].
const MAX_WAITING_BYTES: usize = 16 << 20;

/// Period at which a fetch that waits for its client checks whether it is cancelled.
const ROOM_POLL: Duration = Duration::from_millis(100);

/// Target of the answer of a fetch.
pub(super) struct FetchAnswer<'a> {
    pub(super) outbox: &'a Outbox,
    pub(super) request_id: u32,
    pub(super) is_cancelled: &'a AtomicBool,
    /// Frees the id of the request; called before the last frame, after which the client may use it
    /// again.
    pub(super) release: &'a dyn Fn(),
}

impl FetchAnswer<'_> {
    pub(super) fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }

    /// Sends a frame when the client has read enough of the earlier ones.
    pub(super) fn push(&self, frame: WebSocketFrame) -> ControlFlow<()> {
        loop {
            match self.outbox.wait_for_room(MAX_WAITING_BYTES, ROOM_POLL) {
                Room::Free => break,
                Room::Closed => return ControlFlow::Break(()),
                Room::Full if self.is_cancelled() => return ControlFlow::Break(()),
                Room::Full => {}
            }
        }
        self.outbox.push(frame);
        ControlFlow::Continue(())
    }

    /// Sends the last frame.
    pub(super) fn finish(&self, frame: WebSocketFrame) {
        (self.release)();
        self.outbox.push(frame);
    }

    pub(super) fn fail(&self, why: &str) {
        self.finish(protocol::fetch_failure(self.request_id, why));
    }

    /// Answers a cancelled request that has no frames.
    pub(super) fn fail_cancelled(&self) {
        self.fail("the request was cancelled");
    }
}

/// Frames of messages, sent as they become full.
pub(super) struct MessageFrames<'a> {
    answer: &'a FetchAnswer<'a>,
    frame: Option<StoredMessages>,
    /// Size of the messages so far \[bytes\].
    pub(super) bytes: u64,
}

impl<'a> MessageFrames<'a> {
    pub(super) fn new(answer: &'a FetchAnswer<'a>) -> Self {
        Self { answer, frame: None, bytes: 0 }
    }

    /// Appends a message; breaks when the client is gone or has cancelled the request.
    pub(super) fn push(&mut self, topic_id: u32, time_ns: i64, data: &[u8]) -> ControlFlow<()> {
        let request_id = self.answer.request_id;
        let frame = self.frame.get_or_insert_with(|| StoredMessages::new(request_id));
        frame.push(topic_id, time_ns, data);
        self.bytes += data.len() as u64;
        if frame.bytes() < FRAME_BYTES {
            return ControlFlow::Continue(());
        }
        match self.frame.take() {
            Some(frame) => self.answer.push(frame.finish(time_ns)),
            None => ControlFlow::Continue(()),
        }
    }

    /// Sends the last frame.
    pub(super) fn finish(mut self, reached_ns: i64, has_more: bool) {
        let request_id = self.answer.request_id;
        let frame = self.frame.take().unwrap_or_else(|| StoredMessages::new(request_id));
        self.answer.finish(frame.finish_last(reached_ns, has_more));
    }
}
