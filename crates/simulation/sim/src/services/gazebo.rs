//! The world for programs of Gazebo: its services with Gazebo's own messages, and what it says of itself.
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
//! Those that change the world are there as `.../blocking` too. `/world/<world>/state`, which Gazebo's own
//! window needs, is not there. Who carries the bytes is told by a [`GazeboOutlet`]; this room knows no
//! network.
//!
//! Source: gz-sim's `SimulationRunner`, `UserCommands` and `SceneBroadcaster`.

mod answers;
mod scene;

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use periplus_gz_msgs::{Clock, Message, Time, WorldStatistics};
use periplus_os::Stopwatch;

use super::Log;
use super::reading::Search;
use super::tempo::Tempo;
use crate::Simulation;

/// Wall time between two messages, as in Gazebo.
const STATS_PERIOD: Duration = Duration::from_millis(100);
const POSES_PERIOD: Duration = Duration::from_millis(16);

/// So many questions wait at most; more are refused.
const MOST_WAITING: usize = 1_000;

/// Takes an answer: none says that there is none.
pub type GazeboAnswer = Box<dyn FnOnce(Option<Vec<u8>>) + Send>;

/// Carries what the world says.
pub trait GazeboOutlet: Send {
    /// Whether somebody hears a topic, by its place in [`GazeboDesk::topics`].
    fn is_heard(&self, topic: usize) -> bool;

    /// Sends a message.
    fn put(&self, topic: usize, message: Vec<u8>);
}

/// A service and the types of its question and answer, without what a release puts in front.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GazeboService {
    /// Its name.
    pub name: String,
    /// The type of the question.
    pub request: &'static str,
    /// The type of the answer.
    pub response: &'static str,
    does: Does,
}

/// A topic and its type, without what a release puts in front.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GazeboTopic {
    /// Its name.
    pub name: String,
    /// The type of its messages.
    pub of: &'static str,
    says: Says,
}

/// What a service does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Does {
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

/// What a topic says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Says {
    Stats,
    Clock,
    Poses,
    Scene,
}

/// Where programs of Gazebo ask. Handles of it mean the same.
#[derive(Clone)]
pub struct GazeboDesk(Arc<Shared>);

struct Shared {
    services: Vec<GazeboService>,
    topics: Vec<GazeboTopic>,
    waiting: Mutex<VecDeque<(Does, Vec<u8>, GazeboAnswer)>>,
    outlet: Mutex<Option<Box<dyn GazeboOutlet>>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl GazeboDesk {
    fn new(world: &str) -> Self {
        // Gazebo does not allow spaces in names of topics.
        let world = world.replace(' ', "_");
        let name = |what: &str| format!("/world/{world}/{what}");
        let mut services = Vec::new();
        let mut service = |name: String, request, response, does| {
            services.push(GazeboService { name, request, response, does });
        };
        service(name("control"), "WorldControl", "Boolean", Does::Control);
        for (what, request, does) in [
            ("create", "EntityFactory", Does::Create),
            ("create_multiple", "EntityFactory_V", Does::CreateMany),
            ("remove", "Entity", Does::Remove),
            ("set_pose", "Pose", Does::SetPose),
            ("set_pose_vector", "Pose_V", Does::SetPoses),
            ("light_config", "Light", Does::SetLight),
        ] {
            // All wait until it is done here.
            service(name(what), request, "Boolean", does);
            service(name(&format!("{what}/blocking")), request, "Boolean", does);
        }
        service(name("scene/info"), "Empty", "Scene", Does::TellScene);
        service(name("generate_world_sdf"), "SdfGeneratorConfig", "StringMsg", Does::TellSdf);
        service("/gazebo/worlds".into(), "Empty", "StringMsg_V", Does::TellWorlds);
        let topics = [
            ("/stats".to_owned(), "WorldStatistics", Says::Stats),
            (name("stats"), "WorldStatistics", Says::Stats),
            (name("clock"), "Clock", Says::Clock),
            (name("pose/info"), "Pose_V", Says::Poses),
            (name("dynamic_pose/info"), "Pose_V", Says::Poses),
            (name("scene/info"), "Scene", Says::Scene),
        ];
        let topics = topics.into_iter().map(|(name, of, says)| GazeboTopic { name, of, says });
        Self(Arc::new(Shared {
            services,
            topics: topics.collect(),
            waiting: Mutex::default(),
            outlet: Mutex::default(),
        }))
    }

    /// What can be asked.
    #[must_use]
    pub fn services(&self) -> &[GazeboService] {
        &self.0.services
    }

    /// What is said.
    #[must_use]
    pub fn topics(&self) -> &[GazeboTopic] {
        &self.0.topics
    }

    /// Asks a service, by its place in [`GazeboDesk::services`]. The answer comes between two steps.
    pub fn ask(&self, service: usize, request: Vec<u8>, answer: GazeboAnswer) {
        let mut waiting = lock(&self.0.waiting);
        match self.0.services.get(service) {
            Some(known) if waiting.len() < MOST_WAITING => {
                waiting.push_back((known.does, request, answer));
            }
            _ => {
                drop(waiting);
                answer(None);
            }
        }
    }

    /// Says who carries what the world says.
    pub fn set_outlet(&self, outlet: Box<dyn GazeboOutlet>) {
        *lock(&self.0.outlet) = Some(outlet);
    }
}

impl std::fmt::Debug for GazeboDesk {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("GazeboDesk").field("services", &self.0.services.len()).finish()
    }
}

/// The world for programs of Gazebo.
pub(super) struct Gazebo {
    desk: GazeboDesk,
    /// How long the world is there, and how long of that it stood still.
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
            desk: GazeboDesk::new(world),
            since: Stopwatch::start(),
            paused: Duration::ZERO,
            last: Duration::ZERO,
            stats: None,
            poses: None,
            told: None,
            clock_ns: None,
        }
    }

    pub(super) fn desk(&self) -> GazeboDesk {
        self.desk.clone()
    }

    /// Answers what was asked, and says what is due.
    pub(super) fn serve(
        &mut self,
        simulation: &mut Simulation,
        search: &Search,
        tempo: &mut Tempo,
        log: &mut Log,
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

    fn say(&mut self, simulation: &Simulation, tempo: Tempo) {
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
                Says::Stats => stats,
                Says::Clock => clock,
                Says::Poses => poses,
                Says::Scene => scene,
            };
            if is_due && outlet.is_heard(place) {
                outlet.put(place, self.message(topic.says, simulation, tempo));
            }
        }
    }

    fn message(&self, says: Says, simulation: &Simulation, tempo: Tempo) -> Vec<u8> {
        match says {
            Says::Stats => self.statistics(simulation, tempo).encode(),
            Says::Clock => Clock {
                real: Some(of(self.last)),
                sim: Some(Time::of_ns(simulation.time_ns())),
                ..Clock::default()
            }
            .encode(),
            Says::Poses => scene::poses(simulation).encode(),
            Says::Scene => scene::scene(simulation).encode(),
        }
    }

    fn statistics(&self, simulation: &Simulation, tempo: Tempo) -> WorldStatistics {
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

/// Names that Gazebo has for topics of the graph: ROS allows fewer letters, so that
/// `/model/pong-bot/odometry` is `/model/pong_bot/odometry` there.
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
