//! `gz-sim-pose-publisher-system`.

use std::collections::BTreeSet;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose;
use periplus_graph::{Node, Publisher, Qos};
use periplus_msgs::{geometry_msgs, tf2_msgs};
use periplus_physics::{LinkId, World};
use periplus_scene::{JointKind, Model, carrying_link};

use super::geometry::transform;
use crate::drives::{Beat, Body, Order, earlier};
use crate::{Device, Moment, gz_topic};

/// Where the parts of a model are, each in what it is a part of: links in their model, shapes and
/// sensors in their link. Frames are named by their scope: `robot`, `robot::wheel`.
///
/// Each pose is a `TransformStamped` of its own, or all are one `TFMessage`
/// (`use_pose_vector_msg`). With `static_publisher`, `/model/<m>/pose` has the links on joints that
/// move, and `/model/<m>/pose_static` the rest.
///
/// Source: gz-sim 8, `PosePublisher.cc`.
pub(crate) struct GzPoses {
    name: String,
    parts: Vec<Part>,
    moving: Outlet,
    still: Option<Outlet>,
}

struct Part {
    parent_frame: String,
    frame: String,
    place: Place,
    moves: bool,
}

enum Place {
    /// A link, in its model.
    Link { link: LinkId, model: Body },
    /// A model, in the world or in the model around it.
    Model { model: Body, around: Option<Body> },
    /// A part of a link, in it.
    Fixed(Pose),
}

struct Outlet {
    out: Out,
    tells: Beat,
}

enum Out {
    Each(Publisher<geometry_msgs::TransformStamped>),
    All(Publisher<tf2_msgs::TFMessage>),
}

/// What is published, apart from links.
struct Wanted {
    links: bool,
    visuals: bool,
    collisions: bool,
    sensors: bool,
    nested: bool,
    model: bool,
}

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<GzPoses> {
    let nested = order.flag("publish_nested_model_pose");
    let values = &order.plugin.values;
    let says_model = values.is_given("publish_model_pose");
    let wanted = Wanted {
        links: order.flag("publish_link_pose"),
        visuals: order.flag("publish_visual_pose"),
        collisions: order.flag("publish_collision_pose"),
        sensors: order.flag("publish_sensor_pose"),
        nested,
        // Gazebo asks for both; nobody who writes `publish_model_pose` alone means nothing by it.
        model: if says_model { order.flag("publish_model_pose") } else { nested },
    };
    let model = order.model();
    let body = Body::of_model(order)?;
    let name = order.model_name();
    let mut parts = Vec::new();
    if wanted.model {
        parts.push(Part {
            parent_frame: order.setting.scene.name.clone(),
            frame: name.to_owned(),
            place: Place::Model { model: body, around: None },
            moves: false,
        });
    }
    add(order, model, &order.setting.scoped(order.site, ""), name, body, &wanted, &mut parts);
    let node = order.node(diagnostics)?;
    let topic = gz_topic(&order.below_model("pose"));
    let rate_hz = order.number("update_frequency");
    let moving = outlet(order, &node, &topic, rate_hz, diagnostics)?;
    let still = if order.flag("static_publisher") {
        let given = values.is_given("static_update_frequency");
        let rate_hz = if given { order.number("static_update_frequency") } else { rate_hz };
        Some(outlet(order, &node, &format!("{topic}_static"), rate_hz, diagnostics)?)
    } else {
        None
    };
    Some(GzPoses { name: order.name(), parts, moving, still })
}

fn outlet(
    order: &Order<'_>,
    node: &Node,
    topic: &str,
    rate_hz: f64,
    diagnostics: &mut Diagnostics,
) -> Option<Outlet> {
    let qos = Qos::reliable(100);
    let out = if order.flag("use_pose_vector_msg") {
        Out::All(order.accept(node.publisher(topic, qos), diagnostics)?)
    } else {
        Out::Each(order.accept(node.publisher(topic, qos), diagnostics)?)
    };
    Some(Outlet { out, tells: Beat::telling(rate_hz, order.setting.start_ns) })
}

/// Adds the parts of a model: `scope` is its place in the outermost model, `name` in the frames.
fn add(
    order: &Order<'_>,
    model: &Model,
    scope: &str,
    name: &str,
    body: Body,
    wanted: &Wanted,
    parts: &mut Vec<Part>,
) {
    let moving = moving_links(model);
    for link in &model.links {
        let Some(id) =
            order.setting.world.find_link(order.setting.model, &format!("{scope}{}", link.name))
        else {
            continue;
        };
        let frame = format!("{name}::{}", link.name);
        if wanted.links {
            parts.push(Part {
                parent_frame: name.to_owned(),
                frame: frame.clone(),
                place: Place::Link { link: id, model: body },
                moves: moving.contains(&link.name),
            });
        }
        let mut fixed = |is_wanted: bool, part: &str, pose: Pose| {
            if is_wanted {
                parts.push(Part {
                    parent_frame: frame.clone(),
                    frame: format!("{frame}::{part}"),
                    place: Place::Fixed(pose),
                    moves: false,
                });
            }
        };
        for visual in &link.visuals {
            fixed(wanted.visuals, &visual.name, visual.link_from_visual);
        }
        for collision in &link.collisions {
            fixed(wanted.collisions, &collision.name, collision.link_from_collision);
        }
        for sensor in &link.sensors {
            fixed(wanted.sensors, &sensor.name, sensor.parent_from_sensor);
        }
    }
    for inner in &model.models {
        let scope = format!("{scope}{}::", inner.name);
        let Some(inner_body) = Body::of(order.setting, inner, &scope) else { continue };
        let frame = format!("{name}::{}", inner.name);
        if wanted.nested {
            parts.push(Part {
                parent_frame: name.to_owned(),
                frame: frame.clone(),
                place: Place::Model { model: inner_body, around: Some(body) },
                moves: false,
            });
        }
        add(order, inner, &scope, &frame, inner_body, wanted, parts);
    }
}

/// The links on joints that move, but not the one that carries the model.
fn moving_links(model: &Model) -> BTreeSet<String> {
    let joints = model.joints.iter().filter(|joint| joint.kind != JointKind::Fixed);
    let ends = joints.flat_map(|joint| [&joint.parent, &joint.child]);
    let mut links: BTreeSet<String> = ends.filter_map(|end| carrying_link(model, end)).collect();
    if let Some((canonical, _)) = crate::drives::canonical(model) {
        links.remove(&canonical);
    }
    links
}

impl Place {
    /// The part in what it is a part of.
    fn pose(&self, world: &World) -> Option<Pose> {
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

impl Outlet {
    fn is_heard(&self) -> bool {
        match &self.out {
            Out::Each(publisher) => publisher.is_heard(),
            Out::All(publisher) => publisher.is_heard(),
        }
    }

    fn next_ns(&self) -> Option<i64> {
        self.tells.next_ns().filter(|_| self.is_heard())
    }

    fn tell<'p>(&mut self, parts: impl Iterator<Item = &'p Part>, moment: &Moment<'_>) {
        let now_ns = moment.time_ns();
        if !self.tells.due(now_ns) || !self.is_heard() {
            return;
        }
        let transforms = parts.filter_map(|part| {
            let pose = part.place.pose(moment.world)?;
            Some(transform(now_ns, &part.parent_frame, &part.frame, pose))
        });
        match &self.out {
            Out::Each(publisher) => transforms.for_each(|one| publisher.publish(one)),
            Out::All(publisher) => {
                publisher.publish(tf2_msgs::TFMessage { transforms: transforms.collect() });
            }
        }
    }
}

impl Device for GzPoses {
    fn name(&self) -> &str {
        &self.name
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        match &mut self.still {
            Some(still) => {
                still.tell(self.parts.iter().filter(|part| !part.moves), moment);
                self.moving.tell(self.parts.iter().filter(|part| part.moves), moment);
            }
            None => self.moving.tell(self.parts.iter(), moment),
        }
    }

    fn next_ns(&self) -> Option<i64> {
        earlier(self.moving.next_ns(), self.still.as_ref().and_then(Outlet::next_ns))
    }

    fn reset(&mut self, time_ns: i64) {
        self.moving.tells.restart(time_ns);
        if let Some(still) = &mut self.still {
            still.tells.restart(time_ns);
        }
    }
}
