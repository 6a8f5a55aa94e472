//! The node.

mod reconfigure;
mod user_poses;

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{LaserScan2, Pose2};
use periplus_graph::{
    Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node, NodeSettings,
    Parameters, Qos, StepOutcome,
};
use periplus_grid::OccupancyGrid;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_params::{ParamValue, ParamValues};
use periplus_scan_matching::Symmetric3;
use periplus_slam::{
    Closure, CorrectedInput, Counts, MountingCorrection, ScanOutcome, Slam, Update, tables,
};
use periplus_tf::TransformKind;
use periplus_tf_ros::{Frames, LogThrottle, ScanQueue, TransformedScan, laser_scan, plain};

use crate::Files;
use crate::slam_toolbox::Program;
use crate::slam_toolbox::correction::Anchor;
use crate::slam_toolbox::drawing::Drawer;
use crate::slam_toolbox::engine::{Engine, SURE};
use crate::slam_toolbox::health::{self, SET_RIGHT, SlamHealth};
use crate::slam_toolbox::inputs::{Names, scan_queue};
use crate::slam_toolbox::markers;
use crate::slam_toolbox::outputs::Outputs;
use crate::slam_toolbox::parameters::NodeParams;
use crate::slam_toolbox::services;

/// Period of checking the queue \[ns\]; new transforms trigger it too.
const LOOK_NS: i64 = 20_000_000;
/// Variances of the position \[m²\] and the heading \[rad²\] after a jump of the clock back: the
/// expected drift of odometry.
const AFTER_RESET_VARIANCES: (f64, f64) = (0.25, 0.03);
/// Period of a background slice when live \[ns\]. A slice takes some milliseconds; a scan waits for at most
/// one.
const SLICE_NS: i64 = 4_000_000;
/// Default names of the base frame, preferred first.
const BASES: [&str; 2] = ["base_footprint", "base_link"];
/// Slices of work after each scan in a run with a real time factor.
const FEW_SLICES: usize = 4;

/// Distribution of the background work in lockstep. When live it runs between scans on the node's own
/// thread, whatever this setting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pace {
    /// All of it before the next scan: the result equals that of `periplus slam` on a log.
    #[default]
    Whole,
    /// A few milliseconds of it after each scan, so that no scan is late; deterministic as well.
    Sliced,
}

/// State of a mapper for observers.
#[derive(Clone, Debug)]
pub struct SlamStatus {
    /// The node.
    pub node: String,
    /// The ROS program that it replaces.
    pub program: Program,
    /// Counts of scans by outcome.
    pub counts: Counts,
    /// Scans that were left out for newer ones.
    pub left_out: u64,
    /// Scans that were dropped because a transform was missing.
    pub dropped: u64,
    /// Scans and constraints of the graph.
    pub graph: (usize, usize),
    /// Loop closure candidates with the decision on each.
    pub closures: Vec<Closure>,
    /// Pose of the robot.
    pub map_from_base: Pose2,
    /// Approximate memory of the map \[bytes\].
    pub size: usize,
    /// Current problem, if any.
    pub trouble: Option<String>,
    /// Fault of the data that is being corrected.
    pub correction: Option<MountingCorrection>,
}

/// A mapper as a managed node.
pub struct SlamNode {
    node: Node,
    pub(crate) program: Program,
    pub(crate) values: ParamValues,
    /// Typed `values`.
    pub(crate) params: NodeParams,
    /// Handle for states that are published as parameters.
    parameters: Option<Parameters>,
    pub(crate) files: Arc<dyn Files>,
    pub(crate) slices: usize,
    is_live: bool,
    pub(crate) engine: Option<Engine>,
    frames: Frames,
    pub(crate) scans: Option<ScanQueue>,
    pub(crate) outputs: Option<Outputs>,
    pub(crate) log: LogThrottle,
    pub(crate) health: SlamHealth,
    pub(crate) is_paused: bool,
    pub(crate) is_interactive: bool,
    /// Keyframes moved by hand.
    pub(crate) moved: BTreeMap<usize, Pose2>,
    /// Sequence number of the last feedback of handles.
    pub(crate) handled: u64,
    scan_count: u64,
    /// Number of engine remarks logged.
    remarked: usize,
    /// Fault of the data that is corrected before it is passed to the engine.
    pub(crate) correction: Option<Correction>,
    /// True if the map continues a stored one.
    pub(crate) is_continued: bool,
    /// True if it was logged that a fault remains.
    is_refused: bool,
    /// Pose from which odometry continues in the map.
    anchor: Option<Anchor>,
    /// A pose that a client set, for the next scan.
    said: Option<Pose2>,
    /// Stamp of the first scan of this map \[ns\].
    pub(crate) began_ns: Option<i64>,
    last: Option<Last>,
    /// True if the clock has gone back since the last scan.
    is_back_in_time: bool,
    drawer: Drawer,
    /// Map rasterized last.
    pub(crate) map: Option<OccupancyGrid>,
    drawn: Option<(usize, usize)>,
    published_ns: Option<i64>,
}

/// The last scan that was used.
struct Last {
    time_ns: i64,
    odom_from_base: Pose2,
    /// Odometry as the engine got it.
    corrected: Pose2,
}

/// Fault of the data that is being corrected.
pub(crate) struct Correction {
    pub(crate) cure: CorrectedInput,
    /// Start of the correction \[ns\].
    pub(crate) time_ns: i64,
}

impl SlamNode {
    /// A node by the name that its launch files give it, `slam_toolbox` or `slam_gmapping`, with
    /// parameters of [`Program::table`], see [`crate::slam_toolbox::read`]. Arguments of the graph go before them.
    ///
    /// # Errors
    /// When a topic or service of that name has another type.
    pub fn new(
        graph: &Graph,
        program: Program,
        values: ParamValues,
        files: Arc<dyn Files>,
        pace: Pace,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let node = graph.node(NodeSettings::new(program.node_name()))?;
        Self::at(node, program, values, files, pace)
    }

    /// As this node.
    ///
    /// # Errors
    /// When a topic or service of that name has another type.
    pub fn at(
        node: Node,
        program: Program,
        values: ParamValues,
        files: Arc<dyn Files>,
        pace: Pace,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let is_live = node.graph().is_live();
        let health = SlamHealth::new(&node)?;
        let state = Self {
            node: node.clone(),
            program,
            params: NodeParams::new(program, &values),
            values: values.clone(),
            parameters: None,
            files,
            slices: match (is_live, pace) {
                (true, _) => 0,
                (false, Pace::Whole) => usize::MAX,
                (false, Pace::Sliced) => FEW_SLICES,
            },
            is_live,
            engine: None,
            frames: Frames::default(),
            scans: None,
            outputs: None,
            log: LogThrottle::default(),
            health,
            is_paused: false,
            is_interactive: false,
            moved: BTreeMap::new(),
            handled: 0,
            scan_count: 0,
            remarked: 0,
            correction: None,
            is_continued: false,
            is_refused: false,
            anchor: None,
            said: None,
            began_ns: None,
            last: None,
            is_back_in_time: false,
            drawer: Drawer::new(is_live),
            map: None,
            drawn: None,
            published_ns: None,
        };
        let mut actor = node.actor(state);
        let parameters = actor.parameters(values, |state, values, _| state.change(values))?;
        for name in ["interactive_mode", "paused_processing"] {
            // States: they begin as false, whatever a file has.
            if program.is_toolbox() && parameters.values().flag(name) == Some(true) {
                let _ = parameters.set(name, ParamValue::Bool(false));
            }
        }
        let values = parameters.values();
        let params = NodeParams::new(program, &values);
        actor.with(|state| {
            state.values = values;
            state.params = params.clone();
            state.parameters = Some(parameters);
            if let Some(buffer_ns) = params.transform_buffer_ns {
                state.frames = Frames::kept_for(buffer_ns);
            }
        });
        actor.subscribe::<TFMessage>("/tf_static", Qos::latched(100), |state, message, _| {
            state.frames.take(&message, TransformKind::Fixed);
        })?;
        // Scans wait for transforms.
        actor.subscribe::<TFMessage>("/tf", Qos::reliable(1000), |state, message, io| {
            state.frames.take(&message, TransformKind::Moving);
            state.work(io.node());
        })?;
        actor.timer(LOOK_NS, |state, io| state.work(io.node()))?;
        actor.timer(health::EVERY_NS, |state, io| state.publish_health(io.node()))?;
        if is_live {
            actor.timer(SLICE_NS, |state, _| {
                if let Some(slam) = state.engine.as_mut().and_then(Engine::graph_mut) {
                    slam.work_slices(1);
                }
            })?;
        }
        if params.transform_period_ns > 0 {
            actor.timer(params.transform_period_ns, |state, io| {
                state.publish_transform(io.now_ns());
            })?;
        }
        actor.on_jump(|state, io| {
            state.frames.forget();
            let now_ns = io.now_ns();
            if let Some(scans) = &mut state.scans {
                scans.clear(now_ns);
            }
            state.published_ns = None;
            if state.last.as_ref().is_some_and(|last| now_ns < last.time_ns) {
                state.is_back_in_time = true;
                let words = "time went back: transforms and scans of before are dropped; the robot is \
                             expected where odometry has it on this map";
                io.node().log(Level::Warn, words);
            }
        });
        // `slam_gmapping` does not subscribe to it; a client that publishes one gets the reason in the log.
        actor.subscribe("initialpose", Qos::reliable(10), |state, message, io| {
            state.set_pose(&message, io.node());
        })?;
        if program.is_toolbox() {
            actor.subscribe("slam_toolbox/feedback", Qos::reliable(10), |state, message, io| {
                state.drag(&message, io.node());
            })?;
        }
        services::serve(&mut actor, program, &params)?;
        LifecycleNode::new(actor)
    }

    /// The pose graph, if the program has one and is configured.
    #[must_use]
    pub fn graph(&self) -> Option<&Slam> {
        self.engine.as_ref().and_then(Engine::graph)
    }

    /// Renders the current map.
    #[must_use]
    pub fn map(&self) -> Option<OccupancyGrid> {
        self.engine.as_ref().and_then(|engine| engine.mapper().map())
    }
}

impl LifecycleCallbacks for SlamNode {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let node = io.node();
        for finding in tables::conflicts(&self.values) {
            node.log_finding(&finding);
        }
        self.is_paused = self.params.is_paused;
        let is_newest_first = self.is_live && self.program != Program::Sync;
        let ports = scan_queue(node, &self.params, is_newest_first)
            .and_then(|it| Ok((it, Outputs::new(node, self.program, &self.params)?)));
        match ports {
            Ok((scans, outputs)) => {
                self.scans = Some(scans);
                self.outputs = Some(outputs);
            }
            Err(error) => {
                self.log.report(&Diagnostic::error("no-topics", error.to_string()), node);
                return StepOutcome::Failure;
            }
        }
        self.begin(Engine::empty(self.program, &self.values, self.slices));
        let file = self.params.map_file_name.clone();
        if !file.is_empty() {
            let start = self.map_start(node);
            if !self.load(&file, self.program == Program::Localization, start, node) {
                return StepOutcome::Failure;
            }
        }
        StepOutcome::Success
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        if let Some(scans) = &mut self.scans {
            scans.clear(io.now_ns());
        }
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.scans = None;
        self.outputs = None;
        self.begin(None);
        self.correction = None;
        self.log = LogThrottle::default();
        StepOutcome::Success
    }
}

impl SlamNode {
    /// Starts with another map, or with none.
    pub(crate) fn begin(&mut self, engine: Option<Engine>) {
        self.engine = engine;
        self.moved.clear();
        self.remarked = 0;
        self.is_continued = false;
        self.is_refused = false;
        self.anchor = None;
        self.said = None;
        self.began_ns = None;
        self.health.forget();
        self.last = None;
        self.drawer.forget();
        self.map = None;
        self.drawn = None;
        self.published_ns = None;
    }

    /// Names of the frames.
    pub(crate) fn names(&self) -> Names {
        let params = &self.params;
        let [map, odom, told] = [&params.map_frame, &params.odom_frame, &params.base_frame]
            .map(|name| plain(name).to_owned());
        // By default the frame among the usual ones that is connected to odometry.
        let leads = |base: &str| self.frames.at(&odom, base, 0).is_ok();
        let base = if params.is_base_frame_given || leads(&told) {
            told
        } else {
            BASES.into_iter().find(|base| leads(base)).map_or(told, str::to_owned)
        };
        Names { map, odom, base }
    }

    fn work(&mut self, node: &Node) {
        let now_ns = node.now_ns();
        let Some(scans) = &mut self.scans else { return };
        let is_working = node.is_active() && !self.is_paused;
        if !is_working {
            scans.clear(now_ns);
        }
        scans.receive(now_ns);
        if let Some(silence) = scans.silence(node).filter(|_| is_working) {
            self.log.report(&silence, node);
        }
        // Scans wait meanwhile, as in `slam_toolbox`: what is moved by hand stays where it is put.
        if self.is_interactive && self.program == Program::Sync {
            return;
        }
        let names = self.names();
        let mut complaints = Vec::new();
        while let Some(scan) = self
            .scans
            .as_mut()
            .and_then(|scans| scans.next(&self.frames, &names.robot(), now_ns, &mut complaints))
        {
            self.take(&scan, &names, node);
            if self.is_live {
                // Other nodes run in between.
                break;
            }
        }
        for complaint in complaints {
            self.log.report(&complaint, node);
        }
        if node.is_active() {
            self.publish_map(now_ns, &names, node);
        }
    }

    fn take(&mut self, scan: &TransformedScan, names: &Names, node: &Node) {
        let TransformedScan { message, transforms } = scan;
        self.scan_count += 1;
        if !(self.scan_count - 1).is_multiple_of(self.params.throttle_scans.max(1) as u64) {
            return;
        }
        let time_ns = message.header.stamp.ns();
        let interval_ns = self.params.min_scan_interval_ns;
        let is_early = |last: &Last| (0..interval_ns).contains(&(time_ns - last.time_ns));
        if self.last.as_ref().is_some_and(is_early) {
            return;
        }
        if self.engine.is_none() {
            let words = "there is no stored graph to find the robot on";
            let help = "set `map_file_name` to a session, or call `slam_toolbox/deserialize_map`";
            self.log.report(&Diagnostic::error("no-graph", words).help(help), node);
            return;
        }
        let scan = laser_scan(message, transforms.base_from_laser);
        let odom_from_base = transforms.odom_from_base;
        let Some((mut update, mut corrected)) = self.add(&scan, odom_from_base) else { return };
        self.log_remarks(node);
        if let Some(again) = self.correct(&scan, odom_from_base, names, node) {
            (update, corrected) = again;
        }
        let Some(engine) = &self.engine else { return };
        let covariance = engine.covariance();
        match update.outcome {
            ScanOutcome::Rejected(reason) => {
                let words = format!("scans are rejected: {reason}");
                self.log.report(&Diagnostic::error("bad-scan", words), node);
                return;
            }
            ScanOutcome::NoMatch => {
                let words = "a scan does not match the map; the pose is that of odometry";
                let help = "if this continues, the robot was carried or the wheels slip: set its \
                            pose with `initialpose`";
                self.log.report(&Diagnostic::warning("lost-scan", words).help(help), node);
            }
            ScanOutcome::Inserted | ScanOutcome::BelowMotionThreshold => self.log.clear_error(),
        }
        self.health.count(update.outcome);
        self.last = Some(Last { time_ns, odom_from_base, corrected });
        let Some(outputs) = &self.outputs else { return };
        outputs.publish_pose(update.map_from_base, &self.scaled(&covariance), time_ns, &names.map);
        if update.outcome == ScanOutcome::Inserted {
            outputs.publish_scan(message);
        }
    }

    /// Passes a scan to the engine, with a known fault of the data corrected; also returns the
    /// corrected odometry.
    fn add(&mut self, scan: &LaserScan2, odom_from_base: Pose2) -> Option<(Update, Pose2)> {
        let engine = self.engine.as_mut()?;
        let cured = self.correction.as_mut().map(|it| it.cure.apply(scan, Some(odom_from_base)));
        let (scan, corrected) = match &cured {
            Some((scan, corrected)) => (scan, corrected.unwrap_or(odom_from_base)),
            None => (scan, odom_from_base),
        };
        if std::mem::take(&mut self.is_back_in_time)
            && let Some(last) = &self.last
        {
            // A reset sets robot and odometry back together, so the map is still where it was in
            // odometry. The engine alone would take that step for a slip.
            let map_from_odom = engine.mapper().map_from_base() * last.corrected.inverse();
            let map_from_base = (map_from_odom * corrected).normalized();
            let (place_m2, yaw_rad2) = AFTER_RESET_VARIANCES;
            engine.place(map_from_base, Symmetric3::diagonal(place_m2, place_m2, yaw_rad2));
            self.said = Some(map_from_base);
        }
        let update = engine.add_scan(scan, corrected);
        if !matches!(update.outcome, ScanOutcome::Rejected(_)) {
            self.began_ns.get_or_insert(scan.time_ns);
            match (&mut self.anchor, self.said.take()) {
                (anchor, Some(said)) => *anchor = Some(Anchor::new(said, odom_from_base)),
                (Some(anchor), None) => anchor.follow(odom_from_base),
                (anchor @ None, None) => {
                    *anchor = Some(Anchor::new(update.map_from_base, odom_from_base));
                }
            }
        }
        Some((update, corrected))
    }

    fn log_remarks(&mut self, node: &Node) {
        let remarks = self.engine.as_ref().map_or(&[][..], |engine| engine.mapper().remarks());
        for remark in remarks.iter().skip(self.remarked) {
            node.log(Level::Warn, remark);
        }
        self.remarked = remarks.len();
    }

    /// Restarts the map, at most once, when a fault of the data is certain and can be corrected.
    /// Returns the outcome of the scan in the new map.
    fn correct(
        &mut self,
        scan: &LaserScan2,
        odom_from_base: Pose2,
        names: &Names,
        node: &Node,
    ) -> Option<(Update, Pose2)> {
        let remarks = self.engine.as_ref().map_or(&[][..], |engine| engine.mapper().remarks());
        let remedy = MountingCorrection::of(remarks)?;
        let is_wanted = self.params.corrects_mounting;
        if !is_wanted || self.is_continued || self.correction.is_some() {
            if !std::mem::replace(&mut self.is_refused, true) {
                let why = if !is_wanted {
                    "`correct_mounting` is false"
                } else if self.is_continued {
                    "the map continues a stored one"
                } else {
                    "another fault is corrected already, so that neither is certain"
                };
                let words = format!(
                    "the map is wrong, and it is not begun again, since {why}: set the scanner's \
                     transform or the drive's odometry right and map again"
                );
                node.log(Level::Warn, words);
            }
            return None;
        }
        let (cure, map_from_base) = self.anchor.as_ref()?.corrected(remedy, odom_from_base);
        self.begin(Engine::empty(self.program, &self.values, self.slices));
        self.correction = Some(Correction { cure, time_ns: scan.time_ns });
        if let Some(engine) = &mut self.engine
            && engine.place(map_from_base, SURE)
        {
            self.said = Some(map_from_base);
        }
        let again = self.add(scan, odom_from_base);
        let here = again.map_or(map_from_base, |it| it.0.map_from_base);
        let words = format!(
            "the map begins again: {remedy}. What was mapped before is dropped. The robot is at ({:.2}, \
             {:.2}, {:.2}) in `{}`, where it would have been from the beginning without the fault; drive \
             again where it has been. {}{}. `correct_mounting: false` maps the data as it is",
            here.x_m,
            here.y_m,
            here.yaw_rad,
            names.map,
            SET_RIGHT[..1].to_uppercase(),
            &SET_RIGHT[1..]
        );
        node.log(Level::Warn, words);
        again
    }

    /// Scales a covariance by `position_covariance_scale` and `yaw_covariance_scale`.
    fn scaled(
        &self,
        covariance: &periplus_scan_matching::Symmetric3,
    ) -> periplus_scan_matching::Symmetric3 {
        let place = self.params.position_covariance_scale;
        let heading = self.params.yaw_covariance_scale;
        let both = (place * heading).sqrt();
        let periplus_scan_matching::Symmetric3 { xx, xy, xt, yy, yt, tt } = *covariance;
        periplus_scan_matching::Symmetric3 {
            xx: place * xx,
            xy: place * xy,
            xt: both * xt,
            yy: place * yy,
            yt: both * yt,
            tt: heading * tt,
        }
    }

    fn publish_transform(&mut self, now_ns: i64) {
        let (Some(outputs), Some(engine), Some(last)) = (&self.outputs, &self.engine, &self.last)
        else {
            return;
        };
        // After a jump back the time of the last scan has not come yet.
        if !self.node.is_active() || self.is_back_in_time {
            return;
        }
        let stamp = self.params.transform_stamp;
        let from_ns = if stamp.is_of_publication { now_ns } else { last.time_ns };
        let time_ns = from_ns.saturating_add(stamp.ahead_ns);
        // The map may have been revised since the scan arrived.
        let map_from_odom =
            (engine.mapper().map_from_base() * last.odom_from_base.inverse()).normalized();
        let names = self.names();
        outputs.publish_transform(&names.map, &names.odom, map_from_odom, time_ns);
    }

    /// Rasterizes the map when it has changed, and publishes it periodically: the first one at
    /// once.
    fn publish_map(&mut self, now_ns: i64, names: &Names, node: &Node) {
        let (Some(outputs), Some(engine)) = (&self.outputs, &self.engine) else { return };
        if let Some(map) = self.drawer.take() {
            match map {
                Some(map) => {
                    outputs.publish_map(&map, now_ns, &names.map);
                    self.map = Some(map);
                }
                None => {
                    let words = "the map is too large to draw";
                    let help = "set a coarser `resolution` or a smaller `max_laser_range`";
                    self.log.report(&Diagnostic::error("large-map", words).help(help), node);
                }
            }
        }
        let interval_ns = self.params.map_interval_ns;
        let is_stored = matches!(engine, Engine::Localizer(_));
        let is_due =
            self.published_ns.is_none_or(|last_ns| !(0..interval_ns).contains(&(now_ns - last_ns)));
        if !is_due || self.drawer.is_busy() || (engine.mapper().counts().kept == 0 && !is_stored) {
            return;
        }
        self.published_ns = Some(now_ns);
        let version = engine.version();
        if let Some(entropy) = engine.entropy() {
            outputs.publish_entropy(entropy);
        }
        outputs.publish_graph(|| {
            engine.graph().map_or_else(Default::default, |slam| {
                markers::graph(slam, &self.moved, &names.map, now_ns)
            })
        });
        // Viewers that came since the last change see them, too.
        self.health.draw_again(|drawn| self.draw_contradictions(now_ns, drawn));
        if self.is_interactive {
            self.handled += 1;
            outputs.publish_handles(self.handled, || self.handles(now_ns));
        }
        match &self.map {
            // Latecomers without memory get it again.
            Some(map) if self.drawn == Some(version) => {
                outputs.publish_map(map, now_ns, &names.map);
            }
            _ => {
                self.drawn = Some(version);
                self.drawer.begin(engine.drawing());
                if !self.is_live {
                    self.publish_map(now_ns, names, node);
                }
            }
        }
    }

    /// Publishes the present map and graph, without waiting for `map_update_interval`: at the end of a recording there is
    /// no later time.
    pub fn publish_present_map(&mut self) {
        let node = self.node.clone();
        let (names, now_ns) = (self.names(), node.now_ns());
        self.published_ns = None;
        self.publish_map(now_ns, &names, &node);
    }

    /// Returns the current state.
    #[must_use]
    pub fn status(&self) -> SlamStatus {
        let mapper = self.engine.as_ref().map(Engine::mapper);
        let graph = self.engine.as_ref().and_then(Engine::graph);
        SlamStatus {
            node: self.node.full_name().to_owned(),
            program: self.program,
            counts: mapper.map(periplus_slam::Mapper::counts).unwrap_or_default(),
            left_out: self.scans.as_ref().map_or(0, ScanQueue::superseded),
            dropped: self.scans.as_ref().map_or(0, ScanQueue::without_transforms),
            graph: graph.map_or((0, 0), |slam| (slam.poses().len(), slam.links().count())),
            closures: mapper.map(|it| it.closures().to_vec()).unwrap_or_default(),
            map_from_base: mapper.map_or(Pose2::IDENTITY, periplus_slam::Mapper::map_from_base),
            size: mapper.map_or(0, periplus_slam::Mapper::size),
            trouble: self.log.error.clone(),
            correction: self.correction.as_ref().map(|it| it.cure.remedy()),
        }
    }
}
