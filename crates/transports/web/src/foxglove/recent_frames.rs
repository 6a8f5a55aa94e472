//! The newest transforms, for clients that connect while time is paused.

use std::collections::{BTreeMap, VecDeque};

use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::TransformStamped;
use periplus_msgs::tf2_msgs::TFMessage;

/// Age relative to the newest transform at which transforms are dropped, the cache time of tf2
/// \[ns\].
const KEPT_NS: i64 = 10_000_000_000;

/// Time before the newest transform of all that is kept for each frame: publishers alternate, and a
/// lookup between two frames needs a common time \[ns\].
const SPAN_NS: i64 = 1_000_000_000;

/// Maximum number of transforms kept per frame.
const MAX_OF_ONE: usize = 128;

/// The newest transforms of each frame on a topic.
#[derive(Debug, Default)]
pub(crate) struct RecentFrames {
    by_child: BTreeMap<String, VecDeque<TransformStamped>>,
}

impl RecentFrames {
    /// Adds the transforms of a message.
    pub(crate) fn add(&mut self, message: &TFMessage) {
        for one in &message.transforms {
            let now_ns = stamp_ns(one);
            let own = self.by_child.entry(one.child_frame_id.clone()).or_default();
            if own.back().is_some_and(|before| stamp_ns(before) > now_ns) {
                // The run was reset: newer transforms belong to the time before.
                for kept in self.by_child.values_mut() {
                    kept.retain(|one| stamp_ns(one) <= now_ns);
                }
            }
            let own = self.by_child.entry(one.child_frame_id.clone()).or_default();
            own.push_back(one.clone());
            // The last transform before the span is kept, so that the whole span can be
            // interpolated.
            while own.len() > MAX_OF_ONE
                || own.get(1).is_some_and(|second| now_ns - stamp_ns(second) >= SPAN_NS)
            {
                own.pop_front();
            }
        }
    }

    /// Returns the newest transforms as one message, oldest first; none if there are none.
    pub(crate) fn message(&self) -> Option<TFMessage> {
        let newest = |own: &VecDeque<TransformStamped>| own.back().map(stamp_ns);
        let newest_ns = self.by_child.values().filter_map(newest).max()?;
        let is_recent = |own: &&VecDeque<TransformStamped>| {
            newest(own).is_some_and(|own_ns| newest_ns - own_ns <= KEPT_NS)
        };
        let recent = self.by_child.values().filter(is_recent).flatten();
        let mut transforms: Vec<TransformStamped> = recent.cloned().collect();
        transforms.sort_by_key(stamp_ns);
        Some(TFMessage { transforms })
    }
}

fn stamp_ns(one: &TransformStamped) -> i64 {
    let stamp: &Time = &one.header.stamp;
    stamp.ns()
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_msgs::std_msgs::Header;

    fn at(child: &str, second: i64) -> TFMessage {
        let header = Header::at(second * 1_000_000_000, "odom");
        let one = TransformStamped { header, child_frame_id: child.into(), ..Default::default() };
        TFMessage { transforms: vec![one] }
    }

    fn kept(messages: &[TFMessage]) -> Vec<(String, i64)> {
        let mut frames = RecentFrames::default();
        messages.iter().for_each(|message| frames.add(message));
        let transforms = frames.message().map(|message| message.transforms).unwrap_or_default();
        let short =
            |one: &TransformStamped| (one.child_frame_id.clone(), stamp_ns(one) / 1_000_000_000);
        transforms.iter().map(short).collect()
    }

    #[test]
    fn of_each_frame_the_newest_second_is_kept() {
        assert_eq!(kept(&[]), []);
        let two = kept(&[at("base", 1), at("wheel", 2), at("base", 3), at("base", 4)]);
        let wanted = [("wheel", 2), ("base", 3), ("base", 4)];
        assert_eq!(two, wanted.map(|(name, second)| (name.to_owned(), second)));
    }

    #[test]
    fn a_frame_that_is_silent_for_ten_seconds_is_not_told() {
        assert_eq!(kept(&[at("wheel", 1), at("base", 12)]), [("base".to_owned(), 12)]);
    }

    #[test]
    fn many_transforms_take_bounded_memory() {
        let mut frames = RecentFrames::default();
        (0..1000).for_each(|_| frames.add(&at("base", 1)));
        assert_eq!(frames.message().map(|all| all.transforms.len()), Some(MAX_OF_ONE));
    }

    #[test]
    fn a_reset_forgets_what_was_newer() {
        let left = kept(&[at("base", 8), at("map", 9), at("base", 1)]);
        assert_eq!(left, [("base".to_owned(), 1)]);
    }
}
