//! What layers that look through sensors have in common.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/obstacle_layer.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_grid::{Cell, GridInfo};
use periplus_params::ParamValues;

use crate::clear::clear_cells;
use crate::cost::{FREE, LETHAL, UNKNOWN};
use crate::observation::Span;
use crate::polygon::Columns;
use crate::trace::Trace;
use crate::{Bounds, Combination, Compat, Costmap, Explanation, Moment, Source, Window};

/// Cells, sources, and when to forget.
pub(crate) struct Sight {
    pub(crate) name: String,
    pub(crate) values: ParamValues,
    pub(crate) is_enabled: bool,
    clears_footprint: bool,
    pub(crate) heights: Span,
    combination: Combination,
    /// A number that Humble does not know: there the layer writes nothing.
    is_late_combination: bool,
    pub(crate) grid: Costmap,
    pub(crate) sources: Vec<Source>,
    pub(crate) trace: Trace,
    extra: Option<Bounds>,
    outline: Vec<[f64; 2]>,
    /// Cleared, and not yet looked at again.
    is_waiting: bool,
    pub(crate) complaints: Vec<Diagnostic>,
}

impl Sight {
    pub(crate) fn new(
        name: String,
        values: ParamValues,
        tracks_unknown: bool,
        sources: Vec<Source>,
    ) -> Self {
        let mut sight = Self {
            name,
            values: values.clone(),
            is_enabled: true,
            clears_footprint: true,
            heights: Span::default(),
            combination: Combination::Max,
            is_late_combination: false,
            grid: Costmap::empty(if tracks_unknown { UNKNOWN } else { FREE }),
            sources,
            trace: Trace::default(),
            extra: None,
            outline: Vec::new(),
            is_waiting: false,
            complaints: Vec::new(),
        };
        sight.configure(values);
        sight
    }

    pub(crate) fn configure(&mut self, values: ParamValues) {
        let number = |name: &str| values.number(name).unwrap_or_default();
        let flag = |name: &str| values.flag(name).unwrap_or_default();
        self.is_enabled = flag("enabled");
        self.clears_footprint = flag("footprint_clearing_enabled");
        self.heights =
            Span { min_m: number("min_obstacle_height"), max_m: number("max_obstacle_height") };
        let method = values.integer("combination_method").unwrap_or(1);
        self.combination = Combination::from_number(method);
        self.is_late_combination = !(0..=1).contains(&method);
        if !(0..=2).contains(&method) {
            self.complaints.push(
                Diagnostic::warning(
                    "bad-value",
                    format!("`{}.combination_method` is {method}, taken as 1", self.name),
                )
                .at(values.origin("combination_method"))
                .note("0 overwrites, 1 is the maximum, 2 the maximum of what is known; with `compat: humble` only 0 and 1 write anything"),
            );
        }
        self.values = values;
    }

    pub(crate) fn resized(&mut self, info: &GridInfo) {
        self.grid.resize(*info);
        self.trace.resize(self.grid.info());
    }

    /// Begins an update; false when the layer takes no part in it.
    pub(crate) fn begin(&mut self, moment: &Moment<'_>, bounds: &mut Bounds) -> bool {
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

    /// Ends the first half of an update.
    pub(crate) fn end(&mut self, moment: &Moment<'_>, bounds: &mut Bounds) {
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

    pub(crate) fn costs(&mut self, compat: Compat, master: &mut Costmap, window: Window) {
        if !self.is_enabled {
            return;
        }
        self.is_waiting = false;
        if self.clears_footprint
            && let Some(columns) = Columns::of(&self.grid, &self.outline)
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
        compat: Compat,
    ) {
        clear_cells(&mut self.grid, start, end, invert, compat);
        self.is_waiting = true;
        // So that the next update writes everything anew.
        self.extra.get_or_insert(Bounds::EMPTY).include(&Bounds::of(self.grid.info()));
    }

    pub(crate) fn is_current(&self, now_ns: i64) -> bool {
        !self.is_waiting && self.sources.iter().all(|source| source.is_current(now_ns))
    }

    pub(crate) fn explain(&self, cell: Cell) -> Explanation {
        let value = self.grid.cost(cell);
        let cause = self.trace.cause(cell);
        let (reason, parameter) = match (value, &cause) {
            (Some(LETHAL), Some(cause)) if cause.is_mark => {
                (format!("`{}` saw an obstacle here", cause.source), None)
            }
            (Some(FREE), Some(cause)) if cause.is_mark => (
                "the robot stood here, and its outline was cleared".to_owned(),
                Some(format!("{}.footprint_clearing_enabled", self.name)),
            ),
            (Some(FREE), Some(cause)) => (
                format!("a ray of `{}` went through here", cause.source),
                Some(format!("{}.{}.raytrace_max_range", self.name, cause.source)),
            ),
            (Some(UNKNOWN), _) => {
                ("nothing has been seen here, or it was cleared".to_owned(), None)
            }
            (Some(_), _) => ("nothing has been seen here, and unseen is free".to_owned(), {
                Some("track_unknown_space".to_owned())
            }),
            (None, _) => ("the layer has no such cell".to_owned(), None),
        };
        Explanation { value, reason: Some(reason), cause, parameter, within: Vec::new() }
    }
}

/// Says that a sensor is outside, once for each time that it goes there.
pub(crate) fn complain_of_sensor(
    is_outside: bool,
    layer: &str,
    source: &mut Source,
    [x, y, z]: [f64; 3],
    info: &GridInfo,
    heights: Option<(f64, f64)>,
    complaints: &mut Vec<Diagnostic>,
) {
    if is_outside && !source.was_outside {
        let Bounds { min_x, min_y, max_x, max_y } = Bounds::of(info);
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
        complaints.push(
            Diagnostic::warning("sensor-outside", text)
                .at(source.values.origin("topic"))
                .note(format!("source `{}` of layer `{layer}`", source.name))
                .help(help),
        );
    }
    source.was_outside = is_outside;
}

/// Makes a layer of something that has a [`Sight`] in its field `sight`.
macro_rules! delegate_to_sight {
    () => {
        fn name(&self) -> &str {
            &self.sight.name
        }
        fn is_clearable(&self) -> bool {
            true
        }
        fn is_enabled(&self) -> bool {
            self.sight.is_enabled
        }
        fn is_current(&self, now_ns: i64) -> bool {
            self.sight.is_current(now_ns)
        }
        fn grid(&self) -> Option<&Costmap> {
            Some(&self.sight.grid)
        }
        fn values(&self) -> Option<&ParamValues> {
            Some(&self.sight.values)
        }
        fn sources(&self) -> &[Source] {
            &self.sight.sources
        }
        fn sources_mut(&mut self) -> &mut [Source] {
            &mut self.sight.sources
        }
        fn costs(&mut self, moment: &Moment<'_>, master: &mut Costmap, window: Window) {
            self.sight.costs(moment.compat, master, window);
        }
        fn clear_area(&mut self, start: (i64, i64), end: (i64, i64), invert: bool, compat: Compat) {
            self.sight.clear_area(start, end, invert, compat);
        }
        fn complaints(&mut self) -> Vec<Diagnostic> {
            std::mem::take(&mut self.sight.complaints)
        }
    };
}
pub(crate) use delegate_to_sight;
