//! Compressed clouds.

use crate::cloud::{Cloud, Point};

/// Positions quantized to a millimetre or less, relative to a center.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedPlaces {
    middle: [f32; 2],
    /// Quantization step: 2 to the power of minus this \[m\].
    power: u8,
    steps: Box<[[i16; 2]]>,
}

/// Exponent of the finest step: half a millimetre up to 16 m from the center, coarser powers of two
/// beyond.
const MAX_STEP_BITS: u8 = 11;
/// Maximum number of steps.
const MAX_STEP_COUNT: f32 = 32_767.0;

impl PackedPlaces {
    /// Packs positions; those beyond 32 km from the center are clamped.
    #[must_use]
    pub fn new(places: &[[f32; 2]], middle: [f32; 2]) -> Self {
        let offsets = || places.iter().map(|[x, y]| [x - middle[0], y - middle[1]]);
        let farthest = offsets().flatten().fold(0.0_f32, |most, it| most.max(it.abs()));
        let power = (0..=MAX_STEP_BITS)
            .rev()
            .find(|&it| farthest / step_m(it) <= MAX_STEP_COUNT)
            .unwrap_or(0);
        let per_metre = 1.0 / step_m(power);
        let steps = offsets().map(|it| it.map(|metres| (metres * per_metre).round() as i16));
        Self { middle, power, steps: steps.collect() }
    }

    /// Positions \[m\].
    pub fn iter(&self) -> impl ExactSizeIterator<Item = [f32; 2]> {
        let (step, [x, y]) = (step_m(self.power), self.middle);
        self.steps.iter().map(move |it| [x + step * f32::from(it[0]), y + step * f32::from(it[1])])
    }

    /// Center \[m\].
    #[must_use]
    pub fn middle(&self) -> [f32; 2] {
        self.middle
    }

    /// Number of positions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// True if there are no positions.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Approximate size in memory \[bytes\].
    #[must_use]
    pub fn size(&self) -> usize {
        self.steps.len() * 4
    }
}

fn step_m(power: u8) -> f32 {
    1.0 / f32::from(1_u16 << power)
}

/// Cloud in a quarter of the memory, for clouds that are rarely used: positions quantized to a
/// millimetre or less, normals to less than half a degree. An unpacked cloud packs to the same
/// bytes again.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedCloud {
    places: PackedPlaces,
    /// Normals, scaled by 127.
    normals: Box<[[i8; 2]]>,
    /// Visibility flags, eight per byte.
    followed: Box<[u8]>,
}

impl PackedCloud {
    /// Packs a cloud.
    #[must_use]
    pub fn new(cloud: &Cloud) -> Self {
        let points = cloud.points();
        let places: Vec<[f32; 2]> = points.iter().map(|p| [p.x, p.y]).collect();
        let mut followed = vec![0_u8; points.len().div_ceil(8)];
        for (at, _) in cloud.followed().iter().enumerate().filter(|it| *it.1) {
            followed[at / 8] |= 1 << (at % 8);
        }
        let part = |it: f32| (it * 127.0).round() as i8;
        Self {
            places: PackedPlaces::new(&places, cloud.origin()),
            normals: points.iter().map(|p| [part(p.nx), part(p.ny)]).collect(),
            followed: followed.into(),
        }
    }

    /// Unpacks the cloud.
    #[must_use]
    pub fn cloud(&self) -> Cloud {
        let points = self.places.iter().zip(&self.normals).enumerate();
        let points = points.map(|(at, ([x, y], &[nx, ny]))| {
            let (nx, ny) = (f32::from(nx) / 127.0, f32::from(ny) / 127.0);
            (Point { x, y, nx, ny }, self.followed[at / 8] >> (at % 8) & 1 == 1)
        });
        Cloud::sorted(points, self.places.middle())
    }

    /// Positions of the points, relative to the scanner.
    #[must_use]
    pub fn places(&self) -> &PackedPlaces {
        &self.places
    }

    /// Approximate size in memory \[bytes\].
    #[must_use]
    pub fn size(&self) -> usize {
        self.places.size() + self.normals.len() * 2 + self.followed.len()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::CloudSettings;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn what_is_unpacked_is_nearly_the_same_and_packs_to_the_same(
            ranges in prop::collection::vec(0.2_f32..50.0, 20..200),
            x in -2.0_f32..2.0,
        ) {
            let step = std::f32::consts::TAU / ranges.len() as f32;
            let ends = ranges.iter().enumerate().map(|(at, range)| {
                let (s, c) = libm::sincosf(at as f32 * step);
                Some([x + range * c, range * s])
            });
            let cloud = Cloud::new(ends, [x, 0.0], step, &CloudSettings::default());
            let unpacked = PackedCloud::new(&cloud).cloud();
            prop_assert_eq!(unpacked.points().len(), cloud.points().len());
            for point in cloud.points() {
                let near = unpacked.nearest(point.x, point.y, 0.01);
                prop_assert!(near.is_some_and(|(_, squared)| squared < 0.0016 * 0.0016));
            }
            let again = PackedCloud::new(&unpacked).cloud();
            prop_assert_eq!(again.points(), unpacked.points());
            prop_assert_eq!(again.followed(), unpacked.followed());
        }
    }
}
