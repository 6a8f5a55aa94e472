//! Reasons for the cost of a cell.

use std::fmt;

use periplus_grid::Cell;

use crate::{Cause, LayeredCostmap, ObservationSource};

/// Contribution of a layer to a cell, with the reason.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Explanation {
    /// Cost; none when the layer does not affect the cell.
    pub value: Option<u8>,
    /// Reason, as a sentence.
    pub reason: Option<String>,
    /// Reading that set the cell.
    pub cause: Option<Cause>,
    /// Parameter that controls it.
    pub parameter: Option<String>,
    /// Contributions of the layers of a container.
    pub within: Vec<(String, Explanation)>,
}

/// Report of a layer about a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerReport {
    /// Name of the layer.
    pub name: String,
    /// True if the layer is enabled.
    pub is_enabled: bool,
    /// Contribution of the layer.
    pub explanation: Explanation,
}

/// Report about a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CellReport {
    /// Cell.
    pub cell: Cell,
    /// Centre in the global frame \[m\].
    pub centre_m: (f64, f64),
    /// Cost.
    pub cost: u8,
    /// Layers and filters, lowest first.
    pub layers: Vec<LayerReport>,
}

impl LayeredCostmap {
    /// Returns a report about a cell; none outside the grid.
    #[must_use]
    pub fn inspect(&self, cell: Cell) -> Option<CellReport> {
        let cost = self.costmap().cost(cell)?;
        let is_rolling = self.frame().is_rolling;
        let layers = self.layers().iter().chain(self.filters()).map(|layer| LayerReport {
            name: layer.name().to_owned(),
            is_enabled: layer.is_enabled(),
            explanation: layer.explain(self.costmap(), cell, is_rolling),
        });
        let layers = layers.collect();
        Some(CellReport { cell, centre_m: self.costmap().info().centre_of(cell), cost, layers })
    }

    /// Returns a source of a layer, for inserting observations.
    #[must_use]
    pub fn source_mut(&mut self, layer: &str, source: &str) -> Option<&mut ObservationSource> {
        self.find_mut(layer)?.sources_mut().iter_mut().find(|found| found.name == source)
    }
}

/// Returns a description of a cost.
fn meaning(cost: u8) -> &'static str {
    match cost {
        0 => "free",
        253 => "inscribed",
        254 => "lethal",
        255 => "unknown",
        _ => "near an obstacle",
    }
}

impl fmt::Display for CellReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x_m, y_m) = self.centre_m;
        let (column, row) = self.cell;
        let cost = self.cost;
        writeln!(f, "cell ({column}, {row}) at ({x_m:.3}, {y_m:.3}) m: {cost}, {}", meaning(cost))?;
        for layer in &self.layers {
            let state = if layer.is_enabled { "" } else { " (not enabled)" };
            explain(f, 1, &format!("{}{state}", layer.name), &layer.explanation)?;
        }
        Ok(())
    }
}

fn explain(
    f: &mut fmt::Formatter<'_>,
    depth: usize,
    name: &str,
    about: &Explanation,
) -> fmt::Result {
    let indent = "  ".repeat(depth);
    let value = match about.value {
        Some(value) => format!("{value}, {}", meaning(value)),
        None => "nothing".to_owned(),
    };
    write!(f, "{indent}{name}: {value}")?;
    if let Some(reason) = &about.reason {
        write!(f, "; {reason}")?;
    }
    if let Some(parameter) = &about.parameter {
        write!(f, " [{parameter}]")?;
    }
    writeln!(f)?;
    if let Some(cause) = &about.cause {
        let how = if cause.is_mark { "marked" } else { "cleared" };
        let [ox, oy, oz] = cause.origin;
        let [ex, ey] = cause.end;
        writeln!(
            f,
            "{indent}  {how} by `{}` at {:.3} s: ray from ({ox:.2}, {oy:.2}, {oz:.2}) to ({ex:.2}, {ey:.2})",
            cause.source,
            cause.time_ns as f64 / 1e9,
        )?;
    }
    for (name, within) in &about.within {
        explain(f, depth + 1, name, within)?;
    }
    Ok(())
}
