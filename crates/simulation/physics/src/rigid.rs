//! Physics by rapier, with its settings.

mod anisotropic_friction;
mod friction_limit;
mod step;

use std::ops::Range;

pub(crate) use friction_limit::LimitedCollider;
pub(crate) use step::DivergedBody;

use periplus_geometry::{DVec3, Pose};
use rapier3d_f64::dynamics::{
    FrictionModel, ImpulseJointHandle, RigidBody, RigidBodyBuilder, RigidBodyHandle, RigidBodyType,
};
use rapier3d_f64::pipeline::{CollisionPipeline, PhysicsPipeline};
use rapier3d_f64::prelude::{CCDSolver, ColliderHandle, PhysicsWorld};

use crate::anisotropic_friction::AnisotropicFriction;
use crate::build::{rapier_pose, scene_pose};
use crate::engine::BodyMotion;
use crate::records::{Body, BodyKind, Mark, Records};

/// Number of solver steps per simulation step.
const SUBSTEPS: usize = 4;
/// Penetration that is not corrected [m].
const SLOP_M: f64 = 1e-4;

/// Damping ratio of contacts with fixed bodies. The solver's default of 10 lets a softened contact
/// (see [`crate::compliance`]) sink by 0.9 mm/s at most, this one by 1.6 mm/s.
const CONTACT_DAMPING_RATIO: f64 = 3.0;

/// Linear velocity below which a body, with all its contacts, falls asleep after
/// [`ASLEEP_AFTER_S`] until a force acts on it. The solver's default of 0.05 m/s would stop slow
/// sliding.
const ASLEEP_M_S: f64 = 1e-3;
/// Angular velocity for the same, for bodies without a shape.
const ASLEEP_RAD_S: f64 = 1e-3;
const ASLEEP_AFTER_S: f64 = 1.0;

/// The solver, with handles of our records. A missing handle means that the body or joint was
/// removed.
pub(crate) struct Rigid {
    pub(crate) solver: PhysicsWorld,
    pub(crate) bodies: Vec<Option<RigidBodyHandle>>,
    pub(crate) axes: Vec<Option<ImpulseJointHandle>>,
    /// Colliders with anisotropic friction.
    pub(crate) anisotropic_colliders: Vec<(ColliderHandle, AnisotropicFriction)>,
    pub(crate) has_external_forces: bool,
    /// Colliders with limited friction.
    pub(crate) limited_colliders: Vec<LimitedCollider>,
}

impl Clone for Rigid {
    /// Copies the state of the solver. Pipelines are buffers within a step, and the solver of
    /// continuous collisions is off; both start empty.
    fn clone(&self) -> Self {
        let PhysicsWorld {
            gravity,
            integration_parameters,
            physics_pipeline: _,
            collision_pipeline: _,
            islands,
            broad_phase,
            narrow_phase,
            bodies,
            colliders,
            impulse_joints,
            multibody_joints,
            soft_bodies,
            ccd_solver: _,
        } = &self.solver;
        Self {
            solver: PhysicsWorld {
                gravity: *gravity,
                integration_parameters: *integration_parameters,
                physics_pipeline: PhysicsPipeline::new(),
                collision_pipeline: CollisionPipeline::new(),
                islands: islands.clone(),
                broad_phase: broad_phase.clone(),
                narrow_phase: narrow_phase.clone(),
                bodies: bodies.clone(),
                colliders: colliders.clone(),
                impulse_joints: impulse_joints.clone(),
                multibody_joints: multibody_joints.clone(),
                soft_bodies: soft_bodies.clone(),
                ccd_solver: CCDSolver::new(),
            },
            bodies: self.bodies.clone(),
            axes: self.axes.clone(),
            anisotropic_colliders: self.anisotropic_colliders.clone(),
            has_external_forces: self.has_external_forces,
            limited_colliders: self.limited_colliders.clone(),
        }
    }
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
        // A body that diverges is reported, not slowed down.
        parameters.normalized_max_linear_velocity = f64::MAX;
        Self {
            solver,
            bodies: Vec::new(),
            axes: Vec::new(),
            anisotropic_colliders: Vec::new(),
            has_external_forces: false,
            limited_colliders: Vec::new(),
        }
    }

    /// Changes gravity and wakes all bodies.
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
                let mut anisotropic_colliders = body.anisotropic_colliders.iter().peekable();
                for (index, collider) in body.colliders.iter().enumerate() {
                    let placed = self.solver.insert_collider(collider.clone(), Some(handle));
                    let anisotropic_friction =
                        anisotropic_colliders.next_if(|(of, _)| *of == index);
                    self.anisotropic_colliders.extend(
                        anisotropic_friction
                            .map(|&(_, anisotropic_friction)| (placed, anisotropic_friction)),
                    );
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
        for hold in &records.constraints[after.constraints..] {
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
        self.anisotropic_colliders
            .retain(|(collider, _)| self.solver.colliders.contains(*collider));
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

    /// Sets the velocities of bodies to those of one rigid piece moving with a point of it.
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

    /// Applies a force to a body in the next step; returns false for an immovable body.
    pub(crate) fn apply_force(
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
        apply_force_at(body, records.bodies[number].mass.local_com, at_m, force_n);
        body.add_torque(torque_n_m, true);
        self.has_external_forces = true;
        true
    }

    /// Keeps a commanded body awake.
    pub(crate) fn keep_awake(&mut self, handle: RigidBodyHandle) {
        let body = &self.solver.bodies[handle];
        // Mutable access to a body costs more than reading it.
        if body.is_dynamic() && body.activation().time_since_can_sleep > ASLEEP_AFTER_S / 2.0 {
            self.solver.bodies[handle].wake_up(true);
        }
    }

    /// Returns the solver's own step [s], a fraction of the simulation step.
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

/// Applies a force to a body at a point of the world. The solver's own function would use a centre
/// of mass that it only knows after its first step.
pub(crate) fn apply_force_at(
    body: &mut RigidBody,
    com_in_body: DVec3,
    at_m: DVec3,
    force_n: DVec3,
) {
    let com = scene_pose(body.position()).transform_point(com_in_body);
    body.add_force(force_n, true);
    body.add_torque((at_m - com).cross(force_n), true);
}
