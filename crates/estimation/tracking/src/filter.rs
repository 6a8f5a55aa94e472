//! Kalman filter with constant velocity.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use periplus_geometry::DVec3;

/// Kalman filter of position and velocity in the frame of the sensor.
///
/// The velocity is constant but for white acceleration, with the discrete covariance of Bar-Shalom, Li and Kirubarajan,
/// *Estimation with Applications to Tracking and Navigation* (2001), equation 6.2.2-12. Positions are linear
/// measurements; a radial velocity is linearized at the prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstantVelocityFilter {
    state: Vector6<f64>,
    covariance: Matrix6<f64>,
}

impl ConstantVelocityFilter {
    /// Starts at a position \[m\] with its covariance, at an unknown velocity with this standard deviation \[m/s\].
    #[must_use]
    pub fn new(
        position_m: DVec3,
        position_covariance_m2: Matrix3<f64>,
        velocity_stddev_m_per_s: f64,
    ) -> Self {
        let mut state = Vector6::zeros();
        state.fixed_rows_mut::<3>(0).copy_from(&vector(position_m));
        let mut covariance = Matrix6::zeros();
        covariance.fixed_view_mut::<3, 3>(0, 0).copy_from(&position_covariance_m2);
        let variance = velocity_stddev_m_per_s * velocity_stddev_m_per_s;
        covariance
            .fixed_view_mut::<3, 3>(3, 3)
            .copy_from(&Matrix3::from_diagonal_element(variance));
        Self { state, covariance }
    }

    /// Position \[m\].
    #[must_use]
    pub fn position_m(&self) -> DVec3 {
        DVec3::new(self.state[0], self.state[1], self.state[2])
    }

    /// Velocity \[m/s\].
    #[must_use]
    pub fn velocity_m_per_s(&self) -> DVec3 {
        DVec3::new(self.state[3], self.state[4], self.state[5])
    }

    /// Covariance of the position \[m²\].
    #[must_use]
    pub fn position_covariance_m2(&self) -> Matrix3<f64> {
        self.covariance.fixed_view::<3, 3>(0, 0).into_owned()
    }

    /// Covariance of the velocity \[m²/s²\].
    #[must_use]
    pub fn velocity_covariance(&self) -> Matrix3<f64> {
        self.covariance.fixed_view::<3, 3>(3, 3).into_owned()
    }

    /// Advances the state by a time \[s\], with a spectral density of the acceleration from its standard deviation
    /// \[m/s²\] over one second.
    pub fn predict(&mut self, dt_s: f64, acceleration_stddev_m_per_s2: f64) {
        let mut transition = Matrix6::identity();
        let density = acceleration_stddev_m_per_s2 * acceleration_stddev_m_per_s2;
        let mut noise = Matrix6::zeros();
        for axis in 0..3 {
            transition[(axis, axis + 3)] = dt_s;
            noise[(axis, axis)] = density * dt_s * dt_s * dt_s / 3.0;
            noise[(axis, axis + 3)] = density * dt_s * dt_s / 2.0;
            noise[(axis + 3, axis)] = density * dt_s * dt_s / 2.0;
            noise[(axis + 3, axis + 3)] = density * dt_s;
        }
        self.state = transition * self.state;
        self.covariance = transition * self.covariance * transition.transpose() + noise;
    }

    /// Returns the squared Mahalanobis distance of a measured position; infinite for a singular covariance.
    #[must_use]
    pub fn distance2(&self, position_m: DVec3, covariance_m2: &Matrix3<f64>) -> f64 {
        let innovation = vector(position_m - self.position_m());
        let sum = self.position_covariance_m2() + covariance_m2;
        let Some(inverse) = sum.try_inverse() else { return f64::INFINITY };
        (innovation.transpose() * inverse * innovation)[0]
    }

    /// Updates the state by a measured position.
    pub fn update_position(&mut self, position_m: DVec3, covariance_m2: &Matrix3<f64>) {
        let innovation = vector(position_m - self.position_m());
        let Some(inverse) = (self.position_covariance_m2() + covariance_m2).try_inverse() else {
            return;
        };
        let columns = self.covariance.fixed_view::<6, 3>(0, 0).into_owned();
        let gain = columns * inverse;
        self.state += gain * innovation;
        self.covariance -= gain * columns.transpose();
        self.symmetrize();
    }

    /// Updates the state by a measured radial velocity of this variance: `d = p · v / |p|`.
    pub fn update_doppler(&mut self, doppler_m_per_s: f64, variance: f64) {
        let (position_m, velocity_m_per_s) = (self.position_m(), self.velocity_m_per_s());
        let range_m = position_m.length();
        let direction = position_m / range_m;
        if !direction.is_finite() {
            return;
        }
        let radial_m_per_s = direction.dot(velocity_m_per_s);
        let by_position = (velocity_m_per_s - direction * radial_m_per_s) / range_m;
        let mut gradient = Vector6::zeros();
        gradient.fixed_rows_mut::<3>(0).copy_from(&vector(by_position));
        gradient.fixed_rows_mut::<3>(3).copy_from(&vector(direction));
        let column = self.covariance * gradient;
        let gain = column / (gradient.dot(&column) + variance);
        self.state += gain * (doppler_m_per_s - radial_m_per_s);
        self.covariance -= gain * column.transpose();
        self.symmetrize();
    }

    fn symmetrize(&mut self) {
        self.covariance = (self.covariance + self.covariance.transpose()) / 2.0;
    }
}

fn vector(of: DVec3) -> Vector3<f64> {
    Vector3::new(of.x, of.y, of.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit() -> Matrix3<f64> {
        Matrix3::identity()
    }

    /// Equal variances: the estimate is the mean, its variance half of both.
    #[test]
    fn a_position_of_equal_variance_is_averaged() {
        let mut filter = ConstantVelocityFilter::new(DVec3::X * 10.0, unit(), 1.0);
        assert_eq!(filter.distance2(DVec3::X * 12.0, &unit()), 2.0);
        filter.update_position(DVec3::X * 12.0, &unit());
        assert!((filter.position_m() - DVec3::X * 11.0).length() < 1e-12);
        assert!((filter.position_covariance_m2() - unit() * 0.5).norm() < 1e-12);
    }

    /// After 2 s at an unknown velocity of 3 m/s: 1 + 4 · 9, and the noise of 0.5² · 2³ / 3.
    #[test]
    fn the_covariance_grows_with_time() {
        let mut filter = ConstantVelocityFilter::new(DVec3::X, unit(), 3.0);
        filter.predict(2.0, 0.5);
        let variance_m2 = filter.position_covariance_m2()[(0, 0)];
        assert!((variance_m2 - (37.0 + 0.25 * 8.0 / 3.0)).abs() < 1e-12, "{variance_m2}");
        assert!((filter.velocity_covariance()[(0, 0)] - 9.5).abs() < 1e-12);
    }

    /// A radial velocity changes the velocity along the line of sight only: 4 · 9 / (9 + 1).
    #[test]
    fn a_radial_velocity_acts_along_the_line_of_sight() {
        let mut filter = ConstantVelocityFilter::new(DVec3::Y * 5.0, unit(), 3.0);
        filter.update_doppler(4.0, 1.0);
        assert!((filter.velocity_m_per_s() - DVec3::Y * 3.6).length() < 1e-12);
        let covariance = filter.velocity_covariance();
        assert!((covariance[(0, 0)] - 9.0).abs() < 1e-12);
        assert!((covariance[(1, 1)] - 0.9).abs() < 1e-12);
    }
}
