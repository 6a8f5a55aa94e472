//! Denoise layer: removes small obstacles.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/denoise_layer.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_grid::Cell;
use periplus_params::ParamValues;

use crate::cost::{FREE, INSCRIBED, LETHAL, UNKNOWN};
use crate::tables::DenoiseLayerParams;
use crate::{CellWindow, ChangeError, Costmap, Explanation, Layer, UpdateBounds, UpdateContext};

/// Frees groups of obstacle cells with fewer than `smallest` cells. Neighbouring cells form a
/// group, with `diagonally` also across a corner. Cells outside the window are ignored.
pub fn denoise(
    master: &mut Costmap,
    window: &CellWindow,
    smallest: usize,
    diagonally: bool,
    unknown_is_obstacle: bool,
) {
    let (width, height) = (window.width(), window.height());
    if smallest <= 1 || window.is_empty() {
        return;
    }
    let is_obstacle = |cost: u8| match cost {
        LETHAL | INSCRIBED => true,
        UNKNOWN => unknown_is_obstacle,
        _ => false,
    };
    let info = *master.info();
    // Cells still to visit. Each is visited once, so the run time is linear in the window.
    let mut waits: Vec<bool> = window
        .spans(info.width)
        .flat_map(|span| master.costs()[span].iter().map(|cost| is_obstacle(*cost)))
        .collect();
    let mut group: Vec<(usize, usize)> = Vec::new();
    for y in 0..height {
        for x in 0..width {
            if !std::mem::take(&mut waits[y * width + x]) {
                continue;
            }
            group.clear();
            group.push((x, y));
            let mut next = 0;
            while let Some(&at) = group.get(next) {
                next += 1;
                for (x, y) in neighbours(at, width, height, diagonally) {
                    if std::mem::take(&mut waits[y * width + x]) {
                        group.push((x, y));
                    }
                }
            }
            if group.len() < smallest {
                for (x, y) in &group {
                    let index = (window.y0 + y) * info.width + window.x0 + x;
                    master.costs_mut()[index] = FREE;
                }
            }
        }
    }
}

fn neighbours(
    (x, y): Cell,
    width: usize,
    height: usize,
    diagonally: bool,
) -> impl Iterator<Item = Cell> {
    const NEIGHBOUR_DIRECTIONS: [[isize; 2]; 8] =
        [[-1, 0], [1, 0], [0, -1], [0, 1], [-1, -1], [1, -1], [-1, 1], [1, 1]];
    let count = if diagonally { 8 } else { 4 };
    NEIGHBOUR_DIRECTIONS.into_iter().take(count).filter_map(move |[dx, dy]| {
        let (x, y) = (x.checked_add_signed(dx)?, y.checked_add_signed(dy)?);
        (x < width && y < height).then_some((x, y))
    })
}

/// Layer that removes small obstacles.
pub struct DenoiseLayer {
    name: String,
    values: ParamValues,
    is_enabled: bool,
    smallest: usize,
    diagonally: bool,
    is_waiting: bool,
    diagnostics: Vec<Diagnostic>,
}

impl DenoiseLayer {
    /// Creates the layer from parameters of [`crate::tables::DENOISE`].
    #[must_use]
    pub fn new(name: impl Into<String>, values: ParamValues) -> Self {
        let mut layer = Self {
            name: name.into(),
            values: values.clone(),
            is_enabled: true,
            smallest: 2,
            diagonally: true,
            is_waiting: false,
            diagnostics: Vec::new(),
        };
        layer.take(values);
        layer
    }

    fn take(&mut self, values: ParamValues) {
        let params = DenoiseLayerParams::from_values(&values);
        self.is_enabled = params.layer.is_enabled;
        let asked = params.minimal_group_size;
        self.smallest = usize::try_from(asked).unwrap_or(1).max(1);
        if asked <= 1 {
            self.warn(
                &values,
                "minimal_group_size",
                asked,
                "keeps every obstacle, so the layer has no effect",
            );
        }
        let ways = params.group_connectivity_type;
        self.diagonally = ways != 4;
        if ways != 4 && ways != 8 {
            self.warn(&values, "group_connectivity_type", ways, "is neither 4 nor 8; 8 is used");
        }
        self.values = values;
    }

    fn warn(&mut self, values: &ParamValues, parameter: &str, value: i64, what: &str) {
        self.diagnostics.push(
            Diagnostic::warning(
                "bad-value",
                format!("`{}.{parameter}`: {value} {what}", self.name),
            )
            .at(values.origin(parameter)),
        );
    }

    /// Returns the minimum size of groups that are kept \[cells\]; 1 keeps all.
    #[must_use]
    pub fn smallest(&self) -> usize {
        self.smallest
    }

    /// Returns the number of neighbours of a cell: 4 or 8.
    #[must_use]
    pub fn ways(&self) -> u8 {
        if self.diagonally { 8 } else { 4 }
    }
}

impl Layer for DenoiseLayer {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, _moment: &UpdateContext<'_>, _bounds: &mut UpdateBounds) {}

    fn costs(&mut self, _moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
        if !self.is_enabled {
            return;
        }
        self.is_waiting = false;
        let unknown_is_obstacle = master.default_cost != UNKNOWN;
        denoise(master, &window, self.smallest, self.diagonally, unknown_is_obstacle);
    }

    fn reset(&mut self) {
        self.is_waiting = true;
    }

    fn is_enabled(&self) -> bool {
        self.is_enabled
    }

    fn is_current(&self, _now_ns: i64) -> bool {
        !self.is_waiting
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        self.take(values);
        Ok(())
    }

    fn explain(&self, _master: &Costmap, _cell: Cell, _is_rolling: bool) -> Explanation {
        let reason = match self.smallest {
            1 => "the layer keeps every obstacle".to_owned(),
            smallest => format!("the layer removes obstacles with fewer than {smallest} cells"),
        };
        Explanation {
            reason: Some(reason),
            parameter: Some(format!("{}.minimal_group_size", self.name)),
            ..Explanation::default()
        }
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }
}
