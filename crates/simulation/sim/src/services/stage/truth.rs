//! How well maps agree with the world, for who compares: `/world/<world>/truth`.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use periplus_geometry::Pose2;
use periplus_graph::{Durability, GraphError, Mailbox, Node, Publisher, Qos, Reliability};
use periplus_grid::occupancy::FREE;
use periplus_grid::{Lattice, OccupancyGrid};
use periplus_maps::{BesideTruth, beside_truth, from_message};
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus, KeyValue};
use periplus_msgs::nav_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_os::Stopwatch;
use periplus_tf::Kind;
use periplus_tf_ros::Frames;

use crate::Simulation;

/// Wall time between two messages.
const PERIOD: Duration = Duration::from_secs(2);

/// To compare may take this part of the time.
const SHARE: u32 = 20;

/// What is compared is compared within this of where the robot believes to be.
const WINDOW_M: f64 = 0.6;
const WINDOW_RAD: f64 = 0.12;

/// Larger maps are not compared \[cells\].
const MOST_CELLS: usize = 16_000_000;

/// The robot's place is kept this often, and so many times \[ns\]: what it believes comes later.
const KEEP_NS: i64 = 20_000_000;
const KEPT: usize = 150;

/// Walls further from true ones than this are told as a warning \[m\].
const GOOD_M: f64 = 0.1;

/// How well maps agree with the world.
pub(super) struct Truth {
    node: Node,
    told: Publisher<DiagnosticArray>,
    hearing: Option<Hearing>,
    since: Option<Stopwatch>,
    took: Duration,
}

/// What is heard while somebody wants to know.
struct Hearing {
    frames: Frames,
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    maps: BTreeMap<String, Map>,
    generation: Option<u64>,
    /// Where the robot's links were, by time \[ns\].
    places: VecDeque<(i64, Vec<(String, Pose2)>)>,
}

/// A map that somebody publishes.
struct Map {
    mailbox: Mailbox<nav_msgs::OccupancyGrid>,
    last: Option<Arc<nav_msgs::OccupancyGrid>>,
}

impl Truth {
    pub(super) fn new(node: &Node, topic: &str) -> Result<Self, GraphError> {
        let told = node.publisher(topic, Qos::latched(1))?;
        Ok(Self { node: node.clone(), told, hearing: None, since: None, took: Duration::ZERO })
    }

    /// Compares and tells when it is time.
    pub(super) fn serve(&mut self, simulation: &mut Simulation) -> Result<(), GraphError> {
        if !self.told.is_heard() {
            self.hearing = None;
            return Ok(());
        }
        if self.hearing.is_none() {
            self.hearing = Some(Hearing::new(&self.node)?);
        }
        let Some(hearing) = &mut self.hearing else { return Ok(()) };
        hearing.keep(simulation);
        let period = PERIOD.max(self.took * SHARE);
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

impl Hearing {
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

    /// Keeps where the robot is now.
    fn keep(&mut self, simulation: &Simulation) {
        let now_ns = simulation.time_ns();
        match self.places.back() {
            // Time went back.
            Some((last_ns, _)) if *last_ns > now_ns => {
                self.places.clear();
                self.frames.forget();
            }
            Some((last_ns, _)) if now_ns - last_ns < KEEP_NS => return,
            _ => {}
        }
        if self.places.len() == KEPT {
            self.places.pop_front();
        }
        self.places.push_back((now_ns, simulation.robot_links()));
        for (mailbox, kind) in [(&self.fixed, Kind::Fixed), (&self.moving, Kind::Moving)] {
            mailbox.drain().iter().for_each(|message| self.frames.take(message, kind));
        }
    }

    /// Takes in new maps, of all who publish one.
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
            // Mailboxes that were made count as changes.
            self.generation = Some(graph.generation());
        }
        for map in self.maps.values_mut() {
            map.last = map.mailbox.latest().or(map.last.take());
        }
    }

    fn compare(&self, simulation: &mut Simulation) -> Vec<DiagnosticStatus> {
        let maps = self.maps.iter().filter_map(|(name, map)| Some((name, map.last.as_ref()?)));
        maps.filter_map(|(name, message)| {
            let map = from_message(message).ok().filter(|map| map.lattice.len() <= MOST_CELLS)?;
            let world_from_map = self.world_from_map(&message.header.frame_id)?;
            Some(describe(name, &simulation.beside_truth(&map, world_from_map)?))
        })
        .collect()
    }

    /// Where a map lies in the world, if the robot is where it believes to be: by the newest place of
    /// which both are known.
    fn world_from_map(&self, frame: &str) -> Option<Pose2> {
        let (_, links) = self.places.back()?;
        // Others may be held by joints of which nobody tells.
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
    /// How well a map agrees with the world, where it lies there like this, give or take what a robot
    /// may be wrong by. None where there is no robot, or the world around it is too large.
    pub fn beside_truth(
        &mut self,
        map: &OccupancyGrid,
        world_from_map: Pose2,
    ) -> Option<BesideTruth> {
        let mut map = map.clone();
        map.lattice.origin = world_from_map * map.lattice.origin;
        let (truth, is_whole) = self.truth_around(map.lattice)?;
        let found = beside_truth(&truth, &map, WINDOW_M, WINDOW_RAD).ok()?;
        let explored = found.explored.filter(|_| is_whole);
        Some(BesideTruth { explored, ..found })
    }

    /// The truth on the cells of a map, and on as many more as it takes to have all that the robot
    /// could get to, and whether that is all; no more than the map where there is no end of it.
    fn truth_around(&mut self, lattice: Lattice) -> Option<(OccupancyGrid, bool)> {
        let own = self.truth_map(lattice)?;
        let mut truth = own.clone();
        while is_open(&truth) {
            let Lattice { width, height, resolution_m, .. } = truth.lattice;
            let more = width.max(height) / 2 + 1;
            let (width, height) = (width + 2 * more, height + 2 * more);
            let corner = truth.lattice.moved(-(more as i64), -(more as i64)).origin;
            let larger = Lattice::new(resolution_m, width, height, corner).ok();
            let Some(larger) = larger.filter(|it| it.len() <= MOST_AROUND.max(4 * lattice.len()))
            else {
                return Some((own, false));
            };
            truth = self.truth_map(larger)?;
        }
        Some((truth, true))
    }
}

/// The truth is looked for on no more cells than this beyond the map.
const MOST_AROUND: usize = 1_000_000;

/// Whether what is free goes on beyond: it reaches the edge, or begins elsewhere.
fn is_open(map: &OccupancyGrid) -> bool {
    let (width, height) = (map.lattice.width, map.lattice.height);
    let edge = |index: usize| {
        let (column, row) = map.lattice.cell(index);
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
            "walls are {:.3} m from true ones on average; {:.0} % of what is free is as it is",
            walls.mean_m,
            100.0 * free_iou
        )
    } else {
        "no walls yet".to_owned()
    };
    let values = found.numbers().into_iter();
    let values =
        values.map(|(key, value)| KeyValue { key: key.to_owned(), value: format!("{value:.4}") });
    let is_good = walls.mean_m.is_nan() || walls.mean_m <= GOOD_M;
    DiagnosticStatus {
        level: if is_good { DiagnosticStatus::OK } else { DiagnosticStatus::WARN },
        name: topic.to_owned(),
        message,
        hardware_id: String::new(),
        values: values.collect(),
    }
}
