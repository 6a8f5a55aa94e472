//! TrajectoryPlannerROS, the ancestor of DWA: forward trajectories first, then rotations in place, then sideways, then
//! backwards.
//!
//! Source: `trajectory_planner.cpp`, `trajectory_planner_ros.cpp` of `base_local_planner`.

use periplus_costmap::CostmapView;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2, normalize_angle};
use periplus_params::{ParamValue, ParamValues};

use super::rollout::Rollout;
use super::stop_rotate::{StopRotate, StopRotateLimits};
use super::wavefront::{WavefrontDistances, dense_plan_cells, filled};
use super::{TRAJECTORY_PLANNER, TrajectoryPlannerParams, critics::pose_cost};
use crate::dwb::critics::IllegalTrajectory;
use crate::dwb::{
    CellScores, CriticScore, LocalPlanEvaluation, SampledTrajectory, TrajectoryScore,
};
use crate::parameters::{ParameterChange, ParameterGroup, ParameterRefusal, store};
use crate::path::distance_m;
use crate::{ControlError, ControlInput, ControlReport, Controller, PathRules, PluginSetup};

/// Speed and turn rate at which a robot stands still at the goal \[m/s, rad/s\].
const STOPPED_M_S: f64 = 1e-2;

/// Velocity along x and y of the two diagonal trajectories of holonomic robots \[m/s\].
const DIAGONAL_M_S: f64 = 0.1;

/// Weight of the heading to the plan.
const HEADING_RATIO: f64 = 0.3;

/// Directions that were tried in place since the robot last moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct TriedDirections {
    /// Signs of rotations and of sideways motions in place.
    turned: [bool; 2],
    strafed: [bool; 2],
    /// Signs that are forbidden until the robot has moved.
    stuck_turn: [bool; 2],
    stuck_strafe: [bool; 2],
}

/// Index of a sign: 0 negative, 1 positive.
fn side(value: f64) -> usize {
    usize::from(value > 0.0)
}

/// The local planner TrajectoryPlannerROS.
#[derive(Clone, Debug)]
pub struct TrajectoryPlanner {
    values: ParamValues,
    params: TrajectoryPlannerParams,
    period_s: f64,
    stop_rotate: StopRotate,
    tried: TriedDirections,
    /// Pose at which the robot last moved in place.
    in_place_at: Pose2,
    /// Pose at which an escape began.
    escape_at: Option<Pose2>,
    evaluation: LocalPlanEvaluation,
}

/// Creates the planner from parameters of [`TRAJECTORY_PLANNER`].
pub(crate) fn create(
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    let values = setup.read(&TRAJECTORY_PLANNER, diagnostics);
    Some(Box::new(TrajectoryPlanner::new(values, setup.control_period_s)))
}

/// Inputs and distances of a cycle.
struct Scene<'a> {
    input: &'a ControlInput<'a>,
    view: CostmapView<'a>,
    path: WavefrontDistances,
    goal: WavefrontDistances,
    end: Pose2,
}

/// A trajectory with its cost.
#[derive(Clone, Debug)]
struct Scored {
    index: usize,
    command: Twist2,
    cost: f64,
    end: Pose2,
}

impl TrajectoryPlanner {
    /// Creates the planner from values of [`TRAJECTORY_PLANNER`] for a period of the control loop \[s\].
    #[must_use]
    pub fn new(values: ParamValues, period_s: f64) -> Self {
        Self {
            params: TrajectoryPlannerParams::from_values(&values),
            values,
            period_s,
            stop_rotate: StopRotate::default(),
            tried: TriedDirections::default(),
            in_place_at: Pose2::IDENTITY,
            escape_at: None,
            evaluation: LocalPlanEvaluation::default(),
        }
    }

    fn accelerations(&self) -> Twist2 {
        let params = &self.params;
        Twist2::new(params.acc_lim_x_m_s2, params.acc_lim_y_m_s2, params.acc_lim_theta_rad_s2)
    }

    fn stop_rotate_limits(&self) -> StopRotateLimits {
        let params = &self.params;
        StopRotateLimits {
            xy_tolerance_m: params.xy_goal_tolerance_m,
            yaw_tolerance_rad: params.yaw_goal_tolerance_rad,
            latches: params.latch_xy_goal_tolerance,
            stopped_m_s: STOPPED_M_S,
            stopped_rad_s: STOPPED_M_S,
            min_rate_rad_s: params.min_in_place_vel_theta_rad_s,
            max_rate_rad_s: params.max_rotational_vel_rad_s,
            accelerations: self.accelerations(),
            period_s: self.period_s,
        }
    }

    /// Returns the trajectory of a command.
    fn trajectory(&self, scene: &Scene<'_>, command: Twist2) -> SampledTrajectory {
        let params = &self.params;
        let steps = if params.heading_scoring {
            params.sim_time_s / params.sim_granularity_m
        } else {
            (command.speed_m_s() * params.sim_time_s / params.sim_granularity_m)
                .max(command.wz_rad_s.abs() / params.angular_sim_granularity_rad)
        };
        Rollout {
            start: scene.input.pose,
            present: scene.input.velocity,
            accelerations: Some(self.accelerations()),
            time_s: params.sim_time_s,
            count: (steps + 0.5) as usize,
        }
        .run(command)
    }

    /// Returns the scores of a trajectory: distance to the plan, to its end, cost of the footprint, and heading.
    fn scores(
        &self,
        scene: &Scene<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<[f64; 4], IllegalTrajectory> {
        let params = &self.params;
        let finder = scene.view.costs.finder();
        let step_s = params.sim_time_s / trajectory.poses.len() as f64;
        let heading_s = params.heading_scoring_timestep_s;
        let [mut path, mut goal, mut obstacle, mut heading] = [0.0_f64; 4];
        for (pose, time_s) in trajectory.poses.iter().zip(&trajectory.times_s) {
            obstacle = obstacle.max(f64::from(pose_cost(&scene.view, *pose)?));
            if params.simple_attractor {
                let away_m = distance_m(*pose, scene.end);
                goal = away_m * away_m;
                continue;
            }
            let Some(cell) = finder.cell_of(pose.x_m, pose.y_m) else { continue };
            if params.heading_scoring {
                if *time_s < heading_s || *time_s >= heading_s + step_s {
                    continue;
                }
                heading = heading_difference_rad(scene, *pose);
            }
            path = f64::from(scene.path.reachable(cell)?);
            goal = f64::from(scene.goal.reachable(cell)?);
        }
        Ok([path, goal, obstacle, heading])
    }

    /// Scores a command and records it in the evaluation; none if its trajectory is illegal.
    fn try_command(&mut self, scene: &Scene<'_>, command: Twist2) -> Option<Scored> {
        let trajectory = self.trajectory(scene, command);
        let result = self.scores(scene, &trajectory);
        let params = &self.params;
        let unit = if params.meter_scoring { scene.view.costs.resolution_m() } else { 1.0 };
        let heading_scale = if params.heading_scoring { HEADING_RATIO } else { 0.0 };
        let scales = [
            ("path_distance_bias", params.path_distance_bias * unit),
            ("goal_distance_bias", params.goal_distance_bias * unit),
            ("occdist_scale", params.occdist_scale),
            ("heading_scoring", heading_scale),
        ];
        let index = self.evaluation.twists.len();
        let end = trajectory.poses.last().copied().unwrap_or(scene.input.pose);
        let (scores, total, illegal) = match result {
            Ok(raw) => {
                let total = raw.iter().zip(scales).map(|(raw, (_, scale))| raw * scale).sum();
                let score = |(raw_score, (name, scale)): (f64, (&str, f64))| CriticScore {
                    name: name.into(),
                    raw_score,
                    scale,
                };
                (raw.into_iter().zip(scales).map(score).collect(), total, None)
            }
            Err(illegal) => {
                let name = "trajectory".into();
                (vec![CriticScore { name, raw_score: -1.0, scale: 0.0 }], -1.0, Some(illegal))
            }
        };
        let is_legal = illegal.is_none();
        self.evaluation.twists.push(TrajectoryScore { trajectory, scores, total, illegal });
        is_legal.then_some(Scored { index, command, cost: total, end })
    }

    /// Returns the ranges of velocities that can be reached, along x and around z.
    fn ranges(&self, scene: &Scene<'_>) -> ([f64; 2], [f64; 2]) {
        let params = &self.params;
        let goal_m = distance_m(scene.input.pose, scene.end);
        let time_s = if params.dwa { self.period_s } else { params.sim_time_s };
        let Twist2 { vx_m_s, wz_rad_s, .. } = scene.input.velocity;
        let (x_step, rate_step) =
            (params.acc_lim_x_m_s2 * time_s, params.acc_lim_theta_rad_s2 * time_s);
        let max_x = params.max_vel_x_m_s.min(goal_m / params.sim_time_s).min(vx_m_s + x_step);
        let x = [params.min_vel_x_m_s.max(vx_m_s - x_step), max_x.max(params.min_vel_x_m_s)];
        let rate = [
            params.min_vel_theta_rad_s.max(wz_rad_s - rate_step),
            params.max_vel_theta_rad_s.min(wz_rad_s + rate_step),
        ];
        (x, rate)
    }

    /// Returns the best trajectory that drives forwards.
    fn forward(&mut self, scene: &Scene<'_>, x: [f64; 2], rate: [f64; 2]) -> Option<Scored> {
        let (x_count, rate_count) = (self.params.vx_samples, self.params.vtheta_samples);
        let mut commands = Vec::new();
        for x_m_s in steps(x, x_count) {
            commands.push(Twist2::new(x_m_s, 0.0, 0.0));
            let rates = steps(rate, rate_count).take(rate_count.saturating_sub(1));
            commands.extend(rates.map(|rate| Twist2::new(x_m_s, 0.0, rate)));
        }
        if self.params.holonomic_robot {
            commands.push(Twist2::new(DIAGONAL_M_S, DIAGONAL_M_S, 0.0));
            commands.push(Twist2::new(DIAGONAL_M_S, -DIAGONAL_M_S, 0.0));
        }
        let mut best: Option<Scored> = None;
        for command in commands {
            let Some(found) = self.try_command(scene, command) else { continue };
            if best.as_ref().is_none_or(|best| found.cost < best.cost) {
                best = Some(found);
            }
        }
        best
    }

    /// Returns the distance to the goal of a point ahead of the end of a trajectory.
    fn ahead(&self, scene: &Scene<'_>, end: Pose2) -> Option<u32> {
        let (sine, cosine) = libm::sincos(end.yaw_rad);
        let ahead_m = self.params.heading_lookahead_m;
        let (x_m, y_m) = (end.x_m + ahead_m * cosine, end.y_m + ahead_m * sine);
        let cell = scene.view.costs.info().cell_of(x_m, y_m)?;
        Some(scene.goal.distance(cell))
    }

    /// Returns a rotation in place if it is at least as good as the best trajectory; among rotations the one that ends
    /// towards the goal.
    fn rotation(
        &mut self,
        scene: &Scene<'_>,
        rate: [f64; 2],
        best: Option<Scored>,
    ) -> (Option<Scored>, u32) {
        let min_rate = self.params.min_in_place_vel_theta_rad_s;
        let count = self.params.vtheta_samples;
        let step = (rate[1] - rate[0]) / count.saturating_sub(1).max(1) as f64;
        let (mut best, mut nearest) = (best, u32::MAX);
        for sample in steps(rate, count) {
            let limited = if sample > 0.0 { sample.max(min_rate) } else { sample.min(-min_rate) };
            let Some(found) = self.try_command(scene, Twist2::new(0.0, 0.0, limited)) else {
                continue;
            };
            let is_better = best
                .as_ref()
                .is_none_or(|best| found.cost <= best.cost || best.command.vy_m_s != 0.0);
            if !is_better || sample.abs() <= step || self.tried.stuck_turn[side(sample)] {
                continue;
            }
            if let Some(ahead) = self.ahead(scene, found.end).filter(|ahead| *ahead < nearest) {
                nearest = ahead;
                best = Some(found);
            }
        }
        (best, nearest)
    }

    /// Returns the best sideways motion.
    fn strafe(&mut self, scene: &Scene<'_>, mut nearest: u32) -> Option<Scored> {
        if !self.params.holonomic_robot {
            return None;
        }
        let mut best: Option<Scored> = None;
        for y_m_s in self.params.y_vels_m_s.clone() {
            let Some(found) = self.try_command(scene, Twist2::new(0.0, y_m_s, 0.0)) else {
                continue;
            };
            let is_better = best.as_ref().is_none_or(|best| found.cost <= best.cost);
            if !is_better || y_m_s == 0.0 || self.tried.stuck_strafe[side(y_m_s)] {
                continue;
            }
            if let Some(ahead) = self.ahead(scene, found.end).filter(|ahead| *ahead < nearest) {
                nearest = ahead;
                best = Some(found);
            }
        }
        best
    }

    /// Notes a motion in place, and forgets the tried directions once the robot has moved.
    fn note(&mut self, pose: Pose2, command: Twist2) {
        if command.vx_m_s <= 0.0 {
            let (flags, stuck, value) = if command.wz_rad_s != 0.0 {
                (&mut self.tried.turned, &mut self.tried.stuck_turn, command.wz_rad_s)
            } else {
                (&mut self.tried.strafed, &mut self.tried.stuck_strafe, command.vy_m_s)
            };
            if value != 0.0 {
                // The second motion with a sign forbids the other one.
                if flags[side(value)] {
                    stuck[1 - side(value)] = true;
                }
                flags[side(value)] = true;
            }
            self.in_place_at = pose;
        }
        self.note_distance(pose);
    }

    fn note_distance(&mut self, pose: Pose2) {
        let params = &self.params;
        if distance_m(pose, self.in_place_at) > params.oscillation_reset_dist_m {
            self.tried = TriedDirections::default();
        }
        let has_escaped = |from: Pose2| {
            let turned_rad = normalize_angle(pose.yaw_rad - from.yaw_rad).abs();
            distance_m(pose, from) > params.escape_reset_dist_m
                || turned_rad > params.escape_reset_theta_rad
        };
        if self.escape_at.is_some_and(has_escaped) {
            self.escape_at = None;
        }
    }

    /// Returns the best command of a cycle.
    fn best(&mut self, scene: &Scene<'_>) -> Result<Twist2, ControlError> {
        let pose = scene.input.pose;
        let (x, rate) = self.ranges(scene);
        let forward = if self.escape_at.is_none() { self.forward(scene, x, rate) } else { None };
        let (best, nearest) = self.rotation(scene, rate, forward);
        let best = best.or_else(|| self.strafe(scene, nearest));
        if let Some(best) = best {
            self.evaluation.best_index = Some(best.index);
            self.note(pose, best.command);
            return Ok(best.command);
        }
        // Backing up is allowed even where the footprint touches an obstacle, but not without a path.
        let command = Twist2::new(self.params.escape_vel_m_s, 0.0, 0.0);
        let index = self.evaluation.twists.len();
        self.try_command(scene, command);
        self.note_distance(pose);
        let illegal = self.evaluation.twists.last().and_then(|score| score.illegal);
        let has_no_path = illegal.is_some_and(|illegal| illegal.blocked.is_none());
        if has_no_path {
            let failure = self.evaluation.failure();
            return Err(ControlError::NoValidControl(format!(
                "The rollout planner failed to find a valid plan. {failure}"
            )));
        }
        self.escape_at.get_or_insert(pose);
        if illegal.is_none() {
            self.evaluation.best_index = Some(index);
        }
        Ok(command)
    }
}

/// Evenly spaced values of a range, from its start.
fn steps([min, max]: [f64; 2], count: usize) -> impl Iterator<Item = f64> {
    let count = count.max(1);
    let step = (max - min) / count.saturating_sub(1).max(1) as f64;
    (0..count).map(move |index| min + index as f64 * step)
}

/// Returns the difference of the heading to the farthest pose of the plan in line of sight \[rad\].
fn heading_difference_rad(scene: &Scene<'_>, pose: Pose2) -> f64 {
    let costs = scene.view.costs;
    let finder = costs.finder();
    let Some(from) = finder.cell_of(pose.x_m, pose.y_m) else { return f64::MAX };
    let in_sight = scene.input.plan.iter().rev().find_map(|target| {
        let cell = finder.cell_of(target.x_m, target.y_m)?;
        let mut line = periplus_grid::Line::between(from, cell);
        let is_free = line.all(|cell| costs.cost(cell).is_some_and(|cost| cost < 253));
        is_free.then(|| costs.info().centre_of(cell))
    });
    let Some((x_m, y_m)) = in_sight else { return f64::MAX };
    let bearing_rad = libm::atan2(y_m - pose.y_m, x_m - pose.x_m);
    normalize_angle(bearing_rad - pose.yaw_rad).abs()
}

/// Computes the distances of a cycle; cells within the robot are no obstacles.
fn scene<'a>(input: &'a ControlInput<'a>, end: Pose2) -> Scene<'a> {
    let costs = input.costmap.costs;
    let within = filled(costs, &input.costmap.footprint.placed(input.pose));
    let cells = dense_plan_cells(costs, input.plan);
    let path = WavefrontDistances::new(costs, &cells, |index| within[index]);
    let last = &cells[cells.len().saturating_sub(1)..];
    let goal = WavefrontDistances::new(costs, last, |_| false);
    Scene { input, view: input.costmap, path, goal, end }
}

impl Controller for TrajectoryPlanner {
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        let Some(end) = input.plan.last().copied() else {
            let text = "Received an empty transformed plan.".to_owned();
            return Err(ControlError::InvalidPath(text));
        };
        self.evaluation = LocalPlanEvaluation::default();
        let limits = self.stop_rotate_limits();
        if !self.stop_rotate.is_at_position(&limits, input.pose, end) {
            let scene = scene(input, end);
            let result = self.best(&scene);
            if self.params.publish_cost_grid_pc {
                self.evaluation.cell_scores = cell_scores(&scene);
            }
            return result;
        }
        let command = self.stop_rotate.velocity(&limits, input.pose, end, input.velocity);
        if command == Twist2::ZERO {
            return Ok(command);
        }
        let scene = scene(input, end);
        match self.try_command(&scene, command) {
            Some(found) => {
                self.evaluation.best_index = Some(found.index);
                Ok(command)
            }
            None => {
                let failure = self.evaluation.failure();
                Err(ControlError::NoValidControl(format!("Rotation cmd in collision. {failure}")))
            }
        }
    }

    fn set_plan(&mut self, _plan: &[Pose2]) {
        self.stop_rotate.reset();
    }

    /// Has no effect: ROS 1 has no speed limits.
    fn set_speed_limit(&mut self, _limit: f64, _is_percentage: bool) {}

    fn parameters(&self) -> Vec<ParameterGroup<'_>> {
        vec![ParameterGroup::own(&self.values)]
    }

    fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        store(&mut self.values, name, value)?;
        self.params = TrajectoryPlannerParams::from_values(&self.values);
        Ok(ParameterChange::Applied)
    }

    fn path_rules(&self) -> Option<PathRules> {
        Some(PathRules::MoveBase { prunes: self.params.prune_plan })
    }

    fn report(&self) -> ControlReport<'_> {
        ControlReport::Trajectories(&self.evaluation)
    }
}

/// Distances of cells to the plan and to its end.
fn cell_scores(scene: &Scene<'_>) -> Vec<CellScores> {
    let channel = |name: &str, distances: &WavefrontDistances| CellScores {
        name: name.to_owned(),
        scores: distances.distances().iter().map(|distance| *distance as f32).collect(),
    };
    vec![channel("path_cost", &scene.path), channel("goal_cost", &scene.goal)]
}
