//! Floor on which people walk, from the collisions of the world at the height of their bodies.
//!
//! Cells are not free where a surface is at one of several heights of a body, as on the true map, or where something is
//! above the floor and below the head, such as the top of a table. Robots and people are not surfaces of the floor.

use periplus_crowds::{CrowdError, DVec2, Floor};
use periplus_geometry::{DVec3, Pose};
use periplus_grid::occupancy::{OCCUPIED, UNKNOWN};
use periplus_grid::{Cell, Grid, OccupancyGrid};
use periplus_raycast::Ray;
use periplus_rendering::{RenderScene, SensedGeometry, filter};
use periplus_scene::{Model, Shape};

use super::contour::walls_around;
use crate::default_world::reach_m;
use crate::files::AssetFiles;
use crate::simulation::Simulation;
use crate::truth_map::mark_walls;
use crate::wall_grid;

/// Heights above the floor at which surfaces block a body \[m\].
const BODY_HEIGHTS_M: [f64; 6] = [0.12, 0.35, 0.65, 0.95, 1.25, 1.55];

/// Lowest and highest surface that blocks a body, above the floor: below are thresholds, above lintels \[m\].
const BODY_RANGE_M: [f64; 2] = [0.1, 1.75];

/// Free floor around everything in the world \[m\].
const MARGIN_M: f64 = 3.0;

/// Free floor around the robots in a world without walls \[m\].
const OPEN_MARGIN_M: f64 = 10.0;

/// Largest side of the floor; parts that are farther from its centre are left out \[m\].
const MAX_SIDE_M: f64 = 300.0;

/// Distance from a position within which its free cell is searched \[m\].
const SEARCH_M: f64 = 1.0;

/// Distance beyond a surface of a robot at which a ray goes on \[m\].
const PAST_SURFACE_M: f64 = 1e-6;

/// Maximum number of surfaces of robots that a ray passes.
const MAX_SURFACE_COUNT: usize = 100;

/// Reason why people have no floor.
#[derive(Debug)]
pub(crate) enum FloorError {
    /// No cell is free at the positions of the robots or people.
    NotFree,
    /// The walls are no floor.
    Crowd(CrowdError),
}

/// Positions from which the floor must be reachable, and an area in which people start.
pub(crate) struct FloorSeeds {
    /// Positions of people and goals: the first decides.
    pub(crate) positions: Vec<DVec2>,
    /// Area in which people start.
    pub(crate) area_m: Option<[[f64; 2]; 2]>,
    /// Positions of robots.
    pub(crate) robots: Vec<DVec2>,
}

impl Simulation {
    /// Returns the floor of people at a height \[m\].
    pub(crate) fn people_floor(
        &mut self,
        floor_m: f64,
        seeds: &FloorSeeds,
    ) -> Result<Floor, FloorError> {
        let skipped = self.names_of_moving();
        let is_skipped = |name: &str| skipped.iter().any(|skipped| skipped == name);
        let [low, high] = self.region(floor_m, seeds, &is_skipped);
        let info = wall_grid(low.x, low.y, high.x, high.y);
        let mut map = Grid::new(info, UNKNOWN);
        let seen = self.views.at(SensedGeometry::Collision, self.time_ns, &self.motion);
        for height_m in BODY_HEIGHTS_M {
            mark_walls(&mut map, seen, floor_m + height_m, &is_skipped);
        }
        mark_tops(&mut map, seen, floor_m, &is_skipped);
        let free = free_area(&map, seeds).ok_or(FloorError::NotFree)?;
        Floor::new(walls_around(&free)).map_err(FloorError::Crowd)
    }

    /// Corners of the region that is searched for walls.
    fn region(
        &self,
        floor_m: f64,
        seeds: &FloorSeeds,
        is_skipped: &dyn Fn(&str) -> bool,
    ) -> [DVec2; 2] {
        let mut extent = Extent::default();
        for running in self.running.iter().filter(|it| !is_skipped(&it.member.name)) {
            let pose = self.motion.model_pose(running.model).unwrap_or_default();
            extent.add_model(&running.member.model, pose, floor_m, self.files());
        }
        let margin_m = if extent.low.x.is_finite() { MARGIN_M } else { OPEN_MARGIN_M };
        let robots = seeds.robots.iter().chain(&seeds.positions).copied();
        let corners = seeds.area_m.into_iter().flatten().map(DVec2::from);
        for position in robots.chain(corners) {
            extent.add(position);
        }
        if !extent.low.x.is_finite() {
            extent.add(DVec2::ZERO);
        }
        let (low, high) = (extent.low - margin_m, extent.high + margin_m);
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let half = half.min(DVec2::splat(0.5 * MAX_SIDE_M));
        [centre - half, centre + half]
    }
}

/// Bounding box of surfaces at the height of a body.
struct Extent {
    low: DVec2,
    high: DVec2,
}

impl Default for Extent {
    fn default() -> Self {
        Self { low: DVec2::splat(f64::INFINITY), high: DVec2::splat(f64::NEG_INFINITY) }
    }
}

impl Extent {
    fn add(&mut self, point: DVec2) {
        (self.low, self.high) = (self.low.min(point), self.high.max(point));
    }

    /// Adds the collisions that reach the height of a body; planes and terrain have no extent.
    fn add_model(
        &mut self,
        model: &Model,
        world_from_model: Pose,
        floor_m: f64,
        files: &AssetFiles,
    ) {
        for link in &model.links {
            for collision in &link.collisions {
                let world_from_shape =
                    world_from_model * link.model_from_link * collision.link_from_collision;
                let Some([low, high]) = bounds_m(&collision.shape, world_from_shape, files) else {
                    continue;
                };
                let [min_m, max_m] = BODY_RANGE_M.map(|height_m| floor_m + height_m);
                if high.z >= min_m && low.z <= max_m && low.is_finite() && high.is_finite() {
                    self.add(low.truncate());
                    self.add(high.truncate());
                }
            }
        }
        for inner in &model.models {
            self.add_model(inner, world_from_model * inner.parent_from_model, floor_m, files);
        }
    }
}

/// Lowest and highest coordinates of a shape in the world \[m\].
fn bounds_m(shape: &Shape, world_from_shape: Pose, files: &AssetFiles) -> Option<[DVec3; 2]> {
    if let Shape::Mesh(mesh) = shape {
        let points = periplus_physics::Meshes::triangles(files, mesh)?.points_m;
        let points = points.into_iter().map(|point| world_from_shape.transform_point(point));
        let bounds = [DVec3::splat(f64::INFINITY), DVec3::splat(f64::NEG_INFINITY)];
        return Some(points.fold(bounds, |[low, high], it| [low.min(it), high.max(it)]));
    }
    let shape_from_world = world_from_shape.rotation.conjugate();
    let along = |axis: DVec3| reach_m(shape, shape_from_world * axis);
    let reach = DVec3::new(along(DVec3::X)?, along(DVec3::Y)?, along(DVec3::Z)?);
    Some([world_from_shape.translation - reach, world_from_shape.translation + reach])
}

/// Marks the cells above which something is between the floor and the head.
fn mark_tops(
    map: &mut OccupancyGrid,
    seen: &RenderScene,
    floor_m: f64,
    is_skipped: &dyn Fn(&str) -> bool,
) {
    let [min_m, max_m] = BODY_RANGE_M;
    for index in 0..map.info.len() {
        let cell = map.info.cell(index);
        if map[cell] == OCCUPIED {
            continue;
        }
        let (x_m, y_m) = map.info.centre_of(cell);
        let from = DVec3::new(x_m, y_m, floor_m + max_m);
        let mut ray = Ray { max_m: max_m - min_m, ..Ray::new(from, DVec3::NEG_Z) };
        for _ in 0..MAX_SURFACE_COUNT {
            let Some(hit) = seen.rays().cast(&ray, filter(u32::MAX, None)) else { break };
            if !is_skipped(seen.surface(&hit).model) {
                map[cell] = OCCUPIED;
                break;
            }
            ray.min_m = hit.distance_m + PAST_SURFACE_M;
        }
    }
}

/// The connected free cells that people can walk on: those at the first position, or most of the area in which people
/// start, or at the first robot, or the largest that is enclosed.
fn free_area(map: &OccupancyGrid, seeds: &FloorSeeds) -> Option<Grid<bool>> {
    let info = map.info;
    let mut area_of = Grid::new(info, u32::MAX);
    // Whether it is enclosed, and the number of its cells.
    let mut areas: Vec<(bool, usize)> = Vec::new();
    let mut stack = Vec::new();
    for start in 0..info.len() {
        if map.cells[start] == OCCUPIED || area_of.cells[start] != u32::MAX {
            continue;
        }
        let Ok(number) = u32::try_from(areas.len()) else { break };
        area_of.cells[start] = number;
        stack.push(info.cell(start));
        let mut area = (true, 0);
        while let Some((column, row)) = stack.pop() {
            area.1 += 1;
            area.0 &= column > 0 && row > 0 && column + 1 < info.width && row + 1 < info.height;
            let sides = [
                (column.wrapping_sub(1), row),
                (column + 1, row),
                (column, row.wrapping_sub(1)),
                (column, row + 1),
            ];
            for side in sides.into_iter().filter(|side| info.contains(*side)) {
                if map[side] != OCCUPIED && area_of[side] == u32::MAX {
                    area_of[side] = number;
                    stack.push(side);
                }
            }
        }
        areas.push(area);
    }
    let at = |position: &DVec2| nearest_area(&area_of, *position);
    let in_spawn_area = || most_of(&area_of, seeds.area_m?);
    let largest = || {
        let best = (0..areas.len()).max_by_key(|area| areas[*area])?;
        u32::try_from(best).ok()
    };
    let chosen = if let Some(first) = seeds.positions.first() {
        at(first)?
    } else if seeds.area_m.is_some() {
        in_spawn_area()?
    } else {
        seeds.robots.iter().find_map(at).or_else(largest)?
    };
    Some(area_of.map(|area| *area == chosen))
}

/// Area of the free cell that is nearest to a position.
fn nearest_area(area_of: &Grid<u32>, position: DVec2) -> Option<u32> {
    let info = area_of.info;
    let distance_m = |cell: Cell| DVec2::from(info.centre_of(cell)).distance(position);
    let cells = (0..info.len()).filter(|index| area_of.cells[*index] != u32::MAX);
    let near = cells.map(|index| (distance_m(info.cell(index)), index));
    let near = near.filter(|(distance_m, _)| *distance_m <= SEARCH_M);
    let (_, index) = near.min_by(|one, two| one.0.total_cmp(&two.0))?;
    Some(area_of.cells[index])
}

/// Area with the most cells in a rectangle.
fn most_of(area_of: &Grid<u32>, [one, two]: [[f64; 2]; 2]) -> Option<u32> {
    let (one, two) = (DVec2::from(one), DVec2::from(two));
    let (low, high) = (one.min(two), one.max(two));
    let mut counts = std::collections::BTreeMap::new();
    for index in (0..area_of.info.len()).filter(|index| area_of.cells[*index] != u32::MAX) {
        let centre = DVec2::from(area_of.info.centre_of(area_of.info.cell(index)));
        if centre.cmpge(low).all() && centre.cmple(high).all() {
            *counts.entry(area_of.cells[index]).or_insert(0_usize) += 1;
        }
    }
    counts
        .into_iter()
        .max_by_key(|(area, count)| (*count, std::cmp::Reverse(*area)))
        .map(|(area, _)| area)
}
