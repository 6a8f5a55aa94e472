//! Follower of joint trajectories: `joint_trajectory_controller`.

mod accept;

use std::f64::consts::PI;

use crate::{
    ControlCycle, ControllerError, ControllerInterface, InterfaceSelection, JointInterfaceKind,
    JointTrajectory, LoanedInterfaces, PidController, PidGains, SamplePhase, TrajectoryPoint,
};

pub use accept::{TrajectoryErrorCode, TrajectoryRejection};

/// Tolerances of a joint; zero is unlimited.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointTolerances {
    /// Maximum position error [m or rad].
    pub position: f64,
    /// Maximum velocity error [m/s or rad/s].
    pub velocity: f64,
}

impl JointTolerances {
    fn exceeded(&self, position_error: f64, velocity_error: f64) -> Option<String> {
        let check = |what: &str, error: f64, tolerance: f64| {
            (tolerance > 0.0 && error.abs() > tolerance)
                .then(|| format!("{what} error {error:.6} is beyond {tolerance}"))
        };
        check("position", position_error, self.position)
            .or_else(|| check("velocity", velocity_error, self.velocity))
    }
}

/// Tolerances of a goal, by the joints of the controller.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GoalTolerances {
    /// While the trajectory is followed.
    pub path: Vec<JointTolerances>,
    /// At its end.
    pub goal: Vec<JointTolerances>,
    /// Time after the end within which the goal must be reached [s]; zero is unlimited.
    pub goal_time_s: f64,
}

/// Settings of a [`JointTrajectoryController`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointTrajectorySettings {
    /// Joints of the trajectories.
    pub joints: Vec<String>,
    /// Joints that are commanded, in the same order.
    pub command_joints: Vec<String>,
    /// Commanded interfaces.
    pub command_interfaces: Vec<JointInterfaceKind>,
    /// Interfaces that are read.
    pub state_interfaces: Vec<JointInterfaceKind>,
    /// True for joints that turn without limits: the shorter direction is the error.
    pub is_continuous: Vec<bool>,
    /// Gains of velocity and effort commands, by joint.
    pub gains: Vec<PidGains>,
    /// Part of the desired velocity that is added to velocity and effort commands, by joint.
    pub feed_forward: Vec<f64>,
    /// Default tolerances.
    pub tolerances: GoalTolerances,
    /// True to accept trajectories of some of the joints.
    pub allows_partial_goals: bool,
    /// True to accept a velocity at the last point.
    pub allows_velocity_at_end: bool,
    /// True to accept points without positions.
    pub integrates: bool,
    /// True for splines, false for steps.
    pub interpolates: bool,
    /// True to begin a trajectory at the last command instead of the measured state.
    pub begins_at_command: bool,
}

/// End of a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub enum TrajectoryOutcome {
    /// The end was reached within its tolerances.
    Reached,
    /// A tolerance was exceeded, with the reason.
    Failed(TrajectoryErrorCode, String),
}

/// State of the follower after an update.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrajectoryProgress {
    /// Wanted state.
    pub desired: TrajectoryPoint,
    /// Measured state.
    pub actual: TrajectoryPoint,
    /// Wanted minus measured state.
    pub error: TrajectoryPoint,
    /// Commands.
    pub output: TrajectoryPoint,
    /// Time since the start of the trajectory [ns].
    pub since_start_ns: i64,
}

/// Trajectory that is being followed.
#[derive(Clone, Debug, PartialEq)]
struct Followed {
    trajectory: JointTrajectory,
    before: TrajectoryPoint,
    before_ns: i64,
    tolerances: GoalTolerances,
    /// False for a position that is held.
    is_goal: bool,
}

/// Follows trajectories by position, velocity or effort commands.
///
/// Source: `joint_trajectory_controller.cpp` and `trajectory.cpp` of `ros2_controllers`.
#[derive(Clone, Debug)]
pub struct JointTrajectoryController {
    settings: JointTrajectorySettings,
    followed: Option<Followed>,
    pids: Vec<PidController>,
    last_command: TrajectoryPoint,
    /// State of the last update.
    pub progress: TrajectoryProgress,
    outcome: Option<TrajectoryOutcome>,
}

impl JointTrajectoryController {
    /// Creates an inactive controller.
    #[must_use]
    pub fn new(settings: JointTrajectorySettings) -> Self {
        Self {
            followed: None,
            pids: vec![PidController::default(); settings.joints.len()],
            last_command: TrajectoryPoint::default(),
            progress: TrajectoryProgress::default(),
            outcome: None,
            settings,
        }
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &JointTrajectorySettings {
        &self.settings
    }

    /// Begins to follow a trajectory and ends the present one.
    ///
    /// # Errors
    /// The reason and its code, when the trajectory cannot be followed; the present one goes on.
    pub fn start(
        &mut self,
        trajectory: &JointTrajectory,
        tolerances: Option<GoalTolerances>,
        now_ns: i64,
    ) -> Result<(), TrajectoryRejection> {
        let before = if self.settings.begins_at_command && !self.last_command.positions.is_empty() {
            self.last_command.clone()
        } else {
            self.progress.actual.clone()
        };
        let trajectory = accept::accepted(&self.settings, trajectory, &before, now_ns)?;
        let tolerances = tolerances.unwrap_or_else(|| self.settings.tolerances.clone());
        self.outcome = None;
        self.followed =
            Some(Followed { trajectory, before, before_ns: now_ns, tolerances, is_goal: true });
        Ok(())
    }

    /// Holds the measured positions from now on.
    pub fn hold(&mut self, now_ns: i64) {
        let mut point = self.progress.actual.clone();
        point.velocities = vec![0.0; point.positions.len()];
        point.accelerations.clear();
        point.time_from_start_ns = 0;
        let joints = self.settings.joints.clone();
        let before = point.clone();
        let trajectory = JointTrajectory { joints, points: vec![point], start_ns: now_ns };
        let tolerances = GoalTolerances::default();
        self.followed =
            Some(Followed { trajectory, before, before_ns: now_ns, tolerances, is_goal: false });
    }

    /// Returns and forgets the end of the trajectory, if it has ended.
    pub fn take_outcome(&mut self) -> Option<TrajectoryOutcome> {
        self.outcome.take()
    }

    /// Returns true while a trajectory is being followed.
    #[must_use]
    pub fn is_following(&self) -> bool {
        self.followed.as_ref().is_some_and(|followed| followed.is_goal)
    }

    fn read(&mut self, interfaces: &LoanedInterfaces<'_>) {
        let count = self.settings.joints.len();
        let mut actual = TrajectoryPoint::default();
        for (place, kind) in self.settings.state_interfaces.iter().enumerate() {
            let values = (0..count).map(|joint| interfaces.state(place * count + joint)).collect();
            match kind {
                JointInterfaceKind::Position => actual.positions = values,
                JointInterfaceKind::Velocity => actual.velocities = values,
                JointInterfaceKind::Effort => actual.efforts = values,
            }
        }
        self.progress.actual = actual;
    }

    /// Returns the differences of a desired and the measured state.
    fn error(&self, desired: &TrajectoryPoint) -> TrajectoryPoint {
        let actual = &self.progress.actual;
        let difference = |wanted: &[f64], measured: &[f64]| -> Vec<f64> {
            wanted.iter().zip(measured).map(|(wanted, measured)| wanted - measured).collect()
        };
        let mut positions = difference(&desired.positions, &actual.positions);
        for (error, is_continuous) in positions.iter_mut().zip(&self.settings.is_continuous) {
            if *is_continuous {
                *error = libm::remainder(*error, 2.0 * PI);
            }
        }
        TrajectoryPoint {
            positions,
            velocities: difference(&desired.velocities, &actual.velocities),
            accelerations: Vec::new(),
            efforts: Vec::new(),
            time_from_start_ns: 0,
        }
    }

    /// Computes and sets the commands of a desired state.
    fn command(
        &mut self,
        desired: &TrajectoryPoint,
        error: &TrajectoryPoint,
        interfaces: &mut LoanedInterfaces<'_>,
        dt_s: f64,
    ) {
        let count = self.settings.joints.len();
        let mut output = TrajectoryPoint::default();
        let has_position = self.settings.command_interfaces.contains(&JointInterfaceKind::Position);
        for (place, kind) in self.settings.command_interfaces.clone().into_iter().enumerate() {
            let values: Vec<f64> = (0..count)
                .map(|joint| match kind {
                    JointInterfaceKind::Position => desired.positions[joint],
                    JointInterfaceKind::Velocity if has_position => desired.velocities[joint],
                    JointInterfaceKind::Velocity | JointInterfaceKind::Effort => {
                        self.closed_loop(joint, desired, error, dt_s)
                    }
                })
                .collect();
            for (joint, &value) in values.iter().enumerate() {
                interfaces.set_command(place * count + joint, value);
            }
            match kind {
                JointInterfaceKind::Position => output.positions = values,
                JointInterfaceKind::Velocity => output.velocities = values,
                JointInterfaceKind::Effort => output.efforts = values,
            }
        }
        self.last_command = desired.clone();
        self.progress.output = output;
    }

    fn closed_loop(
        &mut self,
        joint: usize,
        desired: &TrajectoryPoint,
        error: &TrajectoryPoint,
        dt_s: f64,
    ) -> f64 {
        let at = |values: &[f64]| values.get(joint).copied().unwrap_or_default();
        let gains = self.settings.gains.get(joint).copied().unwrap_or_default();
        let forward = at(&self.settings.feed_forward) * at(&desired.velocities);
        let Some(pid) = self.pids.get_mut(joint) else { return forward };
        forward + pid.update(&gains, at(&error.positions), at(&error.velocities), dt_s)
    }

    /// Compares a state with the tolerances; returns the joint and the reason of the first excess.
    fn excess(&self, error: &TrajectoryPoint, tolerances: &[JointTolerances]) -> Option<String> {
        let at = |values: &[f64], joint: usize| values.get(joint).copied().unwrap_or_default();
        self.settings.joints.iter().enumerate().find_map(|(joint, name)| {
            let tolerance = tolerances.get(joint).copied().unwrap_or_default();
            let reason =
                tolerance.exceeded(at(&error.positions, joint), at(&error.velocities, joint))?;
            Some(format!("{name}: {reason}"))
        })
    }

    /// Checks the tolerances of the followed trajectory; returns its end, if it has come.
    fn judge(
        &self,
        followed: &Followed,
        phase: SamplePhase,
        error: &TrajectoryPoint,
        cycle: ControlCycle,
    ) -> Option<TrajectoryOutcome> {
        let GoalTolerances { path, goal, goal_time_s } = &followed.tolerances;
        if phase == SamplePhase::Moving {
            let reason = self.excess(error, path)?;
            let code = TrajectoryErrorCode::PathToleranceViolated;
            return Some(TrajectoryOutcome::Failed(code, reason));
        }
        let Some(reason) = self.excess(error, goal) else {
            return Some(TrajectoryOutcome::Reached);
        };
        let late_s = cycle.age_s(followed.trajectory.end_ns());
        (*goal_time_s > 0.0 && late_s > *goal_time_s).then(|| {
            let code = TrajectoryErrorCode::GoalToleranceViolated;
            TrajectoryOutcome::Failed(code, reason)
        })
    }
}

impl ControllerInterface for JointTrajectoryController {
    fn command_interfaces(&self) -> InterfaceSelection {
        let joints = &self.settings.command_joints;
        let kinds = self.settings.command_interfaces.iter();
        let names = kinds.flat_map(|kind| joints.iter().map(|joint| kind.of(joint)));
        InterfaceSelection::Named(names.collect())
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let joints = &self.settings.joints;
        let kinds = self.settings.state_interfaces.iter();
        let names = kinds.flat_map(|kind| joints.iter().map(|joint| kind.of(joint)));
        InterfaceSelection::Named(names.collect())
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        let settings = &self.settings;
        if settings.joints.is_empty() {
            return Err("`joints` is empty".into());
        }
        if settings.joints.len() != settings.command_joints.len() {
            return Err("`command_joints` must have as many joints as `joints`".into());
        }
        if settings.command_interfaces.is_empty() {
            return Err("`command_interfaces` is empty".into());
        }
        if !settings.state_interfaces.contains(&JointInterfaceKind::Position) {
            return Err("`state_interfaces` must contain `position`".into());
        }
        Ok(())
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.read(interfaces);
        if !self.progress.actual.positions.iter().all(|position| position.is_finite()) {
            return Err(ControllerError::Unmeasured(
                "the position of a joint is not a number".into(),
            ));
        }
        self.pids.iter_mut().for_each(PidController::reset);
        self.last_command = TrajectoryPoint::default();
        self.outcome = None;
        self.hold(cycle.time_ns);
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.read(interfaces);
        let Some(followed) = self.followed.take() else { return Ok(()) };
        let Followed { trajectory, before, before_ns, .. } = &followed;
        let interpolates = self.settings.interpolates;
        let sample = trajectory.sample(cycle.time_ns, before, *before_ns, interpolates);
        let Some(sample) = sample else { return Ok(()) };
        let error = self.error(&sample.point);
        self.command(&sample.point, &error, interfaces, cycle.period_s);
        let ends =
            followed.is_goal.then(|| self.judge(&followed, sample.phase, &error, cycle)).flatten();
        self.progress.since_start_ns = cycle.time_ns.saturating_sub(trajectory.start_ns);
        (self.progress.desired, self.progress.error) = (sample.point, error);
        match ends {
            Some(TrajectoryOutcome::Reached) => {
                // The end is held, not the measured state.
                self.followed = Some(Followed { is_goal: false, ..followed });
                self.outcome = Some(TrajectoryOutcome::Reached);
            }
            Some(failed) => {
                self.hold(cycle.time_ns);
                self.outcome = Some(failed);
            }
            None => self.followed = Some(followed),
        }
        Ok(())
    }

    fn deactivate(&mut self, _: &mut LoanedInterfaces<'_>) {
        self.followed = None;
        self.outcome = None;
    }
}

#[cfg(test)]
mod tests;
