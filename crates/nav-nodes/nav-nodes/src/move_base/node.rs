//! Node with its topics and parameters.

use periplus_geometry::Twist2;
use periplus_graph::{
    Actor, Alarm, GraphError, LifecycleNode, Node, NodeSettings, ParameterRejection, Qos,
};
use periplus_msgs::actionlib_msgs::GoalID;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::move_base_msgs::{MoveBaseActionGoal, MoveBaseGoal};
use periplus_msgs::nav_msgs::{GetPlan, Odometry};
use periplus_msgs::std_srvs::Empty;
use periplus_params::ParamValues;
use periplus_tf_ros::LogThrottle;

use super::actionlib::{ActionServer, STATUS_PERIOD_NS};
use super::config::MoveBaseConfig;
use super::global_planner::GlobalPlanner;
use super::job::Job;
use super::local_planner::LocalPlanner;
use super::outputs::Outputs;
use super::params::MoveBaseParams;
use super::recovery::{Recovery, SlowMotion, measure_robot};
use crate::costmap_2d::CostmapNode;
use crate::server_plugins::changed;

/// Name of the action, which does not follow that of the node.
const ACTION: &str = "move_base";

/// The node `move_base` of ROS 1.
pub struct MoveBase {
    pub(super) params: MoveBaseParams,
    pub(super) global_planner: GlobalPlanner,
    pub(super) local_planner: LocalPlanner,
    pub(super) recoveries: Vec<Recovery>,
    pub(super) global_costmap: LifecycleNode<CostmapNode>,
    pub(super) local_costmap: LifecycleNode<CostmapNode>,
    pub(super) server: ActionServer,
    pub(super) outputs: Outputs,
    /// Last velocity of the odometry, in the base frame.
    pub(super) odometry: Twist2,
    pub(super) job: Option<Job>,
    /// The next cycle while a goal runs.
    pub(super) running: Option<Alarm>,
    /// Limits of the speed after a recovery.
    pub(super) slow: Option<SlowMotion>,
    pub(super) log: LogThrottle,
}

impl MoveBase {
    /// Creates the node, and its costmaps on nodes that `costmap_node` creates from settings with name and namespace.
    ///
    /// # Errors
    /// When a name is not valid, or exists with another type.
    pub fn create(
        node: &Node,
        config: MoveBaseConfig,
        mut costmap_node: impl FnMut(NodeSettings) -> Result<Node, GraphError>,
    ) -> Result<Actor<Self>, GraphError> {
        let MoveBaseConfig { mut values, global_planner, local_planner, mut recoveries, .. } =
            config;
        measure_robot(&mut recoveries, &config.local_costmap);
        let mut costmap = |name: &str, config| {
            let namespace = format!("{}/{name}", node.full_name());
            let settings = NodeSettings::new(name).namespace(&namespace);
            // In ROS 1 `footprint` is the footprint at the pose of the robot.
            let settings = settings
                .remap("footprint", "set_footprint")
                .remap("published_footprint", "footprint");
            CostmapNode::at(costmap_node(settings)?, config)
        };
        let global_costmap = costmap("global_costmap", config.global_costmap)?;
        let local_costmap = costmap("local_costmap", config.local_costmap)?;
        let params = MoveBaseParams::from_values(&values);
        values.add_group(global_planner.name.clone(), global_planner.values.clone());
        let own = local_planner.values();
        let odometry = own.as_ref().and_then(|own| own.text("odom_topic"));
        let odometry = odometry.unwrap_or_else(|| "odom".to_owned());
        if let Some(own) = own {
            values.add_group(local_planner.name.clone(), own);
        }
        let outputs = Outputs::new(node, ACTION, &global_planner.name, &local_planner.name)?;
        let starts_costmaps = !params.shutdown_costmaps;
        let mut actor = node.actor(Self {
            params,
            global_planner,
            local_planner,
            recoveries,
            global_costmap,
            local_costmap,
            server: ActionServer::new(node, ACTION)?,
            outputs,
            odometry: Twist2::ZERO,
            job: None,
            running: None,
            slow: None,
            log: LogThrottle::default(),
        });
        let parameters = actor.parameters(values, |state, values, _| state.change(values))?;
        let given = parameters.values();
        actor.with(|state| {
            // Command-line arguments override the parameter file.
            if let Err(error) = state.change(&given) {
                node.log(periplus_graph::Level::Error, error);
            }
            for costmap in [&state.global_costmap, &state.local_costmap] {
                costmap.lifecycle().change_now(periplus_graph::Transition::Configure);
                if starts_costmaps {
                    costmap.lifecycle().change_now(periplus_graph::Transition::Activate);
                }
            }
        });
        subscribe(&mut actor, &odometry)?;
        Ok(actor)
    }

    /// Node of the global costmap.
    pub fn global_costmap(&self) -> &LifecycleNode<CostmapNode> {
        &self.global_costmap
    }

    /// Node of the local costmap.
    pub fn local_costmap(&self) -> &LifecycleNode<CostmapNode> {
        &self.local_costmap
    }

    /// Applies changed parameters.
    fn change(&mut self, all: &ParamValues) -> Result<(), ParameterRejection> {
        if let Some(own) = self.local_planner.values() {
            let name = self.local_planner.name.clone();
            for (_, parameter, value) in changed(all, std::iter::once((name.as_str(), &own))) {
                self.local_planner.change(&parameter, value).map_err(ParameterRejection::new)?;
            }
        }
        let (name, own) = (self.global_planner.name.clone(), self.global_planner.values.clone());
        for (_, parameter, value) in changed(all, std::iter::once((name.as_str(), &own))) {
            self.global_planner.set(&parameter, value);
        }
        self.params = MoveBaseParams::from_values(all);
        Ok(())
    }
}

/// Connects the topics and services.
fn subscribe(actor: &mut Actor<MoveBase>, odometry: &str) -> Result<(), GraphError> {
    actor.subscribe::<Odometry>(odometry, Qos::reliable(1), |state, odometry, _| {
        let twist = &odometry.twist.twist;
        state.odometry = Twist2::new(twist.linear.x, twist.linear.y, twist.angular.z);
    })?;
    let qos = Qos::reliable(10);
    actor.subscribe::<MoveBaseActionGoal>(&format!("{ACTION}/goal"), qos, |state, goal, io| {
        state.server.receive_goal(&goal, io.now_ns());
        state.start(io);
    })?;
    actor.subscribe::<PoseStamped>("move_base_simple/goal", qos, |state, pose, io| {
        let goal = MoveBaseGoal { target_pose: (*pose).clone() };
        let goal = MoveBaseActionGoal { goal, ..MoveBaseActionGoal::default() };
        state.server.receive_goal(&goal, io.now_ns());
        state.start(io);
    })?;
    actor.subscribe::<GoalID>(&format!("{ACTION}/cancel"), qos, |state, request, io| {
        state.server.receive_cancel(&request, io.now_ns());
    })?;
    actor.timer(STATUS_PERIOD_NS, |state, io| state.server.publish_status(io.now_ns()))?;
    actor.serve::<GetPlan>("~/make_plan", |state, request, io| {
        state.plan_for_user(&request, io.node())
    })?;
    actor.serve::<Empty>("~/clear_costmaps", |state, _, io| state.clear_all(io.node()))?;
    actor.on_jump(|state, io| {
        if state.job.is_some() {
            let text = "the clock jumped; send the goal again";
            state.server.abort(text, io.now_ns());
            state.rest(io);
        }
        state.server.forget();
    });
    Ok(())
}
