//! Physics: rapier, as this house sets it up.

mod grain;
mod step;

use std::ops::Range;

pub(crate) use step::Lost;

use periplus_geometry::{DVec3, Pose};
use rapier3d_f64::dynamics::{
    FrictionModel, ImpulseJointHandle, RigidBody, RigidBodyBuilder, RigidBodyHandle, RigidBodyType,
};
use rapier3d_f64::prelude::{ColliderHandle, PhysicsWorld};

use crate::build::{rapier_pose, scene_pose};
use crate::engine::BodyMotion;
use crate::grain::Grain;
use crate::records::{Body, BodyKind, Mark, Records};

/// Steps of the solver in one of ours.
const SUBSTEPS: usize = 4;
/// How deep bodies may lie in each other without being pushed apart [m].
const SLOP_M: f64 = 1e-4;

/// Damping ratio of contacts with what is fixed. The solver's own 10 lets a softened contact (see
/// [`crate::compliance`]) sink by 0.9 mm/s at most, this one by 1.6 mm/s.
const CONTACT_DAMPING_RATIO: f64 = 3.0;

/// What is slower than this for a second, with all that touches it, is at rest and stays so until
/// something pushes it. The solver's own 0.05 m/s would stop what slides slowly.
const ASLEEP_M_S: f64 = 1e-3;
/// The same for what has no shape.
const ASLEEP_RAD_S: f64 = 1e-3;
const ASLEEP_AFTER_S: f64 = 1.0;

/// The solver, and its names for our records. A body or joint without a name is gone.
pub(crate) struct Rigid {
    pub(crate) solver: PhysicsWorld,
    pub(crate) bodies: Vec<Option<RigidBodyHandle>>,
    pub(crate) axes: Vec<Option<ImpulseJointHandle>>,
    /// What is rougher one way.
    pub(crate) grains: Vec<(ColliderHandle, Grain)>,
    pub(crate) pushed: bool,
}

impl Rigid {
    pub(crate) fn new(gravity_m_s2: DVec3) -> Self {
        let mut solver = PhysicsWorld { gravity: gravity_m_s2, ..PhysicsWorld::default() };
        let parameters = &mut solver.integration_parameters;
        parameters.num_solver_iterations = SUBSTEPS;
        parameters.max_ccd_substeps = 0;
        parameters.friction_model = FrictionModel::Simplified;
        parameters.normalized_allowed_linear_error = SLOP_M;
        parameters.static_contact_softness.damping_ratio = CONTACT_DAMPING_RATIO;
        // A body that flies off is told, not slowed down.
        parameters.normalized_max_linear_velocity = f64::MAX;
        Self { solver, bodies: Vec::new(), axes: Vec::new(), grains: Vec::new(), pushed: false }
    }

    /// Changes gravity, which wakes all that rests.
    pub(crate) fn set_gravity(&mut self, gravity_m_s2: DVec3) {
        self.solver.gravity = gravity_m_s2;
        for handle in self.bodies.iter().flatten() {
            self.solver.bodies[*handle].wake_up(true);
        }
    }

    pub(crate) fn insert(&mut self, records: &Records, after: Mark) {
        for (number, body) in records.bodies.iter().enumerate().skip(after.bodies) {
            let handle = (!body.removed).then(|| {
                let handle = self.solver.insert_body(built(body, number));
                let mut grains = body.grains.iter().peekable();
                for (index, collider) in body.colliders.iter().enumerate() {
                    let placed = self.solver.insert_collider(collider.clone(), Some(handle));
                    let grain = grains.next_if(|(of, _)| *of == index);
                    self.grains.extend(grain.map(|&(_, grain)| (placed, grain)));
                }
                handle
            });
            self.bodies.push(handle);
        }
        for axis in &records.axes[after.axes..] {
            let ends = (self.bodies[axis.body1], self.bodies[axis.body2]);
            let handle = match ends {
                (Some(one), Some(two)) => {
                    Some(self.solver.impulse_joints.insert(one, two, axis.data, true))
                }
                _ => None,
            };
            self.axes.push(handle);
        }
        for hold in &records.holds[after.holds..] {
            if let (Some(one), Some(two)) = (self.bodies[hold.body1], self.bodies[hold.body2]) {
                self.solver.impulse_joints.insert(one, two, hold.data, true);
            }
        }
    }

    pub(crate) fn remove(&mut self, bodies: Range<usize>) {
        for number in bodies {
            if let Some(handle) = self.bodies[number].take() {
                self.solver.remove_body(handle);
            }
        }
        self.grains.retain(|(collider, _)| self.solver.colliders.contains(*collider));
    }

    pub(crate) fn body(&self, number: usize) -> Option<BodyMotion> {
        let body = &self.solver.bodies[self.bodies.get(number).copied().flatten()?];
        let world_from_body = scene_pose(body.position());
        Some(BodyMotion {
            world_from_body,
            linear_m_s: body.velocity_at_point(world_from_body.translation),
            angular_rad_s: body.angvel(),
        })
    }

    pub(crate) fn place(&mut self, places: &[(usize, Pose)]) {
        for &(number, world_from_body) in places {
            let Some(handle) = self.bodies[number] else { continue };
            let body = &mut self.solver.bodies[handle];
            body.set_position(rapier_pose(world_from_body), true);
            body.set_linvel(DVec3::ZERO, true);
            body.set_angvel(DVec3::ZERO, true);
        }
    }

    /// Gives bodies the velocity of one piece that moves with a point of it.
    pub(crate) fn move_as_one(
        &mut self,
        records: &Records,
        numbers: Range<usize>,
        point_m: DVec3,
        (linear_m_s, angular_rad_s): (DVec3, DVec3),
    ) {
        for number in numbers {
            let Some(handle) = self.bodies[number] else { continue };
            let body = &mut self.solver.bodies[handle];
            let com = records.bodies[number].mass.local_com;
            let arm_m = scene_pose(body.position()).transform_point(com) - point_m;
            body.set_linvel(linear_m_s + angular_rad_s.cross(arm_m), true);
            body.set_angvel(angular_rad_s, true);
        }
    }

    /// Pushes a body in the next step; false if nothing can move it.
    pub(crate) fn push(
        &mut self,
        records: &Records,
        number: usize,
        at_m: DVec3,
        (force_n, torque_n_m): (DVec3, DVec3),
    ) -> bool {
        let Some(handle) = self.bodies[number] else { return false };
        let body = &mut self.solver.bodies[handle];
        if !body.is_dynamic() {
            return false;
        }
        push_body(body, records.bodies[number].mass.local_com, at_m, force_n);
        body.add_torque(torque_n_m, true);
        self.pushed = true;
        true
    }

    /// Keeps a body from falling asleep; it is told to move.
    pub(crate) fn keep_awake(&mut self, handle: RigidBodyHandle) {
        let body = &self.solver.bodies[handle];
        // Asking for a body to be changed costs more than looking.
        if body.is_dynamic() && body.activation().time_since_can_sleep > ASLEEP_AFTER_S / 2.0 {
            self.solver.bodies[handle].wake_up(true);
        }
    }

    /// The solver's own step [s], of which it makes several in one of ours.
    pub(crate) fn substep_s(&self) -> f64 {
        self.solver.integration_parameters.dt / SUBSTEPS as f64
    }
}

fn built(body: &Body, number: usize) -> RigidBody {
    let kind = match body.kind {
        BodyKind::Fixed => RigidBodyType::Fixed,
        BodyKind::Kinematic => RigidBodyType::KinematicVelocityBased,
        BodyKind::Dynamic => RigidBodyType::Dynamic,
    };
    let mass = body.mass.mass();
    let mut built = RigidBodyBuilder::new(kind)
        .pose(rapier_pose(body.world_from_body))
        .additional_mass_properties(body.mass)
        .gravity_scale(if mass > 0.0 { body.weight_share / mass } else { 0.0 })
        .linear_damping(body.damping[0].max(0.0))
        .angular_damping(body.damping[1].max(0.0))
        .can_sleep(body.can_sleep)
        .user_data(number as u128)
        .build();
    let activation = built.activation_mut();
    if body.can_sleep {
        activation.normalized_linear_threshold = ASLEEP_M_S;
        activation.angular_threshold = ASLEEP_RAD_S;
        activation.time_until_sleep = ASLEEP_AFTER_S;
    }
    built
}

/// Pushes a body at a point of the world. The solver's own way would trust a centre of mass that
/// it only knows after its first step.
pub(crate) fn push_body(body: &mut RigidBody, com_in_body: DVec3, at_m: DVec3, force_n: DVec3) {
    let com = scene_pose(body.position()).transform_point(com_in_body);
    body.add_force(force_n, true);
    body.add_torque((at_m - com).cross(force_n), true);
}
