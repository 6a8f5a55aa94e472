//! Rolling means.

use std::collections::VecDeque;

/// Window of gz-math's odometry and gz-sim's `OdometryPublisher`.
const WINDOW_SAMPLES: usize = 10;

/// Mean of the last ten values of several quantities (gz-math, `RollingMean`).
#[derive(Clone, Debug)]
pub(crate) struct RollingMean<const N: usize> {
    values: VecDeque<[f64; N]>,
}

impl<const N: usize> Default for RollingMean<N> {
    fn default() -> Self {
        Self { values: VecDeque::with_capacity(WINDOW_SAMPLES) }
    }
}

impl<const N: usize> RollingMean<N> {
    pub(crate) fn push(&mut self, value: [f64; N]) {
        if self.values.len() == WINDOW_SAMPLES {
            self.values.pop_front();
        }
        self.values.push_back(value);
    }

    /// Returns the mean; zero without values.
    #[expect(clippy::cast_precision_loss, reason = "at most ten")]
    pub(crate) fn mean(&self) -> [f64; N] {
        let count = self.values.len().max(1) as f64;
        std::array::from_fn(|index| {
            self.values.iter().map(|value| value[index]).sum::<f64>() / count
        })
    }

    pub(crate) fn clear(&mut self) {
        self.values.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_ten_count() {
        let mut mean = RollingMean::default();
        assert_eq!(mean.mean(), [0.0]);
        for value in 1..=12 {
            mean.push([f64::from(value)]);
        }
        // 3 to 12.
        assert_eq!(mean.mean(), [7.5]);
    }
}
