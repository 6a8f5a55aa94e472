//! Messages that show a time.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use periplus_bags::files::{BagError, ChunkUse, MessageLocation};
use periplus_msgs::Message as _;
use periplus_msgs::tf2_msgs::TFMessage;

use super::entry::{Recording, topic_id};
use super::fetch::{FetchAnswer, MessageFrames};
use super::transform_index::Reach;
use crate::foxglove::protocol::TopicNeed;

/// Maximum number of messages of the history of a topic; the newest are kept.
const MAX_HISTORY: usize = 100_000;

/// Maximum number of messages that are located at once.
const PAGE: usize = 8192;

/// Maximum number of updates of a grid since its last complete message.
const MAX_GRID_UPDATES: usize = 5_000;

/// Time before the present one in which each transform is assumed to be published, until the index
/// of transforms covers it \[ns\].
const LOOK_BACK_NS: i64 = 10_000_000_000;

/// Time in which the transforms of a moving robot are published \[ns\].
const SHORT_LOOK_BACK_NS: i64 = 1_000_000_000;

/// Number of repetitions when parts of the recording turn out to be damaged.
const MAX_ATTEMPTS: usize = 8;

/// Answers with the messages that show a time.
pub(super) fn fetch(
    recording: &Recording,
    time_ns: i64,
    needs: &[TopicNeed],
    answer: &FetchAnswer<'_>,
) -> Result<(), BagError> {
    let mut sent = BTreeSet::new();
    let mut frames = MessageFrames::new(answer);
    for _ in 0..MAX_ATTEMPTS {
        let located = locate(recording, time_ns, needs, answer)?;
        let locations: Vec<MessageLocation> = located.difference(&sent).copied().collect();
        let visit = &mut |location: &MessageLocation, data: &[u8]| {
            sent.insert(*location);
            if answer.is_cancelled() {
                return ControlFlow::Break(());
            }
            frames.push(topic_id(location.topic), location.time_ns, data)
        };
        if recording.bag.read(&locations, ChunkUse::Keep, visit)? || answer.is_cancelled() {
            break;
        }
    }
    frames.finish(time_ns, false);
    Ok(())
}

/// Locations of the messages, in the order of time.
fn locate(
    recording: &Recording,
    time_ns: i64,
    needs: &[TopicNeed],
    answer: &FetchAnswer<'_>,
) -> Result<BTreeSet<MessageLocation>, BagError> {
    let bag = &recording.bag;
    let mut found = BTreeSet::new();
    // One need per topic: the largest.
    let mut by_topic: BTreeMap<usize, (i64, usize)> = BTreeMap::new();
    for need in needs {
        let Some(topic) = recording.topic(need.id) else { continue };
        let count = usize::try_from(need.count).unwrap_or(MAX_HISTORY).min(MAX_HISTORY);
        let known = by_topic.entry(topic).or_insert((0, 0));
        *known = (known.0.max(need.history_ns.0), known.1.max(count));
    }
    for (topic, (history_ns, count)) in by_topic {
        if answer.is_cancelled() {
            break;
        }
        let count = count.max(recording.latched.get(topic).copied().flatten().unwrap_or(0));
        found.extend(bag.newest(topic, time_ns, count)?);
        if history_ns > 0 {
            found.extend(history(recording, topic, time_ns, history_ns, MAX_HISTORY, answer)?);
        }
        if recording.is_transforms.get(topic) == Some(&true) {
            transforms(recording, topic, time_ns, answer, &mut found)?;
        }
        if recording.marker_topics.get(topic).is_some_and(Option::is_some) {
            found.extend(markers(recording, topic, time_ns, answer)?);
        }
        if let Some(Some(grid)) = recording.grid_of_updates.get(topic)
            && let Some(last) = bag.newest(*grid, time_ns, 1)?.first()
        {
            let since_ns = time_ns.saturating_sub(last.time_ns).saturating_add(1);
            let most = MAX_GRID_UPDATES;
            found.extend(history(recording, topic, time_ns, since_ns, most, answer)?);
        }
    }
    Ok(found)
}

/// The newest messages of a topic in `(time - length, time]`.
fn history(
    recording: &Recording,
    topic: usize,
    time_ns: i64,
    length_ns: i64,
    most: usize,
    answer: &FetchAnswer<'_>,
) -> Result<Vec<MessageLocation>, BagError> {
    let end_ns = time_ns.saturating_add(1);
    let mut from_ns = Some(end_ns.saturating_sub(length_ns));
    let mut found: Vec<MessageLocation> = Vec::new();
    while let Some(start_ns) = from_ns
        && !answer.is_cancelled()
    {
        let page = recording.bag.between(&[topic], start_ns, end_ns, PAGE)?;
        found.extend(page.locations);
        found.drain(..found.len().saturating_sub(most));
        from_ns = page.next_ns;
    }
    Ok(found)
}

/// Messages that give the markers that exist at a time. Of the part of the recording that is not
/// indexed yet only the last seconds are read.
fn markers(
    recording: &Recording,
    topic: usize,
    time_ns: i64,
    answer: &FetchAnswer<'_>,
) -> Result<BTreeSet<MessageLocation>, BagError> {
    let reach = recording.markers.reach();
    let length_ns = match reach {
        Reach::All => 0,
        Reach::Until(reached_ns) => time_ns.saturating_sub(reached_ns).clamp(0, LOOK_BACK_NS),
        Reach::Nothing => LOOK_BACK_NS,
    };
    let mut found = recording.markers.state(topic, time_ns);
    if length_ns > 0 {
        found.extend(history(recording, topic, time_ns, length_ns, MAX_HISTORY, answer)?);
    }
    Ok(found)
}

/// Messages with the newest transform of each child frame.
fn transforms(
    recording: &Recording,
    topic: usize,
    time_ns: i64,
    answer: &FetchAnswer<'_>,
    found: &mut BTreeSet<MessageLocation>,
) -> Result<(), BagError> {
    let reach = recording.transforms.reach();
    for at_ns in recording.transforms.newest(topic, time_ns) {
        let end_ns = at_ns.saturating_add(1);
        found.extend(recording.bag.between(&[topic], at_ns, end_ns, PAGE)?.locations);
    }
    if reach.covers(time_ns) {
        return Ok(());
    }
    let mut length_ns = LOOK_BACK_NS;
    if let Reach::Until(reached_ns) = reach {
        // The index has all that is older.
        length_ns = time_ns.saturating_sub(reached_ns).min(LOOK_BACK_NS);
        let short_ns = length_ns.min(SHORT_LOOK_BACK_NS);
        let recent = history(recording, topic, time_ns, short_ns, MAX_HISTORY, answer)?;
        let mut missing = recording.transforms.children(topic);
        let visit = &mut |_: &MessageLocation, data: &[u8]| {
            for transform in TFMessage::decode_cdr(data).unwrap_or_default().transforms {
                missing.remove(&transform.child_frame_id);
            }
            if answer.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        recording.bag.read(&recent, ChunkUse::Keep, visit)?;
        found.extend(recent);
        if missing.is_empty() {
            return Ok(());
        }
    }
    found.extend(history(recording, topic, time_ns, length_ns, MAX_HISTORY, answer)?);
    Ok(())
}
