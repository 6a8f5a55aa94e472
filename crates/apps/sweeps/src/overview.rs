//! Overview of a sweep as SVG: each metric over each parameter, with quantiles over seeds and the other parameters.

use std::fmt::Write as _;

use crate::plan::SweepPlan;
use crate::statistics::quantile;
use crate::table::{ColumnValues, SweepTable};

/// Size of a panel with its labels, and margins of its plot \[px\].
const PANEL_WIDTH_PX: f64 = 300.0;
const PANEL_HEIGHT_PX: f64 = 170.0;
const LEFT_PX: f64 = 56.0;
const RIGHT_PX: f64 = 14.0;
const TOP_PX: f64 = 28.0;
const BOTTOM_PX: f64 = 34.0;
/// Height of the title \[px\].
const TITLE_HEIGHT_PX: f64 = 40.0;
/// Fraction of the range of the values that is left empty above and below.
const EMPTY_FRACTION: f64 = 0.08;
/// Maximum number of labels on the axis of a parameter.
const MAX_LABELS: usize = 8;
/// Maximum number of letters of a label.
const MAX_LABEL_CHARS: usize = 14;

/// Quantiles of a metric at one value of a parameter.
struct Band {
    x: f64,
    low: f64,
    median: f64,
    high: f64,
}

/// Axis of a parameter: position of each value, 0 to 1, and labels.
struct Axis {
    name: String,
    /// Number of the value of each row.
    value_of_row: Vec<usize>,
    positions: Vec<f64>,
    labels: Vec<String>,
}

/// SVG with a panel for each metric and parameter: the median as a line with points, the quantiles of 10 % and 90 % as a
/// band. Without parameters the seeds are the axis.
#[must_use]
pub fn overview_svg(plan: &SweepPlan, table: &SweepTable) -> String {
    let mut axes: Vec<Axis> =
        (0..plan.names.len()).map(|place| parameter_axis(plan, place)).collect();
    if axes.is_empty() {
        let seeds: Vec<String> = plan.jobs.iter().map(|job| job.seed.to_string()).collect();
        axes.push(axis("seed", &seeds));
    }
    let metrics: Vec<(&str, Vec<Option<f64>>)> = table
        .columns
        .iter()
        .filter(|column| column.is_metric && is_shown(&column.name, &column.values))
        .map(|column| (column.name.as_str(), column.values.numbers()))
        .collect();
    let (width, height) = (
        PANEL_WIDTH_PX * axes.len() as f64,
        TITLE_HEIGHT_PX + PANEL_HEIGHT_PX * metrics.len() as f64,
    );
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"11\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    let title =
        format!("{}: {} runs, median and quantiles of 10 % and 90 %", plan.name, table.row_count);
    put(&mut out, LEFT_PX, 24.0, "start", 14, &title);
    for (row, (name, values)) in metrics.iter().enumerate() {
        for (column, axis) in axes.iter().enumerate() {
            let corner =
                [PANEL_WIDTH_PX * column as f64, TITLE_HEIGHT_PX + PANEL_HEIGHT_PX * row as f64];
            panel(&mut out, corner, name, axis, values);
        }
    }
    out.push_str("</svg>\n");
    out
}

/// Returns false for assertions, whose measured values are shown, and for metrics without values.
fn is_shown(name: &str, values: &ColumnValues) -> bool {
    let is_assertion = name.starts_with("assert") && matches!(values, ColumnValues::Bool(_));
    !is_assertion && values.numbers().iter().any(Option::is_some)
}

fn parameter_axis(plan: &SweepPlan, place: usize) -> Axis {
    let texts: Vec<String> = plan.jobs.iter().map(|job| job.values[place].clone()).collect();
    axis(&plan.names[place], &texts)
}

/// Axis over texts: by their numbers if all are numbers, otherwise in the order of their first appearance.
fn axis(name: &str, texts: &[String]) -> Axis {
    let mut values: Vec<&String> = Vec::new();
    for text in texts {
        if !values.contains(&text) {
            values.push(text);
        }
    }
    let numbers: Option<Vec<f64>> =
        values.iter().map(|it| it.parse().ok().filter(|it: &f64| it.is_finite())).collect();
    let positions = match &numbers {
        Some(numbers) => {
            let low = numbers.iter().copied().fold(f64::INFINITY, f64::min);
            let high = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let width = if high > low { high - low } else { 1.0 };
            numbers.iter().map(|it| if high > low { (it - low) / width } else { 0.5 }).collect()
        }
        None => (0..values.len()).map(|it| (it as f64 + 0.5) / values.len() as f64).collect(),
    };
    let value_of_row = texts
        .iter()
        .map(|text| values.iter().position(|it| *it == text).unwrap_or_default())
        .collect();
    let labels = values.iter().map(|it| shortened(it)).collect();
    Axis { name: name.to_owned(), value_of_row, positions, labels }
}

fn shortened(text: &str) -> String {
    if text.chars().count() <= MAX_LABEL_CHARS {
        return text.to_owned();
    }
    let tail: String = text.chars().rev().take(MAX_LABEL_CHARS - 1).collect();
    format!("…{}", tail.chars().rev().collect::<String>())
}

fn bands(axis: &Axis, values: &[Option<f64>]) -> Vec<Band> {
    let mut of_value = vec![Vec::new(); axis.positions.len()];
    for (row, value) in axis.value_of_row.iter().zip(values) {
        of_value[*row].extend(*value);
    }
    let mut bands: Vec<Band> = of_value
        .iter_mut()
        .zip(&axis.positions)
        .filter_map(|(values, x)| {
            values.sort_by(f64::total_cmp);
            let [low, median, high] = [0.1, 0.5, 0.9].map(|share| quantile(values, share));
            Some(Band { x: *x, low: low?, median: median?, high: high? })
        })
        .collect();
    bands.sort_by(|a, b| a.x.total_cmp(&b.x));
    bands
}

fn panel(out: &mut String, [left, top]: [f64; 2], name: &str, axis: &Axis, values: &[Option<f64>]) {
    // `passed` is drawn as the share of runs, whose median is 0 or 1.
    let is_share = values.iter().flatten().all(|it| *it == 0.0 || *it == 1.0) && name == "passed";
    let mut bands = bands(axis, values);
    if is_share {
        share(axis, values, &mut bands);
    }
    let (x0, x1) = (left + LEFT_PX, left + PANEL_WIDTH_PX - RIGHT_PX);
    let (y0, y1) = (top + PANEL_HEIGHT_PX - BOTTOM_PX, top + TOP_PX);
    let low = bands.iter().map(|it| it.low).fold(f64::INFINITY, f64::min);
    let high = bands.iter().map(|it| it.high).fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = if is_share { (0.0, 1.0) } else { (low, high) };
    let (low, high) = if high > low { (low, high) } else { (low - 0.5, high + 0.5) };
    let margin = (high - low) * EMPTY_FRACTION;
    let inset = 8.0;
    let x_of = |x: f64| x0 + inset + x * (x1 - x0 - 2.0 * inset);
    let y_of = |y: f64| y0 - (y - low + margin) / (high - low + 2.0 * margin) * (y0 - y1);
    let _ = writeln!(
        out,
        "<rect x=\"{x0:.1}\" y=\"{y1:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" stroke=\"#999\"/>",
        x1 - x0,
        y0 - y1
    );
    let title = if is_share { "passed (share of runs)" } else { name };
    put(out, x0, y1 - 6.0, "start", 12, title);
    for value in [low, high] {
        put(out, x0 - 4.0, y_of(value) + 4.0, "end", 10, &short_number(value));
    }
    put(out, x1, top + PANEL_HEIGHT_PX - 5.0, "end", 11, &axis.name);
    let step = axis.labels.len().div_ceil(MAX_LABELS).max(1);
    for (position, label) in axis.positions.iter().zip(&axis.labels).step_by(step) {
        put(out, x_of(*position), y0 + 13.0, "middle", 10, label);
    }
    let point = |x: f64, y: f64| format!("{:.1},{:.1}", x_of(x), y_of(y));
    let forth = bands.iter().map(|it| point(it.x, it.high));
    let back = bands.iter().rev().map(|it| point(it.x, it.low));
    let outline: Vec<String> = forth.chain(back).collect();
    let line: Vec<String> = bands.iter().map(|it| point(it.x, it.median)).collect();
    let _ = writeln!(
        out,
        "<polygon points=\"{}\" fill=\"#285ae6\" fill-opacity=\"0.2\"/>",
        outline.join(" ")
    );
    let _ = writeln!(
        out,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#285ae6\" stroke-width=\"1.5\"/>",
        line.join(" ")
    );
    for band in &bands {
        let (x, y) = (x_of(band.x), y_of(band.median));
        let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.5\" fill=\"#285ae6\"/>");
    }
}

/// Replaces quantiles by the mean.
fn share(axis: &Axis, values: &[Option<f64>], bands: &mut Vec<Band>) {
    let mut sums = vec![(0.0, 0.0); axis.positions.len()];
    for (row, value) in axis.value_of_row.iter().zip(values) {
        if let Some(value) = value {
            sums[*row].0 += value;
            sums[*row].1 += 1.0;
        }
    }
    let of = |((sum, count), x): (&(f64, f64), &f64)| {
        let mean = sum / count;
        (*count > 0.0).then_some(Band { x: *x, low: mean, median: mean, high: mean })
    };
    *bands = sums.iter().zip(&axis.positions).filter_map(of).collect();
    bands.sort_by(|a, b| a.x.total_cmp(&b.x));
}

/// Number with at most four significant digits.
fn short_number(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    let text = format!("{rounded}");
    if text.len() <= 8 { text } else { format!("{value:.1e}") }
}

fn put(out: &mut String, x: f64, y: f64, anchor: &str, size_px: u32, text: &str) {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let _ = writeln!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"{size_px}\">{text}</text>"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_placed_by_their_value_and_words_by_their_order() {
        let of = |texts: &[&str]| {
            axis("a", &texts.iter().map(|it| (*it).to_owned()).collect::<Vec<_>>()).positions
        };
        assert_eq!(of(&["0", "0", "1", "4"]), [0.0, 0.25, 1.0]);
        assert_eq!(of(&["x", "y"]), [0.25, 0.75]);
        assert_eq!(of(&["3"]), [0.5]);
    }

    #[test]
    fn a_band_has_the_quantiles_of_the_rows_with_its_value() {
        let rows = ["1", "1", "1", "2"].map(str::to_owned);
        let found = bands(&axis("a", &rows), &[Some(3.0), Some(1.0), Some(2.0), None]);
        assert_eq!(found.len(), 1);
        assert_eq!([found[0].low, found[0].median, found[0].high], [1.2, 2.0, 2.8]);
    }

    #[test]
    fn texts_are_escaped_and_shortened() {
        let mut out = String::new();
        put(&mut out, 0.0, 0.0, "end", 10, "a<b&c");
        assert!(out.contains("a&lt;b&amp;c"), "{out}");
        assert_eq!(shortened("package://robots/b.urdf"), "…robots/b.urdf");
        assert_eq!(short_number(0.123_456), "0.1235");
    }
}
