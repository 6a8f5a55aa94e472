//! People in the plane: crowds that walk to goals, alone and in groups, and avoid each other, walls and robots.
//!
//! A [`Crowd`] has a [`Floor`] of walls, goals with routes to them, doors, and agents with a [`PersonPlan`]. Two models choose
//! the velocities, by name: the social force model ([`SocialForceParams`]) and optimal reciprocal collision avoidance
//! ([`OrcaParams`]). Robots are given as [`MovingObstacle`]s before each step. The same settings and seed give the same
//! bytes at any number of threads.
//!
//! [`ActorScript`] is the other kind of people: those that follow waypoints, through everything.
//!
//! ```
//! use periplus_crowds::*;
//!
//! let floor = Floor::new(Wall::rectangle([0.0, 0.0], [10.0, 4.0]).to_vec())?;
//! let model = SteeringModel::named("orca").expect("one of the names");
//! let mut crowd = Crowd::new(floor, CrowdSettings { model, seed: 1, threads: 1 });
//! let goal = crowd.add_goal(PersonGoal::at(DVec2::new(9.0, 2.0)))?;
//! let plan = PersonPlan::Visit { goals: vec![goal], repeats: false };
//! let agent = crowd.add_agent(PersonSettings::at(DVec2::new(1.0, 2.0)), plan)?;
//! crowd.set_obstacles(vec![MovingObstacle::disc(DVec2::new(5.0, 2.0), 0.3, DVec2::ZERO)]);
//! for _ in 0..100 {
//!     crowd.step(0.1);
//!     assert!(crowd.obstacles()[0].distance_m(crowd.agent(agent).position()) > 0.1);
//! }
//! assert!(crowd.agent(agent).position().distance(DVec2::new(9.0, 2.0)) < 0.5);
//! # Ok::<(), CrowdError>(())
//! ```

mod agent;
mod comfort;
mod crowd;
mod door;
mod error;
pub mod experiments;
mod floor;
mod group;
mod half_plane;
mod headway;
mod model;
mod neighbours;
mod obstacle;
mod orca;
mod perception;
mod route;
mod script;
mod social_force;
mod wall;

pub use agent::{GroupId, Person, PersonGoalId, PersonId, PersonPlan, PersonSettings, PersonState};
pub use comfort::{ComfortMeter, PeopleComfort, RobotComfort};
pub use crowd::{Crowd, CrowdSettings, PersonGoal};
pub use door::{Door, DoorControl, DoorId};
pub use error::CrowdError;
pub use floor::Floor;
pub use glam::DVec2;
pub use headway::Headway;
pub use model::SteeringModel;
pub use obstacle::MovingObstacle;
pub use orca::OrcaParams;
pub use script::{ActorMotion, ActorScript, ActorTrajectory, Waypoint};
pub use social_force::SocialForceParams;
pub use wall::Wall;
