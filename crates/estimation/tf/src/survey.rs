//! What a buffer does not keep, and people look for: who said what of a frame.

use std::collections::{BTreeMap, BTreeSet};

use crate::buffer::{Buffer, Kind, Stamped};
use crate::error::Refused;

/// A frame that somebody said to be the parent of another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parent {
    /// Its name.
    pub name: String,
    /// How often it was said.
    pub count: usize,
    /// The newest stamp with which it was said \[ns\].
    pub newest_ns: i64,
    /// How long the last one holds.
    pub kind: Kind,
}

/// A buffer, and beside it all that was said.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// What is kept.
    pub buffer: Buffer,
    parents: BTreeMap<String, Vec<Parent>>,
    with_slash: BTreeSet<String>,
    refused: BTreeMap<(String, &'static str), usize>,
    jumps: usize,
}

impl Survey {
    /// One that keeps samples of a frame for so long behind its newest \[ns\].
    #[must_use]
    pub fn keeping(span_ns: i64) -> Self {
        Self { buffer: Buffer::new(span_ns), ..Self::default() }
    }

    /// Takes a transform, as [`Buffer::set`] does. When it is older than all that is kept, time has
    /// jumped back: all samples are forgotten, and it is taken.
    ///
    /// # Errors
    /// Why it is not taken, or that time has jumped back.
    pub fn hear(&mut self, it: &Stamped, authority: &str, kind: Kind) -> Result<(), Refused> {
        for name in [&it.parent, &it.child] {
            if name.starts_with('/') {
                self.with_slash.insert(name.clone());
            }
        }
        let outcome = self.buffer.set(it, authority, kind);
        if let Err(why) = &outcome {
            if !matches!(why, Refused::OldData(..)) {
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
                parents.push(Parent { name: parent, count: 1, newest_ns: it.stamp_ns, kind });
            }
        }
        outcome
    }

    /// The parents of a frame, in the order in which they were first named.
    #[must_use]
    pub fn parents_of(&self, child: &str) -> &[Parent] {
        self.parents.get(child).map_or(&[], Vec::as_slice)
    }

    /// Frames that more than one parent was said of.
    pub fn with_several_parents(&self) -> impl Iterator<Item = (&str, &[Parent])> {
        self.parents
            .iter()
            .filter(|(_, parents)| parents.len() > 1)
            .map(|(child, parents)| (child.as_str(), parents.as_slice()))
    }

    /// Names that came with a slash in front, which tf2 has no place for.
    pub fn with_slash(&self) -> impl Iterator<Item = &str> {
        self.with_slash.iter().map(String::as_str)
    }

    /// Children whose transforms were not taken, why by tf2's name, and how often.
    pub fn refused(&self) -> impl Iterator<Item = (&str, &'static str, usize)> {
        self.refused.iter().map(|((child, why), count)| (child.as_str(), *why, *count))
    }

    /// How often time has jumped back.
    #[must_use]
    pub fn jumps(&self) -> usize {
        self.jumps
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose;

    use super::*;

    fn said(parent: &str, child: &str, stamp_ns: i64) -> Stamped {
        Stamped::new(parent, child, stamp_ns, Pose::IDENTITY)
    }

    #[test]
    fn what_was_said_is_known_though_only_the_last_counts() {
        let mut survey = Survey::default();
        survey.hear(&said("odom", "base", 1), "a", Kind::Moving).unwrap();
        survey.hear(&said("/map", "base", 2), "b", Kind::Moving).unwrap();
        assert_eq!(survey.buffer.parent_of("base"), Some("map"));
        let (child, parents) = survey.with_several_parents().next().unwrap();
        assert_eq!(
            (child, parents[0].name.as_str(), parents[1].name.as_str()),
            ("base", "odom", "map")
        );
        assert_eq!(survey.with_slash().collect::<Vec<_>>(), ["/map"]);
    }

    #[test]
    fn a_jump_back_forgets_and_goes_on() {
        let mut survey = Survey::default();
        survey.hear(&said("odom", "base", 60_000_000_000), "a", Kind::Moving).unwrap();
        let jump = survey.hear(&said("odom", "base", 1_000_000_000), "a", Kind::Moving);
        assert!(matches!(jump, Err(Refused::OldData(..))));
        assert_eq!(survey.jumps(), 1);
        let kept: Vec<_> = survey.buffer.kept_frames().map(|kept| kept.newest_ns).collect();
        assert_eq!(kept, [1_000_000_000]);
    }

    #[test]
    fn what_is_refused_is_counted() {
        let mut survey = Survey::default();
        let mut broken = said("odom", "base", 1);
        broken.rotation.w = 3.0;
        assert!(survey.hear(&broken, "a", Kind::Moving).is_err());
        assert_eq!(
            survey.refused().collect::<Vec<_>>(),
            [("base", "TF_DENORMALIZED_QUATERNION", 1)]
        );
        assert!(survey.parents_of("base").is_empty());
    }
}
