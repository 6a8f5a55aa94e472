//! What sensors see, on the ground.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/obstacle_layer.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_grid::{Cell, GridInfo, Line};
use periplus_params::ParamValues;

use super::repeats::Repeats;
use super::sight::{Sight, complain_of_sensor, delegate_to_sight};
use crate::compat::RangeMeasure;
use crate::cost::{FREE, LETHAL};
use crate::observation::{Counters, Span};
use crate::trace::Pen;
use crate::{Bounds, Compat, Costmap, Explanation, Layer, Moment, Observation, Source, Window};

/// How far from the far edges rays are cut \[m\].
const WITHIN_EDGE_M: f64 = 0.001;

/// Marks cells where something is and clears cells that are seen through.
pub struct ObstacleLayer {
    sight: Sight,
    repeats: Repeats,
}

impl ObstacleLayer {
    /// From parameters of [`crate::tables::OBSTACLE`]; `tracks_unknown` is the costmap's
    /// `track_unknown_space`.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        values: ParamValues,
        tracks_unknown: bool,
        sources: Vec<Source>,
    ) -> Self {
        let sight = Sight::new(name.into(), values, tracks_unknown, sources);
        Self { sight, repeats: Repeats::default() }
    }

    /// Adds a source.
    pub fn add_source(&mut self, source: Source) {
        self.sight.sources.push(source);
    }

    /// Its own cells, to be changed by hand.
    pub fn grid_mut(&mut self) -> &mut Costmap {
        &mut self.sight.grid
    }
}

impl Layer for ObstacleLayer {
    delegate_to_sight!();

    fn bounds(&mut self, moment: &Moment<'_>, bounds: &mut Bounds) {
        let sight = &mut self.sight;
        if !sight.begin(moment, bounds) {
            return;
        }
        // All rays of all sources first: what is marked in an update stays.
        for source in sight.sources.iter_mut().filter(|source| source.settings.is_clearing) {
            for index in 0..source.observations.len() {
                let seen = &source.observations[index];
                let origin = seen.origin;
                let pen = sight.trace.pen(&source.name, seen, false);
                let is_inside = clear_rays(&mut sight.grid, pen, seen, &mut self.repeats, bounds);
                if !is_inside && index < source.fresh {
                    source.counters.sensor_outside += 1;
                }
                let (name, info) = (&sight.name, sight.grid.info());
                let complaints = &mut sight.complaints;
                complain_of_sensor(!is_inside, name, source, origin, info, None, complaints);
            }
        }
        for source in sight.sources.iter_mut().filter(|source| source.settings.is_marking) {
            for (index, seen) in source.observations.iter().enumerate() {
                let mut unseen = Counters::default();
                let is_first = index < source.fresh;
                let counters = if is_first { &mut source.counters } else { &mut unseen };
                let pen = sight.trace.pen(&source.name, seen, true);
                let marker = Marker { heights: sight.heights, compat: moment.compat };
                marker.mark(&mut sight.grid, pen, seen, counters, bounds);
            }
        }
        sight.end(moment, bounds);
    }

    fn reset(&mut self) {
        self.sight.reset();
    }

    fn resized(&mut self, info: &GridInfo, _is_rolling: bool) {
        self.sight.resized(info);
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), String> {
        self.sight.configure(values);
        Ok(())
    }

    fn explain(&self, _master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        self.sight.explain(cell)
    }
}

/// Clears what rays go through; false when the sensor is outside of the grid, from where nothing
/// can be cleared.
fn clear_rays(
    grid: &mut Costmap,
    mut pen: Option<Pen<'_>>,
    seen: &Observation,
    repeats: &mut Repeats,
    bounds: &mut Bounds,
) -> bool {
    let [ox, oy, _] = seen.origin;
    let finder = grid.finder();
    let Some(start) = finder.cell_of(ox, oy) else { return false };
    let Bounds { min_x, min_y, .. } = Bounds::of(grid.info());
    let GridInfo { resolution_m, width, height, .. } = *grid.info();
    let (end_x, end_y) =
        (min_x + width as f64 * resolution_m, min_y + height as f64 * resolution_m);
    let longest = grid.cells_along(seen.rays.max_m);
    let shortest = grid.cells_along(seen.rays.min_m);
    bounds.touch(ox, oy);
    repeats.forget();
    for point in &seen.points {
        let (mut wx, mut wy) = (f64::from(point[0]), f64::from(point[1]));
        let (a, b) = (wx - ox, wy - oy);
        // Rays that leave the grid are cut at its edge, one side after the other.
        if wx < min_x {
            (wx, wy) = (min_x, oy + b * ((min_x - ox) / a));
        }
        if wy < min_y {
            (wx, wy) = (ox + a * ((min_y - oy) / b), min_y);
        }
        if wx > end_x {
            (wx, wy) = (end_x - WITHIN_EDGE_M, oy + b * ((end_x - ox) / a));
        }
        if wy > end_y {
            (wx, wy) = (ox + a * ((end_y - oy) / b), end_y - WITHIN_EDGE_M);
        }
        let Some(end) = finder.cell_of(wx, wy) else { continue };
        touch_ray(bounds, [ox, oy], [wx, wy], &seen.rays);
        // Which cells a ray goes through depends on its first and its last one alone.
        if repeats.has((end.1 * width + end.0) as u64) {
            continue;
        }
        let costs = grid.costs_mut();
        for (x, y) in Line::within(start, end, shortest, longest) {
            let index = y * width + x;
            costs[index] = FREE;
            if let Some(pen) = &mut pen {
                pen.note(index, [point[0], point[1]]);
            }
        }
    }
    true
}

/// Enlarges bounds by the part of a ray that clears (`updateRaytraceBounds`).
#[inline]
pub(super) fn touch_ray(bounds: &mut Bounds, origin: [f64; 2], end: [f64; 2], rays: &Span) {
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

/// Marks points.
struct Marker {
    heights: Span,
    compat: Compat,
}

impl Marker {
    fn mark(
        &self,
        grid: &mut Costmap,
        mut pen: Option<Pen<'_>>,
        seen: &Observation,
        counters: &mut Counters,
        bounds: &mut Bounds,
    ) {
        let [ox, oy, oz] = seen.origin;
        let finder = grid.finder();
        let measure = self.compat.range_measure();
        // Cells from the sensor are counted where it has one; measured in space it needs none.
        let start = finder.cell_of(ox, oy).filter(|_| measure != RangeMeasure::Space);
        if start.is_none() && measure != RangeMeasure::Space {
            return;
        }
        let width = grid.info().width;
        let Span { min_m, max_m } = seen.marks;
        let (nearest, furthest) = (grid.cells_along(min_m), grid.cells_along(max_m));
        let costs = grid.costs_mut();
        for point in &seen.points {
            let [px, py, pz] = point.map(f64::from);
            if pz < self.heights.min_m {
                counters.layer_too_low += 1;
                continue;
            }
            if pz > self.heights.max_m {
                counters.layer_too_high += 1;
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
            if let Some(pen) = &mut pen {
                pen.note(index, [point[0], point[1]]);
            }
            bounds.touch(px, py);
        }
    }
}
