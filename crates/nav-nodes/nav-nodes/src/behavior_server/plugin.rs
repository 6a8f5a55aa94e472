//! Behaviors of other authors, which are registered in [`crate::navigation_plugins::NavigationPlugins`].

use std::fmt;
use std::marker::PhantomData;

use periplus_geometry::Pose2;
use periplus_graph::Node;
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::nav2_msgs_main::{BackUpGoal, DriveOnHeadingGoal, SpinGoal, WaitGoal};
use periplus_msgs::{Action, Nav2Action};

use super::behavior::{Behavior, CycleOutcome, CycleTime, FailureReason, MotionFailure, Slot};
use super::motions::{BackUpBehavior, DriveOnHeadingBehavior, SpinBehavior};
use super::node::Slots;
use super::others::WaitBehavior;
use super::world::BehaviorWorld;

/// Action that a behavior of another author serves under its name. The tree node of the action calls it:
/// `<Spin server_name="wiggle" spin_dist="1.0"/>`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BehaviorAction {
    /// `nav2_msgs/action/Spin`.
    Spin,
    /// `nav2_msgs/action/BackUp`.
    BackUp,
    /// `nav2_msgs/action/DriveOnHeading`.
    DriveOnHeading,
    /// `nav2_msgs/action/Wait`.
    Wait,
}

impl BehaviorAction {
    /// Action of a name, such as `DriveOnHeading`.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        [Self::Spin, Self::BackUp, Self::DriveOnHeading, Self::Wait]
            .into_iter()
            .find(|action| action.name() == name)
    }

    /// Name of the action.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Spin => "Spin",
            Self::BackUp => "BackUp",
            Self::DriveOnHeading => "DriveOnHeading",
            Self::Wait => "Wait",
        }
    }
}

/// Goal of a behavior.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BehaviorGoal<'a> {
    /// Goal of `Spin`.
    Spin(&'a SpinGoal),
    /// Goal of `BackUp`.
    BackUp(&'a BackUpGoal),
    /// Goal of `DriveOnHeading`.
    DriveOnHeading(&'a DriveOnHeadingGoal),
    /// Goal of `Wait`.
    Wait(&'a WaitGoal),
}

/// Robot and surroundings in a cycle of a behavior.
pub struct BehaviorInput<'a> {
    world: &'a mut BehaviorWorld,
    time: CycleTime,
    node: &'a Node,
}

impl BehaviorInput<'_> {
    /// Time of the cycle \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.time.now_ns
    }

    /// Time since the start of the goal \[ns\].
    #[must_use]
    pub fn elapsed_ns(&self) -> i64 {
        self.time.elapsed_ns
    }

    /// Newest pose of the robot in the local frame of the server.
    ///
    /// # Errors
    /// When the transform is not available.
    pub fn pose(&self) -> Result<Pose2, MotionFailure> {
        self.world.pose()
    }

    /// Returns true if the footprint of the robot touches no obstacle at any of these poses, in the local frame.
    /// Without a costmap it touches one everywhere.
    pub fn are_free(&mut self, poses: impl IntoIterator<Item = Pose2>) -> bool {
        self.world.are_free(poses, self.node)
    }
}

/// A behavior: one goal at a time, cycle by cycle.
pub trait BehaviorPlugin: Send {
    /// Starts a goal.
    ///
    /// # Errors
    /// The reason why it cannot be executed.
    fn on_run(&mut self, goal: BehaviorGoal<'_>) -> Result<(), MotionFailure>;

    /// Executes a cycle. The server publishes the velocity, and zero at the end of the goal.
    fn on_cycle(&mut self, input: &mut BehaviorInput<'_>) -> CycleOutcome;

    /// Ends a goal, also a canceled one.
    fn on_end(&mut self) {}
}

/// Behavior of a registered class.
pub struct RegisteredBehavior {
    /// Name, which is that of its action.
    pub name: String,
    /// Action.
    pub action: BehaviorAction,
    /// The behavior.
    pub plugin: Box<dyn BehaviorPlugin>,
}

impl fmt::Debug for RegisteredBehavior {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RegisteredBehavior")
            .field("name", &self.name)
            .field("action", &self.action)
            .finish_non_exhaustive()
    }
}

/// Behavior of Nav2 whose action behaviors of others may serve.
pub(super) trait PluginAction: Behavior {
    fn goal(goal: &<Self::Action as Action>::Goal) -> BehaviorGoal<'_>;
    fn plugin_slots(all: &mut PluginSlots) -> &mut Vec<Slot<PluginBehavior<Self>>>;
}

/// Behaviors of others by their actions.
#[derive(Default)]
pub(super) struct PluginSlots {
    pub(super) spins: Vec<Slot<PluginBehavior<SpinBehavior>>>,
    pub(super) backups: Vec<Slot<PluginBehavior<BackUpBehavior>>>,
    pub(super) drives: Vec<Slot<PluginBehavior<DriveOnHeadingBehavior>>>,
    pub(super) waits: Vec<Slot<PluginBehavior<WaitBehavior>>>,
}

macro_rules! plugin_action {
    ($behavior:ident $goal:ident $variant:ident $slots:ident) => {
        impl PluginAction for $behavior {
            fn goal(goal: &$goal) -> BehaviorGoal<'_> {
                BehaviorGoal::$variant(goal)
            }

            fn plugin_slots(all: &mut PluginSlots) -> &mut Vec<Slot<PluginBehavior<Self>>> {
                &mut all.$slots
            }
        }
    };
}

plugin_action!(SpinBehavior SpinGoal Spin spins);
plugin_action!(BackUpBehavior BackUpGoal BackUp backups);
plugin_action!(DriveOnHeadingBehavior DriveOnHeadingGoal DriveOnHeading drives);
plugin_action!(WaitBehavior WaitGoal Wait waits);

/// Behavior of another author that serves the action of `B`.
pub(super) struct PluginBehavior<B> {
    plugin: Box<dyn BehaviorPlugin>,
    action: PhantomData<fn() -> B>,
}

impl<B> PluginBehavior<B> {
    pub(super) fn new(plugin: Box<dyn BehaviorPlugin>) -> Self {
        Self { plugin, action: PhantomData }
    }
}

impl<B: PluginAction> Behavior for PluginBehavior<B>
where
    B::Action: Nav2Action,
{
    type Action = B::Action;
    const MOVES: bool = true;

    fn slots(all: &mut Slots) -> &mut Vec<Slot<Self>> {
        B::plugin_slots(&mut all.plugins)
    }

    fn start(
        &mut self,
        goal: &<B::Action as Action>::Goal,
        _: &mut BehaviorWorld,
        _: i64,
    ) -> Result<(), MotionFailure> {
        self.plugin.on_run(B::goal(goal))
    }

    fn cycle(
        &mut self,
        world: &mut BehaviorWorld,
        time: CycleTime,
        node: &Node,
    ) -> (Option<<B::Action as Action>::Feedback>, CycleOutcome) {
        (None, self.plugin.on_cycle(&mut BehaviorInput { world, time, node }))
    }

    fn end(&mut self, _: &mut BehaviorWorld) {
        self.plugin.on_end();
    }

    fn result(
        elapsed: Duration,
        failure: Option<(FailureReason, String)>,
    ) -> <B::Action as Action>::Result {
        B::result(elapsed, failure)
    }
}
