//! Subscriptions of layers and filters.

mod filters;

use std::collections::VecDeque;
use std::sync::Arc;

use periplus_costmap::layers::{RangeLayer, RangeReading, StaticLayer};
use periplus_costmap::{
    CellWindow, CostmapConfig, DataType, Layer as _, LayerConfig, LayerKind, LayeredCostmap,
    Nav2Release, ObservationSource, Projector, ScanGeometry,
};
use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose};
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::{map_msgs, nav_msgs, sensor_msgs};

use crate::costmap_2d::clouds;
use crate::costmap_2d::frames::Listener;
use crate::costmap_2d::messages::map;
use crate::costmap_2d::topics::resolve;

use filters::{FilterPort, SpeedPort};

/// Time after which a message without a transform is dropped \[ns\].
const PATIENCE_NS: i64 = 1_000_000_000;

/// Maximum number of messages of a source that wait for their transform.
const MOST_WAITING: usize = 50;

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
            port.scans.messages.clear();
            port.clouds.messages.clear();
            match &port.messages {
                Messages::Scans(scans) => drop(scans.drain()),
                Messages::Clouds(clouds) => drop(clouds.drain()),
            }
        }
        for port in &mut self.ranges {
            port.waiting.messages.clear();
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
        let shared_map = config.node.text("map_topic").unwrap_or_default();
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
        let text = |name: &str| layer.values.text(name).unwrap_or_default();
        let flag = |name: &str| layer.values.flag(name).unwrap_or_default();
        match layer.kind {
            LayerKind::Static => {
                let own = text("map_topic");
                let topic = [own.as_str(), shared_map, "map"];
                let topic = topic.into_iter().find(|topic| !topic.is_empty()).unwrap_or("map");
                let topic = place.resolve(topic);
                let is_latched = flag("map_subscribe_transient_local");
                let qos = if is_latched { Qos::latched(3) } else { Qos::reliable(10) };
                let updates = flag("subscribe_to_updates")
                    .then(|| place.node.mailbox(&format!("{topic}_updates"), Qos::reliable(50)));
                self.maps.push(MapPort {
                    layer: layer.name.clone(),
                    map: place.node.mailbox(&topic, qos)?,
                    updates: updates.transpose()?,
                });
            }
            LayerKind::Range => {
                let mut ranges = Vec::new();
                for topic in layer.values.texts("topics") {
                    ranges.push(place.node.mailbox(&place.resolve(&topic), Qos::best_effort(50))?);
                }
                let (layer, waiting) = (layer.name.clone(), Waiting::default());
                self.ranges.push(RangePort { layer, ranges, waiting });
            }
            kind if kind.has_sources() => {
                for source in &layer.sources {
                    let settings = source.settings();
                    let topic = place.resolve(&settings.topic);
                    let depth = if settings.persistence_ns == 0 { FEW } else { MOST_WAITING };
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
                let topic = text("filter_info_topic");
                if topic.is_empty() {
                    return Ok(());
                }
                self.filters.push(FilterPort::new(place, &layer.name, &topic)?);
                if kind == LayerKind::Speed && flag("enable_path_lookahead") {
                    let (path, odom) = (text("path_topic"), text("odom_topic"));
                    self.speeds.push(SpeedPort::new(place, &layer.name, &path, &odom)?);
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
}

/// Messages that wait for their transform.
struct Waiting<T> {
    messages: VecDeque<(i64, Arc<T>)>,
    /// Missing transform of the waiting messages.
    lack: Lack,
}

impl<T> Default for Waiting<T> {
    fn default() -> Self {
        Self { messages: VecDeque::new(), lack: Lack::Frame }
    }
}

/// Result of processing a message.
enum Tried {
    Taken,
    /// The missing transform may still arrive.
    Lacks(Lack),
}

/// Missing transform of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lack {
    /// The frame is unknown.
    Frame,
    /// The frame is known, but not at the stamp.
    Time,
}

/// Counts of messages that were dropped after waiting, by missing transform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Dropped {
    without_frame: u64,
    out_of_time: u64,
}

impl Dropped {
    fn count(&mut self, lack: Lack) {
        match lack {
            Lack::Frame => self.without_frame += 1,
            Lack::Time => self.out_of_time += 1,
        }
    }

    fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

impl<T: periplus_msgs::Message> Waiting<T> {
    /// Processes all queued messages, oldest first; returns the counts of dropped ones.
    fn take(
        &mut self,
        mailbox: &Mailbox<T>,
        now_ns: i64,
        mut attempt: impl FnMut(&T) -> Tried,
    ) -> Dropped {
        for (sample, message) in mailbox.drain_samples() {
            self.messages.push_back((sample.time_ns, message));
        }
        let mut dropped = Dropped::default();
        while self.messages.len() > MOST_WAITING {
            self.messages.pop_front();
            dropped.count(self.lack);
        }
        self.messages.retain(|(came_ns, message)| match attempt(message) {
            Tried::Taken => false,
            Tried::Lacks(lack) => {
                self.lack = lack;
                let may_wait = now_ns - came_ns <= PATIENCE_NS;
                if !may_wait {
                    dropped.count(lack);
                }
                may_wait
            }
        });
        dropped
    }
}

/// Returns `global_from_frame` at the stamp of a message.
fn placed(scene: &Scene<'_>, frame: &str, header: &Header) -> Result<Pose, Lack> {
    match scene.tf.at(scene.global_frame, frame, header.stamp.ns()) {
        Ok((pose, _)) => Ok(pose),
        Err(why) if why.kind.is_extrapolation() => Err(Lack::Time),
        Err(_) => Err(Lack::Frame),
    }
}

struct SourcePort {
    layer: String,
    source: String,
    messages: Messages,
    scans: Waiting<sensor_msgs::LaserScan>,
    clouds: Waiting<sensor_msgs::PointCloud2>,
    projector: Projector,
    points: Vec<[f32; 3]>,
    is_lost: bool,
}

enum Messages {
    Scans(Mailbox<sensor_msgs::LaserScan>),
    Clouds(Mailbox<sensor_msgs::PointCloud2>),
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
        let mut last_frame = None;
        let dropped = match &self.messages {
            Messages::Scans(scans) => self.scans.take(scans, scene.now_ns, |scan| {
                last_frame = Some(scan.header.frame_id.clone());
                take_scan(source, scene, scan, projector, points)
            }),
            Messages::Clouds(clouds) => self.clouds.take(clouds, scene.now_ns, |cloud| {
                last_frame = Some(cloud.header.frame_id.clone());
                take_cloud(source, scene, cloud, points)
            }),
        };
        source.counters.without_frame += dropped.without_frame;
        source.counters.out_of_time += dropped.out_of_time;
        if dropped.is_none() {
            self.is_lost &= last_frame.is_none();
        } else if !std::mem::replace(&mut self.is_lost, true) {
            let frame = last_frame.unwrap_or_default();
            complaints.push(lost(&self.layer, source, scene, &frame));
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
) -> Result<DVec3, Lack> {
    if source.settings.sensor_frame.is_empty() {
        return Ok(cloud.translation);
    }
    Ok(placed(scene, &source.settings.sensor_frame, header)?.translation)
}

/// Returns `global_from_frame` of a message, and the origin of its rays.
fn places(
    source: &ObservationSource,
    scene: &Scene<'_>,
    header: &Header,
) -> Result<(Pose, DVec3), Lack> {
    let pose = placed(scene, &header.frame_id, header)?;
    Ok((pose, origin(source, scene, header, pose)?))
}

fn take_scan(
    source: &mut ObservationSource,
    scene: &Scene<'_>,
    scan: &sensor_msgs::LaserScan,
    projector: &mut Projector,
    points: &mut Vec<[f32; 3]>,
) -> Tried {
    let frame = scan.header.frame_id.as_str();
    let (first, origin) = match places(source, scene, &scan.header) {
        Ok(known) => known,
        Err(lack) => return Tried::Lacks(lack),
    };
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
    Tried::Taken
}

fn take_cloud(
    source: &mut ObservationSource,
    scene: &Scene<'_>,
    cloud: &sensor_msgs::PointCloud2,
    points: &mut Vec<[f32; 3]>,
) -> Tried {
    let (pose, origin) = match places(source, scene, &cloud.header) {
        Ok(known) => known,
        Err(lack) => return Tried::Lacks(lack),
    };
    points.clear();
    match clouds::points(cloud) {
        Ok(all) => {
            let stamp_ns = cloud.header.stamp.ns();
            source.insert(scene.now_ns, stamp_ns, pose, origin, all);
        }
        Err(_) => source.counters.malformed += 1,
    }
    Tried::Taken
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
            let taken = map(&message).and_then(|map| layer.set_map(map, &message.header.frame_id));
            if let Err(why) = taken {
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
    ranges: Vec<Mailbox<sensor_msgs::Range>>,
    waiting: Waiting<sensor_msgs::Range>,
}

impl RangePort {
    fn take(&mut self, costmap: &mut LayeredCostmap, scene: &Scene<'_>) {
        let Some(layer) = costmap.find_as::<RangeLayer>(&self.layer) else { return };
        for ranges in &self.ranges {
            let dropped = self.waiting.take(ranges, scene.now_ns, |range| {
                let pose = match placed(scene, &range.header.frame_id, &range.header) {
                    Ok(pose) => pose,
                    Err(lack) => return Tried::Lacks(lack),
                };
                layer.insert(RangeReading {
                    global_from_sensor: pose,
                    range_m: range.range.into(),
                    min_range_m: range.min_range.into(),
                    max_range_m: range.max_range.into(),
                    field_of_view_rad: range.field_of_view.into(),
                });
                Tried::Taken
            });
            layer.counters.without_frame += dropped.without_frame;
            layer.counters.out_of_time += dropped.out_of_time;
        }
    }
}
