//! Statistics over the seeds of each point of a sweep.

use serde::Serialize;

use crate::plan::SweepPlan;
use crate::table::SweepTable;

/// Statistics of a metric at a point. Runs without a value are left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MetricStatistics {
    /// Name of the column.
    pub name: String,
    /// Number of runs with a value.
    pub count: usize,
    /// Mean value.
    pub mean: f64,
    /// Quantile of 10 %.
    pub q10: f64,
    /// Median.
    pub median: f64,
    /// Quantile of 90 %.
    pub q90: f64,
}

/// Statistics of a point.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PointStatistics {
    /// Values of the parameters, as texts.
    pub values: Vec<String>,
    /// Number of runs.
    pub runs: usize,
    /// Metrics that have a value in at least one run.
    pub metrics: Vec<MetricStatistics>,
}

/// Statistics of all points, in the order of the plan.
#[must_use]
pub fn statistics(plan: &SweepPlan, table: &SweepTable) -> Vec<PointStatistics> {
    let metrics: Vec<(&str, Vec<Option<f64>>)> = table
        .columns
        .iter()
        .filter(|column| column.is_metric)
        .map(|column| (column.name.as_str(), column.values.numbers()))
        .collect();
    let mut points = Vec::new();
    let mut start = 0;
    for jobs in plan.jobs.chunk_by(|a, b| a.values == b.values) {
        let rows = start..start + jobs.len();
        start = rows.end;
        let of = |(name, values): &(&str, Vec<Option<f64>>)| {
            let given: Vec<f64> = values[rows.clone()].iter().flatten().copied().collect();
            summarize(name, given)
        };
        points.push(PointStatistics {
            values: jobs[0].values.clone(),
            runs: jobs.len(),
            metrics: metrics.iter().filter_map(of).collect(),
        });
    }
    points
}

fn summarize(name: &str, mut values: Vec<f64>) -> Option<MetricStatistics> {
    values.sort_by(f64::total_cmp);
    let count = values.len();
    let quantiles = [0.1, 0.5, 0.9].map(|share| quantile(&values, share));
    let [Some(q10), Some(median), Some(q90)] = quantiles else { return None };
    let mean = values.iter().sum::<f64>() / count as f64;
    Some(MetricStatistics { name: name.to_owned(), count, mean, q10, median, q90 })
}

/// Quantile of sorted values, interpolated between neighbours (type 7 of Hyndman and Fan 1996, as NumPy's default).
pub(crate) fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let at = share * last as f64;
    let below = at.floor() as usize;
    let (low, high) = (sorted[below], sorted[(below + 1).min(last)]);
    Some(low + (high - low) * (at - below as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_interpolated() {
        let sorted = [0.0, 1.0, 2.0, 3.0, 4.0];
        assert_eq!(quantile(&sorted, 0.5), Some(2.0));
        assert_eq!(quantile(&sorted, 0.9), Some(3.6));
        assert_eq!(quantile(&sorted, 1.0), Some(4.0));
        assert_eq!(quantile(&[7.0], 0.1), Some(7.0));
        assert_eq!(quantile(&[], 0.1), None);
    }
}
