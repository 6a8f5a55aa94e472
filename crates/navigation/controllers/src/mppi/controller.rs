//! The controller: inputs of a cycle to a command, and results for publication.

use std::cell::OnceCell;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Twist2;
use periplus_params::{Given, ParamValue, ParamValues};

use super::config::{MppiConfig, MppiSetup};
use super::context::CriticContext;
use super::critics::CriticKind;
use super::explain::{CycleFacts, explain_failure, explain_speed};
use super::lane_math::{atan2, normalize_angle};
use super::optimizer::Optimizer;
use super::params::{AckermannParams, PathFollowParams, VisualizerParams};
use super::rollout::Start;
use super::sequence::{ControlSequence, MppiControl};
use super::stall::{Stall, StallWatch, seed};
use super::statistics::{CandidateTrajectory, CriticStatistics, MppiTrajectoryPoint};
use super::surroundings::Surroundings;
use crate::{
    ControlError, ControlInput, ControlReport, Controller, ParameterChange, ParameterGroup,
    ParameterRefusal, PathRules, SamplingReport,
};

/// Distance ahead on the path at which its direction is compared with the heading, in points.
const LOOK_AHEAD_POINTS: usize = 8;

/// Model predictive path integral controller (`nav2_mppi_controller::MPPIController`).
#[derive(Clone, Debug)]
pub struct Mppi {
    config: MppiConfig,
    optimizer: Optimizer,
    surroundings: Surroundings,
    facts: Option<CycleFacts>,
    last_time_ns: Option<i64>,
    has_speed_limit: bool,
    stall: StallWatch,
    /// Number of threads; none for one for each processor.
    threads: Option<usize>,
}

/// Creates a controller from the parameters of the controller server. Returns none if Nav2 would not start
/// with them; the diagnostics contain the reason.
pub fn create<'a>(
    setup: &MppiSetup<'_>,
    given: impl IntoIterator<Item = Given<'a>>,
    diagnostics: &mut Diagnostics,
) -> Option<Mppi> {
    let config = MppiConfig::read(setup, given, diagnostics)?;
    super::advice::advise(&config, setup.group, diagnostics);
    Some(Mppi::new(config))
}

impl Mppi {
    /// Creates a controller.
    #[must_use]
    pub fn new(config: MppiConfig) -> Self {
        Self {
            optimizer: Optimizer::new(&config),
            surroundings: Surroundings::default(),
            facts: None,
            last_time_ns: None,
            has_speed_limit: false,
            stall: StallWatch::default(),
            threads: None,
            config,
        }
    }

    /// Sets the number of threads: with two or more, another thread draws the noise of the next cycle (default:
    /// one for each processor). Results do not depend on it.
    pub fn set_threads(&mut self, threads: usize) {
        self.threads = Some(threads);
        self.optimizer.set_threads(threads);
    }

    /// Returns the configuration.
    #[must_use]
    pub fn config(&self) -> &MppiConfig {
        &self.config
    }

    /// Returns the parameters, with those of the critics in groups.
    #[must_use]
    pub fn values(&self) -> &ParamValues {
        &self.config.values
    }

    /// Changes a parameter, named as within the group of the controller, such as `vx_max` or
    /// `CostCritic.cost_weight`. The optimizer starts again from rest, without a speed limit.
    ///
    /// # Errors
    /// The reason for a refusal: the name is unknown, the value does not fit, the parameter is fixed
    /// (`critics`, `motion_model`, `plugin`), or a speed limit is active (main: `vx_max`, `vx_min`, `vy_max`,
    /// `wz_max`).
    pub fn set_parameter(&mut self, name: &str, value: ParamValue) -> Result<(), ParameterRefusal> {
        const FIXED: [&str; 3] = ["critics", "motion_model", "plugin"];
        const KINEMATIC: [&str; 4] = ["vx_max", "vx_min", "vy_max", "wz_max"];
        let Some(parameter) = self.config.values.find(name) else {
            return Err(ParameterRefusal::Unknown(name.to_owned()));
        };
        if FIXED.contains(&parameter.name) {
            return Err(ParameterRefusal::Conflict(format!(
                "`{name}` is read at the start only; restart the controller server"
            )));
        }
        let is_guarded = self.config.release == Nav2Release::Main && KINEMATIC.contains(&name);
        if is_guarded && self.has_speed_limit {
            return Err(ParameterRefusal::Conflict(format!(
                "Rejected dynamic update to '{name}': speed limit is active. Clear the speed limit first."
            )));
        }
        let value = value
            .fit(parameter)
            .map_err(|error| ParameterRefusal::Unfit { name: name.to_owned(), error })?;
        self.config.values.set(name, value);
        if let super::MppiModel::Ackermann { min_turning_radius_m, samples_curvatures } =
            &mut self.config.model
            && let Some(steering) = self.config.values.group(&self.config.model_group)
        {
            let steering = AckermannParams::from_values(steering);
            *min_turning_radius_m = steering.min_turning_radius_m as f32;
            *samples_curvatures = steering.samples_curvatures;
        }
        self.has_speed_limit = false;
        self.optimizer = Optimizer::new(&self.config);
        if let Some(threads) = self.threads {
            self.optimizer.set_threads(threads);
        }
        Ok(())
    }

    /// Returns every `trajectory_step`-th sample of the last cycle with every `time_step`-th pose, as
    /// `TrajectoryVisualizer` publishes them. The cost is that of the critic in `critic_index_to_visualize`.
    #[must_use]
    pub fn candidates(&self) -> Vec<CandidateTrajectory> {
        let visualizer = self.config.values.group("TrajectoryVisualizer");
        let VisualizerParams { trajectory_step, time_step } =
            visualizer.map(VisualizerParams::from_values).unwrap_or_default();
        let (samples, evaluation) = (&self.optimizer.samples, &self.optimizer.evaluation);
        let critic = usize::try_from(self.config.params().critic_index_to_visualize - 1).ok();
        let of_critic = critic.and_then(|index| self.optimizer.critic_costs.get(index));
        let costs = of_critic.unwrap_or(&evaluation.costs).as_flattened();
        let collisions = evaluation.collisions.as_flattened();
        let count = samples.count.min(costs.len());
        let free = || (0..count).filter(|sample| !collisions[*sample]).map(|sample| costs[sample]);
        let (mut lowest, mut highest) = range(free());
        if lowest > highest {
            (lowest, highest) = range(costs[..count].iter().copied());
        }
        let width = highest - lowest;
        let candidate = |sample: usize| CandidateTrajectory {
            sample,
            poses: (0..samples.steps)
                .step_by(time_step)
                .map(|step| {
                    self.surroundings.pose([
                        samples.x.at(sample, step),
                        samples.y.at(sample, step),
                        samples.yaw.at(sample, step),
                    ])
                })
                .collect(),
            cost: costs[sample],
            relative_cost: if width > 0.0 { (costs[sample] - lowest) / width } else { 0.0 },
            collides: collisions[sample],
        };
        (0..count).step_by(trajectory_step).map(candidate).collect()
    }

    /// Returns the optimal trajectory of the last cycle.
    #[must_use]
    pub fn optimal_trajectory(&self) -> Vec<MppiTrajectoryPoint> {
        let step_s = self.config.params().model_dt_s;
        let point = |(step, pose): (usize, &[f32; 3])| MppiTrajectoryPoint {
            time_s: step as f64 * step_s,
            pose: self.surroundings.pose(*pose),
            velocity: twist(self.optimizer.optimal_sequence.at(step)),
        };
        self.optimizer.optimal.iter().enumerate().map(point).collect()
    }

    /// Returns the statistics of the critics in the last optimization.
    #[must_use]
    pub fn statistics(&self) -> &[CriticStatistics] {
        &self.optimizer.statistics
    }

    /// Returns the control sequence of the next cycle.
    #[must_use]
    pub fn sequence(&self) -> &ControlSequence {
        &self.optimizer.sequence
    }

    /// Returns the share of the samples that touched an obstacle in the last cycle.
    #[must_use]
    pub fn collision_ratio(&self) -> f64 {
        let count = self.optimizer.samples.count;
        self.optimizer.evaluation.colliding(count) as f64 / count.max(1) as f64
    }

    /// Returns the reason for a low speed in the last cycle, such as a speed limit, obstacles, or parameters
    /// that bound each other; none if the robot drives about as fast as it may.
    #[must_use]
    pub fn explain_speed(&self) -> Option<String> {
        explain_speed(self.facts.as_ref()?, &self.surroundings.grid)
    }

    fn check_input(input: &ControlInput<'_>) -> Result<(), ControlError> {
        if input.plan.is_empty() {
            return Err(ControlError::InvalidPath("the plan has no poses".to_owned()));
        }
        if !input.plan.iter().all(|pose| pose.is_finite()) {
            return Err(ControlError::InvalidPath(
                "the plan has a pose that is not finite".to_owned(),
            ));
        }
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = input.velocity;
        if !input.pose.is_finite() || ![vx_m_s, vy_m_s, wz_rad_s].iter().all(|it| it.is_finite()) {
            return Err(ControlError::NoValidControl(
                "the pose or the velocity of the robot is not finite: check the odometry"
                    .to_owned(),
            ));
        }
        Ok(())
    }

    /// Humble forgets its sequence after a pause.
    fn reset_after_pause(&mut self, time_ns: i64) {
        let last_ns = self.last_time_ns.replace(time_ns).unwrap_or(time_ns);
        let pause_s = time_ns.saturating_sub(last_ns) as f64 * 1e-9;
        if self.config.release == Nav2Release::Humble
            && pause_s > self.config.params().reset_period_s
        {
            self.reset();
        }
    }

    fn facts(&self, context: &CriticContext<'_>, command: MppiControl) -> CycleFacts {
        let settings = &self.optimizer.settings;
        let path = context.path;
        let along = |index: usize| path.travelled[index.min(path.last())];
        let furthest = context.furthest.get().copied();
        let offset = self.config.critics.contains(&CriticKind::PathFollow).then(|| {
            PathFollowParams::from_values(&self.config.critic(CriticKind::PathFollow)).offset_points
        });
        let [x, y, _] = path.pose(LOOK_AHEAD_POINTS);
        let (dx, dy) = (x - context.start.x, y - context.start.y);
        CycleFacts {
            start: context.start,
            command_vx: command.vx,
            command_speed: super::critics::length(command.vx, command.vy),
            samples: self.optimizer.samples.count,
            colliding: self.optimizer.evaluation.colliding(self.optimizer.samples.count),
            blocked: context.valid().iter().position(|is_valid| !is_valid).map(along),
            follow_aim: furthest.zip(offset).map(|(furthest, offset)| along(furthest + offset)),
            path_length: path.length,
            path_turn_rad: normalize_angle(atan2(dy, dx) - context.start.yaw).abs(),
            horizon_s: settings.step_s * settings.steps as f32,
            acceleration: settings.acceleration.ax_max,
            period_s: self.config.period_s as f32,
            base: settings.velocity,
            limits: self.optimizer.limits,
            vx_std: settings.scale.vx,
        }
    }
}

impl Controller for Mppi {
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        Self::check_input(input)?;
        self.reset_after_pause(input.time_ns);
        self.surroundings.copy(input);
        let [x, y, yaw] = self.surroundings.near(input.pose);
        let speed = self.optimizer.start_speed(control(input.velocity));
        let start = Start { x, y, yaw, speed };
        let stall = self.stall.look(input);
        if stall == Stall::Begins {
            let [goal_x, goal_y, _] = self.surroundings.near(input.goal);
            let (dx, dy) = (goal_x - x, goal_y - y);
            let (bearing, distance) =
                (normalize_angle(atan2(dy, dx) - yaw), super::critics::length(dx, dy));
            let step_s = self.optimizer.settings.step_s;
            let limits = self.optimizer.limits;
            seed(&mut self.optimizer.sequence, bearing, distance, &limits, step_s);
        }
        // The context refers to the surroundings while the optimizer changes.
        let surroundings = std::mem::take(&mut self.surroundings);
        let context = CriticContext {
            release: self.config.release,
            model: self.config.model,
            step_s: self.optimizer.settings.step_s,
            start,
            path: &surroundings.path,
            goal: surroundings.near(input.goal),
            ignores_goal_heading: stall != Stall::None,
            goal_tolerance: input.tolerance.xy_m.map(|tolerance_m| tolerance_m as f32),
            grid: &surroundings.grid,
            path_length: surroundings.path.length,
            furthest: OnceCell::new(),
            valid: OnceCell::new(),
        };
        let result = self.optimizer.run(&context);
        let result = match result {
            Ok(command) => {
                self.facts = Some(self.facts(&context, command));
                Ok(twist(command))
            }
            Err(failure) => {
                self.facts = None;
                let settings = &self.optimizer.settings;
                let (samples, step_s) = (settings.samples, settings.step_s);
                let grid = &surroundings.grid;
                Err(ControlError::NoValidControl(explain_failure(
                    failure, samples, step_s, grid, &start, input.pose,
                )))
            }
        };
        self.surroundings = surroundings;
        result
    }

    fn set_plan(&mut self, _plan: &[periplus_geometry::Pose2]) {}

    fn set_speed_limit(&mut self, limit: f64, is_percentage: bool) {
        let base = self.optimizer.settings.velocity;
        self.optimizer.limits = base.limited(limit, is_percentage);
        self.has_speed_limit = self.optimizer.limits != base;
    }

    fn reset(&mut self) {
        self.optimizer.reset();
        self.stall = StallWatch::default();
        self.facts = None;
        if self.config.release == Nav2Release::Humble {
            self.set_speed_limit(0.0, false);
        }
    }

    fn parameters(&self) -> Vec<ParameterGroup<'_>> {
        self.groups()
    }

    fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        self.set_parameter(name, value).map(|()| ParameterChange::Applied)
    }

    fn path_rules(&self) -> Option<PathRules> {
        self.own_path_rules()
    }

    fn report(&self) -> ControlReport<'_> {
        ControlReport::Samples(SamplingReport(self))
    }
}

/// Lowest and highest of some numbers.
fn range(numbers: impl Iterator<Item = f32>) -> (f32, f32) {
    numbers.fold((f32::INFINITY, f32::NEG_INFINITY), |(lowest, highest), number| {
        (lowest.min(number), highest.max(number))
    })
}

fn control(twist: Twist2) -> MppiControl {
    MppiControl { vx: twist.vx_m_s as f32, vy: twist.vy_m_s as f32, wz: twist.wz_rad_s as f32 }
}

fn twist(control: MppiControl) -> Twist2 {
    Twist2::new(f64::from(control.vx), f64::from(control.vy), f64::from(control.wz))
}
