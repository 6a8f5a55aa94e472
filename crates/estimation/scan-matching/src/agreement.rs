//! Consistency of two scans.

use periplus_geometry::Pose2;

use crate::cloud::{Cloud, Sight};

/// Tolerance of the heading between the scans \\[rad\\].
const HEADING_TOLERANCE_RAD: f32 = 0.02;

/// Comparison of the points of one scan with the visibility of another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Points at which the other scan has a surface, too.
    pub agreeing: u32,
    /// Points in space that the other scan saw as free: another scene, or something moved.
    pub contradicting: u32,
    /// Points that are occluded in the other scan, or outside of its view.
    pub unseen: u32,
}

impl Agreement {
    /// Fraction of agreeing points among the judged ones; 0 without any.
    #[must_use]
    pub fn share(&self) -> f64 {
        f64::from(self.agreeing) / f64::from((self.agreeing + self.contradicting).max(1))
    }

    /// Number of points that the other scan can judge.
    #[must_use]
    pub fn judged(&self) -> u32 {
        self.agreeing + self.contradicting
    }

    /// Fraction of judged points among all.
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

/// Compares the points of one cloud with what another one saw. A point agrees if the other cloud
/// has a point within `tolerance_m`, and contradicts if it is in front of the surface seen in
/// that direction by more than twice that. Beams without a return judge nothing, since glass and
/// black surfaces give none.
///
/// The comparison is one-sided: a wall that one scan saw and the other saw through is found from
/// that side only. Call it in both directions.
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
            // A small heading error moves distant points by more.
            (Sight::Surface { near, .. }, distance)
                if distance + 2.0 * tolerance_m + HEADING_TOLERANCE_RAD * distance < near =>
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

    /// Scan from the center of a square room.
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
        // The walls of the large room are occluded by those of the small one, so nothing is judged.
        assert_eq!(agreement(&large, &small, Pose2::IDENTITY, 0.1).judged(), 0);
    }
}
