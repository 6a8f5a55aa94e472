//! Costmap node.

mod access;

use periplus_costmap::tables::CostmapParams;
use periplus_costmap::{Advice, CellReport, CostmapConfig, Footprint, LayerConfig, LayeredCostmap};
use periplus_diagnostics::{Diagnostic, SourceMap};
use periplus_geometry::Pose2;
use periplus_graph::{
    Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Mailbox, Node, NodeSettings,
    ParameterRejection, Qos, StepOutcome,
};
use periplus_msgs::geometry_msgs;
use periplus_params::ParamValues;

use crate::costmap_2d::frames::Listener;
use crate::costmap_2d::health::{EVERY_NS, Health, Patient};
use crate::costmap_2d::inputs::{Inputs, Scene};
use crate::costmap_2d::outputs::Outputs;
use crate::costmap_2d::parameters::{node_values, source_group, split};
use crate::costmap_2d::services;

/// Time during which an identical message is not logged again \[ns\].
const QUIET_NS: i64 = 5_000_000_000;

/// Status of a costmap, for diagnosis.
#[derive(Clone, Debug)]
pub struct CostmapStatus {
    /// Name of the node.
    pub node: String,
    /// Number of updates.
    pub updates: u64,
    /// True if all layers are current.
    pub is_current: bool,
    /// Number of columns and rows.
    pub size: (usize, usize),
    /// Reason for which the last update failed.
    pub trouble: Option<String>,
    /// Sources: layer and name, topic, number of messages, and age of the last usable one \[s\].
    pub sources: Vec<(String, String, u64, Option<f64>)>,
    /// Advice about dropped points.
    pub advice: Vec<Advice>,
}

/// Costmap as a lifecycle node.
pub struct CostmapNode {
    node: Node,
    /// Parameters of the node and of all layers.
    config: CostmapConfig,
    /// Parameters of the node.
    params: CostmapParams,
    pub(crate) costmap: Option<LayeredCostmap>,
    pub(crate) tf: Listener,
    inputs: Inputs,
    pub(crate) outputs: Option<Outputs>,
    /// `None` until the parameters are known.
    outlines: Option<Outlines>,
    health: Health,
    updates: u64,
    trouble: Option<String>,
    told: Vec<(String, i64)>,
    /// Sources of the parameter files, for the lines in messages.
    files: SourceMap,
    published_ns: Option<i64>,
    pub(crate) robot: Option<Pose2>,
}

/// Topic of the footprint.
enum Outlines {
    Plain(Mailbox<geometry_msgs::Polygon>),
    Stamped(Mailbox<geometry_msgs::PolygonStamped>),
}

impl Outlines {
    fn new(node: &Node, is_stamped: bool) -> Result<Self, GraphError> {
        Ok(if is_stamped {
            Self::Stamped(node.mailbox("footprint", Qos::reliable(10))?)
        } else {
            Self::Plain(node.mailbox("footprint", Qos::reliable(10))?)
        })
    }

    fn latest(&self) -> Option<Vec<[f64; 2]>> {
        let points = |polygon: &geometry_msgs::Polygon| {
            polygon.points.iter().map(|point| [point.x.into(), point.y.into()]).collect()
        };
        match self {
            Self::Plain(plain) => plain.latest().map(|polygon| points(&polygon)),
            Self::Stamped(stamped) => stamped.latest().map(|stamped| points(&stamped.polygon)),
        }
    }
}

impl CostmapNode {
    /// Creates a costmap `name` in a namespace of the same name, as in Nav2:
    /// `/local_costmap/local_costmap`. Arguments of the graph may change the namespace and remap
    /// topics.
    ///
    /// # Errors
    /// When a topic of that name has another type.
    pub fn new(
        graph: &Graph,
        name: &str,
        config: CostmapConfig,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        Self::at(graph.node(NodeSettings::new(name).namespace(&format!("/{name}")))?, config)
    }

    /// Creates a costmap on an existing node.
    ///
    /// # Errors
    /// When a topic of that name has another type.
    pub fn at(node: Node, config: CostmapConfig) -> Result<LifecycleNode<Self>, GraphError> {
        let name = node.names().name().to_owned();
        let params = config.params();
        let forms = config.forms;
        let values = node_values(&config);
        let names =
            |layers: &[LayerConfig]| layers.iter().map(|layer| layer.name.clone()).collect();
        let (layers, filters): (Vec<_>, Vec<_>) = (names(&config.layers), names(&config.filters));
        let state = Self {
            node: node.clone(),
            config,
            params,
            costmap: None,
            tf: Listener::new(&node)?,
            inputs: Inputs::default(),
            outputs: None,
            outlines: None,
            health: Health::new(&node)?,
            updates: 0,
            trouble: None,
            told: Vec::new(),
            files: SourceMap::new(),
            published_ns: None,
            robot: None,
        };
        let mut actor = node.actor(state);
        let parameters = actor.parameters(values, |state, values, _| state.change(values))?;
        // Command-line arguments override the parameter file.
        let given = parameters.values();
        let node = actor.node().clone();
        let hertz = actor.with(|state| {
            state.adopt(&given);
            let is_stamped = state.params.subscribe_to_stamped_footprint;
            state.outlines = Some(Outlines::new(&node, is_stamped)?);
            Ok::<f64, GraphError>(state.params.update_frequency_hz)
        })?;
        services::serve(&mut actor, &name, &layers, &filters, forms)?;
        if hertz > 0.0 {
            let period_ns = ((1e9 / hertz) as i64).max(1);
            actor.timer(period_ns, |state, io| state.update(io.now_ns(), io.node()))?;
        }
        actor.timer(EVERY_NS, |state, io| state.report(io.now_ns(), io.node()))?;
        actor.on_jump(|state, io| state.jump(io.now_ns(), io.node()));
        LifecycleNode::new(actor)
    }

    /// Sets the sources of the parameter files; messages then contain their lines.
    pub fn name_lines_of(&mut self, files: SourceMap) {
        self.files = files;
    }

    /// Returns true if the parameters select the time of `/clock`.
    #[must_use]
    pub fn uses_simulated_time(&self) -> bool {
        self.params.use_sim_time
    }

    /// The costmap, once it is configured.
    #[must_use]
    pub fn costmap(&self) -> Option<&LayeredCostmap> {
        self.costmap.as_ref()
    }

    /// Returns a report about the cell at a point of the global frame \[m\].
    #[must_use]
    pub fn inspect(&self, x_m: f64, y_m: f64) -> Option<CellReport> {
        let costmap = self.costmap.as_ref()?;
        costmap.inspect(costmap.cell_of(x_m, y_m)?)
    }
}

impl LifecycleCallbacks for CostmapNode {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let node = io.node();
        match Outputs::new(node, &self.config) {
            Ok(outputs) => {
                let (inputs, errors) = Inputs::new(node, &self.config);
                for error in errors {
                    node.log(Level::Error, error);
                }
                self.inputs = inputs;
                self.outputs = Some(outputs);
                self.costmap = Some(self.config.build());
                StepOutcome::Success
            }
            Err(error) => {
                node.log(Level::Error, error);
                StepOutcome::Failure
            }
        }
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        for layer in self.costmap.iter_mut().flat_map(LayeredCostmap::all_mut) {
            for source in layer.sources_mut() {
                source.restart(io.now_ns());
            }
        }
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.costmap = None;
        self.outputs = None;
        self.inputs = Inputs::default();
        self.published_ns = None;
        StepOutcome::Success
    }
}

impl CostmapNode {
    fn update(&mut self, now_ns: i64, node: &Node) {
        self.tf.listen();
        if !node.is_active() {
            return;
        }
        let (Some(costmap), Some(outputs)) = (&mut self.costmap, &mut self.outputs) else { return };
        let global_frame = costmap.frame().global_frame.clone();
        let scene = Scene { tf: &self.tf, global_frame: &global_frame, now_ns };
        let mut complaints = self.inputs.take(costmap, &scene, node, self.config.compat);
        if let Some(points) = self.outlines.as_ref().and_then(Outlines::latest) {
            let padding_m = self.params.footprint_padding_m;
            if points.len() >= 3 {
                costmap.set_footprint(Footprint::new(points).padded(padding_m));
            } else {
                complaints.push(Diagnostic::error(
                    "bad-footprint",
                    format!("a footprint with {} corners is refused; it needs three", points.len()),
                ));
            }
        }
        // A received map sets the size even before the pose of the robot is known.
        costmap.apply_requested_size();
        match robot(&self.tf, &self.params, &self.config.node, now_ns) {
            Ok(robot) => {
                self.trouble = None;
                self.robot = Some(robot);
                outputs.prepare(costmap);
                if let Some(window) = costmap.update(now_ns, robot, &self.tf) {
                    outputs.changed(window);
                }
                self.updates += 1;
                complaints.extend(costmap.diagnostics().iter().cloned());
                outputs.publish_each(costmap, now_ns);
                let hertz = self.params.publish_frequency_hz;
                let is_due = self
                    .published_ns
                    .is_none_or(|last_ns| (now_ns - last_ns) as f64 * hertz >= 1e9 - 1.0);
                if hertz > 0.0 && is_due {
                    self.published_ns = Some(now_ns);
                    let outline = costmap.footprint().placed(robot);
                    outputs.publish_grids(costmap, &self.params, &outline, now_ns);
                }
            }
            Err(trouble) => {
                self.trouble = Some(trouble.message.clone());
                complaints.push(*trouble);
            }
        }
        for complaint in complaints {
            self.tell(&complaint, now_ns, node);
        }
    }

    /// Drops transforms and observations after a clock jump. Marked cells stay until they are
    /// cleared, as in Nav2.
    fn jump(&mut self, now_ns: i64, node: &Node) {
        self.tf.forget();
        self.inputs.forget();
        self.published_ns = None;
        self.told.clear();
        for layer in self.costmap.iter_mut().flat_map(LayeredCostmap::all_mut) {
            for source in layer.sources_mut() {
                source.forget(now_ns);
            }
        }
        node.log(
            Level::Warn,
            "the clock jumped: transforms and observations of before are dropped",
        );
    }

    /// Publishes the health.
    fn report(&mut self, now_ns: i64, node: &Node) {
        let patient = Patient {
            node: node.full_name(),
            costmap: self.costmap.as_ref(),
            inputs: &self.inputs,
            is_active: node.is_active(),
            updates: self.updates,
            trouble: self.trouble.as_deref(),
        };
        self.health.publish(&patient, now_ns);
    }

    /// Logs a message, unless it was logged a short time ago.
    fn tell(&mut self, complaint: &Diagnostic, now_ns: i64, node: &Node) {
        self.told.retain(|(_, told_ns)| (0..QUIET_NS).contains(&(now_ns - told_ns)));
        if self.told.iter().all(|(told, _)| *told != complaint.message) {
            self.told.push((complaint.message.clone(), now_ns));
            node.log_finding(&self.with_line(complaint));
        }
    }

    /// Adds the file and line of a message, if the sources are set.
    fn with_line(&self, complaint: &Diagnostic) -> Diagnostic {
        let mut placed = complaint.clone();
        if let Some(span) = complaint.span.filter(|span| self.files.holds(*span)) {
            let (file, position) = self.files.locate(span);
            placed.message = format!("{} ({file}:{})", complaint.message, position.line);
        }
        placed
    }

    /// Applies changed parameters.
    fn change(&mut self, all: &ParamValues) -> Result<(), ParameterRejection> {
        let node = split(all, "", &self.config.node);
        let tf = &self.tf;
        let frames = |target: &str, source: &str| Some(tf.at(target, source, 0).ok()?.0);
        match &mut self.costmap {
            Some(costmap) => {
                for layer in self.config.layers.iter().chain(&self.config.filters) {
                    change_layer(costmap, layer, all)?;
                }
                self.config.change(costmap, node, &frames).map_err(ParameterRejection::new)?;
            }
            None => self.config.node = node,
        }
        self.adopt(all);
        Ok(())
    }

    /// Copies parameters into the configuration.
    fn adopt(&mut self, all: &ParamValues) {
        fn layers(list: &mut [LayerConfig], all: &ParamValues) {
            for layer in list {
                layer.values = split(all, &layer.name, &layer.values);
                for source in &mut layer.sources {
                    let group = source_group(&layer.name, &source.name);
                    source.values = split(all, &group, &source.values);
                }
                layers(&mut layer.children, all);
            }
        }
        self.config.node = split(all, "", &self.config.node);
        self.params = self.config.params();
        layers(&mut self.config.layers, all);
        layers(&mut self.config.filters, all);
    }

    /// Returns the status.
    #[must_use]
    pub fn status(&self) -> CostmapStatus {
        let now_ns = self.node.now_ns();
        let mut sources = Vec::new();
        for (layer, name, topic) in self.inputs.topics() {
            let found = self.costmap.iter().flat_map(LayeredCostmap::all);
            let mut found = found.filter(|one| one.name() == layer).flat_map(|one| one.sources());
            if let Some(source) = found.find(|source| source.name == name) {
                let is_heard = source.counters.clouds > 0;
                let age_s = source
                    .last_ns()
                    .filter(|_| is_heard)
                    .map(|last_ns| (now_ns - last_ns) as f64 / 1e9);
                let count = source.counters.messages();
                sources.push((format!("{layer}.{name}"), topic.to_owned(), count, age_s));
            }
        }
        let costmap = self.costmap.as_ref();
        let size = costmap.map_or((0, 0), |costmap| {
            let info = costmap.costmap().info();
            (info.width, info.height)
        });
        CostmapStatus {
            node: self.node.full_name().to_owned(),
            updates: self.updates,
            is_current: costmap.is_some_and(|costmap| costmap.is_current(now_ns)),
            size,
            trouble: self.trouble.clone(),
            sources,
            advice: costmap.map(LayeredCostmap::advice).unwrap_or_default(),
        }
    }
}

fn change_layer(
    costmap: &mut LayeredCostmap,
    layer: &LayerConfig,
    all: &ParamValues,
) -> Result<(), ParameterRejection> {
    if let Some(running) = costmap.find_mut(&layer.name)
        && let Some(usual) = running.values().cloned()
    {
        let wanted = split(all, &layer.name, &usual);
        if wanted != usual {
            running.configure(wanted).map_err(ParameterRejection::new)?;
        }
        for source in running.sources_mut() {
            let wanted = split(all, &source_group(&layer.name, &source.name), &source.values);
            if wanted != source.values {
                source.configure(wanted);
            }
        }
    }
    for child in &layer.children {
        change_layer(costmap, child, all)?;
    }
    Ok(())
}

/// Returns the current `global_from_base`.
fn robot(
    tf: &Listener,
    params: &CostmapParams,
    node: &ParamValues,
    now_ns: i64,
) -> Result<Pose2, Box<Diagnostic>> {
    let (global, base) = (&params.global_frame, &params.robot_base_frame);
    let (pose, time_ns) = tf.at(global, base, 0).map_err(|why| {
        let missing = if tf.has(base) { global } else { base };
        let parameter = if tf.has(base) { "global_frame" } else { "robot_base_frame" };
        let missing_pose = Diagnostic::error(
            "no-robot-pose",
            format!("waiting for the transform from `{base}` to `{global}`: {why}"),
        );
        Box::new(
            missing_pose
                .at(node.origin(parameter))
                .help(match (tf.has(missing), missing.as_str()) {
                (true, _) => "both frames exist, but no transforms connect them".to_owned(),
                (false, "map") => {
                    "no node publishes `map`: start SLAM or localization, and set an initial pose"
                        .to_owned()
                }
                (false, _) => format!("no node publishes `{missing}`; check `{parameter}`"),
            }),
        )
    })?;
    let tolerance_s = params.transform_tolerance_s;
    let age_s = (now_ns - time_ns) as f64 / 1e9;
    // Time zero is that of static transforms.
    if time_ns != 0 && age_s > tolerance_s {
        let old_pose = Diagnostic::error(
            "old-robot-pose",
            format!(
                "the transform from `{base}` to `{global}` is {age_s:.2} s old; \
                 at most {tolerance_s} s are allowed"
            ),
        );
        return Err(Box::new(
            old_pose
                .at(node.origin("transform_tolerance"))
                .help("raise `transform_tolerance`, or publish the transform more often"),
        ));
    }
    Ok(Pose2::from(pose))
}
