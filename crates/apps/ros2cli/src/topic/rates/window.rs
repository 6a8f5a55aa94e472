//! Statistics over the last messages.

use std::collections::VecDeque;

/// Sliding window of values, such as the periods between messages.
pub(super) struct Window {
    most: usize,
    values: VecDeque<f64>,
    /// Arrival of the last message \[s\].
    last: Option<f64>,
    is_new: bool,
}

/// Statistics of a window.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spread {
    pub(super) mean: f64,
    pub(super) min: f64,
    pub(super) max: f64,
    pub(super) deviation: f64,
    pub(super) count: usize,
}

impl Spread {
    /// Rate \[Hz\], if the values are periods \[s\].
    pub(super) fn rate(&self) -> f64 {
        if self.mean > 0.0 { 1.0 / self.mean } else { 0.0 }
    }
}

impl Window {
    pub(super) fn new(most: usize) -> Self {
        Self { most: most.max(1), values: VecDeque::new(), last: None, is_new: false }
    }

    /// Adds the period since the last message.
    pub(super) fn arrive(&mut self, at: f64) {
        if let Some(last) = self.last.replace(at) {
            self.take(at - last);
        }
    }

    pub(super) fn take(&mut self, value: f64) {
        if self.values.len() == self.most {
            self.values.pop_front();
        }
        self.values.push_back(value);
        self.is_new = true;
    }

    /// Statistics, if a value was added since the last call.
    pub(super) fn spread_if_new(&mut self) -> Option<Spread> {
        if !std::mem::take(&mut self.is_new) {
            return None;
        }
        let count = self.values.len();
        let mean = self.values.iter().sum::<f64>() / count as f64;
        let squares: f64 = self.values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let least = self.values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let deviation = (squares / count as f64).sqrt();
        Some(Spread { mean, min: least, max: most, deviation, count })
    }
}

/// Arrivals and sizes of the last messages.
pub(super) struct Sizes {
    most: usize,
    messages: VecDeque<(f64, usize)>,
}

/// Bandwidth.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Flow {
    /// \[bytes/s\].
    pub(super) rate: f64,
    pub(super) mean: f64,
    pub(super) min: usize,
    pub(super) max: usize,
    pub(super) count: usize,
}

impl Sizes {
    pub(super) fn new(most: usize) -> Self {
        Self { most: most.max(1), messages: VecDeque::new() }
    }

    pub(super) fn arrive(&mut self, at: f64, size: usize) {
        if self.messages.len() == self.most {
            self.messages.pop_front();
        }
        self.messages.push_back((at, size));
    }

    /// Bandwidth from the first message until now; `None` for fewer than two.
    pub(super) fn flow(&self, now: f64) -> Option<Flow> {
        let (first, _) = *self.messages.front()?;
        let count = self.messages.len();
        if count < 2 || now <= first {
            return None;
        }
        let sizes = || self.messages.iter().map(|(_, size)| *size);
        let total: usize = sizes().sum();
        Some(Flow {
            rate: total as f64 / (now - first),
            mean: total as f64 / count as f64,
            min: sizes().min().unwrap_or(0),
            max: sizes().max().unwrap_or(0),
            count,
        })
    }
}

impl Flow {
    /// Text with a unit that fits the rate.
    pub(super) fn describe(&self) -> String {
        let unit = |bytes: f64| match self.rate {
            rate if rate < 1e3 => format!("{bytes:.0} B"),
            rate if rate < 1e6 => format!("{:.2} KB", bytes / 1e3),
            _ => format!("{:.2} MB", bytes / 1e6),
        };
        format!(
            "{}/s from {} messages\n\tMessage size mean: {} min: {} max: {}",
            unit(self.rate),
            self.count,
            unit(self.mean),
            unit(self.min as f64),
            unit(self.max as f64)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::expect;

    #[test]
    fn rates_are_over_the_window() {
        let mut window = Window::new(2);
        window.arrive(0.0);
        assert_eq!(window.spread_if_new(), None);
        for at in [4.0, 5.0, 8.0] {
            window.arrive(at);
        }
        // The first period of 4 has left the window.
        let spread = Spread { mean: 2.0, min: 1.0, max: 3.0, deviation: 1.0, count: 2 };
        assert_eq!(spread.rate(), 0.5);
        assert_eq!(window.spread_if_new(), Some(spread));
        assert_eq!(window.spread_if_new(), None);
    }

    #[test]
    fn bandwidth_has_a_fitting_unit() {
        let mut sizes = Sizes::new(3);
        sizes.arrive(0.0, 1_000);
        assert_eq!(sizes.flow(1.0), None);
        for (at, size) in [(1.0, 100), (2.0, 200), (3.0, 300)] {
            sizes.arrive(at, size);
        }
        expect![[r#"
            300 B/s from 3 messages
            	Message size mean: 200 B min: 100 B max: 300 B"#]]
        .assert_eq(&sizes.flow(3.0).unwrap().describe());
        let mut sizes = Sizes::new(100);
        sizes.arrive(0.0, 9_830_000);
        sizes.arrive(0.1, 9_830_000);
        expect![[r#"
            98.30 MB/s from 2 messages
            	Message size mean: 9.83 MB min: 9.83 MB max: 9.83 MB"#]]
        .assert_eq(&sizes.flow(0.2).unwrap().describe());
    }
}
