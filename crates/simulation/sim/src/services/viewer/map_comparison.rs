//! Comparison of maps with the world: `/world/<world>/truth`.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use periplus_geometry::Pose2;
use periplus_graph::{Durability, GraphError, Mailbox, Node, Publisher, Qos, Reliability};
use periplus_grid::occupancy::FREE;
use periplus_grid::{GridInfo, OccupancyGrid};
use periplus_maps::{BesideTruth, beside_truth, from_message};
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus, KeyValue};
use periplus_msgs::nav_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_os::Stopwatch;
use periplus_tf::TransformKind;
use periplus_tf_ros::Frames;

use crate::Simulation;

/// Wall time between two messages.
const PERIOD: Duration = Duration::from_secs(2);

/// Inverse of the maximum fraction of time for comparisons.
const COMPARISON_PERIOD_FACTOR: u32 = 20;

/// Search window about the robot's estimated pose.
const WINDOW_M: f64 = 0.6;
const WINDOW_RAD: f64 = 0.12;

/// Maximum size of a compared map \[cells\].
const MAX_CELLS: usize = 16_000_000;

/// Period \[ns\] and number of stored robot poses: estimates arrive later.
const STORE_PERIOD_NS: i64 = 20_000_000;
const STORED_POSE_COUNT: usize = 150;

/// Mean distance of walls beyond which the status is a warning \[m\].
const GOOD_DISTANCE_M: f64 = 0.1;

/// Comparison of maps with the world.
pub(super) struct MapComparison {
    node: Node,
    told: Publisher<DiagnosticArray>,
    hearing: Option<MapSubscriptions>,
    since: Option<Stopwatch>,
    took: Duration,
}

/// Subscriptions, while the topic has subscribers.
struct MapSubscriptions {
    frames: Frames,
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    maps: BTreeMap<String, Map>,
    generation: Option<u64>,
    /// Past poses of the robot's links, by time \[ns\].
    places: VecDeque<(i64, Vec<(String, Pose2)>)>,
}

/// A published map.
struct Map {
    mailbox: Mailbox<nav_msgs::OccupancyGrid>,
    last: Option<Arc<nav_msgs::OccupancyGrid>>,
}

impl MapComparison {
    pub(super) fn new(node: &Node, topic: &str) -> Result<Self, GraphError> {
        let told = node.publisher(topic, Qos::latched(1))?;
        Ok(Self { node: node.clone(), told, hearing: None, since: None, took: Duration::ZERO })
    }

    /// Compares and publishes when it is due.
    pub(super) fn serve(&mut self, simulation: &mut Simulation) -> Result<(), GraphError> {
        if !self.told.is_heard() {
            self.hearing = None;
            return Ok(());
        }
        if self.hearing.is_none() {
            self.hearing = Some(MapSubscriptions::new(&self.node)?);
        }
        let Some(hearing) = &mut self.hearing else { return Ok(()) };
        hearing.keep(simulation);
        let period = PERIOD.max(self.took * COMPARISON_PERIOD_FACTOR);
        if self.since.as_ref().is_some_and(|since| since.elapsed() < period) {
            return Ok(());
        }
        hearing.hear(&self.node, simulation);
        let start = Stopwatch::start();
        let status = hearing.compare(simulation);
        if !status.is_empty() {
            let header = Header::at(simulation.time_ns(), "");
            self.told.publish(DiagnosticArray { header, status });
            self.took = start.elapsed();
        }
        self.since = Some(Stopwatch::start());
        Ok(())
    }
}

impl MapSubscriptions {
    fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            frames: Frames::default(),
            moving: node.mailbox("/tf", Qos::best_effort(100))?,
            fixed: node.mailbox("/tf_static", Qos::latched(100))?,
            maps: BTreeMap::new(),
            generation: None,
            places: VecDeque::new(),
        })
    }

    /// Stores the robot's current pose.
    fn keep(&mut self, simulation: &Simulation) {
        let now_ns = simulation.time_ns();
        match self.places.back() {
            // Time jumped back.
            Some((last_ns, _)) if *last_ns > now_ns => {
                self.places.clear();
                self.frames.forget();
            }
            Some((last_ns, _)) if now_ns - last_ns < STORE_PERIOD_NS => return,
            _ => {}
        }
        if self.places.len() == STORED_POSE_COUNT {
            self.places.pop_front();
        }
        self.places.push_back((now_ns, simulation.robot_links()));
        for (mailbox, kind) in
            [(&self.fixed, TransformKind::Fixed), (&self.moving, TransformKind::Moving)]
        {
            mailbox.drain().iter().for_each(|message| self.frames.take(message, kind));
        }
    }

    /// Receives new maps of all publishers.
    fn hear(&mut self, node: &Node, simulation: &Simulation) {
        let graph = simulation.graph();
        if self.generation.replace(graph.generation()) != Some(graph.generation()) {
            let is_map = |name: &str| name.rsplit('/').next() == Some("map");
            let topics = graph.topics().into_iter().filter(|topic| {
                topic.type_name == "nav_msgs/msg/OccupancyGrid"
                    && is_map(&topic.name)
                    && !topic.publishers.is_empty()
            });
            let mut known = std::mem::take(&mut self.maps);
            for topic in topics {
                let offers = topic.publishers.iter().map(|end| end.qos);
                let is_latched =
                    offers.clone().all(|it| it.durability == Durability::TransientLocal);
                let is_reliable = offers.clone().all(|it| it.reliability == Reliability::Reliable);
                let mut qos = Qos::latched(1);
                if !is_latched {
                    qos.durability = Durability::Volatile;
                }
                if !is_reliable {
                    qos.reliability = Reliability::BestEffort;
                }
                let map = known.remove(&topic.name).or_else(|| {
                    let mailbox = node.mailbox(&topic.name, qos).ok()?;
                    Some(Map { mailbox, last: None })
                });
                self.maps.extend(map.map(|map| (topic.name, map)));
            }
            // New mailboxes count as changes.
            self.generation = Some(graph.generation());
        }
        for map in self.maps.values_mut() {
            map.last = map.mailbox.latest().or(map.last.take());
        }
    }

    fn compare(&self, simulation: &mut Simulation) -> Vec<DiagnosticStatus> {
        let maps = self.maps.iter().filter_map(|(name, map)| Some((name, map.last.as_ref()?)));
        maps.filter_map(|(name, message)| {
            let map = from_message(message).ok().filter(|map| map.info.len() <= MAX_CELLS)?;
            let world_from_map = self.world_from_map(&message.header.frame_id)?;
            Some(describe(name, &simulation.beside_truth(&map, world_from_map)?))
        })
        .collect()
    }

    /// Returns the pose of a map in the world if the robot's estimate is right, at the newest time
    /// with both poses.
    fn world_from_map(&self, frame: &str) -> Option<Pose2> {
        let (_, links) = self.places.back()?;
        // Other links may depend on joints without published states.
        let rank = |name: &str| match name {
            "base_link" => 0,
            "base_footprint" => 1,
            _ => 2,
        };
        let mut names: Vec<&String> = links.iter().map(|(name, _)| name).collect();
        names.sort_by_key(|name| rank(name));
        let known = names.into_iter().find(|name| self.frames.at(frame, name, 0).is_ok())?;
        self.places.iter().rev().find_map(|(time_ns, links)| {
            let (map_from_link, _) = self.frames.at(frame, known, *time_ns).ok()?;
            let (_, world_from_link) = links.iter().find(|(name, _)| name == known)?;
            Some((*world_from_link * Pose2::from(map_from_link).inverse()).normalized())
        })
    }
}

impl Simulation {
    /// Compares a map at this pose with the world, with a search window for the robot's estimation
    /// error. `None` without a robot, or if the world around it is too large.
    pub fn beside_truth(
        &mut self,
        map: &OccupancyGrid,
        world_from_map: Pose2,
    ) -> Option<BesideTruth> {
        let mut map = map.clone();
        map.info.origin = world_from_map * map.info.origin;
        let (truth, is_whole) = self.truth_around(map.info)?;
        let found = beside_truth(&truth, &map, WINDOW_M, WINDOW_RAD).ok()?;
        let explored = found.explored.filter(|_| is_whole);
        Some(BesideTruth { explored, ..found })
    }

    /// Returns the true map on the cells of a map, extended to all that the robot could reach, and
    /// whether it is complete; without the extension if it is unbounded.
    fn truth_around(&mut self, info: GridInfo) -> Option<(OccupancyGrid, bool)> {
        let own = self.truth_map(info)?;
        let mut truth = own.clone();
        while is_open(&truth) {
            let GridInfo { width, height, resolution_m, .. } = truth.info;
            let more = width.max(height) / 2 + 1;
            let (width, height) = (width + 2 * more, height + 2 * more);
            let corner = truth.info.moved(-(more as i64), -(more as i64)).origin;
            let larger = GridInfo::new(resolution_m, width, height, corner).ok();
            let Some(larger) = larger.filter(|it| it.len() <= MAX_MARGIN_CELLS.max(4 * info.len()))
            else {
                return Some((own, false));
            };
            truth = self.truth_map(larger)?;
        }
        Some((truth, true))
    }
}

/// Maximum number of cells of the true map beyond the map.
const MAX_MARGIN_CELLS: usize = 1_000_000;

/// Returns true if free space continues beyond the map: it reaches the border, or begins elsewhere.
fn is_open(map: &OccupancyGrid) -> bool {
    let (width, height) = (map.info.width, map.info.height);
    let edge = |index: usize| {
        let (column, row) = map.info.cell(index);
        column == 0 || row == 0 || column + 1 == width || row + 1 == height
    };
    let mut free = (0..map.cells.len()).filter(|&index| map.cells[index] == FREE).peekable();
    free.peek().is_none() || free.any(edge)
}

fn describe(topic: &str, found: &BesideTruth) -> DiagnosticStatus {
    let walls = found.comparison.other_to_first;
    let free_iou = found.comparison.free.iou();
    let message = if walls.mean_m.is_finite() {
        format!(
            "walls are {:.3} m from true ones on average; {:.0} % of the free space agrees",
            walls.mean_m,
            100.0 * free_iou
        )
    } else {
        "no walls yet".to_owned()
    };
    let values = found.numbers().into_iter();
    let values =
        values.map(|(key, value)| KeyValue { key: key.to_owned(), value: format!("{value:.4}") });
    let is_good = walls.mean_m.is_nan() || walls.mean_m <= GOOD_DISTANCE_M;
    DiagnosticStatus {
        level: if is_good { DiagnosticStatus::OK } else { DiagnosticStatus::WARN },
        name: topic.to_owned(),
        message,
        hardware_id: String::new(),
        values: values.collect(),
    }
}
