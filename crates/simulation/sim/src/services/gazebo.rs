//! Gazebo Transport interface of the world: services and topics with Gazebo's own messages.
//!
//! | name | type |
//! |---|---|
//! | `/world/<world>/control` | `WorldControl` to `Boolean` |
//! | `/world/<world>/create`, `create_multiple` | `EntityFactory`, `EntityFactory_V` to `Boolean` |
//! | `/world/<world>/remove` | `Entity` to `Boolean` |
//! | `/world/<world>/set_pose`, `set_pose_vector` | `Pose`, `Pose_V` to `Boolean` |
//! | `/world/<world>/light_config` | `Light` to `Boolean` |
//! | `/world/<world>/scene/info` | `Empty` to `Scene` |
//! | `/world/<world>/generate_world_sdf` | `SdfGeneratorConfig` to `StringMsg` |
//! | `/gazebo/worlds` | `Empty` to `StringMsg_V` |
//! | topics `/stats`, `/world/<world>/stats`, `clock`, `pose/info`, `dynamic_pose/info`, `scene/info` | `WorldStatistics`, `Clock`, `Pose_V`, `Scene` |
//!
//! Services that change the world exist as `.../blocking` too. `/world/<world>/state`, which
//! Gazebo's own GUI needs, is not implemented. A [`GazeboPublisher`] carries the bytes; this crate is
//! independent of the network.
//!
//! Source: gz-sim's `SimulationRunner`, `UserCommands` and `SceneBroadcaster`.

mod answers;
mod scene;

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use periplus_gz_msgs::{Clock, Message, Time, WorldStatistics};
use periplus_os::Stopwatch;

use super::RejectionLog;
use super::pause_state::PauseState;
use super::reading::Search;
use crate::Simulation;

/// Wall time between two messages, as in Gazebo.
const STATS_PERIOD: Duration = Duration::from_millis(100);
const POSES_PERIOD: Duration = Duration::from_millis(16);

/// Maximum number of queued requests; more are rejected.
const MAX_REQUEST_COUNT: usize = 1_000;

/// Callback for a response; `None` means that there is none.
pub type GazeboAnswer = Box<dyn FnOnce(Option<Vec<u8>>) + Send>;

/// Transport of published messages.
pub trait GazeboPublisher: Send {
    /// Returns true if a topic, by its index in [`GazeboRequestQueue::topics`], has subscribers.
    fn is_heard(&self, topic: usize) -> bool;

    /// Publishes a message.
    fn put(&self, topic: usize, message: Vec<u8>);
}

/// A service with its request and response types, without the package prefix of a release.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GazeboService {
    /// Name of the service.
    pub name: String,
    /// Type of the request.
    pub request: &'static str,
    /// Type of the response.
    pub response: &'static str,
    does: GazeboAction,
}

/// A topic with its type, without the package prefix of a release.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GazeboTopic {
    /// Name of the topic.
    pub name: String,
    /// Type of its messages.
    pub of: &'static str,
    says: GazeboContent,
}

/// Action of a service.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GazeboAction {
    Control,
    Create,
    CreateMany,
    Remove,
    SetPose,
    SetPoses,
    SetLight,
    TellScene,
    TellSdf,
    TellWorlds,
}

/// Content of a topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GazeboContent {
    Stats,
    Clock,
    Poses,
    Scene,
}

/// Queue of requests from Gazebo programs. Clones share the queue.
#[derive(Clone)]
pub struct GazeboRequestQueue(Arc<Shared>);

struct Shared {
    services: Vec<GazeboService>,
    topics: Vec<GazeboTopic>,
    waiting: Mutex<VecDeque<(GazeboAction, Vec<u8>, GazeboAnswer)>>,
    outlet: Mutex<Option<Box<dyn GazeboPublisher>>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl GazeboRequestQueue {
    fn new(world: &str) -> Self {
        // Gazebo does not allow spaces in topic names.
        let world = world.replace(' ', "_");
        let name = |what: &str| format!("/world/{world}/{what}");
        let mut services = Vec::new();
        let mut service = |name: String, request, response, does| {
            services.push(GazeboService { name, request, response, does });
        };
        service(name("control"), "WorldControl", "Boolean", GazeboAction::Control);
        for (what, request, does) in [
            ("create", "EntityFactory", GazeboAction::Create),
            ("create_multiple", "EntityFactory_V", GazeboAction::CreateMany),
            ("remove", "Entity", GazeboAction::Remove),
            ("set_pose", "Pose", GazeboAction::SetPose),
            ("set_pose_vector", "Pose_V", GazeboAction::SetPoses),
            ("light_config", "Light", GazeboAction::SetLight),
        ] {
            // All variants block until the action is done.
            service(name(what), request, "Boolean", does);
            service(name(&format!("{what}/blocking")), request, "Boolean", does);
        }
        service(name("scene/info"), "Empty", "Scene", GazeboAction::TellScene);
        service(
            name("generate_world_sdf"),
            "SdfGeneratorConfig",
            "StringMsg",
            GazeboAction::TellSdf,
        );
        service("/gazebo/worlds".into(), "Empty", "StringMsg_V", GazeboAction::TellWorlds);
        let topics = [
            ("/stats".to_owned(), "WorldStatistics", GazeboContent::Stats),
            (name("stats"), "WorldStatistics", GazeboContent::Stats),
            (name("clock"), "Clock", GazeboContent::Clock),
            (name("pose/info"), "Pose_V", GazeboContent::Poses),
            (name("dynamic_pose/info"), "Pose_V", GazeboContent::Poses),
            (name("scene/info"), "Scene", GazeboContent::Scene),
        ];
        let topics = topics.into_iter().map(|(name, of, says)| GazeboTopic { name, of, says });
        Self(Arc::new(Shared {
            services,
            topics: topics.collect(),
            waiting: Mutex::default(),
            outlet: Mutex::default(),
        }))
    }

    /// Returns the services.
    #[must_use]
    pub fn services(&self) -> &[GazeboService] {
        &self.0.services
    }

    /// Returns the topics.
    #[must_use]
    pub fn topics(&self) -> &[GazeboTopic] {
        &self.0.topics
    }

    /// Requests a service, by its index in [`GazeboRequestQueue::services`]. The response is sent between
    /// two steps.
    pub fn ask(&self, service: usize, request: Vec<u8>, answer: GazeboAnswer) {
        let mut waiting = lock(&self.0.waiting);
        match self.0.services.get(service) {
            Some(known) if waiting.len() < MAX_REQUEST_COUNT => {
                waiting.push_back((known.does, request, answer));
            }
            _ => {
                drop(waiting);
                answer(None);
            }
        }
    }

    /// Sets the transport of published messages.
    pub fn set_outlet(&self, outlet: Box<dyn GazeboPublisher>) {
        *lock(&self.0.outlet) = Some(outlet);
    }
}

impl std::fmt::Debug for GazeboRequestQueue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("GazeboRequestQueue").field("services", &self.0.services.len()).finish()
    }
}

/// Gazebo interface of a world.
pub(super) struct Gazebo {
    desk: GazeboRequestQueue,
    /// Wall time of the world, and the paused part of it.
    since: Stopwatch,
    paused: Duration,
    last: Duration,
    stats: Option<Stopwatch>,
    poses: Option<Stopwatch>,
    told: Option<u64>,
    clock_ns: Option<i64>,
}

impl Gazebo {
    pub(super) fn new(world: &str) -> Self {
        Self {
            desk: GazeboRequestQueue::new(world),
            since: Stopwatch::start(),
            paused: Duration::ZERO,
            last: Duration::ZERO,
            stats: None,
            poses: None,
            told: None,
            clock_ns: None,
        }
    }

    pub(super) fn desk(&self) -> GazeboRequestQueue {
        self.desk.clone()
    }

    /// Answers requests and publishes due messages.
    pub(super) fn serve(
        &mut self,
        simulation: &mut Simulation,
        search: &Search,
        tempo: &mut PauseState,
        log: &mut RejectionLog,
    ) {
        let asked = std::mem::take(&mut *lock(&self.desk.0.waiting));
        for (does, request, answer) in asked {
            answer(answers::answer(does, &request, simulation, search, tempo, log));
        }
        let now = self.since.elapsed();
        if !tempo.may_step() {
            self.paused += now.saturating_sub(self.last);
        }
        self.last = now;
        self.say(simulation, *tempo);
    }

    fn say(&mut self, simulation: &Simulation, tempo: PauseState) {
        let is_due = |since: &Option<Stopwatch>, period| {
            since.as_ref().is_none_or(|since| since.elapsed() >= period)
        };
        let (stats, poses) = (is_due(&self.stats, STATS_PERIOD), is_due(&self.poses, POSES_PERIOD));
        let clock = self.clock_ns.replace(simulation.time_ns()) != Some(simulation.time_ns());
        let scene = self.told.replace(simulation.changes()) != Some(simulation.changes());
        if stats {
            self.stats = Some(Stopwatch::start());
        }
        if poses {
            self.poses = Some(Stopwatch::start());
        }
        let outlet = lock(&self.desk.0.outlet);
        let Some(outlet) = outlet.as_ref() else { return };
        for (place, topic) in self.desk.0.topics.iter().enumerate() {
            let is_due = match topic.says {
                GazeboContent::Stats => stats,
                GazeboContent::Clock => clock,
                GazeboContent::Poses => poses,
                GazeboContent::Scene => scene,
            };
            if is_due && outlet.is_heard(place) {
                outlet.put(place, self.message(topic.says, simulation, tempo));
            }
        }
    }

    fn message(&self, says: GazeboContent, simulation: &Simulation, tempo: PauseState) -> Vec<u8> {
        match says {
            GazeboContent::Stats => self.statistics(simulation, tempo).encode(),
            GazeboContent::Clock => Clock {
                real: Some(of(self.last)),
                sim: Some(Time::of_ns(simulation.time_ns())),
                ..Clock::default()
            }
            .encode(),
            GazeboContent::Poses => scene::poses(simulation).encode(),
            GazeboContent::Scene => scene::scene(simulation).encode(),
        }
    }

    fn statistics(&self, simulation: &Simulation, tempo: PauseState) -> WorldStatistics {
        let running = self.last.saturating_sub(self.paused);
        let time_ns = simulation.time_ns();
        #[expect(clippy::cast_precision_loss, reason = "a run lasts less than 2^53 ns")]
        let real_time_factor = time_ns as f64 * 1e-9 / running.as_secs_f64().max(1e-9);
        WorldStatistics {
            sim_time: Some(Time::of_ns(time_ns)),
            pause_time: Some(of(self.paused)),
            real_time: Some(of(running)),
            paused: tempo.is_paused(),
            iterations: u64::try_from(time_ns / simulation.step_ns()).unwrap_or_default(),
            model_count: i32::try_from(simulation.models().count()).unwrap_or(i32::MAX),
            real_time_factor,
            step_size: Some(Time::of_ns(simulation.step_ns())),
            stepping: tempo.is_stepping(),
            ..WorldStatistics::default()
        }
    }
}

fn of(time: Duration) -> Time {
    Time::of_ns(i64::try_from(time.as_nanos()).unwrap_or(i64::MAX))
}

/// Returns Gazebo's names of graph topics. ROS allows fewer characters: `/model/pong-bot/odometry`
/// of Gazebo is `/model/pong_bot/odometry` in the graph.
pub fn gazebo_topic(simulation: &Simulation) -> impl Fn(&str) -> Option<String> + Send + 'static {
    let mut names = Vec::new();
    let mut name = |own: &str| {
        let ros = periplus_graph::valid_node_name(own);
        if ros != own && !own.contains([' ', '@', '~']) {
            names.push((ros, own.to_owned()));
        }
    };
    name(&simulation.scene.name);
    for running in &simulation.running {
        name(&running.member.name);
        for link in &running.member.model.links {
            name(&link.name);
            link.sensors.iter().for_each(|sensor| name(&sensor.name));
        }
    }
    move |topic: &str| {
        let mut before = "";
        let parts = topic.split('/').map(|part| {
            let is_name = matches!(before, "world" | "model" | "link" | "sensor");
            before = part;
            let own = names.iter().find(|(ros, _)| is_name && ros == part);
            own.map_or(part, |(_, own)| own.as_str())
        });
        Some(parts.collect::<Vec<_>>().join("/"))
    }
}
