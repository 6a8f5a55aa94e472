//! The node.

use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;
use periplus_graph::{
    Actor, Graph, GraphError, Level, Lifecycle, Node, NodeSettings, Qos, Step, StepOutcome,
    Transition,
};
use periplus_localization::{Amcl, Covariance2, Guess, Settings, Status, Update};
use periplus_maps::from_message;
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_params::ParamValues;
use periplus_tf::Kind;
use periplus_tf_ros::{Frames, Told, plain};

use crate::Files;
use crate::amcl::inputs::{Inputs, NO_SCANS, Names, Placed};
use crate::amcl::messages::{pose2, scan};
use crate::amcl::outputs::{Health, Outputs};
use crate::amcl::saved;
use crate::amcl::services;

pub use crate::amcl::file::read;

/// How often it is looked for what waits \[ns\]; transforms that come are a reason, too.
const LOOK_NS: i64 = 20_000_000;
/// How often the state is published when nothing changes \[ns\].
const STATUS_NS: i64 = 1_000_000_000;
/// An initial pose that is older and cannot be brought to now is told \[ns\].
const OLD_NS: i64 = 500_000_000;

/// AMCL as a managed node.
pub struct AmclNode {
    actor: Actor<State>,
    life: Lifecycle,
}

pub(crate) struct State {
    values: ParamValues,
    settings: Settings,
    files: Arc<dyn Files>,
    pub(crate) amcl: Option<Amcl>,
    frames: Frames,
    inputs: Option<Inputs>,
    outputs: Option<Outputs>,
    pub(crate) is_active: bool,
    was_active: bool,
    /// An initial pose that came before the node was active.
    early: Option<PoseWithCovarianceStamped>,
    /// Where the robot was when the node was cleaned up.
    last: Option<(Pose2, Covariance2)>,
    pub(crate) told: Told,
    saved_ns: Option<i64>,
    /// When the state was published, and what it was.
    shown: Option<(i64, Status, Option<String>)>,
}

impl AmclNode {
    /// A node `amcl`, with parameters of [`periplus_localization::AMCL`], see [`read`]. Arguments of
    /// the graph go before them.
    ///
    /// # Errors
    /// When a topic or service of that name has another type.
    pub fn new(
        graph: &Graph,
        values: ParamValues,
        files: Arc<dyn Files>,
    ) -> Result<Self, GraphError> {
        Self::at(graph.node(NodeSettings::new("amcl"))?, values, files)
    }

    /// As this node.
    ///
    /// # Errors
    /// When a topic or service of that name has another type.
    pub fn at(node: Node, values: ParamValues, files: Arc<dyn Files>) -> Result<Self, GraphError> {
        let settings = Settings::of(&values);
        let state = State {
            values: values.clone(),
            settings,
            files,
            amcl: None,
            frames: Frames::default(),
            inputs: None,
            outputs: None,
            is_active: false,
            was_active: false,
            early: None,
            last: None,
            told: Told::default(),
            saved_ns: None,
            shown: None,
        };
        let mut actor = node.actor(state);
        let parameters =
            actor.parameters(values, |state, values, io| state.change(values, io.node()))?;
        let given = parameters.values();
        actor.with(|state| {
            state.settings = Settings::of(&given);
            state.values = given;
        });
        actor.subscribe("initialpose", Qos::reliable(10), |state, message, io| {
            state.set_pose(&message, io.node());
        })?;
        actor.subscribe::<TFMessage>("/tf_static", Qos::latched(100), |state, message, _| {
            state.frames.take(&message, Kind::Fixed);
        })?;
        // Scans wait for transforms.
        actor.subscribe::<TFMessage>("/tf", Qos::reliable(1000), |state, message, io| {
            state.frames.take(&message, Kind::Moving);
            state.work(io.node());
        })?;
        actor.timer(LOOK_NS, |state, io| state.work(io.node()))?;
        actor.on_jump(|state, io| state.jump(io.node()));
        services::serve(&mut actor)?;
        let life = actor.managed(|state, step, io| state.step(step, io.node()))?;
        Ok(Self { actor, life })
    }

    /// Configures and activates it, where no lifecycle manager does.
    pub fn start(&self) {
        self.life.change(Transition::Configure);
        self.life.change(Transition::Activate);
    }

    /// Its node.
    #[must_use]
    pub fn node(&self) -> &Node {
        self.actor.node()
    }

    /// Its life.
    #[must_use]
    pub fn life(&self) -> &Lifecycle {
        &self.life
    }

    /// Looks at the filter, once it is configured.
    pub fn look<R>(&self, look: impl FnOnce(&Amcl) -> R) -> Option<R> {
        self.actor.with(|state| state.amcl.as_ref().map(look))
    }

    /// What keeps it from its work.
    #[must_use]
    pub fn trouble(&self) -> Option<String> {
        self.actor.with(|state| state.told.trouble.clone())
    }
}

impl State {
    fn step(&mut self, step: Step, node: &Node) -> StepOutcome {
        match step {
            Step::Configure => self.configure(node),
            Step::Activate => {
                self.activate(node);
                StepOutcome::Success
            }
            Step::Deactivate => {
                self.is_active = false;
                self.save(node);
                StepOutcome::Success
            }
            Step::Cleanup | Step::Shutdown | Step::Error => {
                self.is_active = false;
                self.was_active = false;
                let known = self.amcl.as_ref().filter(|amcl| amcl.is_settled());
                let estimate = known.and_then(Amcl::estimate);
                self.last = estimate.map(|it| (it.pose, it.covariance)).or(self.last);
                self.amcl = None;
                self.inputs = None;
                self.outputs = None;
                self.shown = None;
                self.told = Told::default();
                StepOutcome::Success
            }
        }
    }

    fn configure(&mut self, node: &Node) -> StepOutcome {
        for finding in Settings::conflicts(&self.values) {
            node.log_finding(&finding);
        }
        let ports = Inputs::new(node, &self.values).and_then(|it| Ok((it, Outputs::new(node)?)));
        match ports {
            Ok((inputs, outputs)) => {
                self.inputs = Some(inputs);
                self.outputs = Some(outputs);
            }
            Err(error) => {
                node.log(Level::Error, error);
                return StepOutcome::Failure;
            }
        }
        let mut settings = self.settings.clone();
        if !self.resets() && self.last.is_some() {
            settings.start = self.last;
        } else if self.values.flag("initialize_at_saved_pose").unwrap_or_default() {
            match saved::read(&self.values, &*self.files, &settings.global_frame) {
                Ok(Some(start)) => settings.start = Some(start),
                Ok(None) => node.log(Level::Info, "there is no saved pose yet"),
                Err(why) => node.log(Level::Warn, why),
            }
        }
        self.amcl = Some(Amcl::new(settings));
        StepOutcome::Success
    }

    /// Whether each activation starts anew.
    fn resets(&self) -> bool {
        self.values.flag("always_reset_initial_pose").unwrap_or_default()
    }

    fn activate(&mut self, node: &Node) {
        self.is_active = true;
        if std::mem::replace(&mut self.was_active, true) && self.resets() {
            // All but the map is forgotten; it comes again, since it is kept for latecomers.
            self.amcl = Some(Amcl::new(self.settings.clone()));
            match Inputs::new(node, &self.values) {
                Ok(inputs) => self.inputs = Some(inputs),
                Err(error) => node.log(Level::Error, error),
            }
        }
        if let Some(inputs) = &mut self.inputs {
            inputs.forget(node.now_ns());
        }
        if let Some(early) = self.early.take() {
            self.set_pose(&early, node);
        }
    }

    /// Takes an initial pose; whether it could be.
    pub(crate) fn set_pose(&mut self, message: &PoseWithCovarianceStamped, node: &Node) -> bool {
        if !self.is_active {
            self.early = Some(message.clone());
            node.log(Level::Info, "an initial pose came; it waits until the node is active");
            return true;
        }
        let mut pose = match pose2(&message.pose.pose) {
            Ok(pose) => pose,
            Err(why) => {
                let bad =
                    Diagnostic::error("bad-guess", format!("the initial pose is refused: {why}"))
                        .help("a robot that looks along x has x = y = z = 0 and w = 1");
                node.log_finding(&bad);
                return false;
            }
        };
        pose = pose.normalized();
        let moved = self.moved_since(message.header.stamp.ns(), node);
        let guess = Guess {
            frame: message.header.frame_id.clone(),
            pose,
            covariance: message.pose.covariance,
            moved,
        };
        let Some(amcl) = &mut self.amcl else { return false };
        match amcl.set_pose(&guess) {
            Ok(doubt) => {
                let Pose2 { x_m, y_m, yaw_rad } = guess.pose * guess.moved;
                node.log(
                    Level::Info,
                    format_args!("the robot is said to be at ({x_m:.3}, {y_m:.3}, {yaw_rad:.3})"),
                );
                doubt.iter().for_each(|doubt| node.log_finding(doubt));
                amcl.request_update();
                true
            }
            Err(why) => {
                node.log_finding(&why);
                false
            }
        }
    }

    /// How odometry moved the robot since a time: `then_from_now`. Time zero is now.
    fn moved_since(&self, time_ns: i64, node: &Node) -> Pose2 {
        let age_ns = node.now_ns() - time_ns;
        if time_ns == 0 || age_ns <= 0 {
            return Pose2::IDENTITY;
        }
        let Names { odom, base } = self.names();
        self.frames.moved_since(&odom, &base, time_ns).unwrap_or_else(|| {
            if age_ns > OLD_NS {
                let age_s = age_ns as f64 * 1e-9;
                let old = Diagnostic::warning(
                    "old-guess",
                    format!(
                        "the initial pose is {age_s:.1} s old, and odometry does not reach back that \
                         far: it is taken as if it were of now"
                    ),
                )
                .help("stamp it with the time at which the robot is there, or with 0");
                node.log_finding(&old);
            }
            Pose2::IDENTITY
        })
    }

    fn names(&self) -> Names {
        let text = |name: &str| self.values.text(name).unwrap_or_default();
        Names { odom: text("odom_frame_id"), base: text("base_frame_id") }
    }

    /// Takes a map; whether it is in use now.
    pub(crate) fn take_map(&mut self, message: &OccupancyGrid, node: &Node) -> bool {
        let Some(amcl) = &mut self.amcl else { return false };
        let grid = match from_message(message) {
            Ok(grid) => grid,
            Err(why) => {
                let bad = Diagnostic::error("bad-map", format!("a map is refused: {why}"));
                self.told.tell(&bad, node);
                return false;
            }
        };
        let lattice = grid.lattice;
        match amcl.set_map(plain(&message.header.frame_id), &grid) {
            Ok(true) => {
                let (width, height, side) = (lattice.width, lattice.height, lattice.resolution_m);
                node.log(
                    Level::Info,
                    format_args!("the map has {width} by {height} cells of {side} m"),
                );
                true
            }
            Ok(false) => {
                node.log(Level::Info, "another map is ignored: `first_map_only` is set");
                false
            }
            Err(why) => {
                self.told.tell(&why, node);
                false
            }
        }
    }

    /// Takes in what has come, and uses it.
    fn work(&mut self, node: &Node) {
        if !self.is_active {
            return;
        }
        let now_ns = node.now_ns();
        if let Some(map) = self.inputs.as_mut().and_then(|inputs| inputs.map(now_ns)) {
            self.take_map(&map, node);
        }
        let names = self.names();
        if let Some(inputs) = &mut self.inputs {
            inputs.listen(now_ns);
        }
        let mut complaints = Vec::new();
        while let Some(inputs) = &mut self.inputs {
            let next = inputs.next(&self.frames, &names, now_ns, &mut complaints);
            let Some(placed) = next else { break };
            self.use_scan(&placed, &names, node);
        }
        if !self.told.has_said(NO_SCANS, now_ns) {
            complaints.extend(self.inputs.as_ref().and_then(|inputs| inputs.silence(node)));
        }
        for complaint in &complaints {
            self.told.tell(complaint, node);
        }
        self.show(node);
        self.save_when_due(node);
    }

    fn use_scan(&mut self, placed: &Placed, names: &Names, node: &Node) {
        let Some(amcl) = &mut self.amcl else { return };
        let was_settled = amcl.is_settled();
        let scan = scan(&placed.message, placed.places.base_from_laser);
        let updated = match amcl.update(placed.places.odom_from_base, &scan) {
            Ok(updated) => {
                self.told.fine();
                updated
            }
            Err(why) => {
                let why = match why.code {
                    "no-map" => self.no_map(),
                    _ => *why,
                };
                self.told.tell(&why, node);
                return;
            }
        };
        self.publish(updated.as_ref(), placed.places.time_ns, names);
        let now_settled = self.amcl.as_ref().is_some_and(Amcl::is_settled);
        if let Some(update) = updated
            && now_settled
            && !was_settled
        {
            let Pose2 { x_m, y_m, yaw_rad } = update.estimate.pose;
            node.log(
                Level::Info,
                format_args!("the robot found itself at ({x_m:.3}, {y_m:.3}, {yaw_rad:.3})"),
            );
        }
    }

    fn no_map(&self) -> Diagnostic {
        let source = self.inputs.as_ref().map(Inputs::map_source).unwrap_or_default();
        Diagnostic::error("no-map", format!("no map has come yet {source}"))
            .help("start and activate a map server, or set `map_topic`")
    }

    fn publish(&self, updated: Option<&Update>, time_ns: i64, names: &Names) {
        let (Some(amcl), Some(outputs)) = (&self.amcl, &self.outputs) else { return };
        let map = &self.settings.global_frame;
        if updated.is_some() {
            outputs.publish_particles(amcl, time_ns, map);
        }
        // One guess among others is no pose.
        if !amcl.is_settled() {
            return;
        }
        if updated.is_some() {
            outputs.publish_pose(amcl, time_ns, map);
        }
        if self.values.flag("tf_broadcast").unwrap_or(true)
            && let Some(map_from_odom) = amcl.map_from_odom()
        {
            let tolerance_s = self.values.number("transform_tolerance").unwrap_or_default();
            let until_ns = time_ns.saturating_add((tolerance_s * 1e9) as i64);
            outputs.publish_transform(map_from_odom, until_ns, (map, plain(&names.odom)));
        }
    }

    /// Publishes the state when it changes, and from time to time.
    fn show(&mut self, node: &Node) {
        let (Some(outputs), Some(amcl)) = (&self.outputs, &self.amcl) else { return };
        let now_ns = node.now_ns();
        let (status, trouble) = (amcl.status(), self.told.trouble.as_deref());
        let is_same = self.shown.as_ref().is_some_and(|(shown_ns, shown, told)| {
            (0..STATUS_NS).contains(&(now_ns - shown_ns))
                && shown.state == status.state
                && told.as_deref() == trouble
        });
        if is_same {
            return;
        }
        let health = Health { node: node.full_name(), status, trouble, amcl: Some(amcl) };
        outputs.publish_status(&health, now_ns, &self.settings.global_frame);
        self.shown = Some((now_ns, status.clone(), trouble.map(str::to_owned)));
    }

    fn save_when_due(&mut self, node: &Node) {
        let rate_hz = self.values.number("save_pose_rate").unwrap_or_default();
        let now_ns = node.now_ns();
        let is_due = rate_hz > 0.0
            && self.saved_ns.is_none_or(|saved_ns| {
                !(0.0..1.0).contains(&((now_ns - saved_ns) as f64 * 1e-9 * rate_hz))
            });
        if is_due {
            self.saved_ns = Some(now_ns);
            self.save(node);
        }
    }

    fn save(&mut self, node: &Node) {
        let Some(amcl) = self.amcl.as_ref().filter(|amcl| amcl.is_settled()) else { return };
        // Before the first scan nothing is known but what was said.
        let (Some(estimate), Some(_)) = (amcl.estimate(), amcl.map_from_odom()) else { return };
        let frame = &self.settings.global_frame;
        let done = saved::write(&self.values, &*self.files, frame, estimate.pose, node.now_ns());
        if let Err(why) = done {
            let help = "set `saved_pose_filepath` to a place that can be written, or \
                        `save_pose_rate: 0.0`";
            self.told.tell(&Diagnostic::warning("pose-not-saved", why).help(help), node);
        }
    }

    /// Takes other parameters while it runs.
    fn change(&mut self, values: &ParamValues, node: &Node) -> Result<(), String> {
        let findings = Settings::conflicts(values);
        if let Some(impossible) = findings.iter().find(|it| it.code == "more-least-than-most") {
            return Err(impossible.message.clone());
        }
        let settings = Settings::of(values);
        if let Some(amcl) = &mut self.amcl {
            if settings.global_frame == self.settings.global_frame {
                amcl.set_settings(settings.clone()).map_err(|why| why.message)?;
            } else {
                // A map in another frame is another map.
                *amcl = Amcl::new(settings.clone());
            }
        }
        let differs = |name: &str| self.values.text(name) != values.text(name);
        let (topics, frames) = (
            ["scan_topic", "map_topic", "global_frame_id"].into_iter().any(differs),
            ["odom_frame_id", "base_frame_id"].into_iter().any(differs),
        );
        let asks = self.values.flag("use_map_topic") != values.flag("use_map_topic");
        if (topics || asks)
            && let Some(inputs) = &mut self.inputs
        {
            *inputs = Inputs::new(node, values).map_err(|error| error.to_string())?;
        }
        if frames && let Some(amcl) = &mut self.amcl {
            amcl.forget_odometry();
        }
        for finding in &findings {
            node.log_finding(finding);
        }
        self.values = values.clone();
        self.settings = settings;
        Ok(())
    }

    /// The clock jumped: what was heard before is of another time.
    fn jump(&mut self, node: &Node) {
        self.frames.forget();
        if let Some(inputs) = &mut self.inputs {
            inputs.forget(node.now_ns());
        }
        // As in Nav2 the particles stay, and make the step of odometry: a reset sets the robot and its
        // odometry back together.
        self.shown = None;
        self.saved_ns = None;
    }
}
