//! How the world moves: bodies, joints, contacts, and the drives of robots.
//!
//! [`World`] takes models as plain data ([`periplus_scene`]) and steps them. The solver is rapier in
//! double precision, behind this interface: none of its types shows. The same program of calls
//! gives the same bits on every machine (`enhanced-determinism`), and names play no part in it.
//!
//! What a user of Gazebo should know:
//!
//! - Links on fixed joints are one body, exactly rigid. Other joints are solved by impulses; their
//!   coordinates start at zero in the pose that the file gives. A motor cannot hold a weight whose
//!   own moment of inertia is far smaller (hundreds of times) than mass times arm squared: impulses
//!   then travel too slowly through the joint.
//! - A follower (`mimic`) is driven after its leader, and the leader does not feel it.
//! - A universal joint has a small cross between its hinges, made of a tenth of the child's mass; so
//!   has a screw, which turns as told and slides as its thread says, but is not turned by pushing.
//! - The child of a gearbox follows its parent, and the parent does not feel it.
//! - Friction of a pair is the **smaller** of the two coefficients, as in ODE; where `mu` and `mu2`
//!   of one surface differ, the smaller holds in every direction, and a warning says so.
//! - A **wheel** (a cylinder or sphere that turns about its own axis) touches with one point, in
//!   the middle of its tread: see [`wheel`](World#wheels). Slip and torsional friction are not
//!   modelled.
//! - Contacts of a model with joints give way by 0.6 mm under a quarter of its weight, whichever
//!   link they belong to, so that wheels and casters share the load. A larger `min_depth` (1 mm to
//!   5 mm) and a smaller `kp` make them softer; `kd` and `max_vel` have no effect.
//! - Meshes are exact where they are static, and their convex hull where they move; of a mesh with
//!   more than 1,000 points up to 1,000 are used, and a hint tells the accuracy. Ellipsoids are
//!   hulls of 162 points on their surface. Outlines are prisms in convex pieces, with their holes.
//!
//! In [`Mode::Kinematic`] the same world moves without physics: robots follow their twists on flat
//! ground exactly ([`Kinematic`]), joints their commands, in steps of any length. Nothing touches,
//! falls or slips there, joints that close a ring are not held, and efforts move nothing.
//!
//! [`drives`] holds the laws of the drive plugins as plain functions of numbers.

mod build;
mod compliance;
mod contacts;
pub mod drives;
mod engine;
mod exact;
mod grain;
mod hooks;
mod hull;
mod inertia;
mod joints;
mod kinematic;
pub mod limits;
mod outline;
mod places;
mod records;
mod rigid;
mod shapes;
mod state;
mod wheels;
mod world;

pub use contacts::{Contact, Touching};
pub use joints::{AxisState, Command};
pub use kinematic::{Kinematic, Twist};
pub use shapes::{Heights, Meshes, NoMeshes, Triangles};
pub use state::{Diverged, JointId, LinkId, LinkState, ModelId};
pub use world::{Added, Mode, World};
