//! Guesses of where the robot is.

use periplus_geometry::{Pose2, normalize_angle};

/// Guesses of where the robot is, each number in a list of its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Particles {
    /// Along x of the map \[m\].
    pub x_m: Vec<f64>,
    /// Along y of the map \[m\].
    pub y_m: Vec<f64>,
    /// Direction \[rad\].
    pub yaw_rad: Vec<f64>,
    /// How much each counts; all together 1, unless there are none.
    pub weight: Vec<f64>,
}

impl Particles {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.x_m.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.x_m.is_empty()
    }

    /// One of them.
    #[must_use]
    pub fn pose(&self, index: usize) -> Pose2 {
        Pose2::new(self.x_m[index], self.y_m[index], self.yaw_rad[index])
    }

    /// Adds one of weight 1.
    pub fn push(&mut self, pose: Pose2) {
        self.x_m.push(pose.x_m);
        self.y_m.push(pose.y_m);
        self.yaw_rad.push(normalize_angle(pose.yaw_rad));
        self.weight.push(1.0);
    }

    /// Gives all the same weight.
    pub fn level(&mut self) {
        let each = 1.0 / self.len() as f64;
        self.weight.fill(each);
    }

    /// By how many equal ones they could be replaced: 1 over the sum of squared weights.
    #[must_use]
    pub fn effective(&self) -> f64 {
        let squares: f64 = self.weight.iter().map(|weight| weight * weight).sum();
        if squares > 0.0 { 1.0 / squares } else { 0.0 }
    }

    /// Whether all are within so many metres of their mean, in x and in y: then the filter has made up
    /// its mind, and beams that contradict most particles may be doubted.
    #[must_use]
    pub fn is_within(&self, radius_m: f64) -> bool {
        let count = self.len() as f64;
        let is_near = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / count;
            values.iter().all(|value| (value - mean).abs() <= radius_m)
        };
        is_near(&self.x_m) && is_near(&self.y_m)
    }
}

/// Sums from which means and spreads follow.
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
    /// Where the sums are counted from, so that far from the origin no digits are lost.
    from: [f64; 2],
}

impl Moments {
    pub(crate) fn around(pose: Pose2) -> Self {
        Self { from: [pose.x_m, pose.y_m], ..Self::default() }
    }

    pub(crate) fn add(&mut self, pose: Pose2, weight: f64) {
        let (x, y) = (pose.x_m - self.from[0], pose.y_m - self.from[1]);
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
        let share = if self.weight > 0.0 { 1.0 / self.weight } else { 0.0 };
        Pose2::new(
            self.from[0] + self.x * share,
            self.from[1] + self.y * share,
            libm::atan2(self.sine, self.cosine),
        )
    }

    pub(crate) fn covariance(&self) -> Covariance2 {
        if self.weight <= 0.0 {
            return Covariance2::default();
        }
        let share = 1.0 / self.weight;
        let (x, y) = (self.x * share, self.y * share);
        let length = (share * libm::hypot(self.cosine, self.sine)).clamp(1e-12, 1.0);
        Covariance2 {
            xx: (self.xx * share - x * x).max(0.0),
            xy: self.xy * share - x * y,
            yy: (self.yy * share - y * y).max(0.0),
            // Of a normal distribution wrapped around the circle.
            yaw: (-2.0 * libm::log(length)).max(0.0),
        }
    }
}

/// How uncertain a pose on the plane is: squares of metres and of radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Covariance2 {
    /// Of x \[m^2\].
    pub xx: f64,
    /// Of x with y \[m^2\].
    pub xy: f64,
    /// Of y \[m^2\].
    pub yy: f64,
    /// Of the direction \[rad^2\].
    pub yaw: f64,
}

impl Covariance2 {
    /// As `geometry_msgs/PoseWithCovariance` has it: six by six, row by row, of x, y, z, roll, pitch,
    /// yaw.
    #[must_use]
    pub fn to_rows(self) -> [f64; 36] {
        let mut rows = [0.0; 36];
        (rows[0], rows[1], rows[6], rows[7], rows[35]) =
            (self.xx, self.xy, self.xy, self.yy, self.yaw);
        rows
    }

    /// The part of a `geometry_msgs/PoseWithCovariance` that is on the plane.
    #[must_use]
    pub fn from_rows(rows: &[f64; 36]) -> Self {
        Self { xx: rows[0], xy: 0.5 * (rows[1] + rows[6]), yy: rows[7], yaw: rows[35] }
    }

    /// The longest half axis of the ellipse of one standard deviation \[m\].
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
        assert!((spread.yaw - 0.041_58_f64.powi(2)).abs() < 1e-5, "{spread:?}");
    }

    #[test]
    fn one_particle_that_counts_alone() {
        let mut particles = Particles::default();
        (0..4).for_each(|x| particles.push(Pose2::new(f64::from(x), 0.0, 0.0)));
        particles.level();
        assert_eq!(particles.effective(), 4.0);
        assert!(particles.is_within(1.5) && !particles.is_within(1.4));
        particles.weight = vec![1.0, 0.0, 0.0, 0.0];
        assert_eq!(particles.effective(), 1.0);
    }
}
