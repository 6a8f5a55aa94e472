//! Lifecycle node of AMCL.

use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;
use periplus_graph::{
    Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node, NodeSettings,
    ParameterRejection, Qos, StepOutcome,
};
use periplus_localization::{
    Amcl, AmclParams, AmclUpdate, Covariance2, InitialPose, LocalizationStatus, Settings,
    SharedMaps,
};
use periplus_maps::from_message;
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_params::ParamValues;
use periplus_tf::TransformKind;
use periplus_tf_ros::{Frames, LogThrottle, NO_SCANS, TransformedScan, laser_scan, plain, pose2};

use crate::Files;
use crate::amcl::inputs::{FrameNames, Inputs};
use crate::amcl::outputs::{Health, Outputs};
use crate::amcl::saved_pose;
use crate::amcl::services;

/// Interval at which waiting scans are processed \[ns\]; new transforms trigger it, too.
const PROCESSING_INTERVAL_NS: i64 = 20_000_000;
/// Interval of the status without changes \[ns\].
const STATUS_INTERVAL_NS: i64 = 1_000_000_000;
/// Age of an initial pose above which missing odometry is reported \[ns\].
const MAX_POSE_AGE_NS: i64 = 500_000_000;

/// AMCL as a lifecycle node.
pub struct AmclNode {
    params: AmclParams,
    values: ParamValues,
    settings: Settings,
    maps: Arc<SharedMaps>,
    files: Arc<dyn Files>,
    pub(crate) amcl: Option<Amcl>,
    frames: Frames,
    inputs: Option<Inputs>,
    outputs: Option<Outputs>,
    was_active: bool,
    /// Initial pose that waits for activation.
    waiting_pose: Option<PoseWithCovarianceStamped>,
    /// Pose at the last cleanup.
    last_pose: Option<(Pose2, Covariance2)>,
    pub(crate) log: LogThrottle,
    saved_ns: Option<i64>,
    /// Last published status: time, status, error.
    published_status: Option<(i64, LocalizationStatus, Option<String>)>,
}

impl AmclNode {
    /// Creates a node `amcl` with parameters of [`periplus_localization::AMCL`], see
    /// [`read_parameters`](crate::amcl::read_parameters). Parameter overrides of the graph take precedence.
    ///
    /// # Errors
    /// A topic or service of that name has another type.
    pub fn new(
        graph: &Graph,
        values: ParamValues,
        files: Arc<dyn Files>,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        Self::at(graph.node(NodeSettings::new("amcl"))?, values, files)
    }

    /// Runs AMCL as a node of the graph.
    ///
    /// # Errors
    /// A topic or service of that name has another type.
    pub fn at(
        node: Node,
        values: ParamValues,
        files: Arc<dyn Files>,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let settings = Settings::from_values(&values);
        let state = Self {
            params: AmclParams::from_values(&values),
            values: values.clone(),
            settings,
            maps: Arc::default(),
            files,
            amcl: None,
            frames: Frames::default(),
            inputs: None,
            outputs: None,
            was_active: false,
            waiting_pose: None,
            last_pose: None,
            log: LogThrottle::default(),
            saved_ns: None,
            published_status: None,
        };
        let mut actor = node.actor(state);
        let parameters = actor
            .parameters(values, |state, values, io| state.set_parameters(values, io.node()))?;
        let given = parameters.values();
        actor.with(|state| {
            state.settings = Settings::from_values(&given);
            state.params = AmclParams::from_values(&given);
            state.values = given;
        });
        actor.subscribe("initialpose", Qos::reliable(10), |state, message, io| {
            state.set_pose(&message, io.node());
        })?;
        actor.subscribe::<TFMessage>("/tf_static", Qos::latched(100), |state, message, _| {
            state.frames.take(&message, TransformKind::Fixed);
        })?;
        // New transforms may complete waiting scans.
        actor.subscribe::<TFMessage>("/tf", Qos::reliable(1000), |state, message, io| {
            state.frames.take(&message, TransformKind::Moving);
            state.process(io.node());
        })?;
        actor.timer(PROCESSING_INTERVAL_NS, |state, io| state.process(io.node()))?;
        actor.on_jump(|state, io| state.on_clock_jump(io.node()));
        services::serve(&mut actor)?;
        LifecycleNode::new(actor)
    }

    /// Shares maps and their tables with the nodes of other robots. Call it before the node is configured.
    pub fn share_maps(&mut self, maps: Arc<SharedMaps>) {
        self.maps = maps;
    }

    /// The filter, once the node is configured.
    #[must_use]
    pub fn amcl(&self) -> Option<&Amcl> {
        self.amcl.as_ref()
    }

    /// Error that keeps the node from localizing.
    #[must_use]
    pub fn trouble(&self) -> Option<&str> {
        self.log.error.as_deref()
    }
}

impl LifecycleCallbacks for AmclNode {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let node = io.node();
        for finding in Settings::conflicts(&self.values) {
            node.log_finding(&finding);
        }
        let ports = Inputs::new(node, &self.params).and_then(|it| Ok((it, Outputs::new(node)?)));
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
        if !self.resets_on_activation() && self.last_pose.is_some() {
            settings.initial_pose = self.last_pose;
        } else if self.params.initialize_at_saved_pose {
            match saved_pose::read(&self.values, &*self.files, &settings.global_frame) {
                Ok(Some(start)) => settings.initial_pose = Some(start),
                Ok(None) => node.log(Level::Info, "there is no saved pose"),
                Err(why) => node.log(Level::Warn, why),
            }
        }
        self.amcl = Some(Amcl::sharing(settings, self.maps.clone()));
        StepOutcome::Success
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        let node = io.node();
        if std::mem::replace(&mut self.was_active, true) && self.resets_on_activation() {
            // Resets everything but the map, which is latched and arrives again.
            self.amcl = Some(Amcl::sharing(self.settings.clone(), self.maps.clone()));
            match Inputs::new(node, &self.params) {
                Ok(inputs) => self.inputs = Some(inputs),
                Err(error) => node.log(Level::Error, error),
            }
        }
        if let Some(inputs) = &mut self.inputs {
            inputs.scans.clear(node.now_ns());
        }
        if let Some(message) = self.waiting_pose.take() {
            self.apply_pose(&message, node);
        }
        StepOutcome::Success
    }

    fn on_deactivate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.save(io.node());
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.was_active = false;
        let known = self.amcl.as_ref().filter(|amcl| amcl.has_pose());
        let estimate = known.and_then(Amcl::estimate);
        self.last_pose = estimate.map(|it| (it.pose, it.covariance)).or(self.last_pose);
        self.amcl = None;
        self.inputs = None;
        self.outputs = None;
        self.published_status = None;
        self.log = LogThrottle::default();
        StepOutcome::Success
    }
}

impl AmclNode {
    /// True if each activation resets the pose.
    fn resets_on_activation(&self) -> bool {
        self.params.always_reset_initial_pose
    }

    /// Sets an initial pose, or keeps it until the node is active. True if it is valid.
    pub(crate) fn set_pose(&mut self, message: &PoseWithCovarianceStamped, node: &Node) -> bool {
        if node.is_active() {
            return self.apply_pose(message, node);
        }
        self.waiting_pose = Some(message.clone());
        node.log(Level::Info, "received an initial pose; it waits until the node is active");
        true
    }

    fn apply_pose(&mut self, message: &PoseWithCovarianceStamped, node: &Node) -> bool {
        let mut pose = match pose2(&message.pose.pose) {
            Ok(pose) => pose,
            Err(why) => {
                let bad =
                    Diagnostic::error("bad-guess", format!("the initial pose is invalid: {why}"))
                        .help("the identity rotation is x = y = z = 0, w = 1");
                node.log_finding(&bad);
                return false;
            }
        };
        pose = pose.normalized();
        let then_from_now = self.moved_since(message.header.stamp.ns(), node);
        let initial_pose = InitialPose {
            frame: message.header.frame_id.clone(),
            pose,
            covariance: message.pose.covariance,
            then_from_now,
        };
        let Some(amcl) = &mut self.amcl else { return false };
        match amcl.set_pose(&initial_pose) {
            Ok(warning) => {
                let Pose2 { x_m, y_m, yaw_rad } = initial_pose.pose * initial_pose.then_from_now;
                node.log(
                    Level::Info,
                    format_args!("initial pose set to ({x_m:.3}, {y_m:.3}, {yaw_rad:.3})"),
                );
                warning.iter().for_each(|warning| node.log_finding(warning));
                amcl.request_update();
                true
            }
            Err(why) => {
                node.log_finding(&why);
                false
            }
        }
    }

    /// Motion by odometry since a time: `then_from_now`. Time zero means now.
    fn moved_since(&self, time_ns: i64, node: &Node) -> Pose2 {
        let age_ns = node.now_ns() - time_ns;
        if time_ns == 0 || age_ns <= 0 {
            return Pose2::IDENTITY;
        }
        let FrameNames { odom, base } = self.frame_names();
        self.frames.moved_since(&odom, &base, time_ns).unwrap_or_else(|| {
            if age_ns > MAX_POSE_AGE_NS {
                let age_s = age_ns as f64 * 1e-9;
                let old = Diagnostic::warning(
                    "old-guess",
                    format!(
                        "the initial pose is {age_s:.1} s old, older than the odometry buffer: it is \
                         applied without the motion since then"
                    ),
                )
                .help("set the stamp to the time of the pose, or to 0 for now");
                node.log_finding(&old);
            }
            Pose2::IDENTITY
        })
    }

    fn frame_names(&self) -> FrameNames {
        FrameNames {
            odom: self.params.odom_frame_id.clone(),
            base: self.params.base_frame_id.clone(),
        }
    }

    /// Sets the map. True if it is in use.
    pub(crate) fn set_map(&mut self, message: &OccupancyGrid, node: &Node) -> bool {
        let Some(amcl) = &mut self.amcl else { return false };
        let grid = match from_message(message) {
            Ok(grid) => grid,
            Err(why) => {
                let bad = Diagnostic::error("bad-map", format!("the map is invalid: {why}"));
                self.log.report(&bad, node);
                return false;
            }
        };
        let info = grid.info;
        match amcl.set_map(plain(&message.header.frame_id), &grid) {
            Ok(true) => {
                let (width, height, side) = (info.width, info.height, info.resolution_m);
                node.log(
                    Level::Info,
                    format_args!("received a map of {width} by {height} cells of {side} m"),
                );
                true
            }
            Ok(false) => {
                node.log(Level::Info, "ignored a new map: `first_map_only` is set");
                false
            }
            Err(why) => {
                self.log.report(&why, node);
                false
            }
        }
    }

    /// Processes new maps and scans.
    fn process(&mut self, node: &Node) {
        if !node.is_active() {
            return;
        }
        let now_ns = node.now_ns();
        if let Some(map) = self.inputs.as_mut().and_then(|inputs| inputs.take_map(now_ns)) {
            self.set_map(&map, node);
        }
        let names = self.frame_names();
        if let Some(inputs) = &mut self.inputs {
            inputs.scans.receive(now_ns);
        }
        let mut reports = Vec::new();
        while let Some(inputs) = &mut self.inputs {
            let next = inputs.scans.next(&self.frames, &names.robot(), now_ns, &mut reports);
            let Some(scan) = next else { break };
            self.use_scan(&scan, &names, node);
        }
        if !self.log.was_reported(NO_SCANS, now_ns) {
            reports.extend(self.inputs.as_ref().and_then(|inputs| inputs.scans.silence(node)));
        }
        for report in &reports {
            self.log.report(report, node);
        }
        if let Some(notice) = self.outputs.as_mut().and_then(Outputs::old_topic_notice) {
            node.log_finding(&notice);
        }
        self.publish_status_when_due(node);
        self.save_when_due(node);
    }

    fn use_scan(&mut self, scan: &TransformedScan, names: &FrameNames, node: &Node) {
        let Some(amcl) = &mut self.amcl else { return };
        let had_pose = amcl.has_pose();
        let TransformedScan { message, transforms } = scan;
        let scan = laser_scan(message, transforms.base_from_laser);
        let updated = match amcl.update(transforms.odom_from_base, &scan) {
            Ok(updated) => {
                self.log.clear_error();
                updated
            }
            Err(why) => {
                let has_map = self.amcl.as_ref().is_some_and(Amcl::has_map);
                let why = if has_map { *why } else { self.no_map() };
                self.log.report(&why, node);
                return;
            }
        };
        self.publish(updated.as_ref(), transforms.time_ns, names);
        let has_pose = self.amcl.as_ref().is_some_and(Amcl::has_pose);
        if let Some(update) = updated
            && has_pose
            && !had_pose
        {
            let Pose2 { x_m, y_m, yaw_rad } = update.estimate.pose;
            node.log(
                Level::Info,
                format_args!(
                    "global localization found the pose ({x_m:.3}, {y_m:.3}, {yaw_rad:.3})"
                ),
            );
        }
    }

    fn no_map(&self) -> Diagnostic {
        let source = self.inputs.as_ref().map(Inputs::map_source).unwrap_or_default();
        Diagnostic::error("no-map", format!("no map received yet {source}"))
            .help("start and activate a map server, or set `map_topic`")
    }

    fn publish(&self, updated: Option<&AmclUpdate>, time_ns: i64, names: &FrameNames) {
        let (Some(amcl), Some(outputs)) = (&self.amcl, &self.outputs) else { return };
        let map = &self.settings.global_frame;
        if updated.is_some() {
            outputs.publish_particles(amcl, time_ns, map);
        }
        // A hypothesis among others is not published as the pose.
        if !amcl.has_pose() {
            return;
        }
        if updated.is_some() {
            outputs.publish_pose(amcl, time_ns, map);
        }
        if self.params.tf_broadcast
            && let Some(map_from_odom) = amcl.map_from_odom()
        {
            let tolerance_ns = (self.params.transform_tolerance_s * 1e9) as i64;
            let until_ns = time_ns.saturating_add(tolerance_ns);
            outputs.publish_transform(map_from_odom, until_ns, (map, plain(&names.odom)));
        }
    }

    /// Publishes the status when it changes, and at an interval.
    fn publish_status_when_due(&mut self, node: &Node) {
        let (Some(outputs), Some(amcl)) = (&self.outputs, &self.amcl) else { return };
        let now_ns = node.now_ns();
        let (status, trouble) = (amcl.status(), self.log.error.as_deref());
        let is_same =
            self.published_status.as_ref().is_some_and(|(published_ns, published, error)| {
                (0..STATUS_INTERVAL_NS).contains(&(now_ns - published_ns))
                    && published.state == status.state
                    && error.as_deref() == trouble
            });
        if is_same {
            return;
        }
        let health = Health { node: node.full_name(), status, trouble, amcl: Some(amcl) };
        outputs.publish_status(&health, now_ns, &self.settings.global_frame);
        self.published_status = Some((now_ns, status.clone(), trouble.map(str::to_owned)));
    }

    fn save_when_due(&mut self, node: &Node) {
        let rate_hz = self.params.save_pose_rate_hz;
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
        let Some(amcl) = self.amcl.as_ref().filter(|amcl| amcl.has_pose()) else { return };
        // Before the first scan only the initial pose is known.
        let (Some(estimate), Some(_)) = (amcl.estimate(), amcl.map_from_odom()) else { return };
        let frame = &self.settings.global_frame;
        let done =
            saved_pose::write(&self.values, &*self.files, frame, estimate.pose, node.now_ns());
        if let Err(why) = done {
            let help = "set `saved_pose_filepath` to a writable path, or `save_pose_rate: 0.0`";
            self.log.report(&Diagnostic::warning("pose-not-saved", why).help(help), node);
        }
    }

    /// Applies changed parameters at run time.
    fn set_parameters(
        &mut self,
        values: &ParamValues,
        node: &Node,
    ) -> Result<(), ParameterRejection> {
        if let Some(conflict) = Settings::particle_conflict(values) {
            return Err(ParameterRejection::new(conflict.message));
        }
        let settings = Settings::from_values(values);
        if let Some(amcl) = &mut self.amcl {
            if settings.global_frame == self.settings.global_frame {
                amcl.set_settings(settings.clone())
                    .map_err(|why| ParameterRejection::new(why.message))?;
            } else {
                // The map is in another frame, so it is another map.
                *amcl = Amcl::new(settings.clone());
            }
        }
        let (old, new) = (&self.params, AmclParams::from_values(values));
        let has_other_inputs = (&old.scan_topic, &old.map_topic, &old.global_frame_id)
            != (&new.scan_topic, &new.map_topic, &new.global_frame_id)
            || old.use_map_topic != new.use_map_topic;
        let has_other_frames =
            (&old.odom_frame_id, &old.base_frame_id) != (&new.odom_frame_id, &new.base_frame_id);
        if has_other_inputs && let Some(inputs) = &mut self.inputs {
            *inputs = Inputs::new(node, &new).map_err(ParameterRejection::new)?;
        }
        if has_other_frames && let Some(amcl) = &mut self.amcl {
            amcl.reset_odometry();
        }
        for finding in Settings::conflicts(values) {
            node.log_finding(&finding);
        }
        self.params = new;
        self.values = values.clone();
        self.settings = settings;
        Ok(())
    }

    /// The clock jumped: data from before is of another time.
    fn on_clock_jump(&mut self, node: &Node) {
        self.frames.forget();
        if let Some(inputs) = &mut self.inputs {
            inputs.scans.clear(node.now_ns());
        }
        // As in Nav2, particles stay and follow odometry: a reset of a simulation moves the robot
        // and its odometry together.
        self.published_status = None;
        self.saved_ns = None;
    }
}
