//! Voxel layer: obstacles seen by sensors, in columns of voxels.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/voxel_layer.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_grid::{Cell, CellFinder, GridInfo};
use periplus_params::ParamValues;

use super::observed::{ObservationLayer, delegate_to_observation_layer, warn_sensor_outside};
use super::obstacle::touch_ray;
use super::ray_dedup::RayDeduplicator;
use crate::cost::{FREE, LETHAL, UNKNOWN};
use crate::observation::{Counters, RangeLimits};
use crate::tables::VoxelLayerParams;
use crate::trace::TraceWriter;
use crate::voxel_grid::{MAX_VOXEL_COUNT, Voxel, VoxelGrid, marked, unknown};
use crate::{
    CellWindow, ChangeError, Costmap, Explanation, Layer, Nav2Release, Observation,
    ObservationSource, UpdateBounds, UpdateContext,
};

/// Fraction of a ray by which it is shortened at the edge of the grid.
const EDGE_MARGIN_RATIO: f64 = 1e-5;

/// Distance below the top at which rays are cut \[m\].
const BELOW_TOP_M: f64 = 0.01;

/// Heights of voxels and thresholds of columns.
#[derive(Clone, Copy, Debug)]
struct VoxelColumns {
    origin_z_m: f64,
    z_resolution_m: f64,
    height: u32,
    unknown_threshold: u32,
    mark_threshold: u32,
}

impl VoxelColumns {
    fn new(params: &VoxelLayerParams) -> Self {
        let count = |count: usize| u32::try_from(count).unwrap_or_default();
        let height = count(params.z_voxels).min(MAX_VOXEL_COUNT);
        Self {
            origin_z_m: params.origin_z_m,
            z_resolution_m: params.z_resolution_m,
            height,
            // Voxels above the grid are always unknown and must not count.
            unknown_threshold: count(params.unknown_threshold)
                .saturating_add(MAX_VOXEL_COUNT - height),
            mark_threshold: count(params.mark_threshold),
        }
    }

    fn top_m(&self) -> f64 {
        self.origin_z_m + f64::from(self.height) * self.z_resolution_m
    }

    /// Converts a point to cells from the lowest corner; none outside the grid.
    fn place(&self, info: &GridInfo, finder: &CellFinder, [x, y, z]: [f64; 3]) -> Option<[f64; 3]> {
        let (columns, rows) = finder.cells_to(x, y);
        let layers = (z - self.origin_z_m) / self.z_resolution_m;
        let is_inside = columns >= 0.0
            && rows >= 0.0
            && layers >= 0.0
            && columns < info.width as f64
            && rows < info.height as f64
            && layers < f64::from(self.height);
        is_inside.then_some([columns, rows, layers])
    }
}

/// Layer that marks and clears voxels; a cell is an obstacle with enough marked voxels in its
/// column.
pub struct VoxelLayer {
    observed: ObservationLayer,
    params: VoxelLayerParams,
    columns: VoxelColumns,
    voxels: VoxelGrid,
    ray_dedup: RayDeduplicator,
    /// Ends of the rays in the last update in the global frame \[m\], if requested.
    clearing_ends: Option<Vec<[f32; 3]>>,
}

impl VoxelLayer {
    /// Creates the layer from parameters of [`crate::tables::VOXEL`]; `tracks_unknown` is
    /// `track_unknown_space` of the costmap.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        values: ParamValues,
        tracks_unknown: bool,
        sources: Vec<ObservationSource>,
    ) -> Self {
        let params = VoxelLayerParams::from_values(&values);
        let columns = VoxelColumns::new(&params);
        let observed = ObservationLayer::new(name.into(), values, tracks_unknown, sources);
        let voxels = VoxelGrid::new(*observed.grid.info(), columns.height);
        let mut layer = Self {
            observed,
            params,
            columns,
            voxels,
            ray_dedup: RayDeduplicator::default(),
            clearing_ends: None,
        };
        layer.warn_voxel_count();
        layer
    }

    fn warn_voxel_count(&mut self) {
        let asked = self.params.z_voxels;
        if asked > MAX_VOXEL_COUNT as usize {
            self.observed.diagnostics.push(
                Diagnostic::warning(
                    "too-many-voxels",
                    format!(
                        "`{}.z_voxels` is {asked}; {MAX_VOXEL_COUNT} are used",
                        self.observed.name
                    ),
                )
                .at(self.observed.values.origin("z_voxels"))
                .help("to reach as high, raise `z_resolution`"),
            );
        }
    }

    /// Adds a source.
    pub fn add_source(&mut self, source: ObservationSource) {
        self.observed.sources.push(source);
    }

    /// Returns the grid of the layer for manual changes; the voxels stay.
    pub fn grid_mut(&mut self) -> &mut Costmap {
        &mut self.observed.grid
    }

    /// Returns the voxels.
    #[must_use]
    pub fn voxels(&self) -> &VoxelGrid {
        &self.voxels
    }

    /// Returns the height of the lowest voxels \[m\].
    #[must_use]
    pub fn origin_z_m(&self) -> f64 {
        self.columns.origin_z_m
    }

    /// Returns the height of a voxel \[m\].
    #[must_use]
    pub fn z_resolution_m(&self) -> f64 {
        self.columns.z_resolution_m
    }

    /// Returns true if voxels are published.
    #[must_use]
    pub fn publishes_voxels(&self) -> bool {
        self.params.publish_voxel_map
    }

    /// Enables recording of ray ends.
    pub fn record_clearing_ends(&mut self, is_wanted: bool) {
        if !is_wanted {
            self.clearing_ends = None;
        } else if self.clearing_ends.is_none() {
            self.clearing_ends = Some(Vec::new());
        }
    }

    /// Returns the ends of the rays in the last update in the global frame \[m\]; empty unless
    /// enabled.
    #[must_use]
    pub fn clearing_ends(&self) -> &[[f32; 3]] {
        self.clearing_ends.as_deref().unwrap_or_default()
    }

    fn clear(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        let observed = &mut self.observed;
        for source in observed.sources.iter_mut().filter(|source| source.settings.is_clearing) {
            for index in 0..source.observations.len() {
                let seen = &source.observations[index];
                let origin = seen.origin;
                let mut clearing = Clearing {
                    columns: self.columns,
                    compat: moment.compat,
                    grid: &mut observed.grid,
                    voxels: &mut self.voxels,
                    writer: observed.trace.writer(&source.name, seen, false),
                    ends: self.clearing_ends.as_mut(),
                };
                let is_inside = clearing.clear(seen, &mut self.ray_dedup, bounds);
                if !is_inside && index < source.fresh {
                    source.counters.sensor_outside += 1;
                }
                // A cloud without points has no rays to lose.
                let is_lost = !is_inside && !source.observations[index].points.is_empty();
                let heights = Some((self.columns.origin_z_m, self.columns.top_m()));
                let (name, info) = (&observed.name, observed.grid.info());
                let diagnostics = &mut observed.diagnostics;
                warn_sensor_outside(is_lost, name, source, origin, info, heights, diagnostics);
            }
        }
    }

    fn mark(&mut self, compat: Nav2Release, bounds: &mut UpdateBounds) {
        let observed = &mut self.observed;
        for source in observed.sources.iter_mut().filter(|source| source.settings.is_marking) {
            for (index, seen) in source.observations.iter().enumerate() {
                let mut unseen = Counters::default();
                let is_first = index < source.fresh;
                let counters = if is_first { &mut source.counters } else { &mut unseen };
                let writer = observed.trace.writer(&source.name, seen, true);
                let mut heights = observed.heights;
                if !compat.has_lowest_voxel_height() {
                    heights.min_m = f64::NEG_INFINITY;
                }
                let marker = Marker { columns: self.columns, heights };
                marker.mark(&mut observed.grid, &mut self.voxels, writer, seen, counters, bounds);
            }
        }
    }
}

impl Layer for VoxelLayer {
    delegate_to_observation_layer!();

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        let takes_part = self.observed.begin(moment, bounds);
        if moment.is_rolling {
            self.voxels.follow(self.observed.grid.info());
        }
        if !takes_part {
            return;
        }
        if let Some(ends) = &mut self.clearing_ends {
            ends.clear();
        }
        self.clear(moment, bounds);
        self.mark(moment.compat, bounds);
        self.observed.end(moment, bounds);
    }

    fn reset(&mut self) {
        self.observed.reset();
        self.voxels.reset();
    }

    fn resized(&mut self, info: &GridInfo, _is_rolling: bool) {
        self.observed.resized(info);
        self.voxels = VoxelGrid::new(*self.observed.grid.info(), self.columns.height);
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        let params = VoxelLayerParams::from_values(&values);
        if params.publish_voxel_map != self.params.publish_voxel_map {
            return Err(ChangeError::Fixed("publish_voxel_map"));
        }
        let columns = VoxelColumns::new(&params);
        let is_same = (columns.height, columns.origin_z_m, columns.z_resolution_m)
            == (self.columns.height, self.columns.origin_z_m, self.columns.z_resolution_m);
        (self.columns, self.params) = (columns, params);
        self.observed.configure(values);
        self.warn_voxel_count();
        if !is_same {
            let info = *self.observed.grid.info();
            self.resized(&info, false);
        }
        Ok(())
    }

    fn explain(&self, _master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        let mut explanation = self.observed.explain(cell);
        let Some(column) = self.voxels.columns().get(self.voxels.info().index(cell)) else {
            return explanation;
        };
        let marked: Vec<String> = (0..self.columns.height)
            .filter(|z| self.voxels.voxel(cell, *z) == Voxel::Marked)
            .map(|z| {
                let low_m = self.columns.origin_z_m + f64::from(z) * self.columns.z_resolution_m;
                format!("{low_m:.2}..{:.2} m", low_m + self.columns.z_resolution_m)
            })
            .collect();
        let missing = MAX_VOXEL_COUNT - self.columns.height;
        let column = format!(
            "{} of {} voxels are marked{}{}, {} unknown",
            marked.len(),
            self.columns.height,
            if marked.is_empty() { "" } else { ": " },
            marked.join(", "),
            unknown(*column).saturating_sub(missing),
        );
        let reason = explanation.reason.take().unwrap_or_default();
        explanation.reason = Some(format!("{reason} ({column})"));
        explanation
    }
}

/// State for clearing along rays.
struct Clearing<'a> {
    columns: VoxelColumns,
    compat: Nav2Release,
    grid: &'a mut Costmap,
    voxels: &'a mut VoxelGrid,
    writer: Option<TraceWriter<'a>>,
    ends: Option<&'a mut Vec<[f32; 3]>>,
}

impl Clearing<'_> {
    /// Clears along all rays; returns false when the sensor is outside the grid.
    fn clear(
        &mut self,
        seen: &Observation,
        ray_dedup: &mut RayDeduplicator,
        bounds: &mut UpdateBounds,
    ) -> bool {
        let VoxelColumns { unknown_threshold, mark_threshold, .. } = self.columns;
        let finder = self.grid.finder();
        let info = *self.grid.info();
        let Some(start) = self.columns.place(&info, &finder, seen.origin) else { return false };
        let rays = RayClipper::new(self.columns, &info, self.compat, seen.origin);
        let longest = self.grid.cells_along(seen.rays.max_m);
        let shortest = self.grid.cells_along(seen.rays.min_m);
        let whole_m = f64::from(longest);
        ray_dedup.forget();
        for point in &seen.points {
            let end_m = rays.end(*point);
            let Some(end) = self.columns.place(&info, &finder, end_m) else { continue };
            let [ox, oy, _] = seen.origin;
            touch_ray(bounds, [ox, oy], [end_m[0], end_m[1]], &seen.rays);
            if let Some(ends) = &mut self.ends {
                ends.push(end_m.map(|at| at as f32));
            }
            // An uncut ray crosses the same voxels as others with the same end. The end of a cut
            // ray depends on its exact length.
            if shortest == 0 && is_within(start, end, whole_m) {
                let [x, y, z] = end.map(|at| at as u64);
                if ray_dedup.has((y * info.width as u64 + x) << 4 | z) {
                    continue;
                }
            }
            let costs = self.grid.costs_mut();
            let writer = &mut self.writer;
            self.voxels.clear_along(start, end, shortest, longest, |index, column| {
                if marked(column) <= mark_threshold {
                    let is_free = unknown_threshold >= MAX_VOXEL_COUNT
                        || unknown(column) <= unknown_threshold;
                    costs[index] = if is_free { FREE } else { UNKNOWN };
                    if let Some(writer) = writer {
                        writer.note(index, [point[0], point[1]]);
                    }
                }
            });
        }
        true
    }
}

/// Returns true if two positions are at most `distance` apart.
fn is_within(start: [f64; 3], end: [f64; 3], distance: f64) -> bool {
    let [dx, dy, dz] = [end[0] - start[0], end[1] - start[1], end[2] - start[2]];
    dx * dx + dy * dy + dz * dz <= distance * distance
}

/// Clipping of rays to the box of the grid.
struct RayClipper {
    origin: [f64; 3],
    low: [f64; 3],
    high: [f64; 3],
    shorter_m: f64,
    /// Fraction by which a cut ray is shortened.
    margin: f64,
}

impl RayClipper {
    fn new(columns: VoxelColumns, info: &GridInfo, compat: Nav2Release, origin: [f64; 3]) -> Self {
        let length = |cells: usize| (cells as f64 - compat.missing_cells()) * info.resolution_m;
        let low = [info.origin.x_m, info.origin.y_m, columns.origin_z_m];
        let high = [low[0] + length(info.width), low[1] + length(info.height), columns.top_m()];
        let margin = if compat.shortens_cut_rays() { EDGE_MARGIN_RATIO } else { 0.0 };
        Self { origin, low, high, shorter_m: 2.0 * info.resolution_m, margin }
    }

    /// Returns the end of the ray to a point: two cells before the point, which spares the obstacle
    /// itself, or the exit from the box.
    #[inline]
    fn end(&self, point: [f32; 3]) -> [f64; 3] {
        let [ox, oy, oz] = self.origin;
        let [dx, dy, dz] =
            [f64::from(point[0]) - ox, f64::from(point[1]) - oy, f64::from(point[2]) - oz];
        let distance = (dx * dx + dy * dy + dz * dz).sqrt();
        let part = ((distance - self.shorter_m) / distance).clamp(0.0, 1.0);
        let along = [dx, dy, dz].map(|length| part * length);
        let end = [along[0] + ox, along[1] + oy, along[2] + oz];
        // Fraction of the ray inside the box.
        let mut t: f64 = 1.0;
        let mut is_cut = false;
        if end[2] > self.high[2] {
            t = ((self.high[2] - BELOW_TOP_M - oz) / along[2]).min(t).max(0.0);
            is_cut = true;
        } else if end[2] < self.low[2] {
            t = t.min((self.low[2] - oz) / along[2]);
            is_cut = true;
        }
        for axis in [0, 1] {
            if end[axis] < self.low[axis] {
                t = t.min((self.low[axis] - self.origin[axis]) / along[axis]);
                is_cut = true;
            }
            if end[axis] > self.high[axis] {
                t = t.min((self.high[axis] - self.origin[axis]) / along[axis]);
                is_cut = true;
            }
        }
        if !is_cut {
            return end;
        }
        if t > 0.0 {
            t -= self.margin;
        } else if t < 0.0 {
            t += self.margin;
        }
        [ox + along[0] * t, oy + along[1] * t, oz + along[2] * t]
    }
}

/// Marker of points.
struct Marker {
    columns: VoxelColumns,
    heights: RangeLimits,
}

impl Marker {
    fn mark(
        &self,
        grid: &mut Costmap,
        voxels: &mut VoxelGrid,
        mut writer: Option<TraceWriter<'_>>,
        seen: &Observation,
        counters: &mut Counters,
        bounds: &mut UpdateBounds,
    ) {
        let VoxelColumns { origin_z_m, z_resolution_m, height, mark_threshold, .. } = self.columns;
        let finder = grid.finder();
        let width = grid.info().width;
        let [ox, oy, oz] = seen.origin;
        let RangeLimits { min_m, max_m } = seen.marks;
        for point in &seen.points {
            let [px, py, pz] = point.map(f64::from);
            if !counters.is_in_layer(pz, &self.heights) {
                continue;
            }
            let (dx, dy, dz) = (px - ox, py - oy, pz - oz);
            let squared = dx * dx + dy * dy + dz * dz;
            if squared >= max_m * max_m {
                counters.too_far += 1;
                continue;
            }
            if squared < min_m * min_m {
                counters.too_near += 1;
                continue;
            }
            let Some(cell) = finder.cell_of(px, py) else {
                counters.outside += 1;
                continue;
            };
            // Points below the box mark its lowest voxel.
            let layer = (pz.max(origin_z_m) - origin_z_m) / z_resolution_m;
            if layer >= f64::from(height) {
                counters.layer_too_high += 1;
                continue;
            }
            counters.marked += 1;
            if voxels.mark(cell, layer as u32, mark_threshold) {
                let index = cell.1 * width + cell.0;
                grid.costs_mut()[index] = LETHAL;
                if let Some(writer) = &mut writer {
                    writer.note(index, [point[0], point[1]]);
                }
                bounds.touch(px, py);
            }
        }
    }
}
