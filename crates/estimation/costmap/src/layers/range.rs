//! Range sensor layer: sonars and other sensors with one wide beam.
//!
//! Cells contain the probability of an obstacle, times 254. Source of the rules:
//! `nav2_costmap_2d/plugins/range_sensor_layer.cpp`.

use std::collections::VecDeque;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose};
use periplus_grid::{Cell, GridInfo};
use periplus_params::ParamValues;

use crate::clear::clear_cells;
use crate::cost::{FREE, LETHAL, UNKNOWN};
use crate::tables::RangeLayerParams;
use crate::{
    CellWindow, ChangeError, Costmap, Explanation, Layer, Nav2Release, UpdateBounds, UpdateContext,
};

/// Cost of the cell of a reading from which the reading counts as seen.
const SEEN_COST: u8 = 233;

/// Maximum number of readings queued for an update, which waits for the pose of the robot.
const MAX_READINGS: usize = 1000;

/// Length of the cone relative to the reading.
const CONE_LENGTH_RATIO: f64 = 1.2;

/// Reading of a range sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeReading {
    /// `global_from_sensor`; the beam is along x.
    pub global_from_sensor: Pose,
    /// Measured range \[m\].
    pub range_m: f64,
    /// Minimum range; shorter ones are invalid \[m\].
    pub min_range_m: f64,
    /// Maximum range; longer ones are invalid \[m\].
    pub max_range_m: f64,
    /// Field of view \[rad\].
    pub field_of_view_rad: f64,
}

/// Counts of readings by result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RangeCounters {
    /// Readings that were used.
    pub taken: u64,
    /// Readings beyond the limits of their sensor, or of the wrong type.
    pub beyond_limits: u64,
    /// Readings dropped without a transform of the sensor.
    pub without_frame: u64,
    /// Readings dropped without a transform at their stamp.
    pub out_of_time: u64,
}

/// Sensor types that are accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Variable,
    Fixed,
    All,
}

/// Returns the probability of an obstacle after one reading of `range_m`, at `distance_m` and
/// `angle_rad` from the sensor.
#[must_use]
pub fn probability(
    range_m: f64,
    distance_m: f64,
    angle_rad: f64,
    half_angle_rad: f64,
    phi_m: f64,
    resolution_m: f64,
) -> f64 {
    let aside = angle_rad / half_angle_rad;
    let gamma = if angle_rad.abs() > half_angle_rad { 0.0 } else { 1.0 - aside * aside };
    let delta = 1.0 - (1.0 + libm::tanh(2.0 * (distance_m - phi_m))) / 2.0;
    let weight = delta * gamma;
    // The reference uses the resolution, a length, as a fraction of the range.
    let width_m = resolution_m * range_m;
    if distance_m >= 0.0 && distance_m < range_m - 2.0 * width_m {
        (1.0 - weight) * 0.5
    } else if distance_m < range_m - width_m {
        let rise = (distance_m - (range_m - 2.0 * width_m)) / width_m;
        weight * 0.5 * rise * rise + (1.0 - weight) * 0.5
    } else if distance_m < range_m + width_m {
        let fall = (range_m - distance_m) / width_m;
        weight * ((1.0 - 0.5 * fall * fall) - 0.5) + 0.5
    } else {
        0.5
    }
}

fn as_cost(probability: f64) -> u8 {
    (probability * f64::from(LETHAL)) as u8
}

/// Layer of obstacle probabilities.
pub struct RangeLayer {
    name: String,
    values: ParamValues,
    params: RangeLayerParams,
    kind: Kind,
    silence_ns: i64,
    grid: Costmap,
    /// Counts of readings by result.
    pub counters: RangeCounters,
    readings: VecDeque<RangeReading>,
    /// Area changed by readings since the last update.
    touched: UpdateBounds,
    extra: Option<UpdateBounds>,
    last_ns: Option<i64>,
    is_waiting: bool,
    is_complaining: bool,
    diagnostics: Vec<Diagnostic>,
}

impl RangeLayer {
    /// Creates the layer from parameters of [`crate::tables::RANGE`].
    #[must_use]
    pub fn new(name: impl Into<String>, values: ParamValues) -> Self {
        let mut layer = Self {
            name: name.into(),
            values: values.clone(),
            params: RangeLayerParams::from_values(&values),
            kind: Kind::All,
            silence_ns: 0,
            grid: Costmap::empty(as_cost(0.5)),
            counters: RangeCounters::default(),
            readings: VecDeque::new(),
            touched: UpdateBounds::EMPTY,
            extra: None,
            last_ns: None,
            is_waiting: false,
            is_complaining: false,
            diagnostics: Vec::new(),
        };
        layer.take(values);
        layer
    }

    fn take(&mut self, values: ParamValues) {
        self.params = RangeLayerParams::from_values(&values);
        self.silence_ns = libm::round(self.params.no_readings_timeout_s * 1e9) as i64;
        let kind = &self.params.input_sensor_type;
        self.kind = match kind.to_ascii_uppercase().as_str() {
            "VARIABLE" => Kind::Variable,
            "FIXED" => Kind::Fixed,
            "ALL" => Kind::All,
            _ => {
                self.diagnostics.push(
                    Diagnostic::error(
                        "bad-value",
                        format!("`{}.input_sensor_type` is `{kind}`; ALL is used", self.name),
                    )
                    .at(values.origin("input_sensor_type"))
                    .help("write VARIABLE, FIXED or ALL"),
                );
                Kind::All
            }
        };
        self.values = values;
    }

    /// Queues a reading for the next update.
    pub fn insert(&mut self, reading: RangeReading) {
        if self.readings.len() == MAX_READINGS {
            self.readings.pop_front();
        }
        self.readings.push_back(reading);
    }

    /// Returns the grid of the layer for manual changes.
    pub fn grid_mut(&mut self) -> &mut Costmap {
        &mut self.grid
    }

    fn process(&mut self, mut reading: RangeReading) -> bool {
        let is_fixed = match self.kind {
            Kind::Variable => false,
            Kind::Fixed => true,
            Kind::All => reading.min_range_m == reading.max_range_m,
        };
        let is_clear;
        if is_fixed {
            if !reading.range_m.is_infinite() {
                self.warn_fixed_range(reading.range_m);
                return false;
            }
            is_clear = reading.range_m > 0.0;
            if is_clear && !self.params.clear_on_max_reading {
                return false;
            }
            reading.range_m = reading.min_range_m;
        } else {
            // Written such that NaN is outside.
            let is_inside =
                reading.range_m >= reading.min_range_m && reading.range_m <= reading.max_range_m;
            if !is_inside {
                return false;
            }
            is_clear = reading.range_m >= reading.max_range_m && self.params.clear_on_max_reading;
        }
        self.put(&reading, is_clear);
        true
    }

    fn warn_fixed_range(&mut self, range_m: f64) {
        if std::mem::replace(&mut self.is_complaining, true) {
            return;
        }
        self.diagnostics.push(
            Diagnostic::error(
                "bad-reading",
                format!("layer `{}`: a sensor with one range read {range_m} m", self.name),
            )
            .note("when min_range and max_range are equal, -Inf means detection, and Inf no detection")
            .help("for a sensor that measures distances, set two different limits"),
        );
    }

    /// Applies Bayes' rule to the cells of the cone.
    fn put(&mut self, reading: &RangeReading, is_clear: bool) {
        let sensor = reading.global_from_sensor;
        let half_angle_rad = reading.field_of_view_rad / 2.0;
        let origin = sensor.transform_point(DVec3::ZERO);
        let target = sensor.transform_point(DVec3::X * reading.range_m);
        let (dx, dy) = (target.x - origin.x, target.y - origin.y);
        let direction_rad = libm::atan2(dy, dx);
        let reach_m = (dx * dx + dy * dy).sqrt() * CONE_LENGTH_RATIO;
        self.touched.touch(origin.x, origin.y);
        if let Some(cell) = self.grid.finder().cell_of(target.x, target.y) {
            self.grid.set(cell, SEEN_COST);
            self.touched.touch(target.x, target.y);
        }
        let [left, right] = [-half_angle_rad, half_angle_rad].map(|turn_rad| {
            let (sine, cosine) = libm::sincos(direction_rad + turn_rad);
            (origin.x + cosine * reach_m, origin.y + sine * reach_m)
        });
        self.touched.touch(left.0, left.1);
        self.touched.touch(right.0, right.1);
        let cone = Cone {
            apex: self.grid.cell_anywhere(origin.x, origin.y),
            left: self.grid.cell_anywhere(left.0, left.1),
            right: self.grid.cell_anywhere(right.0, right.1),
        };
        let info = *self.grid.info();
        let window = cone.window(&info);
        for x in window.x0..window.xn {
            for y in window.y0..window.yn {
                if self.params.inflate_cone < 1.0 && !cone.holds((x, y), self.params.inflate_cone) {
                    continue;
                }
                let (x_m, y_m) = info.centre_of((x, y));
                let (dx, dy) = (x_m - origin.x, y_m - origin.y);
                let angle_rad =
                    periplus_geometry::normalize_angle(libm::atan2(dy, dx) - direction_rad);
                let distance_m = (dx * dx + dy * dy).sqrt();
                let seen = if is_clear {
                    0.0
                } else {
                    probability(
                        reading.range_m,
                        distance_m,
                        angle_rad,
                        half_angle_rad,
                        self.params.phi_m,
                        info.resolution_m,
                    )
                };
                let index = y * info.width + x;
                let prior = f64::from(self.grid.costs()[index]) / f64::from(LETHAL);
                let occupied = seen * prior;
                let free = (1.0 - seen) * (1.0 - prior);
                // Where both are zero the fraction is NaN, which becomes 0.
                self.grid.costs_mut()[index] = as_cost(occupied / (occupied + free));
            }
        }
    }
}

/// Triangle of a beam, in cells.
struct Cone {
    apex: (i64, i64),
    left: (i64, i64),
    right: (i64, i64),
}

impl Cone {
    /// Returns the bounding window, clipped to the grid.
    fn window(&self, info: &GridInfo) -> CellWindow {
        let corners = [self.apex, self.left, self.right];
        let range = |part: fn(&(i64, i64)) -> i64, count: usize| {
            let low = corners.iter().map(part).min().unwrap_or(0);
            let high = corners.iter().map(part).max().unwrap_or(0);
            let clamp = |cell: i64| cell.clamp(0, count as i64) as usize;
            (clamp(low), clamp(high.saturating_add(1)))
        };
        let (x0, xn) = range(|corner| corner.0, info.width);
        let (y0, yn) = range(|corner| corner.1, info.height);
        CellWindow { x0, y0, xn, yn }
    }

    /// Returns true if a cell is inside the triangle, or outside by less than a fraction `slack` of
    /// its area.
    fn holds(&self, (x, y): Cell, slack: f64) -> bool {
        let area2 = |a: (i64, i64), b: (i64, i64), c: (i64, i64)| {
            ((b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)) as f64
        };
        let at = (x as i64, y as i64);
        let Self { apex, left, right } = *self;
        let least = -slack * area2(left, right, apex).abs() / 2.0;
        area2(left, right, at) >= least
            && area2(right, apex, at) >= least
            && area2(apex, left, at) >= least
    }
}

impl Layer for RangeLayer {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        if moment.is_rolling {
            self.grid.roll_around(moment.robot, moment.compat);
        }
        let silent_since = *self.last_ns.get_or_insert(moment.now_ns);
        for reading in std::mem::take(&mut self.readings) {
            if self.process(reading) {
                self.counters.taken += 1;
                self.last_ns = Some(moment.now_ns);
            } else {
                self.counters.beyond_limits += 1;
            }
        }
        bounds.include(&std::mem::take(&mut self.touched));
        if let Some(extra) = self.extra.take() {
            bounds.include(&extra);
        }
        if self.last_ns == Some(silent_since) && !self.is_current(moment.now_ns) {
            if !std::mem::replace(&mut self.is_complaining, true) {
                let silence_s = (moment.now_ns - silent_since) as f64 / 1e9;
                self.diagnostics.push(
                    Diagnostic::warning(
                        "no-readings",
                        format!("layer `{}` received no readings for {silence_s:.2} s", self.name),
                    )
                    .at(self.values.origin("topics"))
                    .help("check `topics`, or raise `no_readings_timeout`"),
                );
            }
        } else {
            self.is_complaining = false;
        }
    }

    fn costs(&mut self, _moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
        if !self.params.layer.is_enabled {
            return;
        }
        self.is_waiting = false;
        let mark = as_cost(self.params.mark_threshold);
        let clear = as_cost(self.params.clear_threshold);
        for span in window.spans(self.grid.info().width) {
            let olds = &mut master.costs_mut()[span.clone()];
            for (old, probability) in olds.iter_mut().zip(&self.grid.costs()[span]) {
                let new = match *probability {
                    UNKNOWN => continue,
                    probability if probability > mark => LETHAL,
                    probability if probability < clear => FREE,
                    _ => continue,
                };
                *old = crate::Combination::Max.of(*old, new);
            }
        }
    }

    fn reset(&mut self) {
        self.grid.reset();
        self.readings.clear();
        self.is_waiting = true;
    }

    fn is_clearable(&self) -> bool {
        true
    }

    fn clear_area(
        &mut self,
        start: (i64, i64),
        end: (i64, i64),
        invert: bool,
        compat: Nav2Release,
    ) {
        clear_cells(&mut self.grid, start, end, invert, compat);
        // An unknown cell would stay unknown under Bayes' rule.
        let default_cost = self.grid.default_cost;
        for cost in self.grid.costs_mut() {
            if *cost == UNKNOWN {
                *cost = default_cost;
            }
        }
        self.extra = Some(UpdateBounds::of(self.grid.info()));
        self.is_waiting = true;
    }

    fn resized(&mut self, info: &GridInfo, _is_rolling: bool) {
        self.grid.resize(*info);
    }

    fn is_enabled(&self) -> bool {
        self.params.layer.is_enabled
    }

    fn is_current(&self, now_ns: i64) -> bool {
        let is_silent = self.silence_ns > 0
            && self.last_ns.is_some_and(|last_ns| now_ns - last_ns > self.silence_ns);
        !self.is_waiting && !is_silent
    }

    fn grid(&self) -> Option<&Costmap> {
        Some(&self.grid)
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        if values.get("topics") != self.values.get("topics") {
            return Err(ChangeError::Fixed("topics"));
        }
        self.take(values);
        Ok(())
    }

    fn explain(&self, _master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        let Some(value) = self.grid.cost(cell) else { return Explanation::default() };
        let probability = f64::from(value) / f64::from(LETHAL);
        let (mark, clear) = (self.params.mark_threshold, self.params.clear_threshold);
        let (value, parameter) = match value {
            value if value > as_cost(mark) => (Some(LETHAL), "mark_threshold"),
            value if value < as_cost(clear) => (Some(FREE), "clear_threshold"),
            _ => (None, "mark_threshold"),
        };
        let reason = format!(
            "an obstacle has probability {probability:.2}; above {mark} it is lethal, below {clear} free"
        );
        let parameter = Some(format!("{}.{parameter}", self.name));
        Explanation { value, reason: Some(reason), parameter, ..Explanation::default() }
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }
}
