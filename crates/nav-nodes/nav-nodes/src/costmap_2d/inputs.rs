//! Subscriptions of layers and filters.

mod filters;

use std::sync::Arc;

use periplus_costmap::layers::{RangeLayer, RangeReading, StaticLayer};
use periplus_costmap::tables::{
    FilterParams, RangeLayerParams, SpeedFilterParams, StaticLayerParams,
};
use periplus_costmap::{
    CellWindow, CostmapConfig, DataType, Layer as _, LayerConfig, LayerKind, LayeredCostmap,
    Nav2Release, ObservationSource, Projector, ScanGeometry,
};
use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose};
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::sensor_msgs::{LaserScan, PointCloud2, Range};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::{map_msgs, nav_msgs};
use periplus_params::Params as _;
use periplus_tf_ros::{FilterOrder, FilterSettings, MessageFilter};

use crate::costmap_2d::clouds;
use crate::costmap_2d::frames::Listener;
use crate::costmap_2d::messages::map;
use crate::costmap_2d::topics::resolve;

use filters::{FilterPort, SpeedPort};

/// Time after which a message without a transform is dropped \[ns\].
const TRANSFORM_TIMEOUT_NS: i64 = 1_000_000_000;

/// Maximum number of messages of a source that wait for their transform.
const MAX_WAITING: usize = 50;

/// Queue size of a source that keeps only its newest observation.
const FEW: usize = 5;

/// Topics of layers and filters.
#[derive(Default)]
pub(crate) struct Inputs {
    sources: Vec<SourcePort>,
    maps: Vec<MapPort>,
    ranges: Vec<RangePort>,
    filters: Vec<FilterPort>,
    speeds: Vec<SpeedPort>,
}

/// Context of an update.
pub(crate) struct Scene<'a> {
    pub(crate) tf: &'a Listener,
    pub(crate) global_frame: &'a str,
    pub(crate) now_ns: i64,
}

impl Inputs {
    /// Drops queued messages.
    pub(crate) fn forget(&mut self) {
        for port in &mut self.sources {
            port.scans.filter.clear();
            port.clouds.filter.clear();
            match &port.messages {
                Messages::Scans(scans) => drop(scans.drain()),
                Messages::Clouds(clouds) => drop(clouds.drain()),
            }
        }
        for port in &mut self.ranges {
            port.waiting.filter.clear();
            port.ranges.iter().for_each(|ranges| drop(ranges.drain()));
        }
    }

    /// Subscribes to the topics of all layers and filters. Topics that fail are reported, and the
    /// others work.
    pub(crate) fn new(node: &Node, config: &CostmapConfig) -> (Self, Vec<GraphError>) {
        let mut inputs = Self::default();
        let mut errors = Vec::new();
        let mut layers: Vec<&LayerConfig> = Vec::new();
        for layer in config.layers.iter().chain(&config.filters) {
            gather(layer, &mut layers);
        }
        let namespace = node.names().namespace().to_owned();
        let place = Place { node, namespace: &namespace, compat: config.compat };
        let shared_map = config.params().map_topic;
        for layer in layers {
            if let Err(error) = inputs.listen(&place, layer, &shared_map) {
                errors.push(error);
            }
        }
        (inputs, errors)
    }

    fn listen(
        &mut self,
        place: &Place<'_>,
        layer: &LayerConfig,
        shared_map: &str,
    ) -> Result<(), GraphError> {
        match layer.kind {
            LayerKind::Static => {
                let params = StaticLayerParams::from_values(&layer.values);
                let topic = [params.map_topic.as_str(), shared_map];
                let topic = match topic.into_iter().find(|topic| !topic.is_empty()) {
                    Some(topic) => place.resolve(topic),
                    None => place.default_map_topic(),
                };
                let is_latched = params.map_subscribe_transient_local;
                let qos = if is_latched { Qos::latched(3) } else { Qos::reliable(10) };
                let updates = params
                    .subscribe_to_updates
                    .then(|| place.node.mailbox(&format!("{topic}_updates"), Qos::reliable(50)));
                self.maps.push(MapPort {
                    layer: layer.name.clone(),
                    map: place.node.mailbox(&topic, qos)?,
                    updates: updates.transpose()?,
                });
            }
            LayerKind::Range => {
                let mut ranges = Vec::new();
                for topic in RangeLayerParams::from_values(&layer.values).topics {
                    ranges.push(place.node.mailbox(&place.resolve(&topic), Qos::best_effort(50))?);
                }
                let (layer, waiting) = (layer.name.clone(), Waiting::default());
                self.ranges.push(RangePort { layer, ranges, waiting });
            }
            kind if kind.has_sources() => {
                for source in &layer.sources {
                    let settings = source.settings();
                    let topic = place.resolve(&settings.topic);
                    let depth = if settings.persistence_ns == 0 { FEW } else { MAX_WAITING };
                    let qos = Qos::best_effort(depth);
                    let messages = match settings.data_type {
                        DataType::LaserScan => Messages::Scans(place.node.mailbox(&topic, qos)?),
                        DataType::PointCloud2 => Messages::Clouds(place.node.mailbox(&topic, qos)?),
                    };
                    self.sources.push(SourcePort {
                        layer: layer.name.clone(),
                        source: source.name.clone(),
                        messages,
                        scans: Waiting::default(),
                        clouds: Waiting::default(),
                        projector: Projector::default(),
                        points: Vec::new(),
                        is_lost: false,
                    });
                }
            }
            kind if kind.is_filter() => {
                let topic = FilterParams::from_values(&layer.values).filter_info_topic;
                if topic.is_empty() {
                    return Ok(());
                }
                self.filters.push(FilterPort::new(place, &layer.name, &topic)?);
                if kind != LayerKind::Speed {
                    return Ok(());
                }
                let params = SpeedFilterParams::from_values(&layer.values);
                if params.enable_path_lookahead {
                    let (path, odom) = (&params.path_topic, &params.odom_topic);
                    self.speeds.push(SpeedPort::new(place, &layer.name, path, odom)?);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Passes received messages to the layers. Each warning is reported once.
    pub(crate) fn take(
        &mut self,
        costmap: &mut LayeredCostmap,
        scene: &Scene<'_>,
        node: &Node,
        compat: Nav2Release,
    ) -> Vec<Diagnostic> {
        let mut complaints = Vec::new();
        for port in &mut self.maps {
            port.take(costmap, &mut complaints);
        }
        for port in &mut self.sources {
            port.take(costmap, scene, &mut complaints);
        }
        for port in &mut self.ranges {
            port.take(costmap, scene);
        }
        let namespace = node.names().namespace().to_owned();
        let place = Place { node, namespace: &namespace, compat };
        for port in &mut self.filters {
            port.take(costmap, &place, &mut complaints);
        }
        for port in &self.speeds {
            port.take(costmap, scene);
        }
        complaints
    }

    /// Iterates over layer, source and topic.
    pub(crate) fn topics(&self) -> impl Iterator<Item = (&str, &str, &str)> {
        self.sources.iter().map(|port| {
            let topic = match &port.messages {
                Messages::Scans(scans) => scans.topic(),
                Messages::Clouds(clouds) => clouds.topic(),
            };
            (port.layer.as_str(), port.source.as_str(), topic)
        })
    }

    /// Iterates over the filters without a mask, with the topics on which they wait for it.
    pub(crate) fn filters_without_mask(&self) -> impl Iterator<Item = (&str, &str)> {
        self.filters.iter().filter_map(FilterPort::waits_for)
    }

    /// Iterates over the layers with a map, with their topics.
    pub(crate) fn maps(&self) -> impl Iterator<Item = (&str, &str)> {
        self.maps.iter().map(|port| (port.layer.as_str(), port.map.topic()))
    }

    /// Iterates over the range sensor layers.
    pub(crate) fn ranges(&self) -> impl Iterator<Item = &str> {
        self.ranges.iter().map(|port| port.layer.as_str())
    }
}

fn gather<'a>(layer: &'a LayerConfig, layers: &mut Vec<&'a LayerConfig>) {
    layers.push(layer);
    for child in &layer.children {
        gather(child, layers);
    }
}

struct Place<'a> {
    node: &'a Node,
    namespace: &'a str,
    compat: Nav2Release,
}

impl Place<'_> {
    fn resolve(&self, topic: &str) -> String {
        resolve(topic, self.namespace, self.compat)
    }

    /// Topic of the map if no parameter names it: in every release beside the costmap of a server,
    /// `map` of `/robot/global_costmap` is `/robot/map`.
    fn default_map_topic(&self) -> String {
        let own = self.namespace.rsplit('/').next();
        let is_of_server = own == Some(self.node.names().name());
        resolve("map", self.namespace, if is_of_server { Nav2Release::Main } else { self.compat })
    }
}

/// Missing transform of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MissingPose {
    /// The frame is unknown.
    Frame,
    /// The frame is known, but not at the stamp.
    Time,
}

/// Counts of messages that were dropped after waiting, by missing transform, and the frame of the
/// last one.
#[derive(Clone, Debug, Default)]
struct Dropped {
    without_frame: u64,
    out_of_time: u64,
    frame: Option<String>,
}

impl Dropped {
    fn count(&mut self, missing: MissingPose, header: &Header) {
        match missing {
            MissingPose::Frame => self.without_frame += 1,
            MissingPose::Time => self.out_of_time += 1,
        }
        self.frame = Some(header.frame_id.clone());
    }
}

/// Messages with a header.
trait Stamped {
    fn header(&self) -> &Header;
}

impl Stamped for LaserScan {
    fn header(&self) -> &Header {
        &self.header
    }
}

impl Stamped for PointCloud2 {
    fn header(&self) -> &Header {
        &self.header
    }
}

impl Stamped for Range {
    fn header(&self) -> &Header {
        &self.header
    }
}

/// Messages that wait for their transform.
struct Waiting<T> {
    filter: MessageFilter<T>,
    /// Missing transform of the waiting messages.
    missing: MissingPose,
}

impl<T> Default for Waiting<T> {
    fn default() -> Self {
        let settings = FilterSettings {
            max_waiting: MAX_WAITING,
            timeout_ns: TRANSFORM_TIMEOUT_NS,
            order: FilterOrder::EachReady,
        };
        Self { filter: MessageFilter::new(settings), missing: MissingPose::Frame }
    }
}

impl<T: periplus_msgs::Message + Stamped> Waiting<T> {
    /// Adds the messages that have arrived. A dropped one is counted by the transform that the
    /// waiting ones lack.
    fn receive(&mut self, mailbox: &Mailbox<T>, dropped: &mut Dropped) {
        for (sample, message) in mailbox.drain_samples() {
            if let Some(oldest) = self.filter.push(sample.time_ns, message) {
                dropped.count(self.missing, oldest.header());
            }
        }
    }

    /// Returns the oldest message whose transforms are available, with the result of `lookup`.
    fn next<R>(
        &mut self,
        now_ns: i64,
        mut lookup: impl FnMut(&T) -> Result<R, MissingPose>,
        dropped: &mut Dropped,
    ) -> Option<(Arc<T>, R)> {
        let last = &mut self.missing;
        let lookup = |message: &T| lookup(message).inspect_err(|missing| *last = *missing);
        let on_timeout = |message: &T, missing| dropped.count(missing, message.header());
        self.filter.next(now_ns, lookup, on_timeout)
    }
}

/// Returns `global_from_frame` at the stamp of a message.
fn placed(scene: &Scene<'_>, frame: &str, header: &Header) -> Result<Pose, MissingPose> {
    match scene.tf.at(scene.global_frame, frame, header.stamp.ns()) {
        Ok((pose, _)) => Ok(pose),
        Err(why) if why.kind.is_extrapolation() => Err(MissingPose::Time),
        Err(_) => Err(MissingPose::Frame),
    }
}

struct SourcePort {
    layer: String,
    source: String,
    messages: Messages,
    scans: Waiting<LaserScan>,
    clouds: Waiting<PointCloud2>,
    projector: Projector,
    points: Vec<[f32; 3]>,
    is_lost: bool,
}

enum Messages {
    Scans(Mailbox<LaserScan>),
    Clouds(Mailbox<PointCloud2>),
}

impl SourcePort {
    fn take(
        &mut self,
        costmap: &mut LayeredCostmap,
        scene: &Scene<'_>,
        complaints: &mut Vec<Diagnostic>,
    ) {
        let Some(source) = costmap.source_mut(&self.layer, &self.source) else { return };
        let (projector, points) = (&mut self.projector, &mut self.points);
        let (mut dropped, mut has_messages) = (Dropped::default(), false);
        match &self.messages {
            Messages::Scans(scans) => {
                let waiting = &mut self.scans;
                waiting.receive(scans, &mut dropped);
                while let Some((scan, poses)) = waiting.next(
                    scene.now_ns,
                    |scan| source_poses(source, scene, &scan.header),
                    &mut dropped,
                ) {
                    insert_scan(source, scene, &scan, poses, projector, points);
                    has_messages = true;
                }
                has_messages |= !waiting.filter.is_empty();
            }
            Messages::Clouds(clouds) => {
                let waiting = &mut self.clouds;
                waiting.receive(clouds, &mut dropped);
                while let Some((cloud, poses)) = waiting.next(
                    scene.now_ns,
                    |cloud| source_poses(source, scene, &cloud.header),
                    &mut dropped,
                ) {
                    insert_cloud(source, scene, &cloud, poses, points);
                    has_messages = true;
                }
                has_messages |= !waiting.filter.is_empty();
            }
        }
        source.counters.without_frame += dropped.without_frame;
        source.counters.out_of_time += dropped.out_of_time;
        match dropped.frame {
            Some(frame) if !std::mem::replace(&mut self.is_lost, true) => {
                complaints.push(lost(&self.layer, source, scene, &frame));
            }
            Some(_) => {}
            None => self.is_lost &= !has_messages,
        }
    }
}

/// Returns a warning that explains the missing transform of a message.
fn lost(layer: &str, source: &ObservationSource, scene: &Scene<'_>, frame: &str) -> Diagnostic {
    let why = match scene.tf.at(scene.global_frame, frame, 0) {
        Err(error) => error.to_string(),
        Ok(_) => "its time is too far from that of the transforms".to_owned(),
    };
    let help = if !scene.tf.has(frame) {
        "start what publishes this frame (robot_state_publisher, a static transform), or set `sensor_frame`"
    } else if !scene.tf.has(scene.global_frame) {
        "start what publishes the global frame: odometry, SLAM or localization with an initial pose"
    } else {
        "check that all nodes use the same time (`use_sim_time`)"
    };
    Diagnostic::warning(
        "message-dropped",
        format!(
            "messages of `{layer}.{}` in frame `{frame}` are dropped: no transform to `{}`: {why}",
            source.name, scene.global_frame
        ),
    )
    .at(source.values.origin("topic"))
    .help(help)
}

/// Returns the origin of the rays: that of `sensor_frame` if it is set.
fn origin(
    source: &ObservationSource,
    scene: &Scene<'_>,
    header: &Header,
    cloud: Pose,
) -> Result<DVec3, MissingPose> {
    if source.settings.sensor_frame.is_empty() {
        return Ok(cloud.translation);
    }
    Ok(placed(scene, &source.settings.sensor_frame, header)?.translation)
}

/// Returns `global_from_frame` of a message, and the origin of its rays.
fn source_poses(
    source: &ObservationSource,
    scene: &Scene<'_>,
    header: &Header,
) -> Result<(Pose, DVec3), MissingPose> {
    let pose = placed(scene, &header.frame_id, header)?;
    Ok((pose, origin(source, scene, header, pose)?))
}

fn insert_scan(
    source: &mut ObservationSource,
    scene: &Scene<'_>,
    scan: &LaserScan,
    (first, origin): (Pose, DVec3),
    projector: &mut Projector,
    points: &mut Vec<[f32; 3]>,
) {
    let frame = scan.header.frame_id.as_str();
    let beams = ScanGeometry {
        angle_min_rad: scan.angle_min,
        angle_increment_rad: scan.angle_increment,
        range_min_m: scan.range_min,
        range_max_m: scan.range_max,
    };
    let stamp_ns = scan.header.stamp.ns();
    let count = scan.ranges.len().saturating_sub(1) as f64;
    let length_ns = (f64::from(scan.time_increment) * count * 1e9) as i64;
    let inf_is_valid = source.settings.inf_is_valid;
    points.clear();
    // Without a transform at the end of the scan it counts as instantaneous, as in Nav2.
    let last = (length_ns > 0)
        .then(|| scene.tf.at(scene.global_frame, frame, stamp_ns + length_ns).ok())
        .flatten();
    let global_from_points = match last {
        Some((last, _)) => {
            let moving = projector.points_in_motion(beams, &scan.ranges, inf_is_valid, first, last);
            points.extend(moving);
            Pose::IDENTITY
        }
        None => {
            points.extend(projector.points(beams, &scan.ranges, inf_is_valid));
            first
        }
    };
    source.counters.without_return += (scan.ranges.len() - points.len()) as u64;
    let points = points.iter().copied();
    source.insert(scene.now_ns, stamp_ns, global_from_points, origin, points);
}

fn insert_cloud(
    source: &mut ObservationSource,
    scene: &Scene<'_>,
    cloud: &PointCloud2,
    (pose, origin): (Pose, DVec3),
    points: &mut Vec<[f32; 3]>,
) {
    points.clear();
    match clouds::points(cloud) {
        Ok(all) => {
            let stamp_ns = cloud.header.stamp.ns();
            source.insert(scene.now_ns, stamp_ns, pose, origin, all);
        }
        Err(_) => source.counters.malformed += 1,
    }
}

struct MapPort {
    layer: String,
    map: Mailbox<nav_msgs::OccupancyGrid>,
    updates: Option<Mailbox<map_msgs::OccupancyGridUpdate>>,
}

impl MapPort {
    fn take(&self, costmap: &mut LayeredCostmap, complaints: &mut Vec<Diagnostic>) {
        let Some(layer) = costmap.find_as::<StaticLayer>(&self.layer) else { return };
        let (topic, name) = (self.map.topic(), &self.layer);
        let told_at = layer.values().map(|values| values.origin("map_topic")).unwrap_or_default();
        let mut refuse = |why: String| {
            complaints.push(
                Diagnostic::error(
                    "malformed-map",
                    format!("a map on {topic} (`{name}.map_topic`) is refused: {why}"),
                )
                .at(told_at)
                .help("the layer keeps the map that it had"),
            );
        };
        if let Some(message) = self.map.latest() {
            let frame = &message.header.frame_id;
            let set = |map| layer.set_map(map, frame).map_err(|error| error.to_string());
            if let Err(why) = map(&message).and_then(set) {
                refuse(why);
            }
        }
        for update in self.updates.iter().flat_map(Mailbox::drain) {
            let (Ok(x0), Ok(y0)) = (usize::try_from(update.x), usize::try_from(update.y)) else {
                refuse("an update begins beside the map".into());
                continue;
            };
            let (width, height) = (update.width as usize, update.height as usize);
            let window = CellWindow { x0, y0, xn: x0 + width, yn: y0 + height };
            if let Err(why) = layer.update_map(window, &update.data, &update.header.frame_id) {
                refuse(format!("an update: {why}"));
            }
        }
    }
}

struct RangePort {
    layer: String,
    ranges: Vec<Mailbox<Range>>,
    waiting: Waiting<Range>,
}

impl RangePort {
    fn take(&mut self, costmap: &mut LayeredCostmap, scene: &Scene<'_>) {
        let Some(layer) = costmap.find_as::<RangeLayer>(&self.layer) else { return };
        for ranges in &self.ranges {
            let mut dropped = Dropped::default();
            self.waiting.receive(ranges, &mut dropped);
            while let Some((range, pose)) = self.waiting.next(
                scene.now_ns,
                |range| placed(scene, &range.header.frame_id, &range.header),
                &mut dropped,
            ) {
                layer.insert(RangeReading {
                    global_from_sensor: pose,
                    range_m: range.range.into(),
                    min_range_m: range.min_range.into(),
                    max_range_m: range.max_range.into(),
                    field_of_view_rad: range.field_of_view.into(),
                });
            }
            layer.counters.without_frame += dropped.without_frame;
            layer.counters.out_of_time += dropped.out_of_time;
        }
    }
}
