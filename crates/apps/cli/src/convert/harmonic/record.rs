//! Simulation of one of the two descriptions, with all messages.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use periplus_geometry::Pose;
use periplus_graph::{NodeSettings, Qos, RawMailbox, Sample, Sink, TopicInfo};
use periplus_loader::LoadContext;
use periplus_os::Overlay;
use periplus_resources::Resolver;
use periplus_scene::{Material, Model, builtin_material};
use periplus_sim::{
    AssetFiles, Composition, Options, PhysicsMode, RobotPlacement, Simulation, compose,
};
use periplus_xml::Element;

use super::drive::{COMMAND_PERIOD_NS, CommandPublishers, DURATION_S};
use crate::terminal::{processors, working_folder};

/// Types whose messages are slow to compute: the first ones are enough.
const HEAVY_TYPES: [&str; 2] = ["sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2"];

/// Number of such messages on each topic.
const MAX_HEAVY_MESSAGES: usize = 3;

/// Topics that are not compared: the log, those of the simulator itself, and the text of the robot, which is new.
const OMITTED_TOPICS: [&str; 4] = ["/clock", "/rosout", "/parameter_events", "/robot_description"];

/// Duration of a world without drives \[s\]: sensors and settling models.
const UNDRIVEN_DURATION_S: i64 = 3;

/// A topic of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct TopicLog {
    pub(super) type_name: String,
    pub(super) samples: Vec<Sample>,
}

/// Result of a run.
#[derive(Debug, Default)]
pub(super) struct RunLog {
    pub(super) topics: BTreeMap<String, TopicLog>,
    /// Poses of all links before the first step, by scoped name.
    pub(super) link_poses: BTreeMap<String, Pose>,
    /// Topics of velocity commands.
    pub(super) command_topics: Vec<String>,
    /// Simulated time \[s\].
    pub(super) duration_s: i64,
    /// Reason why the run ended early.
    pub(super) failure: Option<String>,
    /// Differences between the two simulators that a controlled run has removed.
    pub(super) equalized: Vec<&'static str>,
}

/// Kind of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RunKind {
    /// The description as it is.
    Usual,
    /// Without the known differences of the two simulators.
    Controlled,
    /// As [`RunKind::Controlled`], with motion exactly as commanded instead of contacts.
    Kinematic,
}

/// Description and options of a run.
pub(super) struct RunSetup<'a> {
    pub(super) file: &'a Path,
    pub(super) arguments: &'a [(String, String)],
    pub(super) folders: &'a [PathBuf],
    /// True if the file is a robot, which is put into a room.
    pub(super) is_robot: bool,
    /// True to send commands to the drives.
    pub(super) is_driven: bool,
    /// Kind of the run.
    pub(super) kind: RunKind,
}

type Topics = Arc<Mutex<BTreeMap<String, TopicLog>>>;

struct Recorder(Topics);

impl Sink for Recorder {
    fn wants(&self, topic: &TopicInfo) -> bool {
        is_compared(topic) && !HEAVY_TYPES.contains(&topic.type_name.as_str())
    }

    fn take(&self, topic: &TopicInfo, sample: &Sample) {
        let mut topics = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let log = topics.entry(topic.name.clone()).or_default();
        log.type_name.clone_from(&topic.type_name);
        log.samples.push(sample.clone());
    }
}

fn is_compared(topic: &TopicInfo) -> bool {
    !topic.publishers.is_empty()
        && !OMITTED_TOPICS.contains(&topic.name.as_str())
        && !topic.name.starts_with("/gazebo/")
        && topic.publishers.iter().any(|publisher| publisher.node != DRIVER_NODE)
}

/// Node that publishes the commands.
const DRIVER_NODE: &str = "/comparison";

/// Room around the origin for robots without a world: walls and columns for their sensors.
const ROOM: &str = include_str!("room.sdf");

/// Simulates a description.
pub(super) fn record(setup: &RunSetup<'_>, overlay: Overlay) -> RunLog {
    let room = working_folder().join("periplus-comparison-room.sdf");
    let host = overlay.with_text(room.clone(), ROOM.to_owned());
    let resolver = Resolver::new(&host, setup.folders);
    let context = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: working_folder(),
        arguments: if setup.is_robot { Vec::new() } else { setup.arguments.to_vec() },
        open_meshes: true,
    };
    let mut composition = if setup.is_robot {
        let robot = RobotPlacement {
            file: setup.file.to_owned(),
            arguments: setup.arguments.to_vec(),
            ..RobotPlacement::default()
        };
        compose(&room, &[robot], &context)
    } else {
        compose(setup.file, &[], &context)
    };
    let mut log = RunLog::default();
    if setup.kind != RunKind::Usual {
        for member in &mut composition.members {
            equalize(&mut member.model, &mut log.equalized);
        }
        log.equalized.sort_unstable();
        log.equalized.dedup();
    }
    if setup.kind == RunKind::Kinematic {
        log.equalized.push(CONTACTS);
    }
    drive(&mut composition, setup, &mut log);
    log
}

fn drive(composition: &mut Composition, setup: &RunSetup<'_>, log: &mut RunLog) {
    let files = Arc::new(AssetFiles::default());
    let mode = match setup.kind {
        RunKind::Kinematic => PhysicsMode::Kinematic,
        RunKind::Usual | RunKind::Controlled => PhysicsMode::Rigid,
    };
    let options = Options { threads: processors(), mode, ..Options::default() };
    let mut simulation = Simulation::new(composition, files, options);
    let motion = simulation.motion();
    for (model, name) in motion.models() {
        for link in motion.links(model) {
            if let (Some(link_name), Some(state)) =
                (motion.link_name(link), motion.link_state(link))
            {
                log.link_poses.insert(format!("{name}::{link_name}"), state.world_from_link);
            }
        }
    }
    let Ok(node) = simulation.graph().node(NodeSettings::new("comparison")) else { return };
    let publishers = CommandPublishers::of(&simulation, &node);
    log.command_topics = publishers.topics();
    let topics = Topics::default();
    let mut heavy: Vec<(String, RawMailbox)> = Vec::new();
    let infos = simulation.graph().topics();
    let compared: Vec<&TopicInfo> = infos.iter().filter(|topic| is_compared(topic)).collect();
    for topic in &compared {
        if HEAVY_TYPES.contains(&topic.type_name.as_str())
            && let Ok(mailbox) =
                node.raw_mailbox(&topic.name, &topic.type_name, None, Qos::best_effort(8))
        {
            heavy.push((topic.type_name.clone(), mailbox));
        }
    }
    simulation.graph().tap(Box::new(Recorder(Arc::clone(&topics))));
    log.duration_s = if log.command_topics.is_empty() { UNDRIVEN_DURATION_S } else { DURATION_S };
    let end_ns = log.duration_s * 1_000_000_000;
    let mut command_ns = 0;
    while simulation.time_ns() < end_ns {
        if simulation.time_ns() >= command_ns {
            if setup.is_driven {
                publishers.publish(command_ns);
            }
            command_ns += COMMAND_PERIOD_NS;
        }
        if let Err(diverged) = simulation.step_until(command_ns.min(end_ns)) {
            log.failure = Some(diverged.to_string());
            break;
        }
        simulation.graph().settle();
        heavy.retain(|(type_name, mailbox)| keep(&topics, type_name, mailbox));
    }
    if let Some(diverged) = simulation.diverged().first() {
        log.failure = Some(diverged.to_string());
    }
    let topics = topics.lock().unwrap_or_else(PoisonError::into_inner);
    log.topics.clone_from(&topics);
}

/// Keeps messages of a slow topic; false if there are enough.
fn keep(topics: &Topics, type_name: &str, mailbox: &RawMailbox) -> bool {
    let mut topics = topics.lock().unwrap_or_else(PoisonError::into_inner);
    let log = topics.entry(mailbox.topic().to_owned()).or_default();
    type_name.clone_into(&mut log.type_name);
    log.samples.extend(mailbox.drain());
    log.samples.len() < MAX_HEAVY_MESSAGES
}

/// Parameters of drives that only one of the two simulators has; the value that switches each off, or `None` to leave it out.
const LIMITS: [(&str, Option<&str>, &str); 9] = [
    ("max_wheel_acceleration", None, ACCELERATION),
    ("wheelAcceleration", None, ACCELERATION),
    ("min_linear_acceleration", None, ACCELERATION),
    ("max_linear_acceleration", None, ACCELERATION),
    ("min_angular_acceleration", None, ACCELERATION),
    ("max_angular_acceleration", None, ACCELERATION),
    ("max_wheel_torque", Some(UNLIMITED_TORQUE), TORQUE),
    ("wheelTorque", Some(UNLIMITED_TORQUE), TORQUE),
    ("torque", Some(UNLIMITED_TORQUE), TORQUE),
];

/// Torque of a wheel that no robot reaches \[N m\].
const UNLIMITED_TORQUE: &str = "1e6";

const ACCELERATION: &str =
    "limits of acceleration (of wheels in the old drive, of the robot in DiffDrive)";
const TORQUE: &str = "the maximum torque of wheels (DiffDrive has none)";
const CONTACTS: &str = "contacts of wheels with the floor (motion exactly as commanded)";
const COLOURS: &str = "colours of visuals that have a color of URDF and a material of Gazebo (Gazebo Classic shows the first, the new file the second)";
const GEOMETRY: &str =
    "the geometry that lidars measure (collisions in the old file, visuals in the new one)";

/// Drives whose limits are removed, with the parameter of the maximum torque.
const DRIVES: [&str; 3] =
    ["gazebo_ros_diff_drive", "gazebo_ros_skid_steer_drive", "gz-sim-diff-drive-system"];

/// Removes the known differences of the simulators from a model.
fn equalize(model: &mut Model, equalized: &mut Vec<&'static str>) {
    for plugin in &mut model.plugins {
        let library = periplus_plugin_specs::library_id(&plugin.filename);
        if !DRIVES.contains(&library.as_str()) {
            continue;
        }
        plugin.content.retain_mut(|element| {
            let limit = LIMITS.iter().find(|(name, ..)| element.name == *name);
            let Some((name, value, reason)) = limit else { return true };
            equalized.push(reason);
            let Some(value) = value else { return false };
            *element = Element::new(*name).with_text(*value);
            true
        });
        // Without the parameter the old drives have 5 N m.
        let has = |name: &str| plugin.content.iter().any(|element| element.name == name);
        let torque = match library.as_str() {
            "gazebo_ros_skid_steer_drive" => Some("torque"),
            "gazebo_ros_diff_drive" if has("left_joint") => Some("max_wheel_torque"),
            "gazebo_ros_diff_drive" => Some("wheelTorque"),
            _ => None,
        };
        if let Some(torque) = torque.filter(|name| !has(name)) {
            plugin.content.push(Element::new(torque).with_text(UNLIMITED_TORQUE));
            equalized.push(TORQUE);
        }
    }
    for link in &mut model.links {
        for material in link.visuals.iter_mut().filter_map(|visual| visual.material.as_mut()) {
            let script = material.script.as_ref().and_then(|script| builtin_material(&script.name));
            let Some(script) = script else { continue };
            let colours = |material: &Material| {
                (material.ambient, material.diffuse, material.specular, material.emissive)
            };
            if material.ambient.is_some() && colours(material) != colours(&script) {
                *material = script;
                equalized.push(COLOURS);
            }
        }
        for sensor in &mut link.sensors {
            if sensor.type_name == "ray" {
                sensor.type_name = "gpu_ray".to_owned();
                equalized.push(GEOMETRY);
            }
        }
    }
    for nested in &mut model.models {
        equalize(nested, equalized);
    }
}
