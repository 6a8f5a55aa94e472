//! Why a cell is marked, or is not.

use std::fmt;

use periplus_grid::Cell;

use crate::{Cause, LayeredCostmap, Source};

/// What a layer gives a cell, and why.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Explanation {
    /// The cost; none when the layer has nothing to say.
    pub value: Option<u8>,
    /// Why, in words.
    pub reason: Option<String>,
    /// The reading that decided.
    pub cause: Option<Cause>,
    /// The parameter to look at.
    pub parameter: Option<String>,
    /// What layers within it say.
    pub within: Vec<(String, Explanation)>,
}

/// What a layer says of a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerReport {
    /// Its name.
    pub name: String,
    /// Whether it takes part.
    pub is_enabled: bool,
    /// What it says.
    pub explanation: Explanation,
}

/// All that is known of a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CellReport {
    /// The cell.
    pub cell: Cell,
    /// Its centre in the global frame \[m\].
    pub centre_m: (f64, f64),
    /// Its cost.
    pub cost: u8,
    /// Layers and filters, lowest first.
    pub layers: Vec<LayerReport>,
}

impl LayeredCostmap {
    /// All that is known of a cell; none outside.
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

    /// A source of a layer, to give it something to see.
    #[must_use]
    pub fn source_mut(&mut self, layer: &str, source: &str) -> Option<&mut Source> {
        self.find_mut(layer)?.sources_mut().iter_mut().find(|found| found.name == source)
    }
}

/// What a cost means, in words.
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
