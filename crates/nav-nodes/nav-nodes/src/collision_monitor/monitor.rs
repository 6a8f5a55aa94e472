//! Lifecycle node of the collision monitor.

use periplus_costmap::Nav2Release;
use periplus_geometry::Twist2;
use periplus_graph::{
    Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node, NodeSettings, Publisher,
    Qos, StepOutcome,
};
use periplus_motion::collision_monitor::{
    MonitorAction, MonitorDecision, SourcePoints, ZoneAction, decide,
};
use periplus_motion::tables::CollisionMonitorParams;
use periplus_msgs::geometry_msgs::TwistStamped;
use periplus_msgs::nav2_msgs::{CollisionMonitorState, Toggle, ToggleResponse};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::visualization_msgs::MarkerArray;
use periplus_params::ParamValues;

use crate::velocity_topics::{
    VelocityPublisher, components, subscribe_velocity, uses_stamped_velocity,
};

use super::config::MonitorConfig;
use super::markers;
use super::perception::{Perception, serve_exclusions};

/// Name that stands for a zone when a source is invalid.
const INVALID_SOURCE: &str = "invalid source";

/// Publishers of a configured monitor.
struct Outputs {
    velocity: VelocityPublisher,
    state: Option<Publisher<CollisionMonitorState>>,
    points: Publisher<MarkerArray>,
    /// Only main has it.
    triggering: Option<Publisher<MarkerArray>>,
}

/// Last action, to publish changes only.
struct LastAction {
    action: MonitorAction,
    name: String,
    was_zero: bool,
    /// True if a velocity was published that is not zero.
    is_moving: bool,
}

impl Default for LastAction {
    fn default() -> Self {
        let action = MonitorAction::DoNothing;
        Self { action, name: String::new(), was_zero: false, is_moving: false }
    }
}

/// Collision monitor as a lifecycle node.
pub struct CollisionMonitorNode {
    config: MonitorConfig,
    params: CollisionMonitorParams,
    is_enabled: bool,
    perception: Option<Perception>,
    outputs: Option<Outputs>,
    last: LastAction,
    stopped_ns: i64,
}

impl CollisionMonitorNode {
    /// Creates a node `collision_monitor`.
    ///
    /// # Errors
    /// When a topic or service of that name has another type.
    pub fn new(graph: &Graph, config: MonitorConfig) -> Result<LifecycleNode<Self>, GraphError> {
        Self::at(graph.node(NodeSettings::new("collision_monitor"))?, config)
    }

    /// Runs the collision monitor as a node of the graph. The configuration is read by
    /// [`MonitorConfig::read_monitor`].
    ///
    /// # Errors
    /// When a topic or service of that name has another type.
    pub fn at(node: Node, config: MonitorConfig) -> Result<LifecycleNode<Self>, GraphError> {
        let values = config.values();
        let params = CollisionMonitorParams::from_values(&config.node);
        let mut actor = node.actor(Self {
            config,
            params,
            is_enabled: true,
            perception: None,
            outputs: None,
            last: LastAction::default(),
            stopped_ns: 0,
        });
        let parameters = actor.parameters(values, |state, values, _| {
            state.adopt(values);
            Ok(())
        })?;
        let given = parameters.values();
        let (config, params) = actor.with(|state| {
            state.adopt(&given);
            (state.config.clone(), state.params.clone())
        });
        let release = params.common.node.compat;
        let usual_topic =
            if release == Nav2Release::Humble { "cmd_vel_raw" } else { "cmd_vel_smoothed" };
        let topic = params.cmd_vel_in_topic.as_deref().unwrap_or(usual_topic);
        subscribe_velocity(&mut actor, topic, is_stamped(&params), |state, command, io| {
            state.receive(command, io.node());
        })?;
        if release != Nav2Release::Humble {
            actor.serve::<Toggle>("~/toggle", |state, request, _| {
                state.is_enabled = request.enable;
                let word = if request.enable { "on" } else { "off" };
                let message = format!("Collision monitor toggled {word} successfully");
                ToggleResponse { success: true, message }
            })?;
        }
        serve_exclusions(&mut actor, &config, |state: &mut Self| state.perception.as_mut())?;
        actor.on_jump(|state, _| {
            if let Some(perception) = &mut state.perception {
                perception.forget();
            }
            state.last = LastAction::default();
        });
        LifecycleNode::new(actor)
    }

    fn adopt(&mut self, values: &ParamValues) {
        self.config.adopt(values);
        let params = CollisionMonitorParams::from_values(&self.config.node);
        if params.is_enabled != self.params.is_enabled {
            self.is_enabled = params.is_enabled;
        }
        self.params = params;
        if let Some(perception) = &mut self.perception {
            perception.adopt(&self.config);
        }
    }

    fn receive(&mut self, command: &TwistStamped, node: &Node) {
        if !node.is_active() {
            return;
        }
        let [vx, vy, .., wz] = components(&command.twist);
        if !components(&command.twist).iter().all(|component| component.is_finite()) {
            node.log(Level::Error, "ignored a velocity with a component that is not finite");
            return;
        }
        self.process(Twist2::new(vx, vy, wz), &command.header, node);
    }

    /// Applies the zones to a command and publishes what they allow.
    fn process(&mut self, command: Twist2, header: &Header, node: &Node) {
        let (Some(perception), Some(outputs)) = (&mut self.perception, &self.outputs) else {
            return;
        };
        let release = perception.params.node.compat;
        let now_ns = node.now_ns();
        perception.receive();
        let seen = perception.see(node);
        let frame = perception.params.base_frame_id.clone();
        if outputs.points.is_heard() {
            let has_height = perception.params.collision_points_marker_3d;
            outputs.points.publish(markers::seen(&seen.points, &frame, has_height));
        }
        // Humble ignores an invalid source.
        let is_blind = seen.has_invalid_source && release != Nav2Release::Humble;
        let start = if is_blind { MonitorDecision::stop() } else { MonitorDecision::pass(command) };
        let decision = if self.is_enabled {
            decide(&mut perception.zones, &seen.points, command, start)
        } else {
            start
        };
        let zone = decision.zone.and_then(|index| perception.zones.get(index));
        let name = match zone {
            Some(zone) => zone.name.clone(),
            None if is_blind => INVALID_SOURCE.to_owned(),
            None => String::new(),
        };
        if let Some(triggering) = outputs.triggering.as_ref().filter(|it| it.is_heard()) {
            let zones = [(name.as_str(), decision.points.as_slice())];
            let colour = markers::colour(decision.action);
            triggering.publish(markers::triggering(&zones, &seen.points, &frame, colour));
        }
        let is_changed = match release {
            Nav2Release::Humble => decision.action != self.last.action,
            _ => name != self.last.name && self.is_enabled,
        };
        if is_changed {
            let action = zone.map(|zone| zone.action);
            node.log(level(decision.action, is_blind), describe(action, &name, &seen.points));
            if let Some(state) = &outputs.state {
                let (action_type, polygon_name) = (decision.action.number(), name.clone());
                state.publish(CollisionMonitorState { action_type, polygon_name });
            }
        }
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = decision.velocity;
        let is_zero = decision.velocity == Twist2::ZERO;
        if is_zero && !self.last.was_zero {
            self.stopped_ns = now_ns;
        }
        let silence_ns = (self.params.stop_pub_timeout_s * 1e9) as i64;
        if !is_zero || now_ns - self.stopped_ns <= silence_ns {
            outputs.velocity.publish_planar(header.clone(), [vx_m_s, vy_m_s, wz_rad_s]);
        }
        perception.publish_shapes(now_ns, self.is_enabled);
        let action = decision.action;
        self.last = LastAction { action, name, was_zero: is_zero, is_moving: !is_zero };
    }
}

fn is_stamped(params: &CollisionMonitorParams) -> bool {
    let node = &params.common.node;
    uses_stamped_velocity(node.enable_stamped_cmd_vel, node.compat)
}

fn level(action: MonitorAction, is_blind: bool) -> Level {
    if action == MonitorAction::Stop && is_blind { Level::Warn } else { Level::Info }
}

/// Message about a new action.
fn describe(action: Option<ZoneAction>, name: &str, seen: &[SourcePoints]) -> String {
    match action {
        Some(ZoneAction::Stop) => format!("the robot stops: points in `{name}`"),
        Some(ZoneAction::Slowdown { ratio }) => {
            format!("the robot slows down to {:.0} %: points in `{name}`", ratio * 100.0)
        }
        Some(ZoneAction::Limit { linear_m_s, angular_rad_s }) => format!(
            "the robot is limited to {linear_m_s} m/s and {angular_rad_s} rad/s: points in `{name}`"
        ),
        Some(ZoneAction::Approach(limits)) => format!(
            "the robot keeps {} s to a collision of `{name}`",
            limits.time_before_collision_s
        ),
        Some(ZoneAction::None) | None if name.is_empty() => {
            "the robot continues normal operation".to_owned()
        }
        Some(ZoneAction::None) | None => {
            let count = seen.len();
            format!("the robot stops: at least one of {count} sources has no valid data")
        }
    }
}

impl LifecycleCallbacks for CollisionMonitorNode {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let node = io.node();
        let opened = Perception::open(node, &self.config).and_then(|perception| {
            let outputs = Outputs::new(node, &self.params).map_err(|error| error.to_string())?;
            Ok((perception, outputs))
        });
        match opened {
            Ok((perception, outputs)) => {
                self.perception = Some(perception);
                self.outputs = Some(outputs);
                self.is_enabled = self.params.is_enabled;
                StepOutcome::Success
            }
            Err(why) => {
                node.log(Level::Error, why);
                StepOutcome::Failure
            }
        }
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        if let Some(perception) = &mut self.perception {
            perception.reset();
            perception.receive();
            perception.publish_shapes(io.now_ns(), self.is_enabled);
        }
        StepOutcome::Success
    }

    fn on_deactivate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.stop(io.now_ns());
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        // A node may be shut down while it is active.
        self.stop(io.now_ns());
        self.perception = None;
        self.outputs = None;
        StepOutcome::Success
    }
}

impl Outputs {
    fn new(node: &Node, params: &CollisionMonitorParams) -> Result<Self, GraphError> {
        let is_main = params.common.node.compat == Nav2Release::Main;
        let (topic, qos) = (&params.state_topic, Qos::reliable(1));
        let velocity = VelocityPublisher::new(node, &params.cmd_vel_out_topic, is_stamped(params))?;
        let state = (!topic.is_empty()).then(|| node.publisher(topic, qos)).transpose()?;
        let points = node.publisher("~/collision_points_marker", qos)?;
        let triggering = is_main.then(|| node.publisher("~/triggering_points", qos)).transpose()?;
        Ok(Self { velocity, state, points, triggering })
    }
}

impl CollisionMonitorNode {
    /// Stops a robot that moves: it obeys its last command.
    fn stop(&mut self, now_ns: i64) {
        let last = std::mem::take(&mut self.last);
        if let Some(outputs) = self.outputs.as_ref().filter(|_| last.is_moving) {
            let header = Header::at(now_ns, &self.params.common.base_frame_id);
            outputs.velocity.publish_planar(header, [0.0; 3]);
        }
    }

    /// True while the zones are applied, see `~/toggle`.
    #[must_use]
    pub fn is_enabled(&self) -> bool {
        self.is_enabled
    }
}
