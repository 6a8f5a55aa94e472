//! Times of the transforms of each child frame.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;

use periplus_msgs::tf2_msgs::TFMessage;
use periplus_transport::lock;

/// Maximum number of indexed messages; 8 bytes each.
const MAX_MESSAGES: usize = 4_000_000;

/// Maximum number of different sets of child frames.
const MAX_GROUPS: usize = 10_000;

/// Times of the messages that contain each child frame, filled in the order of time while a
/// recording is replayed already.
#[derive(Default)]
pub(super) struct TransformIndex(Mutex<Times>);

#[derive(Default)]
struct Times {
    frames: BTreeMap<String, u32>,
    /// Times of the messages of a topic with the same child frames, in order.
    groups: BTreeMap<(usize, Vec<u32>), Vec<i64>>,
    messages: usize,
    reach: Reach,
}

/// Part of a recording that an index covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Reach {
    /// Nothing yet.
    #[default]
    Nothing,
    /// All messages up to a time \[ns\].
    Until(i64),
    /// The whole recording.
    All,
}

impl Reach {
    /// True if all messages up to a time are covered.
    pub(super) fn covers(self, time_ns: i64) -> bool {
        match self {
            Self::Nothing => false,
            Self::Until(reached_ns) => time_ns <= reached_ns,
            Self::All => true,
        }
    }
}

impl TransformIndex {
    /// Adds a message. Messages come in the order of time. False if the index is full.
    pub(super) fn add(&self, topic: usize, time_ns: i64, message: &TFMessage) -> bool {
        let mut times = lock(&self.0);
        if times.messages >= MAX_MESSAGES || times.groups.len() >= MAX_GROUPS {
            return false;
        }
        let mut children = Vec::new();
        for transform in &message.transforms {
            let next = u32::try_from(times.frames.len()).unwrap_or(u32::MAX);
            let name = &transform.child_frame_id;
            children.push(match times.frames.get(name) {
                Some(number) => *number,
                None => {
                    times.frames.insert(name.clone(), next);
                    next
                }
            });
        }
        children.sort_unstable();
        children.dedup();
        let group = times.groups.entry((topic, children)).or_default();
        if group.last() != Some(&time_ns) {
            group.push(time_ns);
            times.messages += 1;
        }
        true
    }

    /// Declares the part of the recording that was read.
    pub(super) fn set_reach(&self, reach: Reach) {
        lock(&self.0).reach = reach;
    }

    pub(super) fn reach(&self) -> Reach {
        lock(&self.0).reach
    }

    /// Child frames of a topic so far.
    pub(super) fn children(&self, topic: usize) -> BTreeSet<String> {
        let times = lock(&self.0);
        let of_topic = times.groups.range((topic, Vec::new())..(topic + 1, Vec::new()));
        let numbers: BTreeSet<u32> =
            of_topic.flat_map(|((_, children), _)| children).copied().collect();
        let frames = times.frames.iter().filter(|(_, number)| numbers.contains(number));
        frames.map(|(name, _)| name.clone()).collect()
    }

    /// Times of the messages of a topic that have the newest transform of each child frame at or
    /// before a time.
    pub(super) fn newest(&self, topic: usize, at_ns: i64) -> BTreeSet<i64> {
        let times = lock(&self.0);
        let mut newest: BTreeMap<u32, i64> = BTreeMap::new();
        for ((_, children), group) in
            times.groups.range((topic, Vec::new())..(topic + 1, Vec::new()))
        {
            let until = group.partition_point(|time_ns| *time_ns <= at_ns);
            let Some(&last_ns) = until.checked_sub(1).and_then(|last| group.get(last)) else {
                continue;
            };
            for child in children {
                let known = newest.entry(*child).or_insert(last_ns);
                *known = last_ns.max(*known);
            }
        }
        newest.into_values().collect()
    }
}

#[cfg(test)]
mod tests {
    use periplus_msgs::geometry_msgs::TransformStamped;

    use super::*;

    fn message(children: &[&str]) -> TFMessage {
        let one = |child: &&str| TransformStamped {
            child_frame_id: (*child).to_owned(),
            ..TransformStamped::default()
        };
        TFMessage { transforms: children.iter().map(one).collect() }
    }

    #[test]
    fn the_newest_message_of_each_child_is_found() {
        let index = TransformIndex::default();
        index.add(0, 1, &message(&["arm"]));
        index.add(1, 1, &message(&["other"]));
        for time_ns in 2..10 {
            index.add(0, time_ns, &message(&["base", "wheel"]));
        }
        index.add(0, 5, &message(&["wheel"]));
        assert_eq!(index.newest(0, 0), [].into());
        assert_eq!(index.newest(0, 1), [1].into());
        assert_eq!(index.newest(0, 7), [1, 7].into());
        assert_eq!(index.newest(1, 7), [1].into());
        assert_eq!(index.newest(2, 7), [].into());
        assert_eq!(index.children(0), ["arm", "base", "wheel"].map(str::to_owned).into());
        assert_eq!(index.children(1), ["other".to_owned()].into());
    }

    #[test]
    fn an_index_covers_what_was_read() {
        assert!(!Reach::Nothing.covers(0));
        assert!(Reach::Until(5).covers(5) && !Reach::Until(5).covers(6));
        assert!(Reach::All.covers(i64::MAX));
    }
}
