//! Node of the controller server.

use periplus_controllers::ControlReport;
use periplus_controllers::mppi::check_costmap;
use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Twist2;
use periplus_graph::{
    ActionSettings, Alarm, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode,
    LifecycleState, Node, ParameterRejection, Qos, StepOutcome, Transition,
};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::nav2_msgs::SpeedLimit;
use periplus_msgs::nav2_msgs_main::FollowPath;
use periplus_params::{Given, ParamValues};
use periplus_tf_ros::LogThrottle;

use super::job::Job;
use super::outputs::Outputs;
use super::parameters::{CONTROLLER_SERVER, ControllerServerParams};
use super::plugins::{ControllerPlugins, plugins};
use crate::costmap_2d::CostmapNode;
use crate::loop_rate::LoopRate;
use crate::navigation_plugins::NavigationPlugins;
use crate::server_plugins::ServerParameters;
use crate::simple_action_server::{SimpleActionServer, serve_simple_action};

/// Controller server as a lifecycle node.
pub struct ControllerServer {
    pub(super) params: ControllerServerParams,
    /// Release whose behaviour is used.
    pub(super) release: Nav2Release,
    /// Release whose messages are used.
    forms: Nav2Release,
    pub(super) plugins: ControllerPlugins,
    pub(super) costmap: LifecycleNode<CostmapNode>,
    pub(super) outputs: Option<Outputs>,
    pub(super) server: SimpleActionServer<FollowPath>,
    /// Last velocity of the odometry, in the base frame.
    pub(super) odometry: Twist2,
    pub(super) job: Option<Job>,
    /// The control loop while a goal runs.
    pub(super) running: Option<(LoopRate, Alarm)>,
    pub(super) log: LogThrottle,
    /// Errors in the parameters because of which it cannot be configured.
    failures: Vec<String>,
}

impl ControllerServer {
    /// Creates the server on a node, with parameters as written. It owns the node of the local costmap, whose
    /// release applies to the server as well.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn new<'a>(
        node: &Node,
        given: impl IntoIterator<Item = Given<'a>>,
        costmap: LifecycleNode<CostmapNode>,
        diagnostics: &mut Diagnostics,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        Self::with_plugins(node, given, costmap, &NavigationPlugins::new(), diagnostics)
    }

    /// Creates the server as [`Self::new`] does, with controllers of other authors.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn with_plugins<'a>(
        node: &Node,
        given: impl IntoIterator<Item = Given<'a>>,
        costmap: LifecycleNode<CostmapNode>,
        registered: &NavigationPlugins,
        diagnostics: &mut Diagnostics,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let (release, forms) = costmap.with(|costmap| costmap.releases());
        let mut server = ServerParameters::new(&CONTROLLER_SERVER, given, diagnostics);
        let frequency_hz =
            ControllerServerParams::from_values(&server.node).controller_frequency_hz;
        let plugins = plugins(&mut server, &registered.controllers, release, frequency_hz);
        let (mut values, failures) = server.finish();
        plugins.add_groups(&mut values);
        let mut actor = node.actor(Self {
            params: ControllerServerParams::from_values(&values),
            release,
            forms,
            plugins,
            costmap,
            outputs: None,
            server: SimpleActionServer::default(),
            odometry: Twist2::ZERO,
            job: None,
            running: None,
            log: LogThrottle::default(),
            failures,
        });
        let parameters = actor.parameters(values, |state, values, _| state.change(values))?;
        let params = actor.with(|state| {
            // Command-line arguments override the parameter file.
            if let Err(error) = state.change(&parameters.values()) {
                state.failures.push(error.to_string());
            }
            state.params.clone()
        });
        let odometry = if release == Nav2Release::Main { &params.odom_topic } else { "odom" };
        actor.subscribe::<Odometry>(odometry, Qos::reliable(1), |state, odometry, _| {
            let twist = &odometry.twist.twist;
            state.odometry = Twist2::new(twist.linear.x, twist.linear.y, twist.angular.z);
        })?;
        let qos = Qos::reliable(10);
        actor.subscribe::<SpeedLimit>(&params.speed_limit_topic, qos, |state, limit, _| {
            state.plugins.set_speed_limit(limit.speed_limit, limit.percentage);
        })?;
        let result_timeout_ns = (params.action_server_result_timeout_s * 1e9) as i64;
        serve_simple_action::<FollowPath, Self>(
            &mut actor,
            forms,
            "follow_path",
            ActionSettings { result_timeout_ns },
            |state| Some(&mut state.server),
            |state, goal, _| {
                // Before main, a goal that is not valid is accepted and then fails.
                if state.release < Nav2Release::Main {
                    return Ok(());
                }
                if goal.path.poses.is_empty() {
                    return Err("Requested path to follow is empty.".to_owned());
                }
                state.plugins.find(goal, state.release).map(|_| ()).map_err(|failure| failure.text)
            },
            |state, io| state.start(io),
        )?;
        LifecycleNode::new(actor)
    }

    /// Node of the local costmap.
    pub fn costmap(&self) -> &LifecycleNode<CostmapNode> {
        &self.costmap
    }

    /// Applies changed parameters; either all or none.
    fn change(&mut self, all: &ParamValues) -> Result<(), ParameterRejection> {
        let params = ControllerServerParams::from_values(all);
        let is_valid = params.failure_tolerance_s >= 0.0 || params.failure_tolerance_s == -1.0;
        if !is_valid {
            let text = format!(
                "`failure_tolerance` is {}; it must be at least 0 s, or -1 for no limit",
                params.failure_tolerance_s
            );
            return Err(ParameterRejection::new(text));
        }
        self.plugins.change(all)?;
        self.params = params;
        Ok(())
    }

    fn follow(&self, transition: Transition) -> StepOutcome {
        if self.costmap.lifecycle().change_now(transition) {
            StepOutcome::Success
        } else {
            StepOutcome::Failure
        }
    }

    /// Ends the work without a result.
    fn stop(&mut self, node: &Node) {
        self.running = None;
        self.job = None;
        self.server.deactivate();
        self.publish_zero(node);
        self.plugins.reset_controllers();
    }

    /// Contradictions between the costmap and the parameters of the controllers.
    fn costmap_advice(&self) -> Diagnostics {
        let mut advice = Diagnostics::new();
        self.costmap.with(|costmap| {
            costmap.footprint_advice().into_iter().for_each(|one| advice.push(one));
            let Some(view) = costmap.view() else { return };
            for slot in &self.plugins.controllers {
                if let ControlReport::Samples(report) = slot.controller.report() {
                    check_costmap(report.0.config(), &slot.id, &view, &mut advice);
                }
            }
        });
        advice
    }

    pub(super) fn publish_zero(&self, node: &Node) {
        if let Some(outputs) = &self.outputs {
            let base = self.costmap.with(|costmap| costmap.params().robot_base_frame.clone());
            outputs.publish_velocity(node, &base, Twist2::ZERO);
        }
    }
}

impl LifecycleCallbacks for ControllerServer {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        for failure in &self.failures {
            io.node().log(Level::Fatal, format!("Failed to create controller: {failure}"));
        }
        if !self.failures.is_empty() || self.follow(Transition::Configure) != StepOutcome::Success {
            return StepOutcome::Failure;
        }
        match Outputs::new(io.node(), &self.params, self.release, self.forms) {
            Ok(outputs) => self.outputs = Some(outputs),
            Err(error) => {
                io.node().log(Level::Error, error);
                self.follow(Transition::Cleanup);
                return StepOutcome::Failure;
            }
        }
        let ids: Vec<&str> = self.plugins.controllers.iter().map(|slot| slot.id.as_str()).collect();
        let text = format!("Controller Server has {} controllers available.", ids.join(" "));
        io.node().log(Level::Info, text);
        StepOutcome::Success
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let outcome = self.follow(Transition::Activate);
        self.costmap_advice().iter().for_each(|advice| io.node().log_finding(advice));
        if outcome == StepOutcome::Success {
            self.server.activate();
        }
        outcome
    }

    fn on_deactivate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.stop(io.node());
        self.follow(Transition::Deactivate);
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.stop(io.node());
        self.outputs = None;
        if self.costmap.lifecycle().state() == LifecycleState::Active {
            self.follow(Transition::Deactivate);
        }
        self.follow(Transition::Cleanup);
        StepOutcome::Success
    }
}
