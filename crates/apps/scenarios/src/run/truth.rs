//! True motion of the robot: trajectory, clearance, collisions.

use periplus_evaluation::{StampedPose, Trajectory};
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_sim::{DriveScore, Simulation, wall_grid, wall_grid_around};

use crate::file::{EventAction, Scenario, planar_pose};

/// Time between two poses of the trajectory \[ns\].
const SAMPLE_PERIOD_NS: i64 = 10_000_000;

/// True motion of the robot so far.
pub(crate) struct Truth {
    info: GridInfo,
    score: Option<DriveScore>,
    poses: Vec<StampedPose>,
    next_ns: i64,
    length_m: f64,
    min_clearance_m: f64,
    collision_count: usize,
    model_count: usize,
}

/// True motion of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct TruthRecord {
    /// Poses of the robot in the world.
    pub(crate) trajectory: Trajectory,
    /// Distance driven \[m\].
    pub(crate) length_m: f64,
    /// Smallest distance between footprint and walls \[m\]; infinite without walls.
    pub(crate) min_clearance_m: f64,
    /// Number of times that the robot began to touch something that is not a floor.
    pub(crate) collision_count: usize,
    /// True if there is a robot.
    pub(crate) has_robot: bool,
}

impl Truth {
    pub(crate) fn new(simulation: &mut Simulation, info: GridInfo) -> Self {
        Self {
            score: DriveScore::new(simulation, info),
            info,
            poses: Vec::new(),
            next_ns: 0,
            length_m: 0.0,
            min_clearance_m: f64::INFINITY,
            collision_count: 0,
            model_count: simulation.models().count(),
        }
    }

    /// Takes a sample. Call it before each step. When a model has appeared or disappeared, or `has_changed`, the walls
    /// are looked for again.
    pub(crate) fn sample(&mut self, simulation: &mut Simulation, has_changed: bool) {
        let model_count = simulation.models().count();
        if has_changed || model_count != self.model_count {
            self.model_count = model_count;
            self.close_score();
            self.score = DriveScore::new(simulation, self.info);
        }
        if let Some(score) = &mut self.score {
            score.sample(simulation);
        }
        let now_ns = simulation.time_ns();
        if now_ns < self.next_ns {
            return;
        }
        self.next_ns = now_ns + SAMPLE_PERIOD_NS;
        if let Some(pose) = simulation.robot_pose() {
            self.poses.push(StampedPose { stamp_s: now_ns as f64 * 1e-9, pose });
        }
    }

    fn close_score(&mut self) {
        if let Some(score) = self.score.take() {
            self.length_m += score.length_m;
            self.min_clearance_m = self.min_clearance_m.min(score.min_clearance_m);
            self.collision_count += score.collisions.len();
        }
    }

    pub(crate) fn finish(mut self) -> TruthRecord {
        let has_robot = self.score.is_some();
        self.close_score();
        TruthRecord {
            trajectory: Trajectory::new(self.poses),
            length_m: self.length_m,
            min_clearance_m: self.min_clearance_m,
            collision_count: self.collision_count,
            has_robot,
        }
    }
}

/// Grid of the true map: the region of the scenario, or that around start, goals and other positions of the events.
pub(crate) fn grid_of(scenario: &Scenario) -> GridInfo {
    match scenario.params.region_m.as_slice() {
        &[low_x, low_y, high_x, high_y] if low_x < high_x && low_y < high_y => {
            wall_grid(low_x, low_y, high_x, high_y)
        }
        _ => {
            let mut poses: Vec<Pose2> = vec![scenario.start()];
            poses.extend(scenario.events.iter().filter_map(|event| match &event.action {
                EventAction::Goal(goal) => Some(planar_pose(&goal.pose)),
                EventAction::Teleport(teleport) => Some(planar_pose(&teleport.pose)),
                _ => None,
            }));
            let drive = scenario.drive.iter().flat_map(|script| &script.goals);
            poses.extend(drive.map(|goal| Pose2::new(goal.position_m[0], goal.position_m[1], 0.0)));
            wall_grid_around(&poses)
        }
    }
}
