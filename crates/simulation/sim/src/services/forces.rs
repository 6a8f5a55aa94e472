//! External forces: services of `gazebo_ros_force_system` and of ROS 1.

use periplus_geometry::DVec3;
use periplus_graph::{GraphError, Node};
use periplus_msgs::builtin_interfaces::{Duration, Time};
use periplus_msgs::gazebo_msgs::{
    ApplyBodyWrench, ApplyBodyWrenchResponse, ApplyJointEffort, ApplyJointEffortResponse,
    ApplyLinkWrench, ApplyLinkWrenchResponse, BodyRequest, BodyRequestResponse, JointRequest,
    JointRequestResponse, LinkRequest, LinkRequestResponse,
};
use periplus_msgs::geometry_msgs::{Point, Wrench};
use periplus_physics::limits::{MAX_FORCE_N, MAX_POSITION_M, is_within};
use periplus_physics::{JointCommand, JointId, LinkId, PhysicsMode};

use super::convert::vector;
use super::entity;
use super::service_aliases::ServiceAliases;
use crate::Simulation;

pub(super) struct Forces {
    body: ServiceAliases<ApplyBodyWrench>,
    link: ServiceAliases<ApplyLinkWrench>,
    joint: ServiceAliases<ApplyJointEffort>,
    clear_body: ServiceAliases<BodyRequest>,
    clear_link: ServiceAliases<LinkRequest>,
    clear_joint: ServiceAliases<JointRequest>,
    active: ActiveForces,
}

#[derive(Clone, Default)]
pub(super) struct ActiveForces {
    /// Active and scheduled forces.
    pushes: Vec<Push>,
    /// Time of the last step in which forces were applied \[ns\].
    pushed_ns: Option<i64>,
}

/// A force with a duration.
#[derive(Clone)]
struct Push {
    on: On,
    start_ns: i64,
    /// End time \[ns\].
    end_ns: i64,
}

#[derive(Clone, Copy)]
enum On {
    Link { link: LinkId, link_from_point_m: DVec3, force_n: DVec3, torque_n_m: DVec3 },
    Joint { joint: JointId, effort: f64 },
}

impl Forces {
    pub(super) fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            body: ServiceAliases::new(node, ["/gazebo/apply_body_wrench"])?,
            link: ServiceAliases::new(node, ["/apply_link_wrench", "/gazebo/apply_link_wrench"])?,
            joint: ServiceAliases::new(
                node,
                ["/apply_joint_effort", "/gazebo/apply_joint_effort"],
            )?,
            clear_body: ServiceAliases::new(node, ["/gazebo/clear_body_wrenches"])?,
            clear_link: ServiceAliases::new(
                node,
                ["/clear_link_wrenches", "/gazebo/clear_link_wrenches"],
            )?,
            clear_joint: ServiceAliases::new(
                node,
                ["/clear_joint_efforts", "/gazebo/clear_joint_forces"],
            )?,
            active: ActiveForces::default(),
        })
    }

    pub(super) fn serve(&mut self, simulation: &mut Simulation) {
        let pushes = &mut self.active.pushes;
        self.clear_body.answer(|asked| {
            clear_link(simulation, pushes, &asked.body_name);
            BodyRequestResponse::default()
        });
        self.clear_link.answer(|asked| {
            clear_link(simulation, pushes, &asked.link_name);
            LinkRequestResponse::default()
        });
        self.clear_joint.answer(|asked| {
            if let Some(joint) = find_joint(simulation, &asked.joint_name) {
                pushes
                    .retain(|push| !matches!(push.on, On::Joint { joint: on, .. } if on == joint));
                simulation.motion.command(joint, JointCommand::Free);
            }
            JointRequestResponse::default()
        });
        self.body.answer(|asked| {
            let (name, frame) = (&asked.body_name, &asked.reference_frame);
            let push = wrench(simulation, name, frame, &asked.reference_point, &asked.wrench);
            let (start, duration) = (&asked.start_time, &asked.duration);
            let (success, status_message) = accept(simulation, pushes, push, start, duration);
            ApplyBodyWrenchResponse { success, status_message }
        });
        self.link.answer(|asked| {
            let (name, frame) = (&asked.link_name, &asked.reference_frame);
            let push = wrench(simulation, name, frame, &asked.reference_point, &asked.wrench);
            let (start, duration) = (&asked.start_time, &asked.duration);
            let (success, status_message) = accept(simulation, pushes, push, start, duration);
            ApplyLinkWrenchResponse { success, status_message }
        });
        self.joint.answer(|asked| {
            let push = effort(simulation, &asked.joint_name, asked.effort);
            let (start, duration) = (&asked.start_time, &asked.duration);
            let (success, status_message) = accept(simulation, pushes, push, start, duration);
            ApplyJointEffortResponse { success, status_message }
        });
    }

    /// Applies active forces before a step, and drops expired ones. A second call before the same
    /// step does nothing, since forces accumulate.
    pub(super) fn push(&mut self, simulation: &mut Simulation) {
        let now_ns = simulation.time_ns();
        if self.active.pushed_ns.replace(now_ns) == Some(now_ns) {
            return;
        }
        self.active.pushes.retain(|push| {
            let is_over = now_ns >= push.end_ns;
            if now_ns < push.start_ns {
                return true;
            }
            match push.on {
                On::Joint { joint, .. } if is_over => {
                    simulation.motion.command(joint, JointCommand::Free);
                }
                On::Joint { joint, effort } => {
                    simulation.motion.command(joint, JointCommand::Effort(effort));
                }
                On::Link { .. } if is_over => {}
                On::Link { link, link_from_point_m, force_n, torque_n_m } => {
                    let state = simulation.motion.link_state(link);
                    let at_m =
                        state.map(|state| state.world_from_link.transform_point(link_from_point_m));
                    if let Some(at_m) = at_m {
                        simulation.motion.apply_force(link, at_m, force_n, torque_n_m);
                    }
                }
            }
            !is_over
        });
    }

    /// Removes all forces after a reset.
    pub(super) fn forget(&mut self) {
        self.active = ActiveForces::default();
    }

    pub(super) fn save(&self) -> ActiveForces {
        self.active.clone()
    }

    pub(super) fn restore(&mut self, saved: &ActiveForces) {
        self.active.clone_from(saved);
    }
}

fn clear_link(simulation: &Simulation, pushes: &mut Vec<Push>, name: &str) {
    if let Ok(link) = entity::find_link(simulation, name) {
        pushes.retain(|push| !matches!(push.on, On::Link { link: on, .. } if on == link));
    }
}

/// Finds the first joint of this name in any model; or `model::joint`.
fn find_joint(simulation: &Simulation, name: &str) -> Option<JointId> {
    let motion = simulation.motion();
    motion.models().find_map(|(model, own)| {
        let within = name.strip_prefix(own).and_then(|rest| rest.strip_prefix("::"));
        [Some(name), within].into_iter().flatten().find_map(|name| motion.find_joint(model, name))
    })
}

/// Computes a wrench at a point of a frame. In the world frame its point is the link's centre of
/// mass, as in Gazebo.
fn wrench(
    simulation: &Simulation,
    link: &str,
    frame: &str,
    point: &Point,
    wrench: &Wrench,
) -> Result<On, String> {
    if simulation.motion().mode() == PhysicsMode::Kinematic {
        return Err("this run has no physics (kinematic mode): forces have no effect".into());
    }
    let name = link;
    let link = entity::find_link(simulation, link)?;
    let world_from_frame = entity::frame(simulation, frame)?.pose;
    let (force, torque) = (vector(&wrench.force), vector(&wrench.torque));
    let point_m = DVec3::new(point.x, point.y, point.z);
    let sound = is_within(force, MAX_FORCE_N)
        && is_within(torque, MAX_FORCE_N)
        && is_within(point_m, MAX_POSITION_M);
    if !sound {
        return Err(format!(
            "the wrench or its point contains a value that is not finite, or beyond \
             {MAX_FORCE_N:e} N, {MAX_FORCE_N:e} N m or {MAX_POSITION_M:e} m"
        ));
    }
    let link_from_point_m = if entity::WORLD_FRAMES.contains(&frame) {
        simulation.centre_of_mass(name)
    } else {
        let state = simulation.motion().link_state(link);
        let world_from_link = state.map(|state| state.world_from_link).unwrap_or_default();
        let at_m = world_from_frame.transform_point(point_m);
        world_from_link.inverse().transform_point(at_m)
    };
    let turn = world_from_frame.rotation;
    Ok(On::Link { link, link_from_point_m, force_n: turn * force, torque_n_m: turn * torque })
}

fn effort(simulation: &Simulation, name: &str, effort: f64) -> Result<On, String> {
    if simulation.motion().mode() == PhysicsMode::Kinematic {
        return Err("this run has no physics (kinematic mode): efforts have no effect".into());
    }
    if effort.is_nan() || effort.abs() > MAX_FORCE_N {
        return Err(format!("`effort` is not finite, or beyond {MAX_FORCE_N:e}"));
    }
    let joint = find_joint(simulation, name);
    let joint = joint.ok_or_else(|| format!("there is no joint `{name}`"))?;
    Ok(On::Joint { joint, effort })
}

/// Adds a force. A duration of zero has no effect; one shorter than a step lasts a step.
fn accept(
    simulation: &Simulation,
    pushes: &mut Vec<Push>,
    push: Result<On, String>,
    start: &Time,
    duration: &Duration,
) -> (bool, String) {
    let on = match push {
        Ok(on) => on,
        Err(why) => return (false, why),
    };
    let start_ns = start.ns().max(simulation.time_ns());
    let end_ns = match duration.ns() {
        0 => return (true, "a duration of 0 has no effect; a negative one is unlimited".into()),
        below if below < 0 => i64::MAX,
        length_ns => start_ns.saturating_add(length_ns.max(simulation.step_ns())),
    };
    pushes.push(Push { on, start_ns, end_ns });
    (true, String::new())
}
