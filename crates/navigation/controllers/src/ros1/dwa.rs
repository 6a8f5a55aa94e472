//! DWAPlannerROS.
//!
//! Source: `dwa_planner.cpp`, `dwa_planner_ros.cpp`, `simple_trajectory_generator.cpp`,
//! `simple_scored_sampling_planner.cpp`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2};
use periplus_params::{ParamValue, ParamValues};

use super::critics::{FootprintCost, PlanDistance};
use super::rollout::{Rollout, approach_command, spread};
use super::stop_rotate::{StopRotate, StopRotateLimits};
use super::{DWA_PLANNER, DwaPlannerParams};
use crate::dwb::critics::{
    CriticInput, MapGridTarget, NamedCritic, OscillationCritic, TrajectoryCritic, TwirlingCritic,
};
use crate::dwb::{
    CellScores, LocalPlanEvaluation, OSCILLATION_CRITIC, PLAIN_CRITIC, SampledTrajectory, evaluate,
};
use crate::parameters::{ParameterChange, ParameterGroup, ParameterRefusal, store};
use crate::path::distance_m;
use crate::{ControlError, ControlInput, ControlReport, Controller, PathRules, PluginSetup};

/// Difference of speeds that counts as none \[m/s or rad/s\]; the value of ROS.
const EQUAL_M_S: f64 = 1e-4;

/// The local planner DWAPlannerROS.
pub struct DwaPlanner {
    values: ParamValues,
    params: DwaPlannerParams,
    period_s: f64,
    critics: Vec<NamedCritic>,
    stop_rotate: StopRotate,
    evaluation: LocalPlanEvaluation,
}

/// Creates the planner from parameters of [`DWA_PLANNER`].
pub(crate) fn create(
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    let values = setup.read(&DWA_PLANNER, diagnostics);
    Some(Box::new(DwaPlanner::new(values, setup.control_period_s)))
}

impl DwaPlanner {
    /// Creates the planner from values of [`DWA_PLANNER`] for a period of the control loop \[s\].
    #[must_use]
    pub fn new(values: ParamValues, period_s: f64) -> Self {
        let params = DwaPlannerParams::from_values(&values);
        Self {
            critics: critics(&params),
            values,
            params,
            period_s,
            stop_rotate: StopRotate::default(),
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
            stopped_m_s: params.trans_stopped_vel_m_s,
            stopped_rad_s: params.theta_stopped_vel_rad_s,
            min_rate_rad_s: params.min_vel_theta_rad_s,
            max_rate_rad_s: params.max_vel_theta_rad_s,
            accelerations: self.accelerations(),
            period_s: self.period_s,
        }
    }

    /// Returns the velocities that are simulated; the turn rate varies fastest.
    fn samples(&self, present: Twist2, goal_m: f64) -> Vec<Twist2> {
        let params = &self.params;
        let (mut max_x, mut max_y) = (params.max_vel_x_m_s, params.max_vel_y_m_s);
        let time_s = if params.use_dwa { self.period_s } else { params.sim_time_s };
        if !params.use_dwa {
            // Without overshooting the goal.
            max_x = max_x.min(goal_m / time_s).max(params.min_vel_x_m_s);
            max_y = max_y.min(goal_m / time_s).max(params.min_vel_y_m_s);
        }
        let axis = |present: f64, min: f64, max: f64, acceleration: f64, count: usize| {
            let step = acceleration * time_s;
            spread((present - step).max(min), (present + step).min(max), count.max(1))
        };
        let max_rate = params.max_vel_theta_rad_s;
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = present;
        let xs =
            axis(vx_m_s, params.min_vel_x_m_s, max_x, params.acc_lim_x_m_s2, params.vx_samples);
        let ys =
            axis(vy_m_s, params.min_vel_y_m_s, max_y, params.acc_lim_y_m_s2, params.vy_samples);
        let acceleration = params.acc_lim_theta_rad_s2;
        let rates = axis(wz_rad_s, -max_rate, max_rate, acceleration, params.vth_samples);
        let mut samples = Vec::with_capacity(xs.len() * ys.len() * rates.len());
        for x in &xs {
            for y in &ys {
                samples.extend(rates.iter().map(|rate| Twist2::new(*x, *y, *rate)));
            }
        }
        samples
    }

    /// Returns the trajectory of a command; none if its speed is not allowed.
    fn trajectory(
        &self,
        start: Pose2,
        present: Twist2,
        command: Twist2,
    ) -> Option<SampledTrajectory> {
        let params = &self.params;
        let (speed_m_s, rate_rad_s) = (command.speed_m_s(), command.wz_rad_s.abs());
        let is_too_slow = params.min_vel_trans_m_s >= 0.0
            && speed_m_s + EQUAL_M_S < params.min_vel_trans_m_s
            && params.min_vel_theta_rad_s >= 0.0
            && rate_rad_s + EQUAL_M_S < params.min_vel_theta_rad_s;
        let is_too_fast =
            params.max_vel_trans_m_s >= 0.0 && speed_m_s - EQUAL_M_S > params.max_vel_trans_m_s;
        let steps = (speed_m_s * params.sim_time_s / params.sim_granularity_m)
            .max(rate_rad_s * params.sim_time_s / params.angular_sim_granularity_rad);
        let count = libm::ceil(steps) as usize;
        if is_too_slow || is_too_fast || count == 0 {
            return None;
        }
        let accelerations = (!params.use_dwa).then(|| self.accelerations());
        let rollout = Rollout { start, present, accelerations, time_s: params.sim_time_s, count };
        let mut trajectory = rollout.run(command);
        if let Some(accelerations) = accelerations {
            // The velocity of the first step is commanded.
            let step_s = params.sim_time_s / count as f64;
            trajectory.velocity = approach_command(present, command, accelerations, step_s);
        }
        Some(trajectory)
    }

    fn best(&mut self, input: &CriticInput<'_>) -> Result<Twist2, ControlError> {
        let goal_m = input.plan.last().map_or(0.0, |end| distance_m(input.pose, *end));
        let samples = self.samples(input.velocity, goal_m);
        let trajectories = samples
            .into_iter()
            .filter_map(|command| self.trajectory(input.pose, input.velocity, command));
        let mut evaluation = evaluate(&self.critics, input, trajectories, true);
        if self.params.publish_cost_grid_pc {
            evaluation.cell_scores = cell_scores(&self.critics, input);
        }
        self.evaluation = evaluation;
        let command = self.evaluation.best().map(|best| best.trajectory.velocity);
        if let Some(command) = command {
            for critic in &mut self.critics {
                critic.critic.debrief(command);
            }
        }
        command.ok_or_else(|| {
            let failure = self.evaluation.failure();
            ControlError::NoValidControl(format!("DWA planner failed to produce path. {failure}"))
        })
    }

    /// Checks a command at the goal by all critics.
    fn check(&mut self, input: &CriticInput<'_>, command: Twist2) -> Result<Twist2, ControlError> {
        for critic in &mut self.critics {
            critic.critic.reset();
        }
        let trajectory = self.trajectory(input.pose, input.velocity, command);
        let Some(trajectory) = trajectory else { return Ok(command) };
        self.evaluation = evaluate(&self.critics, input, std::iter::once(trajectory), false);
        if self.evaluation.best_index.is_some() {
            return Ok(command);
        }
        let failure = self.evaluation.failure();
        Err(ControlError::NoValidControl(format!("Rotation cmd in collision. {failure}")))
    }
}

/// Cost functions in the order of their evaluation.
fn critics(params: &DwaPlannerParams) -> Vec<NamedCritic> {
    let named = |name: &str, critic: Box<dyn TrajectoryCritic>| NamedCritic {
        name: name.into(),
        values: ParamValues::defaults(&PLAIN_CRITIC),
        critic,
    };
    let distance =
        |target| -> Box<dyn TrajectoryCritic> { Box::new(PlanDistance::new(params, target)) };
    let mut oscillation = ParamValues::defaults(&OSCILLATION_CRITIC);
    for (name, number) in [
        ("oscillation_reset_dist", params.oscillation_reset_dist_m),
        ("oscillation_reset_angle", params.oscillation_reset_angle_rad),
        ("x_only_threshold", params.min_vel_trans_m_s),
    ] {
        oscillation.set(name, ParamValue::Number(number));
    }
    let mut twirling = ParamValues::defaults(&PLAIN_CRITIC);
    twirling.set("scale", ParamValue::Number(params.twirling_scale));
    vec![
        named("oscillation", Box::new(OscillationCritic::new(&oscillation))),
        named("obstacle", Box::new(FootprintCost { params: params.clone() })),
        named("goal_front", distance(MapGridTarget::GoalAhead)),
        named("alignment", distance(MapGridTarget::PathAhead)),
        named("path", distance(MapGridTarget::Path)),
        named("goal", distance(MapGridTarget::Goal)),
        named("twirling", Box::new(TwirlingCritic::new(&twirling))),
    ]
}

/// Scores of cells by obstacles, plan and goal, and their scaled sum.
fn cell_scores(critics: &[NamedCritic], input: &CriticInput<'_>) -> Vec<CellScores> {
    let mut channels = Vec::new();
    let mut totals = vec![0.0_f32; input.costmap.costs.info().len()];
    for NamedCritic { name, critic, .. } in critics {
        let Some(scores) = critic.cell_scores(input) else { continue };
        let scale = critic.scale(input) as f32;
        for (total, score) in totals.iter_mut().zip(&scores) {
            *total += score * scale;
        }
        channels.push(CellScores { name: format!("{name}_cost"), scores });
    }
    channels.push(CellScores { name: "total_cost".to_owned(), scores: totals });
    channels
}

impl Controller for DwaPlanner {
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        if input.plan.is_empty() {
            let text = "Received an empty transformed plan.".to_owned();
            return Err(ControlError::InvalidPath(text));
        }
        let critic_input = CriticInput {
            time_ns: input.time_ns,
            pose: input.pose,
            velocity: input.velocity,
            goal: input.goal,
            plan: input.plan,
            costmap: input.costmap,
        };
        for critic in &mut self.critics {
            critic.critic.prepare(&critic_input);
        }
        let limits = self.stop_rotate_limits();
        if !self.stop_rotate.is_at_position(&limits, input.pose, input.goal) {
            return self.best(&critic_input);
        }
        let command = self.stop_rotate.velocity(&limits, input.pose, input.goal, input.velocity);
        self.check(&critic_input, command)
    }

    fn set_plan(&mut self, _plan: &[Pose2]) {
        self.stop_rotate.reset();
        for critic in &mut self.critics {
            critic.critic.reset();
        }
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
        self.params = DwaPlannerParams::from_values(&self.values);
        self.critics = critics(&self.params);
        Ok(ParameterChange::Applied)
    }

    fn path_rules(&self) -> Option<PathRules> {
        Some(PathRules::MoveBase { prunes: self.params.prune_plan })
    }

    fn report(&self) -> ControlReport<'_> {
        ControlReport::Trajectories(&self.evaluation)
    }
}
