//! Monitor of published transforms: every parent of a frame, rejected transforms and time jumps.

use std::collections::{BTreeMap, BTreeSet};

use crate::buffer::{Buffer, StampedTransform, TransformKind};
use crate::error::RejectedTransform;

/// A frame that was published as the parent of another frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PublishedParent {
    /// Name of the parent.
    pub name: String,
    /// Number of transforms with this parent.
    pub count: usize,
    /// Newest stamp with this parent \[ns\].
    pub newest_ns: i64,
    /// Static or dynamic, in the latest transform.
    pub kind: TransformKind,
}

/// A transform buffer with statistics about all transforms that were published.
#[derive(Clone, Debug, Default)]
pub struct TransformMonitor {
    /// Cached transforms.
    pub buffer: Buffer,
    parents: BTreeMap<String, Vec<PublishedParent>>,
    with_slash: BTreeSet<String>,
    refused: BTreeMap<(String, &'static str), usize>,
    jumps: usize,
}

impl TransformMonitor {
    /// Creates a monitor that keeps the samples of a frame for `span_ns` before its newest one
    /// \[ns\].
    #[must_use]
    pub fn with_cache_ns(span_ns: i64) -> Self {
        Self { buffer: Buffer::new(span_ns), ..Self::default() }
    }

    /// Inserts a transform like [`Buffer::set`]. A transform older than all cached samples is a
    /// time jump: all samples are dropped, and the transform is inserted.
    /// # Errors
    /// The reason for which the transform is rejected, or the time jump.
    /// Why it is not taken, or that time has jumped back.
    pub fn insert(
        &mut self,
        it: &StampedTransform,
        authority: &str,
        kind: TransformKind,
    ) -> Result<(), RejectedTransform> {
        for name in [&it.parent, &it.child] {
            if name.starts_with('/') {
                self.with_slash.insert(name.clone());
            }
        }
        let outcome = self.buffer.set(it, authority, kind);
        if let Err(why) = &outcome {
            if !matches!(why, RejectedTransform::OldData(..)) {
                let child = it.child.strip_prefix('/').unwrap_or(&it.child).to_owned();
                *self.refused.entry((child, why.name())).or_default() += 1;
                return outcome;
            }
            self.jumps += 1;
            self.buffer.clear();
            self.buffer.set(it, authority, kind)?;
        }
        let plain = |name: &str| name.strip_prefix('/').unwrap_or(name).to_owned();
        let (parent, child) = (plain(&it.parent), plain(&it.child));
        let parents = self.parents.entry(child).or_default();
        match parents.iter_mut().find(|known| known.name == parent) {
            Some(known) => {
                known.count += 1;
                known.newest_ns = known.newest_ns.max(it.stamp_ns);
                known.kind = kind;
            }
            None => {
                parents.push(PublishedParent {
                    name: parent,
                    count: 1,
                    newest_ns: it.stamp_ns,
                    kind,
                });
            }
        }
        outcome
    }

    /// Returns the parents of a frame, in the order in which they were first named.
    #[must_use]
    pub fn parents_of(&self, child: &str) -> &[PublishedParent] {
        self.parents.get(child).map_or(&[], Vec::as_slice)
    }

    /// Iterates over the frames that were published with more than one parent.
    pub fn with_several_parents(&self) -> impl Iterator<Item = (&str, &[PublishedParent])> {
        self.parents
            .iter()
            .filter(|(_, parents)| parents.len() > 1)
            .map(|(child, parents)| (child.as_str(), parents.as_slice()))
    }

    /// Iterates over the frame names with a leading slash, which tf2 does not support.
    pub fn with_slash(&self) -> impl Iterator<Item = &str> {
        self.with_slash.iter().map(String::as_str)
    }

    /// Iterates over rejected transforms: child frame, name of the error in tf2, and count.
    pub fn refused(&self) -> impl Iterator<Item = (&str, &'static str, usize)> {
        self.refused.iter().map(|((child, why), count)| (child.as_str(), *why, *count))
    }

    /// Returns the number of jumps back in time.
    #[must_use]
    pub fn jumps(&self) -> usize {
        self.jumps
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose;

    use super::*;

    fn published(parent: &str, child: &str, stamp_ns: i64) -> StampedTransform {
        StampedTransform::new(parent, child, stamp_ns, Pose::IDENTITY)
    }

    #[test]
    fn all_published_parents_are_kept_beside_the_current_one() {
        let mut monitor = TransformMonitor::default();
        monitor.insert(&published("odom", "base", 1), "a", TransformKind::Moving).unwrap();
        monitor.insert(&published("/map", "base", 2), "b", TransformKind::Moving).unwrap();
        assert_eq!(monitor.buffer.parent_of("base"), Some("map"));
        let (child, parents) = monitor.with_several_parents().next().unwrap();
        assert_eq!(
            (child, parents[0].name.as_str(), parents[1].name.as_str()),
            ("base", "odom", "map")
        );
        assert_eq!(monitor.with_slash().collect::<Vec<_>>(), ["/map"]);
    }

    #[test]
    fn a_jump_back_forgets_and_goes_on() {
        let mut monitor = TransformMonitor::default();
        monitor
            .insert(&published("odom", "base", 60_000_000_000), "a", TransformKind::Moving)
            .unwrap();
        let jump =
            monitor.insert(&published("odom", "base", 1_000_000_000), "a", TransformKind::Moving);
        assert!(matches!(jump, Err(RejectedTransform::OldData(..))));
        assert_eq!(monitor.jumps(), 1);
        let kept: Vec<_> = monitor.buffer.kept_frames().map(|kept| kept.newest_ns).collect();
        assert_eq!(kept, [1_000_000_000]);
    }

    #[test]
    fn what_is_refused_is_counted() {
        let mut monitor = TransformMonitor::default();
        let mut broken = published("odom", "base", 1);
        broken.rotation.w = 3.0;
        assert!(monitor.insert(&broken, "a", TransformKind::Moving).is_err());
        assert_eq!(
            monitor.refused().collect::<Vec<_>>(),
            [("base", "TF_DENORMALIZED_QUATERNION", 1)]
        );
        assert!(monitor.parents_of("base").is_empty());
    }
}
