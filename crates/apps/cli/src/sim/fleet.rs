//! Copies of a robot, spread over the free floor.

use std::sync::Arc;

use periplus_geometry::Pose2;
use periplus_sim::{AssetFiles, Composition, Options, Simulation, spread_poses, wall_grid};

use crate::error::CliError;

/// Room between two robots \[m\].
const GAP_M: f64 = 0.5;

/// Radius of a robot whose collisions define none \[m\].
const UNKNOWN_RADIUS_M: f64 = 0.3;

/// Smallest distance from the robot within which poses are searched \[m\].
const MIN_REACH_M: f64 = 10.0;

/// Finds poses for `count` robots on the floor that the last robot of a world can reach, the nearest first. The world is
/// used up.
///
/// # Errors
/// When it has no robot, or too little floor.
pub(super) fn places(mut world: Composition, count: usize) -> Result<Vec<Pose2>, CliError> {
    let files = Arc::new(AssetFiles::default());
    let mut simulation = Simulation::new(&mut world, files, Options::default());
    let start = simulation.robot_pose().map(Pose2::from);
    let start = start.ok_or_else(|| CliError::failed("`--robots` needs a robot that moves"))?;
    let radius_m = simulation.robot_radius_m().unwrap_or(UNKNOWN_RADIUS_M);
    let spacing_m = 2.0 * radius_m + GAP_M;
    // A square of floor for all of them, and twice that for obstacles.
    let reach_m = (2.0 * spacing_m * libm::sqrt(count as f64)).max(MIN_REACH_M);
    let (x_m, y_m) = (start.x_m, start.y_m);
    let grid = wall_grid(x_m - reach_m, y_m - reach_m, x_m + reach_m, y_m + reach_m);
    let map = simulation.truth_map(grid);
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
