//! Poses of a sensor during a measurement.

use periplus_geometry::Pose;

/// Poses of a sensor during a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sweep<'a> {
    /// All beams are measured at once from this pose (`world_from_sensor`).
    AtOnce(Pose),
    /// Columns of beams are measured one after the other while the sensor moves through these poses,
    /// each with its fraction of the scan (0 at the first column, 1 at the last), in order.
    Moving(&'a [(f64, Pose)]),
}

impl Sweep<'_> {
    /// Returns `world_from_sensor` at a fraction of the scan, interpolated between poses.
    #[must_use]
    pub fn at(&self, part: f64) -> Pose {
        let poses = match self {
            Sweep::AtOnce(pose) => return *pose,
            Sweep::Moving(poses) => poses,
        };
        let after = poses.partition_point(|(at, _)| *at <= part);
        match (after.checked_sub(1).map(|before| poses[before]), poses.get(after)) {
            (Some((from, before)), Some(&(to, next))) => {
                between(before, next, (part - from) / (to - from))
            }
            (Some((_, pose)), None) | (None, Some(&(_, pose))) => pose,
            (None, None) => Pose::IDENTITY,
        }
    }
}

/// Interpolates between two poses (spherical linear interpolation of the rotation).
fn between(from: Pose, to: Pose, part: f64) -> Pose {
    let translation = from.translation + (to.translation - from.translation) * part;
    let turn = from.rotation.conjugate() * to.rotation;
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let axis = periplus_geometry::DVec3::new(turn.x, turn.y, turn.z);
    let sine = axis.length();
    if sine < 1e-12 {
        return Pose { translation, rotation: from.rotation };
    }
    let half_angle = libm::atan2(sine, turn.w) * part;
    let (new_sine, cosine) = libm::sincos(half_angle);
    let scaled = axis * (new_sine / sine);
    let turn = periplus_geometry::DQuat::from_xyzw(scaled.x, scaled.y, scaled.z, cosine);
    Pose { translation, rotation: (from.rotation * turn).normalize() }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Rpy;

    use super::*;

    #[test]
    fn poses_between_lie_between() {
        let yaw = |x, yaw| Pose::from_xyz_rpy([x, 0.0, 0.0], Rpy { roll: 0.0, pitch: 0.0, yaw });
        let poses = [(0.0, yaw(0.0, 3.0)), (0.5, yaw(1.0, 3.2)), (1.0, yaw(5.0, 3.2))];
        let sweep = Sweep::Moving(&poses);
        assert!(sweep.at(0.25).distance_to(yaw(0.5, 3.1)).1 < 1e-12);
        assert!((sweep.at(0.75).translation.x - 3.0).abs() < 1e-12);
        assert_eq!((sweep.at(-1.0), sweep.at(2.0)), (poses[0].1, poses[2].1));
    }
}
