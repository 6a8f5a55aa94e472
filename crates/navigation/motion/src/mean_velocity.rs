//! Mean of recent velocities.

use std::collections::VecDeque;

use crate::velocity_smoother::{VELOCITY_COMPONENT_COUNT, Velocity6};

/// Mean of the velocities in a window of time, as `nav2_util::OdomSmoother` computes it for the
/// velocity smoother, the controllers and the navigator.
///
/// ```
/// use periplus_motion::MeanVelocity;
///
/// let mut mean = MeanVelocity::new(100_000_000);
/// mean.add(0, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
/// mean.add(100_000_000, [2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
/// assert_eq!(mean.value().map(|velocity| velocity[0]), Some(1.5));
/// mean.add(150_000_000, [3.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
/// assert_eq!(mean.value().map(|velocity| velocity[0]), Some(2.5));
/// ```
#[derive(Clone, Debug)]
pub struct MeanVelocity {
    window_ns: i64,
    history: VecDeque<(i64, Velocity6)>,
}

impl MeanVelocity {
    /// Creates an empty mean over a window \[ns\].
    #[must_use]
    pub fn new(window_ns: i64) -> Self {
        Self { window_ns, history: VecDeque::new() }
    }

    /// Adds a velocity; those older than the window before it are dropped.
    pub fn add(&mut self, time_ns: i64, velocity: Velocity6) {
        while self.history.front().is_some_and(|(first, _)| time_ns - first > self.window_ns) {
            self.history.pop_front();
        }
        self.history.push_back((time_ns, velocity));
    }

    /// The mean; none without velocities.
    #[must_use]
    pub fn value(&self) -> Option<Velocity6> {
        let count = self.history.len();
        let mut sum = [0.0; VELOCITY_COMPONENT_COUNT];
        for (_, velocity) in &self.history {
            for (sum, component) in sum.iter_mut().zip(velocity) {
                *sum += component;
            }
        }
        (count > 0).then(|| sum.map(|sum| sum / count as f64))
    }

    /// Drops all velocities, as after a jump of time.
    pub fn clear(&mut self) {
        self.history.clear();
    }
}
