//! Gazebo's services for inspecting and changing the world, under the names of all its generations.
//!
//! | names | from |
//! |---|---|
//! | `/pause_physics`, `/spawn_entity`, `/get_entity_state`, `/set_physics_properties`, ... | ROS 2 with Classic |
//! | `/gazebo/pause_physics`, `/gazebo/spawn_urdf_model`, `/gazebo/set_model_state`, ... | ROS 1 |
//! | `/world/<world>/control`, `create`, `remove`, `set_pose`, `set_physics`, `light_config` | Harmonic |
//!
//! Failures are answered with `success = false` and the reason; for response types without a reason
//! field it is among the [findings](Services::take_findings).

mod convert;
mod entity;
mod factory;
mod forces;
mod gazebo;
mod gz_sim;
mod insertion;
mod light;
mod metrics;
mod pause_state;
mod people;
mod physics;
mod properties;
mod reading;
mod service_aliases;
mod spawn;
mod state;
mod state_plugin;
mod topics;
mod viewer;

use std::path::PathBuf;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{GraphError, Node, NodeSettings};
use periplus_msgs::std_srvs::{Empty, EmptyResponse};

use self::factory::Factory;
use self::forces::{ActiveForces, Forces};
use self::gazebo::Gazebo;
use self::gz_sim::{GzSimServices, name_of};
use self::metrics::Metrics;
use self::pause_state::PauseState;
use self::people::PeopleTopics;
use self::physics::{Factor, Physics};
use self::properties::Properties;
use self::service_aliases::ServiceAliases;
use self::state::State;
use self::state_plugin::StatePlugin;
use self::topics::{PeriodTimer, StateTopics};
use self::viewer::ViewerTopics;
use crate::Simulation;

pub(crate) use self::entity::Entity;
pub use self::gazebo::{
    GazeboAnswer, GazeboPublisher, GazeboRequestQueue, GazeboService, GazeboTopic, gazebo_topic,
};
pub use self::insertion::{InsertionResult, InsertionSource, ModelInsertion};
pub use self::reading::Search;
pub use self::spawn::SpawnError;

/// Services of a world, processed between steps.
pub struct Services {
    tempo: PauseState,
    search: Search,
    new_factor: Option<Factor>,
    log: RejectionLog,
    pause: ServiceAliases<Empty>,
    unpause: ServiceAliases<Empty>,
    reset_simulation: ServiceAliases<Empty>,
    reset_world: ServiceAliases<Empty>,
    factory: Factory,
    state: State,
    properties: Properties,
    physics: Physics,
    forces: Forces,
    gz_sim: GzSimServices,
    topics: StateTopics,
    metrics: Metrics,
    people: Option<PeopleTopics>,
    stage: Option<ViewerTopics>,
    gazebo: Option<Gazebo>,
    last_ns: i64,
}

impl Services {
    /// Offers the services on the graph of a simulation. Files of spawned models are resolved with
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
            ServiceAliases::new(
                &node,
                [format!("/{name}").as_str(), format!("/gazebo/{name}").as_str()],
            )
        };
        Ok(Self {
            tempo: PauseState::default(),
            search,
            new_factor: None,
            log: RejectionLog { found: Diagnostics::new(), node: node.clone() },
            pause: offer("pause_physics")?,
            unpause: offer("unpause_physics")?,
            reset_simulation: offer("reset_simulation")?,
            reset_world: offer("reset_world")?,
            factory: Factory::new(&node)?,
            state: State::new(&node, &states)?,
            properties: Properties::new(&node, &properties)?,
            physics: Physics::new(&node, &properties, &name_of(&scene.name, "set_physics"))?,
            forces: Forces::new(&node)?,
            gz_sim: GzSimServices::new(&node, &scene.name)?,
            topics: StateTopics::new(&node, &states, now_ns)?,
            metrics: Metrics::new(&node, &scene.name, now_ns),
            people: PeopleTopics::new(simulation)?,
            stage: None,
            gazebo: None,
            last_ns: now_ns,
        })
    }

    /// Publishes the world for viewers, and offers to save it: `/world/<world>/scene`, `poses`,
    /// `save` and `library`. Insertable models are searched in these folders besides those of the
    /// environment.
    ///
    /// # Errors
    /// When one of the topics has another type.
    pub fn show(
        &mut self,
        simulation: &Simulation,
        folders: Vec<PathBuf>,
    ) -> Result<(), GraphError> {
        let folders = self.search.folders.iter().cloned().chain(folders).collect();
        self.stage = Some(ViewerTopics::new(&self.log.node, &simulation.scene.name, folders)?);
        if let Some(people) = &mut self.people {
            people.offer()?;
        }
        self.metrics.offer()
    }

    /// Offers to write the changed world to a file, which may be that of the world: `/world/<world>/write`. It has no effect
    /// before [`Services::show`].
    ///
    /// # Errors
    /// When the service has another type.
    pub fn write_world_to(
        &mut self,
        simulation: &Simulation,
        file: PathBuf,
    ) -> Result<(), GraphError> {
        match &mut self.stage {
            Some(stage) => stage.offer_writing(&self.log.node, &simulation.scene.name, file),
            None => Ok(()),
        }
    }

    /// Offers the world to Gazebo programs, with Gazebo's own messages; the request queue receives
    /// their calls.
    pub fn open_to_gazebo(&mut self, simulation: &Simulation) -> GazeboRequestQueue {
        self.gazebo.insert(Gazebo::new(&simulation.scene.name)).desk()
    }

    /// Pauses or resumes the simulation.
    pub fn set_paused(&mut self, is_paused: bool) {
        self.tempo.set_paused(is_paused);
    }

    /// Returns true if the next step may be taken.
    #[must_use]
    pub fn may_step(&self) -> bool {
        self.tempo.may_step()
    }

    /// Returns the latest end of the next step \[ns\], for a client that requested single steps.
    #[must_use]
    pub fn until_ns(&self) -> i64 {
        self.tempo.until_ns()
    }

    /// Returns a newly requested real-time factor, if any; an inner `None` is unlimited.
    #[must_use]
    pub fn take_factor(&mut self) -> Option<Option<f64>> {
        self.new_factor.take()
    }

    /// Returns and clears the rejected requests with their reasons.
    pub fn take_findings(&mut self) -> Diagnostics {
        std::mem::take(&mut self.log.found)
    }

    /// Processes requests and publishes due states. Call it before each step, and periodically while
    /// no step may be taken.
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
        self.gz_sim.serve(simulation, &self.search, &mut self.tempo, &mut self.log);
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
        if let Some(people) = &mut self.people
            && let Err(error) = people.serve(simulation)
        {
            self.log.refused("people", &error.to_string());
        }
        if let Some(stage) = &mut self.stage
            && let Err(error) = stage.serve(simulation, &self.search)
        {
            self.log.refused("truth", &error.to_string());
        }
        if self.tempo.may_step() {
            self.forces.push(simulation);
        } else {
            if self.stage.is_some() {
                simulation.sense_paused();
            }
            // Clients get their answers also while the simulation is paused.
            simulation.graph().settle();
        }
    }

    /// Saves forces, pause state and the times of state topics. Requests that wait are not part of
    /// it.
    #[must_use]
    pub fn snapshot(&self) -> ServicesSnapshot {
        ServicesSnapshot {
            pause: self.tempo,
            forces: self.forces.save(),
            topics: self.topics.save(),
            people: self.people.as_ref().map(PeopleTopics::save),
            last_ns: self.last_ns,
        }
    }

    /// Returns to a snapshot of these services, taken together with one of their simulation. Call it
    /// after [`Simulation::restore`].
    pub fn restore(&mut self, snapshot: &ServicesSnapshot) {
        self.tempo = snapshot.pause;
        self.forces.restore(&snapshot.forces);
        self.topics.restore(&snapshot.topics);
        if let (Some(people), Some(saved)) = (&mut self.people, snapshot.people) {
            people.restore(saved);
        }
        self.last_ns = snapshot.last_ns;
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

/// State of [`Services`] at one time.
#[derive(Clone)]
pub struct ServicesSnapshot {
    pause: PauseState,
    forces: ActiveForces,
    topics: Vec<PeriodTimer>,
    people: Option<[PeriodTimer; 2]>,
    last_ns: i64,
}

/// Rejected requests whose response has no reason field.
#[derive(Debug)]
struct RejectionLog {
    found: Diagnostics,
    node: Node,
}

impl RejectionLog {
    /// Records the reason of a failure; returns true on success.
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

    /// Records notes about a successful request.
    fn notes(&mut self, call: &str, notes: &str) {
        if !notes.trim().is_empty() {
            let message = format!("`{call}`: {}", notes.trim_end());
            self.push(Diagnostic::warning("call-findings", message));
        }
    }
}
