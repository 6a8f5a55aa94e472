//! All frames, and what is known of them.
//!
//! Source: `tf2/src/buffer_core.cpp`.

use std::collections::BTreeMap;

use periplus_geometry::{DQuat, DVec3, Pose};

use crate::cache::{Sample, Samples};
use crate::error::{LookupError, Refused, Unreachable};
use crate::walk::walk;

/// How long samples are kept unless asked otherwise \[ns\].
pub const CACHE_NS: i64 = 10_000_000_000;

/// How far the square of a quaternion's length may be from 1.
const DENORMALIZED: f64 = 10e-3;

/// A transform as it comes from a broadcaster.
#[derive(Clone, Debug, PartialEq)]
pub struct Stamped {
    /// The frame that it is given in. A leading slash is dropped.
    pub parent: String,
    /// The frame that it places. A leading slash is dropped.
    pub child: String,
    /// When \[ns\].
    pub stamp_ns: i64,
    /// Origin of the child in the parent \[m\].
    pub translation: DVec3,
    /// Orientation of the child in the parent; the length must be near 1.
    pub rotation: DQuat,
}

impl Stamped {
    /// `parent_from_child` at a time \[ns\].
    #[must_use]
    pub fn new(
        parent: impl Into<String>,
        child: impl Into<String>,
        stamp_ns: i64,
        parent_from_child: Pose,
    ) -> Self {
        let Pose { translation, rotation } = parent_from_child;
        Self { parent: parent.into(), child: child.into(), stamp_ns, translation, rotation }
    }
}

/// How long a transform holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// At its time; from `/tf`.
    Moving,
    /// Always; from `/tf_static`.
    Fixed,
}

/// A transform that was asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// When \[ns\]: the time asked for, or the newest common one.
    pub time_ns: i64,
    /// Turns coordinates in the source into coordinates in the target.
    pub target_from_source: Pose,
}

/// What is looked up across time: where the source was at one time in the target at another, with a
/// frame that stood still between.
#[derive(Clone, Copy, Debug)]
pub struct Lookup<'a> {
    /// Into which frame.
    pub target: &'a str,
    /// At which time \[ns\].
    pub target_time_ns: i64,
    /// From which frame.
    pub source: &'a str,
    /// At which time \[ns\].
    pub source_time_ns: i64,
    /// What stood still.
    pub fixed: &'a str,
}

/// Number of a frame. 0 is no frame.
pub(crate) type FrameId = usize;

/// What is kept of a frame.
#[derive(Clone, Debug)]
pub(crate) enum Cache {
    Moving(Samples<FrameId>),
    Fixed(Option<Sample<FrameId>>),
}

impl Cache {
    /// Where the frame was; a fixed one was there at every time.
    pub(crate) fn at(&self, time_ns: i64) -> Result<Sample<FrameId>, LookupError> {
        match self {
            Self::Moving(samples) => samples.at(time_ns),
            Self::Fixed(Some(sample)) => Ok(Sample { stamp_ns: time_ns, ..*sample }),
            Self::Fixed(None) => {
                Err(LookupError::new(Unreachable::NoDataForExtrapolation, String::new()))
            }
        }
    }

    /// The newest stamp, 0 for a fixed one, and the parent then, 0 for none.
    pub(crate) fn newest(&self) -> (i64, FrameId) {
        match self {
            Self::Moving(samples) => {
                samples.newest().map_or((0, 0), |sample| (sample.stamp_ns, sample.parent))
            }
            Self::Fixed(sample) => (0, sample.map_or(0, |sample| sample.parent)),
        }
    }
}

#[derive(Clone, Debug)]
struct Frame {
    name: String,
    /// None for the root of a tree.
    cache: Option<Cache>,
    authority: String,
}

/// Where frames were, at which time.
#[derive(Clone, Debug)]
pub struct Buffer {
    span_ns: i64,
    /// In the order in which they were first named; the first is no frame.
    frames: Vec<Frame>,
    numbers: BTreeMap<String, FrameId>,
}

impl Default for Buffer {
    fn default() -> Self {
        Self::new(CACHE_NS)
    }
}

/// What is kept of a frame that has a parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kept<'a> {
    /// The frame.
    pub name: &'a str,
    /// Its parent, by the newest sample.
    pub parent: &'a str,
    /// Who broadcast it last.
    pub authority: &'a str,
    /// Whether it moves.
    pub kind: Kind,
    /// How many samples are kept.
    pub count: usize,
    /// Stamp of the newest \[ns\]; 0 for a fixed one.
    pub newest_ns: i64,
    /// Stamp of the oldest \[ns\]; 0 for a fixed one.
    pub oldest_ns: i64,
}

/// Rates are over this span at least \[ns\].
const SHORTEST_NS: i64 = 100_000;

impl Kept<'_> {
    /// Samples in a second, as tf2 counts them: so many over the time from the oldest to the newest.
    /// Of one sample alone it makes 10000.
    #[must_use]
    pub fn rate_hz(&self) -> f64 {
        self.count as f64 * 1e9 / (self.newest_ns - self.oldest_ns).max(SHORTEST_NS) as f64
    }
}

impl Buffer {
    /// Keeps samples of a frame for so long behind its newest \[ns\].
    #[must_use]
    pub fn new(span_ns: i64) -> Self {
        let nowhere = Frame { name: "NO_PARENT".into(), cache: None, authority: String::new() };
        Self { span_ns, frames: vec![nowhere], numbers: BTreeMap::new() }
    }

    /// Takes a transform from a broadcaster, whose name is kept for those who ask. A frame that was
    /// fixed and now moves, or the other way round, forgets what was before.
    ///
    /// # Errors
    /// Why it is not taken. The buffer stays as it is.
    pub fn set(&mut self, it: &Stamped, authority: &str, kind: Kind) -> Result<(), Refused> {
        let parent = it.parent.strip_prefix('/').unwrap_or(&it.parent);
        let child = it.child.strip_prefix('/').unwrap_or(&it.child);
        if child.is_empty() {
            return Err(Refused::NoChild);
        }
        if parent.is_empty() {
            return Err(Refused::NoParent(child.into()));
        }
        if child == parent {
            return Err(Refused::SelfTransform(child.into()));
        }
        if !it.translation.is_finite() || !it.rotation.is_finite() {
            return Err(Refused::NotANumber(child.into()));
        }
        let off = (it.rotation.length_squared() - 1.0).abs();
        if off >= DENORMALIZED {
            return Err(Refused::Denormalized(child.into(), it.rotation.to_array()));
        }
        let child_id = self.number(child);
        let parent_id = self.number(parent);
        let sample = Sample {
            stamp_ns: it.stamp_ns,
            parent: parent_id,
            translation: it.translation,
            rotation: it.rotation,
        };
        let span_ns = self.span_ns;
        let frame = &mut self.frames[child_id];
        match (&mut frame.cache, kind) {
            (Some(Cache::Moving(samples)), Kind::Moving) => {
                if !samples.insert(sample) {
                    return Err(Refused::OldData(child.into(), it.stamp_ns));
                }
            }
            (cache, Kind::Moving) => {
                let mut samples = Samples::new(span_ns);
                samples.insert(sample);
                *cache = Some(Cache::Moving(samples));
            }
            (cache, Kind::Fixed) => *cache = Some(Cache::Fixed(Some(sample))),
        }
        authority.clone_into(&mut frame.authority);
        Ok(())
    }

    /// `target_from_source` at a time \[ns\]; 0 asks for the newest that all frames between have in
    /// common. A frame in itself is always there, known or not.
    ///
    /// # Errors
    /// Why there is none.
    pub fn lookup(&self, target: &str, source: &str, time_ns: i64) -> Result<Found, LookupError> {
        if target == source {
            let newest = || Some(self.frames[self.find(target)?].cache.as_ref()?.newest().0);
            let time_ns = if time_ns == 0 { newest().unwrap_or(0) } else { time_ns };
            return Ok(Found { time_ns, target_from_source: Pose::IDENTITY });
        }
        let target = self.known(target, "target_frame")?;
        let source = self.known(source, "source_frame")?;
        walk(self, target, source, time_ns)
    }

    /// `target_from_source`, each at its own time.
    ///
    /// # Errors
    /// Why there is none.
    pub fn lookup_across(&self, lookup: Lookup<'_>) -> Result<Found, LookupError> {
        let Lookup { target, target_time_ns, source, source_time_ns, fixed } = lookup;
        self.known(target, "target_frame")?;
        self.known(source, "source_frame")?;
        self.known(fixed, "fixed_frame")?;
        let fixed_from_source = self.lookup(fixed, source, source_time_ns)?;
        let target_from_fixed = self.lookup(target, fixed, target_time_ns)?;
        Ok(Found {
            time_ns: target_from_fixed.time_ns,
            target_from_source: target_from_fixed.target_from_source
                * fixed_from_source.target_from_source,
        })
    }

    /// Whether [`Buffer::lookup`] would succeed.
    ///
    /// # Errors
    /// Why not, in the words of `canTransform`.
    pub fn can_transform(
        &self,
        target: &str,
        source: &str,
        time_ns: i64,
    ) -> Result<(), LookupError> {
        if target == source {
            return Ok(());
        }
        let check = |frame: &str, argument: &str| {
            let why = match self.find(frame) {
                _ if frame.is_empty() => "in tf2 frame_ids cannot be empty",
                _ if frame.starts_with('/') => "in tf2 frame_ids cannot start with a '/'",
                None => "frame does not exist",
                Some(number) => return Ok(number),
            };
            let message = format!(
                "Invalid frame ID \"{frame}\" passed to canTransform argument {argument} - {why}"
            );
            Err(LookupError::new(Unreachable::InvalidArgument, message))
        };
        let target = check(target, "target_frame")?;
        let source = check(source, "source_frame")?;
        walk(self, target, source, time_ns).map(|_| ())
    }

    /// Forgets all samples; frames stay known.
    pub fn clear(&mut self) {
        for frame in &mut self.frames {
            match &mut frame.cache {
                Some(Cache::Moving(samples)) => samples.clear(),
                // What is fixed is so after a jump of time, too.
                Some(Cache::Fixed(_)) | None => {}
            }
        }
    }

    /// Whether no frame was ever named.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.frames.len() == 1
    }

    /// The frames that were named, in that order.
    pub fn frames(&self) -> impl Iterator<Item = &str> {
        self.frames.iter().skip(1).map(|frame| frame.name.as_str())
    }

    /// Whether a frame was ever named.
    #[must_use]
    pub fn has_frame(&self, frame: &str) -> bool {
        self.find(frame).is_some()
    }

    /// The parent of a frame, by its newest sample.
    #[must_use]
    pub fn parent_of(&self, frame: &str) -> Option<&str> {
        let parent = self.frames[self.find(frame)?].cache.as_ref()?.newest().1;
        (parent != 0).then(|| self.name(parent))
    }

    /// Who broadcast a frame last.
    #[must_use]
    pub fn authority_of(&self, frame: &str) -> Option<&str> {
        let frame = &self.frames[self.find(frame)?];
        frame.cache.as_ref().map(|_| frame.authority.as_str())
    }

    /// The frames from the source up to where both chains meet and down to the target, both
    /// included, by the newest samples; none when they do not meet.
    #[must_use]
    pub fn chain(&self, target: &str, source: &str) -> Option<Vec<&str>> {
        let up = |frame: &str| {
            let mut chain = vec![self.find(frame)?];
            while let Some(cache) = chain.last().and_then(|&last| self.cache(last)) {
                let parent = cache.newest().1;
                // A circle has no top.
                if parent == 0 || chain.contains(&parent) {
                    break;
                }
                chain.push(parent);
            }
            Some(chain)
        };
        let (from, to) = (up(source)?, up(target)?);
        let meeting = from.iter().find(|frame| to.contains(frame))?;
        let rise = from.iter().take_while(|frame| *frame != meeting);
        let fall: Vec<_> = to.iter().take_while(|frame| *frame != meeting).collect();
        let whole = rise.chain([meeting]).chain(fall.into_iter().rev());
        Some(whole.map(|&frame| self.name(frame)).collect())
    }

    /// What is kept of each frame that has a parent, in the order in which frames were first named.
    pub fn kept_frames(&self) -> impl Iterator<Item = Kept<'_>> {
        self.frames.iter().skip(1).filter_map(|frame| {
            let cache = frame.cache.as_ref()?;
            let (newest_ns, parent) = cache.newest();
            let (kind, count, oldest_ns) = match cache {
                Cache::Moving(samples) => (Kind::Moving, samples.len(), samples.oldest_ns()?),
                Cache::Fixed(sample) => (Kind::Fixed, 1, sample.map(|_| 0)?),
            };
            Some(Kept {
                name: &frame.name,
                parent: self.name(parent),
                authority: &frame.authority,
                kind,
                count,
                newest_ns,
                oldest_ns,
            })
        })
    }

    pub(crate) fn name(&self, frame: FrameId) -> &str {
        &self.frames[frame].name
    }

    pub(crate) fn cache(&self, frame: FrameId) -> Option<&Cache> {
        self.frames[frame].cache.as_ref()
    }

    fn find(&self, frame: &str) -> Option<FrameId> {
        self.numbers.get(frame).copied()
    }

    fn number(&mut self, frame: &str) -> FrameId {
        if let Some(number) = self.find(frame) {
            return number;
        }
        let number = self.frames.len();
        self.frames.push(Frame { name: frame.into(), cache: None, authority: String::new() });
        self.numbers.insert(frame.into(), number);
        number
    }

    fn known(&self, frame: &str, argument: &str) -> Result<FrameId, LookupError> {
        let invalid = |why: &str| {
            let message = format!(
                "Invalid argument \"{frame}\" passed to lookupTransform argument {argument} - {why}"
            );
            Err(LookupError::new(Unreachable::InvalidArgument, message))
        };
        if frame.is_empty() {
            return invalid("in tf2 frame_ids cannot be empty");
        }
        if frame.starts_with('/') {
            return invalid("in tf2 frame_ids cannot start with a '/'");
        }
        self.find(frame).ok_or_else(|| {
            let message = format!(
                "\"{frame}\" passed to lookupTransform argument {argument} does not exist. "
            );
            LookupError::new(Unreachable::Lookup, message)
        })
    }
}
