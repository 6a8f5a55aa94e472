//! EKF node.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_ekf::Variable;
use periplus_ekf::{
    Covariance, Ekf, EkfParams, Estimate, Intake, Refusal, Settings, State as Numbers,
};
use periplus_geometry::Pose;
use periplus_graph::{Actor, GraphError, Level, Node, ParameterRejection, Qos};
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::std_srvs::{Empty, EmptyResponse};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_params::ParamValues;
use periplus_tf::TransformKind;
use periplus_tf_ros::{Frames, LogThrottle, plain, transform};

use crate::ekf_node::inputs::{Desk, hear};
use crate::ekf_node::messages::pose;
use crate::ekf_node::outputs::{Health, Outputs};

/// Period of the diagnostics \[ns\].
const HEALTH_NS: i64 = 1_000_000_000;

/// Filter node.
pub struct EkfNode {
    actor: Actor<State>,
}

pub(crate) struct State {
    params: EkfParams,
    ekf: Ekf,
    intakes: Vec<Intake>,
    /// Reason for which each input is dropped.
    troubles: Vec<Option<String>>,
    frames: Frames,
    outputs: Outputs,
    log: LogThrottle,
    is_enabled: bool,
    published_ns: Option<i64>,
    refused: Vec<(String, u64)>,
    last_ns: i64,
}

impl EkfNode {
    /// Creates the filter with settings and the parameters of [`periplus_ekf::EKF`] that they were
    /// read from.
    /// # Errors
    /// When a topic or service exists with another type.
    pub fn at(node: Node, settings: Settings, values: ParamValues) -> Result<Self, GraphError> {
        let params = EkfParams::from_values(&values);
        if settings.sources.is_empty() {
            let missing =
                Diagnostic::error("no-inputs", "the filter has no inputs, and publishes nothing")
                    .help("set `odom0`, `imu0`, `pose0` or `twist0` to a topic, and its `_config`");
            node.log_finding(&missing);
        }
        let state = State {
            outputs: Outputs::new(&node, params.publish_acceleration)?,
            intakes: settings.sources.iter().cloned().map(Intake::new).collect(),
            troubles: vec![None; settings.sources.len()],
            is_enabled: !params.disabled_at_startup,
            ekf: Ekf::new(settings.clone()),
            params,
            frames: Frames::default(),
            log: LogThrottle::default(),
            published_ns: None,
            refused: Vec::new(),
            last_ns: node.now_ns(),
        };
        let mut actor = node.actor(state);
        let parameters = actor.parameters(values, |state, values, _| state.change(values))?;
        let given = parameters.values();
        actor
            .with(|state| state.apply(&given))
            .map_err(|why| GraphError::Value { reason: why.to_string() })?;
        let params = EkfParams::from_values(&given);
        let node = actor.node().clone();
        actor.with(|state| {
            state.is_enabled = !params.disabled_at_startup;
            state.outputs.set_acceleration(&node, params.publish_acceleration)
        })?;
        actor.subscribe::<TFMessage>("/tf_static", Qos::latched(100), |state, message, _| {
            state.frames.take(&message, TransformKind::Fixed);
        })?;
        actor.subscribe::<TFMessage>("/tf", Qos::reliable(1000), |state, message, _| {
            state.frames.take(&message, TransformKind::Moving);
        })?;
        for (number, source) in settings.sources.iter().enumerate() {
            hear(&mut actor, source, number)?;
        }
        actor.subscribe("set_pose", Qos::reliable(1), |state, message, io| {
            state.set_pose(&message, io.node());
        })?;
        actor.serve::<Empty>("enable", |state, _, io| {
            state.is_enabled = true;
            io.node().log(Level::Info, "the filter is enabled");
            EmptyResponse::default()
        })?;
        actor.serve::<Empty>("reset", |state, _, io| {
            state.reset();
            io.node().log(Level::Info, "the filter was reset");
            EmptyResponse::default()
        })?;
        let frequency_hz = params.frequency_hz;
        let period_ns = (1e9 / frequency_hz).max(1.0) as i64;
        actor.timer(period_ns, |state, io| state.tick(io.node()))?;
        actor.timer(HEALTH_NS, |state, io| state.show(io.node()))?;
        actor.on_jump(|state, io| state.jump(io.node()));
        Ok(Self { actor })
    }

    /// Returns the node.
    #[must_use]
    pub fn node(&self) -> &Node {
        self.actor.node()
    }

    /// Returns the estimate.
    #[must_use]
    pub fn estimate(&self) -> Option<Estimate> {
        self.actor.with(|state| state.ekf.estimate().cloned())
    }
}

impl State {
    /// Returns the frame of the estimate.
    fn world(&self) -> String {
        self.params.world_frame.clone().unwrap_or_else(|| self.params.odom_frame.clone())
    }

    /// Processes a message of an input.
    pub(crate) fn take(
        &mut self,
        number: usize,
        node: &Node,
        read: impl FnOnce(&mut Desk<'_>) -> Result<(), Box<Diagnostic>>,
    ) {
        if !self.is_enabled {
            return;
        }
        let (world, base) = (self.world(), self.params.base_link_frame.clone());
        let Some(intake) = self.intakes.get_mut(number) else { return };
        let mut desk =
            Desk { intake, ekf: &mut self.ekf, frames: &self.frames, world: &world, base: &base };
        let trouble = read(&mut desk).err();
        self.troubles[number] = trouble.as_ref().map(|it| it.message.clone());
        if let Some(why) = trouble {
            self.log.report(&why, node);
        }
    }

    fn tick(&mut self, node: &Node) {
        let now_ns = node.now_ns();
        self.last_ns = now_ns;
        if !self.is_enabled || !self.ekf.run_until(now_ns) {
            return;
        }
        for refusal in self.ekf.take_refusals() {
            self.count(refusal, node);
        }
        let estimate = match self.params.predict_to_current_time {
            true => self.ekf.predicted(now_ns),
            false => self.ekf.estimate().cloned(),
        };
        // Each stamp is published once.
        let Some(estimate) =
            estimate.filter(|it| self.published_ns.is_none_or(|last| last < it.time_ns))
        else {
            return;
        };
        self.published_ns = Some(estimate.time_ns);
        let (world, base) = (self.world(), self.params.base_link_frame.clone());
        let output = self.params.base_link_frame_output.clone();
        self.outputs.publish(&estimate, plain(&world), plain(output.as_ref().unwrap_or(&base)));
        if self.params.publish_tf {
            let output = output.unwrap_or_else(|| base.clone());
            self.publish_transform(&estimate, &world, &output, node);
        }
    }

    fn publish_transform(&mut self, estimate: &Estimate, world: &str, base: &str, node: &Node) {
        let offset_ns = (self.params.transform_time_offset_s * 1e9) as i64;
        let time_ns = estimate.time_ns.saturating_add(offset_ns);
        let (map, odom) = (self.params.map_frame.clone(), self.params.odom_frame.clone());
        let world_from_base = estimate.world_from_base();
        if plain(world) != plain(&map) || plain(world) == plain(&odom) {
            self.outputs.tf.publish(transform(plain(world), plain(base), world_from_base, time_ns));
            return;
        }
        // Another node publishes the pose in odom; the remainder is `map_from_odom`.
        let then = self.frames.at(base, &odom, estimate.time_ns);
        match then.or_else(|_| self.frames.at(base, &odom, 0)) {
            Ok((base_from_odom, _)) => {
                let map_from_odom: Pose = world_from_base * base_from_odom;
                self.outputs.tf.publish(transform(
                    plain(&map),
                    plain(&odom),
                    map_from_odom,
                    time_ns,
                ));
            }
            Err(_) => {
                let why = self.frames.missing(&odom, base);
                let lost = Diagnostic::error(
                    "no-odometry",
                    format!(
                        "no transform from `{base}` to `{odom}`, so none to `{map}` is published: \
                         {why}"
                    ),
                )
                .help(
                    "start a node that publishes odometry, or set `world_frame` to the frame of \
                     odometry",
                );
                self.log.report(&lost, node);
            }
        }
    }

    fn count(&mut self, refusal: Refusal, node: &Node) {
        let (source, finding) = match refusal {
            Refusal::TooFar { source, .. } => (source, None),
            Refusal::Broken { source } => {
                let words = format!(
                    "a measurement of `{source}` is not a number, or its covariance is none"
                );
                (source, Some(Diagnostic::warning("broken-input", words)))
            }
        };
        if let Some(finding) = finding {
            self.log.report(&finding, node);
        }
        match self.refused.iter_mut().find(|(it, _)| *it == source) {
            Some((_, count)) => *count += 1,
            None => self.refused.push((source, 1)),
        }
    }

    fn show(&mut self, node: &Node) {
        if !self.params.print_diagnostics {
            return;
        }
        let health = Health {
            node: node.full_name(),
            trouble: self.troubles.iter().flatten().next().map(String::as_str),
            estimate: self.ekf.estimate(),
            refused: &self.refused,
        };
        self.outputs.publish_health(&health, node.now_ns());
    }

    /// Sets the pose from a message on `set_pose`.
    fn set_pose(&mut self, message: &PoseWithCovarianceStamped, node: &Node) {
        let (world, frame) = (self.world(), plain(&message.header.frame_id));
        let is_elsewhere = !frame.is_empty() && frame != plain(&world);
        let Some(world_from_base) = pose(&message.pose.pose).filter(|_| !is_elsewhere) else {
            let why = match is_elsewhere {
                true => format!("it is in `{frame}`, not in `{world}`"),
                false => "its quaternion has no length".to_owned(),
            };
            let bad =
                Diagnostic::error("bad-pose", format!("a pose to start from is refused: {why}"));
            node.log_finding(&bad);
            return;
        };
        let stamp_ns = message.header.stamp.ns();
        let mut estimate = Estimate {
            time_ns: if stamp_ns == 0 { node.now_ns() } else { stamp_ns },
            state: Numbers::zeros(),
            covariance: Covariance::from_diagonal_element(1e-9),
        };
        let (place, rpy) = (world_from_base.translation, world_from_base.rpy());
        let numbers = [place.x, place.y, place.z, rpy.roll, rpy.pitch, rpy.yaw];
        for (row, number) in numbers.into_iter().enumerate() {
            estimate.state[Variable::X.at() + row] = number;
            for column in 0..6 {
                estimate.covariance[(row, column)] = message.pose.covariance[row * 6 + column];
            }
        }
        self.intakes.iter_mut().for_each(Intake::forget);
        self.published_ns = None;
        self.ekf.set_estimate(estimate);
    }

    fn reset(&mut self) {
        self.ekf.reset();
        self.intakes.iter_mut().for_each(Intake::forget);
        self.published_ns = None;
        self.refused.clear();
    }

    /// Applies parameters that change while the node runs.
    fn change(&mut self, values: &ParamValues) -> Result<(), ParameterRejection> {
        let (old, new) = (&self.params, EkfParams::from_values(values));
        let fixed = [
            ("frequency", old.frequency_hz != new.frequency_hz),
            ("publish_acceleration", old.publish_acceleration != new.publish_acceleration),
        ];
        if let Some((name, _)) = fixed.into_iter().find(|(_, differs)| *differs) {
            return Err(ParameterRejection::new(format_args!(
                "`{name}` is read when the node starts; restart the node"
            )));
        }
        self.apply(values)
    }

    fn apply(&mut self, values: &ParamValues) -> Result<(), ParameterRejection> {
        let mut findings = Diagnostics::new();
        let sources = self.ekf.settings().sources.clone();
        let settings = Settings::of(values, sources, &mut findings);
        if let Some(bad) = findings.iter().next() {
            return Err(ParameterRejection::new(&bad.message));
        }
        self.ekf.set_settings(settings);
        self.params = EkfParams::from_values(values);
        Ok(())
    }

    /// Handles a jump of the clock.
    fn jump(&mut self, node: &Node) {
        // Time advances with each timer tick; an earlier time is a jump back.
        let now_ns = node.now_ns();
        let went_back = now_ns < std::mem::replace(&mut self.last_ns, now_ns);
        self.frames.forget();
        self.published_ns = None;
        // The state has a stamp in the future; without a reset it would not be updated until then.
        if went_back || self.params.reset_on_time_jump {
            self.reset();
            node.log(
                Level::Warn,
                "time went back: the filter starts again with the next measurements",
            );
        }
    }
}
