//! Forces within a group.
//!
//! Source: M. Moussaid, N. Perozo, S. Garnier, D. Helbing, G. Theraulaz, "The walking behaviour of pedestrian social
//! groups and its impact on crowd dynamics", PLoS ONE 5(4), 2010, equations 3 to 5. Members keep each other in view
//! (`-beta_1 alpha v`, where `alpha` is the angle by which the head must turn beyond the field of view), are attracted
//! by the centre of the group beyond `(N - 1) / 2` metres from it (`beta_2`). The repulsion of overlapping members is
//! that of all people.

use glam::DVec2;

use crate::perception::GroupView;

/// Strength of slowing to keep others in view, `beta_1` (for an angle in radians) \[1/s\].
const GAZE_STRENGTH_PER_S_RAD: f64 = 4.0;

/// Strength of the attraction by the centre, `beta_2` \[m/s²\].
const ATTRACTION_M_PER_S2: f64 = 3.0;

/// Half of the field of view in which others are seen without turning the head \[rad\].
const HALF_FIELD_OF_VIEW_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// Returns the acceleration that keeps a member with its group \[m/s²\].
pub(crate) fn group_acceleration(group: GroupView, preferred: DVec2, velocity: DVec2) -> DVec2 {
    let mut acceleration = DVec2::ZERO;
    if preferred != DVec2::ZERO && group.to_others != DVec2::ZERO {
        let angle_rad =
            libm::atan2(preferred.perp_dot(group.to_others).abs(), preferred.dot(group.to_others));
        let turn_rad = (angle_rad - HALF_FIELD_OF_VIEW_RAD).max(0.0);
        acceleration -= velocity * (GAZE_STRENGTH_PER_S_RAD * turn_rad / std::f64::consts::PI);
    }
    #[expect(clippy::cast_precision_loss, reason = "groups are small")]
    let limit_m = (group.members as f64 - 1.0) / 2.0;
    let distance_m = group.to_centre.length();
    if distance_m > limit_m {
        acceleration += group.to_centre * (ATTRACTION_M_PER_S2 / distance_m);
    }
    acceleration
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_member_far_from_the_centre_is_attracted() {
        let ahead = DVec2::new(1.0, 0.0);
        let group = |distance: f64| GroupView {
            to_centre: DVec2::new(distance, 0.0),
            to_others: DVec2::new(2.0 * distance, 0.0),
            members: 2,
        };
        assert_eq!(group_acceleration(group(0.4), ahead, ahead), DVec2::ZERO);
        assert_eq!(group_acceleration(group(0.6), ahead, ahead), DVec2::new(3.0, 0.0));
        // A member ahead turns the head by a quarter turn, slows down, and is attracted.
        let behind = group_acceleration(group(-0.6), ahead, ahead);
        assert!(behind.distance(DVec2::new(-3.0 - 2.0, 0.0)) < 1e-12, "{behind}");
    }
}
