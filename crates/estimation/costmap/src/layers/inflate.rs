//! Inflation layer: costs around obstacles.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/inflation_layer.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_grid::{Cell, GridInfo};
use periplus_params::ParamValues;

use crate::cost::{LETHAL, UNKNOWN};
use crate::inflation::{CostTable, InflationBuffers, InflationSettings, inflate};
use crate::tables::InflationLayerParams;
use crate::{
    CellWindow, ChangeError, Costmap, Explanation, Footprint, InflationLaw, Layer, Nav2Release,
    UpdateBounds, UpdateContext,
};

/// Layer that inflates obstacles.
pub struct InflationLayer {
    name: String,
    values: ParamValues,
    params: InflationLayerParams,
    how: InflationSettings,
    /// Inscribed radius of the footprint, without `custom_inscribed_radius` \[m\].
    inscribed_radius_m: f64,
    resolution_m: f64,
    compat: Nav2Release,
    table: CostTable,
    /// Bounds of the previous update, without the margin.
    last: UpdateBounds,
    must_redo: bool,
    is_waiting: bool,
    scratch: InflationBuffers,
    diagnostics: Vec<Diagnostic>,
}

impl InflationLayer {
    /// Creates the layer from parameters of [`crate::tables::INFLATION`].
    #[must_use]
    pub fn new(name: impl Into<String>, values: ParamValues, compat: Nav2Release) -> Self {
        let mut layer = Self {
            name: name.into(),
            values: values.clone(),
            params: InflationLayerParams::from_values(&values),
            how: InflationSettings::default(),
            inscribed_radius_m: 0.0,
            resolution_m: 1.0,
            compat,
            table: CostTable::new(1.0, 0.0, 0.0, 0.0, compat),
            last: UpdateBounds::ALL,
            must_redo: false,
            is_waiting: false,
            scratch: InflationBuffers::default(),
            diagnostics: Vec::new(),
        };
        layer.take(values);
        layer.must_redo = false;
        layer
    }

    fn take(&mut self, values: ParamValues) {
        self.params = InflationLayerParams::from_values(&values);
        self.how = InflationSettings {
            into_unknown: self.params.inflate_unknown,
            around_unknown: self.params.inflate_around_unknown,
        };
        self.values = values;
        self.rebuild_table();
    }

    fn rebuild_table(&mut self) {
        let scaling = self.params.cost_scaling_factor;
        let inscribed_m = self.inscribed_m();
        self.table = CostTable::new(
            self.resolution_m,
            self.params.inflation_radius_m,
            inscribed_m,
            scaling,
            self.compat,
        );
        self.must_redo = true;
    }

    fn inscribed_m(&self) -> f64 {
        let custom_m = self.params.custom_inscribed_radius_m;
        if custom_m >= 0.0 { custom_m } else { self.inscribed_radius_m }
    }

    /// Returns the law by which costs fall.
    #[must_use]
    pub fn law(&self) -> InflationLaw {
        InflationLaw {
            radius_m: self.params.inflation_radius_m,
            scaling_per_m: self.params.cost_scaling_factor,
        }
    }

    /// Returns the table of costs.
    #[must_use]
    pub fn table(&self) -> &CostTable {
        &self.table
    }
}

impl Layer for InflationLayer {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        let last = std::mem::replace(&mut self.last, *bounds);
        if std::mem::take(&mut self.must_redo) {
            *bounds = UpdateBounds::ALL;
            if moment.compat.forgets_bounds_when_redone() {
                // The whole map was just inflated; this update need not repeat it.
                self.last = UpdateBounds::EMPTY;
            }
        } else {
            // Costs around removed obstacles must be removed as well.
            bounds.include(&last);
            *bounds = bounds.grown(self.params.inflation_radius_m);
        }
    }

    fn costs(&mut self, _moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
        if self.params.layer.is_enabled && self.table.radius_cells() > 0 {
            inflate(master, &window, &self.table, self.how, &mut self.scratch);
            self.is_waiting = false;
        }
    }

    fn reset(&mut self) {
        self.must_redo = true;
        self.is_waiting = true;
    }

    fn is_current(&self, _now_ns: i64) -> bool {
        !self.is_waiting
    }

    fn is_enabled(&self) -> bool {
        self.params.layer.is_enabled
    }

    fn footprint_changed(&mut self, footprint: &Footprint) {
        self.inscribed_radius_m = footprint.inscribed_radius_m;
        self.rebuild_table();
        let inscribed_m = self.inscribed_m();
        if self.params.inflation_radius_m > 0.0
            && self.params.inflation_radius_m < inscribed_m
            && inscribed_m < f64::MAX
        {
            self.diagnostics.push(
                Diagnostic::warning(
                    "inflation-too-small",
                    format!(
                        "`{}.inflation_radius` is {} m, less than the robot's inscribed radius of \
                         {inscribed_m:.3} m",
                        self.name, self.params.inflation_radius_m
                    ),
                )
                .at(self.values.origin("inflation_radius"))
                .note("planners require costs in all cells in which the robot would collide")
                .help(format!("set it to {inscribed_m:.2} or more")),
            );
        }
    }

    fn resized(&mut self, info: &GridInfo, _is_rolling: bool) {
        let must_redo = self.must_redo;
        self.resolution_m = info.resolution_m;
        self.rebuild_table();
        self.must_redo = must_redo;
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        self.take(values);
        Ok(())
    }

    fn explain(&self, master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        let around = |cost| cost == LETHAL || (self.how.around_unknown && cost == UNKNOWN);
        let (x, y) = cell;
        let window = CellWindow { x0: x, y0: y, xn: x + 1, yn: y + 1 };
        let near = window.grown(self.table.radius_cells() as usize, master.info());
        let nearest = (near.y0..near.yn)
            .flat_map(|y| (near.x0..near.xn).map(move |x| (x, y)))
            .filter(|cell| master.cost(*cell).is_some_and(around))
            .map(|at| ((at.0.abs_diff(x).pow(2) + at.1.abs_diff(y).pow(2)) as u32, at))
            .min();
        let radius = Some(format!("{}.inflation_radius", self.name));
        match nearest.map(|(square, at)| (square, at, self.table.cost(square))) {
            Some((square, at, cost)) if cost > 0 => Explanation {
                value: Some(cost),
                reason: Some(format!(
                    "the nearest obstacle is cell ({}, {}), {:.3} m away",
                    at.0,
                    at.1,
                    f64::from(square).sqrt() * self.resolution_m
                )),
                parameter: radius,
                ..Explanation::default()
            },
            _ => Explanation {
                value: Some(0),
                reason: Some("no obstacle is near".to_owned()),
                parameter: radius,
                ..Explanation::default()
            },
        }
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }
}
