//! Step-by-step simulation of a world with its robots.
//!
//! [`compose`] reads files, [`Simulation`] creates nodes for their contents and steps them, [`Run`]
//! runs them at a real-time factor. A [`SimulationRecorder`] writes published messages to a bag, a [`Driver`]
//! plays velocity commands, [`Services`] let clients change the world. A [`Snapshot`] saves a state to
//! which the simulation can return.
//!
//! ```
//! use periplus_loader::LoadContext;
//! use periplus_resources::{MemoryHost, Resolver};
//! use periplus_sim::{Options, Simulation, compose};
//!
//! let world = "<sdf version='1.9'><world name='sky'><model name='ball'><link name='ball'>
//!     <collision name='ball'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
//!     </link></model></world></sdf>";
//! let host = MemoryHost::new().with_file("/sky.sdf", world);
//! let (resolver, working_folder, open_meshes) = (Resolver::new(&host, &[]), "/".into(), true);
//! let context = LoadContext { host: &host, resolver: &resolver, working_folder, arguments: vec![], open_meshes };
//! let mut composition = compose("/sky.sdf".as_ref(), &[], &context);
//! let mut simulation = Simulation::new(&mut composition, Default::default(), Options::default());
//! while simulation.time_ns() < 1_000_000_000 {
//!     simulation.step()?;
//! }
//! assert!(simulation.robot_pose().is_some_and(|it| (it.translation.z + 4.9).abs() < 0.01));
//! # Ok::<(), periplus_sim::Diverged>(())
//! ```

mod actors;
mod arrival;
mod compose;
mod compute_topics;
mod default_world;
mod drive;
mod drive_score;
mod files;
mod fleet_score;
mod footprint;
mod free_floor;
mod ground_truth;
mod map_drawing;
mod optics;
mod pace;
mod people;
mod photo;
mod profile;
mod record;
mod run;
pub mod script;
mod services;
mod simulation;
mod truth_map;
mod wall_grid;

pub use arrival::ArrivalClock;
pub use compose::{
    Composition, ModelInstance, PlacementPose, RobotPlacement, compose, compose_plain,
};
pub use compute_topics::compute_topics;
pub use drive::{DriveError, Driver, ScriptFindings, VelocityTopic, velocity_topics};
pub use drive_score::{DriveCollision, DriveScore};
pub use files::AssetFiles;
pub use fleet_score::{FleetMember, FleetScore};
pub use free_floor::{FreeFloor, reachable_cells, spread_poses};
pub use ground_truth::{
    CameraFrame, LabelledPoint, LabellingCamera, LabellingError, LabellingLidar, LidarFrame,
};
pub use map_drawing::{MapDrawing, MapDrawingError};
pub use optics::{OpticalRange, OpticalSurface};
pub use pace::RealTimePacer;
pub use people::{
    MAX_PEOPLE_COUNT, PeopleFile, PeopleRequest, PersonMotion, RequestedDoor, RequestedGoal,
    RequestedParty, RequestedPerson, RequestedPlan, read_people,
};
pub use periplus_physics::limits::STEP_RANGE_S;
pub use periplus_physics::{Diverged, PhysicsMode};
pub use periplus_rendering::{
    DetectedObject, LabelledObject, LensError, ObjectLabel, PixelBox, PixelRegion, RenderedImages,
    SensedGeometry, box_corners,
};
pub use periplus_sensors::Quirks;
pub use periplus_sim_nodes::{FleetPathError, fleet_path_from, fleet_point_distance_m};
pub use photo::{BoundingBox, Photo, PhotoRequest};
pub use profile::{Work, WorkProfile};
pub use record::{
    PEOPLE_TOPIC, RecordError, RecordingSummary, SimulationRecorder, TRUTH_TOPIC, TopicFilter,
};
pub use run::{Run, RunProgress, Tick};
pub use services::{
    GazeboAnswer, GazeboPublisher, GazeboRequestQueue, GazeboService, GazeboTopic, InsertionResult,
    InsertionSource, ModelInsertion, Search, Services, ServicesSnapshot, SpawnError, gazebo_topic,
};
pub use simulation::{Options, PeopleReport, SimulatedRobot, Simulation, Snapshot, SnapshotError};
pub use wall_grid::{wall_grid, wall_grid_around};
