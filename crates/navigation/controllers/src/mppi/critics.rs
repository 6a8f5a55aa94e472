//! Critics: costs of the samples.
//!
//! Source: `nav2_mppi_controller/src/critics/*.cpp` (humble, jazzy, main).

mod constraint;
mod cost;
mod goal;
mod obstacles;
mod path_align;
mod path_align_legacy;
mod path_angle;
mod path_follow;
mod speed;

use periplus_costmap::Nav2Release;
use periplus_params::{ParamValues, Table};

use super::context::{CriticContext, Evaluation};
use super::lanes::{LANES, Row, power};
use super::params;
use super::samples::Samples;

/// Critic of MPPI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CriticKind {
    /// `ConstraintCritic`: velocities beyond the limits.
    Constraint,
    /// `CostCritic`: costs along a trajectory.
    Cost,
    /// `ObstaclesCritic`: distance to obstacles.
    Obstacles,
    /// `GoalCritic`: distance to the goal.
    Goal,
    /// `GoalAngleCritic`: heading at the goal.
    GoalAngle,
    /// `PathAlignCritic`: distance to the path, point by point.
    PathAlign,
    /// `PathAlignLegacyCritic`: distance to the nearest point of the path (Humble).
    PathAlignLegacy,
    /// `PathAngleCritic`: heading towards the path.
    PathAngle,
    /// `PathFollowCritic`: progress along the path.
    PathFollow,
    /// `PreferForwardCritic`: motion backwards.
    PreferForward,
    /// `TwirlingCritic`: turns.
    Twirling,
    /// `VelocityDeadbandCritic`: speeds that the robot cannot drive.
    VelocityDeadband,
}

impl CriticKind {
    /// All critics with their names.
    pub const ALL: [(&str, Self); 12] = [
        ("ConstraintCritic", Self::Constraint),
        ("CostCritic", Self::Cost),
        ("ObstaclesCritic", Self::Obstacles),
        ("GoalCritic", Self::Goal),
        ("GoalAngleCritic", Self::GoalAngle),
        ("PathAlignCritic", Self::PathAlign),
        ("PathAlignLegacyCritic", Self::PathAlignLegacy),
        ("PathAngleCritic", Self::PathAngle),
        ("PathFollowCritic", Self::PathFollow),
        ("PreferForwardCritic", Self::PreferForward),
        ("TwirlingCritic", Self::Twirling),
        ("VelocityDeadbandCritic", Self::VelocityDeadband),
    ];

    /// Returns the critic of a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == name).map(|(_, kind)| *kind)
    }

    /// Returns the name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }

    /// Returns the table of the parameters.
    #[must_use]
    pub fn table(self) -> &'static Table {
        match self {
            Self::Constraint => &params::CONSTRAINT_CRITIC,
            Self::Cost => &params::COST_CRITIC,
            Self::Obstacles => &params::OBSTACLES_CRITIC,
            Self::Goal => &params::GOAL_CRITIC,
            Self::GoalAngle => &params::GOAL_ANGLE_CRITIC,
            Self::PathAlign | Self::PathAlignLegacy => &params::PATH_ALIGN_CRITIC,
            Self::PathAngle => &params::PATH_ANGLE_CRITIC,
            Self::PathFollow => &params::PATH_FOLLOW_CRITIC,
            Self::PreferForward => &params::PREFER_FORWARD_CRITIC,
            Self::Twirling => &params::TWIRLING_CRITIC,
            Self::VelocityDeadband => &params::VELOCITY_DEADBAND_CRITIC,
        }
    }
}

/// Limits of the velocity to which `ConstraintCritic` refers: those of the parameters, whatever the speed
/// limit is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CriticLimits {
    pub(crate) vx_max: f32,
    pub(crate) vx_min: f32,
    pub(crate) vy_max: f32,
}

/// A critic with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Critic {
    Constraint(constraint::ConstraintCritic),
    Cost(cost::CostCritic),
    Obstacles(obstacles::ObstaclesCritic),
    Goal(goal::GoalCritic),
    GoalAngle(goal::GoalAngleCritic),
    PathAlign(path_align::PathAlignCritic),
    PathAlignLegacy(path_align::PathAlignCritic),
    PathAngle(path_angle::PathAngleCritic),
    PathFollow(path_follow::PathFollowCritic),
    PreferForward(speed::PreferForwardCritic),
    Twirling(speed::TwirlingCritic),
    VelocityDeadband(speed::VelocityDeadbandCritic),
}

impl Critic {
    /// Creates a critic from the values of its table.
    pub(crate) fn new(
        kind: CriticKind,
        values: &ParamValues,
        limits: CriticLimits,
        release: Nav2Release,
    ) -> Self {
        match kind {
            CriticKind::Constraint => Self::Constraint(constraint::ConstraintCritic::new(
                &params::ConstraintParams::from_values(values),
                limits,
                release,
            )),
            CriticKind::Cost => {
                Self::Cost(cost::CostCritic::new(&params::CostParams::from_values(values)))
            }
            CriticKind::Obstacles => Self::Obstacles(obstacles::ObstaclesCritic::new(
                &params::ObstaclesParams::from_values(values),
            )),
            CriticKind::Goal => {
                Self::Goal(goal::GoalCritic::new(&params::GoalParams::from_values(values)))
            }
            CriticKind::GoalAngle => Self::GoalAngle(goal::GoalAngleCritic::new(
                &params::GoalAngleParams::from_values(values),
            )),
            CriticKind::PathAlign => Self::PathAlign(path_align::PathAlignCritic::new(
                &params::PathAlignParams::from_values(values),
            )),
            CriticKind::PathAlignLegacy => Self::PathAlignLegacy(path_align::PathAlignCritic::new(
                &params::PathAlignParams::from_values(values),
            )),
            CriticKind::PathAngle => Self::PathAngle(path_angle::PathAngleCritic::new(
                &params::PathAngleParams::from_values(values),
                limits.vx_min,
                release,
            )),
            CriticKind::PathFollow => Self::PathFollow(path_follow::PathFollowCritic::new(
                &params::PathFollowParams::from_values(values),
            )),
            CriticKind::PreferForward => Self::PreferForward(speed::PreferForwardCritic::new(
                &params::MppiPreferForwardParams::from_values(values),
            )),
            CriticKind::Twirling => Self::Twirling(speed::TwirlingCritic::new(
                &params::MppiTwirlingParams::from_values(values),
            )),
            CriticKind::VelocityDeadband => {
                Self::VelocityDeadband(speed::VelocityDeadbandCritic::new(
                    &params::VelocityDeadbandParams::from_values(values),
                ))
            }
        }
    }

    /// Adds the costs of all samples.
    pub(crate) fn score(
        &self,
        context: &CriticContext<'_>,
        samples: &Samples,
        evaluation: &mut Evaluation,
    ) {
        let costs = &mut evaluation.costs;
        match self {
            Self::Constraint(critic) => critic.score(context, samples, costs),
            Self::Cost(critic) => critic.score(context, samples, evaluation),
            Self::Obstacles(critic) => critic.score(context, samples, evaluation),
            Self::Goal(critic) => critic.score(context, samples, costs),
            Self::GoalAngle(critic) => critic.score(context, samples, costs),
            Self::PathAlign(critic) => critic.score(context, samples, costs),
            Self::PathAlignLegacy(critic) => {
                path_align_legacy::score(critic, context, samples, costs);
            }
            Self::PathAngle(critic) => critic.score(context, samples, costs),
            Self::PathFollow(critic) => critic.score(context, samples, costs),
            Self::PreferForward(critic) => critic.score(context, samples, costs),
            Self::Twirling(critic) => critic.score(context, samples, costs),
            Self::VelocityDeadband(critic) => critic.score(context, samples, costs),
        }
    }
}

/// Weight of a critic and the power of the weighted cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weighting {
    pub(crate) is_enabled: bool,
    pub(crate) weight: f32,
    pub(crate) power: u32,
}

impl Weighting {
    pub(crate) fn new(common: &params::MppiCriticParams, weight: f64) -> Self {
        Self {
            is_enabled: common.is_enabled,
            weight: weight as f32,
            power: u32::try_from(common.power).unwrap_or(1),
        }
    }

    /// Adds weighted measures to the costs of a block.
    #[inline(always)]
    pub(crate) fn add(&self, costs: &mut Row, measures: &Row) {
        if self.power <= 1 {
            for lane in 0..LANES {
                costs[lane] += measures[lane] * self.weight;
            }
        } else {
            for lane in 0..LANES {
                costs[lane] += power(measures[lane] * self.weight, self.power);
            }
        }
    }
}

/// Length of a vector.
#[inline(always)]
pub(crate) fn length(x: f32, y: f32) -> f32 {
    (x * x + y * y).sqrt()
}
