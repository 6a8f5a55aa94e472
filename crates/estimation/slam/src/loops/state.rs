//! State of the loop search in a session file.

use super::{Candidate, Closure, Kept, Loops, Place, Task};
use crate::session::{Bytes, Fault, Pack, Reader, packed};

packed!(Closure { keyframes, old_from_new, is_accepted, region_m, agreeing, reason });
packed!(Task { stretch, anchor, place, covariance });
packed!(Place { keyframes, middle });
packed!(Candidate {
    anchor,
    middle,
    middle_from_anchor,
    information,
    region_m,
    share,
    is_unique,
    is_partial
});
packed!(Loops { places, place_from, searched_m, tasks, pending, fields, closures });

/// Maximum number of closure reports in lifelong mapping.
const MAX_REPORT_COUNT: usize = 300;

impl Pack for Kept {
    fn pack(&self, out: &mut Bytes) {
        self.place.pack(out);
        self.of.pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let (place, of) = Pack::unpack(from)?;
        Ok(Self { place, of, field: None })
    }
}

impl Loops {
    /// Starts a new stretch of path at a keyframe.
    pub(crate) fn restart(&mut self, keyframe: usize, travel_m: f64) {
        self.place_from = keyframe;
        self.searched_m = travel_m;
    }

    /// Keys have new numbers, or are gone. What was asked before is asked of another map.
    pub(crate) fn renumber(&mut self, number: &[Option<usize>]) {
        self.forget();
        // The first that is left at or after a key.
        let left = |keyframe: usize| number[keyframe..].iter().find_map(|it| *it);
        self.places.retain_mut(|place| {
            let mut there = number[place.keyframes.clone()].iter().filter_map(|it| *it);
            let (Some(first), last) = (there.next(), there.next_back()) else { return false };
            place.keyframes = first..last.unwrap_or(first) + 1;
            place.middle =
                left(place.middle).unwrap_or(first).clamp(first, place.keyframes.end - 1);
            true
        });
        self.place_from = left(self.place_from).unwrap_or(0);
        self.pending.retain_mut(|it| match (number[it.anchor], number[it.middle]) {
            (Some(anchor), Some(middle)) => {
                (it.anchor, it.middle) = (anchor, middle);
                true
            }
            _ => false,
        });
        self.closures.retain_mut(|it| match (number[it.keyframes.0], number[it.keyframes.1]) {
            (Some(old), Some(new)) => {
                it.keyframes = (old, new);
                true
            }
            _ => false,
        });
        // Those that are part of the map stay.
        let mut many = self.closures.len().saturating_sub(MAX_REPORT_COUNT);
        self.closures.retain(|it| {
            let stays = it.is_accepted || many == 0;
            many -= usize::from(!stays);
            stays
        });
    }

    /// True if all referenced keyframes and stretches exist.
    pub(crate) fn fits(&self, keyframes: usize) -> bool {
        let is_key = |keyframe: usize| keyframe < keyframes;
        let is_place = |place: usize| place < self.places.len();
        let is_way = |way: &std::ops::Range<usize>| way.start < way.end && way.end <= keyframes;
        self.places.iter().all(|it| is_way(&it.keyframes) && is_key(it.middle))
            && (is_key(self.place_from) || self.place_from == 0)
            && self
                .tasks
                .iter()
                .all(|it| is_way(&it.stretch) && is_key(it.anchor) && is_place(it.place))
            && self.pending.iter().all(|it| is_key(it.anchor) && is_key(it.middle))
            && self
                .fields
                .iter()
                .all(|it| is_place(it.place) && it.of.iter().all(|&(keyframe, _)| is_key(keyframe)))
            && self.closures.iter().all(|it| is_key(it.keyframes.0) && is_key(it.keyframes.1))
    }
}
