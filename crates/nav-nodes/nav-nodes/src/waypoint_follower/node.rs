//! Lifecycle node of the waypoint follower.

use periplus_costmap::Nav2Release;
use periplus_graph::{
    ActionSettings, Actor, Client, Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode,
    Node, NodeSettings, Qos, StepOutcome,
};
use periplus_msgs::nav2_msgs_main::{FollowGPSWaypoints, FollowWaypoints, NavigateToPose};
use periplus_msgs::robot_localization::FromLL;
use periplus_msgs::std_msgs::Empty;
use periplus_params::ParamValues;
use periplus_tf_ros::LogThrottle;

use crate::nav2_actions::Nav2ActionClient;
use crate::simple_action_server::serve_simple_action;

use super::actions::FollowAction;
use super::config::{
    InputAtWaypointParams, PhotoAtWaypointParams, TaskKind, WaypointFollowerConfig,
    WaypointFollowerParams,
};
use super::follow::{Follower, begin};
use super::tasks::{SavePhoto, WaypointTask};

/// Waypoint follower as a lifecycle node.
pub struct WaypointFollowerNode {
    config: WaypointFollowerConfig,
    pub(super) params: WaypointFollowerParams,
    pub(super) task: WaypointTask,
    pub(super) poses: Follower<FollowWaypoints>,
    pub(super) gps: Follower<FollowGPSWaypoints>,
    pub(super) navigator: Option<Nav2ActionClient<NavigateToPose>>,
    pub(super) from_ll: Option<Client<FromLL>>,
    pub(super) log: LogThrottle,
}

impl WaypointFollowerNode {
    /// Creates a node `waypoint_follower`. `save` writes the photos of `PhotoAtWaypoint`.
    ///
    /// # Errors
    /// When a topic or action of that name has another type.
    pub fn new(
        graph: &Graph,
        config: WaypointFollowerConfig,
        save: SavePhoto,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        Self::at(graph.node(NodeSettings::new("waypoint_follower"))?, config, save)
    }

    /// Runs the waypoint follower as a node of the graph.
    ///
    /// # Errors
    /// When a topic or action of that name has another type.
    pub fn at(
        node: Node,
        config: WaypointFollowerConfig,
        save: SavePhoto,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let values = config.values();
        let kind = config.task.unwrap_or(TaskKind::Wait);
        let task = WaypointTask::new(kind, config.task_values.clone(), save);
        let params = config.params();
        let mut actor = node.actor(Self {
            config,
            params,
            task,
            poses: Follower::default(),
            gps: Follower::default(),
            navigator: None,
            from_ll: None,
            log: LogThrottle::default(),
        });
        let parameters = actor.parameters(values, |state, values, _| {
            state.adopt(values);
            Ok(())
        })?;
        let given = parameters.values();
        let (params, task_values) = actor.with(|state| {
            state.adopt(&given);
            (state.params.clone(), state.config.task_values.clone())
        });
        match kind {
            TaskKind::Wait => {}
            TaskKind::Photo => {
                let topic = PhotoAtWaypointParams::from_values(&task_values).image_topic;
                actor.subscribe(&topic, Qos::best_effort(1), |state, image, _| {
                    state.task.image = Some(image);
                })?;
            }
            TaskKind::Input => {
                let topic = InputAtWaypointParams::from_values(&task_values).input_topic;
                actor.subscribe::<Empty>(&topic, Qos::reliable(10), |state, _, _| {
                    state.task.has_input = true;
                })?;
            }
        }
        serve::<FollowWaypoints>(&mut actor, "follow_waypoints", &params)?;
        if params.node.compat != Nav2Release::Humble {
            serve::<FollowGPSWaypoints>(&mut actor, "follow_gps_waypoints", &params)?;
        }
        actor.on_jump(|state, io| {
            state.stop();
            if io.node().is_active() {
                state.activate();
            }
            io.node().log(Level::Warn, "the clock jumped: running goals are aborted");
        });
        LifecycleNode::new(actor)
    }

    fn adopt(&mut self, values: &ParamValues) {
        self.config.adopt(values);
        self.params = self.config.params();
        self.task.adopt(self.config.task_values.clone());
    }

    fn activate(&mut self) {
        self.poses.server.activate();
        self.gps.server.activate();
    }

    /// Ends all goals, and cancels those of the navigator.
    fn stop(&mut self) {
        let sent = [self.poses.deactivate(), self.gps.deactivate()];
        let Some(client) = self.navigator.as_ref().filter(|client| client.is_ready()) else {
            return;
        };
        for sent in sent.into_iter().flatten() {
            let _ = client.cancel(sent.id());
        }
    }
}

fn serve<A: FollowAction>(
    actor: &mut Actor<WaypointFollowerNode>,
    name: &str,
    params: &WaypointFollowerParams,
) -> Result<(), GraphError> {
    let result_timeout_ns = (params.action_server_result_timeout_s * 1e9) as i64;
    serve_simple_action::<A, WaypointFollowerNode>(
        actor,
        params.node.compat,
        name,
        ActionSettings { result_timeout_ns },
        |state| Some(&mut A::follower(state).server),
        |_, goal, _| A::request(goal).check(),
        |state, io| begin::<A>(state, io),
    )
}

impl LifecycleCallbacks for WaypointFollowerNode {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let node = io.node();
        if self.config.task.is_none() {
            let name = &self.params.task_plugin;
            node.log(Level::Error, format_args!("`{name}.plugin` is no task of this node"));
            return StepOutcome::Failure;
        }
        let release = self.params.node.compat;
        let opened = Nav2ActionClient::new(node, release, "navigate_to_pose")
            .and_then(|navigator| Ok((navigator, node.client("/fromLL")?)));
        match opened {
            Ok((navigator, from_ll)) => {
                self.navigator = Some(navigator);
                self.from_ll = Some(from_ll);
                StepOutcome::Success
            }
            Err(error) => {
                node.log(Level::Error, error);
                StepOutcome::Failure
            }
        }
    }

    fn on_activate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.activate();
        StepOutcome::Success
    }

    fn on_deactivate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.stop();
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.stop();
        self.navigator = None;
        self.from_ll = None;
        StepOutcome::Success
    }
}
