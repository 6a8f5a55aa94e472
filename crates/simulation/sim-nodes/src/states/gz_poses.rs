//! `gz-sim-pose-publisher-system`.

use std::collections::BTreeSet;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose;
use periplus_graph::{Node, Publisher, Qos};
use periplus_msgs::{geometry_msgs, tf2_msgs};
use periplus_physics::{LinkId, PhysicsWorld};
use periplus_scene::{JointKind, Model, carrying_link};

use super::geometry::transform;
use crate::drives::{Body, BuildContext, RateTimer, earlier};
use crate::{Device, DeviceState, SenseContext, gz_topic};

/// Poses of a model's parts relative to their parents: links in their model, shapes and sensors in
/// their link. Frames are scoped names: `robot`, `robot::wheel`.
///
/// Poses are single `TransformStamped` messages, or one `TFMessage` (`use_pose_vector_msg`). With
/// `static_publisher`, `/model/<m>/pose` contains the links on movable joints, and
/// `/model/<m>/pose_static` the rest.
///
/// Source: gz-sim 8, `PosePublisher.cc`.
pub(crate) struct GzPoses {
    name: String,
    parts: Vec<Part>,
    moving: PoseTopic,
    fixed: Option<PoseTopic>,
}

struct Part {
    parent_frame: String,
    frame: String,
    place: PartPose,
    moves: bool,
}

enum PartPose {
    /// A link, in its model.
    Link { link: LinkId, model: Body },
    /// A model, in the world or in its parent model.
    Model { model: Body, around: Option<Body> },
    /// A part of a link, in the link.
    Fixed(Pose),
}

struct PoseTopic {
    out: PoseOutput,
    publish_timer: RateTimer,
}

enum PoseOutput {
    Each(Publisher<geometry_msgs::TransformStamped>),
    All(Publisher<tf2_msgs::TFMessage>),
}

/// Kinds of poses to publish.
struct PublishedParts {
    links: bool,
    visuals: bool,
    collisions: bool,
    sensors: bool,
    nested: bool,
    model: bool,
}

pub(crate) fn build(context: &BuildContext<'_>, diagnostics: &mut Diagnostics) -> Option<GzPoses> {
    let nested = context.flag("publish_nested_model_pose");
    let values = &context.plugin.values;
    let says_model = values.is_given("publish_model_pose");
    let published = PublishedParts {
        links: context.flag("publish_link_pose"),
        visuals: context.flag("publish_visual_pose"),
        collisions: context.flag("publish_collision_pose"),
        sensors: context.flag("publish_sensor_pose"),
        nested,
        // Gazebo requires both flags; `publish_model_pose` alone would have no effect.
        model: if says_model { context.flag("publish_model_pose") } else { nested },
    };
    let model = context.model();
    let body = Body::of_model(context)?;
    let name = context.model_name();
    let mut parts = Vec::new();
    if published.model {
        parts.push(Part {
            parent_frame: context.setting.scene.name.clone(),
            frame: name.to_owned(),
            place: PartPose::Model { model: body, around: None },
            moves: false,
        });
    }
    add(
        context,
        model,
        &context.setting.scoped(context.site, ""),
        name,
        body,
        &published,
        &mut parts,
    );
    let node = context.node(diagnostics)?;
    let topic = gz_topic(&context.below_model("pose"));
    let rate_hz = context.number("update_frequency");
    let moving = pose_topic(context, &node, &topic, rate_hz, diagnostics)?;
    let fixed = if context.flag("static_publisher") {
        let given = values.is_given("static_update_frequency");
        let rate_hz = if given { context.number("static_update_frequency") } else { rate_hz };
        Some(pose_topic(context, &node, &format!("{topic}_static"), rate_hz, diagnostics)?)
    } else {
        None
    };
    Some(GzPoses { name: context.name(), parts, moving, fixed })
}

fn pose_topic(
    context: &BuildContext<'_>,
    node: &Node,
    topic: &str,
    rate_hz: f64,
    diagnostics: &mut Diagnostics,
) -> Option<PoseTopic> {
    let qos = Qos::reliable(100);
    let out = if context.flag("use_pose_vector_msg") {
        PoseOutput::All(context.accept(node.publisher(topic, qos), diagnostics)?)
    } else {
        PoseOutput::Each(context.accept(node.publisher(topic, qos), diagnostics)?)
    };
    Some(PoseTopic {
        out,
        publish_timer: RateTimer::for_publisher(rate_hz, context.setting.start_ns),
    })
}

/// Adds the parts of a model: `scope` is its scope in the outermost model, `name` its frame.
fn add(
    context: &BuildContext<'_>,
    model: &Model,
    scope: &str,
    name: &str,
    body: Body,
    published: &PublishedParts,
    parts: &mut Vec<Part>,
) {
    let moving = moving_links(model);
    for link in &model.links {
        let Some(id) = context
            .setting
            .world
            .find_link(context.setting.model, &format!("{scope}{}", link.name))
        else {
            continue;
        };
        let frame = format!("{name}::{}", link.name);
        if published.links {
            parts.push(Part {
                parent_frame: name.to_owned(),
                frame: frame.clone(),
                place: PartPose::Link { link: id, model: body },
                moves: moving.contains(&link.name),
            });
        }
        let mut fixed = |is_wanted: bool, part: &str, pose: Pose| {
            if is_wanted {
                parts.push(Part {
                    parent_frame: frame.clone(),
                    frame: format!("{frame}::{part}"),
                    place: PartPose::Fixed(pose),
                    moves: false,
                });
            }
        };
        for visual in &link.visuals {
            fixed(published.visuals, &visual.name, visual.link_from_visual);
        }
        for collision in &link.collisions {
            fixed(published.collisions, &collision.name, collision.link_from_collision);
        }
        for sensor in &link.sensors {
            fixed(published.sensors, &sensor.name, sensor.parent_from_sensor);
        }
    }
    for inner in &model.models {
        let scope = format!("{scope}{}::", inner.name);
        let Some(inner_body) = Body::of(context.setting, inner, &scope) else { continue };
        let frame = format!("{name}::{}", inner.name);
        if published.nested {
            parts.push(Part {
                parent_frame: name.to_owned(),
                frame: frame.clone(),
                place: PartPose::Model { model: inner_body, around: Some(body) },
                moves: false,
            });
        }
        add(context, inner, &scope, &frame, inner_body, published, parts);
    }
}

/// Returns the links on movable joints, except the canonical link.
fn moving_links(model: &Model) -> BTreeSet<String> {
    let joints = model.joints.iter().filter(|joint| joint.kind != JointKind::Fixed);
    let ends = joints.flat_map(|joint| [&joint.parent, &joint.child]);
    let mut links: BTreeSet<String> = ends.filter_map(|end| carrying_link(model, end)).collect();
    if let Some((canonical, _)) = crate::drives::canonical(model) {
        links.remove(&canonical);
    }
    links
}

impl PartPose {
    /// Returns the pose of the part in its parent.
    fn pose(&self, world: &PhysicsWorld) -> Option<Pose> {
        let of = |body: &Body| Some(body.state(world)?.world_from_link);
        match self {
            Self::Link { link, model } => {
                let world_from_link = world.link_state(*link)?.world_from_link;
                Some(of(model)?.inverse() * world_from_link)
            }
            Self::Model { model, around: None } => of(model),
            Self::Model { model, around: Some(around) } => Some(of(around)?.inverse() * of(model)?),
            Self::Fixed(pose) => Some(*pose),
        }
    }
}

impl PoseTopic {
    fn has_subscribers(&self) -> bool {
        match &self.out {
            PoseOutput::Each(publisher) => publisher.is_heard(),
            PoseOutput::All(publisher) => publisher.is_heard(),
        }
    }

    fn next_ns(&self) -> Option<i64> {
        self.publish_timer.next_ns().filter(|_| self.has_subscribers())
    }

    fn publish<'p>(&mut self, parts: impl Iterator<Item = &'p Part>, moment: &SenseContext<'_>) {
        let now_ns = moment.time_ns();
        if !self.publish_timer.due(now_ns) || !self.has_subscribers() {
            return;
        }
        let transforms = parts.filter_map(|part| {
            let pose = part.place.pose(moment.world)?;
            Some(transform(now_ns, &part.parent_frame, &part.frame, pose))
        });
        match &self.out {
            PoseOutput::Each(publisher) => transforms.for_each(|one| publisher.publish(one)),
            PoseOutput::All(publisher) => {
                publisher.publish(tf2_msgs::TFMessage { transforms: transforms.collect() });
            }
        }
    }
}

impl Device for GzPoses {
    fn name(&self) -> &str {
        &self.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        match &mut self.fixed {
            Some(fixed) => {
                fixed.publish(self.parts.iter().filter(|part| !part.moves), moment);
                self.moving.publish(self.parts.iter().filter(|part| part.moves), moment);
            }
            None => self.moving.publish(self.parts.iter(), moment),
        }
    }

    fn next_ns(&self) -> Option<i64> {
        earlier(self.moving.next_ns(), self.fixed.as_ref().and_then(PoseTopic::next_ns))
    }

    fn reset(&mut self, time_ns: i64) {
        self.moving.publish_timer.restart(time_ns);
        if let Some(fixed) = &mut self.fixed {
            fixed.publish_timer.restart(time_ns);
        }
    }

    fn save(&self) -> DeviceState {
        let fixed = self.fixed.as_ref().map(|fixed| fixed.publish_timer.clone());
        DeviceState::new((self.moving.publish_timer.clone(), fixed))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((moving, fixed)) = saved.get::<(RateTimer, Option<RateTimer>)>() else {
            return false;
        };
        self.moving.publish_timer = moving.clone();
        if let (Some(topic), Some(fixed)) = (&mut self.fixed, fixed) {
            topic.publish_timer = fixed.clone();
        }
        true
    }
}
