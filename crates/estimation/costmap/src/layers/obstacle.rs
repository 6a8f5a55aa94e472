//! Obstacle layer: obstacles seen by sensors, in the plane.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/obstacle_layer.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_grid::{Cell, GridInfo, Line};
use periplus_params::ParamValues;

use super::observed::{ObservationLayer, delegate_to_observation_layer, warn_sensor_outside};
use super::ray_dedup::RayDeduplicator;
use crate::compat::RangeMeasure;
use crate::cost::{FREE, LETHAL};
use crate::observation::{Counters, RangeLimits};
use crate::trace::TraceWriter;
use crate::{
    CellWindow, ChangeError, Costmap, Explanation, Layer, Nav2Release, Observation,
    ObservationSource, UpdateBounds, UpdateContext,
};

/// Distance inside the upper edges at which rays are cut \[m\].
const EDGE_MARGIN_M: f64 = 0.001;

/// Layer that marks cells with obstacles and clears cells along rays.
pub struct ObstacleLayer {
    observed: ObservationLayer,
    ray_dedup: RayDeduplicator,
}

impl ObstacleLayer {
    /// Creates the layer from parameters of [`crate::tables::OBSTACLE`]; `tracks_unknown` is
    /// `track_unknown_space` of the costmap.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        values: ParamValues,
        tracks_unknown: bool,
        sources: Vec<ObservationSource>,
    ) -> Self {
        let observed = ObservationLayer::new(name.into(), values, tracks_unknown, sources);
        Self { observed, ray_dedup: RayDeduplicator::default() }
    }

    /// Adds a source.
    pub fn add_source(&mut self, source: ObservationSource) {
        self.observed.sources.push(source);
    }

    /// Returns the grid of the layer for manual changes.
    pub fn grid_mut(&mut self) -> &mut Costmap {
        &mut self.observed.grid
    }
}

impl Layer for ObstacleLayer {
    delegate_to_observation_layer!();

    fn bounds(&mut self, moment: &UpdateContext<'_>, bounds: &mut UpdateBounds) {
        let observed = &mut self.observed;
        if !observed.begin(moment, bounds) {
            return;
        }
        // All rays of all sources come first: marks of this update stay.
        for source in observed.sources.iter_mut().filter(|source| source.settings.is_clearing) {
            for index in 0..source.observations.len() {
                let seen = &source.observations[index];
                let origin = seen.origin;
                let writer = observed.trace.writer(&source.name, seen, false);
                let is_inside =
                    clear_rays(&mut observed.grid, writer, seen, &mut self.ray_dedup, bounds);
                if !is_inside && index < source.fresh {
                    source.counters.sensor_outside += 1;
                }
                let (name, info) = (&observed.name, observed.grid.info());
                let diagnostics = &mut observed.diagnostics;
                warn_sensor_outside(!is_inside, name, source, origin, info, None, diagnostics);
            }
        }
        for source in observed.sources.iter_mut().filter(|source| source.settings.is_marking) {
            for (index, seen) in source.observations.iter().enumerate() {
                let mut unseen = Counters::default();
                let is_first = index < source.fresh;
                let counters = if is_first { &mut source.counters } else { &mut unseen };
                let writer = observed.trace.writer(&source.name, seen, true);
                let marker = Marker { heights: observed.heights, compat: moment.compat };
                marker.mark(&mut observed.grid, writer, seen, counters, bounds);
            }
        }
        observed.end(moment, bounds);
    }

    fn reset(&mut self) {
        self.observed.reset();
    }

    fn resized(&mut self, info: &GridInfo, _is_rolling: bool) {
        self.observed.resized(info);
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), ChangeError> {
        self.observed.configure(values);
        Ok(())
    }

    fn explain(&self, _master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        self.observed.explain(cell)
    }
}

/// Clears the cells along rays; returns false when the sensor is outside the grid, from which rays
/// cannot be cleared.
fn clear_rays(
    grid: &mut Costmap,
    mut writer: Option<TraceWriter<'_>>,
    seen: &Observation,
    ray_dedup: &mut RayDeduplicator,
    bounds: &mut UpdateBounds,
) -> bool {
    let [ox, oy, _] = seen.origin;
    let finder = grid.finder();
    let Some(start) = finder.cell_of(ox, oy) else { return false };
    let UpdateBounds { min_x, min_y, .. } = UpdateBounds::of(grid.info());
    let GridInfo { resolution_m, width, height, .. } = *grid.info();
    let (end_x, end_y) =
        (min_x + width as f64 * resolution_m, min_y + height as f64 * resolution_m);
    let longest = grid.cells_along(seen.rays.max_m);
    let shortest = grid.cells_along(seen.rays.min_m);
    bounds.touch(ox, oy);
    ray_dedup.forget();
    for point in &seen.points {
        let (mut wx, mut wy) = (f64::from(point[0]), f64::from(point[1]));
        let (a, b) = (wx - ox, wy - oy);
        // Rays that leave the grid are cut at its edges, one side after the other.
        if wx < min_x {
            (wx, wy) = (min_x, oy + b * ((min_x - ox) / a));
        }
        if wy < min_y {
            (wx, wy) = (ox + a * ((min_y - oy) / b), min_y);
        }
        if wx > end_x {
            (wx, wy) = (end_x - EDGE_MARGIN_M, oy + b * ((end_x - ox) / a));
        }
        if wy > end_y {
            (wx, wy) = (ox + a * ((end_y - oy) / b), end_y - EDGE_MARGIN_M);
        }
        let Some(end) = finder.cell_of(wx, wy) else { continue };
        touch_ray(bounds, [ox, oy], [wx, wy], &seen.rays);
        // The cells of a ray depend on its first and last cell alone.
        if ray_dedup.has((end.1 * width + end.0) as u64) {
            continue;
        }
        let costs = grid.costs_mut();
        for (x, y) in Line::within(start, end, shortest, longest) {
            let index = y * width + x;
            costs[index] = FREE;
            if let Some(writer) = &mut writer {
                writer.note(index, [point[0], point[1]]);
            }
        }
    }
    true
}

/// Enlarges bounds by the cleared part of a ray (`updateRaytraceBounds`).
#[inline]
pub(super) fn touch_ray(
    bounds: &mut UpdateBounds,
    origin: [f64; 2],
    end: [f64; 2],
    rays: &RangeLimits,
) {
    let (dx, dy) = (end[0] - origin[0], end[1] - origin[1]);
    let squared = dx * dx + dy * dy;
    if rays.min_m > 0.0 && squared < rays.min_m * rays.min_m {
        return;
    }
    if squared <= rays.max_m * rays.max_m {
        return bounds.touch(end[0], end[1]);
    }
    let part = (rays.max_m / (squared).sqrt()).min(1.0);
    bounds.touch(origin[0] + dx * part, origin[1] + dy * part);
}

/// Marker of points.
struct Marker {
    heights: RangeLimits,
    compat: Nav2Release,
}

impl Marker {
    fn mark(
        &self,
        grid: &mut Costmap,
        mut writer: Option<TraceWriter<'_>>,
        seen: &Observation,
        counters: &mut Counters,
        bounds: &mut UpdateBounds,
    ) {
        let [ox, oy, oz] = seen.origin;
        let finder = grid.finder();
        let measure = self.compat.range_measure();
        // Distances in cells need a sensor inside the grid; those in space do not.
        let start = finder.cell_of(ox, oy).filter(|_| measure != RangeMeasure::Space);
        if start.is_none() && measure != RangeMeasure::Space {
            return;
        }
        let width = grid.info().width;
        let RangeLimits { min_m, max_m } = seen.marks;
        let (nearest, furthest) = (grid.cells_along(min_m), grid.cells_along(max_m));
        let costs = grid.costs_mut();
        for point in &seen.points {
            let [px, py, pz] = point.map(f64::from);
            if !counters.is_in_layer(pz, &self.heights) {
                continue;
            }
            let (dx, dy, dz) = (px - ox, py - oy, pz - oz);
            let (is_too_far, is_too_near) = match measure {
                RangeMeasure::Cells => (false, false),
                RangeMeasure::GroundAndCells => {
                    let squared = dx * dx + dy * dy;
                    (squared > max_m * max_m, squared < min_m * min_m)
                }
                RangeMeasure::Space => {
                    let squared = dx * dx + dy * dy + dz * dz;
                    (squared >= max_m * max_m, squared < min_m * min_m)
                }
            };
            if is_too_far {
                counters.too_far += 1;
                continue;
            }
            if is_too_near {
                counters.too_near += 1;
                continue;
            }
            let Some((x, y)) = finder.cell_of(px, py) else {
                counters.outside += 1;
                continue;
            };
            if let Some(start) = start {
                // The same measure by which rays are cut.
                let (columns, rows) = (x.abs_diff(start.0) as f64, y.abs_diff(start.1) as f64);
                let cells = (columns * columns + rows * rows).sqrt() as u32;
                if cells > furthest {
                    counters.too_far += 1;
                    continue;
                }
                if cells < nearest {
                    counters.too_near += 1;
                    continue;
                }
            }
            counters.marked += 1;
            let index = y * width + x;
            costs[index] = LETHAL;
            if let Some(writer) = &mut writer {
                writer.note(index, [point[0], point[1]]);
            }
            bounds.touch(px, py);
        }
    }
}
