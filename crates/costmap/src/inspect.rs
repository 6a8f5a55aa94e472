//! Why a cell is marked, or is not.

use std::any::Any;

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
        Some(CellReport { cell, centre_m: self.costmap().lattice().centre_of(cell), cost, layers })
    }

    /// A source of a layer, to give it something to see.
    #[must_use]
    pub fn source_mut(&mut self, layer: &str, source: &str) -> Option<&mut Source> {
        self.find_mut(layer)?.sources_mut().iter_mut().find(|found| found.name == source)
    }

    /// What to do about points that get lost, for all sources.
    #[must_use]
    pub fn advice(&self) -> Vec<Advice> {
        self.all()
            .flat_map(|layer| {
                layer.sources().iter().flat_map(|source| {
                    let is_voxel = (layer as &dyn Any).is::<crate::layers::VoxelLayer>();
                    advice(layer.name(), source, is_voxel)
                })
            })
            .collect()
    }
}

/// Where points of a source go, and the parameter that sends them there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Advice {
    /// The source, as `layer.source`.
    pub source: String,
    /// How many points, or messages, it concerns.
    pub count: u64,
    /// Of how many.
    pub of: u64,
    /// What happened to them.
    pub what: &'static str,
    /// The parameter, with all that goes before its name.
    pub parameter: String,
    /// What to do.
    pub help: &'static str,
}

/// What happened to the points of a source, the most first.
#[must_use]
pub fn advice(layer: &str, source: &Source, is_voxel: bool) -> Vec<Advice> {
    let counters = source.counters;
    let own = |name: &str| format!("{layer}.{}.{name}", source.name);
    let above = |name: &str| format!("{layer}.{name}");
    let points = counters.points;
    let clouds = counters.clouds + counters.without_frame + counters.malformed;
    let rows = [
        (
            counters.too_high,
            points,
            "were above the source's greatest height, for marking and clearing",
            own("max_obstacle_height"),
            "it is measured in the global frame and is 0 unless set; set it to the robot's height",
        ),
        (
            counters.too_low,
            points,
            "were below the source's least height, for marking and clearing",
            own("min_obstacle_height"),
            "lower it a little if the floor is not level",
        ),
        (
            counters.layer_too_high,
            points,
            "were above what the layer marks",
            above(if is_voxel { "z_voxels" } else { "max_obstacle_height" }),
            "raise `max_obstacle_height`, and for voxels `z_voxels` or `z_resolution`",
        ),
        (
            counters.layer_too_low,
            points,
            "were below what the layer marks",
            above("min_obstacle_height"),
            "lower it a little if the floor is not level",
        ),
        (
            counters.too_far,
            points,
            "were too far away to mark",
            own("obstacle_max_range"),
            "raise it, and `raytrace_max_range` beyond it",
        ),
        (
            counters.too_near,
            points,
            "were too near to mark",
            own("obstacle_min_range"),
            "lower it if they are no part of the robot",
        ),
        (
            counters.outside,
            points,
            "were beside the costmap",
            "width".to_owned(),
            "enlarge the costmap if they should count",
        ),
        (
            counters.not_finite,
            points,
            "were no numbers",
            own("topic"),
            "clouds have no points without a return; nothing is cleared there",
        ),
        (
            if source.settings.inf_is_valid { 0 } else { counters.without_return },
            points + counters.without_return,
            "had no return, and cleared nothing",
            own("inf_is_valid"),
            "with `true`, infinite ranges clear up to the largest range",
        ),
        (
            counters.without_frame,
            clouds,
            "messages came before anybody knew where the sensor was",
            own("sensor_frame"),
            "check that all nodes use the same time (`use_sim_time`) and the frame is published",
        ),
        (
            counters.malformed,
            clouds,
            "messages could not be read",
            own("data_type"),
            "check that topic and `data_type` belong together",
        ),
        (
            counters.sensor_outside,
            counters.clouds,
            "messages came from a sensor outside of the costmap",
            if is_voxel { above("origin_z") } else { own("sensor_frame") },
            "a sensor above or beside the grid clears nothing",
        ),
    ];
    let mut found: Vec<Advice> = rows
        .into_iter()
        .filter(|row| row.0 > 0)
        .map(|(count, of, what, parameter, help)| Advice {
            source: format!("{layer}.{}", source.name),
            count,
            of,
            what,
            parameter,
            help,
        })
        .collect();
    found.sort_by_key(|advice| std::cmp::Reverse(advice.count));
    found
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source, count, of, what, parameter, help } = self;
        write!(f, "{source}: {count} of {of} {what} (`{parameter}`): {help}")
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
