//! Spread of the particles.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::Symmetric3;

use super::{Gmapping, resample};

impl Gmapping {
    /// Entropy of the particle weights: 0 if one has all, the logarithm of their number if all are equal.
    /// `slam_gmapping` publishes it as `entropy`.
    #[must_use]
    pub fn entropy(&self) -> f64 {
        let weighs = |weight: &f64| *weight > 0.0;
        -self
            .weights()
            .into_iter()
            .filter(weighs)
            .map(|weight| weight * libm::log(weight))
            .sum::<f64>()
    }

    /// Covariance of the particle poses, along the axes of the map.
    #[must_use]
    pub fn covariance(&self) -> Symmetric3 {
        let best = self.particles.get(self.best).map_or(Pose2::IDENTITY, |it| it.map_from_base);
        let mut sum = Symmetric3::ZERO;
        for (particle, weight) in self.particles.iter().zip(self.weights()) {
            let pose = particle.map_from_base;
            let turn = normalize_angle(pose.yaw_rad - best.yaw_rad);
            sum.add_outer([pose.x_m - best.x_m, pose.y_m - best.y_m, turn], weight);
        }
        sum
    }

    fn weights(&self) -> Vec<f64> {
        let logs: Vec<f64> = self.particles.iter().map(|it| it.log).collect();
        resample::weights(&logs, self.settings.gain * logs.len() as f64)
    }
}
