//! Wheel odometry and true odometry.

use periplus_geometry::{DVec3, Pose};

use crate::kinematic::{Kinematic, Twist};

/// Odometry from the displacements of two wheels, by the midpoint rule of Gazebo Classic and
/// Harmonic: the displacement is along the heading in the middle of the step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Odometry {
    /// Estimated pose, from zero at the start.
    pub pose: Kinematic,
    /// Estimated velocity.
    pub twist: Twist,
}

impl Odometry {
    /// Advances by the displacements of the left and right wheels [m] over a time [s].
    #[must_use]
    pub fn advanced(self, left_m: f64, right_m: f64, separation_m: f64, dt_s: f64) -> Self {
        let ahead_m = (left_m + right_m) / 2.0;
        let turned_rad = (right_m - left_m) / separation_m;
        let (sine, cosine) = libm::sincos(self.pose.yaw_rad + turned_rad / 2.0);
        let pose = Kinematic {
            x_m: self.pose.x_m + ahead_m * cosine,
            y_m: self.pose.y_m + ahead_m * sine,
            yaw_rad: self.pose.yaw_rad + turned_rad,
        };
        let twist = if dt_s > 0.0 {
            Twist { x_m_s: ahead_m / dt_s, y_m_s: 0.0, yaw_rad_s: turned_rad / dt_s }
        } else {
            self.twist
        };
        Self { pose, twist }
    }
}

/// Returns the velocity of a body in its own heading, as Classic's `WORLD` source and `planar_move`
/// publish it. Their pose is `world_from_base` itself.
#[must_use]
pub fn true_twist(world_from_base: Pose, linear_m_s: DVec3, angular_rad_s: DVec3) -> Twist {
    let (sine, cosine) = libm::sincos(world_from_base.rpy().yaw);
    Twist {
        x_m_s: cosine * linear_m_s.x + sine * linear_m_s.y,
        y_m_s: cosine * linear_m_s.y - sine * linear_m_s.x,
        yaw_rad_s: angular_rad_s.z,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use periplus_geometry::Rpy;

    #[test]
    fn a_circle_in_a_hundred_steps_closes() {
        let separation_m = 0.5;
        // 1 m of radius: the inner wheel runs on 0.75 m, the outer on 1.25 m.
        let (left, right) = (0.75 * 2.0 * PI / 100.0, 1.25 * 2.0 * PI / 100.0);
        let mut odometry = Odometry::default();
        for step in 0..100 {
            odometry = odometry.advanced(left, right, separation_m, 0.01);
            if step == 49 {
                // After half a circle it is a diameter to the left. The midpoint rule inscribes
                // chords of the arc's length, so its circle is 1/6000 too large.
                assert!((odometry.pose.y_m - 2.0).abs() < 1e-3, "{odometry:?}");
            }
        }
        let Kinematic { x_m, y_m, yaw_rad } = odometry.pose;
        assert!(x_m.abs() < 1e-9 && y_m.abs() < 1e-9 && (yaw_rad - 2.0 * PI).abs() < 1e-9);
        assert!((odometry.twist.x_m_s - 2.0 * PI).abs() < 1e-9);
    }

    #[test]
    fn truth_is_told_in_the_robots_heading() {
        let north = Pose::from_xyz_rpy([0.0; 3], Rpy { roll: 0.0, pitch: 0.0, yaw: FRAC_PI_2 });
        let twist = true_twist(north, DVec3::new(0.0, 2.0, 0.0), DVec3::new(0.0, 0.0, 0.5));
        assert!((twist.x_m_s - 2.0).abs() < 1e-12 && twist.y_m_s.abs() < 1e-12);
        assert_eq!(twist.yaw_rad_s, 0.5);
    }
}
