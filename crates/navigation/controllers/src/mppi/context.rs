//! Inputs of the critics: robot, path, costs.

use std::cell::OnceCell;

use periplus_costmap::Nav2Release;

use super::cost_grid::CostGrid;
use super::lanes::Row;
use super::limits::MppiModel;
use super::path::LocalPath;
use super::rollout::Start;
use super::samples::Samples;

/// Inputs that are the same for all samples of a cycle.
#[derive(Debug)]
pub(crate) struct CriticContext<'a> {
    pub(crate) release: Nav2Release,
    pub(crate) model: MppiModel,
    /// Duration of a time step \[s\].
    pub(crate) step_s: f32,
    /// Pose and velocity of the robot.
    pub(crate) start: Start,
    pub(crate) path: &'a LocalPath,
    /// Last pose of the plan: x \[m\], y \[m\], yaw \[rad\].
    pub(crate) goal: [f32; 3],
    /// True if `GoalAngleCritic` does not apply: the robot stands near the goal.
    pub(crate) ignores_goal_heading: bool,
    /// Tolerance of the goal checker \[m\].
    pub(crate) goal_tolerance: Option<f32>,
    pub(crate) grid: &'a CostGrid,
    /// Length of the local path \[m\], by which critics of main decide if they apply.
    pub(crate) path_length: f32,
    pub(crate) furthest: OnceCell<usize>,
    pub(crate) valid: OnceCell<Vec<bool>>,
}

impl CriticContext<'_> {
    /// Goal of the goal critics: the end of the local path, or of the whole plan in Jazzy and Kilted.
    pub(crate) fn goal(&self) -> [f32; 3] {
        match self.release {
            Nav2Release::Humble | Nav2Release::Main => self.path.pose(self.path.last()),
            _ => self.goal,
        }
    }

    /// Returns true if the goal is nearer than a distance \[m\].
    pub(crate) fn is_goal_within(&self, distance: f32) -> bool {
        if self.release == Nav2Release::Main {
            return self.path_length < distance;
        }
        let [goal_x, goal_y, _] = self.goal();
        let (dx, dy) = (goal_x - self.start.x, goal_y - self.start.y);
        dx * dx + dy * dy < distance * distance
    }

    /// Returns true if the goal critics apply, up to a distance \[m\].
    pub(crate) fn is_goal_near(&self, distance: f32) -> bool {
        if self.release == Nav2Release::Main {
            self.path_length <= distance
        } else {
            self.is_goal_within(distance)
        }
    }

    /// Index of the path's point that the samples reach.
    pub(crate) fn furthest(&self, samples: &Samples) -> usize {
        *self.furthest.get_or_init(|| self.path.find_furthest(samples, self.release, self.step_s))
    }

    /// Validity of each point of the path but the last.
    pub(crate) fn valid(&self) -> &[bool] {
        self.valid.get_or_init(|| self.path.find_valid(self.grid))
    }

    /// Returns true if a point of the path is free; the last counts as occupied.
    pub(crate) fn is_valid(&self, index: usize) -> bool {
        self.valid().get(index).copied().unwrap_or(false)
    }
}

/// Costs of all samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Evaluation {
    /// Total costs.
    pub(crate) costs: Vec<Row>,
    /// Samples that touch an obstacle.
    pub(crate) collisions: Vec<[bool; super::lanes::LANES]>,
    /// True if all samples touch an obstacle.
    pub(crate) has_failed: bool,
}

impl Evaluation {
    /// Sets costs to zero.
    pub(crate) fn clear(&mut self, blocks: usize) {
        self.costs.clear();
        self.costs.resize(blocks, super::lanes::ZEROS);
        self.collisions.clear();
        self.collisions.resize(blocks, [false; super::lanes::LANES]);
        self.has_failed = false;
    }

    /// Number of samples that touch an obstacle.
    pub(crate) fn colliding(&self, count: usize) -> usize {
        self.collisions.as_flattened().iter().take(count).filter(|it| **it).count()
    }
}
