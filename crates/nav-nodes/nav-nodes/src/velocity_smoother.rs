//! Node of `nav2_velocity_smoother`.
//!
//! Receives `cmd_vel`, publishes `cmd_vel_smoothed`. Source: `velocity_smoother.cpp` (humble to main).

use periplus_costmap::Nav2Release;
use periplus_graph::{
    Alarm, Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node, NodeSettings,
    ParameterRejection, Qos, StepOutcome,
};
use periplus_motion::{
    LimitError, MeanVelocity, VelocitySmoother, VelocitySmootherParams, VelocitySmootherSettings,
};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::TwistStamped;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::std_msgs::Header;
use periplus_params::ParamValues;

use crate::loop_rate::LoopRate;
use crate::velocity_topics::{
    VelocityPublisher, components, subscribe_velocity, twist, uses_stamped_velocity,
};

pub use periplus_motion::tables::VELOCITY_SMOOTHER;

/// Velocity smoother as a lifecycle node.
pub struct VelocitySmootherNode {
    params: VelocitySmootherParams,
    smoother: Option<VelocitySmoother>,
    measured: MeanVelocity,
    output: Option<VelocityPublisher>,
    /// Header of the last command.
    header: Header,
    /// True if the last output was not zero.
    is_moving: bool,
    /// Loop while the node is active.
    running: Option<(LoopRate, Alarm)>,
}

impl VelocitySmootherNode {
    /// Creates a node `velocity_smoother` with parameters of [`VELOCITY_SMOOTHER`].
    ///
    /// # Errors
    /// When a topic of that name has another type.
    pub fn new(graph: &Graph, values: ParamValues) -> Result<LifecycleNode<Self>, GraphError> {
        Self::at(graph.node(NodeSettings::new("velocity_smoother"))?, values)
    }

    /// Runs the smoother as a node of the graph.
    ///
    /// # Errors
    /// When a topic of that name has another type.
    pub fn at(node: Node, values: ParamValues) -> Result<LifecycleNode<Self>, GraphError> {
        let state = Self {
            params: VelocitySmootherParams::from_values(&values),
            smoother: None,
            measured: MeanVelocity::new(0),
            output: None,
            header: Header::default(),
            is_moving: false,
            running: None,
        };
        let mut actor = node.actor(state);
        let parameters = actor.parameters(values, |state, values, io| {
            let params = VelocitySmootherParams::from_values(values);
            state.change(params, io).map_err(ParameterRejection::new)
        })?;
        let params = VelocitySmootherParams::from_values(&parameters.values());
        let (is_stamped, odometry) = (is_stamped(&params), params.odom_topic.clone());
        actor.with(|state| {
            state.measured = MeanVelocity::new((params.odom_duration_s * 1e9) as i64);
            state.params = params;
        });
        subscribe_velocity(&mut actor, "cmd_vel", is_stamped, |state, command, io| {
            state.receive(command, io.node());
        })?;
        actor.subscribe::<Odometry>(&odometry, Qos::reliable(10), |state, odometry, _| {
            let velocity = components(&odometry.twist.twist);
            state.measured.add(odometry.header.stamp.ns(), velocity);
        })?;
        actor.on_jump(|state, io| state.restart(io));
        LifecycleNode::new(actor)
    }

    /// Applies changed parameters.
    fn change(
        &mut self,
        params: VelocitySmootherParams,
        io: &Io<'_, Self>,
    ) -> Result<(), LimitError> {
        let settings = VelocitySmootherSettings::new(&params)?;
        if params.odom_duration_s != self.params.odom_duration_s {
            self.measured = MeanVelocity::new((params.odom_duration_s * 1e9) as i64);
        }
        self.params = params;
        let Some(smoother) = &mut self.smoother else { return Ok(()) };
        let is_new_rate = smoother.settings().period_ns() != settings.period_ns();
        smoother.set_settings(settings);
        if is_new_rate && self.running.is_some() {
            self.start_loop(io);
        }
        Ok(())
    }

    fn receive(&mut self, command: &TwistStamped, node: &Node) {
        let Some(smoother) = &mut self.smoother else { return };
        let stamp_ns = command.header.stamp.ns();
        let time_ns = if stamp_ns == 0 { node.now_ns() } else { stamp_ns };
        if smoother.set_command(components(&command.twist), time_ns) {
            self.header = command.header.clone();
        } else {
            node.log(Level::Error, "ignored a velocity with a component that is not finite");
        }
    }

    fn start_loop(&mut self, io: &Io<'_, Self>) {
        let Some(smoother) = &self.smoother else { return };
        let rate = LoopRate::start(smoother.settings().period_ns(), io.now_ns());
        self.schedule(rate, io);
    }

    fn schedule(&mut self, mut rate: LoopRate, io: &Io<'_, Self>) {
        let next_ns = rate.next(io.now_ns());
        let alarm = io.alarm(next_ns, |state, io| state.tick(io));
        self.running = Some((rate, alarm));
    }

    fn tick(&mut self, io: &Io<'_, Self>) {
        let Some((rate, _)) = self.running.take() else { return };
        self.schedule(rate, io);
        let (now_ns, measured) = (io.now_ns(), self.measured.value());
        let (Some(smoother), Some(output)) = (&mut self.smoother, &self.output) else { return };
        if let Some(velocity) = smoother.update(now_ns, measured) {
            let header =
                Header { stamp: self.stamp(now_ns), frame_id: self.header.frame_id.clone() };
            output.publish(TwistStamped { header, twist: twist(velocity) });
            self.is_moving = velocity.iter().any(|component| *component != 0.0);
        }
    }

    /// Stamp of the output: the present time, before main that of the command.
    fn stamp(&self, now_ns: i64) -> Time {
        let is_present = self.params.node.compat == Nav2Release::Main
            || self.params.stamps_present_time
            || self.header.stamp.ns() == 0;
        if is_present { Time::of_ns(now_ns) } else { self.header.stamp.clone() }
    }

    /// Ends the output with a velocity of zero if the robot moves: it obeys its last command.
    fn stop(&mut self, now_ns: i64) {
        self.running = None;
        if std::mem::take(&mut self.is_moving)
            && let Some(output) = &self.output
        {
            let header =
                Header { stamp: Time::of_ns(now_ns), frame_id: self.header.frame_id.clone() };
            output.publish(TwistStamped { header, ..TwistStamped::default() });
        }
        // The robot starts from rest the next time.
        self.smoother = self.smoother.take().map(|it| VelocitySmoother::new(it.settings().clone()));
    }

    /// Forgets commands and odometry after a jump of time.
    fn restart(&mut self, io: &Io<'_, Self>) {
        self.measured.clear();
        self.smoother = self.smoother.take().map(|it| VelocitySmoother::new(it.settings().clone()));
        if self.running.is_some() {
            self.start_loop(io);
        }
    }
}

fn is_stamped(params: &VelocitySmootherParams) -> bool {
    uses_stamped_velocity(params.node.enable_stamped_cmd_vel, params.node.compat)
}

impl LifecycleCallbacks for VelocitySmootherNode {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let settings = match VelocitySmootherSettings::new(&self.params) {
            Ok(settings) => settings,
            Err(error) => {
                io.node().log(Level::Error, error);
                return StepOutcome::Failure;
            }
        };
        match VelocityPublisher::new(io.node(), "cmd_vel_smoothed", is_stamped(&self.params)) {
            Ok(output) => {
                self.output = Some(output);
                self.smoother = Some(VelocitySmoother::new(settings));
                StepOutcome::Success
            }
            Err(error) => {
                io.node().log(Level::Error, error);
                StepOutcome::Failure
            }
        }
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.start_loop(io);
        StepOutcome::Success
    }

    fn on_deactivate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.stop(io.now_ns());
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        // A node may be shut down while it is active.
        self.stop(io.now_ns());
        self.smoother = None;
        self.output = None;
        self.measured.clear();
        StepOutcome::Success
    }
}
