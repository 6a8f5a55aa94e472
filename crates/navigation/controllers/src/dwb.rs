//! DWB: the best of many simulated trajectories, by the scores of critics.
//!
//! Source: `nav2_dwb_controller` (`dwb_core`, `dwb_plugins`, `dwb_critics`).

pub mod critics;
mod evaluation;
mod params;
mod trajectory;
mod velocities;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{Pose2, Twist2};
use periplus_params::{ParamValue, ParamValues};

use critics::{CriticInput, NamedCritic, create_critic};
pub(crate) use evaluation::evaluate;
pub use evaluation::{CellScores, CriticScore, IllegalCount, LocalPlanEvaluation, TrajectoryScore};
pub use params::{
    CriticParams, DWB, DwbParams, KinematicParams, MAP_GRID_CRITIC, MapGridCriticParams,
    OBSTACLE_CRITIC, OSCILLATION_CRITIC, ObstacleCriticParams, OscillationCriticParams,
    PLAIN_CRITIC, PREFER_FORWARD_CRITIC, PlainCriticParams, PreferForwardCriticParams,
    ROTATE_TO_GOAL_CRITIC, RotateToGoalCriticParams, ScoreAggregation, TrajectoryParams,
};
pub(crate) use trajectory::moved;
pub use trajectory::{SampledTrajectory, TrajectoryGenerator, step_count};
pub use velocities::{AxisLimits, KinematicLimits};

use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change, store};
use crate::{
    ControlError, ControlInput, ControlReport, Controller, GivenParameters, ParameterGroup,
    PathRules, PluginSetup,
};

/// Names of the parameters that change while the controller runs.
const DYNAMIC_NAMES: [&str; 14] = [
    "min_vel_x",
    "min_vel_y",
    "max_vel_x",
    "max_vel_y",
    "max_vel_theta",
    "min_speed_xy",
    "max_speed_xy",
    "min_speed_theta",
    "acc_lim_x",
    "acc_lim_y",
    "acc_lim_theta",
    "decel_lim_x",
    "decel_lim_y",
    "decel_lim_theta",
];

/// Names of limits that may be negative.
const SIGNED_NAMES: &[&str] = &[
    "min_vel_x",
    "min_vel_y",
    "min_speed_xy",
    "min_speed_theta",
    "decel_lim_x",
    "decel_lim_y",
    "decel_lim_theta",
];

/// Speed limit that is set from outside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct SpeedLimit {
    limit: f64,
    is_percentage: bool,
}

/// The controller DWB.
pub struct Dwb {
    release: Nav2Release,
    period_s: f64,
    values: ParamValues,
    params: DwbParams,
    generator: TrajectoryGenerator,
    critics: Vec<NamedCritic>,
    speed_limit: SpeedLimit,
    evaluation: LocalPlanEvaluation,
}

/// Creates the controller from parameters of [`DWB`] and its critics.
pub(crate) fn create(
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    Dwb::read(setup, diagnostics).map(|dwb| Box::new(dwb) as Box<dyn Controller>)
}

impl Dwb {
    /// Reads the parameters of the controller and of its critics; none after an error that it has reported.
    #[must_use]
    pub fn read(setup: &PluginSetup<'_>, diagnostics: &mut Diagnostics) -> Option<Self> {
        let mut given = setup.given.clone();
        let names = critic_names(&given);
        let mut groups: Vec<(String, GivenParameters<'_>)> = Vec::new();
        for name in names {
            let group = given.take_group(&name);
            groups.push((name, group));
        }
        drop_unlisted_critics(&mut given, diagnostics);
        let values = given.read(&DWB, &setup.neighbours, diagnostics);
        let params = DwbParams::from_values(&values);
        if groups.is_empty() {
            diagnostics.push(no_critics(setup));
            return None;
        }
        let class = &params.trajectory_generator_name;
        let Some(generator) = TrajectoryGenerator::of_class(class) else {
            diagnostics.push(unknown_generator(class, &values));
            return None;
        };
        let mut critics = Vec::new();
        for (name, group) in &groups {
            critics.push(create_critic(name, group, &params, setup.release, diagnostics)?);
        }
        Some(Self::new(values, generator, critics, setup.release, setup.control_period_s))
    }

    fn new(
        mut values: ParamValues,
        generator: TrajectoryGenerator,
        critics: Vec<NamedCritic>,
        release: Nav2Release,
        period_s: f64,
    ) -> Self {
        for critic in &critics {
            values.add_group(critic.name.to_string(), critic.values.clone());
        }
        Self {
            release,
            period_s,
            params: DwbParams::from_values(&values),
            values,
            generator,
            critics,
            speed_limit: SpeedLimit::default(),
            evaluation: LocalPlanEvaluation::default(),
        }
    }

    /// Returns the limits with the speed limit.
    #[must_use]
    pub fn limits(&self) -> KinematicLimits {
        let SpeedLimit { limit, is_percentage } = self.speed_limit;
        KinematicLimits::new(&self.params.kinematics).limited(limit, is_percentage)
    }

    /// Returns the evaluation of the last cycle.
    #[must_use]
    pub fn last_evaluation(&self) -> &LocalPlanEvaluation {
        &self.evaluation
    }

    fn prepare(&mut self, input: &CriticInput<'_>) -> Vec<String> {
        let mut unprepared = Vec::new();
        for NamedCritic { name, critic, .. } in &mut self.critics {
            if !critic.prepare(input) {
                unprepared.push(name.to_string());
            }
        }
        unprepared
    }

    /// Returns the scores of cells by all critics with a grid, and their scaled sum.
    fn cell_scores(&self, input: &CriticInput<'_>) -> Vec<CellScores> {
        let mut channels = Vec::new();
        let mut totals = vec![0.0_f32; input.costmap.costs.info().len()];
        for NamedCritic { name, critic, .. } in &self.critics {
            let Some(scores) = critic.cell_scores(input) else { continue };
            let scale = critic.scale(input) as f32;
            for (total, score) in totals.iter_mut().zip(&scores) {
                *total += score * scale;
            }
            channels.push(CellScores { name: name.to_string(), scores });
        }
        channels.push(CellScores { name: "total_cost".to_owned(), scores: totals });
        channels
    }
}

/// Returns the names in `critics`.
fn critic_names(given: &GivenParameters<'_>) -> Vec<String> {
    let Some(text) = given.text("critics") else { return Vec::new() };
    let parameter = DWB.find("critics");
    match parameter.map(|parameter| ParamValue::read(parameter, text)) {
        Some(Ok(ParamValue::Texts(names))) => names,
        _ => Vec::new(),
    }
}

/// Removes parameters of critics that are not listed, with one hint each: files often keep them.
fn drop_unlisted_critics(given: &mut GivenParameters<'_>, diagnostics: &mut Diagnostics) {
    let mut unlisted: Vec<&str> = Vec::new();
    for entry in given.entries() {
        if let Some((group, _)) = entry.name.split_once('.')
            && !unlisted.contains(&group)
        {
            unlisted.push(group);
            diagnostics.push(
                Diagnostic::hint(
                    "unlisted-critic",
                    format!("`{group}` is not in `critics`; its parameters have no effect"),
                )
                .at(entry.name_origin),
            );
        }
    }
    given.retain(|name| !name.contains('.'));
}

fn no_critics(setup: &PluginSetup<'_>) -> Diagnostic {
    let name = setup.name;
    Diagnostic::error("missing-parameter", format!("No critics defined for {name}"))
        .at(setup.class_origin)
        .note("critics decide which trajectory is the best")
        .help(format!(
            "set `{name}.critics`, for example to `[RotateToGoal, Oscillation, BaseObstacle, GoalAlign, PathAlign, \
             PathDist, GoalDist]`"
        ))
}

fn unknown_generator(class: &str, values: &ParamValues) -> Diagnostic {
    let known = TrajectoryGenerator::CLASSES.map(|(class, _)| class);
    Diagnostic::error(
        "unknown-plugin",
        format!("`trajectory_generator_name`: there is no trajectory generator `{class}`"),
    )
    .at(values.origin("trajectory_generator_name"))
    .note(format!("known are {}", known.join(", ")))
    .did_you_mean(values.origin("trajectory_generator_name"), class, known)
}

impl Controller for Dwb {
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError> {
        let critic_input = CriticInput {
            time_ns: input.time_ns,
            pose: input.pose,
            velocity: input.velocity,
            goal: input.goal,
            plan: input.plan,
            costmap: input.costmap,
        };
        let unprepared = self.prepare(&critic_input);
        let (limits, params) = (self.limits(), &self.params.trajectories);
        let generator = self.generator;
        let samples = generator.samples(params, &limits, input.velocity, self.period_s);
        let trajectories = samples.into_iter().map(|command| {
            generator.simulate(params, &limits, input.pose, input.velocity, command)
        });
        let short_circuits = self.params.short_circuit_trajectory_evaluation;
        let mut evaluation = evaluate(&self.critics, &critic_input, trajectories, short_circuits);
        evaluation.unprepared = unprepared;
        if self.params.publish_cost_grid_pc {
            evaluation.cell_scores = self.cell_scores(&critic_input);
        }
        let command = evaluation.best().map(|best| best.trajectory.velocity);
        for critic in &mut self.critics {
            critic.critic.debrief(command.unwrap_or(Twist2::ZERO));
        }
        self.evaluation = evaluation;
        command.ok_or_else(|| {
            let failure = self.evaluation.failure();
            ControlError::NoValidControl(format!("Could not find a legal trajectory: {failure}"))
        })
    }

    fn set_plan(&mut self, _plan: &[Pose2]) {
        for critic in &mut self.critics {
            critic.critic.reset();
        }
    }

    fn set_speed_limit(&mut self, limit: f64, is_percentage: bool) {
        self.speed_limit = SpeedLimit { limit, is_percentage };
    }

    fn parameters(&self) -> Vec<ParameterGroup<'_>> {
        vec![ParameterGroup::own(&self.values)]
    }

    fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        if name.starts_with("decel_lim_")
            && let ParamValue::Number(number) = value
            && number > 0.0
        {
            return Err(ParameterRefusal::Conflict(format!(
                "`{name}` must be at most 0; {number} is refused"
            )));
        }
        if !DYNAMIC_NAMES.contains(&name) {
            // These have no effect before a restart, so Nav2 does not check their signs.
            return store(&mut self.values, name, value).map(|()| ParameterChange::AfterRestart);
        }
        let rules = ChangeRules { fixed: &[], signed: SIGNED_NAMES };
        let change = change(&mut self.values, rules, name, value)?;
        self.params.kinematics = DwbParams::from_values(&self.values).kinematics;
        Ok(change)
    }

    fn path_rules(&self) -> Option<PathRules> {
        (self.release < Nav2Release::Main).then_some(PathRules::Dwb {
            prune_distance_m: self.params.prune_distance_m,
            forward_prune_distance_m: self.params.forward_prune_distance_m,
            prunes: self.params.prune_plan,
            shortens: self.params.shorten_transformed_plan,
        })
    }

    fn report(&self) -> ControlReport<'_> {
        ControlReport::Trajectories(&self.evaluation)
    }
}
