//! Speed filter: zones with speed limits.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/costmap_filters/speed_filter.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;
use periplus_params::ParamValues;

use super::mask::filter_info_error;
use super::{FilterInfo, FilterKind, FilterMask, MaskFilter};
use crate::footprint::distance_to_side_m;
use crate::tables::SpeedFilterParams;
use crate::{CellWindow, ChangeError, Costmap, Layer, UpdateBounds, UpdateContext};

/// Speed limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpeedLimit {
    /// True if `limit` is in percent of the maximum speed, false for m/s.
    pub is_percentage: bool,
    /// Limit; 0 for none.
    pub limit: f64,
}

/// Filter that publishes the speed limit at the robot.
pub struct SpeedFilter {
    name: String,
    values: ParamValues,
    params: SpeedFilterParams,
    info: Option<FilterInfo>,
    mask: Option<FilterMask>,
    /// Path of the robot in the global frame \[m\], and the index of the nearest segment.
    path: Vec<[f64; 2]>,
    reached: usize,
    speed_m_s: f64,
    /// While the limit ahead differs from the current one, the lookahead distance does not shrink.
    held_m: f64,
    last: f64,
    outgoing: Option<SpeedLimit>,
    /// Reason of the last warning, which is not repeated.
    last_warning: Option<&'static str>,
    diagnostics: Vec<Diagnostic>,
}

impl SpeedFilter {
    /// Creates the filter from parameters of [`crate::tables::SPEED`].
    #[must_use]
    pub fn new(name: impl Into<String>, values: ParamValues) -> Self {
        Self {
            name: name.into(),
            params: SpeedFilterParams::from_values(&values),
            values,
            info: None,
            mask: None,
            path: Vec::new(),
            reached: 0,
            speed_m_s: 0.0,
            held_m: 0.0,
            last: 0.0,
            outgoing: None,
            last_warning: None,
            diagnostics: Vec::new(),
        }
    }

    /// Sets the path of the robot, in the global frame \[m\].
    pub fn set_path(&mut self, path: Vec<[f64; 2]>) {
        self.path = path;
        self.reached = 0;
    }

    /// Sets the speed of the robot \[m/s\].
    pub fn set_speed(&mut self, speed_m_s: f64) {
        self.speed_m_s = speed_m_s.abs();
    }

    /// Takes the limit to publish, if it has changed.
    pub fn take_limit(&mut self) -> Option<SpeedLimit> {
        self.outgoing.take()
    }

    /// Returns the limit at a pose, or the reason for which the mask has none.
    fn limit_at(&self, moment: &UpdateContext<'_>, at: Pose2) -> Result<f64, &'static str> {
        let (Some(mask), Some(info)) = (&self.mask, &self.info) else {
            return Err("no mask was received");
        };
        let mask_from_global = mask.placed(moment).ok_or("there is no transform to the mask")?;
        let cell = mask.cell_of(mask_from_global, at).ok_or("the robot is outside the mask")?;
        let number = mask.grid[cell];
        match number {
            0 => return Ok(0.0),
            -1 => return Err("the mask is unknown here"),
            _ => {}
        }
        let limit = info.value(number);
        let is_possible = match info.kind {
            FilterKind::SpeedPercent => (0.0..=100.0).contains(&limit),
            _ => limit >= 0.0,
        };
        Ok(if is_possible { limit } else { 0.0 })
    }

    /// Returns the lowest limit from the robot along the path, or the reason for which the mask has
    /// none at the robot.
    fn limit_ahead(&mut self, moment: &UpdateContext<'_>) -> Result<f64, &'static str> {
        let shortest_m = self.params.min_lookahead_m.max(0.0);
        let longest_m = self.params.max_lookahead_m.max(shortest_m);
        let slowing_m_s2 = self.params.max_decel_m_s2;
        let mut reach_m = longest_m;
        if slowing_m_s2 < 0.0 {
            let braking_m = self.speed_m_s * self.speed_m_s / (2.0 * -slowing_m_s2);
            reach_m = braking_m.clamp(shortest_m, longest_m).max(self.held_m);
        }
        self.held_m = 0.0;
        self.reached = self.nearest(moment.robot);
        let here = self.limit_at(moment, moment.robot)?;
        let mut lowest = if here == 0.0 { f64::INFINITY } else { here };
        let mut along_m = 0.0;
        for index in self.reached..self.path.len() {
            let [x_m, y_m] = self.path[index];
            if index > self.reached {
                let [last_x_m, last_y_m] = self.path[index - 1];
                along_m += libm::hypot(x_m - last_x_m, y_m - last_y_m);
            }
            if along_m > reach_m {
                break;
            }
            match self.limit_at(moment, Pose2::new(x_m, y_m, 0.0)) {
                Ok(limit) if limit != 0.0 => lowest = lowest.min(limit),
                _ => {}
            }
        }
        let lowest = if lowest.is_finite() { lowest } else { 0.0 };
        if lowest != here {
            self.held_m = reach_m;
        }
        Ok(lowest)
    }

    /// Returns the start of the nearest path segment, searched from the last one.
    fn nearest(&self, robot: Pose2) -> usize {
        let from = if self.reached < self.path.len() { self.reached } else { 0 };
        let mut found = (f64::INFINITY, from);
        for index in from..self.path.len().saturating_sub(1) {
            let distance_m =
                distance_to_side_m([robot.x_m, robot.y_m], self.path[index], self.path[index + 1]);
            if distance_m < found.0 {
                found = (distance_m, index);
            }
        }
        found.1
    }

    fn warn(&mut self, why: &'static str) {
        if self.last_warning.replace(why) == Some(why) {
            return;
        }
        self.diagnostics.push(
            Diagnostic::warning("no-limit", format!("filter `{}`: {why}", self.name))
                .at(self.values.origin("filter_info_topic"))
                .note("the last limit still applies"),
        );
    }
}

impl MaskFilter for SpeedFilter {
    fn set_info(&mut self, info: FilterInfo) {
        if matches!(info.kind, FilterKind::SpeedPercent | FilterKind::SpeedAbsolute) {
            self.info = Some(info);
        } else {
            let what = format!("the mask is for {:?}", info.kind);
            let error = filter_info_error(&self.name, &self.values, &what);
            self.diagnostics.push(error.help("publish type 1 (percent) or 2 (metres per second)"));
        }
    }

    fn set_mask(&mut self, mask: FilterMask) {
        self.mask = Some(mask);
    }
}

impl Layer for SpeedFilter {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, _moment: &UpdateContext<'_>, _bounds: &mut UpdateBounds) {}

    fn costs(&mut self, moment: &UpdateContext<'_>, _master: &mut Costmap, _window: CellWindow) {
        if !self.params.filter.is_enabled || self.mask.is_none() || self.info.is_none() {
            return;
        }
        let looks_ahead = moment.compat.looks_ahead_on_paths() && self.params.enable_path_lookahead;
        let limit = if looks_ahead && !self.path.is_empty() {
            self.limit_ahead(moment)
        } else {
            self.limit_at(moment, moment.robot)
        };
        let limit = match limit {
            Ok(limit) => limit,
            Err(why) => return self.warn(why),
        };
        self.last_warning = None;
        if limit != self.last {
            self.last = limit;
            let is_percentage = self.info.is_some_and(|info| info.kind == FilterKind::SpeedPercent);
            self.outgoing = Some(SpeedLimit { is_percentage, limit });
        }
    }

    fn is_enabled(&self) -> bool {
        self.params.filter.is_enabled
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        self.params = SpeedFilterParams::from_values(&values);
        self.values = values;
        Ok(())
    }

    fn masked(&mut self) -> Option<&mut dyn MaskFilter> {
        Some(self)
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }
}
