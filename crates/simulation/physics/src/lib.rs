//! Physics of the simulated world: bodies, joints, contacts, and drives of robots.
//!
//! [`PhysicsWorld`] loads models ([`periplus_scene`]) and steps them. The solver is rapier in double
//! precision, behind this interface: none of its types is public. The same sequence of calls gives
//! the same bits on every machine (`enhanced-determinism`), independent of names.
//!
//! Differences for users of Gazebo:
//!
//! - Links on fixed joints are one rigid body. Other joints are solved by impulses; their
//!   coordinates are zero in the pose of the file. A motor cannot hold a load whose own moment of
//!   inertia is far smaller (hundreds of times) than mass times arm squared: impulses then converge
//!   too slowly through the joint.
//! - A mimic joint is driven after its leader, without reaction on the leader.
//! - A universal joint has a small cross between its hinges with a tenth of the child's mass. A
//!   screw joint has one too: it turns as commanded and slides by its thread, but axial forces do not
//!   turn it.
//! - The child of a gearbox follows its parent, without reaction on the parent.
//! - Friction of a pair is the **smaller** of the two coefficients, as in ODE; if `mu` and `mu2` of
//!   a surface differ, the smaller applies in all directions, with a warning.
//! - A **wheel** (a cylinder or sphere that turns about its own axis) has a single contact point in
//!   the middle of its tread: see [`wheel`](PhysicsWorld#wheels). Slip and torsional friction are not
//!   modelled.
//! - Contacts of a model with joints yield by 0.6 mm under a quarter of its weight, for all of its
//!   links, so that wheels and casters share the load. A larger `min_depth` (1 mm to 5 mm) and a
//!   smaller `kp` make them softer; `kd` and `max_vel` have no effect.
//! - Static meshes are exact; movable ones are replaced by their convex hull, reduced to 1,000
//!   points for larger meshes, with a hint about the accuracy. Ellipsoids are hulls of 162 points on
//!   their surface. Polylines are prisms in convex pieces, with their holes.
//!
//! In [`PhysicsMode::Kinematic`] the same world moves without physics: robots follow their twists in the
//! plane exactly ([`Kinematic`]), joints their commands, in steps of any length. There are no
//! contacts, gravity or slip; joints that close a loop are not enforced, and efforts have no effect.
//!
//! [`drives`] contains the control laws of the drive plugins as plain functions.
//!
//! ```
//! use periplus_geometry::{DVec3, Pose};
//! use periplus_physics::{NoMeshes, PhysicsMode, PhysicsWorld};
//! use periplus_scene::{Collision, Link, Model, Shape};
//!
//! let mut ball = Model::new("ball");
//! let collisions = vec![Collision::new("sphere", Shape::Sphere { radius_m: 0.1 })];
//! ball.links.push(Link { collisions, ..Link::new("ball") });
//! let mut world = PhysicsWorld::empty(DVec3::new(0.0, 0.0, -9.8), PhysicsMode::Rigid);
//! let model = world.add(&ball, Pose::IDENTITY, &NoMeshes).model.expect("a valid model");
//! for _ in 0..1000 {
//!     world.step(1_000_000)?;
//! }
//! let fallen_m = -world.model_pose(model).expect("a pose").translation.z;
//! assert!((fallen_m - 4.9).abs() < 0.002);
//! # Ok::<(), periplus_physics::Diverged>(())
//! ```

mod anisotropic_friction;
mod build;
mod compliance;
mod contacts;
pub mod drives;
mod engine;
mod exact;
mod flat_model;
mod hooks;
mod hull;
mod inertia;
mod joints;
mod kinematic;
pub mod limits;
mod outline;
mod records;
mod rigid;
mod shapes;
mod state;
mod wheels;
mod world;

pub use contacts::{CollisionId, PhysicsContact};
pub use joints::{AxisState, JointCommand};
pub use kinematic::{Kinematic, Twist};
pub use shapes::{Heights, Meshes, NoMeshes, Triangles};
pub use state::{Diverged, JointId, LinkId, LinkState, ModelId};
pub use world::{AddOutcome, PhysicsMode, PhysicsWorld};
