//! Critics: scores of trajectories.
//!
//! Source: `dwb_core/trajectory_critic.hpp`, `dwb_critics`.

mod grid;
mod map_grid;
mod motion;
mod obstacles;
mod rotate_to_goal;

use std::sync::Arc;

use periplus_costmap::{CostmapView, Nav2Release};
use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_geometry::{Pose2, Twist2};
use periplus_params::{ParamValues, Table};

pub(crate) use grid::plan_cells;
pub use grid::{CellDistances, densified};
pub use map_grid::{MapGridCritic, MapGridTarget};
pub use motion::{OscillationCritic, PreferForwardCritic, TwirlingCritic};
pub use obstacles::{BaseObstacleCritic, ObstacleFootprintCritic};
pub use rotate_to_goal::RotateToGoalCritic;

use super::params::{
    MAP_GRID_CRITIC, OBSTACLE_CRITIC, OSCILLATION_CRITIC, PLAIN_CRITIC, PREFER_FORWARD_CRITIC,
    ROTATE_TO_GOAL_CRITIC,
};
use super::{DwbParams, SampledTrajectory};
use crate::{BlockedCell, GivenParameters};

/// Inputs of critics in a cycle. All poses are in the frame of the costmap.
#[derive(Clone, Copy, Debug)]
pub struct CriticInput<'a> {
    /// Time \[ns\].
    pub time_ns: i64,
    /// Pose of the robot.
    pub pose: Pose2,
    /// Velocity of the robot.
    pub velocity: Twist2,
    /// Goal.
    pub goal: Pose2,
    /// Local plan.
    pub plan: &'a [Pose2],
    /// Local costmap.
    pub costmap: CostmapView<'a>,
}

/// Reason for which a trajectory must not be driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IllegalTrajectory {
    /// Sentence of Nav2.
    pub reason: &'static str,
    /// Cell that is hit, if the reason is one.
    pub blocked: Option<BlockedCell>,
}

impl IllegalTrajectory {
    pub(crate) const fn new(reason: &'static str) -> Self {
        Self { reason, blocked: None }
    }

    pub(crate) const fn at(reason: &'static str, blocked: BlockedCell) -> Self {
        Self { reason, blocked: Some(blocked) }
    }

    /// A pose outside of the costmap.
    pub(crate) const fn off_grid(reason: &'static str, pose: Pose2) -> Self {
        let position_m = (pose.x_m, pose.y_m);
        let cost = periplus_costmap::cost::UNKNOWN;
        Self::at(reason, BlockedCell { pose, cell: None, position_m, cost })
    }
}

/// A critic, which scores trajectories. Lower scores are better.
pub trait TrajectoryCritic: Send {
    /// Prepares for the trajectories of a cycle. False if the critic has no basis for scores.
    fn prepare(&mut self, _input: &CriticInput<'_>) -> bool {
        true
    }

    /// Returns the weight of the score.
    fn scale(&self, input: &CriticInput<'_>) -> f64;

    /// Returns the score of a trajectory.
    ///
    /// # Errors
    /// If the trajectory must not be driven.
    fn score(
        &self,
        input: &CriticInput<'_>,
        trajectory: &SampledTrajectory,
    ) -> Result<f64, IllegalTrajectory>;

    /// Reports the command that was selected; zero if there was none.
    fn debrief(&mut self, _command: Twist2) {}

    /// Forgets the state, as for a new plan.
    fn reset(&mut self) {}

    /// Returns the score of each cell for display; none for critics without a grid.
    fn cell_scores(&self, _input: &CriticInput<'_>) -> Option<Vec<f32>> {
        None
    }
}

/// A critic with its name and parameters.
pub(crate) struct NamedCritic {
    pub name: Arc<str>,
    pub values: ParamValues,
    pub critic: Box<dyn TrajectoryCritic>,
}

/// Inputs from which a critic is created.
struct CriticSetup<'a> {
    values: &'a ParamValues,
    planner: &'a DwbParams,
    release: Nav2Release,
}

type CreateCritic = fn(&CriticSetup<'_>) -> Box<dyn TrajectoryCritic>;

/// Classes of critics without their package, with their parameters.
const CRITICS: &[(&str, &Table, CreateCritic)] = &[
    ("BaseObstacleCritic", &OBSTACLE_CRITIC, |setup| {
        Box::new(BaseObstacleCritic::new(setup.values))
    }),
    ("ObstacleFootprintCritic", &OBSTACLE_CRITIC, |setup| {
        Box::new(ObstacleFootprintCritic::new(setup.values))
    }),
    ("GoalAlignCritic", &MAP_GRID_CRITIC, |setup| {
        Box::new(MapGridCritic::new(setup.values, MapGridTarget::GoalAhead))
    }),
    ("PathAlignCritic", &MAP_GRID_CRITIC, |setup| {
        Box::new(MapGridCritic::new(setup.values, MapGridTarget::PathAhead))
    }),
    ("GoalDistCritic", &MAP_GRID_CRITIC, |setup| {
        Box::new(MapGridCritic::new(setup.values, MapGridTarget::Goal))
    }),
    ("PathDistCritic", &MAP_GRID_CRITIC, |setup| {
        Box::new(MapGridCritic::new(setup.values, MapGridTarget::Path))
    }),
    ("OscillationCritic", &OSCILLATION_CRITIC, |setup| {
        Box::new(OscillationCritic::new(setup.values))
    }),
    ("PreferForwardCritic", &PREFER_FORWARD_CRITIC, |setup| {
        Box::new(PreferForwardCritic::new(setup.values))
    }),
    ("RotateToGoalCritic", &ROTATE_TO_GOAL_CRITIC, |setup| {
        Box::new(RotateToGoalCritic::new(setup.values, setup.planner, setup.release))
    }),
    ("TwirlingCritic", &PLAIN_CRITIC, |setup| Box::new(TwirlingCritic::new(setup.values))),
];

/// Creates a critic from parameters of its group; none after an error that it has reported.
pub(crate) fn create_critic(
    name: &str,
    given: &GivenParameters<'_>,
    planner: &DwbParams,
    release: Nav2Release,
    diagnostics: &mut Diagnostics,
) -> Option<NamedCritic> {
    let class = given.text("class").unwrap_or(name);
    let short = short_class(class, &planner.default_critic_namespaces);
    let Some((_, table, create)) = CRITICS.iter().find(|(known, _, _)| *known == short) else {
        diagnostics.push(unknown_critic(name, class, &short));
        return None;
    };
    let values = given.read(table, &[], diagnostics);
    let critic = create(&CriticSetup { values: &values, planner, release });
    Some(NamedCritic { name: name.into(), values, critic })
}

/// Creates a critic of a class such as `dwb_critics::BaseObstacleCritic` or `BaseObstacle`, from parameters of its
/// group; none after an error that it has reported.
#[must_use]
pub fn create_trajectory_critic(
    class: &str,
    given: &GivenParameters<'_>,
    planner: &DwbParams,
    release: Nav2Release,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn TrajectoryCritic>> {
    create_critic(class, given, planner, release, diagnostics).map(|critic| critic.critic)
}

/// Name of a class without its package, with `Critic` at its end.
fn short_class(class: &str, packages: &[String]) -> String {
    let class = class.trim().replace('/', "::");
    let known = packages.iter().map(String::as_str).chain(["dwb_critics"]);
    let mut short = known
        .filter_map(|package| class.strip_prefix(package)?.strip_prefix("::"))
        .next()
        .unwrap_or(&class)
        .to_owned();
    if !short.contains("Critic") {
        short += "Critic";
    }
    short
}

fn unknown_critic(name: &str, class: &str, short: &str) -> Diagnostic {
    let known: Vec<&str> =
        CRITICS.iter().map(|(class, _, _)| class.trim_end_matches("Critic")).collect();
    let diagnostic = Diagnostic::error(
        "unknown-plugin",
        format!("critic `{name}`: DWB has no critic of the class `{class}`"),
    )
    .note(format!("known are {}", known.join(", ")));
    let wanted = short.trim_end_matches("Critic");
    match closest(wanted, known) {
        Some(near) => diagnostic.help(format!("did you mean `{near}`?")),
        None => diagnostic,
    }
}
