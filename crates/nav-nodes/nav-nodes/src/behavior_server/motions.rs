//! Behaviors that move the robot by themselves: spin, back up, drive on heading.

use periplus_geometry::{Pose2, Twist2, normalize_angle};
use periplus_graph::Node;
use periplus_motion::behaviors::{DriveLimits, InvalidDrive, Spin, SpinLimits, StraightDrive};
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::Point;
use periplus_msgs::nav2_msgs_main::{
    BackUp, BackUpFeedback, BackUpGoal, BackUpResult, DriveOnHeading, DriveOnHeadingFeedback,
    DriveOnHeadingGoal, DriveOnHeadingResult, Spin as SpinAction, SpinFeedback, SpinGoal,
    SpinResult,
};

use super::behavior::{Behavior, CycleOutcome, CycleTime, FailureReason, MotionFailure, Slot};
use super::node::Slots;
use super::world::BehaviorWorld;

/// Failure because of an obstacle.
fn collision_ahead() -> CycleOutcome {
    let text = "an obstacle is ahead, or unknown space".to_owned();
    MotionFailure { reason: FailureReason::CollisionAhead, text }.into()
}

/// Time that a goal may take; 0 for any.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TimeAllowance(i64);

impl TimeAllowance {
    pub(super) fn new(allowance: &Duration) -> Self {
        Self(allowance.ns())
    }

    /// # Errors
    /// The failure once the time is over.
    pub(super) fn check(self, time: CycleTime) -> Result<(), MotionFailure> {
        if self.0 > 0 && time.elapsed_ns > self.0 {
            let seconds = self.0 as f64 * 1e-9;
            let text = format!("the goal was not reached within {seconds} s (`time_allowance`)");
            return Err(MotionFailure { reason: FailureReason::Timeout, text });
        }
        Ok(())
    }
}

/// Rotation in place.
#[derive(Default)]
pub(super) struct SpinBehavior {
    running: Option<Spin>,
    allowance: TimeAllowance,
    checks_collisions: bool,
}

impl SpinBehavior {
    fn step(
        &mut self,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> Result<(f64, CycleOutcome), MotionFailure> {
        self.allowance.check(time)?;
        let pose = world.pose()?;
        let Some(spin) = &mut self.running else { return Ok((0.0, CycleOutcome::Succeeded)) };
        spin.update(normalize_angle(pose.yaw_rad));
        let turned_rad = spin.turned_rad();
        let params = &world.params;
        let limits = SpinLimits {
            min_rad_s: params.min_rotational_vel_rad_s,
            max_rad_s: params.max_rotational_vel_rad_s,
            acc_rad_s2: params.rotational_acc_lim_rad_s2,
        };
        let Some(velocity_rad_s) = spin.velocity_rad_s(&limits) else {
            return Ok((turned_rad, CycleOutcome::Succeeded));
        };
        let (hertz, ahead_s) = (params.cycle_frequency_hz, params.simulate_ahead_time_s);
        let poses = spin.poses_ahead(pose, velocity_rad_s, hertz, ahead_s);
        if self.checks_collisions && !world.is_motion_free(poses, node) {
            return Ok((turned_rad, collision_ahead()));
        }
        let velocity = Twist2::new(0.0, 0.0, velocity_rad_s);
        Ok((turned_rad, CycleOutcome::Running(Some(velocity))))
    }
}

impl Behavior for SpinBehavior {
    type Action = SpinAction;
    const MOVES: bool = true;

    fn slots(all: &mut Slots) -> &mut Vec<Slot<Self>> {
        &mut all.spins
    }

    fn start(
        &mut self,
        goal: &SpinGoal,
        world: &mut BehaviorWorld,
        _: i64,
    ) -> Result<(), MotionFailure> {
        if !goal.target_yaw.is_finite() {
            let text = "`target_yaw` must be a finite number".to_owned();
            return Err(MotionFailure { reason: FailureReason::InvalidInput, text });
        }
        let yaw_rad = normalize_angle(world.pose()?.yaw_rad);
        self.running = Some(Spin::new(f64::from(goal.target_yaw), yaw_rad));
        self.allowance = TimeAllowance::new(&goal.time_allowance);
        self.checks_collisions = !goal.disable_collision_checks;
        Ok(())
    }

    fn cycle(
        &mut self,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> (Option<SpinFeedback>, CycleOutcome) {
        match self.step(world, time, node) {
            Ok((turned_rad, outcome)) => {
                let feedback = SpinFeedback { angular_distance_traveled: turned_rad as f32 };
                (Some(feedback), outcome)
            }
            Err(failure) => (None, failure.into()),
        }
    }

    fn result(elapsed: Duration, failure: Option<(FailureReason, String)>) -> SpinResult {
        let code = |reason| match reason {
            FailureReason::Timeout => SpinResult::TIMEOUT,
            FailureReason::Transform => SpinResult::TF_ERROR,
            FailureReason::CollisionAhead => SpinResult::COLLISION_AHEAD,
            FailureReason::InvalidInput => SpinResult::UNKNOWN,
        };
        let (error_code, error_msg) =
            failure.map_or((0, String::new()), |(it, text)| (code(it), text));
        SpinResult { total_elapsed_time: elapsed, error_code, error_msg }
    }
}

/// Straight drive that runs.
struct RunningDrive {
    drive: StraightDrive,
    start: Pose2,
    last_m_s: f64,
    allowance: TimeAllowance,
    checks_collisions: bool,
}

impl RunningDrive {
    fn start(
        drive: Result<StraightDrive, InvalidDrive>,
        allowance: &Duration,
        checks_collisions: bool,
        world: &BehaviorWorld,
    ) -> Result<Self, MotionFailure> {
        let drive = drive.map_err(|error| MotionFailure {
            reason: FailureReason::InvalidInput,
            text: error.to_string(),
        })?;
        let (start, allowance) = (world.pose()?, TimeAllowance::new(allowance));
        Ok(Self { drive, start, last_m_s: 0.0, allowance, checks_collisions })
    }

    /// Distance and outcome of a cycle.
    fn step(
        &mut self,
        limits: &DriveLimits,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> Result<(f64, CycleOutcome), MotionFailure> {
        self.allowance.check(time)?;
        let pose = world.pose()?;
        let travelled_m = libm::hypot(pose.x_m - self.start.x_m, pose.y_m - self.start.y_m);
        let hertz = world.params.cycle_frequency_hz;
        let velocity = self.drive.velocity_m_s(travelled_m, self.last_m_s, hertz, limits);
        let Some(velocity_m_s) = velocity else {
            return Ok((travelled_m, CycleOutcome::Succeeded));
        };
        let ahead_s = world.params.simulate_ahead_time_s;
        let poses = self.drive.poses_ahead(pose, travelled_m, velocity_m_s, hertz, ahead_s);
        if self.checks_collisions && !world.is_motion_free(poses, node) {
            return Ok((travelled_m, collision_ahead()));
        }
        self.last_m_s = velocity_m_s;
        let velocity = Twist2::new(velocity_m_s, 0.0, 0.0);
        Ok((travelled_m, CycleOutcome::Running(Some(velocity))))
    }
}

fn xyz(point: &Point) -> [f64; 3] {
    [point.x, point.y, point.z]
}

/// Drive backward.
pub(super) struct BackUpBehavior {
    pub(super) limits: DriveLimits,
    running: Option<RunningDrive>,
}

/// Drive in the direction of the heading.
pub(super) struct DriveOnHeadingBehavior {
    pub(super) limits: DriveLimits,
    running: Option<RunningDrive>,
}

impl BackUpBehavior {
    pub(super) fn new(limits: DriveLimits) -> Self {
        Self { limits, running: None }
    }
}

impl DriveOnHeadingBehavior {
    pub(super) fn new(limits: DriveLimits) -> Self {
        Self { limits, running: None }
    }
}

/// Executes a cycle of a drive; the distance is missing if there is none.
fn step(
    running: &mut Option<RunningDrive>,
    limits: &DriveLimits,
    world: &mut BehaviorWorld,
    time: CycleTime,
    node: &Node,
) -> (Option<f32>, CycleOutcome) {
    let Some(drive) = running else { return (None, CycleOutcome::Succeeded) };
    match drive.step(limits, world, time, node) {
        Ok((travelled_m, outcome)) => (Some(travelled_m as f32), outcome),
        Err(failure) => (None, failure.into()),
    }
}

impl Behavior for BackUpBehavior {
    type Action = BackUp;
    const MOVES: bool = true;

    fn slots(all: &mut Slots) -> &mut Vec<Slot<Self>> {
        &mut all.backups
    }

    fn start(
        &mut self,
        goal: &BackUpGoal,
        world: &mut BehaviorWorld,
        _: i64,
    ) -> Result<(), MotionFailure> {
        let drive = StraightDrive::backward(xyz(&goal.target), f64::from(goal.speed));
        let checks = !goal.disable_collision_checks;
        self.running = Some(RunningDrive::start(drive, &goal.time_allowance, checks, world)?);
        Ok(())
    }

    fn cycle(
        &mut self,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> (Option<BackUpFeedback>, CycleOutcome) {
        let (travelled, outcome) = step(&mut self.running, &self.limits, world, time, node);
        (travelled.map(|distance_traveled| BackUpFeedback { distance_traveled }), outcome)
    }

    fn end(&mut self, _: &mut BehaviorWorld) {
        self.running = None;
    }

    fn result(elapsed: Duration, failure: Option<(FailureReason, String)>) -> BackUpResult {
        let code = |reason| match reason {
            FailureReason::Timeout => BackUpResult::TIMEOUT,
            FailureReason::Transform => BackUpResult::TF_ERROR,
            FailureReason::CollisionAhead => BackUpResult::COLLISION_AHEAD,
            FailureReason::InvalidInput => BackUpResult::INVALID_INPUT,
        };
        let (error_code, error_msg) =
            failure.map_or((0, String::new()), |(it, text)| (code(it), text));
        BackUpResult { total_elapsed_time: elapsed, error_code, error_msg }
    }
}

impl Behavior for DriveOnHeadingBehavior {
    type Action = DriveOnHeading;
    const MOVES: bool = true;

    fn slots(all: &mut Slots) -> &mut Vec<Slot<Self>> {
        &mut all.drives
    }

    fn start(
        &mut self,
        goal: &DriveOnHeadingGoal,
        world: &mut BehaviorWorld,
        _: i64,
    ) -> Result<(), MotionFailure> {
        let drive = StraightDrive::on_heading(xyz(&goal.target), f64::from(goal.speed));
        let checks = !goal.disable_collision_checks;
        self.running = Some(RunningDrive::start(drive, &goal.time_allowance, checks, world)?);
        Ok(())
    }

    fn cycle(
        &mut self,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> (Option<DriveOnHeadingFeedback>, CycleOutcome) {
        let (travelled, outcome) = step(&mut self.running, &self.limits, world, time, node);
        (travelled.map(|distance_traveled| DriveOnHeadingFeedback { distance_traveled }), outcome)
    }

    fn end(&mut self, _: &mut BehaviorWorld) {
        self.running = None;
    }

    fn result(elapsed: Duration, failure: Option<(FailureReason, String)>) -> DriveOnHeadingResult {
        let code = |reason| match reason {
            FailureReason::Timeout => DriveOnHeadingResult::TIMEOUT,
            FailureReason::Transform => DriveOnHeadingResult::TF_ERROR,
            FailureReason::CollisionAhead => DriveOnHeadingResult::COLLISION_AHEAD,
            FailureReason::InvalidInput => DriveOnHeadingResult::INVALID_INPUT,
        };
        let (error_code, error_msg) =
            failure.map_or((0, String::new()), |(it, text)| (code(it), text));
        DriveOnHeadingResult { total_elapsed_time: elapsed, error_code, error_msg }
    }
}
