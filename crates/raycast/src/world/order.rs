//! An order in which rays that have nothing in common follow those that have something.

use periplus_base::DVec3;

use crate::ray::Ray;

/// Fewer rays than this are not worth sorting.
const SORT_MIN: usize = 512;
/// More than this many would not stay in the cache.
const SORT_MAX: usize = 1 << 16;

/// Rays by their places in a list, each with a key of 32 bits.
pub(super) struct Loose {
    low_m: DVec3,
    cells_per_m: DVec3,
    places: Vec<u64>,
    spare: Vec<u64>,
}

impl Loose {
    /// For rays that start about the box of these corners.
    pub(super) fn new(low_m: DVec3, high_m: DVec3) -> Self {
        let per_m = |size: f64| if size > 0.0 { 127.99 / size } else { 0.0 };
        let cells_per_m = DVec3::from_array((high_m - low_m).to_array().map(per_m));
        Self { low_m, cells_per_m, places: Vec::new(), spare: Vec::new() }
    }

    pub(super) fn push(&mut self, place: u32, ray: &Ray) {
        let cell = (ray.origin_m - self.low_m) * self.cells_per_m;
        self.places.push(u64::from(key(cell, ray.direction)) << 32 | u64::from(place));
    }

    pub(super) fn is_full(&self) -> bool {
        self.places.len() >= SORT_MAX
    }

    /// The places of all rays that were pushed: those of like directions together, and of these
    /// such as start near each other, so that they find in the cache what the one before has
    /// fetched.
    pub(super) fn sorted(&mut self) -> impl Iterator<Item = usize> {
        if self.places.len() >= SORT_MIN {
            sort(&mut self.places, &mut self.spare);
        }
        self.places.drain(..).map(place)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the lower half")]
fn place(entry: u64) -> usize {
    entry as u32 as usize
}

/// From the top: the octant of the direction, the cell of the origin along a Z-order curve, the
/// direction within the octant.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers")]
fn key(cell: DVec3, direction: DVec3) -> u32 {
    let octant = u32::from(direction.x < 0.0) << 2
        | u32::from(direction.y < 0.0) << 1
        | u32::from(direction.z < 0.0);
    let [x, y, z] = cell.to_array().map(|x| spread((x as u32).min(127)));
    let direction = direction.abs();
    let fine = direction / (direction.x + direction.y + direction.z) * 15.99;
    octant << 29 | (x << 2 | y << 1 | z) << 8 | (fine.x as u32 & 15) << 4 | fine.y as u32 & 15
}

/// Seven bits, each two places apart.
fn spread(bits: u32) -> u32 {
    let bits = (bits | bits << 8) & 0x0000_700f;
    let bits = (bits | bits << 4) & 0x0004_30c3;
    (bits | bits << 2) & 0x0004_9249
}

/// By the upper half; entries of equal keys stay in order.
fn sort(entries: &mut Vec<u64>, spare: &mut Vec<u64>) {
    const BITS: u32 = 11;
    spare.clear();
    spare.resize(entries.len(), 0);
    for shift in [32, 32 + BITS, 32 + 2 * BITS] {
        #[expect(clippy::cast_possible_truncation, reason = "masked")]
        let digit = |entry: u64| (entry >> shift) as usize & ((1 << BITS) - 1);
        let mut starts = [0_usize; 1 << BITS];
        for &entry in &*entries {
            starts[digit(entry)] += 1;
        }
        let mut start = 0;
        for count in &mut starts {
            start += std::mem::replace(count, start);
        }
        for &entry in &*entries {
            let to = &mut starts[digit(entry)];
            spare[*to] = entry;
            *to += 1;
        }
        std::mem::swap(entries, spare);
    }
}

#[cfg(test)]
mod tests {
    use periplus_base::{DVec3, Stream};

    use super::{Loose, sort, spread};
    use crate::Ray;

    #[test]
    fn bits_are_spread() {
        assert_eq!(spread(0b101_1011), 0b1_000_001_001_000_001_001);
    }

    #[test]
    fn sorted_as_the_library_sorts() {
        let mut stream = Stream::keyed(3, "keys", 0);
        let mut entries: Vec<u64> = (0..3000).map(|n| stream.bits() << 32 | n).collect();
        let mut expected = entries.clone();
        expected.sort_unstable();
        sort(&mut entries, &mut Vec::new());
        assert_eq!(entries, expected);
    }

    #[test]
    fn every_ray_comes_once() {
        let mut stream = Stream::keyed(4, "rays", 0);
        for count in [0_u32, 1, 100, 5000] {
            let mut loose = Loose::new(DVec3::ZERO, DVec3::ONE);
            for place in 0..count {
                let mut point = || DVec3::from_array([0; 3].map(|_| 3.0 * stream.unit() - 1.0));
                loose.push(place, &Ray::new(point(), point()));
            }
            let mut places: Vec<usize> = loose.sorted().collect();
            places.sort_unstable();
            assert_eq!(places, (0..count as usize).collect::<Vec<_>>());
        }
    }
}
