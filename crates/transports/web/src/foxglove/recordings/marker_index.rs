//! Changes of the markers of a recording.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;

use periplus_bags::BagTopic;
use periplus_bags::files::MessageLocation;
use periplus_msgs::Message as _;
use periplus_msgs::visualization_msgs::{Marker, MarkerArray};
use periplus_transport::lock;

use super::transform_index::Reach;

/// Values of `visualization_msgs/msg/Marker.action`.
mod action {
    pub(super) const ADD: i32 = 0;
    pub(super) const DELETE: i32 = 2;
    pub(super) const DELETE_ALL: i32 = 3;
}

/// Maximum number of stored changes and locations.
const MAX_SIZE: usize = 2_000_000;

/// Type of the messages of a topic of markers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MarkerTopic {
    Single,
    Array,
}

impl MarkerTopic {
    /// Type of a topic; none if it has no markers.
    pub(super) fn of(topic: &BagTopic) -> Option<Self> {
        match topic.type_name.as_str() {
            _ if topic.encoding != "cdr" => None,
            Marker::TYPE_NAME => Some(Self::Single),
            MarkerArray::TYPE_NAME => Some(Self::Array),
            _ => None,
        }
    }

    /// Markers of a message; none if it is damaged.
    pub(super) fn decode(self, data: &[u8]) -> Option<Vec<Marker>> {
        match self {
            Self::Single => Marker::decode_cdr(data).ok().map(|marker| vec![marker]),
            Self::Array => MarkerArray::decode_cdr(data).ok().map(|array| array.markers),
        }
    }
}

/// Messages that each marker is set and deleted by, filled in the order of time while a recording
/// is replayed already.
pub(super) struct MarkerIndex<L = MessageLocation>(Mutex<Changes<L>>);

struct Changes<L> {
    namespaces: BTreeMap<(usize, String), u32>,
    /// Number of each marker by namespace and id.
    markers: BTreeMap<(u32, i32), u32>,
    /// Namespace of each marker.
    namespace_of: Vec<u32>,
    /// Messages of a topic with the same changes, in order. A node that publishes the same markers
    /// periodically has one entry.
    groups: BTreeMap<GroupKey, Vec<(i64, L)>>,
    size: usize,
    reach: Reach,
}

/// A topic, and the changes that a message of it makes.
type GroupKey = (usize, Vec<Change>);

/// Change that a message makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Change {
    /// Adds or modifies a marker; a lifetime of 0 has no end.
    Set {
        marker: u32,
        lifetime_ns: i64,
    },
    Delete {
        marker: u32,
    },
    DeleteNamespace {
        namespace: u32,
    },
    DeleteAll,
}

/// Newest change of a marker: its message, its position in the message, and the end of the marker.
#[derive(Clone, Copy)]
struct Newest<L> {
    at: (L, usize),
    /// Time at which the marker expires; none if it was deleted.
    until_ns: Option<i64>,
}

impl<L> Default for MarkerIndex<L> {
    fn default() -> Self {
        Self(Mutex::new(Changes {
            namespaces: BTreeMap::new(),
            markers: BTreeMap::new(),
            namespace_of: Vec::new(),
            groups: BTreeMap::new(),
            size: 0,
            reach: Reach::Nothing,
        }))
    }
}

impl<L: Copy + Ord> MarkerIndex<L> {
    /// Adds a message. Messages come in the order of time. False if the index is full.
    pub(super) fn add(&self, topic: usize, time_ns: i64, location: L, markers: &[Marker]) -> bool {
        let mut index = lock(&self.0);
        if index.size >= MAX_SIZE {
            return false;
        }
        let changes: Vec<Change> =
            markers.iter().filter_map(|marker| index.change(topic, marker)).collect();
        let count = changes.len();
        let messages = index.groups.entry((topic, changes)).or_default();
        let is_new = messages.is_empty();
        messages.push((time_ns, location));
        index.size += 1 + if is_new { count } else { 0 };
        true
    }

    /// Declares the part of the recording that was read.
    pub(super) fn set_reach(&self, reach: Reach) {
        lock(&self.0).reach = reach;
    }

    pub(super) fn reach(&self) -> Reach {
        lock(&self.0).reach
    }

    /// Messages that, processed in order, give the markers that exist at a time.
    pub(super) fn state(&self, topic: usize, at_ns: i64) -> BTreeSet<L> {
        lock(&self.0).state(topic, at_ns)
    }
}

impl<L: Copy + Ord> Changes<L> {
    fn change(&mut self, topic: usize, marker: &Marker) -> Option<Change> {
        if marker.action == action::DELETE_ALL && marker.ns.is_empty() {
            return Some(Change::DeleteAll);
        }
        let next = u32::try_from(self.namespaces.len()).unwrap_or(u32::MAX);
        let namespace = *self.namespaces.entry((topic, marker.ns.clone())).or_insert(next);
        if marker.action == action::DELETE_ALL {
            return Some(Change::DeleteNamespace { namespace });
        }
        let next = u32::try_from(self.namespace_of.len()).unwrap_or(u32::MAX);
        let number = *self.markers.entry((namespace, marker.id)).or_insert(next);
        if number == next {
            self.namespace_of.push(namespace);
        }
        match marker.action {
            action::ADD => {
                Some(Change::Set { marker: number, lifetime_ns: marker.lifetime.ns().max(0) })
            }
            action::DELETE => Some(Change::Delete { marker: number }),
            _ => None,
        }
    }

    fn state(&self, topic: usize, at_ns: i64) -> BTreeSet<L> {
        // Of messages with the same changes only the newest one counts.
        let mut messages: BTreeMap<L, &[Change]> = BTreeMap::new();
        let mut newest: BTreeMap<u32, Newest<L>> = BTreeMap::new();
        // Newest deletion of a namespace, or of all.
        let mut cleared: BTreeMap<Option<u32>, (L, usize)> = BTreeMap::new();
        let of_topic = (topic, Vec::new())..(topic + 1, Vec::new());
        for ((_, changes), group) in self.groups.range(of_topic) {
            let until = group.partition_point(|(time_ns, _)| *time_ns <= at_ns);
            let Some(&(time_ns, message)) = until.checked_sub(1).and_then(|last| group.get(last))
            else {
                continue;
            };
            messages.insert(message, changes);
            for (position, change) in changes.iter().enumerate() {
                let at = (message, position);
                let mut set = |marker: u32, until_ns: Option<i64>| {
                    let known = newest.entry(marker).or_insert(Newest { at, until_ns });
                    if at > known.at {
                        *known = Newest { at, until_ns };
                    }
                };
                match *change {
                    Change::Set { marker, lifetime_ns: 0 } => set(marker, Some(i64::MAX)),
                    Change::Set { marker, lifetime_ns } => {
                        set(marker, Some(time_ns.saturating_add(lifetime_ns)));
                    }
                    Change::Delete { marker } => set(marker, None),
                    Change::DeleteNamespace { namespace } => {
                        let known = cleared.entry(Some(namespace)).or_insert(at);
                        *known = at.max(*known);
                    }
                    Change::DeleteAll => {
                        let known = cleared.entry(None).or_insert(at);
                        *known = at.max(*known);
                    }
                }
            }
        }
        for (marker, known) in &mut newest {
            let namespace = usize::try_from(*marker).ok().and_then(|it| self.namespace_of.get(it));
            for key in [None, namespace.copied()] {
                if let Some(at) = cleared.get(&key)
                    && *at > known.at
                {
                    *known = Newest { at: *at, until_ns: None };
                }
            }
        }
        let is_shown = |known: &&Newest<L>| known.until_ns.is_some_and(|until| until >= at_ns);
        let mut found: BTreeSet<L> = newest.values().filter(is_shown).map(|it| it.at.0).collect();
        // A message may also set markers that were changed since: these changes belong to the state.
        let mut pending: Vec<L> = found.iter().copied().collect();
        while let Some(message) = pending.pop() {
            for change in messages.get(&message).copied().unwrap_or_default() {
                let (Change::Set { marker, .. } | Change::Delete { marker }) = change else {
                    continue;
                };
                if let Some(known) = newest.get(marker)
                    && found.insert(known.at.0)
                {
                    pending.push(known.at.0);
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use periplus_msgs::builtin_interfaces::Duration;

    use super::*;

    fn marker(ns: &str, id: i32, action: i32) -> Marker {
        Marker { ns: ns.to_owned(), id, action, ..Marker::default() }
    }

    fn set(id: i32) -> Marker {
        marker("a", id, action::ADD)
    }

    /// An index of messages at the times 0, 1, 2 ...; a message is located by its time.
    fn index(messages: &[Vec<Marker>]) -> MarkerIndex<i64> {
        let index = MarkerIndex::default();
        for (time, markers) in (0..).zip(messages) {
            assert!(index.add(0, time, time, markers));
        }
        index
    }

    #[test]
    fn a_marker_that_was_set_long_ago_is_part_of_the_state() {
        let mut messages = vec![vec![set(1)]];
        messages.extend((0..100).map(|_| vec![set(2)]));
        assert_eq!(index(&messages).state(0, 100), [0, 100].into());
        assert_eq!(index(&messages).state(0, 0), [0].into());
        assert_eq!(index(&messages).state(0, -1), [].into());
        assert_eq!(index(&messages).state(1, 100), [].into());
    }

    #[test]
    fn deleted_markers_are_not() {
        let delete = marker("a", 1, action::DELETE);
        let messages = [vec![set(1)], vec![delete], vec![set(2)]];
        assert_eq!(index(&messages).state(0, 2), [2].into());
        assert_eq!(index(&messages).state(0, 1), [].into());
    }

    #[test]
    fn a_deletion_counts_where_another_marker_of_the_same_message_is_still_shown() {
        let delete = marker("a", 1, action::DELETE);
        let messages = [vec![set(1), set(2)], vec![delete], vec![set(3)]];
        assert_eq!(index(&messages).state(0, 2), [0, 1, 2].into());
    }

    #[test]
    fn all_markers_of_a_namespace_or_of_the_topic_are_deleted() {
        let other = marker("b", 1, action::ADD);
        let namespace = marker("a", 0, action::DELETE_ALL);
        let all = marker("", 0, action::DELETE_ALL);
        let messages = [vec![set(1)], vec![other], vec![namespace], vec![all, set(7)]];
        assert_eq!(index(&messages).state(0, 1), [0, 1].into());
        assert_eq!(index(&messages).state(0, 2), [1].into());
        assert_eq!(index(&messages).state(0, 3), [3].into());
    }

    #[test]
    fn a_marker_is_shown_for_its_lifetime() {
        let brief = Marker { lifetime: Duration { sec: 0, nanosec: 2 }, ..set(1) };
        let index = index(&[vec![brief]]);
        assert_eq!(index.state(0, 2), [0].into());
        assert_eq!(index.state(0, 3), [].into());
    }
}
