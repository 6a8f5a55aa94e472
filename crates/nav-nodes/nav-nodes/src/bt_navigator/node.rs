//! Node of the navigator.

use std::sync::Arc;

use periplus_costmap::Nav2Release;
use periplus_graph::{
    ActionSettings, Actor, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node,
    Publisher, Qos, StepOutcome,
};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav2_msgs_main::{NavigateToPose, NavigateToPoseGoal};
use periplus_msgs::std_msgs;
use periplus_params::ParamValues;

use super::kinds::{ThroughPoses, ToPose};
use super::loading::TreeLoader;
use super::navigator::{Environment, Navigator, NavigatorKind};
use super::parameters::BtNavigatorParams;
use super::shared::Shared;
use super::status::NavigatorStatus;
use super::tree_nodes::registry;
use crate::Files;
use crate::nav2_actions::{Nav2ActionClient, Nav2SentGoal};
use crate::navigation_plugins::NavigationPlugins;
use crate::simple_action_server::serve_simple_action;

/// Navigator as a lifecycle node: it executes behavior trees for goals.
///
/// Actions `navigate_to_pose` and `navigate_through_poses`; a pose on `goal_pose` becomes a goal of the
/// former. Publishes `behavior_tree_log` and, not in Nav2, `~/status_reason`: what the navigator does and
/// why, in one sentence.
pub struct BtNavigator {
    env: Environment,
    to_pose: Navigator<ToPose>,
    through_poses: Navigator<ThroughPoses>,
    reason: Option<Publisher<std_msgs::String>>,
    /// Last published reason.
    published: String,
    /// Client of the own action, for `goal_pose`.
    client: Option<Nav2ActionClient<NavigateToPose>>,
    /// Goal of `goal_pose`, so that its answers have a receiver.
    sent: Option<Nav2SentGoal<NavigateToPose>>,
}

/// Navigator of a kind in the state of the node.
trait Find<K: NavigatorKind> {
    fn find(&mut self) -> &mut Navigator<K>;
    /// True if another navigator has a goal.
    fn is_other_navigating(&self) -> bool;
}

impl Find<ToPose> for BtNavigator {
    fn find(&mut self) -> &mut Navigator<ToPose> {
        &mut self.to_pose
    }

    fn is_other_navigating(&self) -> bool {
        self.through_poses.is_navigating()
    }
}

impl Find<ThroughPoses> for BtNavigator {
    fn find(&mut self) -> &mut Navigator<ThroughPoses> {
        &mut self.through_poses
    }

    fn is_other_navigating(&self) -> bool {
        self.to_pose.is_navigating()
    }
}

impl BtNavigator {
    /// Creates the navigator on a node, with the behaviour and the messages of a release. Trees are read
    /// through `files`.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn new(
        node: &Node,
        values: ParamValues,
        release: Nav2Release,
        files: Arc<dyn Files>,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        Self::with_plugins(node, values, release, files, &NavigationPlugins::new())
    }

    /// Creates the navigator as [`Self::new`] does, with tree nodes of other authors.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn with_plugins(
        node: &Node,
        values: ParamValues,
        release: Nav2Release,
        files: Arc<dyn Files>,
        plugins: &NavigationPlugins,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let parameters = node.parameters(values)?;
        let params = BtNavigatorParams::from_values(&parameters.values());
        let (period_ns, result_timeout_ns) =
            (params.loop_duration_ns(), params.result_timeout_ns());
        let names = params.navigators.clone();
        let shared = Arc::new(Shared::new(node, release, params)?);
        let mut registry = registry(&shared);
        plugins.register_nodes(&mut registry);
        let loader = Arc::new(TreeLoader { files, registry });
        let mut actor = node.actor(Self {
            env: Environment { shared, loader, log: None },
            to_pose: Navigator::default(),
            through_poses: Navigator::default(),
            reason: None,
            published: String::new(),
            client: None,
            sent: None,
        });
        let settings = ActionSettings { result_timeout_ns };
        if names.iter().any(|name| name == ToPose::NAME) {
            serve::<ToPose>(&mut actor, release, settings)?;
            actor.subscribe::<PoseStamped>("goal_pose", Qos::reliable(10), |state, pose, _| {
                state.send_to_self(&pose);
            })?;
        }
        if names.iter().any(|name| name == ThroughPoses::NAME) {
            serve::<ThroughPoses>(&mut actor, release, settings)?;
        }
        actor.timer(period_ns, |state, io| state.tick(io.now_ns()))?;
        actor.on_jump(|state, _| state.env.shared.forget());
        LifecycleNode::new(actor)
    }

    /// Activity and the reason for it.
    #[must_use]
    pub fn status(&self) -> NavigatorStatus {
        let running = self.to_pose.status().or_else(|| self.through_poses.status());
        let mut status = running.unwrap_or_default();
        status.last_error = self.env.shared.last_error();
        status.last_outcome = self.env.shared.last_outcome();
        status
    }

    fn tick(&mut self, now_ns: i64) {
        self.env.shared.receive();
        let env = self.env.clone();
        self.to_pose.tick(&env, now_ns);
        self.through_poses.tick(&env, now_ns);
        self.publish_reason();
    }

    fn publish_reason(&mut self) {
        let Some(publisher) = &self.reason else { return };
        let reason = self.status().to_string();
        if reason != self.published {
            publisher.publish(std_msgs::String { data: reason.clone() });
            self.published = reason;
        }
    }

    fn send_to_self(&mut self, pose: &PoseStamped) {
        if let Some(client) = &self.client {
            let goal = NavigateToPoseGoal { pose: pose.clone(), behavior_tree: String::new() };
            self.sent = Some(client.send(goal));
        }
    }

    fn navigators(&self) -> Vec<String> {
        self.env.shared.params.navigators.clone()
    }

    fn configure(&mut self, node: &Node) -> Result<(), String> {
        let known = [ToPose::NAME, ThroughPoses::NAME];
        if let Some(other) = self.navigators().iter().find(|name| !known.contains(&name.as_str())) {
            return Err(format!(
                "there is no navigator `{other}`; known navigators: {}",
                known.join(", ")
            ));
        }
        let text = |error: GraphError| error.to_string();
        let log = node.publisher("behavior_tree_log", Qos::reliable(10)).map_err(text)?;
        self.env.log = Some(Arc::new(log));
        self.reason = Some(node.publisher("~/status_reason", Qos::latched(1)).map_err(text)?);
        let release = self.env.shared.release;
        if self.navigators().iter().any(|name| name == ToPose::NAME) {
            let client = Nav2ActionClient::new(node, release, ToPose::NAME);
            self.client = Some(client.map_err(text)?);
        }
        Ok(())
    }

    fn activate<K: NavigatorKind>(&mut self, node: &Node) -> bool
    where
        Self: Find<K>,
    {
        if !self.navigators().iter().any(|name| name == K::NAME) {
            return true;
        }
        let env = self.env.clone();
        match Find::<K>::find(self).activate(&env) {
            Ok(()) => true,
            Err(errors) => {
                for error in errors {
                    node.log(
                        Level::Error,
                        format!("Error loading the tree of {}: {error}", K::NAME),
                    );
                }
                false
            }
        }
    }
}

/// Serves the action of a navigator.
fn serve<K: NavigatorKind>(
    actor: &mut Actor<BtNavigator>,
    release: Nav2Release,
    settings: ActionSettings,
) -> Result<(), GraphError>
where
    BtNavigator: Find<K>,
{
    serve_simple_action::<K::Action, BtNavigator>(
        actor,
        release,
        K::NAME,
        settings,
        |state| Some(&mut Find::<K>::find(state).server),
        |state, goal, _| {
            if Find::<K>::is_other_navigating(state) {
                return Err("another navigator has a goal".to_owned());
            }
            // Before main such a goal is accepted and then aborted.
            if state.env.shared.release < Nav2Release::Main {
                return Ok(());
            }
            Navigator::<K>::check(&state.env.shared, goal).map(drop)
        },
        |state, io| {
            let env = state.env.clone();
            Find::<K>::find(state).start(&env, io.now_ns());
            state.publish_reason();
        },
    )
}

impl LifecycleCallbacks for BtNavigator {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        match self.configure(io.node()) {
            Ok(()) => StepOutcome::Success,
            Err(error) => {
                io.node().log(Level::Error, error);
                StepOutcome::Failure
            }
        }
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let is_active =
            self.activate::<ToPose>(io.node()) && self.activate::<ThroughPoses>(io.node());
        if !is_active {
            self.on_deactivate(io);
            return StepOutcome::Failure;
        }
        self.publish_reason();
        StepOutcome::Success
    }

    fn on_deactivate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let env = self.env.clone();
        self.to_pose.deactivate(&env, io.now_ns());
        self.through_poses.deactivate(&env, io.now_ns());
        self.env.shared.forget_canceling();
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        // A node may be shut down while it is active.
        self.on_deactivate(io);
        self.to_pose.cleanup();
        self.through_poses.cleanup();
        (self.client, self.sent, self.reason, self.env.log) = (None, None, None, None);
        StepOutcome::Success
    }
}
