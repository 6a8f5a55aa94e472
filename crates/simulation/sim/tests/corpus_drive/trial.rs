//! Test of one file: its robots are spawned and driven, and their messages checked.

use std::cell::Cell;
use std::path::Path;
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, RenderStyle, Severity, render};
use periplus_geometry::{DVec3, Pose};
use periplus_graph::{Node, NodeSettings, Publisher, Qos};
use periplus_loader::LoadContext;
use periplus_msgs::Message as _;
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::std_msgs::Float64MultiArray;
use periplus_msgs::trajectory_msgs::{JointTrajectory, JointTrajectoryPoint};
use periplus_plugin_specs::{Role, interpret, model_sites};
use periplus_scene::{Model, World};
use periplus_sim::{
    AssetFiles, Composition, ModelInstance, Options, PhysicsMode, RobotPlacement, Simulation,
    compose,
};

use crate::ears::Ears;

const SPEED_M_S: f64 = 0.3;
const TURN_RAD_S: f64 = 0.3;
/// Command of controllers of joints: a position, a speed or an effort.
const JOINT_COMMAND: f64 = 5.0;
/// Commands come as from a joystick \[ns\].
const COMMAND_NS: i64 = 100_000_000;

/// Distance and angle beyond which a robot has moved.
const MOVED_M: f64 = 0.2;
const MOVED_RAD: f64 = 0.2;
/// A robot that is lower than this at the end has fallen \[m\].
const FALLS_M: f64 = 0.1;
const LATE_NS: i64 = 500_000_000;

/// A robot with a drive, and its result.
#[derive(Clone, Debug)]
pub(crate) struct Trial {
    pub(crate) robot: String,
    pub(crate) drives: Vec<&'static str>,
    /// Topics of velocities in its world.
    pub(crate) commands: usize,
    pub(crate) sensors: usize,
    /// Messages of its world.
    pub(crate) messages: u64,
    pub(crate) moved_m: f64,
    pub(crate) turned_rad: f64,
    /// Problems; empty for a robot that drove.
    pub(crate) faults: Vec<String>,
}

impl Trial {
    /// A file without a result: it cannot be simulated.
    pub(crate) fn failed(name: &str, fault: String) -> Self {
        Self {
            robot: name.into(),
            drives: Vec::new(),
            commands: 0,
            sensors: 0,
            messages: 0,
            moved_m: 0.0,
            turned_rad: 0.0,
            faults: vec![fault],
        }
    }
}

/// All results of a file.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) trials: Vec<Trial>,
    /// Findings: code and message.
    pub(crate) findings: Vec<(Severity, &'static str, String)>,
}

/// Drives every robot of a file that can be driven. Nothing for a file without one.
pub(crate) fn drive(
    path: &Path,
    robots: &[RobotPlacement],
    name: &str,
    seconds: i64,
    mode: PhysicsMode,
    setting: &LoadContext<'_>,
) -> Report {
    let mut composition = compose(path, robots, setting);
    let has_drive = |member: &ModelInstance| !drives(&composition.world, &member.model).is_empty();
    if !composition.members.iter().any(has_drive) {
        return Report::default();
    }
    let files = Arc::new(AssetFiles::default());
    let options = Options { mode, ..Options::default() };
    let mut simulation = Simulation::new(&mut composition, files, options);
    let node = simulation.graph().node(NodeSettings::new("trial")).unwrap();
    let pedals = Pedals::of(&simulation, &node);
    let mut ears = Ears::open(&simulation, &node);
    let driven: Vec<(&ModelInstance, Vec<&'static str>)> = composition
        .members
        .iter()
        .map(|member| (member, drives(&composition.world, &member.model)))
        .filter(|(_, drives)| !drives.is_empty())
        .collect();
    let starts: Vec<Option<Pose>> =
        driven.iter().map(|(member, _)| pose_of(&simulation, &member.name)).collect();
    let parts: Vec<Vec<Pose>> =
        driven.iter().map(|(member, _)| links_of(&simulation, &member.name)).collect();
    let mut broken = None;
    let (end_ns, mut next_ns) = (seconds * 1_000_000_000, 0);
    let mut late = Vec::new();
    while simulation.time_ns() < end_ns && broken.is_none() {
        if simulation.time_ns() >= next_ns {
            pedals.press();
            next_ns += COMMAND_NS;
        }
        if late.is_empty() && simulation.time_ns() >= end_ns - LATE_NS {
            late.extend(driven.iter().map(|(member, _)| pose_of(&simulation, &member.name)));
        }
        broken = simulation.step().err().map(|diverged| diverged.to_string());
        simulation.graph().settle();
        ears.listen();
    }
    let (messages, wrong) = ears.close();
    let mut report = Report::default();
    for (index, (member, drives)) in driven.into_iter().enumerate() {
        let mut faults: Vec<String> = broken.iter().cloned().collect();
        faults.extend(wrong.iter().cloned());
        let end = pose_of(&simulation, &member.name);
        let late = late.get(index).copied().flatten();
        // A robot on the world moves its links.
        let parts_m = moved_parts_m(&parts[index], &links_of(&simulation, &member.name));
        let (moved_m, turned_rad) = match (starts[index], late.or(end), end) {
            (Some(start), Some(_), Some(end)) if start == end && parts_m > MOVED_M => {
                (parts_m, 0.0)
            }
            (Some(start), Some(late), Some(end)) => motion([start, late, end], &mut faults),
            _ => {
                faults.push("not in the world".into());
                (0.0, 0.0)
            }
        };
        if pedals.count() == 0 {
            faults.push("listens to no velocity".into());
        }
        report.trials.push(Trial {
            robot: format!("{name}::{} ({mode:?})", member.name),
            drives,
            commands: pedals.count(),
            sensors: sensors(&member.model),
            messages,
            moved_m,
            turned_rad,
            faults,
        });
    }
    report.findings = findings(&composition);
    report
}

/// Distance and rotation of the motion; unexpected motion is added to the faults.
fn motion([start, late, end]: [Pose; 3], faults: &mut Vec<String>) -> (f64, f64) {
    let way = end.translation - start.translation;
    let moved_m = way.truncate().length();
    let ahead = |pose: Pose| pose.rotation * DVec3::X;
    let (from, to) = (ahead(start), ahead(end));
    let turned_rad = (from.x * to.y - from.y * to.x).atan2(from.x * to.x + from.y * to.y);
    if !end.is_finite() {
        faults.push("its pose is not a number".into());
    } else if late.translation.z - end.translation.z > FALLS_M {
        faults.push(format!("falls, {:.2} m so far", -way.z));
    } else if (start.rotation * DVec3::Z).dot(end.rotation * DVec3::Z) < 0.7 {
        faults.push("tipped over".into());
    } else if moved_m < MOVED_M && turned_rad.abs() < MOVED_RAD {
        faults.push("stood".into());
    } else if moved_m > 5.0 {
        faults.push("flew off".into());
    }
    (moved_m, turned_rad)
}

fn pose_of(simulation: &Simulation, name: &str) -> Option<Pose> {
    let motion = simulation.motion();
    let (id, _) = motion.models().find(|(_, known)| *known == name)?;
    motion.model_pose(id)
}

/// Poses of the links of a model.
fn links_of(simulation: &Simulation, name: &str) -> Vec<Pose> {
    let motion = simulation.motion();
    let found = motion.models().find(|(_, known)| *known == name);
    let links = found.into_iter().flat_map(|(id, _)| motion.links(id));
    links.filter_map(|link| Some(motion.link_state(link)?.world_from_link)).collect()
}

/// Distance of the link that moved farthest [m].
fn moved_parts_m(before: &[Pose], after: &[Pose]) -> f64 {
    let ways = before.iter().zip(after);
    ways.map(|(before, after)| (after.translation - before.translation).length())
        .fold(0.0, f64::max)
}

/// The drives among the plugins of a model.
fn drives(world: &World, model: &Model) -> Vec<&'static str> {
    let sites = model_sites(world, model);
    let known = sites
        .iter()
        .filter_map(|site| interpret(site.plugin, &site.context, &mut Diagnostics::new()))
        .map(|plugin| plugin.known);
    known
        .filter(|known| known.role == Role::Drive || known.id.contains("ros2_control"))
        .map(|known| known.id)
        .collect()
}

fn sensors(model: &Model) -> usize {
    let own: usize = model.links.iter().map(|link| link.sensors.len()).sum();
    own + model.models.iter().map(sensors).sum::<usize>()
}

/// Findings by code, each as printed.
fn findings(composition: &Composition) -> Vec<(Severity, &'static str, String)> {
    let mut found = Vec::new();
    for file in &composition.files {
        for finding in file.diagnostics.iter() {
            let told = render(finding, &file.sources, RenderStyle::Plain);
            assert!(told.contains(&finding.message), "{told}");
            found.push((finding.severity, finding.code, finding.message.clone()));
        }
    }
    found
}

/// Publisher of commands to all topics with subscribers.
struct Pedals {
    plain: Vec<Publisher<Twist>>,
    stamped: Vec<Publisher<TwistStamped>>,
    joints: Vec<Publisher<Float64MultiArray>>,
    trajectories: Vec<Publisher<JointTrajectory>>,
    /// Names of the movable joints.
    names: Vec<String>,
    presses: Cell<u32>,
}

impl Pedals {
    fn of(simulation: &Simulation, node: &Node) -> Self {
        let motion = simulation.motion();
        let joints = motion.models().flat_map(|(id, _)| motion.joints(id));
        let names = joints
            .filter(|joint| motion.axis_state(*joint).is_some())
            .filter_map(|joint| motion.joint_name(joint).map(str::to_owned));
        let mut pedals = Self {
            plain: Vec::new(),
            stamped: Vec::new(),
            joints: Vec::new(),
            trajectories: Vec::new(),
            names: names.collect(),
            presses: Cell::new(0),
        };
        let topics = simulation.graph().topics();
        for topic in topics.iter().filter(|topic| !topic.subscriptions.is_empty()) {
            let (name, qos) = (&topic.name, Qos::reliable(10));
            if topic.type_name == Twist::TYPE_NAME {
                pedals.plain.push(node.publisher(name, qos).unwrap());
            } else if topic.type_name == TwistStamped::TYPE_NAME {
                pedals.stamped.push(node.publisher(name, qos).unwrap());
            } else if topic.type_name == Float64MultiArray::TYPE_NAME {
                pedals.joints.push(node.publisher(name, qos).unwrap());
            } else if topic.type_name == JointTrajectory::TYPE_NAME {
                pedals.trajectories.push(node.publisher(name, qos).unwrap());
            }
        }
        pedals
    }

    fn count(&self) -> usize {
        self.plain.len() + self.stamped.len() + self.joints.len() + self.trajectories.len()
    }

    fn press(&self) {
        let mut twist = Twist::default();
        twist.linear.x = SPEED_M_S;
        twist.angular.z = TURN_RAD_S;
        self.plain.iter().for_each(|pedal| pedal.publish(twist.clone()));
        let stamped = TwistStamped { twist, ..TwistStamped::default() };
        self.stamped.iter().for_each(|pedal| pedal.publish(stamped.clone()));
        // All of these robots have one joint with a command.
        let data = vec![JOINT_COMMAND];
        let command = Float64MultiArray { data, ..Float64MultiArray::default() };
        self.joints.iter().for_each(|pedal| pedal.publish(command.clone()));
        if self.presses.replace(self.presses.get() + 1) == 0 {
            let point = JointTrajectoryPoint {
                positions: vec![1.0],
                time_from_start: Duration { sec: 3, nanosec: 0 },
                ..JointTrajectoryPoint::default()
            };
            let joint_names = self.names.iter().take(1).cloned().collect();
            let points = vec![point];
            let way = JointTrajectory { joint_names, points, ..JointTrajectory::default() };
            self.trajectories.iter().for_each(|pedal| pedal.publish(way.clone()));
        }
    }
}
