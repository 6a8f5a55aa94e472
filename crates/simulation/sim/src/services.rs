//! What others may do to the world, and ask of it: Gazebo's services under the names of all its
//! generations.
//!
//! | names | from |
//! |---|---|
//! | `/pause_physics`, `/spawn_entity`, `/get_entity_state`, `/set_physics_properties`, ... | ROS 2 with Classic |
//! | `/gazebo/pause_physics`, `/gazebo/spawn_urdf_model`, `/gazebo/set_model_state`, ... | ROS 1 |
//! | `/world/<world>/control`, `create`, `remove`, `set_pose`, `set_physics`, `light_config` | Harmonic |
//!
//! What cannot be done is answered with `success = false` and the reason; where an answer has no
//! place for a reason, it is among the [findings](Services::take_findings).

mod arrival;
mod convert;
mod entity;
mod factory;
mod forces;
mod gazebo;
mod harmonic;
mod light;
mod metrics;
mod offer;
mod physics;
mod properties;
mod reading;
mod spawn;
mod stage;
mod state;
mod state_plugin;
mod tempo;
mod topics;

use std::path::PathBuf;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{GraphError, Node, NodeSettings};
use periplus_msgs::std_srvs::{Empty, EmptyResponse};

use self::factory::Factory;
use self::forces::Forces;
use self::gazebo::Gazebo;
use self::harmonic::{Harmonic, name_of};
use self::metrics::Metrics;
use self::offer::Offer;
use self::physics::{Factor, Physics};
use self::properties::Properties;
use self::stage::Stage;
use self::state::State;
use self::state_plugin::StatePlugin;
use self::tempo::Tempo;
use self::topics::StateTopics;
use crate::Simulation;

pub use self::arrival::{Arrival, ArrivalFrom, Arrived};
pub(crate) use self::entity::Entity;
pub use self::gazebo::{
    GazeboAnswer, GazeboDesk, GazeboOutlet, GazeboService, GazeboTopic, gazebo_topic,
};
pub use self::reading::Search;

/// The services of a world. They are looked at between steps.
pub struct Services {
    tempo: Tempo,
    search: Search,
    new_factor: Option<Factor>,
    log: Log,
    pause: Offer<Empty>,
    unpause: Offer<Empty>,
    reset_simulation: Offer<Empty>,
    reset_world: Offer<Empty>,
    factory: Factory,
    state: State,
    properties: Properties,
    physics: Physics,
    forces: Forces,
    harmonic: Harmonic,
    topics: StateTopics,
    metrics: Metrics,
    stage: Option<Stage>,
    gazebo: Option<Gazebo>,
    last_ns: i64,
}

impl Services {
    /// Offers them on the graph of a simulation. What a spawned text mentions is looked for with
    /// `search`.
    ///
    /// # Errors
    /// When the graph has a node `/gazebo`, or one of the services.
    pub fn new(simulation: &Simulation, search: Search) -> Result<Self, GraphError> {
        let node = simulation.graph().node(NodeSettings::new("gazebo").keep_names())?;
        let (scene, now_ns) = (&simulation.scene, simulation.time_ns());
        let states = StatePlugin::of(scene, "gazebo_ros_state");
        let properties = StatePlugin::of(scene, "gazebo_ros_properties");
        let offer = |name: &str| {
            Offer::new(&node, [format!("/{name}").as_str(), format!("/gazebo/{name}").as_str()])
        };
        Ok(Self {
            tempo: Tempo::default(),
            search,
            new_factor: None,
            log: Log { found: Diagnostics::new(), node: node.clone() },
            pause: offer("pause_physics")?,
            unpause: offer("unpause_physics")?,
            reset_simulation: offer("reset_simulation")?,
            reset_world: offer("reset_world")?,
            factory: Factory::new(&node)?,
            state: State::new(&node, &states)?,
            properties: Properties::new(&node, &properties)?,
            physics: Physics::new(&node, &properties, &name_of(&scene.name, "set_physics"))?,
            forces: Forces::new(&node)?,
            harmonic: Harmonic::new(&node, &scene.name)?,
            topics: StateTopics::new(&node, &states, now_ns)?,
            metrics: Metrics::new(&node, &scene.name, now_ns),
            stage: None,
            gazebo: None,
            last_ns: now_ns,
        })
    }

    /// Shows the world to who draws it, and lets them save it: `/world/<world>/scene`, `poses`,
    /// `save` and `library`. Models that could be put into it are looked for in these folders beside
    /// those of the environment.
    ///
    /// # Errors
    /// When one of the topics has another type.
    pub fn show(
        &mut self,
        simulation: &Simulation,
        folders: Vec<PathBuf>,
    ) -> Result<(), GraphError> {
        let folders = self.search.folders.iter().cloned().chain(folders).collect();
        self.stage = Some(Stage::new(&self.log.node, &simulation.scene.name, folders)?);
        self.metrics.offer()
    }

    /// Offers the world to programs of Gazebo, with Gazebo's own messages; the desk is where they ask.
    pub fn open_to_gazebo(&mut self, simulation: &Simulation) -> GazeboDesk {
        self.gazebo.insert(Gazebo::new(&simulation.scene.name)).desk()
    }

    /// Stops time, or lets it go on.
    pub fn set_paused(&mut self, is_paused: bool) {
        self.tempo.set_paused(is_paused);
    }

    /// Whether the next step may be taken.
    #[must_use]
    pub fn may_step(&self) -> bool {
        self.tempo.may_step()
    }

    /// Where the next step must end at the latest \[ns\]: somebody asked for so many steps.
    #[must_use]
    pub fn until_ns(&self) -> i64 {
        self.tempo.until_ns()
    }

    /// Simulated seconds per second of the wall, if somebody asked for another pace; none inside is
    /// as fast as can be.
    #[must_use]
    pub fn take_factor(&mut self) -> Option<Option<f64>> {
        self.new_factor.take()
    }

    /// What was refused since this was last asked, and why.
    pub fn take_findings(&mut self) -> Diagnostics {
        std::mem::take(&mut self.log.found)
    }

    /// Does what was asked since the last time, and publishes states that are due. Call it before
    /// each step, and from time to time while no step may be taken.
    pub fn serve(&mut self, simulation: &mut Simulation) {
        self.tempo.arrived(simulation.time_ns());
        self.pause.answer(|_| {
            self.tempo.set_paused(true);
            EmptyResponse::default()
        });
        self.reset_simulation.answer(|_| {
            simulation.reset();
            EmptyResponse::default()
        });
        self.reset_world.answer(|_| {
            simulation.reset_models();
            EmptyResponse::default()
        });
        self.factory.serve(simulation, &self.search);
        self.state.serve(simulation, &mut self.log);
        self.properties.serve(simulation);
        let new_factor = self.physics.serve(simulation, self.tempo);
        self.new_factor = new_factor.or(self.new_factor);
        self.harmonic.serve(simulation, &self.search, &mut self.tempo, &mut self.log);
        if let Some(gazebo) = &mut self.gazebo {
            gazebo.serve(simulation, &self.search, &mut self.tempo, &mut self.log);
        }
        self.unpause.answer(|_| {
            self.tempo.set_paused(false);
            EmptyResponse::default()
        });
        if simulation.time_ns() < self.last_ns {
            self.forces.forget();
        }
        if simulation.time_ns() != self.last_ns {
            self.metrics.count_step();
        }
        self.last_ns = simulation.time_ns();
        self.forces.serve(simulation);
        self.publish(simulation);
        if let Some(stage) = &mut self.stage
            && let Err(error) = stage.serve(simulation)
        {
            self.log.refused("truth", &error.to_string());
        }
        if self.tempo.may_step() {
            self.forces.push(simulation);
        } else {
            if self.stage.is_some() {
                simulation.sense_paused();
            }
            // Who waits for an answer hears it though time stands still.
            simulation.graph().settle();
        }
    }

    fn publish(&mut self, simulation: &Simulation) {
        if let Err(error) = self.topics.publish(simulation) {
            self.log.refused("model_states", &error.to_string());
        }
        if let Err(error) = self.metrics.publish(simulation, self.tempo) {
            self.log.refused("performance_metrics", &error.to_string());
        }
    }
}

/// What was refused where the answer has no place for a reason.
#[derive(Debug)]
struct Log {
    found: Diagnostics,
    node: Node,
}

impl Log {
    /// Keeps the reason of what was not done; whether it was.
    fn note(&mut self, call: &str, done: Result<(), String>) -> bool {
        if let Err(why) = &done {
            self.refused(call, why);
        }
        done.is_ok()
    }

    fn refused(&mut self, call: &str, why: &str) {
        let message = format!("`{call}` was refused: {}", why.trim_end());
        self.push(Diagnostic::warning("call-refused", message));
    }

    fn push(&mut self, finding: Diagnostic) {
        self.node.log_finding(&finding);
        self.found.push(finding);
    }

    /// Keeps what is to be said about something that was done.
    fn notes(&mut self, call: &str, notes: &str) {
        if !notes.trim().is_empty() {
            let message = format!("`{call}`: {}", notes.trim_end());
            self.push(Diagnostic::warning("call-findings", message));
        }
    }
}
