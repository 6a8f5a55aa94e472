//! Contact sensors and bumpers.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;
use periplus_graph::Publisher;
use periplus_msgs::gazebo_msgs::{ContactState, ContactsState};
use periplus_msgs::geometry_msgs::Wrench;
use periplus_msgs::ros_gz_interfaces::{self, Contacts, Entity, JointWrench};
use periplus_msgs::std_msgs::Header;
use periplus_physics::{CollisionId, PhysicsContact, PhysicsWorld};
use periplus_scene::SensorKind;
use periplus_sensors::contacts_of;

use super::imu::vector;
use super::port::Convention;
use super::{DeviceResult, Mount, SensorBuildContext, Timer};
use crate::{Device, DeviceState, SenseContext};

struct ContactDevice {
    mount: Mount,
    timer: Timer,
    own: Vec<CollisionId>,
    outputs: Vec<ContactOutput>,
}

enum ContactOutput {
    /// `gazebo_msgs`, in the world frame or the frame of the link.
    Classic {
        publisher: Publisher<ContactsState>,
        frame: String,
        in_world: bool,
    },
    Gz {
        publisher: Publisher<Contacts>,
        frame: String,
    },
}

pub(super) fn device(
    context: SensorBuildContext<'_, '_>,
    diagnostics: &mut Diagnostics,
) -> DeviceResult {
    let SensorKind::Contact { collisions, topic } = &context.sensor_context.sensor.kind else {
        return Err(super::SensorBuildError::unsupported(context.sensor_context.sensor));
    };
    let own = own(&context, collisions, diagnostics);
    let mut outputs = Vec::new();
    for port in &context.ports {
        outputs.push(if port.convention == Convention::Gz {
            let topic = match topic {
                Some(topic) => periplus_graph::valid_topic_name(topic),
                None => port.topic(context.sensor_context, "/contact"),
            };
            ContactOutput::Gz { publisher: port.publisher(&topic)?, frame: port.frame.clone() }
        } else {
            let name = if port.convention == Convention::Ros2 { "frame_name" } else { "frameName" };
            let frame = port.text(name);
            let frame = frame.trim_start_matches('/');
            let in_world = matches!(frame, "" | "world" | "map");
            let frame = if frame.is_empty() { "world" } else { frame }.to_owned();
            ContactOutput::Classic {
                publisher: port.publisher(&port.topic(context.sensor_context, ""))?,
                frame,
                in_world,
            }
        });
    }
    Ok(Box::new(ContactDevice {
        timer: Timer::new(context.sensor_context, &context.ports),
        mount: context.mount,
        own,
        outputs,
    }))
}

/// Returns the collisions of a sensor; all of its link if the file names none. Lumped links have
/// longer collision names that contain the original ones.
fn own(
    context: &SensorBuildContext<'_, '_>,
    wanted: &[String],
    diagnostics: &mut Diagnostics,
) -> Vec<CollisionId> {
    let (world, link) = (context.sensor_context.setting.world, context.mount.link);
    let names: Vec<&str> = (0..).map_while(|number| world.collision_name(link, number)).collect();
    let numbers = 0..names.len();
    let touching = |collision: usize| CollisionId { link, collision };
    if wanted.is_empty() {
        return numbers.map(touching).collect();
    }
    let mut own = Vec::new();
    for name in wanted {
        let last = name.rsplit("::").next().unwrap_or(name);
        let exact = numbers.clone().find(|&number| names[number] == last);
        let found = exact.or_else(|| numbers.clone().find(|&number| names[number].contains(last)));
        match found {
            Some(number) => own.push(touching(number)),
            None => diagnostics.push(
                Diagnostic::error(
                    "unknown-collision",
                    format!(
                        "sensor `{}` uses the collision `{name}`, which does not exist",
                        context.sensor_context.sensor.name
                    ),
                )
                .at(context.sensor_context.sensor.origin)
                .help(format!("collisions of its link: {}", names.join(", "))),
            ),
        }
    }
    own
}

impl ContactOutput {
    fn has_subscribers(&self) -> bool {
        match self {
            Self::Classic { publisher, .. } => publisher.is_heard(),
            Self::Gz { publisher, .. } => publisher.is_heard(),
        }
    }
}

impl Device for ContactDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let time_ns = moment.time_ns();
        if self.timer.due(time_ns).is_none()
            || !self.outputs.iter().any(ContactOutput::has_subscribers)
        {
            return;
        }
        let world = moment.world;
        let contacts = contacts_of(&world.contacts(), |touching| self.own.contains(&touching));
        for out in &self.outputs {
            match out {
                ContactOutput::Classic { publisher, frame, in_world } => {
                    publisher.publish(ContactsState {
                        header: Header::at(time_ns, frame),
                        states: contacts
                            .iter()
                            .map(|it| self.state(world, it, *in_world))
                            .collect(),
                    });
                }
                // As in Gazebo, no message without contacts.
                ContactOutput::Gz { .. } if contacts.is_empty() => {}
                ContactOutput::Gz { publisher, frame } => {
                    let header = Header::at(time_ns, frame);
                    let contacts = contacts.iter().map(|it| gz_contact(world, it)).collect();
                    publisher.publish(Contacts { header, contacts });
                }
            }
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let has_subscribers = self.outputs.iter().any(ContactOutput::has_subscribers);
        self.timer.next_ns().filter(|_| has_subscribers)
    }

    fn reset(&mut self, time_ns: i64) {
        self.timer.reset(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.timer)
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.timer)
    }
}

impl ContactDevice {
    /// Forces act on the sensor's own side, divided evenly among the points; torques are about the
    /// link's origin. Normals point into the sensor's own collision, as in ODE.
    fn state(
        &self,
        world: &PhysicsWorld,
        contact: &PhysicsContact,
        in_world: bool,
    ) -> ContactState {
        let link = world.link_state(self.mount.link);
        let world_from_link = link.map(|link| link.world_from_link).unwrap_or_default();
        let rotation = if in_world {
            periplus_geometry::DQuat::IDENTITY
        } else {
            world_from_link.rotation.conjugate()
        };
        let placed = |point: DVec3| {
            if in_world { point } else { world_from_link.inverse().transform_point(point) }
        };
        let share = share_n(contact);
        let mut state = ContactState {
            info: String::new(),
            collision1_name: collision_name(world, contact.one),
            collision2_name: collision_name(world, contact.two),
            ..ContactState::default()
        };
        let (mut force_sum, mut torque_sum) = (DVec3::ZERO, DVec3::ZERO);
        for &(point, depth_m) in &contact.points {
            let force = -contact.normal * share;
            let torque = (point - world_from_link.translation).cross(force);
            (force_sum, torque_sum) = (force_sum + force, torque_sum + torque);
            state.wrenches.push(wrench(rotation * force, rotation * torque));
            state.contact_positions.push(vector(placed(point)));
            state.contact_normals.push(vector(rotation * -contact.normal));
            state.depths.push(depth_m);
        }
        state.total_wrench = wrench(rotation * force_sum, rotation * torque_sum);
        state
    }
}

fn gz_contact(world: &PhysicsWorld, contact: &PhysicsContact) -> ros_gz_interfaces::Contact {
    let entity = |touching| Entity {
        name: collision_name(world, touching),
        r#type: Entity::COLLISION,
        ..Entity::default()
    };
    let share = share_n(contact);
    let named =
        |touching| periplus_msgs::std_msgs::String { data: collision_name(world, touching) };
    let force = |sign: f64| wrench(contact.normal * (share * sign), DVec3::ZERO);
    let at = contact.points.iter();
    ros_gz_interfaces::Contact {
        collision1: entity(contact.one),
        collision2: entity(contact.two),
        positions: at.clone().map(|(point, _)| vector(*point)).collect(),
        normals: at.clone().map(|_| vector(-contact.normal)).collect(),
        depths: at.clone().map(|(_, depth_m)| *depth_m).collect(),
        wrenches: at
            .map(|_| JointWrench {
                body_1_name: named(contact.one),
                body_2_name: named(contact.two),
                body_1_wrench: force(-1.0),
                body_2_wrench: force(1.0),
                ..JointWrench::default()
            })
            .collect(),
    }
}

/// Returns the force per contact point [N].
fn share_n(contact: &PhysicsContact) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a handful")]
    let count = contact.points.len().max(1) as f64;
    contact.force_n / count
}

fn wrench(force: DVec3, torque: DVec3) -> Wrench {
    Wrench { force: vector(force), torque: vector(torque) }
}

/// Returns `model::link::collision`, Gazebo's name of a collision.
fn collision_name(world: &PhysicsWorld, touching: CollisionId) -> String {
    let CollisionId { link, collision } = touching;
    let model = world.model_of(link);
    let model = world.models().find(|(id, _)| Some(*id) == model).map_or("", |(_, name)| name);
    let link_name = world.link_name(link).unwrap_or_default();
    let collision = world.collision_name(link, collision).unwrap_or_default();
    format!("{model}::{link_name}::{collision}")
}
