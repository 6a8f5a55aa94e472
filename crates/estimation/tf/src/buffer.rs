//! Transform buffer: cached transforms of all frames.
//!
//! Source: `tf2/src/buffer_core.cpp`.

use std::collections::BTreeMap;

use periplus_geometry::{DQuat, DVec3, Pose};

use crate::cache::{TransformCache, TransformSample};
use crate::error::{LookupError, LookupErrorKind, RejectedTransform};
use crate::walk::walk;

/// Default duration for which samples are kept \[ns\]; the default of tf2.
pub const CACHE_NS: i64 = 10_000_000_000;

/// Largest deviation of a squared quaternion norm from 1 (`QUATERNION_NORMALIZATION_TOLERANCE` of
/// tf2).
const QUATERNION_NORM_TOLERANCE_RATIO: f64 = 10e-3;

/// A transform as a broadcaster publishes it.
#[derive(Clone, Debug, PartialEq)]
pub struct StampedTransform {
    /// Parent frame. A leading slash is dropped.
    pub parent: String,
    /// Child frame. A leading slash is dropped.
    pub child: String,
    /// Time of the transform \[ns\].
    pub stamp_ns: i64,
    /// Origin of the child in the parent \[m\].
    pub translation: DVec3,
    /// Orientation of the child in the parent; the length must be near 1.
    pub rotation: DQuat,
}

impl StampedTransform {
    /// Creates the transform `parent_from_child` at a time \[ns\].
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

/// Validity of a transform in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransformKind {
    /// Valid at its stamp; from `/tf`.
    Moving,
    /// Valid at all times; from `/tf_static`.
    Fixed,
}

/// Result of a lookup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResolvedTransform {
    /// Time of the transform \[ns\]: the requested time, or the latest common time.
    pub time_ns: i64,
    /// Turns coordinates in the source into coordinates in the target.
    pub target_from_source: Pose,
}

/// Lookup across time: the pose of the source frame at one time in the target frame at another,
/// through a frame that is fixed between both times.
#[derive(Clone, Copy, Debug)]
pub struct TransformLookup<'a> {
    /// Target frame.
    pub target: &'a str,
    /// Time in the target frame \[ns\].
    pub target_time_ns: i64,
    /// Source frame.
    pub source: &'a str,
    /// Time in the source frame \[ns\].
    pub source_time_ns: i64,
    /// Frame that does not move between the two times.
    pub fixed: &'a str,
}

/// Index of a frame. 0 is not a frame.
pub(crate) type FrameId = usize;

/// Cached samples of a frame.
#[derive(Clone, Debug)]
pub(crate) enum Cache {
    Moving(TransformCache<FrameId>),
    Fixed(Option<TransformSample<FrameId>>),
}

impl Cache {
    /// Returns the sample at a time; that of a static transform has the requested time.
    pub(crate) fn at(&self, time_ns: i64) -> Result<TransformSample<FrameId>, LookupError> {
        match self {
            Self::Moving(samples) => samples.at(time_ns),
            Self::Fixed(Some(sample)) => Ok(TransformSample { stamp_ns: time_ns, ..*sample }),
            Self::Fixed(None) => {
                Err(LookupError::new(LookupErrorKind::NoDataForExtrapolation, String::new()))
            }
        }
    }

    /// Returns the newest stamp (0 for a static transform) and the parent at that time (0 for
    /// none).
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

/// Transforms between frames over time.
#[derive(Clone, Debug)]
pub struct Buffer {
    span_ns: i64,
    /// In the order in which they were first named; the first is not a frame.
    frames: Vec<Frame>,
    numbers: BTreeMap<String, FrameId>,
}

impl Default for Buffer {
    fn default() -> Self {
        Self::new(CACHE_NS)
    }
}

/// Status of a frame that has a parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameStatus<'a> {
    /// Name of the frame.
    pub name: &'a str,
    /// Parent in the newest sample.
    pub parent: &'a str,
    /// Authority (publisher) of the newest sample.
    pub authority: &'a str,
    /// Static or dynamic.
    pub kind: TransformKind,
    /// Number of cached samples.
    pub count: usize,
    /// Stamp of the newest sample \[ns\]; 0 for a static transform.
    pub newest_ns: i64,
    /// Stamp of the oldest sample \[ns\]; 0 for a static transform.
    pub oldest_ns: i64,
}

/// Shortest duration over which a rate is computed \[ns\].
const SHORTEST_NS: i64 = 100_000;

impl FrameStatus<'_> {
    /// Returns the average rate as tf2 computes it \[Hz\]: the sample count divided by the time
    /// from the oldest to the newest sample. A single sample results in 10000 Hz.
    #[must_use]
    pub fn rate_hz(&self) -> f64 {
        self.count as f64 * 1e9 / (self.newest_ns - self.oldest_ns).max(SHORTEST_NS) as f64
    }
}

impl Buffer {
    /// Creates a buffer that keeps the samples of a frame for `span_ns` before its newest one
    /// \[ns\].
    #[must_use]
    pub fn new(span_ns: i64) -> Self {
        let nowhere = Frame { name: "NO_PARENT".into(), cache: None, authority: String::new() };
        Self { span_ns, frames: vec![nowhere], numbers: BTreeMap::new() }
    }

    /// Inserts a transform and stores the name of its authority. If a frame changes between static
    /// and dynamic, its older samples are dropped.
    ///
    /// # Errors
    /// The reason for which the transform is rejected. The buffer is unchanged then.
    pub fn set(
        &mut self,
        it: &StampedTransform,
        authority: &str,
        kind: TransformKind,
    ) -> Result<(), RejectedTransform> {
        let parent = it.parent.strip_prefix('/').unwrap_or(&it.parent);
        let child = it.child.strip_prefix('/').unwrap_or(&it.child);
        if child.is_empty() {
            return Err(RejectedTransform::NoChild);
        }
        if parent.is_empty() {
            return Err(RejectedTransform::NoParent(child.into()));
        }
        if child == parent {
            return Err(RejectedTransform::SelfTransform(child.into()));
        }
        if !it.translation.is_finite() || !it.rotation.is_finite() {
            return Err(RejectedTransform::NotANumber(child.into()));
        }
        let off = (it.rotation.length_squared() - 1.0).abs();
        if off >= QUATERNION_NORM_TOLERANCE_RATIO {
            return Err(RejectedTransform::Denormalized(child.into(), it.rotation.to_array()));
        }
        let child_id = self.number(child);
        let parent_id = self.number(parent);
        let sample = TransformSample {
            stamp_ns: it.stamp_ns,
            parent: parent_id,
            translation: it.translation,
            rotation: it.rotation,
        };
        let span_ns = self.span_ns;
        let frame = &mut self.frames[child_id];
        match (&mut frame.cache, kind) {
            (Some(Cache::Moving(samples)), TransformKind::Moving) => {
                if !samples.insert(sample) {
                    return Err(RejectedTransform::OldData(child.into(), it.stamp_ns));
                }
            }
            (cache, TransformKind::Moving) => {
                let mut samples = TransformCache::new(span_ns);
                samples.insert(sample);
                *cache = Some(Cache::Moving(samples));
            }
            (cache, TransformKind::Fixed) => *cache = Some(Cache::Fixed(Some(sample))),
        }
        authority.clone_into(&mut frame.authority);
        Ok(())
    }

    /// Returns `target_from_source` at a time \[ns\]; 0 requests the latest common time of all
    /// frames in the chain. The transform of a frame to itself always exists, also for an unknown
    /// frame.
    ///
    /// # Errors
    /// The reason for which there is no transform.
    pub fn lookup(
        &self,
        target: &str,
        source: &str,
        time_ns: i64,
    ) -> Result<ResolvedTransform, LookupError> {
        if target == source {
            let newest = || Some(self.frames[self.find(target)?].cache.as_ref()?.newest().0);
            let time_ns = if time_ns == 0 { newest().unwrap_or(0) } else { time_ns };
            return Ok(ResolvedTransform { time_ns, target_from_source: Pose::IDENTITY });
        }
        let target = self.known(target, "target_frame")?;
        let source = self.known(source, "source_frame")?;
        walk(self, target, source, time_ns)
    }

    /// Returns `target_from_source`, each frame at its own time.
    ///
    /// # Errors
    /// The reason for which there is no transform.
    pub fn lookup_across(
        &self,
        lookup: TransformLookup<'_>,
    ) -> Result<ResolvedTransform, LookupError> {
        let TransformLookup { target, target_time_ns, source, source_time_ns, fixed } = lookup;
        self.known(target, "target_frame")?;
        self.known(source, "source_frame")?;
        self.known(fixed, "fixed_frame")?;
        let fixed_from_source = self.lookup(fixed, source, source_time_ns)?;
        let target_from_fixed = self.lookup(target, fixed, target_time_ns)?;
        Ok(ResolvedTransform {
            time_ns: target_from_fixed.time_ns,
            target_from_source: target_from_fixed.target_from_source
                * fixed_from_source.target_from_source,
        })
    }

    /// Checks that [`Buffer::lookup`] would succeed.
    ///
    /// # Errors
    /// The reason, worded as by `canTransform` of tf2.
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
            Err(LookupError::new(LookupErrorKind::InvalidArgument, message))
        };
        let target = check(target, "target_frame")?;
        let source = check(source, "source_frame")?;
        walk(self, target, source, time_ns).map(|_| ())
    }

    /// Drops all samples of dynamic frames; the frames stay known.
    pub fn clear(&mut self) {
        for frame in &mut self.frames {
            match &mut frame.cache {
                Some(Cache::Moving(samples)) => samples.clear(),
                // Static transforms stay valid after a time jump.
                Some(Cache::Fixed(_)) | None => {}
            }
        }
    }

    /// Returns true if no frame was ever named.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.frames.len() == 1
    }

    /// Returns the names of all frames, in the order in which they were first named.
    pub fn frames(&self) -> impl Iterator<Item = &str> {
        self.frames.iter().skip(1).map(|frame| frame.name.as_str())
    }

    /// Returns true if a frame was ever named.
    #[must_use]
    pub fn has_frame(&self, frame: &str) -> bool {
        self.find(frame).is_some()
    }

    /// Returns the parent of a frame in its newest sample.
    #[must_use]
    pub fn parent_of(&self, frame: &str) -> Option<&str> {
        let parent = self.frames[self.find(frame)?].cache.as_ref()?.newest().1;
        (parent != 0).then(|| self.name(parent))
    }

    /// Returns the authority (publisher) of the newest sample of a frame.
    #[must_use]
    pub fn authority_of(&self, frame: &str) -> Option<&str> {
        let frame = &self.frames[self.find(frame)?];
        frame.cache.as_ref().map(|_| frame.authority.as_str())
    }

    /// Returns the frames from the source up to the common ancestor and down to the target, both
    /// included, by the newest samples; none if the frames are not connected.
    #[must_use]
    pub fn chain(&self, target: &str, source: &str) -> Option<Vec<&str>> {
        let up = |frame: &str| {
            let mut chain = vec![self.find(frame)?];
            while let Some(cache) = chain.last().and_then(|&last| self.cache(last)) {
                let parent = cache.newest().1;
                // A loop has no root.
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

    /// Iterates over the status of each frame that has a parent, in the order in which frames were
    /// first named.
    pub fn kept_frames(&self) -> impl Iterator<Item = FrameStatus<'_>> {
        self.frames.iter().skip(1).filter_map(|frame| {
            let cache = frame.cache.as_ref()?;
            let (newest_ns, parent) = cache.newest();
            let (kind, count, oldest_ns) = match cache {
                Cache::Moving(samples) => {
                    (TransformKind::Moving, samples.len(), samples.oldest_ns()?)
                }
                Cache::Fixed(sample) => (TransformKind::Fixed, 1, sample.map(|_| 0)?),
            };
            Some(FrameStatus {
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
            Err(LookupError::new(LookupErrorKind::InvalidArgument, message))
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
            LookupError::new(LookupErrorKind::Lookup, message)
        })
    }
}
