//! Copies of a robot, spread over the free floor.

use std::f64::consts::PI;
use std::sync::Arc;

use periplus_geometry::{Pose2, Stream};
use periplus_grid::OccupancyGrid;
use periplus_sim::{
    AssetFiles, Composition, Options, Simulation, reachable_cells, spread_poses, wall_grid,
};

use crate::error::CliError;

/// Room between two robots \[m\].
const GAP_M: f64 = 0.5;

/// Radius of a robot whose collisions define none \[m\].
const UNKNOWN_RADIUS_M: f64 = 0.3;

/// Number of positions that are drawn for each robot until there is no room.
const TRIES_PER_ROBOT_COUNT: usize = 200;

/// Smallest distance from the robot within which poses are searched \[m\].
const MIN_REACH_M: f64 = 10.0;

/// Robot of which there are copies, and the simulation of its world.
struct Original {
    simulation: Simulation,
    start: Pose2,
    radius_m: f64,
}

impl Original {
    /// The last robot of a world, which is used up.
    fn of(world: &mut Composition) -> Result<Self, CliError> {
        let files = Arc::new(AssetFiles::default());
        let simulation = Simulation::new(world, files, Options::default());
        let start = simulation.robot_pose().map(Pose2::from);
        let start = start.ok_or_else(|| CliError::failed("`--robots` needs a robot that moves"))?;
        let radius_m = simulation.robot_radius_m().unwrap_or(UNKNOWN_RADIUS_M);
        Ok(Self { simulation, start, radius_m })
    }

    fn spacing_m(&self) -> f64 {
        2.0 * self.radius_m + GAP_M
    }
}

/// Finds poses for `count` robots on the floor that the last robot of a world can reach, the nearest first. The world is
/// used up.
///
/// # Errors
/// When it has no robot, or too little floor.
pub(super) fn places(mut world: Composition, count: usize) -> Result<Vec<Pose2>, CliError> {
    let mut original = Original::of(&mut world)?;
    let (start, radius_m, spacing_m) = (original.start, original.radius_m, original.spacing_m());
    // A square of floor for all of them, and twice that for obstacles.
    let reach_m = (2.0 * spacing_m * libm::sqrt(count as f64)).max(MIN_REACH_M);
    let (x_m, y_m) = (start.x_m, start.y_m);
    let grid = wall_grid(x_m - reach_m, y_m - reach_m, x_m + reach_m, y_m + reach_m);
    let map = original.simulation.truth_map(grid);
    let poses =
        map.map_or_else(Vec::new, |map| spread_poses(&map, start, radius_m, spacing_m, count));
    if poses.len() < count {
        return Err(CliError::failed(format!(
            "{} robots of {radius_m:.2} m have room within {reach_m:.0} m of the start, and `--robots {count}` asks for \
             more: use a larger world, or another `--pose`",
            poses.len()
        )));
    }
    Ok(poses)
}

/// Draws poses for `count` robots all over a map in the frame of the world, where the last robot of the world can drive
/// to. The world is used up.
///
/// # Errors
/// When it has no robot, or the map has too little floor.
pub(crate) fn drawn_places(
    mut world: Composition,
    map: &OccupancyGrid,
    count: usize,
    seed: u64,
) -> Result<Vec<Pose2>, CliError> {
    let original = Original::of(&mut world)?;
    let spacing_m = original.spacing_m();
    let cells = reachable_cells(map, original.start, original.radius_m);
    let mut poses: Vec<Pose2> = Vec::new();
    let tries = if cells.is_empty() { 0 } else { count.saturating_mul(TRIES_PER_ROBOT_COUNT) };
    for number in 0..tries as u64 {
        if poses.len() == count {
            break;
        }
        let mut stream = Stream::keyed(seed, "starts of robots", number);
        let index = (stream.unit() * cells.len() as f64) as usize;
        let (x_m, y_m) = map.info.centre_of(cells[index.min(cells.len() - 1)]);
        let yaw_rad = (2.0 * stream.unit() - 1.0) * PI;
        let is_near = |pose: &Pose2| libm::hypot(pose.x_m - x_m, pose.y_m - y_m) < spacing_m;
        if !poses.iter().any(is_near) {
            poses.push(Pose2::new(x_m, y_m, yaw_rad));
        }
    }
    if poses.len() < count {
        return Err(CliError::failed(format!(
            "{} robots of {:.2} m have room on the map where the robot at its `--pose` can drive to, and `--robots \
             {count}` asks for more: use a larger map, or another `--pose`",
            poses.len(),
            original.radius_m
        )));
    }
    Ok(poses)
}
