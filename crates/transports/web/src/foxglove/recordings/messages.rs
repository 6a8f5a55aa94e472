//! Messages of a span.

use std::ops::{ControlFlow, Range};

use periplus_bags::files::{BagError, ChunkUse, MessageLocation};

use super::entry::{Recording, topic_id};
use super::fetch::{FetchAnswer, MessageFrames};

/// Maximum number of messages that are located at once.
const PAGE: usize = 1024;

/// Maximum size of the messages of an answer \[bytes\].
const MAX_ANSWER_BYTES: u64 = 64 << 20;

/// Answers with the messages of a span until they have `max_bytes`.
pub(super) fn fetch(
    recording: &Recording,
    topics: &[u32],
    span_ns: &Range<i64>,
    max_bytes: u64,
    answer: &FetchAnswer<'_>,
) -> Result<(), BagError> {
    let max_bytes = max_bytes.min(MAX_ANSWER_BYTES);
    let mut topics: Vec<usize> = topics.iter().filter_map(|id| recording.topic(*id)).collect();
    topics.sort_unstable();
    topics.dedup();
    let mut frames = MessageFrames::new(answer);
    // Time of the last message, and the last time of which all messages were sent.
    let mut time_ns = span_ns.start.saturating_sub(1);
    let mut reached_ns = time_ns;
    let mut from_ns = Some(span_ns.start);
    let mut is_full = false;
    while let Some(start_ns) = from_ns {
        let page = recording.bag.between(&topics, start_ns, span_ns.end, PAGE)?;
        let visit = &mut |location: &MessageLocation, data: &[u8]| {
            if location.time_ns > time_ns {
                reached_ns = time_ns;
                // All messages of one time are in one answer.
                is_full |= frames.bytes >= max_bytes && frames.bytes > 0;
            }
            is_full |= answer.is_cancelled();
            if is_full {
                return ControlFlow::Break(());
            }
            time_ns = location.time_ns;
            let flow = frames.push(topic_id(location.topic), location.time_ns, data);
            is_full |= flow.is_break();
            flow
        };
        recording.bag.read(&page.locations, ChunkUse::Keep, visit)?;
        from_ns = page.next_ns;
        if is_full {
            break;
        }
    }
    if !is_full {
        reached_ns = span_ns.end.saturating_sub(1).max(time_ns);
    }
    frames.finish(reached_ns, is_full);
    Ok(())
}
