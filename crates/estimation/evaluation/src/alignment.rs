//! Alignment of an estimated trajectory with its reference.

use std::fmt;

use nalgebra::{Matrix3, Vector3};
use periplus_geometry::{DQuat, DVec3, Pose, Pose2};

use crate::association::PosePair;

/// Freedom of an alignment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AlignmentMethod {
    /// No alignment.
    None,
    /// First poses on each other (`--align_origin` of `evo`).
    Origin,
    /// Translation and yaw, least squares over all positions. A base frame above the floor is no error.
    #[default]
    Se2,
    /// Rigid transform in space, least squares over all positions (`--align` of `evo`).
    Se3,
    /// Rigid transform in space and scale (`--align --correct_scale` of `evo`).
    Sim3,
    /// Scale alone (`--correct_scale` of `evo`).
    Scale,
}

/// Transform `reference_from_estimate` with a scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Rigid part.
    pub reference_from_estimate: Pose,
    /// Factor of the estimated positions, before the rigid part.
    pub scale: f64,
}

/// Positions that do not determine the alignment: too few, or on a line (in space) or in one point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Degenerate {
    /// Number of poses.
    pub pose_count: usize,
}

impl fmt::Display for Degenerate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.pose_count;
        write!(
            f,
            "the {count} associated positions do not determine the alignment; align in the plane or at the \
             origin, or use a run that turns"
        )
    }
}

impl std::error::Error for Degenerate {}

impl Similarity {
    /// Identity transform.
    pub const IDENTITY: Self = Self { reference_from_estimate: Pose::IDENTITY, scale: 1.0 };

    /// Transforms an estimated pose to the frame of the reference.
    #[must_use]
    pub fn apply(&self, estimate: Pose) -> Pose {
        let scaled = Pose { translation: estimate.translation * self.scale, ..estimate };
        self.reference_from_estimate * scaled
    }

    /// Transforms the estimates of all pairs.
    #[must_use]
    pub fn apply_to(&self, pairs: &[PosePair]) -> Vec<PosePair> {
        pairs.iter().map(|it| PosePair { estimate: self.apply(it.estimate), ..*it }).collect()
    }
}

/// Computes the alignment that minimizes the sum of squared distances of the positions.
///
/// # Errors
/// When the positions do not determine it.
pub fn align(pairs: &[PosePair], method: AlignmentMethod) -> Result<Similarity, Degenerate> {
    let rigid = |reference_from_estimate| Similarity { reference_from_estimate, scale: 1.0 };
    match method {
        AlignmentMethod::None => Ok(Similarity::IDENTITY),
        AlignmentMethod::Origin => {
            let first = pairs.first().ok_or(Degenerate { pose_count: 0 })?;
            Ok(rigid(first.reference * first.estimate.inverse()))
        }
        AlignmentMethod::Se2 => planar(pairs).map(rigid),
        AlignmentMethod::Se3 => umeyama(pairs).map(|it| rigid(it.pose(1.0))),
        AlignmentMethod::Sim3 => umeyama(pairs)
            .map(|it| Similarity { reference_from_estimate: it.pose(it.scale), scale: it.scale }),
        AlignmentMethod::Scale => umeyama(pairs)
            .map(|it| Similarity { reference_from_estimate: Pose::IDENTITY, scale: it.scale }),
    }
}

/// Means of the reference and of the estimated positions \[m\].
fn means(pairs: &[PosePair]) -> (DVec3, DVec3) {
    let count = pairs.len() as f64;
    let mean = |of: fn(&PosePair) -> DVec3| pairs.iter().map(of).sum::<DVec3>() / count;
    (mean(|it| it.reference.translation), mean(|it| it.estimate.translation))
}

/// Rotation about z and translation: Umeyama 1991 in two dimensions, and the mean difference of heights.
fn planar(pairs: &[PosePair]) -> Result<Pose, Degenerate> {
    let (to, from) = means(pairs);
    let (mut dot, mut cross) = (0.0, 0.0);
    for pair in pairs {
        let (a, b) = (pair.estimate.translation - from, pair.reference.translation - to);
        dot += a.x * b.x + a.y * b.y;
        cross += a.x * b.y - a.y * b.x;
    }
    if pairs.len() < 2 || libm::hypot(dot, cross) <= f64::EPSILON * pairs.len() as f64 {
        return Err(Degenerate { pose_count: pairs.len() });
    }
    let turn = Pose2::new(0.0, 0.0, libm::atan2(cross, dot));
    let (x_m, y_m) = turn.transform_point(from.x, from.y);
    let pose = Pose::from(Pose2 { x_m: to.x - x_m, y_m: to.y - y_m, ..turn });
    Ok(Pose::from_xyz(0.0, 0.0, to.z - from.z) * pose)
}

struct Umeyama {
    to: DVec3,
    from: DVec3,
    rotation: DQuat,
    scale: f64,
}

impl Umeyama {
    /// Equation 41.
    fn pose(&self, scale: f64) -> Pose {
        let translation = self.to - scale * (self.rotation * self.from);
        Pose { translation, rotation: self.rotation }
    }
}

/// Umeyama 1991, "Least-squares estimation of transformation parameters between two point patterns",
/// equations 34 to 43.
fn umeyama(pairs: &[PosePair]) -> Result<Umeyama, Degenerate> {
    let degenerate = Degenerate { pose_count: pairs.len() };
    if pairs.is_empty() {
        return Err(degenerate);
    }
    let (to, from) = means(pairs);
    let count = pairs.len() as f64;
    let (mut covariance, mut variance) = (Matrix3::<f64>::zeros(), 0.0);
    for pair in pairs {
        let (a, b) = (pair.estimate.translation - from, pair.reference.translation - to);
        covariance += Vector3::from(b.to_array()) * Vector3::from(a.to_array()).transpose() / count;
        variance += a.length_squared() / count;
    }
    // The iteration does not end with numbers that are not finite.
    if !covariance.iter().all(|it| it.is_finite()) {
        return Err(degenerate);
    }
    let svd = covariance.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return Err(degenerate) };
    let singular = svd.singular_values;
    if singular.iter().filter(|it| **it > f64::EPSILON).count() < 2 {
        return Err(degenerate);
    }
    // Singular values are in descending order: the sign belongs to the last one.
    let mut signs = Vector3::new(1.0, 1.0, 1.0);
    if u.determinant() * v_t.determinant() < 0.0 {
        signs.z = -1.0;
    }
    let rotation = u * Matrix3::from_diagonal(&signs) * v_t;
    let columns =
        [0, 1, 2].map(|index| DVec3::from_array(rotation.column(index).into_owned().into()));
    let rotation = quaternion(columns);
    let scale = singular.dot(&signs) / variance;
    Ok(Umeyama { to, from, rotation, scale })
}

/// Quaternion of a rotation matrix of columns.
fn quaternion([x, y, z]: [DVec3; 3]) -> DQuat {
    // Four candidates, of which the one with the largest component is exact (Shepperd 1978).
    let squares = [
        1.0 + x.x + y.y + z.z,
        1.0 + x.x - y.y - z.z,
        1.0 - x.x + y.y - z.z,
        1.0 - x.x - y.y + z.z,
    ];
    let largest = (0..4).fold(0, |best, it| if squares[it] > squares[best] { it } else { best });
    let (a, b, c) = (y.z - z.y, z.x - x.z, x.y - y.x);
    let (d, e, f) = (x.y + y.x, x.z + z.x, y.z + z.y);
    let [w, i, j, k] = match largest {
        0 => [squares[0], a, b, c],
        1 => [a, squares[1], d, e],
        2 => [b, d, squares[2], f],
        _ => [c, e, f, squares[3]],
    };
    DQuat::from_xyzw(i, j, k, w).normalize()
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Rpy;
    use proptest::prelude::*;

    use super::*;

    fn pairs_of(reference_from_estimate: Pose, scale: f64, points: &[[f64; 3]]) -> Vec<PosePair> {
        let pair = |&[x, y, z]: &[f64; 3]| {
            let estimate = Pose::from_xyz(x, y, z);
            let reference = Similarity { reference_from_estimate, scale }.apply(estimate);
            PosePair { stamp_s: 0.0, reference, estimate }
        };
        points.iter().map(pair).collect()
    }

    const CORNERS: [[f64; 3]; 4] = [[0.0; 3], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [5.0, 1.0, 0.0]];

    #[test]
    fn a_quarter_turn_is_found() {
        let yaw_rad = std::f64::consts::FRAC_PI_2;
        let turned = Pose::from(Pose2::new(1.0, 2.0, yaw_rad));
        for method in [AlignmentMethod::Se2, AlignmentMethod::Se3, AlignmentMethod::Origin] {
            let found = align(&pairs_of(turned, 1.0, &CORNERS), method).unwrap();
            let (metres, radians) = found.reference_from_estimate.distance_to(turned);
            assert!(metres < 1e-12 && radians < 1e-12, "{method:?}: {found:?}");
        }
    }

    #[test]
    fn scale_is_found_with_and_without_the_pose() {
        let turned = Pose::from(Pose2::new(1.0, 2.0, 0.5));
        let pairs = pairs_of(turned, 2.0, &CORNERS);
        let scale = |method| align(&pairs, method).unwrap().scale;
        assert!((scale(AlignmentMethod::Sim3) - 2.0).abs() < 1e-12);
        assert!((scale(AlignmentMethod::Scale) - 2.0).abs() < 1e-12);
        assert_eq!(scale(AlignmentMethod::Se3), 1.0);
    }

    #[test]
    fn a_line_determines_the_yaw_but_not_the_roll() {
        let line = pairs_of(Pose::from_xyz(0.0, 1.0, 0.0), 1.0, &[[0.0; 3], [1.0, 0.0, 0.0]]);
        assert_eq!(align(&line, AlignmentMethod::Se3), Err(Degenerate { pose_count: 2 }));
        let found = align(&line, AlignmentMethod::Se2).unwrap();
        assert_eq!(found.reference_from_estimate.translation, DVec3::Y);
    }

    /// Regression test: a base frame 0.3 m above the origin of its model was an error of 0.3 m.
    #[test]
    fn heights_are_aligned_by_their_means() {
        let raised = Pose::from_xyz(1.0, 0.0, 0.3);
        let found = align(&pairs_of(raised, 1.0, &CORNERS), AlignmentMethod::Se2).unwrap();
        assert!(found.reference_from_estimate.distance_to(raised).0 < 1e-12, "{found:?}");
    }

    #[test]
    fn one_point_determines_nothing() {
        let point = pairs_of(Pose::IDENTITY, 1.0, &[[1.0, 0.0, 0.0]; 3]);
        assert_eq!(align(&point, AlignmentMethod::Se2), Err(Degenerate { pose_count: 3 }));
        let far = [[1e300, 0.0, 0.0], [0.0, 1e300, 0.0], [0.0; 3]];
        let far = pairs_of(Pose::IDENTITY, 1.0, &far);
        assert_eq!(align(&far, AlignmentMethod::Se3), Err(Degenerate { pose_count: 3 }));
        assert_eq!(align(&[], AlignmentMethod::Origin), Err(Degenerate { pose_count: 0 }));
        assert_eq!(align(&[], AlignmentMethod::None), Ok(Similarity::IDENTITY));
    }

    proptest! {
        #[test]
        fn any_similarity_is_found(
            points in prop::collection::vec(prop::array::uniform3(-9.0..9.0), 6..20),
            xyz in prop::array::uniform3(-9.0..9.0),
            [roll, pitch, yaw] in prop::array::uniform3(-1.5..1.5),
            scale in 0.5..2.0,
        ) {
            let expected = Pose::from_xyz_rpy(xyz, Rpy { roll, pitch, yaw });
            let found = align(&pairs_of(expected, scale, &points), AlignmentMethod::Sim3).unwrap();
            let (metres, radians) = found.reference_from_estimate.distance_to(expected);
            prop_assert!(metres < 1e-7 && radians < 1e-7 && (found.scale - scale).abs() < 1e-8);
        }
    }
}
