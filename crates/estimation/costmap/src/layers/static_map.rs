//! Static layer: a map.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/static_layer.cpp`. Unlike the reference, a
//! rotation of the origin is applied.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_grid::{Cell, GridInfo, OccupancyGrid};
use periplus_params::ParamValues;

use crate::cost::{FREE, INSCRIBED, LETHAL, UNKNOWN};
use crate::costmap::half_size_m;
use crate::polygon::PolygonColumns;
use crate::tables::{CostmapParams, StaticLayerParams};
use crate::{
    CellWindow, ChangeError, Combination, Costmap, Explanation, Layer, MapError, Nav2Release,
    UpdateBounds, UpdateContext,
};

/// Tolerance between equal lengths \[m\].
const EQUAL_TOLERANCE_M: f64 = 1e-5;

/// Minimum resolution of a map \[m\].
const MIN_RESOLUTION_M: f64 = 1e-6;

/// Meaning of map values; parameters of the costmap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapMeaning {
    /// True if unknown cells stay unknown, false if they become free.
    pub tracks_unknown: bool,
    /// Value of unknown cells; 255 represents -1.
    pub unknown_value: i64,
    /// Minimum value of lethal cells, 0 to 100.
    pub lethal_threshold: i64,
    /// True if cells are only free, lethal or unknown.
    pub is_trinary: bool,
    /// Value of inscribed cells, on main.
    pub inscribed_value: Option<i64>,
    /// True if the map only raises costs.
    pub uses_maximum: bool,
}

impl MapMeaning {
    /// Converts parameters of [`crate::tables::COSTMAP`].
    #[must_use]
    pub fn read(values: &ParamValues, compat: Nav2Release) -> Self {
        let params = CostmapParams::from_values(values);
        Self {
            tracks_unknown: params.track_unknown_space,
            unknown_value: params.unknown_cost_value,
            lethal_threshold: params.lethal_cost_threshold.clamp(0, 100),
            is_trinary: params.trinary_costmap,
            inscribed_value: compat
                .knows_inscribed_maps()
                .then_some(params.inscribed_obstacle_cost_value),
            uses_maximum: params.use_maximum,
        }
    }

    /// Converts a map value to a cost.
    #[must_use]
    pub fn cost(&self, occupancy: i8) -> u8 {
        // As in the reference, values are unsigned: -1 is 255.
        let value = i64::from(occupancy as u8);
        if value == self.unknown_value {
            if self.tracks_unknown { UNKNOWN } else { FREE }
        } else if Some(value) == self.inscribed_value {
            INSCRIBED
        } else if value >= self.lethal_threshold {
            LETHAL
        } else if self.is_trinary {
            FREE
        } else {
            (value as f64 / self.lethal_threshold as f64 * f64::from(LETHAL)) as u8
        }
    }
}

/// Layer with a map.
pub struct StaticLayer {
    name: String,
    values: ParamValues,
    meaning: MapMeaning,
    compat: Nav2Release,
    is_enabled: bool,
    clears_footprint: bool,
    restores_footprint: bool,
    /// Map as received.
    map: Option<OccupancyGrid>,
    map_frame: String,
    grid: Costmap,
    /// True if the map is not in `grid` yet.
    is_new: bool,
    has_changed: bool,
    /// True if the layer contributes to this update, which `bounds` decides.
    takes_part: bool,
    is_waiting: bool,
    was_lost: bool,
    /// Transform of the last update of a rolling costmap.
    map_from_global: Option<Pose>,
    outline: Vec<[f64; 2]>,
    diagnostics: Vec<Diagnostic>,
}

impl StaticLayer {
    /// Creates the layer from parameters of [`crate::tables::STATIC`].
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        values: ParamValues,
        meaning: MapMeaning,
        compat: Nav2Release,
    ) -> Self {
        let mut layer = Self {
            name: name.into(),
            values: values.clone(),
            meaning,
            compat,
            is_enabled: true,
            clears_footprint: false,
            restores_footprint: true,
            map: None,
            map_frame: String::new(),
            grid: Costmap::empty(FREE),
            is_new: false,
            has_changed: false,
            takes_part: false,
            is_waiting: false,
            was_lost: false,
            map_from_global: None,
            outline: Vec::new(),
            diagnostics: Vec::new(),
        };
        layer.take(values);
        layer
    }

    fn take(&mut self, values: ParamValues) {
        let params = StaticLayerParams::from_values(&values);
        self.is_enabled = params.layer.is_enabled;
        self.restores_footprint =
            self.compat.restores_cleared_footprint() && params.restore_cleared_footprint;
        self.clears_footprint = params.footprint_clearing_enabled;
        self.values = values;
        self.has_changed = true;
    }

    /// Sets the map, which is used from the next update on.
    /// # Errors
    /// The reason, for a malformed map; the layer keeps the previous one.
    pub fn set_map(&mut self, map: OccupancyGrid, frame: &str) -> Result<(), MapError> {
        let GridInfo { resolution_m, width, height, origin } = map.info;
        if frame.is_empty() {
            return Err(MapError::NoFrame);
        }
        if !(resolution_m.is_finite() && resolution_m >= MIN_RESOLUTION_M) {
            return Err(MapError::Resolution(resolution_m));
        }
        if !origin.is_finite() {
            return Err(MapError::Origin);
        }
        if map.cells.len() != width * height {
            let count = map.cells.len();
            return Err(MapError::CellCount { count, width, height });
        }
        if width == 0 || height == 0 {
            return Err(MapError::NoCells);
        }
        frame.clone_into(&mut self.map_frame);
        self.map = Some(upright(map));
        self.is_new = true;
        self.is_waiting = false;
        Ok(())
    }

    /// Updates a part of the map: `cells` in row-major order in a window of the map.
    /// # Errors
    /// The reason, if the update does not match the map.
    pub fn update_map(
        &mut self,
        window: CellWindow,
        cells: &[i8],
        frame: &str,
    ) -> Result<(), MapError> {
        let Some(map) = &mut self.map else { return Err(MapError::NoMap) };
        let info = map.info;
        if window.xn > info.width || window.yn > info.height {
            return Err(MapError::BeyondMap {
                end: (window.xn, window.yn),
                size: (info.width, info.height),
            });
        }
        if frame != self.map_frame {
            return Err(MapError::OtherFrame {
                update: frame.to_owned(),
                map: self.map_frame.clone(),
            });
        }
        if cells.len() != window.width() * window.height() {
            return Err(MapError::UpdateCellCount {
                count: cells.len(),
                width: window.width(),
                height: window.height(),
            });
        }
        if window.is_empty() {
            return Ok(());
        }
        let is_current = self.grid.info().len() == info.len() && !self.is_new;
        for (row, span) in cells.chunks(window.width()).zip(window.spans(info.width)) {
            map.cells[span.clone()].copy_from_slice(row);
            if is_current {
                for (cost, value) in self.grid.costs_mut()[span].iter_mut().zip(row) {
                    *cost = self.meaning.cost(*value);
                }
            }
        }
        self.has_changed = true;
        Ok(())
    }

    /// Returns true if a map was received.
    #[must_use]
    pub fn has_map(&self) -> bool {
        self.map.is_some()
    }

    fn write_grid(&mut self) {
        if let Some(map) = &self.map {
            self.grid = Costmap::new(map.info, FREE);
            for (cost, value) in self.grid.costs_mut().iter_mut().zip(&map.cells) {
                *cost = self.meaning.cost(*value);
            }
        }
        self.is_new = false;
        self.has_changed = true;
    }

    /// Looks up each cell of a window in a map that is in another frame.
    fn look_up(&self, master: &mut Costmap, window: &CellWindow, map_from_global: Pose) {
        let finder = self.grid.finder();
        let info = *master.info();
        for y in window.y0..window.yn {
            for x in window.x0..window.xn {
                let (wx, wy) = info.centre_of((x, y));
                let at = map_from_global.transform_point(DVec3::new(wx, wy, 0.0));
                let Some(cell) = finder.cell_of(at.x, at.y) else { continue };
                let Some(cost) = self.grid.cost(cell) else { continue };
                let index = y * info.width + x;
                let old = master.costs()[index];
                let new = if self.meaning.uses_maximum {
                    // The reference compares numbers here: unknown is the highest.
                    cost.max(old)
                } else {
                    cost
                };
                master.costs_mut()[index] = new;
            }
        }
    }
}

/// Resamples a rotated map on the axes of its frame, with the nearest cell.
fn upright(map: OccupancyGrid) -> OccupancyGrid {
    let GridInfo { resolution_m, width, height, origin } = map.info;
    if origin.yaw_rad == 0.0 {
        return map;
    }
    let (columns, rows) = (width as f64, height as f64);
    let corners = [(0.0, 0.0), (columns, 0.0), (0.0, rows), (columns, rows)]
        .map(|(column, row)| map.info.point_at(column, row));
    let mut bounds = UpdateBounds::EMPTY;
    for (x_m, y_m) in corners {
        bounds.touch(x_m, y_m);
    }
    // A half turn leaves a rounding error, which is not a cell.
    let count = |length_m: f64| libm::ceil(length_m / resolution_m - 1e-6).max(1.0) as usize;
    let origin = Pose2::new(bounds.min_x, bounds.min_y, 0.0);
    let (columns, rows) = (count(bounds.max_x - bounds.min_x), count(bounds.max_y - bounds.min_y));
    let Ok(info) = GridInfo::new(resolution_m, columns, rows, origin) else { return map };
    let finder = map.info.finder();
    let cells = (0..info.len())
        .map(|index| {
            let (x_m, y_m) = info.centre_of(info.cell(index));
            let cell = finder.cell_of(x_m, y_m);
            cell.map_or(periplus_grid::occupancy::UNKNOWN, |cell| map[cell])
        })
        .collect();
    OccupancyGrid { info, cells }
}

fn is_same(a: &GridInfo, b: &GridInfo) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < EQUAL_TOLERANCE_M;
    (a.width, a.height) == (b.width, b.height)
        && near(a.resolution_m, b.resolution_m)
        && near(a.origin.x_m, b.origin.x_m)
        && near(a.origin.y_m, b.origin.y_m)
}

impl Layer for StaticLayer {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        self.takes_part = self.map.is_some();
        if self.map.is_none() {
            return;
        }
        let is_fitting = moment.is_rolling || is_same(self.grid.info(), &moment.info);
        if self.is_new || !is_fitting {
            self.write_grid();
        }
        if !moment.is_rolling && !std::mem::take(&mut self.has_changed) {
            return;
        }
        if moment.is_rolling && moment.compat.follows_robot_with_map() {
            let (half_width_m, half_height_m) = half_size_m(&moment.info, moment.compat);
            bounds.touch(moment.robot.x_m - half_width_m, moment.robot.y_m - half_height_m);
            bounds.touch(moment.robot.x_m + half_width_m, moment.robot.y_m + half_height_m);
        } else {
            // As in the reference: from the centre of the first cell to that of one past the last.
            let info = self.grid.info();
            let (x_m, y_m) = info.centre_of((0, 0));
            bounds.touch(x_m, y_m);
            let (x_m, y_m) = info.centre_of((info.width, info.height));
            bounds.touch(x_m, y_m);
        }
        if self.clears_footprint {
            self.outline = moment.footprint.placed(moment.robot);
            for [x_m, y_m] in &self.outline {
                bounds.touch(*x_m, *y_m);
            }
        }
    }

    fn costs(&mut self, moment: &UpdateContext<'_>, master: &mut Costmap, window: CellWindow) {
        if !self.is_enabled || !self.takes_part {
            return;
        }
        self.is_waiting = false;
        let mut under_robot = Vec::new();
        if self.clears_footprint
            && let Some(columns) = PolygonColumns::of(&self.grid, &self.outline)
        {
            for cell in columns.cells() {
                under_robot.push((cell, self.grid.cost(cell).unwrap_or(FREE)));
                self.grid.set(cell, FREE);
            }
        }
        if moment.is_rolling {
            let map_from_global = moment.frames.latest(&self.map_frame, moment.global_frame);
            match map_from_global {
                Some(map_from_global) => self.look_up(master, &window, map_from_global),
                None if !self.was_lost => self.diagnostics.push(
                    Diagnostic::warning(
                        "no-transform",
                        format!(
                            "layer `{}` has no transform from `{}` to `{}`, the frame of its map",
                            self.name, moment.global_frame, self.map_frame
                        ),
                    )
                    .help("start the node that localizes the robot, or set its initial pose"),
                ),
                None => {}
            }
            self.was_lost = map_from_global.is_none();
            self.map_from_global = map_from_global.or(self.map_from_global);
        } else if is_same(self.grid.info(), master.info()) {
            let how = if self.meaning.uses_maximum { Combination::Max } else { Combination::Copy };
            how.apply(master, &self.grid, &window);
        }
        if self.restores_footprint {
            for (cell, cost) in under_robot {
                self.grid.set(cell, cost);
            }
        }
    }

    fn reset(&mut self) {
        self.has_changed = true;
        self.is_waiting = true;
    }

    fn requested_grid_info(&self, current: &GridInfo, is_size_locked: bool) -> Option<GridInfo> {
        let map = self.map.as_ref().filter(|_| self.is_new)?;
        (!is_size_locked || !is_same(current, &map.info)).then_some(map.info)
    }

    fn resized(&mut self, info: &GridInfo, is_rolling: bool) {
        // The window of a rolling costmap does not affect the map. Otherwise the map is rewritten.
        if !is_rolling && !is_same(self.grid.info(), info) {
            self.grid.resize(*info);
            self.is_new = self.map.is_some();
        }
        self.has_changed = true;
    }

    fn is_enabled(&self) -> bool {
        self.is_enabled
    }

    fn is_current(&self, _now_ns: i64) -> bool {
        self.map.is_some() && !self.is_waiting
    }

    fn grid(&self) -> Option<&Costmap> {
        Some(&self.grid)
    }

    fn values(&self) -> Option<&ParamValues> {
        Some(&self.values)
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        for fixed in ["map_topic", "subscribe_to_updates", "map_subscribe_transient_local"] {
            if values.get(fixed) != self.values.get(fixed) {
                return Err(ChangeError::Fixed(fixed));
            }
        }
        let restores = values.get("restore_cleared_footprint");
        if self.compat.guards_restore_parameter()
            && !self.clears_footprint
            && restores != self.values.get("restore_cleared_footprint")
        {
            return Err(ChangeError::RestoreWithoutClearing);
        }
        self.take(values);
        Ok(())
    }

    fn explain(&self, master: &Costmap, cell: Cell, is_rolling: bool) -> Explanation {
        let Some(map) = &self.map else {
            return Explanation {
                reason: Some("no map was received".to_owned()),
                parameter: Some(format!("{}.map_topic", self.name)),
                ..Explanation::default()
            };
        };
        debug_assert!(is_rolling || is_same(master.info(), self.grid.info()) || self.is_new);
        let cell = if is_rolling {
            // The map is in another frame, from which updates look the cell up.
            let (x_m, y_m) = master.info().centre_of(cell);
            let at = self
                .map_from_global
                .map(|map_from_global| map_from_global.transform_point(DVec3::new(x_m, y_m, 0.0)));
            let Some(cell) = at.and_then(|at| self.grid.finder().cell_of(at.x, at.y)) else {
                let reason = "the map, which is in another frame, does not have the cell";
                return Explanation { reason: Some(reason.to_owned()), ..Explanation::default() };
            };
            cell
        } else {
            cell
        };
        let value = self.grid.cost(cell);
        let reason =
            map.get(cell).map(|occupancy| format!("the map has the value {occupancy} here"));
        let parameter = match value {
            Some(FREE) if map.get(cell) == Some(&-1) => Some("track_unknown_space".to_owned()),
            Some(_) => Some("lethal_cost_threshold".to_owned()),
            None => None,
        };
        Explanation { value, reason, parameter, ..Explanation::default() }
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }
}
