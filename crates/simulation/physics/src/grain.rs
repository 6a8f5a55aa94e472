//! Surfaces that are rougher one way than the other: rollers, skates, tracks.

use periplus_geometry::DVec3;

/// The rougher way of a collision, and how much rougher it is. The solver knows one coefficient,
/// the smaller; what the other has more pushes along this way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grain {
    /// The body that the first direction stands still in.
    pub(crate) frame_body: usize,
    /// The first direction, in that body, of unit length.
    pub(crate) first_in_frame: DVec3,
    /// Coefficient along the first direction.
    pub(crate) mu: f64,
    /// Coefficient across it.
    pub(crate) mu2: f64,
}

impl Grain {
    /// The rougher way at a contact, a unit vector in its plane, and the coefficient that the solver
    /// does not know; none where the first direction is the normal.
    ///
    /// As ODE has it (`dContactFDir1`): the second direction is the normal times the first, and of
    /// two surfaces the smoother counts.
    pub(crate) fn along(
        &self,
        first: DVec3,
        normal: DVec3,
        mu_of_other: f64,
    ) -> Option<(DVec3, f64)> {
        let first = (first - normal * first.dot(normal)).try_normalize()?;
        let rough = if self.mu > self.mu2 { first } else { normal.cross(first) };
        let more = self.mu.max(self.mu2).min(mu_of_other) - self.mu.min(self.mu2).min(mu_of_other);
        (more > 0.0).then_some((rough, more))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grain(mu: f64, mu2: f64) -> Grain {
        Grain { frame_body: 0, first_in_frame: DVec3::X, mu, mu2 }
    }

    #[test]
    fn the_rougher_way_lies_in_the_ground() {
        let leaning = DVec3::new(3.0, 0.0, 4.0);
        assert_eq!(grain(1.0, 0.0).along(leaning, DVec3::Z, 9.0), Some((DVec3::X, 1.0)));
        assert_eq!(grain(0.25, 1.0).along(leaning, DVec3::Z, 9.0), Some((DVec3::Y, 0.75)));
    }

    #[test]
    fn a_smooth_ground_takes_all_of_it() {
        assert_eq!(grain(1.0, 0.5).along(DVec3::X, DVec3::Z, 0.5), None);
        assert_eq!(grain(1.0, 0.0).along(DVec3::Z, DVec3::Z, 1.0), None);
    }
}
