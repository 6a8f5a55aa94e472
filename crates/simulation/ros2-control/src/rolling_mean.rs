//! Mean of the last values.

use std::collections::VecDeque;

/// Mean of at most the last N values, as `rcppmath::RollingMeanAccumulator`.
#[derive(Clone, Debug, PartialEq)]
pub struct RollingMeanAccumulator {
    values: VecDeque<f64>,
    max_count: usize,
    sum: f64,
}

impl RollingMeanAccumulator {
    /// Creates an accumulator of at least one value.
    #[must_use]
    pub fn new(max_count: usize) -> Self {
        Self { values: VecDeque::new(), max_count: max_count.max(1), sum: 0.0 }
    }

    /// Adds a value and forgets the oldest one if there are more than N.
    pub fn push(&mut self, value: f64) {
        if self.values.len() == self.max_count {
            self.sum -= self.values.pop_front().unwrap_or_default();
        }
        self.values.push_back(value);
        self.sum += value;
    }

    /// Returns the mean; zero without values.
    #[must_use]
    pub fn mean(&self) -> f64 {
        if self.values.is_empty() { 0.0 } else { self.sum / self.values.len() as f64 }
    }

    /// Forgets all values.
    pub fn clear(&mut self) {
        self.values.clear();
        self.sum = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_value_leaves_the_mean() {
        let mut mean = RollingMeanAccumulator::new(2);
        assert_eq!(mean.mean(), 0.0);
        mean.push(1.0);
        assert_eq!(mean.mean(), 1.0);
        mean.push(3.0);
        mean.push(5.0);
        assert_eq!(mean.mean(), 4.0);
        mean.clear();
        assert_eq!(mean.mean(), 0.0);
    }
}
