//! Whether two scans can be of the same place.

use periplus_geometry::Pose2;

use crate::cloud::{Cloud, Sight};

/// Points of one scan held against what another saw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Points at which the other saw a surface too.
    pub agreeing: u32,
    /// Points where the other saw through: either it is not the same place, or something moved.
    pub contradicting: u32,
    /// Points hidden from the other, or where it did not look.
    pub unseen: u32,
}

impl Agreement {
    /// Agreeing points among those that the other could judge; 0 when there are none.
    #[must_use]
    pub fn share(&self) -> f64 {
        f64::from(self.agreeing) / f64::from((self.agreeing + self.contradicting).max(1))
    }

    /// Points that the other could judge.
    #[must_use]
    pub fn judged(&self) -> u32 {
        self.agreeing + self.contradicting
    }

    /// Judged points among all.
    #[must_use]
    pub fn overlap(&self) -> f64 {
        f64::from(self.judged()) / f64::from((self.judged() + self.unseen).max(1))
    }
}

impl std::ops::AddAssign for Agreement {
    fn add_assign(&mut self, other: Self) {
        self.agreeing += other.agreeing;
        self.contradicting += other.contradicting;
        self.unseen += other.unseen;
    }
}

/// Holds the points of one cloud against what another saw: a point is agreed with when the other has
/// one within `tolerance_m`, and contradicted when it lies in front of the surface that the other saw
/// in that direction by more than twice that. Readings that came back from nowhere judge nothing:
/// glass and black walls give none.
///
/// This is one way; a wall that one scan saw and the other saw through is found from that side only,
/// so ask both ways.
#[must_use]
pub fn agreement(
    points: &Cloud,
    seen: &Cloud,
    seen_from_points: Pose2,
    tolerance_m: f32,
) -> Agreement {
    let (sine, cosine) = libm::sincos(seen_from_points.yaw_rad);
    let (sine, cosine) = (sine as f32, cosine as f32);
    let (x_m, y_m) = (seen_from_points.x_m as f32, seen_from_points.y_m as f32);
    let mut counts = Agreement::default();
    for point in points.points() {
        let x = cosine * point.x - sine * point.y + x_m;
        let y = sine * point.x + cosine * point.y + y_m;
        if seen.nearest(x, y, tolerance_m).is_some() {
            counts.agreeing += 1;
            continue;
        }
        match seen.sight(x, y) {
            // Far away a small error of heading moves a point by more.
            (Sight::Surface { near, .. }, distance)
                if distance + 2.0 * tolerance_m + 0.02 * distance < near =>
            {
                counts.contradicting += 1;
            }
            _ => counts.unseen += 1,
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CloudSettings;

    /// A square room of 4 m seen from its middle.
    fn room(half_m: f32) -> Cloud {
        let beams = (0..360).map(|i| {
            let angle = (i as f32).to_radians();
            let (s, c) = (libm::sinf(angle), libm::cosf(angle));
            let range = half_m / s.abs().max(c.abs());
            Some([range * c, range * s])
        });
        Cloud::new(beams, [0.0, 0.0], 1f32.to_radians(), &CloudSettings::default())
    }

    #[test]
    fn a_room_agrees_with_itself() {
        let room = room(2.0);
        let same = agreement(&room, &room, Pose2::IDENTITY, 0.1);
        assert_eq!((same.contradicting, same.unseen), (0, 0));
        assert!(same.agreeing > 100);
    }

    #[test]
    fn a_small_room_is_not_a_large_one() {
        let (small, large) = (room(2.0), room(4.0));
        assert!(agreement(&small, &large, Pose2::IDENTITY, 0.1).share() < 0.01);
        // Its walls are hidden behind those of the small one, so that way nothing is known.
        assert_eq!(agreement(&large, &small, Pose2::IDENTITY, 0.1).judged(), 0);
    }
}
