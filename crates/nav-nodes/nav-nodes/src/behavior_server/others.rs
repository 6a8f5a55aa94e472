//! Assisted teleoperation and waiting.

use periplus_geometry::Twist2;
use periplus_graph::Node;
use periplus_motion::behaviors::{TeleopProjection, limit_teleop};
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::nav2_msgs_main::{
    AssistedTeleop, AssistedTeleopFeedback, AssistedTeleopGoal, AssistedTeleopResult, Wait,
    WaitFeedback, WaitGoal, WaitResult,
};

use super::behavior::{
    Behavior, CycleOutcome, CycleTime, FailureReason, MotionFailure, Slot, duration,
};
use super::motions::TimeAllowance;
use super::node::Slots;
use super::world::{BehaviorWorld, TeleopInput};

/// Teleoperation that avoids collisions.
#[derive(Default)]
pub(super) struct AssistedTeleopBehavior {
    allowance: TimeAllowance,
}

impl AssistedTeleopBehavior {
    fn step(
        &self,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> Result<CycleOutcome, MotionFailure> {
        self.allowance.check(time)?;
        // The user reports that the robot is where it should be.
        if world.teleop.is_preempted {
            return Ok(CycleOutcome::Succeeded);
        }
        let (pose, command) = (world.pose()?, world.teleop.command);
        let projection = TeleopProjection {
            projection_time_s: world.params.projection_time_s,
            time_step_s: world.params.simulation_time_step_s,
        };
        let velocity = match command {
            Twist2::ZERO => command,
            _ => limit_teleop(command, pose, projection, |pose| world.are_free([pose], node)),
        };
        Ok(CycleOutcome::Running(Some(velocity)))
    }
}

impl Behavior for AssistedTeleopBehavior {
    type Action = AssistedTeleop;
    const MOVES: bool = true;

    fn slots(all: &mut Slots) -> &mut Vec<Slot<Self>> {
        &mut all.teleops
    }

    fn start(
        &mut self,
        goal: &AssistedTeleopGoal,
        world: &mut BehaviorWorld,
        _: i64,
    ) -> Result<(), MotionFailure> {
        self.allowance = TimeAllowance::new(&goal.time_allowance);
        world.teleop.is_preempted = false;
        Ok(())
    }

    fn cycle(
        &mut self,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> (Option<AssistedTeleopFeedback>, CycleOutcome) {
        let current_teleop_duration = duration(time.elapsed_ns);
        let outcome = self.step(world, time, node).unwrap_or_else(CycleOutcome::from);
        (Some(AssistedTeleopFeedback { current_teleop_duration }), outcome)
    }

    fn end(&mut self, world: &mut BehaviorWorld) {
        world.teleop = TeleopInput::default();
    }

    fn result(elapsed: Duration, failure: Option<(FailureReason, String)>) -> AssistedTeleopResult {
        let code = |reason| match reason {
            FailureReason::Timeout => AssistedTeleopResult::TIMEOUT,
            FailureReason::Transform => AssistedTeleopResult::TF_ERROR,
            FailureReason::CollisionAhead | FailureReason::InvalidInput => {
                AssistedTeleopResult::UNKNOWN
            }
        };
        let (error_code, error_msg) =
            failure.map_or((0, String::new()), |(it, text)| (code(it), text));
        AssistedTeleopResult { total_elapsed_time: elapsed, error_code, error_msg }
    }
}

/// Waits for a time of the graph.
#[derive(Default)]
pub(super) struct WaitBehavior {
    end_ns: i64,
}

impl Behavior for WaitBehavior {
    type Action = Wait;
    const MOVES: bool = false;

    fn slots(all: &mut Slots) -> &mut Vec<Slot<Self>> {
        &mut all.waits
    }

    fn start(
        &mut self,
        goal: &WaitGoal,
        _: &mut BehaviorWorld,
        now_ns: i64,
    ) -> Result<(), MotionFailure> {
        self.end_ns = now_ns.saturating_add(goal.time.ns());
        Ok(())
    }

    fn cycle(
        &mut self,
        _: &mut BehaviorWorld,
        time: CycleTime,
        _: &Node,
    ) -> (Option<WaitFeedback>, CycleOutcome) {
        let left_ns = self.end_ns - time.now_ns;
        let outcome =
            if left_ns > 0 { CycleOutcome::Running(None) } else { CycleOutcome::Succeeded };
        (Some(WaitFeedback { time_left: duration(left_ns) }), outcome)
    }

    fn result(elapsed: Duration, failure: Option<(FailureReason, String)>) -> WaitResult {
        let code = |reason| match reason {
            FailureReason::Timeout => WaitResult::TIMEOUT,
            _ => WaitResult::UNKNOWN,
        };
        let (error_code, error_msg) =
            failure.map_or((0, String::new()), |(it, text)| (code(it), text));
        WaitResult { total_elapsed_time: elapsed, error_code, error_msg }
    }
}
