//! Goal on which the controller server works.

use periplus_controllers::PathHandler;
use periplus_costmap::Nav2Release;
use periplus_geometry::Pose2;
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs_main::{FollowPathGoal, FollowPathResult};

use super::plugins::ControllerPlugins;
use crate::costmap_2d::pose2_of;
use crate::server_plugins::find_plugin;

/// End of a goal with an error code of `FollowPath`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ControlFailure {
    pub(super) code: u16,
    pub(super) text: String,
}

impl ControlFailure {
    pub(super) fn new(code: u16, text: impl Into<String>) -> Self {
        Self { code, text: text.into() }
    }
}

/// Plugins of a goal, by their index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct JobPlugins {
    pub(super) controller: usize,
    pub(super) goal_checker: usize,
    /// None without progress checkers.
    pub(super) progress_checker: Option<usize>,
    /// Path handler of the server; none if the controller has its own one.
    path_handler: Option<usize>,
}

/// A goal being worked on.
pub(super) struct Job {
    pub(super) plugins: JobPlugins,
    pub(super) path: Path,
    /// Poses of the path, in its frame.
    pub(super) plan: Vec<Pose2>,
    /// Time of the last valid velocity \[ns\].
    pub(super) last_valid_ns: i64,
    /// Time since which a cycle waits for the costmap \[ns\].
    pub(super) waits_since_ns: Option<i64>,
    /// True once the robot was stopped because it waits.
    pub(super) is_stopped: bool,
    /// First segment in which the nearest one is searched for the feedback.
    pub(super) segment: usize,
}

impl ControllerPlugins {
    /// Finds the plugins that a goal asks for.
    pub(super) fn find(
        &self,
        goal: &FollowPathGoal,
        release: Nav2Release,
    ) -> Result<JobPlugins, ControlFailure> {
        let ids = self.controllers.iter().map(|slot| slot.id.as_str());
        let controller = find_plugin(ids, &goal.controller_id, "controller")
            .map_err(|text| ControlFailure::new(FollowPathResult::INVALID_CONTROLLER, text))?;
        let unknown = |text| ControlFailure::new(FollowPathResult::UNKNOWN, text);
        let ids = self.goal_checkers.iter().map(|(id, _)| id.as_str());
        let goal_checker =
            find_plugin(ids, &goal.goal_checker_id, "goal checker").map_err(unknown)?;
        let mut ids = self.progress_checkers.iter().map(|(id, _)| id.as_str()).peekable();
        let progress_checker = if ids.peek().is_none() && goal.progress_checker_id.is_empty() {
            None
        } else {
            let asked = &goal.progress_checker_id;
            Some(find_plugin(ids, asked, "progress checker").map_err(unknown)?)
        };
        let has_own = self.controllers[controller].own_handler.is_some();
        let ids = self.path_handlers.iter().map(|(id, _)| id.as_str());
        let path_handler = if has_own {
            None
        } else {
            // Before main goals name none.
            let asked = if release < Nav2Release::Main { "" } else { &goal.path_handler_id };
            Some(find_plugin(ids, asked, "path handler").map_err(unknown)?)
        };
        Ok(JobPlugins { controller, goal_checker, progress_checker, path_handler })
    }

    /// Path handler of a goal.
    pub(super) fn handler(&mut self, job: JobPlugins) -> Option<&mut PathHandler> {
        match job.path_handler {
            Some(index) => self.path_handlers.get_mut(index).map(|(_, handler)| handler),
            None => self.controllers[job.controller].own_handler.as_mut(),
        }
    }

    /// Passes a path to the plugins of a goal.
    pub(super) fn set_plan(&mut self, job: JobPlugins, plan: &[Pose2]) {
        self.controllers[job.controller].controller.set_plan(plan);
        if let Some(handler) = self.handler(job) {
            handler.set_plan(plan.to_vec());
        }
        self.goal_checkers[job.goal_checker].1.reset();
    }

    pub(super) fn reset_progress(&mut self, job: JobPlugins) {
        if let Some(index) = job.progress_checker {
            self.progress_checkers[index].1.reset();
        }
    }
}

impl Job {
    /// Starts a goal: the path goes to the plugins.
    pub(super) fn new(
        plugins: &mut ControllerPlugins,
        goal: &FollowPathGoal,
        release: Nav2Release,
        now_ns: i64,
    ) -> Result<Self, ControlFailure> {
        let mut job = Self {
            plugins: plugins.find(goal, release)?,
            path: Path::default(),
            plan: Vec::new(),
            last_valid_ns: now_ns,
            waits_since_ns: None,
            is_stopped: false,
            segment: 0,
        };
        job.set_path(plugins, goal)?;
        plugins.reset_progress(job.plugins);
        Ok(job)
    }

    /// Replaces the path by that of a goal that preempts. The progress checker goes on, unless it is another one.
    pub(super) fn preempt(
        &mut self,
        plugins: &mut ControllerPlugins,
        goal: &FollowPathGoal,
        release: Nav2Release,
    ) -> Result<(), ControlFailure> {
        let found = plugins.find(goal, release).map_err(|failure| {
            ControlFailure::new(FollowPathResult::INVALID_CONTROLLER, failure.text)
        })?;
        let is_other = found.progress_checker != self.plugins.progress_checker;
        self.plugins = found;
        if is_other {
            plugins.reset_progress(found);
        }
        self.set_path(plugins, goal)
    }

    fn set_path(
        &mut self,
        plugins: &mut ControllerPlugins,
        goal: &FollowPathGoal,
    ) -> Result<(), ControlFailure> {
        if goal.path.poses.is_empty() {
            let text = "Path is empty.";
            return Err(ControlFailure::new(FollowPathResult::INVALID_PATH, text));
        }
        let mut poses = goal.path.poses.iter().map(|pose| pose2_of(&pose.pose));
        if let Some(index) = poses.position(|pose| !pose.is_finite()) {
            let text =
                format!("pose {index} of the path has a component that is not a finite number");
            return Err(ControlFailure::new(FollowPathResult::INVALID_PATH, text));
        }
        self.plan = goal.path.poses.iter().map(|pose| pose2_of(&pose.pose)).collect();
        self.path = goal.path.clone();
        self.segment = 0;
        plugins.set_plan(self.plugins, &self.plan);
        Ok(())
    }
}
