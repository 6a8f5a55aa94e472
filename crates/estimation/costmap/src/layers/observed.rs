//! State and behaviour shared by obstacle and voxel layers.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/obstacle_layer.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_grid::{Cell, GridInfo};
use periplus_params::{ParamValues, Params as _};

use crate::clear::clear_cells;
use crate::cost::{FREE, LETHAL, UNKNOWN};
use crate::observation::RangeLimits;
use crate::polygon::PolygonColumns;
use crate::tables::ObservationLayerParams;
use crate::trace::ReadingTrace;
use crate::{
    CellWindow, Combination, Costmap, Explanation, Nav2Release, ObservationSource, UpdateBounds,
    UpdateContext,
};

/// Grid, sources and reset state of a layer with observation sources.
pub(crate) struct ObservationLayer {
    pub(crate) name: String,
    pub(crate) values: ParamValues,
    pub(crate) is_enabled: bool,
    clears_footprint: bool,
    pub(crate) heights: RangeLimits,
    combination: Combination,
    /// Method that Humble does not support: the layer writes nothing there.
    is_late_combination: bool,
    pub(crate) grid: Costmap,
    pub(crate) sources: Vec<ObservationSource>,
    pub(crate) trace: ReadingTrace,
    extra: Option<UpdateBounds>,
    outline: Vec<[f64; 2]>,
    /// True after a reset until the next update.
    is_waiting: bool,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl ObservationLayer {
    pub(crate) fn new(
        name: String,
        values: ParamValues,
        tracks_unknown: bool,
        sources: Vec<ObservationSource>,
    ) -> Self {
        let mut observed = Self {
            name,
            values: values.clone(),
            is_enabled: true,
            clears_footprint: true,
            heights: RangeLimits::default(),
            combination: Combination::Max,
            is_late_combination: false,
            grid: Costmap::empty(if tracks_unknown { UNKNOWN } else { FREE }),
            sources,
            trace: ReadingTrace::default(),
            extra: None,
            outline: Vec::new(),
            is_waiting: false,
            diagnostics: Vec::new(),
        };
        observed.configure(values);
        observed
    }

    pub(crate) fn configure(&mut self, values: ParamValues) {
        let params = ObservationLayerParams::from_values(&values);
        self.is_enabled = params.layer.is_enabled;
        self.clears_footprint = params.footprint_clearing_enabled;
        self.heights = RangeLimits {
            min_m: params.min_obstacle_height_m,
            max_m: params.max_obstacle_height_m,
        };
        let method = params.combination.method;
        self.combination = Combination::from_number(method);
        self.is_late_combination = !(0..=1).contains(&method);
        if !(0..=2).contains(&method) {
            self.diagnostics.push(
                Diagnostic::warning(
                    "bad-value",
                    format!("`{}.combination_method` is {method}; 1 is used", self.name),
                )
                .at(values.origin("combination_method"))
                .note("0 overwrites, 1 is the maximum, 2 the maximum of known costs; with `compat: humble` only 0 and 1 write anything"),
            );
        }
        self.values = values;
    }

    pub(crate) fn resized(&mut self, info: &GridInfo) {
        self.grid.resize(*info);
        self.trace.resize(self.grid.info());
    }

    /// Begins an update; returns false when the layer is disabled.
    pub(crate) fn begin(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) -> bool {
        if moment.is_rolling {
            self.grid.roll_around(moment.robot, moment.compat);
            self.trace.follow(self.grid.info());
        }
        if !self.is_enabled {
            return false;
        }
        if let Some(extra) = self.extra.take() {
            bounds.include(&extra);
        }
        for source in &mut self.sources {
            source.purge(moment.now_ns);
        }
        true
    }

    /// Ends the bounds pass of an update.
    pub(crate) fn end(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        for source in &mut self.sources {
            source.fresh = 0;
        }
        if self.clears_footprint {
            self.outline = moment.footprint.placed(moment.robot);
            for [x_m, y_m] in &self.outline {
                bounds.touch(*x_m, *y_m);
            }
        }
    }

    pub(crate) fn costs(&mut self, compat: Nav2Release, master: &mut Costmap, window: CellWindow) {
        if !self.is_enabled {
            return;
        }
        self.is_waiting = false;
        if self.clears_footprint
            && let Some(columns) = PolygonColumns::of(&self.grid, &self.outline)
        {
            for cell in columns.cells() {
                self.grid.set(cell, FREE);
            }
        }
        if compat.knows_max_of_known() || !self.is_late_combination {
            self.combination.apply(master, &self.grid, &window);
        }
    }

    pub(crate) fn reset(&mut self) {
        self.grid.reset();
        self.trace.forget();
        self.is_waiting = true;
    }

    pub(crate) fn clear_area(
        &mut self,
        start: (i64, i64),
        end: (i64, i64),
        invert: bool,
        compat: Nav2Release,
    ) {
        clear_cells(&mut self.grid, start, end, invert, compat);
        self.is_waiting = true;
        // The next update rewrites the whole grid.
        self.extra.get_or_insert(UpdateBounds::EMPTY).include(&UpdateBounds::of(self.grid.info()));
    }

    pub(crate) fn is_current(&self, now_ns: i64) -> bool {
        !self.is_waiting && self.sources.iter().all(|source| source.is_current(now_ns))
    }

    pub(crate) fn explain(&self, cell: Cell) -> Explanation {
        let value = self.grid.cost(cell);
        let cause = self.trace.cause(cell);
        let (reason, parameter) = match (value, &cause) {
            (Some(LETHAL), Some(cause)) if cause.is_mark => {
                (format!("`{}` observed an obstacle here", cause.source), None)
            }
            (Some(FREE), Some(cause)) if cause.is_mark => (
                "the robot was here, and its footprint was cleared".to_owned(),
                Some(format!("{}.footprint_clearing_enabled", self.name)),
            ),
            (Some(FREE), Some(cause)) => (
                format!("a ray of `{}` crossed this cell", cause.source),
                Some(format!("{}.{}.raytrace_max_range", self.name, cause.source)),
            ),
            (Some(UNKNOWN), _) => {
                ("the cell was never observed, or it was cleared".to_owned(), None)
            }
            (Some(_), _) => {
                ("the cell was never observed, and unobserved cells are free".to_owned(), {
                    Some("track_unknown_space".to_owned())
                })
            }
            (None, _) => ("the layer has no such cell".to_owned(), None),
        };
        Explanation { value, reason: Some(reason), cause, parameter, within: Vec::new() }
    }
}

/// Warns about a sensor outside the grid, once each time that it leaves the grid.
pub(crate) fn warn_sensor_outside(
    is_outside: bool,
    layer: &str,
    source: &mut ObservationSource,
    [x, y, z]: [f64; 3],
    info: &GridInfo,
    heights: Option<(f64, f64)>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    if is_outside && !source.was_outside {
        let UpdateBounds { min_x, min_y, max_x, max_y } = UpdateBounds::of(info);
        let text = match heights {
            None => format!(
                "sensor origin at ({x:.2}, {y:.2}) is out of map bounds ({min_x:.2}, {min_y:.2}) \
                 to ({max_x:.2}, {max_y:.2}); the costmap cannot raytrace for it"
            ),
            Some((min_z, max_z)) => format!(
                "sensor origin at ({x:.2}, {y:.2}, {z:.2}) is out of map bounds \
                 ({min_x:.2}, {min_y:.2}, {min_z:.2}) to ({max_x:.2}, {max_y:.2}, {max_z:.2}); \
                 the costmap cannot raytrace for it"
            ),
        };
        let is_too_high = heights.is_some_and(|(min_z, max_z)| z < min_z || z > max_z);
        let help = if is_too_high {
            format!(
                "raise `{layer}.z_voxels` (16 at most) or `{layer}.z_resolution`, or lower `{layer}.origin_z`"
            )
        } else {
            "check `sensor_frame` and the transform of the sensor, or enlarge the costmap"
                .to_owned()
        };
        diagnostics.push(
            Diagnostic::warning("sensor-outside", text)
                .at(source.values.origin("topic"))
                .note(format!("source `{}` of layer `{layer}`", source.name))
                .help(help),
        );
    }
    source.was_outside = is_outside;
}

/// Implements [`crate::Layer`] methods for a type with an [`ObservationLayer`] in its field
/// `observed`.
macro_rules! delegate_to_observation_layer {
    () => {
        fn name(&self) -> &str {
            &self.observed.name
        }
        fn is_clearable(&self) -> bool {
            true
        }
        fn is_enabled(&self) -> bool {
            self.observed.is_enabled
        }
        fn is_current(&self, now_ns: i64) -> bool {
            self.observed.is_current(now_ns)
        }
        fn grid(&self) -> Option<&Costmap> {
            Some(&self.observed.grid)
        }
        fn values(&self) -> Option<&ParamValues> {
            Some(&self.observed.values)
        }
        fn sources(&self) -> &[ObservationSource] {
            &self.observed.sources
        }
        fn sources_mut(&mut self) -> &mut [ObservationSource] {
            &mut self.observed.sources
        }
        fn costs(&mut self, moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
            self.observed.costs(moment.compat, master, window);
        }
        fn clear_area(
            &mut self,
            start: (i64, i64),
            end: (i64, i64),
            invert: bool,
            compat: Nav2Release,
        ) {
            self.observed.clear_area(start, end, invert, compat);
        }
        fn diagnostics(&mut self) -> Vec<Diagnostic> {
            std::mem::take(&mut self.observed.diagnostics)
        }
    };
}
pub(crate) use delegate_to_observation_layer;
