//! Statistics of errors.

/// Statistics of absolute errors, in their unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorStatistics {
    /// Number of errors.
    pub count: usize,
    /// Root of the mean square.
    pub rmse: f64,
    /// Mean.
    pub mean: f64,
    /// Median; the mean of the middle two for an even number.
    pub median: f64,
    /// Standard deviation of the population (divided by the number).
    pub std: f64,
    /// Minimum.
    pub min: f64,
    /// Maximum.
    pub max: f64,
    /// Sum of squares.
    pub sse: f64,
}

impl ErrorStatistics {
    /// Returns the statistics of errors; none without errors.
    #[must_use]
    pub fn of(errors: &[f64]) -> Option<Self> {
        let count = errors.len();
        let (&first, &last) = (errors.first()?, errors.last()?);
        let total = count as f64;
        let sse: f64 = errors.iter().map(|it| it * it).sum();
        let mean = errors.iter().sum::<f64>() / total;
        let variance = errors.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / total;
        Some(Self {
            count,
            rmse: (sse / total).sqrt(),
            mean,
            median: quantile(errors, 0.5)?,
            std: variance.sqrt(),
            min: errors.iter().copied().fold(first, f64::min),
            max: errors.iter().copied().fold(last, f64::max),
            sse,
        })
    }

    /// Returns the statistics by name, in the order of a table.
    #[must_use]
    pub fn numbers(&self) -> [(&'static str, f64); 7] {
        [
            ("rmse", self.rmse),
            ("mean", self.mean),
            ("median", self.median),
            ("std", self.std),
            ("min", self.min),
            ("max", self.max),
            ("sse", self.sse),
        ]
    }
}

/// Returns the quantile of a part, 0 to 1, with linear interpolation between the sorted values (type 7 of
/// Hyndman and Fan 1996, as `numpy.quantile`); none without values.
#[must_use]
pub fn quantile(values: &[f64], part: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let position = part.clamp(0.0, 1.0) * sorted.len().checked_sub(1)? as f64;
    let (low, high) = (position.floor(), position.ceil());
    let (below, above) = (sorted.get(low as usize)?, sorted.get(high as usize)?);
    Some(below + (above - below) * (position - low))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_errors() {
        let found = ErrorStatistics::of(&[1.0, 5.0, 1.0, 1.0]).unwrap();
        let expected = ErrorStatistics {
            count: 4,
            rmse: 7_f64.sqrt(),
            mean: 2.0,
            median: 1.0,
            std: 3_f64.sqrt(),
            min: 1.0,
            max: 5.0,
            sse: 28.0,
        };
        assert_eq!(found, expected);
        assert_eq!(ErrorStatistics::of(&[]), None);
    }

    #[test]
    fn quantiles_are_interpolated() {
        let check = |part: f64, expected: f64| {
            assert_eq!(quantile(&[4.0, 0.0, 1.0], part), Some(expected), "{part}");
        };
        check(0.0, 0.0);
        check(0.25, 0.5);
        check(0.5, 1.0);
        check(1.0, 4.0);
        assert_eq!(quantile(&[], 0.5), None);
    }
}
