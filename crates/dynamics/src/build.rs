//! From a model as plain data to the records of a world.

use periplus_base::{DVec3, Pose};
use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_scene::{Collision, Joint, JointKind, Model};
use rapier3d_f64::dynamics::CoefficientCombineRule;
use rapier3d_f64::geometry::{
    ColliderBuilder, Group, InteractionGroups, InteractionTestMode, SharedShape,
};
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::parry::mass_properties::MassProperties;
use rapier3d_f64::pipeline::ActiveHooks;

use crate::hooks::{Part, Tag};
use crate::inertia::{mass_properties, moved};
use crate::joints::{Axes, axes_of};
use crate::places::{End, Flat};
use crate::shapes::{Meshes, shape};
use crate::wheels::wheel;
use crate::world::{Body, BodyKind, JointRecord, LinkRecord, Records, WORLD_BODY};

/// The core of a wheel ends this far below its tread, so that it never carries the robot.
const CORE_SHARE: f64 = 0.9;
/// A mass this many times another one across a joint is worth a warning: impulses reach the far
/// side of such a joint only in part.
const STEEP_RATIO: f64 = 1000.0;

pub(crate) fn rapier_pose(pose: Pose) -> RapierPose {
    RapierPose { rotation: pose.rotation, translation: pose.translation }
}

pub(crate) fn scene_pose(pose: &RapierPose) -> Pose {
    Pose { translation: pose.translation, rotation: pose.rotation }
}

/// Appends a model to the records; on an error nothing is appended.
pub(crate) fn append(
    records: &mut Records,
    model: &Model,
    world_from_model: Pose,
    meshes: &dyn Meshes,
    diagnostics: &mut Diagnostics,
) {
    let number = records.models.len() as u32;
    let (bodies, links, joints) = (records.bodies.len(), records.links.len(), records.joints.len());
    let (axes, holds) = (records.axes.len(), records.holds.len());
    let flat = Flat::new(model);
    let mut builder =
        Builder { records, number, first_link: links, world_from_model, flat, diagnostics };
    if builder.run(model, meshes).is_none() {
        records.bodies.truncate(bodies);
        records.links.truncate(links);
        records.joints.truncate(joints);
        records.axes.truncate(axes);
        records.holds.truncate(holds);
    } else {
        let first_link = links as u32;
        let canonical = model.canonical_link.as_deref();
        let canonical = records.links[links..]
            .iter()
            .position(|link| Some(link.name.as_str()) == canonical)
            .unwrap_or(0);
        records.models.push(crate::world::ModelRecord {
            name: model.name.clone(),
            world_from_model,
            links: first_link..records.links.len() as u32,
            joints: joints as u32..records.joints.len() as u32,
            bodies: bodies as u32..records.bodies.len() as u32,
            canonical: first_link + canonical as u32,
            removed: false,
        });
    }
}

struct Builder<'a, 'b> {
    records: &'a mut Records,
    number: u32,
    first_link: usize,
    world_from_model: Pose,
    flat: Flat<'b>,
    diagnostics: &'a mut Diagnostics,
}

impl Builder<'_, '_> {
    /// None where the model cannot be simulated at all.
    fn run(&mut self, model: &Model, meshes: &dyn Meshes) -> Option<()> {
        let poses = self.flat.links.iter().map(|(_, _, pose)| pose);
        if !self.world_from_model.is_finite() || poses.into_iter().any(|pose| !pose.is_finite()) {
            self.diagnostics.push(
                Diagnostic::error(
                    "pose-not-finite",
                    format!("the pose of `{}` or of a link in it is not finite", model.name),
                )
                .at(model.origin),
            );
            return None;
        }
        let group_of_link = self.groups(model.is_static);
        let driven = self.driven();
        self.bodies(model, &group_of_link, driven)?;
        self.collisions(model, meshes);
        for number in 0..self.flat.joints.len() {
            let (scope, joint) = self.flat.joints[number].clone();
            self.joint(&scope, joint)?;
        }
        self.mimics();
        self.warn_of_steep_masses();
        Some(())
    }

    /// Whether some joint of the model can move: then it must not fall asleep under a command.
    fn driven(&self) -> bool {
        self.flat.joints.iter().any(|(_, joint)| joint.kind != JointKind::Fixed)
    }

    /// For each link, the lowest link on the same rigid body; `None` in the world's.
    fn groups(&mut self, is_static: bool) -> Vec<Option<usize>> {
        let count = self.flat.links.len();
        if is_static {
            return vec![None; count];
        }
        // Union-find in which the world is the number after the last link.
        let mut above: Vec<usize> = (0..=count).collect();
        fn find(above: &mut [usize], mut member: usize) -> usize {
            while above[member] != member {
                above[member] = above[above[member]];
                member = above[member];
            }
            member
        }
        for (scope, joint) in &self.flat.joints {
            let rigid = match joint.kind {
                JointKind::Fixed => true,
                JointKind::Screw | JointKind::Gearbox => {
                    self.diagnostics.push(
                        Diagnostic::warning(
                            "joint-not-simulated",
                            format!("joint `{scope}{}` is of a kind that is not simulated; it is held fast", joint.name),
                        )
                        .at(joint.origin),
                    );
                    true
                }
                _ => false,
            };
            let number = |end: Option<End>| match end {
                Some(End::World) => Some(count),
                Some(End::Link(link, _)) => Some(link),
                None => None,
            };
            let ends = (
                number(self.flat.end(scope, &joint.parent)),
                number(self.flat.end(scope, &joint.child)),
            );
            if let (true, (Some(a), Some(b))) = (rigid, ends) {
                let (a, b) = (find(&mut above, a), find(&mut above, b));
                // The world is the root of its own group, otherwise the lowest link is.
                let (low, high) = if a == count || (b != count && a < b) { (a, b) } else { (b, a) };
                above[high] = low;
            }
        }
        (0..count).map(|link| Some(find(&mut above, link)).filter(|&root| root != count)).collect()
    }

    fn bodies(
        &mut self,
        model: &Model,
        group_of_link: &[Option<usize>],
        driven: bool,
    ) -> Option<()> {
        let mut refused = false;
        let mut body_of_group: Vec<Option<usize>> = vec![None; self.flat.links.len() + 1];
        for (number, group) in group_of_link.iter().enumerate() {
            let (name, link, model_from_link) = &self.flat.links[number];
            let world_from_link = self.world_from_model * *model_from_link;
            let slot = group.unwrap_or(self.flat.links.len());
            let body = match body_of_group[slot] {
                Some(body) => body,
                None => {
                    let kind = match (group, link.kinematic) {
                        (None, _) => BodyKind::Fixed,
                        (_, true) => BodyKind::Kinematic,
                        _ => BodyKind::Dynamic,
                    };
                    self.records.bodies.push(Body {
                        name: format!("{}::{name}", model.name),
                        kind,
                        world_from_body: world_from_link,
                        mass: MassProperties::default(),
                        weight_share: 0.0,
                        damping: link.velocity_decay,
                        can_sleep: model.allow_auto_disable && !driven,
                        colliders: Vec::new(),
                        handle: None,
                    });
                    self.records.bodies.len() - 1
                }
            };
            body_of_group[slot] = Some(body);
            let record = &mut self.records.bodies[body];
            let body_from_link = record.world_from_body.inverse() * world_from_link;
            if record.kind == BodyKind::Dynamic {
                let Some(mass) = mass_properties(link, name, self.diagnostics) else {
                    // The others may be worth a word too.
                    refused = true;
                    continue;
                };
                record.mass += moved(mass, &rapier_pose(body_from_link));
                if link.gravity {
                    record.weight_share += link.inertial.mass_kg;
                }
            }
            self.records.links.push(LinkRecord {
                model: self.number,
                name: name.clone(),
                body,
                body_from_link,
                collisions: link.collisions.iter().map(|found| found.name.clone()).collect(),
            });
        }
        (!refused).then_some(())
    }

    fn collisions(&mut self, model: &Model, meshes: &dyn Meshes) {
        let first = self.first_link;
        // A hook costs time at each step: only models of several bodies need to know their own.
        let bodies: std::collections::BTreeSet<usize> =
            self.records.links[first..].iter().map(|link| link.body).collect();
        let several = bodies.len() > 1;
        let axles = self.axles();
        for (number, axle) in axles.into_iter().enumerate() {
            let (name, link, _) = &self.flat.links[number];
            let link_number = first + number;
            let (body, body_from_link) = (
                self.records.links[link_number].body,
                self.records.links[link_number].body_from_link,
            );
            let moves = self.records.bodies[body].kind != BodyKind::Fixed;
            for (index, collision) in link.collisions.iter().enumerate() {
                let scoped = format!("{name}::{}", collision.name);
                let Ok(index) = u16::try_from(index) else {
                    self.diagnostics.push(
                        Diagnostic::warning(
                            "too-many-collisions",
                            format!(
                                "`{name}` has more than 65536 collisions; the rest will not touch"
                            ),
                        )
                        .at(link.origin),
                    );
                    break;
                };
                let finite = collision.link_from_collision.is_finite()
                    && collision.surface.friction.mu.is_finite()
                        | (collision.surface.friction.mu > 0.0);
                if !finite {
                    self.diagnostics.push(
                        Diagnostic::error(
                            "collision-not-finite",
                            format!("the pose or friction of collision `{scoped}` is not a number"),
                        )
                        .at(collision.origin),
                    );
                    continue;
                }
                let Some((collision_from_shape, solid)) =
                    shape(collision, &scoped, moves, meshes, self.diagnostics)
                else {
                    continue;
                };
                let body_from_collision = body_from_link * collision.link_from_collision;
                let tag = |part| Tag {
                    link: link_number as u32,
                    collision: index,
                    self_collide: link.self_collide || model.self_collide,
                    only_reports: collision.surface.contact.collide_without_contact,
                    part,
                };
                let surface = Surface::of(collision, &scoped, self.diagnostics);
                let mut push = |solid: SharedShape, pose: Pose, tag: Tag| {
                    let collider = surface.collider(solid, pose, tag, several);
                    self.records.bodies[body].colliders.push(collider);
                };
                let found = axle
                    .and_then(|axle| wheel(&collision.shape, collision.link_from_collision, axle));
                match found {
                    Some(wheel) => {
                        let tread = SharedShape::ball(wheel.radius_m);
                        push(tread, body_from_collision, tag(Part::Tread(wheel.half_width_m)));
                        let core =
                            SharedShape::cylinder(wheel.half_width_m, wheel.radius_m * CORE_SHARE);
                        push(core, body_from_collision * collision_from_shape, tag(Part::Core));
                    }
                    None => {
                        push(solid, body_from_collision * collision_from_shape, tag(Part::Whole));
                    }
                }
            }
        }
    }

    /// For each link that turns on exactly one hinge above it: a point of the axis and its
    /// direction, in the link's frame.
    fn axles(&self) -> Vec<Option<(DVec3, DVec3)>> {
        let mut axles = vec![None; self.flat.links.len()];
        for (scope, joint) in &self.flat.joints {
            let turns = matches!(joint.kind, JointKind::Revolute | JointKind::Continuous);
            let (Some(End::Link(link, model_from_child)), Some(axis), true) =
                (self.flat.end(scope, &joint.child), &joint.axis, turns)
            else {
                continue;
            };
            let link_from_joint =
                self.flat.links[link].2.inverse() * model_from_child * joint.child_from_joint;
            let direction = link_from_joint.rotation * axis.direction_in_joint.normalize_or_zero();
            axles[link] = Some((link_from_joint.translation, direction));
        }
        axles
    }

    /// None where the joint makes the model impossible.
    fn joint(&mut self, scope: &str, joint: &Joint) -> Option<()> {
        let name = format!("{scope}{}", joint.name);
        let ends = (self.flat.end(scope, &joint.parent), self.flat.end(scope, &joint.child));
        let body_of = |end: End| match end {
            End::World => WORLD_BODY,
            End::Link(link, _) => self.records.links[self.first_link + link].body,
        };
        let (parent, child, model_from_child) = match ends {
            (Some(parent), Some(child @ End::Link(_, pose))) => {
                (body_of(parent), body_of(child), pose)
            }
            (parent, _) => {
                let missing = if parent.is_none() { &joint.parent } else { &joint.child };
                let known: Vec<&str> =
                    self.flat.links.iter().map(|(name, ..)| name.as_str()).collect();
                let mut found = Diagnostic::error(
                    "joint-end-unknown",
                    format!(
                        "joint `{name}` holds `{missing}`, which is no link, frame or model here"
                    ),
                )
                .at(joint.origin)
                .note("the joint is left out");
                if let Some(near) = closest(missing, known) {
                    found = found.help(format!("did you mean `{near}`?"));
                }
                self.diagnostics.push(found);
                return Some(());
            }
        };
        let mut record = JointRecord {
            model: self.number,
            name,
            axes: self.records.axes.len()..self.records.axes.len(),
        };
        let rigid = matches!(
            joint.kind,
            JointKind::Fixed | JointKind::Floating | JointKind::Screw | JointKind::Gearbox
        );
        let world_from_joint = self.world_from_model * model_from_child * joint.child_from_joint;
        if !world_from_joint.is_finite() {
            self.diagnostics.push(
                Diagnostic::error(
                    "joint-impossible",
                    format!("the pose of joint `{}` is not finite", record.name),
                )
                .at(joint.origin),
            );
            return None;
        }
        if !rigid && parent == child {
            self.diagnostics.push(
                Diagnostic::warning(
                    "joint-inside-a-body",
                    format!(
                        "joint `{}` moves nothing: both sides are fixed to each other",
                        record.name
                    ),
                )
                .at(joint.origin),
            );
        } else if !rigid {
            let place = Axes { parent, child, world_from_joint };
            axes_of(joint, &record.name, place, self.records, self.diagnostics)?;
        }
        record.axes.end = self.records.axes.len();
        self.records.joints.push(record);
        Some(())
    }

    /// Binds followers to what they follow.
    fn mimics(&mut self) {
        let mine = |record: &JointRecord| record.model == self.number;
        for (scope, joint) in &self.flat.joints {
            for (which, axis) in [&joint.axis, &joint.axis2].into_iter().enumerate() {
                let Some(mimic) = axis.as_ref().and_then(|axis| axis.mimic.as_ref()) else {
                    continue;
                };
                let find = |name: &str| {
                    let scoped = format!("{scope}{name}");
                    let records = &self.records.joints;
                    records.iter().find(|record| mine(record) && record.name == scoped)
                };
                let leader = find(&mimic.joint).and_then(|leader| {
                    let second = usize::from(mimic.axis == "axis2");
                    leader.axes.clone().nth(second)
                });
                let follower =
                    find(&joint.name).and_then(|follower| follower.axes.clone().nth(which));
                match (leader, follower) {
                    (Some(leader), Some(follower)) if leader != follower => {
                        self.records.axes[follower].follows = Some(crate::joints::Follow {
                            leader,
                            multiplier: mimic.multiplier,
                            offset: mimic.offset - mimic.multiplier * mimic.reference,
                        });
                    }
                    _ => self.diagnostics.push(
                        Diagnostic::warning("mimic-of-nothing", format!("joint `{}` follows `{}`, which does not move here; it moves freely", joint.name, mimic.joint))
                            .at(joint.origin),
                    ),
                }
            }
        }
    }

    fn warn_of_steep_masses(&mut self) {
        let axes = self.records.joints.iter().filter(|joint| joint.model == self.number);
        for joint in axes {
            for axis in &self.records.axes[joint.axes.clone()] {
                let mass = |body: usize| self.records.bodies[body].mass.mass();
                let (a, b) = (mass(axis.body1), mass(axis.body2));
                if a > 0.0 && b > 0.0 && (a / b).max(b / a) > STEEP_RATIO {
                    self.diagnostics.push(
                        Diagnostic::warning(
                            "steep-masses",
                            format!(
                                "joint `{}` holds {a} kg against {b} kg; it may give way",
                                joint.name
                            ),
                        )
                        .help("make the lighter link heavier, or fix it to the other"),
                    );
                }
            }
        }
    }
}

/// Friction and bounce of one collision.
struct Surface {
    friction: f64,
    restitution: f64,
    mask: u32,
    reports: bool,
}

impl Surface {
    fn of(collision: &Collision, name: &str, diagnostics: &mut Diagnostics) -> Self {
        let (friction, contact) = (&collision.surface.friction, &collision.surface.contact);
        // ODE takes a negative coefficient for infinite.
        let endless = |mu: f64| if mu < 0.0 { f64::INFINITY } else { mu };
        let (mu, mu2) = (endless(friction.mu), endless(friction.mu2));
        if mu != mu2 && mu2.is_finite() {
            diagnostics.push(
                Diagnostic::warning(
                    "friction-one-direction",
                    format!("collision `{name}` has friction {mu} one way and {mu2} the other"),
                )
                .at(collision.origin)
                .note("the smaller one holds in every direction"),
            );
        }
        // Gazebo bounces only above a threshold, whose default nothing ever reaches.
        let bounces = contact.bounce_threshold_m_s < 1000.0 && !contact.restitution.is_nan();
        let restitution = if bounces { contact.restitution.clamp(0.0, 1.0) } else { 0.0 };
        Self {
            // Beyond this no slope is too steep, and products stay finite.
            friction: mu.min(mu2).min(1e6),
            restitution,
            mask: contact.collide_bitmask,
            reports: contact.collide_without_contact,
        }
    }

    fn collider(
        &self,
        shape: SharedShape,
        body_from_shape: Pose,
        tag: Tag,
        several: bool,
    ) -> ColliderBuilder {
        let mask = Group::from_bits_retain(self.mask);
        let mut hooks = ActiveHooks::empty();
        if several || self.reports {
            hooks |= ActiveHooks::FILTER_CONTACT_PAIRS;
        }
        if tag.part != Part::Whole {
            hooks |= ActiveHooks::MODIFY_SOLVER_CONTACTS;
        }
        ColliderBuilder::new(shape)
            .position(rapier_pose(body_from_shape))
            .density(0.0)
            .friction(self.friction)
            .friction_combine_rule(CoefficientCombineRule::Min)
            .restitution(self.restitution)
            .restitution_combine_rule(CoefficientCombineRule::Min)
            // Sharing a bit is symmetric, so members and filter are the same mask.
            .collision_groups(InteractionGroups::new(mask, mask, InteractionTestMode::And))
            .active_hooks(hooks)
            .user_data(tag.pack())
    }
}

/// A part of a body's mass, placed elsewhere.
pub(crate) fn split(mass: &MassProperties, share: f64, com: Vector) -> MassProperties {
    MassProperties::with_principal_inertia_frame(
        com,
        mass.mass() * share,
        mass.principal_inertia() * share,
        mass.principal_inertia_local_frame,
    )
}
