//! Execution of a behavior: one cycle after the other, until it ends.

use periplus_costmap::Nav2Release;
use periplus_geometry::Twist2;
use periplus_graph::{Alarm, Io, Level, Node};
use periplus_msgs::builtin_interfaces::{Duration, Time};
use periplus_msgs::{Action, Nav2Action};

use crate::loop_rate::LoopRate;
use crate::simple_action_server::SimpleActionServer;

use super::node::{BehaviorServerNode, Slots};
use super::world::BehaviorWorld;

/// Reason of a failure; each action has its own code for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FailureReason {
    /// The time allowance is over.
    Timeout,
    /// The pose of the robot is not available.
    Transform,
    /// The goal cannot be executed.
    InvalidInput,
    /// An obstacle is ahead.
    CollisionAhead,
}

/// Failure of a behavior.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MotionFailure {
    /// Reason, from which the error code of the action follows.
    pub reason: FailureReason,
    /// Description for users.
    pub text: String,
}

/// Result of a cycle of a behavior.
#[derive(Clone, Debug, PartialEq)]
pub enum CycleOutcome {
    /// The behavior goes on, with a velocity; none for behaviors that do not move the robot.
    Running(Option<Twist2>),
    /// The behavior is complete.
    Succeeded,
    /// The behavior cannot go on.
    Failed(MotionFailure),
}

impl From<MotionFailure> for CycleOutcome {
    fn from(failure: MotionFailure) -> Self {
        Self::Failed(failure)
    }
}

/// Times of a cycle \[ns\].
#[derive(Clone, Copy)]
pub(super) struct CycleTime {
    pub(super) now_ns: i64,
    /// Time since the start of the goal.
    pub(super) elapsed_ns: i64,
}

/// Feedback of an action.
type FeedbackOf<B> = <<B as Behavior>::Action as Action>::Feedback;
type GoalOf<B> = <<B as Behavior>::Action as Action>::Goal;
type ResultOf<B> = <<B as Behavior>::Action as Action>::Result;

/// A behavior of one action.
pub(super) trait Behavior: Sized + Send + 'static {
    /// Its action, in the form of main.
    type Action: Nav2Action;
    /// True if it moves the robot, which then has to be stopped at its end.
    const MOVES: bool;

    /// The behaviors of this kind.
    fn slots(all: &mut Slots) -> &mut Vec<Slot<Self>>;

    /// Starts a goal.
    fn start(
        &mut self,
        goal: &GoalOf<Self>,
        world: &mut BehaviorWorld,
        now_ns: i64,
    ) -> Result<(), MotionFailure>;

    /// Executes a cycle.
    fn cycle(
        &mut self,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> (Option<FeedbackOf<Self>>, CycleOutcome);

    /// Ends a goal, however it ended.
    fn end(&mut self, _world: &mut BehaviorWorld) {}

    /// Result after a time, with the failure and its text.
    fn result(elapsed: Duration, failure: Option<(FailureReason, String)>) -> ResultOf<Self>;
}

/// A behavior with its action server.
pub(super) struct Slot<B: Behavior> {
    pub(super) name: String,
    pub(super) behavior: B,
    pub(super) server: SimpleActionServer<B::Action>,
    started_ns: i64,
    /// Next cycle of the running goal.
    next: Option<Alarm>,
}

impl<B: Behavior> Slot<B> {
    pub(super) fn new(name: &str, behavior: B) -> Self {
        Self {
            name: name.to_owned(),
            behavior,
            server: SimpleActionServer::default(),
            started_ns: 0,
            next: None,
        }
    }

    /// Rejects goals from now on. Returns true if the robot has to be stopped.
    pub(super) fn deactivate(&mut self, world: &mut BehaviorWorld) -> bool {
        self.next = None;
        let was_running = self.server.deactivate();
        if was_running {
            self.behavior.end(world);
        }
        was_running && B::MOVES
    }
}

/// Duration of a time span \[ns\].
pub(super) fn duration(span_ns: i64) -> Duration {
    let Time { sec, nanosec } = Time::of_ns(span_ns.max(0));
    Duration { sec, nanosec }
}

/// Starts the current goal of a behavior, and its first cycle.
pub(super) fn begin<B: Behavior>(
    state: &mut BehaviorServerNode,
    index: usize,
    io: &Io<'_, BehaviorServerNode>,
) {
    let now_ns = io.now_ns();
    loop {
        let world = &mut state.world;
        let Some(slot) = B::slots(&mut state.slots).get_mut(index) else { return };
        world.receive(io.node());
        if let Some(goal) = slot.server.current_goal() {
            match slot.behavior.start(&goal, world, now_ns) {
                Ok(()) => {
                    io.node().log(Level::Info, format_args!("running `{}`", slot.name));
                    slot.started_ns = now_ns;
                    let rate = LoopRate::of_hertz(world.params.cycle_frequency_hz, now_ns);
                    return cycle::<B>(state, index, rate, io);
                }
                Err(MotionFailure { reason, text }) => {
                    let text_of_log = format!("`{}` does not start: {text}", slot.name);
                    io.node().log(Level::Warn, text_of_log);
                    let failure = Some((reason, text));
                    slot.server.terminate_current(B::result(Duration::default(), failure));
                }
            }
        }
        if !slot.server.finish() {
            return;
        }
    }
}

/// End of a goal.
enum GoalEnd {
    Preempted,
    Canceled,
    Succeeded,
    Failed(MotionFailure),
}

/// Executes a cycle, and schedules the next one or ends the goal.
fn cycle<B: Behavior>(
    state: &mut BehaviorServerNode,
    index: usize,
    mut rate: LoopRate,
    io: &Io<'_, BehaviorServerNode>,
) {
    let (now_ns, node, world) = (io.now_ns(), io.node(), &mut state.world);
    let Some(slot) = B::slots(&mut state.slots).get_mut(index) else { return };
    slot.next = None;
    let elapsed_ns = now_ns - slot.started_ns;
    let end = match interruption(&slot.server, world.release()) {
        Some(end) => end,
        None => {
            world.receive(node);
            let time = CycleTime { now_ns, elapsed_ns };
            let (feedback, outcome) = slot.behavior.cycle(world, time, node);
            if let Some(feedback) = feedback {
                slot.server.publish_feedback(feedback);
            }
            match outcome {
                CycleOutcome::Running(velocity) => {
                    if let Some(velocity) = velocity {
                        world.drive(velocity, now_ns);
                    }
                    let next_ns = rate.next(now_ns);
                    let alarm =
                        io.alarm(next_ns, move |state, io| cycle::<B>(state, index, rate, io));
                    slot.next = Some(alarm);
                    return;
                }
                CycleOutcome::Succeeded => GoalEnd::Succeeded,
                CycleOutcome::Failed(failure) => GoalEnd::Failed(failure),
            }
        }
    };
    if B::MOVES {
        world.drive(Twist2::ZERO, now_ns);
    }
    slot.behavior.end(world);
    let name = &slot.name;
    let elapsed = duration(elapsed_ns);
    match end {
        GoalEnd::Preempted => {
            let text = format!("`{name}` is stopped: a new goal arrived");
            node.log(Level::Warn, text);
            slot.server.terminate_current(B::result(elapsed, None));
        }
        GoalEnd::Canceled => {
            node.log(Level::Info, format_args!("`{name}` is canceled"));
            slot.server.terminate_all(B::result(elapsed, None));
        }
        GoalEnd::Succeeded => {
            node.log(Level::Info, format_args!("`{name}` succeeded"));
            slot.server.succeeded_current(B::result(elapsed, None));
        }
        GoalEnd::Failed(MotionFailure { reason, text }) => {
            let text = format!("{name} failed: {text}");
            node.log(Level::Warn, &text);
            slot.server.terminate_current(B::result(elapsed, Some((reason, text))));
        }
    }
    if slot.server.finish() {
        begin::<B>(state, index, io);
    }
}

/// Request to end a goal. Humble looks for cancellation first, later releases for a new goal.
fn interruption<A: Action>(
    server: &SimpleActionServer<A>,
    release: Nav2Release,
) -> Option<GoalEnd> {
    let canceled = server.is_cancel_requested().then_some(GoalEnd::Canceled);
    let preempted = server.is_preempt_requested().then_some(GoalEnd::Preempted);
    if release == Nav2Release::Humble { canceled.or(preempted) } else { preempted.or(canceled) }
}
