//! A world that moves.

use std::ops::Range;

use periplus_base::{DVec3, Pose};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::Model;
use rapier3d_f64::dynamics::{FrictionModel, RigidBodyBuilder, RigidBodyHandle, RigidBodyType};
use rapier3d_f64::geometry::ColliderBuilder;
use rapier3d_f64::parry::mass_properties::MassProperties;
use rapier3d_f64::prelude::PhysicsWorld;

use crate::build::{append, rapier_pose, scene_pose};
use crate::joints::{AxisRecord, AxisState, Command, Hold};
use crate::shapes::Meshes;
use crate::state::{Diverged, JointId, LinkId, LinkState, ModelId};

/// The body that joints to the world hold on to.
pub(crate) const WORLD_BODY: usize = 0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BodyKind {
    Fixed,
    Kinematic,
    Dynamic,
}

/// A rigid body: one link, or several on fixed joints. Its frame is that of the first.
#[derive(Clone)]
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) kind: BodyKind,
    pub(crate) world_from_body: Pose,
    pub(crate) mass: MassProperties,
    /// The mass that gravity pulls [kg].
    pub(crate) weight_share: f64,
    pub(crate) damping: [f64; 2],
    pub(crate) can_sleep: bool,
    pub(crate) colliders: Vec<ColliderBuilder>,
    pub(crate) handle: Option<RigidBodyHandle>,
}

pub(crate) struct LinkRecord {
    pub(crate) model: u32,
    pub(crate) name: String,
    pub(crate) body: usize,
    pub(crate) body_from_link: Pose,
    pub(crate) collisions: Vec<String>,
}

pub(crate) struct JointRecord {
    pub(crate) model: u32,
    pub(crate) name: String,
    pub(crate) axes: Range<usize>,
}

pub(crate) struct ModelRecord {
    pub(crate) name: String,
    pub(crate) world_from_model: Pose,
    pub(crate) links: Range<u32>,
    pub(crate) joints: Range<u32>,
    pub(crate) bodies: Range<u32>,
    pub(crate) canonical: u32,
    pub(crate) removed: bool,
}

/// All that a reset starts from again. Nothing is ever taken out, so numbers stay valid.
#[derive(Default)]
pub(crate) struct Records {
    pub(crate) models: Vec<ModelRecord>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) links: Vec<LinkRecord>,
    pub(crate) joints: Vec<JointRecord>,
    pub(crate) axes: Vec<AxisRecord>,
    pub(crate) holds: Vec<Hold>,
}

/// What became of a model.
#[derive(Debug)]
pub struct Added {
    /// Its number; none if it cannot be simulated at all.
    pub model: Option<ModelId>,
    /// What is wrong with it.
    pub diagnostics: Diagnostics,
}

/// Bodies, joints and contacts, moved step by step.
///
/// # Wheels
///
/// A cylinder that rests on its side touches the ground along a line, and a line scrubs: in place it
/// turns up to 20 % less than told, more or less by the solver's mood. A cylinder whose link turns
/// about the cylinder's own axis therefore touches by a ball of its radius, whose contacts count
/// only within the width of the tread; a core of 0.9 of the radius touches with its flat sides what
/// stands beside the wheel. Turning in place then agrees with the commanded angle to 0.5 %.
pub struct World {
    pub(crate) records: Records,
    pub(crate) model_of_link: Vec<u32>,
    pub(crate) solver: PhysicsWorld,
    pub(crate) time_s: f64,
    pub(crate) diverged: Option<Diverged>,
    pub(crate) pushed: bool,
    gravity_m_s2: DVec3,
}

impl World {
    /// A world of a file with its models. Models that cannot be simulated are left out, each with
    /// an error.
    #[must_use]
    pub fn new(world: &periplus_scene::World, meshes: &dyn Meshes) -> (Self, Diagnostics) {
        let mut diagnostics = Diagnostics::new();
        let mut gravity = world.gravity_m_s2;
        if !gravity.is_finite() {
            diagnostics.push(
                Diagnostic::error(
                    "gravity-not-finite",
                    "gravity is not a finite number; there is none",
                )
                .at(world.origin),
            );
            gravity = DVec3::ZERO;
        }
        let mut made = Self::empty(gravity);
        for model in &world.models {
            diagnostics.append(made.add(model, model.parent_from_model, meshes).diagnostics);
        }
        for joint in &world.joints {
            diagnostics.push(
                Diagnostic::warning(
                    "joint-not-simulated",
                    format!("joint `{}` between models is not simulated", joint.name),
                )
                .at(joint.origin),
            );
        }
        (made, diagnostics)
    }

    /// A world with nothing in it, and gravity in its frame [m/s²].
    #[must_use]
    pub fn empty(gravity_m_s2: DVec3) -> Self {
        let mut records = Records::default();
        records.bodies.push(Body {
            name: "world".into(),
            kind: BodyKind::Fixed,
            world_from_body: Pose::IDENTITY,
            mass: MassProperties::default(),
            weight_share: 0.0,
            damping: [0.0; 2],
            can_sleep: true,
            colliders: Vec::new(),
            handle: None,
        });
        let mut world = Self {
            records,
            model_of_link: Vec::new(),
            solver: PhysicsWorld::default(),
            time_s: 0.0,
            diverged: None,
            pushed: false,
            gravity_m_s2,
        };
        world.reset();
        world
    }

    /// Adds a model with its frame somewhere in the world.
    pub fn add(&mut self, model: &Model, world_from_model: Pose, meshes: &dyn Meshes) -> Added {
        let mut diagnostics = Diagnostics::new();
        let before = (
            self.records.models.len(),
            self.records.bodies.len(),
            self.records.axes.len(),
            self.records.holds.len(),
        );
        append(&mut self.records, model, world_from_model, meshes, &mut diagnostics);
        if self.records.models.len() == before.0 {
            return Added { model: None, diagnostics };
        }
        self.insert(before.1, before.2, before.3);
        Added { model: Some(ModelId(before.0 as u32)), diagnostics }
    }

    /// Takes a model out. Its numbers become void: questions about it are answered with none.
    pub fn remove(&mut self, model: ModelId) {
        let Some(record) = self.records.models.get_mut(model.0 as usize) else { return };
        record.removed = true;
        for body in &mut self.records.bodies[range(&record.bodies)] {
            if let Some(handle) = body.handle.take() {
                self.solver.remove_body(handle);
            }
        }
    }

    /// Everything back to where it was added, at rest and without commands. The same steps then
    /// give the same bits as in a new world. Removed models stay away.
    pub fn reset(&mut self) {
        self.solver = PhysicsWorld::default();
        self.solver.gravity = self.gravity_m_s2;
        let parameters = &mut self.solver.integration_parameters;
        parameters.num_solver_iterations = SUBSTEPS;
        parameters.max_ccd_substeps = 0;
        parameters.friction_model = FrictionModel::Simplified;
        parameters.normalized_allowed_linear_error = SLOP_M;
        // A body that flies off is told, not slowed down.
        parameters.normalized_max_linear_velocity = f64::MAX;
        self.time_s = 0.0;
        self.diverged = None;
        self.pushed = false;
        for body in &mut self.records.bodies {
            body.handle = None;
        }
        for axis in &mut self.records.axes {
            (axis.command, axis.state, axis.handle) = Default::default();
        }
        self.insert(0, 0, 0);
    }

    /// Hands records from these numbers on to the solver.
    fn insert(&mut self, bodies: usize, axes: usize, holds: usize) {
        let records = &mut self.records;
        let mut gone = vec![false; records.bodies.len()];
        for model in records.models.iter().filter(|model| model.removed) {
            gone[range(&model.bodies)].fill(true);
        }
        for (number, body) in records.bodies.iter_mut().enumerate().skip(bodies) {
            if gone[number] {
                continue;
            }
            let kind = match body.kind {
                BodyKind::Fixed => RigidBodyType::Fixed,
                BodyKind::Kinematic => RigidBodyType::KinematicVelocityBased,
                BodyKind::Dynamic => RigidBodyType::Dynamic,
            };
            let mass = body.mass.mass();
            let built = RigidBodyBuilder::new(kind)
                .pose(rapier_pose(body.world_from_body))
                .additional_mass_properties(body.mass)
                .gravity_scale(if mass > 0.0 { body.weight_share / mass } else { 0.0 })
                .linear_damping(body.damping[0].max(0.0))
                .angular_damping(body.damping[1].max(0.0))
                .can_sleep(body.can_sleep)
                .user_data(number as u128)
                .build();
            let handle = self.solver.insert_body(built);
            for collider in &body.colliders {
                self.solver.insert_collider(collider.clone(), Some(handle));
            }
            body.handle = Some(handle);
        }
        let handles: Vec<_> = records.bodies.iter().map(|body| body.handle).collect();
        for axis in &mut records.axes[axes..] {
            if let (Some(one), Some(two)) = (handles[axis.body1], handles[axis.body2]) {
                axis.handle = Some(self.solver.impulse_joints.insert(one, two, axis.data, true));
            }
        }
        for hold in &records.holds[holds..] {
            if let (Some(one), Some(two)) = (handles[hold.body1], handles[hold.body2]) {
                self.solver.impulse_joints.insert(one, two, hold.data, true);
            }
        }
        self.model_of_link = records.links.iter().map(|link| link.model).collect();
    }

    /// Simulated time since the start or the last reset [s].
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Gravity in the world's frame [m/s²].
    #[must_use]
    pub fn gravity_m_s2(&self) -> DVec3 {
        self.gravity_m_s2
    }

    /// Changes gravity [m/s²], for good.
    pub fn set_gravity(&mut self, gravity_m_s2: DVec3) {
        if gravity_m_s2.is_finite() {
            self.gravity_m_s2 = gravity_m_s2;
            self.solver.gravity = gravity_m_s2;
        }
    }

    /// The first model of a name.
    #[must_use]
    pub fn find_model(&self, name: &str) -> Option<ModelId> {
        let found =
            self.records.models.iter().position(|model| !model.removed && model.name == name);
        found.map(|number| ModelId(number as u32))
    }

    /// A link of a model by its scoped name.
    #[must_use]
    pub fn find_link(&self, model: ModelId, name: &str) -> Option<LinkId> {
        self.links(model).find(|&link| self.link_name(link) == Some(name))
    }

    /// A joint of a model by its scoped name.
    #[must_use]
    pub fn find_joint(&self, model: ModelId, name: &str) -> Option<JointId> {
        self.joints(model).find(|&joint| self.joint_name(joint) == Some(name))
    }

    /// The links of a model, in the order of the file.
    pub fn links(&self, model: ModelId) -> impl Iterator<Item = LinkId> + use<> {
        self.present(model).map_or(0..0, |model| model.links.clone()).map(LinkId)
    }

    /// The joints of a model, in the order of the file; fixed ones too.
    pub fn joints(&self, model: ModelId) -> impl Iterator<Item = JointId> + use<> {
        self.present(model).map_or(0..0, |model| model.joints.clone()).map(JointId)
    }

    /// A link's name, scoped within its model.
    #[must_use]
    pub fn link_name(&self, link: LinkId) -> Option<&str> {
        self.records.links.get(link.0 as usize).map(|link| link.name.as_str())
    }

    /// A joint's name, scoped within its model.
    #[must_use]
    pub fn joint_name(&self, joint: JointId) -> Option<&str> {
        self.records.joints.get(joint.0 as usize).map(|joint| joint.name.as_str())
    }

    /// The name of a collision of a link.
    #[must_use]
    pub fn collision_name(&self, link: LinkId, collision: usize) -> Option<&str> {
        let link = self.records.links.get(link.0 as usize)?;
        link.collisions.get(collision).map(String::as_str)
    }

    /// The model that a link belongs to.
    #[must_use]
    pub fn model_of(&self, link: LinkId) -> Option<ModelId> {
        self.model_of_link.get(link.0 as usize).map(|&model| ModelId(model))
    }

    /// Where a link is and how it moves.
    #[must_use]
    pub fn link_state(&self, link: LinkId) -> Option<LinkState> {
        let record = self.records.links.get(link.0 as usize)?;
        let body = &self.solver.bodies[self.records.bodies[record.body].handle?];
        let world_from_link = scene_pose(body.position()) * record.body_from_link;
        Some(LinkState {
            world_from_link,
            linear_m_s: body.velocity_at_point(world_from_link.translation),
            angular_rad_s: body.angvel(),
        })
    }

    /// All links of all models that are there, in the order of adding.
    #[must_use]
    pub fn snapshot(&self) -> Vec<(LinkId, LinkState)> {
        let numbers = (0..self.records.links.len() as u32).map(LinkId);
        numbers.filter_map(|link| Some((link, self.link_state(link)?))).collect()
    }

    /// All models that are there, in the order of adding, with their names.
    pub fn models(&self) -> impl Iterator<Item = (ModelId, &str)> {
        let models = self.records.models.iter().enumerate();
        models
            .filter(|(_, model)| !model.removed)
            .map(|(number, model)| (ModelId(number as u32), model.name.as_str()))
    }

    /// A model's frame in the world, carried by its canonical link.
    #[must_use]
    pub fn model_pose(&self, model: ModelId) -> Option<Pose> {
        let record = self.present(model)?;
        let link = self.records.links.get(record.canonical as usize)?;
        let body = &self.records.bodies[link.body];
        let now = scene_pose(self.solver.bodies[body.handle?].position());
        Some(now * (body.world_from_body.inverse() * record.world_from_model))
    }

    /// The axes of a joint: none of a fixed or ball joint, two of a universal joint.
    #[must_use]
    pub fn joint_state(&self, joint: JointId) -> Vec<AxisState> {
        self.axes(joint).iter().map(|axis| axis.state).collect()
    }

    /// The first axis of a joint.
    #[must_use]
    pub fn axis_state(&self, joint: JointId) -> Option<AxisState> {
        self.axes(joint).first().map(|axis| axis.state)
    }

    /// Tells the first axis of a joint what to do. False if there is none, or a number is none.
    pub fn command(&mut self, joint: JointId, command: Command) -> bool {
        self.command_axis(joint, 0, command)
    }

    /// Tells an axis of a joint what to do. False if there is none, or a number is none.
    pub fn command_axis(&mut self, joint: JointId, axis: usize, command: Command) -> bool {
        let sound = match command {
            Command::Free => true,
            Command::Velocity { target, max_effort } => target.is_finite() && max_effort >= 0.0,
            Command::Position { target, max_speed, max_effort } => {
                target.is_finite() && max_speed >= 0.0 && max_effort >= 0.0
            }
            Command::Effort(effort) => effort.is_finite(),
        };
        let Some(record) = self.records.joints.get(joint.0 as usize) else { return false };
        let Some(number) = record.axes.clone().nth(axis).filter(|_| sound) else { return false };
        self.records.axes[number].command = command;
        true
    }

    /// Puts a model down somewhere, as it is bent, at rest. False if there is no such model, or
    /// the pose is not finite.
    pub fn set_pose(&mut self, model: ModelId, world_from_model: Pose) -> bool {
        let Some(now) = self.model_pose(model).filter(|_| world_from_model.is_finite()) else {
            return false;
        };
        let change = world_from_model * now.inverse();
        self.for_bodies(model, |body, _| {
            body.set_position(rapier_pose(change * scene_pose(body.position())), true);
            body.set_linvel(DVec3::ZERO, true);
            body.set_angvel(DVec3::ZERO, true);
        })
    }

    /// Gives all bodies of a model a velocity as if it were one piece: of its frame's origin
    /// [m/s] and about it [rad/s], in world axes. This is what planar drives and Gazebo's
    /// `VelocityControl` do at each step.
    pub fn set_model_velocity(
        &mut self,
        model: ModelId,
        linear_m_s: DVec3,
        angular_rad_s: DVec3,
    ) -> bool {
        let finite = linear_m_s.is_finite() && angular_rad_s.is_finite();
        let Some(pose) = self.model_pose(model).filter(|_| finite) else { return false };
        self.for_bodies(model, |body, com| {
            let arm = scene_pose(body.position()).transform_point(com) - pose.translation;
            body.set_linvel(linear_m_s + angular_rad_s.cross(arm), true);
            body.set_angvel(angular_rad_s, true);
        })
    }

    /// Pushes a link for the next step only, at a point of the world [m], by a force [N] and a
    /// torque [N m] in world axes.
    pub fn push(&mut self, link: LinkId, at_m: DVec3, force_n: DVec3, torque_n_m: DVec3) -> bool {
        let finite = at_m.is_finite() && force_n.is_finite() && torque_n_m.is_finite();
        let record = self.records.links.get(link.0 as usize).filter(|_| finite);
        let handle = record.and_then(|link| self.records.bodies[link.body].handle);
        let Some(handle) = handle else { return false };
        let body = &mut self.solver.bodies[handle];
        if !body.is_dynamic() {
            return false;
        }
        let com = self.records.bodies[self.records.links[link.0 as usize].body].mass.local_com;
        push_body(body, com, at_m, force_n);
        body.add_torque(torque_n_m, true);
        self.pushed = true;
        true
    }

    fn for_bodies(
        &mut self,
        model: ModelId,
        mut change: impl FnMut(&mut rapier3d_f64::prelude::RigidBody, DVec3),
    ) -> bool {
        let Some(record) = self.present(model) else { return false };
        for body in &self.records.bodies[range(&record.bodies)] {
            if let Some(handle) = body.handle {
                change(&mut self.solver.bodies[handle], body.mass.local_com);
            }
        }
        true
    }

    fn axes(&self, joint: JointId) -> &[AxisRecord] {
        let record = self.records.joints.get(joint.0 as usize);
        record.map_or(&[], |joint| &self.records.axes[joint.axes.clone()])
    }

    fn present(&self, model: ModelId) -> Option<&ModelRecord> {
        self.records.models.get(model.0 as usize).filter(|model| !model.removed)
    }

    /// The solver's own step [s], of which it makes several in one of ours.
    pub(crate) fn substep_s(&self) -> f64 {
        self.solver.integration_parameters.dt / SUBSTEPS as f64
    }
}

/// Steps of the solver in one of ours.
const SUBSTEPS: usize = 4;
/// How deep bodies may lie in each other without being pushed apart [m].
const SLOP_M: f64 = 1e-4;

fn range(numbers: &Range<u32>) -> Range<usize> {
    numbers.start as usize..numbers.end as usize
}

/// Pushes a body at a point of the world. The solver's own way would trust a centre of mass that
/// it only knows after its first step.
pub(crate) fn push_body(
    body: &mut rapier3d_f64::prelude::RigidBody,
    com_in_body: DVec3,
    at_m: DVec3,
    force_n: DVec3,
) {
    let com = scene_pose(body.position()).transform_point(com_in_body);
    body.add_force(force_n, true);
    body.add_torque((at_m - com).cross(force_n), true);
}
