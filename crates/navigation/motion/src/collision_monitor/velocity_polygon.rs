//! Polygons that depend on the velocity.

use periplus_geometry::Twist2;

/// Polygon for a range of velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityPart {
    /// Corners, in the base frame \[m\].
    pub corners: Vec<[f64; 2]>,
    /// Minimum and maximum of the linear velocity \[m/s\]: along x, or the speed of a holonomic robot.
    pub linear_m_s: [f64; 2],
    /// Minimum and maximum of the angular velocity \[rad/s\].
    pub theta_rad_s: [f64; 2],
    /// First and last direction of travel of a holonomic robot \[rad\]; a range through ±π has a
    /// first direction above its last.
    pub direction_rad: [f64; 2],
}

/// Polygons of a zone, by velocity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VelocityParts {
    /// Ranges; the first that contains a velocity applies.
    pub parts: Vec<VelocityPart>,
    /// True if the robot can move sideways: ranges are then of speed and direction.
    pub is_holonomic: bool,
}

impl VelocityParts {
    /// The part for a command; none if no range contains it.
    #[must_use]
    pub fn select(&self, command: Twist2) -> Option<&VelocityPart> {
        self.parts.iter().find(|part| part.covers(command, self.is_holonomic))
    }
}

impl VelocityPart {
    fn covers(&self, command: Twist2, is_holonomic: bool) -> bool {
        let within = |[min, max]: [f64; 2], value: f64| min <= value && value <= max;
        if !within(self.theta_rad_s, command.wz_rad_s) {
            return false;
        }
        if !is_holonomic {
            return within(self.linear_m_s, command.vx_m_s);
        }
        let speed_m_s = libm::hypot(command.vx_m_s, command.vy_m_s);
        // A robot at rest has no direction; 0 is used.
        let direction_rad =
            if speed_m_s > 0.0 { libm::atan2(command.vy_m_s, command.vx_m_s) } else { 0.0 };
        let [first, last] = self.direction_rad;
        let is_in_direction = if first <= last {
            within([first, last], direction_rad)
        } else {
            direction_rad >= first || direction_rad <= last
        };
        within(self.linear_m_s, speed_m_s) && is_in_direction
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_range_with_the_velocity_applies() {
        let part = |linear_m_s, direction_rad| VelocityPart {
            corners: Vec::new(),
            linear_m_s,
            theta_rad_s: [-1.0, 1.0],
            direction_rad,
        };
        let ahead = part([0.0, 0.5], [-0.8, 0.8]);
        let back = part([-0.5, 0.5], [2.3, -2.3]);
        let parts = vec![ahead, back];
        let check = |is_holonomic: bool, command: (f64, f64, f64), expected: Option<usize>| {
            let parts = VelocityParts { parts: parts.clone(), is_holonomic };
            let (vx, vy, wz) = command;
            let found = parts.select(Twist2::new(vx, vy, wz));
            let expected = expected.map(|index| &parts.parts[index]);
            assert_eq!(found, expected, "{is_holonomic} {command:?}");
        };
        check(false, (0.2, 0.0, 0.0), Some(0));
        check(false, (-0.2, 0.0, 0.0), Some(1));
        check(false, (0.6, 0.0, 0.0), None);
        check(false, (0.2, 0.0, 1.1), None);
        check(true, (-0.2, 0.01, 0.0), Some(1));
        check(true, (-0.2, -0.01, 0.0), Some(1));
        check(true, (0.0, 0.2, 0.0), None);
        check(true, (0.0, 0.0, 0.5), Some(0));
    }
}
