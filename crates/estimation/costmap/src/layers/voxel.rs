//! What sensors see, in columns of voxels.
//!
//! Source of the rules: `nav2_costmap_2d/plugins/voxel_layer.cpp`.

use periplus_diagnostics::Diagnostic;
use periplus_grid::{Cell, CellFinder, GridInfo};
use periplus_params::ParamValues;

use super::obstacle::touch_ray;
use super::repeats::Repeats;
use super::sight::{Sight, complain_of_sensor, delegate_to_sight};
use crate::cost::{FREE, LETHAL, UNKNOWN};
use crate::observation::{Counters, Span};
use crate::trace::Pen;
use crate::voxel_grid::{MOST_VOXELS, Voxel, VoxelGrid, marked, unknown};
use crate::{Bounds, Compat, Costmap, Explanation, Layer, Moment, Observation, Source, Window};

/// How much of a ray that leaves the box is cut off beyond its edge, in parts of the ray.
const WITHIN_EDGE: f64 = 1e-5;

/// How far below the top rays are cut \[m\].
const BELOW_TOP_M: f64 = 0.01;

/// Heights of voxels and what their numbers mean.
#[derive(Clone, Copy, Debug)]
struct Columns {
    origin_z_m: f64,
    z_resolution_m: f64,
    height: u32,
    unknown_threshold: u32,
    mark_threshold: u32,
}

impl Columns {
    fn read(values: &ParamValues) -> Self {
        let number = |name: &str| values.number(name).unwrap_or_default();
        let count = |name: &str| {
            u32::try_from(values.integer(name).unwrap_or_default()).unwrap_or_default()
        };
        let height = count("z_voxels").min(MOST_VOXELS);
        Self {
            origin_z_m: number("origin_z"),
            z_resolution_m: number("z_resolution"),
            height,
            // The voxels that a column does not have are never seen, and shall not count.
            unknown_threshold: count("unknown_threshold").saturating_add(MOST_VOXELS - height),
            mark_threshold: count("mark_threshold"),
        }
    }

    fn top_m(&self) -> f64 {
        self.origin_z_m + f64::from(self.height) * self.z_resolution_m
    }

    /// A place in cells from the lowest corner; none outside.
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

/// Marks and clears voxels; a cell is an obstacle when enough voxels of its column are.
pub struct VoxelLayer {
    sight: Sight,
    columns: Columns,
    voxels: VoxelGrid,
    repeats: Repeats,
    /// Where rays ended in the last update, in the global frame \[m\], when somebody wants to know.
    clearing_ends: Option<Vec<[f32; 3]>>,
}

impl VoxelLayer {
    /// From parameters of [`crate::tables::VOXEL`]; `tracks_unknown` is the costmap's
    /// `track_unknown_space`.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        values: ParamValues,
        tracks_unknown: bool,
        sources: Vec<Source>,
    ) -> Self {
        let columns = Columns::read(&values);
        let sight = Sight::new(name.into(), values, tracks_unknown, sources);
        let voxels = VoxelGrid::new(*sight.grid.info(), columns.height);
        let mut layer =
            Self { sight, columns, voxels, repeats: Repeats::default(), clearing_ends: None };
        layer.complain_of_height();
        layer
    }

    fn complain_of_height(&mut self) {
        let values = &self.sight.values;
        let asked = values.integer("z_voxels").unwrap_or_default();
        if asked > i64::from(MOST_VOXELS) {
            self.sight.complaints.push(
                Diagnostic::warning(
                    "too-many-voxels",
                    format!("`{}.z_voxels` is {asked}; {MOST_VOXELS} are used", self.sight.name),
                )
                .at(values.origin("z_voxels"))
                .help("to reach as high, raise `z_resolution`"),
            );
        }
    }

    /// Adds a source.
    pub fn add_source(&mut self, source: Source) {
        self.sight.sources.push(source);
    }

    /// Its own cells, to be changed by hand; the voxels stay.
    pub fn grid_mut(&mut self) -> &mut Costmap {
        &mut self.sight.grid
    }

    /// The voxels.
    #[must_use]
    pub fn voxels(&self) -> &VoxelGrid {
        &self.voxels
    }

    /// Height of the lowest voxels \[m\].
    #[must_use]
    pub fn origin_z_m(&self) -> f64 {
        self.columns.origin_z_m
    }

    /// Height of a voxel \[m\].
    #[must_use]
    pub fn z_resolution_m(&self) -> f64 {
        self.columns.z_resolution_m
    }

    /// Whether voxels are to be published.
    #[must_use]
    pub fn publishes_voxels(&self) -> bool {
        self.sight.values.flag("publish_voxel_map").unwrap_or_default()
    }

    /// Whether somebody wants to know where rays end.
    pub fn keep_clearing_ends(&mut self, is_wanted: bool) {
        if !is_wanted {
            self.clearing_ends = None;
        } else if self.clearing_ends.is_none() {
            self.clearing_ends = Some(Vec::new());
        }
    }

    /// Where rays ended in the last update, in the global frame \[m\]; empty unless asked for.
    #[must_use]
    pub fn clearing_ends(&self) -> &[[f32; 3]] {
        self.clearing_ends.as_deref().unwrap_or_default()
    }

    fn clear(&mut self, moment: &Moment<'_>, bounds: &mut Bounds) {
        let sight = &mut self.sight;
        for source in sight.sources.iter_mut().filter(|source| source.settings.is_clearing) {
            for index in 0..source.observations.len() {
                let seen = &source.observations[index];
                let origin = seen.origin;
                let mut clearing = Clearing {
                    columns: self.columns,
                    compat: moment.compat,
                    grid: &mut sight.grid,
                    voxels: &mut self.voxels,
                    pen: sight.trace.pen(&source.name, seen, false),
                    ends: self.clearing_ends.as_mut(),
                };
                let is_inside = clearing.clear(seen, &mut self.repeats, bounds);
                if !is_inside && index < source.fresh {
                    source.counters.sensor_outside += 1;
                }
                // A cloud without points has no rays to lose.
                let is_lost = !is_inside && !source.observations[index].points.is_empty();
                let heights = Some((self.columns.origin_z_m, self.columns.top_m()));
                let (name, info) = (&sight.name, sight.grid.info());
                let complaints = &mut sight.complaints;
                complain_of_sensor(is_lost, name, source, origin, info, heights, complaints);
            }
        }
    }

    fn mark(&mut self, compat: Compat, bounds: &mut Bounds) {
        let sight = &mut self.sight;
        for source in sight.sources.iter_mut().filter(|source| source.settings.is_marking) {
            for (index, seen) in source.observations.iter().enumerate() {
                let mut unseen = Counters::default();
                let is_first = index < source.fresh;
                let counters = if is_first { &mut source.counters } else { &mut unseen };
                let pen = sight.trace.pen(&source.name, seen, true);
                let mut heights = sight.heights;
                if !compat.has_lowest_voxel_height() {
                    heights.min_m = f64::NEG_INFINITY;
                }
                let marker = Marker { columns: self.columns, heights };
                marker.mark(&mut sight.grid, &mut self.voxels, pen, seen, counters, bounds);
            }
        }
    }
}

impl Layer for VoxelLayer {
    delegate_to_sight!();

    fn bounds(&mut self, moment: &Moment<'_>, bounds: &mut Bounds) {
        let takes_part = self.sight.begin(moment, bounds);
        if moment.is_rolling {
            self.voxels.follow(self.sight.grid.info());
        }
        if !takes_part {
            return;
        }
        if let Some(ends) = &mut self.clearing_ends {
            ends.clear();
        }
        self.clear(moment, bounds);
        self.mark(moment.compat, bounds);
        self.sight.end(moment, bounds);
    }

    fn reset(&mut self) {
        self.sight.reset();
        self.voxels.reset();
    }

    fn resized(&mut self, info: &GridInfo, _is_rolling: bool) {
        self.sight.resized(info);
        self.voxels = VoxelGrid::new(*self.sight.grid.info(), self.columns.height);
    }

    fn configure(&mut self, values: ParamValues) -> Result<(), String> {
        if values.flag("publish_voxel_map") != self.sight.values.flag("publish_voxel_map") {
            return Err("`publish_voxel_map` cannot be changed while the costmap runs".into());
        }
        let columns = Columns::read(&values);
        let is_same = (columns.height, columns.origin_z_m, columns.z_resolution_m)
            == (self.columns.height, self.columns.origin_z_m, self.columns.z_resolution_m);
        self.columns = columns;
        self.sight.configure(values);
        self.complain_of_height();
        if !is_same {
            let info = *self.sight.grid.info();
            self.resized(&info, false);
        }
        Ok(())
    }

    fn explain(&self, _master: &Costmap, cell: Cell, _is_rolling: bool) -> Explanation {
        let mut explanation = self.sight.explain(cell);
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
        let missing = MOST_VOXELS - self.columns.height;
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

/// What is needed to clear along rays.
struct Clearing<'a> {
    columns: Columns,
    compat: Compat,
    grid: &'a mut Costmap,
    voxels: &'a mut VoxelGrid,
    pen: Option<Pen<'a>>,
    ends: Option<&'a mut Vec<[f32; 3]>>,
}

impl Clearing<'_> {
    /// Clears along all rays; false when the sensor is outside of the box.
    fn clear(&mut self, seen: &Observation, repeats: &mut Repeats, bounds: &mut Bounds) -> bool {
        let Columns { unknown_threshold, mark_threshold, .. } = self.columns;
        let finder = self.grid.finder();
        let info = *self.grid.info();
        let Some(start) = self.columns.place(&info, &finder, seen.origin) else { return false };
        let rays = Rays::new(self.columns, &info, self.compat, seen.origin);
        let longest = self.grid.cells_along(seen.rays.max_m);
        let shortest = self.grid.cells_along(seen.rays.min_m);
        let whole_m = f64::from(longest);
        repeats.forget();
        for point in &seen.points {
            let end_m = rays.end(*point);
            let Some(end) = self.columns.place(&info, &finder, end_m) else { continue };
            let [ox, oy, _] = seen.origin;
            touch_ray(bounds, [ox, oy], [end_m[0], end_m[1]], &seen.rays);
            if let Some(ends) = &mut self.ends {
                ends.push(end_m.map(|at| at as f32));
            }
            // A ray that is not cut goes through the same voxels as the others that end where it
            // does. Where a cut one ends depends on its length to the last digit.
            if shortest == 0 && is_within(start, end, whole_m) {
                let [x, y, z] = end.map(|at| at as u64);
                if repeats.has((y * info.width as u64 + x) << 4 | z) {
                    continue;
                }
            }
            let costs = self.grid.costs_mut();
            let pen = &mut self.pen;
            self.voxels.clear_along(start, end, shortest, longest, |index, column| {
                if marked(column) <= mark_threshold {
                    let is_free =
                        unknown_threshold >= MOST_VOXELS || unknown(column) <= unknown_threshold;
                    costs[index] = if is_free { FREE } else { UNKNOWN };
                    if let Some(pen) = pen {
                        pen.note(index, [point[0], point[1]]);
                    }
                }
            });
        }
        true
    }
}

/// Whether two places are no further apart.
fn is_within(start: [f64; 3], end: [f64; 3], distance: f64) -> bool {
    let [dx, dy, dz] = [end[0] - start[0], end[1] - start[1], end[2] - start[2]];
    dx * dx + dy * dy + dz * dz <= distance * distance
}

/// Where rays end that shall stay in a box.
struct Rays {
    origin: [f64; 3],
    low: [f64; 3],
    high: [f64; 3],
    shorter_m: f64,
    /// Part of a cut ray that is left out at its end.
    margin: f64,
}

impl Rays {
    fn new(columns: Columns, info: &GridInfo, compat: Compat, origin: [f64; 3]) -> Self {
        let length = |cells: usize| (cells as f64 - compat.missing_cells()) * info.resolution_m;
        let low = [info.origin.x_m, info.origin.y_m, columns.origin_z_m];
        let high = [low[0] + length(info.width), low[1] + length(info.height), columns.top_m()];
        let margin = if compat.shortens_cut_rays() { WITHIN_EDGE } else { 0.0 };
        Self { origin, low, high, shorter_m: 2.0 * info.resolution_m, margin }
    }

    /// The end of the ray to a point: two cells before it, so that it does not clear the obstacle
    /// itself, or where it leaves the box.
    #[inline]
    fn end(&self, point: [f32; 3]) -> [f64; 3] {
        let [ox, oy, oz] = self.origin;
        let [dx, dy, dz] =
            [f64::from(point[0]) - ox, f64::from(point[1]) - oy, f64::from(point[2]) - oz];
        let distance = (dx * dx + dy * dy + dz * dz).sqrt();
        let part = ((distance - self.shorter_m) / distance).clamp(0.0, 1.0);
        let along = [dx, dy, dz].map(|length| part * length);
        let end = [along[0] + ox, along[1] + oy, along[2] + oz];
        // How much of that is in the box.
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

/// Marks points.
struct Marker {
    columns: Columns,
    heights: Span,
}

impl Marker {
    fn mark(
        &self,
        grid: &mut Costmap,
        voxels: &mut VoxelGrid,
        mut pen: Option<Pen<'_>>,
        seen: &Observation,
        counters: &mut Counters,
        bounds: &mut Bounds,
    ) {
        let Columns { origin_z_m, z_resolution_m, height, mark_threshold, .. } = self.columns;
        let finder = grid.finder();
        let width = grid.info().width;
        let [ox, oy, oz] = seen.origin;
        let Span { min_m, max_m } = seen.marks;
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
            // What is seen below the box stands on its floor.
            let layer = (pz.max(origin_z_m) - origin_z_m) / z_resolution_m;
            if layer >= f64::from(height) {
                counters.layer_too_high += 1;
                continue;
            }
            counters.marked += 1;
            if voxels.mark(cell, layer as u32, mark_threshold) {
                let index = cell.1 * width + cell.0;
                grid.costs_mut()[index] = LETHAL;
                if let Some(pen) = &mut pen {
                    pen.note(index, [point[0], point[1]]);
                }
                bounds.touch(px, py);
            }
        }
    }
}
