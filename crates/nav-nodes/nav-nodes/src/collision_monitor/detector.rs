//! Lifecycle node of the collision detector.

use periplus_costmap::Nav2Release;
use periplus_graph::{
    Alarm, Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node, NodeSettings,
    Publisher, Qos, StepOutcome,
};
use periplus_motion::collision_monitor::{CollisionPoint, MonitorAction, ZoneAction, detect};
use periplus_motion::tables::CollisionDetectorParams;
use periplus_msgs::nav2_msgs::CollisionDetectorState;
use periplus_msgs::visualization_msgs::MarkerArray;

use crate::loop_rate::LoopRate;

use super::config::MonitorConfig;
use super::markers;
use super::perception::{Perception, serve_exclusions};

/// Topic of the reports.
const STATE_TOPIC: &str = "collision_detector_state";

/// Publishers of a configured detector.
struct Outputs {
    state: Publisher<CollisionDetectorState>,
    points: Publisher<MarkerArray>,
    /// Only main has it.
    triggering: Option<Publisher<MarkerArray>>,
}

/// Collision detector as a lifecycle node.
pub struct CollisionDetectorNode {
    config: MonitorConfig,
    perception: Option<Perception>,
    outputs: Option<Outputs>,
    /// Loop while the node is active.
    running: Option<(LoopRate, Alarm)>,
}

impl CollisionDetectorNode {
    /// Creates a node `collision_detector`.
    ///
    /// # Errors
    /// When a topic or service of that name has another type.
    pub fn new(graph: &Graph, config: MonitorConfig) -> Result<LifecycleNode<Self>, GraphError> {
        Self::at(graph.node(NodeSettings::new("collision_detector"))?, config)
    }

    /// Runs the collision detector as a node of the graph. The configuration is read by
    /// [`MonitorConfig::read_detector`].
    ///
    /// # Errors
    /// When a topic or service of that name has another type.
    pub fn at(node: Node, config: MonitorConfig) -> Result<LifecycleNode<Self>, GraphError> {
        let values = config.values();
        let state = Self { config, perception: None, outputs: None, running: None };
        let mut actor = node.actor(state);
        let parameters = actor.parameters(values, |state, values, _| {
            state.config.adopt(values);
            if let Some(perception) = &mut state.perception {
                perception.adopt(&state.config);
            }
            Ok(())
        })?;
        let given = parameters.values();
        let config = actor.with(|state| {
            state.config.adopt(&given);
            state.config.clone()
        });
        serve_exclusions(&mut actor, &config, |state: &mut Self| state.perception.as_mut())?;
        actor.on_jump(|state, io| {
            if let Some(perception) = &mut state.perception {
                perception.forget();
            }
            if state.running.is_some() {
                state.start_loop(io);
            }
        });
        LifecycleNode::new(actor)
    }

    fn start_loop(&mut self, io: &Io<'_, Self>) {
        let hertz = CollisionDetectorParams::from_values(&self.config.node).frequency_hz;
        self.schedule(LoopRate::of_hertz(hertz, io.now_ns()), io);
    }

    fn schedule(&mut self, mut rate: LoopRate, io: &Io<'_, Self>) {
        let next_ns = rate.next(io.now_ns());
        self.running = Some((rate, io.alarm(next_ns, |state, io| state.tick(io))));
    }

    fn tick(&mut self, io: &Io<'_, Self>) {
        let Some((rate, _)) = self.running.take() else { return };
        self.schedule(rate, io);
        let (Some(perception), Some(outputs)) = (&mut self.perception, &self.outputs) else {
            return;
        };
        perception.receive();
        let seen = perception.see(io.node());
        let frame = &perception.params.base_frame_id;
        if outputs.points.is_heard() {
            let has_height = perception.params.collision_points_marker_3d;
            outputs.points.publish(markers::seen_in_one(&seen.points, frame, has_height));
        }
        let found = detect(&mut perception.zones, &seen.points);
        let mut state = CollisionDetectorState::default();
        let mut triggered: Vec<(&str, &[(usize, CollisionPoint)])> = Vec::new();
        for detection in &found {
            let Some(zone) = perception.zones.get(detection.zone) else { continue };
            state.polygons.push(zone.name.clone());
            state.detections.push(detection.is_triggered);
            if detection.is_triggered {
                triggered.push((&zone.name, &detection.points));
            }
        }
        outputs.state.publish(state);
        if let Some(triggering) = outputs.triggering.as_ref().filter(|it| it.is_heard()) {
            let colour = markers::colour(MonitorAction::Stop);
            triggering.publish(markers::triggering(&triggered, &seen.points, frame, colour));
        }
        perception.publish_shapes(io.now_ns(), true);
    }
}

impl Outputs {
    fn new(node: &Node, release: Nav2Release) -> Result<Self, GraphError> {
        let qos = Qos::reliable(1);
        let is_main = release == Nav2Release::Main;
        Ok(Self {
            state: node.publisher(STATE_TOPIC, qos)?,
            points: node.publisher("~/collision_points_marker", qos)?,
            triggering: is_main.then(|| node.publisher("~/triggering_points", qos)).transpose()?,
        })
    }
}

impl LifecycleCallbacks for CollisionDetectorNode {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let node = io.node();
        let opened = Perception::open(node, &self.config).and_then(|perception| {
            let acting = perception.zones.iter().find(|zone| zone.action != ZoneAction::None);
            if let Some(zone) = acting {
                let name = &zone.name;
                return Err(format!("`{name}.action_type` must be `none` in a collision detector"));
            }
            let release = perception.params.node.compat;
            let outputs = Outputs::new(node, release).map_err(|error| error.to_string())?;
            Ok((perception, outputs))
        });
        match opened {
            Ok((perception, outputs)) => {
                self.perception = Some(perception);
                self.outputs = Some(outputs);
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
        }
        self.start_loop(io);
        StepOutcome::Success
    }

    fn on_deactivate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.running = None;
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.running = None;
        self.perception = None;
        self.outputs = None;
        StepOutcome::Success
    }
}
