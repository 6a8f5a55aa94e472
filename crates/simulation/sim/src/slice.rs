//! The world as a map could know it: a horizontal slice at the height of a lidar.

use std::collections::VecDeque;

use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_grid::occupancy::{FREE, OCCUPIED, UNKNOWN};
use periplus_grid::{Grid, Lattice, OccupancyGrid};
use periplus_raycast::{InstanceId, Ray};
use periplus_rendering::{RenderScene, SensedGeometry, filter};
use periplus_scene::{Model, SensorKind};

use crate::Simulation;
use crate::simulation::Running;

/// A point of a wall counts to the cell this far behind its surface \[m\]: walls stand on the edges of
/// cells more often than not.
const INTO_WALL_M: f64 = 1e-3;

/// A ray meets no more surfaces than this.
const MOST_SURFACES: usize = 1000;

/// Where there is no lidar, the slice is this high \[m\].
const USUAL_HEIGHT_M: f64 = 0.2;

/// A lidar on a robot.
struct Eye {
    height_m: f64,
    geometry: SensedGeometry,
}

impl Simulation {
    /// What is really there, on the cells of a map that lies like this in the world: walls are where
    /// a shape cuts the height of the first robot's lidar, free is what the robot could get to from
    /// where it is without crossing one, all else is unknown. The robot itself is no wall. None where
    /// there is no robot.
    pub fn truth_map(&mut self, lattice: Lattice) -> Option<OccupancyGrid> {
        let robot = self.robot()?;
        let (name, model) = (robot.member.name.clone(), robot.model);
        let eye = self.eye(robot);
        let world_from_robot = Pose2::from(self.motion.model_pose(model)?);
        let height_m = eye.height_m;
        let seen = self.views.at(eye.geometry, self.time_ns, &self.motion);
        let mut map = Grid::new(lattice, UNKNOWN);
        mark_walls(&mut map, seen, height_m, &name);
        let from = lattice.cell_of(world_from_robot.x_m, world_from_robot.y_m);
        if let Some(from) = from {
            flood(&mut map, from);
        }
        Some(map)
    }

    /// Where the first lidar of a robot is, and what it sees.
    fn eye(&self, robot: &Running) -> Eye {
        lidar(&robot.member.model, "")
            .and_then(|(link, eye)| {
                let link = self.motion.find_link(robot.model, &link)?;
                let world_from_link = self.motion.link_state(link)?.world_from_link;
                let place = world_from_link * eye.link_from_sensor;
                Some(Eye { height_m: place.translation.z, geometry: eye.geometry })
            })
            .unwrap_or(Eye { height_m: USUAL_HEIGHT_M, geometry: SensedGeometry::Collision })
    }
}

/// A lidar on a link.
struct Mounted {
    link_from_sensor: Pose,
    geometry: SensedGeometry,
}

/// The first lidar of a model, with the scoped name of its link; those of nested models come after.
fn lidar(model: &Model, scope: &str) -> Option<(String, Mounted)> {
    let own = model.links.iter().find_map(|link| {
        let is_lidar = |kind: &SensorKind| matches!(kind, SensorKind::Lidar(_));
        let sensor = link.sensors.iter().find(|sensor| is_lidar(&sensor.kind))?;
        // As in Gazebo: the graphics card renders what is seen, the others ask physics.
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

/// Marks what rays along all rows and columns of cells meet, two in each and in both directions, so
/// that no face is missed for being seen from its edge or from behind.
fn mark_walls(map: &mut OccupancyGrid, seen: &RenderScene, height_m: f64, robot: &str) {
    let lattice = map.lattice;
    let (columns, rows) = (lattice.width as f64, lattice.height as f64);
    for half in 0..2 * lattice.height {
        let row = half as f64 / 2.0 + 0.25;
        mark_line(map, seen, [(0.0, row), (columns, row)], height_m, robot);
    }
    for half in 0..2 * lattice.width {
        let column = half as f64 / 2.0 + 0.25;
        mark_line(map, seen, [(column, 0.0), (column, rows)], height_m, robot);
    }
}

/// Marks what a line between two places, in columns and rows, meets from either end.
fn mark_line(
    map: &mut OccupancyGrid,
    seen: &RenderScene,
    ends: [(f64, f64); 2],
    height_m: f64,
    robot: &str,
) {
    let place = |(column, row): (f64, f64)| {
        let (x_m, y_m) = map.lattice.point_at(column, row);
        DVec3::new(x_m, y_m, height_m)
    };
    let [first, last] = ends.map(place);
    let finder = map.lattice.finder();
    for (from, to) in [(first, last), (last, first)] {
        let length_m = (to - from).length();
        let mut ray = Ray { max_m: length_m, ..Ray::new(from, (to - from) / length_m) };
        // What the ray is in: the next surface of such a thing is its far side.
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
            if seen.surface(&hit).model != robot
                && let Some(cell) = finder.cell_of(at.x, at.y)
            {
                map[cell] = OCCUPIED;
            }
            ray.min_m = hit.distance_m + INTO_WALL_M;
        }
    }
}

/// Makes free what can be reached from a cell, over edges of cells.
fn flood(map: &mut OccupancyGrid, from: (usize, usize)) {
    let (width, height) = (map.lattice.width, map.lattice.height);
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
