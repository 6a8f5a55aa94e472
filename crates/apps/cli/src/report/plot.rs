//! Line plots as SVG.

use std::fmt::Write as _;

use super::html::escape;

/// Size of a plot, in units that are about a pixel.
const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 220.0;

/// Space for the numbers of the axes.
const LEFT: f64 = 52.0;
const RIGHT: f64 = 8.0;
const TOP: f64 = 10.0;
const BOTTOM: f64 = 36.0;

/// Number of columns in which a curve keeps its smallest and largest value.
const COLUMN_COUNT: usize = 400;

/// Approximate number of ticks of an axis.
const TICK_COUNT: f64 = 5.0;

/// Curve of a plot.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    pub(super) name: String,
    /// Time \[s\] and value, in the order of time.
    pub(super) points: Vec<(f64, f64)>,
}

/// Plot over time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plot {
    pub(super) title: String,
    pub(super) unit: &'static str,
    pub(super) curves: Vec<Curve>,
}

impl Plot {
    /// Returns the plot as a figure; none without finite points.
    pub(super) fn figure(&self) -> Option<String> {
        let finite = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
            points.iter().copied().filter(|(x, y)| x.is_finite() && y.is_finite()).collect()
        };
        let curves: Vec<(&str, Vec<(f64, f64)>)> = self
            .curves
            .iter()
            .map(|curve| (curve.name.as_str(), finite(&curve.points)))
            .filter(|(_, points)| !points.is_empty())
            .collect();
        let all = || curves.iter().flat_map(|(_, points)| points);
        let first = *all().next()?;
        let bounds = |of: fn(&(f64, f64)) -> f64| {
            all().map(of).fold((of(&first), of(&first)), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        let (x_low, x_high) = bounds(|point| point.0);
        let (y_low, y_high) = bounds(|point| point.1);
        // Magnitudes begin at zero.
        let y_low = if y_low >= 0.0 { 0.0 } else { y_low };
        let x_axis = Axis::of(x_low, x_high);
        let y_axis = Axis::of(y_low, y_high);
        let x = |value: f64| LEFT + (WIDTH - LEFT - RIGHT) * x_axis.part(value);
        let y = |value: f64| HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * y_axis.part(value);
        let title = escape(&format!("{} [{}]", self.title, self.unit));
        let summary = escape(&self.summary(&curves));
        let mut svg = format!(
            "<figure><h3>{title}</h3><svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" \
             aria-label=\"{title}. {summary}\">\n"
        );
        for tick in y_axis.ticks() {
            let at = y(tick);
            let _ = writeln!(
                svg,
                "<line class=\"axis\" x1=\"{LEFT}\" x2=\"{:.1}\" y1=\"{at:.1}\" y2=\"{at:.1}\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                WIDTH - RIGHT,
                LEFT - 6.0,
                at + 4.0,
                y_axis.text(tick)
            );
        }
        for tick in x_axis.ticks() {
            let at = x(tick);
            let _ = writeln!(
                svg,
                "<line class=\"axis\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{TOP}\" y2=\"{:.1}\"/>\
                 <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                HEIGHT - BOTTOM,
                HEIGHT - BOTTOM + 16.0,
                x_axis.text(tick)
            );
        }
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">time [s]</text>",
            WIDTH - RIGHT,
            HEIGHT - 4.0
        );
        for (index, (_, points)) in curves.iter().enumerate() {
            let points = reduced(points, (x_low, x_high));
            let _ = write!(svg, "<polyline class=\"curve s{}\" points=\"", index % 3);
            for (time, value) in points {
                let _ = write!(svg, "{:.1},{:.1} ", x(time), y(value));
            }
            svg.push_str("\"/>\n");
        }
        svg.push_str("</svg><figcaption>");
        if curves.len() > 1 {
            svg.push_str("<ul class=\"legend\">");
            for (index, (name, _)) in curves.iter().enumerate() {
                let _ = write!(svg, "<li>{}{}</li>", key(index), escape(name));
            }
            svg.push_str("</ul>");
        }
        let _ = writeln!(svg, "{summary}</figcaption></figure>");
        Some(svg)
    }

    /// Returns mean and maximum of each curve as a sentence.
    fn summary(&self, curves: &[(&str, Vec<(f64, f64)>)]) -> String {
        let mut parts = Vec::new();
        for (name, points) in curves {
            let values = || points.iter().map(|point| point.1);
            let mean = values().sum::<f64>() / points.len() as f64;
            let (low, high) = values()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
                    (low.min(it), high.max(it))
                });
            let name = if curves.len() > 1 { format!("{name}: ") } else { String::new() };
            let unit = if self.unit == "1" { "" } else { self.unit };
            parts.push(
                format!("{name}mean {mean:.3} {unit}, smallest {low:.3} {unit}, largest {high:.3} {unit}.")
                    .replace(" ,", ",")
                    .replace(" .", "."),
            );
        }
        parts.join(" ")
    }
}

/// Returns a sample of the line of a curve.
pub(super) fn key(index: usize) -> String {
    format!(
        "<svg class=\"key\" viewBox=\"0 0 24 10\" aria-hidden=\"true\"><line class=\"curve s{}\" x1=\"0\" \
         x2=\"24\" y1=\"5\" y2=\"5\" stroke-width=\"3\"/></svg>",
        index % 3
    )
}

/// Keeps the smallest and the largest value of each column.
fn reduced(points: &[(f64, f64)], (low, high): (f64, f64)) -> Vec<(f64, f64)> {
    if points.len() <= 2 * COLUMN_COUNT {
        return points.to_vec();
    }
    let column = |time: f64| ((time - low) / (high - low).max(1e-9) * COLUMN_COUNT as f64) as usize;
    let mut out = Vec::new();
    for group in points.chunk_by(|a, b| column(a.0) == column(b.0)) {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let (min, max) = (group.iter().min_by(by_value), group.iter().max_by(by_value));
        let mut pair: Vec<(f64, f64)> = min.into_iter().chain(max).copied().collect();
        pair.sort_by(|a, b| a.0.total_cmp(&b.0));
        pair.dedup();
        out.extend(pair);
    }
    out
}

/// Axis with round ticks.
#[derive(Clone, Copy, Debug)]
struct Axis {
    low: f64,
    high: f64,
    step: f64,
}

impl Axis {
    fn of(low: f64, high: f64) -> Self {
        let (low, high) = if high > low { (low, high) } else { (low, low + 1.0) };
        let raw = (high - low) / TICK_COUNT;
        let magnitude = libm::pow(10_f64, libm::log10(raw).floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|it| it * magnitude >= raw);
        let step = step.unwrap_or(10.0) * magnitude;
        Self { low, high, step }
    }

    fn part(self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    fn ticks(self) -> impl Iterator<Item = f64> {
        let first = (self.low / self.step - 1e-9).ceil();
        let count = ((self.high / self.step + 1e-9).floor() - first).max(0.0) as usize;
        (0..=count).map(move |index| (first + index as f64) * self.step)
    }

    fn text(self, value: f64) -> String {
        let places = (-libm::log10(self.step).floor()).max(0.0) as usize;
        let text = format!("{value:.places$}");
        if text.trim_start_matches('-').chars().all(|it| "0.".contains(it)) {
            "0".to_owned()
        } else {
            text
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round() {
        let texts = |low, high| {
            let axis = Axis::of(low, high);
            axis.ticks().map(|it| axis.text(it)).collect::<Vec<_>>()
        };
        assert_eq!(texts(0.0, 10.0), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(texts(0.0, 0.55), ["0", "0.2", "0.4"]);
        assert_eq!(texts(-1.0, 1.0), ["-1.0", "-0.5", "0", "0.5", "1.0"]);
        assert_eq!(texts(3.0, 3.0).len(), 6);
    }

    #[test]
    fn peaks_survive_the_reduction() {
        let mut points: Vec<(f64, f64)> = (0..10_000).map(|it| (f64::from(it), 0.0)).collect();
        points[5_555].1 = 7.0;
        let reduced = reduced(&points, (0.0, 9_999.0));
        assert!(reduced.len() <= 2 * COLUMN_COUNT + 2 && reduced.contains(&(5_555.0, 7.0)));
    }

    #[test]
    fn a_plot_without_numbers_is_left_out() {
        let plot = |points: Vec<(f64, f64)>| Plot {
            title: "Speed".into(),
            unit: "m/s",
            curves: vec![Curve { name: "<a>".into(), points }],
        };
        assert_eq!(plot(vec![(0.0, f64::NAN)]).figure(), None);
        let figure = plot(vec![(0.0, 1.0), (1.0, 3.0)]).figure().unwrap();
        assert!(figure.contains("mean 2.000 m/s, smallest 1.000 m/s, largest 3.000 m/s."));
    }
}
