//! True occupancy grid: a horizontal slice of the world at the height of a lidar.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_grid::occupancy::{FREE, OCCUPIED, UNKNOWN};
use periplus_grid::{Grid, GridInfo, OccupancyGrid};
use periplus_raycast::{InstanceId, Ray};
use periplus_rendering::{RenderScene, SensedGeometry, filter};
use periplus_scene::{Model, SensorKind};

use crate::Simulation;
use crate::simulation::RunningModel;

/// Offset of a wall's point behind its surface \[m\]: walls are often on the borders of cells.
const INTO_WALL_M: f64 = 1e-3;

/// Distance from a surface of the robot at which a ray goes on \[m\].
const PAST_SURFACE_M: f64 = 1e-6;

/// Number of directions in which each point of an outline looks for surfaces.
const CLEARANCE_RAYS: usize = 64;

/// Maximum number of surfaces that a ray hits.
const MOST_SURFACES: usize = 1000;

/// Height of the slice without a lidar \[m\].
const DEFAULT_HEIGHT_M: f64 = 0.2;

/// A lidar on a robot.
struct SliceView {
    height_m: f64,
    geometry: SensedGeometry,
}

impl Simulation {
    /// Returns the true map on the cells of a grid: walls are where a shape intersects the height of
    /// the first robot's lidar, free is what the robot can reach without crossing one, the rest is
    /// unknown. The robot itself is not a wall. `None` without a robot.
    pub fn truth_map(&mut self, info: GridInfo) -> Option<OccupancyGrid> {
        let robot = self.robot()?;
        let (name, model) = (robot.member.name.clone(), robot.model);
        let eye = self.eye(robot);
        let world_from_robot = Pose2::from(self.motion.model_pose(model)?);
        let people = self.names_of_people();
        let height_m = eye.height_m;
        let seen = self.views.at(eye.geometry, self.time_ns, &self.motion);
        let mut map = Grid::new(info, UNKNOWN);
        // People are no walls.
        mark_walls(&mut map, seen, height_m, &|model| {
            model == name || people.iter().any(|it| it == model)
        });
        let from = info.cell_of(world_from_robot.x_m, world_from_robot.y_m);
        if let Some(from) = from {
            flood(&mut map, from);
        }
        Some(map)
    }

    /// Returns the distance from the outline of the first robot to the nearest surface of another model at the height of
    /// the robot's lidar, if it is less than `max_m`: 0 if a side meets a surface, otherwise that of the points which
    /// `is_near` keeps by their positions in the world \[m\]. They look in `CLEARANCE_RAYS` directions, so that a flat
    /// surface is up to 0.12 % further away. The outline is points in the frame of the robot \[m\].
    pub(crate) fn clearance_m(
        &mut self,
        outline_m: &[[f64; 2]],
        max_m: f64,
        is_near: impl Fn(f64, f64) -> bool,
    ) -> Option<f64> {
        let robot = self.robot()?;
        let (name, model) = (robot.member.name.clone(), robot.model);
        let SliceView { height_m, geometry } = self.eye(robot);
        let world_from_robot = Pose2::from(self.motion.model_pose(model)?);
        let seen = self.views.at(geometry, self.time_ns, &self.motion);
        let place = |[x_m, y_m]: &[f64; 2]| {
            let (x_m, y_m) = world_from_robot.transform_point(*x_m, *y_m);
            DVec3::new(x_m, y_m, height_m)
        };
        let points: Vec<DVec3> = outline_m.iter().map(place).collect();
        let mut sides = points.iter().zip(points.iter().cycle().skip(1));
        let is_met = sides.any(|(from, to)| {
            let length_m = (to - from).length();
            length_m > 0.0
                && distance_m(seen, *from, (to - from) / length_m, length_m, &name).is_some()
        });
        if is_met {
            return Some(0.0);
        }
        let mut nearest_m = None;
        for point in points.iter().filter(|point| is_near(point.x, point.y)) {
            for index in 0..CLEARANCE_RAYS {
                let (y, x) = libm::sincos(TAU * index as f64 / CLEARANCE_RAYS as f64);
                let limit_m = nearest_m.unwrap_or(max_m);
                let found_m = distance_m(seen, *point, DVec3::new(x, y, 0.0), limit_m, &name);
                nearest_m = found_m.or(nearest_m);
            }
        }
        nearest_m
    }

    /// Returns height and geometry of a robot's first lidar.
    fn eye(&self, robot: &RunningModel) -> SliceView {
        lidar(&robot.member.model, "")
            .and_then(|(link, eye)| {
                let link = self.motion.find_link(robot.model, &link)?;
                let world_from_link = self.motion.link_state(link)?.world_from_link;
                let place = world_from_link * eye.link_from_sensor;
                Some(SliceView { height_m: place.translation.z, geometry: eye.geometry })
            })
            .unwrap_or(SliceView {
                height_m: DEFAULT_HEIGHT_M,
                geometry: SensedGeometry::Collision,
            })
    }
}

/// A lidar on a link.
struct Mounted {
    link_from_sensor: Pose,
    geometry: SensedGeometry,
}

/// Returns the first lidar of a model, with the scoped name of its link; nested models come last.
fn lidar(model: &Model, scope: &str) -> Option<(String, Mounted)> {
    let own = model.links.iter().find_map(|link| {
        let is_lidar = |kind: &SensorKind| matches!(kind, SensorKind::Lidar(_));
        let sensor = link.sensors.iter().find(|sensor| is_lidar(&sensor.kind))?;
        // As in Gazebo: GPU lidars sense visuals, others collisions.
        let is_rendered = sensor.type_name.starts_with("gpu");
        let geometry = if is_rendered { SensedGeometry::Visual } else { SensedGeometry::Collision };
        let mounted = Mounted { link_from_sensor: sensor.parent_from_sensor, geometry };
        Some((format!("{scope}{}", link.name), mounted))
    });
    own.or_else(|| {
        let mut nested = model.models.iter();
        nested.find_map(|inner| lidar(inner, &format!("{scope}{}::", inner.name)))
    })
}

/// Marks the hits of rays along all rows and columns of cells, two in each and in both directions,
/// so that no face is missed edge-on or from behind.
pub(crate) fn mark_walls(
    map: &mut OccupancyGrid,
    seen: &RenderScene,
    height_m: f64,
    is_skipped: &dyn Fn(&str) -> bool,
) {
    let info = map.info;
    let (columns, rows) = (info.width as f64, info.height as f64);
    for half in 0..2 * info.height {
        let row = half as f64 / 2.0 + 0.25;
        mark_line(map, seen, [(0.0, row), (columns, row)], height_m, is_skipped);
    }
    for half in 0..2 * info.width {
        let column = half as f64 / 2.0 + 0.25;
        mark_line(map, seen, [(column, 0.0), (column, rows)], height_m, is_skipped);
    }
}

/// Marks the hits on a line between two points, in columns and rows, from either end.
fn mark_line(
    map: &mut OccupancyGrid,
    seen: &RenderScene,
    ends: [(f64, f64); 2],
    height_m: f64,
    is_skipped: &dyn Fn(&str) -> bool,
) {
    let place = |(column, row): (f64, f64)| {
        let (x_m, y_m) = map.info.point_at(column, row);
        DVec3::new(x_m, y_m, height_m)
    };
    let [first, last] = ends.map(place);
    let finder = map.info.finder();
    for (from, to) in [(first, last), (last, first)] {
        let length_m = (to - from).length();
        let mut ray = Ray { max_m: length_m, ..Ray::new(from, (to - from) / length_m) };
        // Shapes around the ray's origin: their next surface is the far side.
        let mut inside: Vec<InstanceId> = Vec::new();
        for _ in 0..MOST_SURFACES {
            let Some(hit) = seen.rays().cast(&ray, filter(u32::MAX, None)) else { break };
            let into_m = match inside.iter().position(|one| *one == hit.instance) {
                Some(place) => {
                    inside.swap_remove(place);
                    -INTO_WALL_M
                }
                None => {
                    inside.push(hit.instance);
                    INTO_WALL_M
                }
            };
            let at = ray.at(hit.distance_m + into_m);
            if !is_skipped(seen.surface(&hit).model)
                && let Some(cell) = finder.cell_of(at.x, at.y)
            {
                map[cell] = OCCUPIED;
            }
            ray.min_m = hit.distance_m + INTO_WALL_M;
        }
    }
}

/// Distance to the first surface of another model than the robot, if it is at most `max_m`.
fn distance_m(
    seen: &RenderScene,
    from: DVec3,
    direction: DVec3,
    max_m: f64,
    robot: &str,
) -> Option<f64> {
    let mut ray = Ray { max_m, ..Ray::new(from, direction) };
    for _ in 0..MOST_SURFACES {
        let hit = seen.rays().cast(&ray, filter(u32::MAX, None))?;
        if seen.surface(&hit).model != robot {
            return Some(hit.distance_m);
        }
        ray.min_m = hit.distance_m + PAST_SURFACE_M;
    }
    None
}

/// Marks as free all cells reachable from a cell over edges.
pub(crate) fn flood(map: &mut OccupancyGrid, from: (usize, usize)) {
    let (width, height) = (map.info.width, map.info.height);
    let mut open = VecDeque::from([from]);
    map[from] = FREE;
    while let Some((column, row)) = open.pop_front() {
        let beside = [
            (column.wrapping_sub(1), row),
            (column + 1, row),
            (column, row.wrapping_sub(1)),
            (column, row + 1),
        ];
        for cell in beside.into_iter().filter(|(column, row)| *column < width && *row < height) {
            if map[cell] == UNKNOWN {
                map[cell] = FREE;
                open.push_back(cell);
            }
        }
    }
}
