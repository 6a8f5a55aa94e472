//! Absolute and relative pose errors.

use periplus_geometry::{DVec3, Pose};

use crate::association::PosePair;
use crate::pairs::PairSelection;

/// Quantity of a pose error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PoseRelation {
    /// Length of the translation \[m\] (`trans_part` of `evo`).
    #[default]
    TranslationM,
    /// Angle of the rotation \[rad\], 0 to π (`angle_rad`).
    RotationRad,
    /// Angle of the rotation \[deg\], 0 to 180 (`angle_deg`).
    RotationDeg,
    /// Frobenius norm of the rotation matrix minus the identity, without unit (`rot_part`).
    RotationPart,
    /// Frobenius norm of the homogeneous matrix minus the identity; metres and radians are mixed (`full`).
    FullTransformation,
}

impl PoseRelation {
    /// All relations.
    pub const ALL: [Self; 5] = [
        Self::TranslationM,
        Self::RotationRad,
        Self::RotationDeg,
        Self::RotationPart,
        Self::FullTransformation,
    ];

    /// Returns the name that `evo_ape` uses.
    #[must_use]
    pub fn evo_name(self) -> &'static str {
        match self {
            Self::TranslationM => "trans_part",
            Self::RotationRad => "angle_rad",
            Self::RotationDeg => "angle_deg",
            Self::RotationPart => "rot_part",
            Self::FullTransformation => "full",
        }
    }

    /// Returns the size of an error.
    #[must_use]
    pub fn of(self, error: Pose) -> f64 {
        let angle_rad = || error.distance_to(Pose::IDENTITY).1;
        let rotation_square = || {
            let difference = |axis: DVec3| (error.rotation * axis - axis).length_squared();
            difference(DVec3::X) + difference(DVec3::Y) + difference(DVec3::Z)
        };
        match self {
            Self::TranslationM => error.translation.length(),
            Self::RotationRad => angle_rad(),
            Self::RotationDeg => angle_rad().to_degrees(),
            Self::RotationPart => rotation_square().sqrt(),
            Self::FullTransformation => {
                (rotation_square() + error.translation.length_squared()).sqrt()
            }
        }
    }
}

/// Returns the absolute pose error of each pair: the pose of the reference in the frame of the estimate.
///
/// The metric of Sturm et al. 2012, "A benchmark for the evaluation of RGB-D SLAM systems"; its root mean
/// square over translations is the ATE. Align the pairs first, see [`align`](crate::align).
#[must_use]
pub fn ape(pairs: &[PosePair], relation: PoseRelation) -> Vec<f64> {
    pairs.iter().map(|it| relation.of(it.estimate.inverse() * it.reference)).collect()
}

/// Returns the relative pose errors: the difference of the motions between the poses of each selected pair.
/// The estimate selects the pairs. An alignment without scale has no effect.
///
/// The metric of Sturm et al. 2012 and Kümmerle et al. 2009.
#[must_use]
pub fn rpe(pairs: &[PosePair], relation: PoseRelation, selection: PairSelection) -> Vec<f64> {
    let estimates: Vec<Pose> = pairs.iter().map(|it| it.estimate).collect();
    let error = |(from, to): (usize, usize)| {
        let (from, to) = (&pairs[from], &pairs[to]);
        let reference = from.reference.inverse() * to.reference;
        let estimate = from.estimate.inverse() * to.estimate;
        relation.of(reference.inverse() * estimate)
    };
    selection.indices(&estimates).into_iter().map(error).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use periplus_geometry::Pose2;
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn sizes_of_an_error() {
        // Three and four metres, and a quarter turn: two columns of the matrix move by the root of two.
        let error = Pose::from(Pose2::new(3.0, 4.0, FRAC_PI_2));
        let check = |relation: PoseRelation, expected: f64| {
            assert!((relation.of(error) - expected).abs() < 1e-12, "{relation:?}");
        };
        check(PoseRelation::TranslationM, 5.0);
        check(PoseRelation::RotationRad, FRAC_PI_2);
        check(PoseRelation::RotationDeg, 90.0);
        check(PoseRelation::RotationPart, 2.0);
        check(PoseRelation::FullTransformation, 29_f64.sqrt());
    }

    fn pairs(poses: &[(f64, f64)]) -> Vec<PosePair> {
        let pose = |x_m: f64| Pose::from(Pose2::new(x_m, 0.0, 0.0));
        let pair = |&(reference, estimate): &(f64, f64)| PosePair {
            stamp_s: 0.0,
            reference: pose(reference),
            estimate: pose(estimate),
        };
        poses.iter().map(pair).collect()
    }

    #[test]
    fn one_wrong_step_remains_in_the_absolute_error_only() {
        let pairs = pairs(&[(0.0, 0.0), (1.0, 1.5), (2.0, 2.5), (3.0, 3.5)]);
        assert_eq!(ape(&pairs, PoseRelation::TranslationM), [0.0, 0.5, 0.5, 0.5]);
        let errors = rpe(&pairs, PoseRelation::TranslationM, PairSelection::default());
        assert_eq!(errors, [0.5, 0.0, 0.0]);
    }

    proptest! {
        #[test]
        fn relative_errors_do_not_depend_on_the_alignment(
            steps in prop::collection::vec(prop::array::uniform3(-PI..PI), 2..20),
            at in prop::array::uniform3(-PI..PI),
        ) {
            let pose = |[x_m, y_m, yaw_rad]: [f64; 3]| Pose::from(Pose2::new(x_m, y_m, yaw_rad));
            let pairs: Vec<PosePair> = steps.windows(2).map(|it| PosePair {
                stamp_s: 0.0, reference: pose(it[0]), estimate: pose(it[1]),
            }).collect();
            let moved: Vec<PosePair> =
                pairs.iter().map(|it| PosePair { estimate: pose(at) * it.estimate, ..*it }).collect();
            for relation in PoseRelation::ALL {
                let selection = PairSelection::default();
                let (a, b) = (rpe(&pairs, relation, selection), rpe(&moved, relation, selection));
                prop_assert_eq!(a.len(), b.len());
                for (a, b) in a.iter().zip(b) {
                    prop_assert!((a - b).abs() < 1e-6, "{:?}", relation);
                }
            }
        }
    }
}
