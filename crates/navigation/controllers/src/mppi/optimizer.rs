//! Optimizer: samples controls, scores them and improves the sequence.
//!
//! Source: `nav2_mppi_controller/src/optimizer.cpp`.
//!
//! One difference to Nav2: an attempt after a collision of all samples scores its samples again. In Nav2 the
//! flag of the failure stays set, so that further attempts fail without a test.

use std::num::NonZero;

use periplus_costmap::Nav2Release;

use super::config::MppiConfig;
use super::context::{CriticContext, Evaluation};
use super::critics::{Critic, CriticKind, CriticLimits};
use super::filter::{ControlHistory, smooth};
use super::lanes::Row;
use super::limits::{Changes, MppiAccelerationLimits, MppiVelocityLimits};
use super::noise_thread::{NoiseKey, NoiseThread};
use super::params::{MppiParams, ValidatorParams};
use super::rollout::{Delays, Motion, NoiseScale, add_sequence, draw_noise, predict, trajectory};
use super::samples::Samples;
use super::sequence::{ControlSequence, MppiControl, SequenceLimits};
use super::statistics::CriticStatistics;
use super::update::{UpdateSettings, update};
use super::validator::ValidatorSettings;

/// Settings of the optimizer, from the parameters.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OptimizerSettings {
    pub(crate) samples: usize,
    pub(crate) steps: usize,
    pub(crate) step_s: f32,
    pub(crate) iterations: usize,
    pub(crate) retries: usize,
    pub(crate) velocity: MppiVelocityLimits,
    pub(crate) acceleration: MppiAccelerationLimits,
    pub(crate) scale: NoiseScale,
    temperature: f32,
    gamma: f32,
    smoothing_order: i64,
    delays_s: [f64; 3],
    limits_controls: bool,
    regenerates: bool,
    is_open_loop: bool,
    period_s: f32,
    shifts: bool,
    validator: Option<ValidatorSettings>,
    seed: u64,
}

impl OptimizerSettings {
    pub(crate) fn new(config: &MppiConfig) -> Self {
        let params: MppiParams = config.params();
        let is_main = config.release == Nav2Release::Main;
        let step_s = params.model_dt_s as f32;
        let validator =
            config.values.group("TrajectoryValidator").map(ValidatorParams::from_values);
        let delays_s = [params.delay_vx_s, params.delay_vy_s, params.delay_wz_s];
        Self {
            samples: params.batch_size,
            steps: params.time_steps,
            step_s,
            iterations: params.iteration_count,
            retries: params.retry_attempt_limit,
            velocity: MppiVelocityLimits {
                vx_max: params.vx_max_m_s as f32,
                vx_min: params.vx_min_m_s as f32,
                vy_max: params.vy_max_m_s as f32,
                wz_max: params.wz_max_rad_s as f32,
            },
            // Wrong signs are corrected as in Nav2.
            acceleration: MppiAccelerationLimits {
                ax_max: params.ax_max_m_s2.abs() as f32,
                ax_min: -params.ax_min_m_s2.abs() as f32,
                ay_max: params.ay_max_m_s2 as f32,
                ay_min: -params.ay_min_m_s2.abs() as f32,
                az_max: params.az_max_rad_s2 as f32,
            },
            scale: NoiseScale {
                vx: params.vx_std_m_s as f32,
                vy: params.vy_std_m_s as f32,
                wz: params.wz_std_rad_s as f32,
            },
            temperature: params.temperature as f32,
            gamma: params.gamma as f32,
            smoothing_order: if is_main { params.smoothing_order } else { 2 },
            delays_s: if is_main { delays_s } else { [0.0; 3] },
            limits_controls: if is_main {
                params.clamp_raw_controls
            } else {
                config.release != Nav2Release::Humble
            },
            regenerates: params.regenerate_noises,
            is_open_loop: params.is_open_loop && config.release != Nav2Release::Humble,
            period_s: config.period_s as f32,
            shifts: config.shifts(),
            validator: validator.map(|params| ValidatorSettings::new(&params, step_s)),
            seed: config.seed,
        }
    }
}

/// Reason why an attempt failed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum AttemptFailure {
    /// All samples touch an obstacle.
    AllCollide,
    /// The optimal trajectory enters an obstacle at a step.
    TrajectoryCollides(usize),
    /// The sequence is not finite.
    NotFinite,
}

/// Optimizer with its state between cycles.
#[derive(Clone, Debug)]
pub(crate) struct Optimizer {
    pub(crate) settings: OptimizerSettings,
    release: Nav2Release,
    model: super::limits::MppiModel,
    critics: Vec<(CriticKind, Critic)>,
    /// Limits of the velocity under the speed limit.
    pub(crate) limits: MppiVelocityLimits,
    pub(crate) sequence: ControlSequence,
    history: ControlHistory,
    delays: Delays,
    pub(crate) samples: Samples,
    /// Noise that is used again; none while it is drawn in each cycle.
    pool: Option<Samples>,
    pub(crate) evaluation: Evaluation,
    weights: Vec<Row>,
    /// Number of the next draw of noise.
    draw: u64,
    noise_thread: NoiseThread,
    pub(crate) last_command: MppiControl,
    /// Poses that follow from the sequence.
    pub(crate) optimal: Vec<[f32; 3]>,
    /// Sequence of the optimal trajectory.
    pub(crate) optimal_sequence: ControlSequence,
    pub(crate) statistics: Vec<CriticStatistics>,
    /// Costs added by each critic; filled if `keeps_costs`.
    pub(crate) critic_costs: Vec<Vec<Row>>,
    pub(crate) keeps_costs: bool,
}

impl Optimizer {
    pub(crate) fn new(config: &MppiConfig) -> Self {
        let settings = OptimizerSettings::new(config);
        let MppiVelocityLimits { vx_max, vx_min, vy_max, .. } = settings.velocity;
        let limits = CriticLimits { vx_max, vx_min, vy_max };
        let critic = |kind: &CriticKind| {
            (*kind, Critic::new(*kind, &config.critic(*kind), limits, config.release))
        };
        let mut optimizer = Self {
            release: config.release,
            model: config.model,
            critics: config.critics.iter().map(critic).collect(),
            limits: settings.velocity,
            sequence: ControlSequence::default(),
            history: ControlHistory::default(),
            delays: Delays::default(),
            samples: Samples::default(),
            pool: None,
            evaluation: Evaluation::default(),
            weights: Vec::new(),
            draw: 0,
            noise_thread: NoiseThread::new(processor_count()),
            last_command: MppiControl::default(),
            optimal: Vec::new(),
            optimal_sequence: ControlSequence::default(),
            statistics: Vec::new(),
            critic_costs: Vec::new(),
            keeps_costs: config.params().visualize,
            settings,
        };
        optimizer.reset();
        optimizer
    }

    /// Sets the number of threads; results do not depend on it.
    pub(crate) fn set_threads(&mut self, threads: usize) {
        self.noise_thread = NoiseThread::new(threads);
    }

    /// Forgets the sequence and draws noise; the speed limit stays.
    pub(crate) fn reset(&mut self) {
        let settings = &self.settings;
        let (count, steps) = (settings.samples, settings.steps);
        self.sequence = ControlSequence::new(steps);
        self.history = ControlHistory::default();
        self.delays = Delays::new(settings.delays_s, f64::from(settings.step_s));
        self.delays.clear();
        if settings.is_open_loop || self.release == Nav2Release::Main {
            self.last_command = MppiControl::default();
        }
        if self.samples.count != count || self.samples.steps != steps {
            self.samples = Samples::new(count, steps, self.model.is_holonomic());
        }
        self.evaluation.clear(self.samples.blocks());
        if !settings.regenerates {
            let mut pool = Samples::new(count, steps, self.model.is_holonomic());
            draw_noise(&mut pool, settings.seed, self.draw, settings.scale);
            self.draw += 1;
            self.pool = Some(pool);
        }
    }

    /// Velocity from which the samples start.
    pub(crate) fn start_speed(&self, measured: MppiControl) -> MppiControl {
        let settings = &self.settings;
        if settings.is_open_loop {
            return self.last_command;
        }
        if self.release != Nav2Release::Main {
            return measured;
        }
        // The last command is still to take effect, as far as the accelerations permit.
        let changes = settings.acceleration.within(settings.period_s);
        let reach = |change: super::limits::Change, last: f32, measured: f32| {
            super::lanes::clamp(last, measured + change.loss, measured + change.gain)
        };
        MppiControl {
            vx: reach(changes.vx, self.last_command.vx, measured.vx),
            vy: if self.model.is_holonomic() {
                reach(changes.vy, self.last_command.vy, measured.vy)
            } else {
                measured.vy
            },
            wz: reach(changes.wz, self.last_command.wz, measured.wz),
        }
    }

    /// Runs a cycle and returns the command.
    ///
    /// # Errors
    /// The reason why the last attempt failed; the optimizer is reset then.
    pub(crate) fn run(
        &mut self,
        context: &CriticContext<'_>,
    ) -> Result<MppiControl, AttemptFailure> {
        let mut result = Ok(());
        for _ in 0..=self.settings.retries {
            self.evaluation.clear(self.samples.blocks());
            result = self.attempt(context);
            if result.is_ok() {
                break;
            }
            self.reset();
        }
        result?;
        if self.release != Nav2Release::Main {
            self.smooth();
        }
        let sent = usize::from(self.settings.shifts);
        let command = self.sequence.at(sent);
        self.optimal_sequence = self.sequence.clone();
        self.delays.push(command);
        self.last_command = command;
        if self.settings.shifts {
            self.sequence.advance();
        }
        Ok(command)
    }

    fn attempt(&mut self, context: &CriticContext<'_>) -> Result<(), AttemptFailure> {
        for _ in 0..self.settings.iterations {
            self.sample(context);
            self.criticize(context);
            self.improve(context.start.speed);
        }
        self.optimal = trajectory(&self.sequence, &context.start, self.settings.step_s);
        if self.evaluation.has_failed {
            return Err(AttemptFailure::AllCollide);
        }
        if !self.optimal.as_flattened().iter().all(|value| value.is_finite()) {
            return Err(AttemptFailure::NotFinite);
        }
        let validator = self.settings.validator;
        match validator.and_then(|it| it.find_collision(&self.optimal, context.grid)) {
            Some(step) => Err(AttemptFailure::TrajectoryCollides(step)),
            None => Ok(()),
        }
    }

    fn sample(&mut self, context: &CriticContext<'_>) {
        let speed = context.start.speed;
        self.sequence.start_from(speed, &self.sequence_limits());
        let settings = &self.settings;
        match &self.pool {
            Some(pool) => self.samples.copy_controls(pool),
            None => {
                let key = NoiseKey { seed: settings.seed, draw: self.draw, scale: settings.scale };
                self.noise_thread.draw(&mut self.samples, key);
                self.draw += 1;
            }
        }
        add_sequence(&mut self.samples, &self.sequence);
        let is_free = self.release == Nav2Release::Humble;
        let changes = settings.acceleration.within(settings.step_s);
        let motion = Motion {
            model: self.model,
            changes: if is_free { Changes::FREE } else { changes },
            step_s: settings.step_s,
            limits_controls: settings.limits_controls,
            delays: &self.delays,
            sequence: &self.sequence,
        };
        predict(&mut self.samples, &context.start, &motion);
    }

    /// Adds the costs of all critics, up to one that finds collisions of all samples.
    fn criticize(&mut self, context: &CriticContext<'_>) {
        self.statistics.clear();
        self.critic_costs.clear();
        let mut before: Vec<Row> = Vec::new();
        for (kind, critic) in &self.critics {
            if self.evaluation.has_failed {
                break;
            }
            before.clone_from(&self.evaluation.costs);
            critic.score(context, &self.samples, &mut self.evaluation);
            for (before, after) in before.iter_mut().zip(&self.evaluation.costs) {
                for (before, after) in before.iter_mut().zip(after) {
                    *before = after - *before;
                }
            }
            let added = &before.as_flattened()[..self.samples.count];
            self.statistics.push(CriticStatistics::new(*kind, added));
            if self.keeps_costs {
                self.critic_costs.push(before.clone());
            }
        }
    }

    fn improve(&mut self, speed: MppiControl) {
        let settings = &self.settings;
        let how = UpdateSettings {
            temperature: settings.temperature,
            gamma: settings.gamma,
            scale: settings.scale,
        };
        let costs = &mut self.evaluation.costs;
        update(&mut self.sequence, &self.samples, costs, &mut self.weights, &how);
        if self.release == Nav2Release::Main {
            self.smooth();
        }
        let limits = self.sequence_limits();
        self.sequence.limit(speed, &limits);
    }

    fn smooth(&mut self) {
        let sent = usize::from(self.settings.shifts);
        let order = self.settings.smoothing_order;
        smooth(&mut self.sequence, &mut self.history, order, self.release, sent);
    }

    fn sequence_limits(&self) -> SequenceLimits {
        SequenceLimits {
            release: self.release,
            model: self.model,
            velocity: self.limits,
            acceleration: self.settings.acceleration,
            step_s: self.settings.step_s,
            period_s: self.settings.period_s,
            shifts: self.settings.shifts,
        }
    }
}

fn processor_count() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}
