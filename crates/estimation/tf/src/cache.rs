//! Time cache of one frame.
//!
//! Source: `tf2/src/cache.cpp` and `static_cache.cpp`.

use std::collections::VecDeque;

use periplus_geometry::{DQuat, DVec3, Pose};

use crate::error::{LookupError, LookupErrorKind};
use crate::text::display_time;

/// Pose of a frame in its parent at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransformSample<P> {
    /// Time of the sample \[ns\].
    pub stamp_ns: i64,
    /// Parent frame.
    pub parent: P,
    /// Origin of the frame in the parent \[m\].
    pub translation: DVec3,
    /// Orientation as published: of near unit length.
    pub rotation: DQuat,
}

impl<P> TransformSample<P> {
    /// Returns `parent_from_child`.
    pub(crate) fn pose(&self) -> Pose {
        Pose::from_xyz_quaternion(self.translation.to_array(), self.rotation)
    }
}

/// Samples of a dynamic frame, kept for a duration before the newest one.
#[derive(Clone, Debug)]
pub struct TransformCache<P> {
    span_ns: i64,
    /// From the oldest to the newest; samples with equal stamps in the order of arrival.
    kept: VecDeque<TransformSample<P>>,
}

impl<P: Copy + PartialEq> TransformCache<P> {
    /// Creates a cache that keeps samples for `span_ns` \[ns\].
    #[must_use]
    pub fn new(span_ns: i64) -> Self {
        Self { span_ns, kept: VecDeque::new() }
    }

    /// Inserts a sample; returns false if it is older than all cached samples. An identical sample
    /// changes nothing.
    /// Expired samples are removed first, measured from the newest sample before this one.
    pub fn insert(&mut self, sample: TransformSample<P>) -> bool {
        if let Some(newest_ns) = self.newest_ns() {
            let oldest_ns = newest_ns.saturating_sub(self.span_ns);
            while self.kept.front().is_some_and(|oldest| oldest.stamp_ns < oldest_ns) {
                self.kept.pop_front();
            }
            if sample.stamp_ns < oldest_ns {
                return false;
            }
        }
        let at = self.kept.partition_point(|kept| kept.stamp_ns <= sample.stamp_ns);
        let mut equal = self.kept.range(..at).rev();
        let is_repeated = equal
            .by_ref()
            .take_while(|kept| kept.stamp_ns == sample.stamp_ns)
            .any(|kept| *kept == sample);
        if !is_repeated {
            self.kept.insert(at, sample);
        }
        true
    }

    /// Iterates over the samples from the newest to the oldest.
    pub fn newest_first(&self) -> impl Iterator<Item = &TransformSample<P>> {
        self.kept.iter().rev()
    }

    /// Returns the number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.kept.len()
    }

    /// Returns true if there is no sample.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Returns the newest stamp \[ns\].
    #[must_use]
    pub fn newest_ns(&self) -> Option<i64> {
        self.kept.back().map(|sample| sample.stamp_ns)
    }

    /// Returns the oldest stamp \[ns\].
    #[must_use]
    pub fn oldest_ns(&self) -> Option<i64> {
        self.kept.front().map(|sample| sample.stamp_ns)
    }

    /// Returns the newest sample.
    #[must_use]
    pub fn newest(&self) -> Option<&TransformSample<P>> {
        self.kept.back()
    }

    /// Removes all samples.
    pub fn clear(&mut self) {
        self.kept.clear();
    }

    /// Returns the pose at a time \[ns\], 0 for the newest. Between two samples, positions are
    /// interpolated linearly and orientations spherically (slerp); if the parent changed between
    /// them, the earlier sample is returned.
    ///
    /// # Errors
    /// When the time is outside the cached time range.
    pub fn at(&self, time_ns: i64) -> Result<TransformSample<P>, LookupError> {
        let (Some(oldest), Some(newest)) = (self.kept.front(), self.kept.back()) else {
            return Err(LookupError::new(LookupErrorKind::NoDataForExtrapolation, String::new()));
        };
        if time_ns == 0 || time_ns == newest.stamp_ns {
            return Ok(*newest);
        }
        if time_ns == oldest.stamp_ns {
            return Ok(*oldest);
        }
        let asked = display_time(time_ns);
        let beyond = |kind, words: String| Err(LookupError::new(kind, words));
        if self.kept.len() == 1 {
            let only = display_time(newest.stamp_ns);
            return beyond(
                LookupErrorKind::NoDataForExtrapolation,
                format!(
                    "Lookup would require extrapolation at time {asked}, but only time {only} is in \
                     the buffer"
                ),
            );
        }
        if time_ns > newest.stamp_ns {
            let latest = display_time(newest.stamp_ns);
            return beyond(
                LookupErrorKind::Forward,
                format!(
                    "Lookup would require extrapolation into the future.  Requested time {asked} but \
                     the latest data is at time {latest}"
                ),
            );
        }
        if time_ns < oldest.stamp_ns {
            let earliest = display_time(oldest.stamp_ns);
            return beyond(
                LookupErrorKind::Backward,
                format!(
                    "Lookup would require extrapolation into the past.  Requested time {asked} but \
                     the earliest data is at time {earliest}"
                ),
            );
        }
        let after = self.kept.partition_point(|kept| kept.stamp_ns <= time_ns);
        let (older, newer) = (self.kept[after - 1], self.kept[after]);
        Ok(if older.parent == newer.parent { between(older, newer, time_ns) } else { older })
    }
}

fn between<P: Copy>(
    older: TransformSample<P>,
    newer: TransformSample<P>,
    time_ns: i64,
) -> TransformSample<P> {
    let ratio = (time_ns - older.stamp_ns) as f64 / (newer.stamp_ns - older.stamp_ns) as f64;
    TransformSample {
        stamp_ns: time_ns,
        translation: older.translation * (1.0 - ratio) + newer.translation * ratio,
        rotation: turned_between(older.rotation, newer.rotation, ratio),
        ..older
    }
}

/// Spherical interpolation (slerp) along the shorter arc.
fn turned_between(from: DQuat, to: DQuat, ratio: f64) -> DQuat {
    let (from, to) = (from.normalize(), to.normalize());
    let dot = from.dot(to);
    let to = if dot < 0.0 { -to } else { to };
    // Half the angle between them; also exact for small angles.
    let angle = 2.0 * libm::atan2((from - to).length(), (from + to).length());
    let sine = libm::sin(angle);
    if sine < 1e-12 {
        return from;
    }
    let mixed =
        from * (libm::sin((1.0 - ratio) * angle) / sine) + to * (libm::sin(ratio * angle) / sine);
    mixed.normalize()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn sample(parent: char, stamp_ns: i64) -> TransformSample<char> {
        TransformSample { stamp_ns, parent, translation: DVec3::ZERO, rotation: DQuat::IDENTITY }
    }

    fn order(samples: &TransformCache<char>) -> String {
        samples.newest_first().map(|sample| sample.parent).collect()
    }

    #[test]
    fn samples_are_in_the_order_of_time_and_old_ones_go() {
        let mut samples = TransformCache::new(10);
        let first = [('a', 0), ('b', 10), ('c', 5), ('d', 3), ('e', 8), ('f', 8)];
        for (name, stamp_ns) in first.into_iter().chain(first.into_iter().rev()) {
            assert!(samples.insert(sample(name, stamp_ns)));
        }
        assert_eq!(order(&samples), "bfecda");
        assert!(samples.insert(sample('h', 15)));
        assert!(!samples.insert(sample('i', 0)));
        assert_eq!(order(&samples), "hbfec");
    }

    proptest! {
        #[test]
        fn a_turn_is_even(yaw_rad in -3.0..3.0_f64, ratio in 0.0..1.0_f64, negated in any::<bool>()) {
            let to = DQuat::from_rotation_z(yaw_rad);
            let to = if negated { -to } else { to };
            let mixed = turned_between(DQuat::IDENTITY, to, ratio);
            let expected = DQuat::from_rotation_z(yaw_rad * ratio);
            prop_assert!(mixed.dot(expected).abs() > 1.0 - 1e-12);
        }
    }
}
