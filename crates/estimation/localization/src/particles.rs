//! Particles and their moments.

use periplus_geometry::{Pose2, normalize_angle};

/// Particles as a structure of arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Particles {
    /// x in the map \[m\].
    pub x_m: Vec<f64>,
    /// y in the map \[m\].
    pub y_m: Vec<f64>,
    /// Yaw in the map \[rad\].
    pub yaw_rad: Vec<f64>,
    /// Importance weights; their sum is 1 unless there are no particles.
    pub weight: Vec<f64>,
}

impl Particles {
    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.x_m.len()
    }

    /// True if there are no particles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.x_m.is_empty()
    }

    /// Pose of a particle.
    #[must_use]
    pub fn pose(&self, index: usize) -> Pose2 {
        Pose2::new(self.x_m[index], self.y_m[index], self.yaw_rad[index])
    }

    /// Adds a particle of weight 1.
    pub fn push(&mut self, pose: Pose2) {
        self.x_m.push(pose.x_m);
        self.y_m.push(pose.y_m);
        self.yaw_rad.push(normalize_angle(pose.yaw_rad));
        self.weight.push(1.0);
    }

    /// Sets all weights to the same value, with sum 1.
    pub fn set_uniform_weights(&mut self) {
        let each = 1.0 / self.len() as f64;
        self.weight.fill(each);
    }

    /// Effective sample size: 1 over the sum of squared weights.
    #[must_use]
    pub fn effective_count(&self) -> f64 {
        let squares: f64 = self.weight.iter().map(|weight| weight * weight).sum();
        if squares > 0.0 { 1.0 / squares } else { 0.0 }
    }

    /// True if all particles are within `radius_m` of their mean in x and in y: the filter has
    /// converged, and beam skipping may start.
    #[must_use]
    pub fn are_within(&self, radius_m: f64) -> bool {
        let count = self.len() as f64;
        let is_near = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / count;
            values.iter().all(|value| (value - mean).abs() <= radius_m)
        };
        is_near(&self.x_m) && is_near(&self.y_m)
    }
}

/// Weighted sums for mean and covariance.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moments {
    pub(crate) weight: f64,
    x: f64,
    y: f64,
    cosine: f64,
    sine: f64,
    xx: f64,
    xy: f64,
    yy: f64,
    /// Reference point of the sums, against loss of precision far from the origin.
    reference_m: [f64; 2],
}

impl Moments {
    pub(crate) fn around(pose: Pose2) -> Self {
        Self { reference_m: [pose.x_m, pose.y_m], ..Self::default() }
    }

    pub(crate) fn add(&mut self, pose: Pose2, weight: f64) {
        let (x, y) = (pose.x_m - self.reference_m[0], pose.y_m - self.reference_m[1]);
        let (sine, cosine) = libm::sincos(pose.yaw_rad);
        self.weight += weight;
        self.x += weight * x;
        self.y += weight * y;
        self.cosine += weight * cosine;
        self.sine += weight * sine;
        self.xx += weight * x * x;
        self.xy += weight * x * y;
        self.yy += weight * y * y;
    }

    pub(crate) fn mean(&self) -> Pose2 {
        let scale = if self.weight > 0.0 { 1.0 / self.weight } else { 0.0 };
        Pose2::new(
            self.reference_m[0] + self.x * scale,
            self.reference_m[1] + self.y * scale,
            libm::atan2(self.sine, self.cosine),
        )
    }

    pub(crate) fn covariance(&self) -> Covariance2 {
        if self.weight <= 0.0 {
            return Covariance2::default();
        }
        let scale = 1.0 / self.weight;
        let (x, y) = (self.x * scale, self.y * scale);
        let length = (scale * libm::hypot(self.cosine, self.sine)).clamp(1e-12, 1.0);
        Covariance2 {
            xx: (self.xx * scale - x * x).max(0.0),
            xy: self.xy * scale - x * y,
            yy: (self.yy * scale - y * y).max(0.0),
            // Variance of a wrapped normal distribution.
            yaw: (-2.0 * libm::log(length)).max(0.0),
        }
    }
}

/// Covariance of a planar pose, without correlation of position and yaw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Covariance2 {
    /// Variance of x \[m^2\].
    pub xx: f64,
    /// Covariance of x and y \[m^2\].
    pub xy: f64,
    /// Variance of y \[m^2\].
    pub yy: f64,
    /// Variance of yaw \[rad^2\].
    pub yaw: f64,
}

impl Covariance2 {
    /// Row-major 6 by 6 covariance of x, y, z, roll, pitch, yaw, as in
    /// `geometry_msgs/PoseWithCovariance`.
    #[must_use]
    pub fn to_rows(self) -> [f64; 36] {
        let mut rows = [0.0; 36];
        (rows[0], rows[1], rows[6], rows[7], rows[35]) =
            (self.xx, self.xy, self.xy, self.yy, self.yaw);
        rows
    }

    /// Planar part of the covariance of a `geometry_msgs/PoseWithCovariance`.
    #[must_use]
    pub fn from_rows(rows: &[f64; 36]) -> Self {
        Self { xx: rows[0], xy: 0.5 * (rows[1] + rows[6]), yy: rows[7], yaw: rows[35] }
    }

    /// Semi-major axis of the ellipse of one standard deviation \[m\].
    #[must_use]
    pub fn radius_m(self) -> f64 {
        let middle = 0.5 * (self.xx + self.yy);
        let difference = 0.5 * (self.xx - self.yy);
        libm::sqrt((middle + libm::hypot(difference, self.xy)).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_covariance_of_two() {
        let mut moments = Moments::around(Pose2::new(1e6, 0.0, 0.0));
        moments.add(Pose2::new(1e6 - 1.0, 0.0, 3.1), 0.5);
        moments.add(Pose2::new(1e6 + 1.0, 0.0, -3.1), 0.5);
        let (mean, spread) = (moments.mean(), moments.covariance());
        assert_eq!((mean.x_m, mean.y_m), (1e6, 0.0));
        assert!((mean.yaw_rad.abs() - std::f64::consts::PI).abs() < 1e-12);
        assert!((spread.xx - 1.0).abs() < 1e-12 && spread.yy == 0.0);
        assert!((spread.yaw - libm::pow(0.041_58_f64, 2.0)).abs() < 1e-5, "{spread:?}");
    }

    #[test]
    fn effective_sample_size() {
        let mut particles = Particles::default();
        (0..4).for_each(|x| particles.push(Pose2::new(f64::from(x), 0.0, 0.0)));
        particles.set_uniform_weights();
        assert_eq!(particles.effective_count(), 4.0);
        assert!(particles.are_within(1.5) && !particles.are_within(1.4));
        particles.weight = vec![1.0, 0.0, 0.0, 0.0];
        assert_eq!(particles.effective_count(), 1.0);
    }
}
