//! Anisotropic friction: rollers, skates, tracks.

use periplus_geometry::DVec3;

/// Anisotropic friction of a collision. The solver uses one coefficient, the smaller; the excess of
/// the other acts as a force along its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AnisotropicFriction {
    /// Body in whose frame the first direction is fixed.
    pub(crate) frame_body: usize,
    /// First direction, in that body, a unit vector.
    pub(crate) first_in_frame: DVec3,
    /// Coefficient along the first direction.
    pub(crate) mu: f64,
    /// Coefficient across the first direction.
    pub(crate) mu2: f64,
}

impl AnisotropicFriction {
    /// Returns the direction of higher friction at a contact, a unit vector in its plane, and the
    /// excess coefficient; `None` if the first direction is the normal.
    ///
    /// As in ODE (`dContactFDir1`): the second direction is the normal times the first, and of two
    /// surfaces the smaller coefficient counts.
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

    fn anisotropic_friction(mu: f64, mu2: f64) -> AnisotropicFriction {
        AnisotropicFriction { frame_body: 0, first_in_frame: DVec3::X, mu, mu2 }
    }

    #[test]
    fn the_rougher_way_lies_in_the_ground() {
        let leaning = DVec3::new(3.0, 0.0, 4.0);
        assert_eq!(
            anisotropic_friction(1.0, 0.0).along(leaning, DVec3::Z, 9.0),
            Some((DVec3::X, 1.0))
        );
        assert_eq!(
            anisotropic_friction(0.25, 1.0).along(leaning, DVec3::Z, 9.0),
            Some((DVec3::Y, 0.75))
        );
    }

    #[test]
    fn a_smooth_ground_takes_all_of_it() {
        assert_eq!(anisotropic_friction(1.0, 0.5).along(DVec3::X, DVec3::Z, 0.5), None);
        assert_eq!(anisotropic_friction(1.0, 0.0).along(DVec3::Z, DVec3::Z, 1.0), None);
    }
}
