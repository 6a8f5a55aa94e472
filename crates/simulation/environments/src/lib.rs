//! Batched navigation environments for reinforcement learning, and generators of worlds.
//!
//! A [`NavigationWorld`] is what environments share: the scene of the lidar's exact rays, the obstacles at the heights
//! of the robot, and the free space in which starts and goals are connected. A [`NavigationBatch`] steps any number of
//! environments on it, each with its own seed, and writes observations into one array of the caller. The same seeds
//! and actions give the same bytes at any number of threads.
//!
//! [`generate_world`] makes worlds for the environments and for the ordinary simulation.
//!
//! ```
//! use periplus_environments::*;
//!
//! let robot = EnvironmentRobot::new(EnvironmentRobotParams::default())?;
//! let rooms = generate_world(&WorldGeneratorParams::default(), 7);
//! let (world, findings) = NavigationWorld::new(&rooms, &robot, &periplus_rendering::NoAssets, 1);
//! assert!(!findings.has_errors());
//! let (worlds, task) = (vec![std::sync::Arc::new(world)], NavigationTaskParams::default());
//! let reward = NavigationRewardParams::default();
//! let settings = NavigationSettings { worlds, robot, task, reward, agents: 1, resets_in_next_step: true };
//! let mut batch = NavigationBatch::new(settings, 8, 2)?;
//! let mut observations = vec![0.0; 8 * batch.observation_size()];
//! batch.reset(ResetRequest::default(), &mut observations)?;
//! assert!(observations[..360].iter().all(|range_m| (0.2..=10.0).contains(range_m)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod batch;
mod footprint;
mod free_space;
mod generate;
mod observation;
mod obstacles;
mod parameters;
mod plane;
mod reward;
mod robot;
mod world;

pub use batch::{
    Agent, BatchError, NavigationBatch, NavigationSettings, ResetRequest, StepOutputs,
};
pub use footprint::{PlacedFootprint, RobotFootprint, RobotFootprintError};
pub use free_space::{FreeSpace, StartAndGoal};
pub use generate::{WORLD_GENERATOR, WorldGeneratorParams, WorldKind, generate_world};
pub use observation::{ObservationError, ObservationPart, ObservationSlice, observation_layout};
pub use obstacles::{HeightBand, ObstacleArea, Obstacles};
pub use parameters::{
    DriveKind, ENVIRONMENT_ROBOT, EnvironmentRobotParams, LidarGeometry, NAVIGATION_REWARD,
    NAVIGATION_TASK, NavigationRewardParams, NavigationTaskParams,
};
pub use reward::{AgentState, REWARD_TERMS, StepResult, reward_terms};
pub use robot::{EnvironmentRobot, RobotError};
pub use world::NavigationWorld;
