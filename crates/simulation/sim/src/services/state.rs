//! Services and topics of poses: those of `gazebo_ros_state` and of ROS 1.

use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::gazebo_msgs::{
    EntityState, GetEntityState, GetEntityStateResponse, GetLinkState, GetLinkStateResponse,
    GetModelState, GetModelStateResponse, LinkState, ModelState, SetEntityState,
    SetEntityStateResponse, SetLinkState, SetLinkStateResponse, SetModelConfiguration,
    SetModelConfigurationResponse, SetModelState, SetModelStateResponse,
};
use periplus_msgs::geometry_msgs::{Pose, Twist};
use periplus_msgs::std_msgs::Header;
use periplus_physics::limits::{MAX_ANGULAR_SPEED_RAD_S, MAX_SPEED_M_S, is_within};

use super::RejectionLog;
use super::convert::{BAD_POSE, pose, pose_message, twist_message, vector};
use super::entity::{self, Entity, Motion};
use super::service_aliases::ServiceAliases;
use super::state_plugin::StatePlugin;
use crate::Simulation;

pub(super) struct State {
    get_entity: ServiceAliases<GetEntityState>,
    set_entity: ServiceAliases<SetEntityState>,
    get_model: ServiceAliases<GetModelState>,
    set_model: ServiceAliases<SetModelState>,
    get_link: ServiceAliases<GetLinkState>,
    set_link: ServiceAliases<SetLinkState>,
    joints: ServiceAliases<SetModelConfiguration>,
    models: Mailbox<ModelState>,
    links: Mailbox<LinkState>,
}

impl State {
    pub(super) fn new(node: &Node, plugins: &[StatePlugin]) -> Result<Self, GraphError> {
        let names = |name: &str| {
            let mut names = vec![format!("/{name}"), format!("/gazebo/{name}")];
            names.extend(plugins.iter().map(|plugin| plugin.resolve(name)));
            names
        };
        Ok(Self {
            get_entity: ServiceAliases::new(
                node,
                names("get_entity_state").iter().map(String::as_str),
            )?,
            set_entity: ServiceAliases::new(
                node,
                names("set_entity_state").iter().map(String::as_str),
            )?,
            get_model: ServiceAliases::new(node, ["/gazebo/get_model_state"])?,
            set_model: ServiceAliases::new(node, ["/gazebo/set_model_state"])?,
            get_link: ServiceAliases::new(node, ["/gazebo/get_link_state"])?,
            set_link: ServiceAliases::new(node, ["/gazebo/set_link_state"])?,
            joints: ServiceAliases::new(
                node,
                ["/set_joint_positions", "/gazebo/set_model_configuration"],
            )?,
            models: node.mailbox("/gazebo/set_model_state", Qos::reliable(10))?,
            links: node.mailbox("/gazebo/set_link_state", Qos::reliable(10))?,
        })
    }

    pub(super) fn serve(&self, simulation: &mut Simulation, log: &mut RejectionLog) {
        self.set(simulation, log);
        self.get(simulation, log);
    }

    fn set(&self, simulation: &mut Simulation, log: &mut RejectionLog) {
        self.set_entity.answer(|asked| {
            let done = set(simulation, &RequestedState::entity(&asked.state));
            SetEntityStateResponse { success: log.note("set_entity_state", done) }
        });
        self.set_model.answer(|asked| {
            let done = set(simulation, &RequestedState::model(&asked.model_state));
            let (success, status_message) = said(done, "SetModelState: set model state done");
            SetModelStateResponse { success, status_message }
        });
        self.set_link.answer(|asked| {
            let done = set(simulation, &RequestedState::link(&asked.link_state));
            let (success, status_message) = said(done, "SetLinkState: success");
            SetLinkStateResponse { success, status_message }
        });
        self.joints.answer(|_| SetModelConfigurationResponse {
            success: false,
            status_message:
                "joint positions cannot be set at once; command the joints, or spawn the \
                             model with other joint poses"
                    .into(),
        });
        for state in self.models.drain() {
            log.note("/gazebo/set_model_state", set(simulation, &RequestedState::model(&state)));
        }
        for state in self.links.drain() {
            log.note("/gazebo/set_link_state", set(simulation, &RequestedState::link(&state)));
        }
    }

    fn get(&self, simulation: &Simulation, log: &mut RejectionLog) {
        self.get_entity.answer(|asked| {
            let found = relative(simulation, &asked.name, &asked.reference_frame);
            let success = found.is_ok();
            if let Err(why) = &found {
                log.refused("get_entity_state", why);
            }
            let Motion { pose, linear_m_s, angular_rad_s } = found.unwrap_or_default();
            GetEntityStateResponse {
                header: Header::at(simulation.time_ns(), &asked.reference_frame),
                state: EntityState {
                    name: asked.name.clone(),
                    pose: pose_message(pose),
                    twist: twist_message(linear_m_s, angular_rad_s),
                    reference_frame: asked.reference_frame.clone(),
                },
                success,
            }
        });
        self.get_model.answer(|asked| {
            let frame = &asked.relative_entity_name;
            let found = relative(simulation, &asked.model_name, frame);
            let (success, status_message) = told(&found, "GetModelState: got properties");
            let Motion { pose, linear_m_s, angular_rad_s } = found.unwrap_or_default();
            GetModelStateResponse {
                header: Header::at(simulation.time_ns(), frame),
                pose: pose_message(pose),
                twist: twist_message(linear_m_s, angular_rad_s),
                success,
                status_message,
            }
        });
        self.get_link.answer(|asked| {
            let found = entity::find_link(simulation, &asked.link_name)
                .and_then(|_| relative(simulation, &asked.link_name, &asked.reference_frame));
            let (success, status_message) = told(&found, "GetLinkState: got state");
            let Motion { pose, linear_m_s, angular_rad_s } = found.unwrap_or_default();
            GetLinkStateResponse {
                link_state: LinkState {
                    link_name: asked.link_name.clone(),
                    pose: pose_message(pose),
                    twist: twist_message(linear_m_s, angular_rad_s),
                    reference_frame: asked.reference_frame.clone(),
                },
                success,
                status_message,
            }
        });
    }
}

/// Returns the state of an entity relative to a frame; velocities are differences in the frame's
/// axes, as in Gazebo.
fn relative(simulation: &Simulation, name: &str, frame: &str) -> Result<Motion, String> {
    let found = entity::find(simulation, name)?;
    let found = entity::motion_of(simulation.motion(), found)
        .ok_or_else(|| entity::unknown(simulation, name))?;
    let frame = entity::frame(simulation, frame)?;
    let frame_from_world = frame.pose.inverse();
    Ok(Motion {
        pose: frame_from_world * found.pose,
        linear_m_s: frame_from_world.rotation * (found.linear_m_s - frame.linear_m_s),
        angular_rad_s: frame_from_world.rotation * (found.angular_rad_s - frame.angular_rad_s),
    })
}

/// A requested state.
struct RequestedState<'a> {
    name: &'a str,
    pose: &'a Pose,
    twist: &'a Twist,
    frame: &'a str,
}

impl<'a> RequestedState<'a> {
    fn entity(state: &'a EntityState) -> Self {
        let EntityState { name, pose, twist, reference_frame: frame } = state;
        Self { name, pose, twist, frame }
    }

    fn model(state: &'a ModelState) -> Self {
        let ModelState { model_name: name, pose, twist, reference_frame: frame } = state;
        Self { name, pose, twist, frame }
    }

    fn link(state: &'a LinkState) -> Self {
        let LinkState { link_name: name, pose, twist, reference_frame: frame } = state;
        Self { name, pose, twist, frame }
    }
}

fn set(simulation: &mut Simulation, wanted: &RequestedState<'_>) -> Result<(), String> {
    let frame_from_entity = pose(wanted.pose).ok_or(BAD_POSE)?;
    let (linear, angular) = (vector(&wanted.twist.linear), vector(&wanted.twist.angular));
    if !(is_within(linear, MAX_SPEED_M_S) && is_within(angular, MAX_ANGULAR_SPEED_RAD_S)) {
        return Err(format!(
            "the twist contains a value that is not finite, or beyond {MAX_SPEED_M_S} m/s \
             or {MAX_ANGULAR_SPEED_RAD_S} rad/s"
        ));
    }
    let found = entity::find(simulation, wanted.name)?;
    let frame = entity::frame(simulation, wanted.frame)?;
    simulation.place(found, frame.pose * frame_from_entity);
    let at_rest = linear.length_squared() + angular.length_squared() == 0.0;
    match found {
        _ if at_rest => Ok(()),
        Entity::Model(model) => {
            let (linear, angular) = (frame.pose.rotation * linear, frame.pose.rotation * angular);
            simulation.motion.set_model_velocity(model, linear, angular);
            Ok(())
        }
        Entity::Link(_) => {
            Err("the link has its new pose, but is at rest: only whole models can be \
                                given a velocity"
                .into())
        }
    }
}

fn said(done: Result<(), String>, well: &str) -> (bool, String) {
    told(&done, well)
}

fn told<T>(found: &Result<T, String>, well: &str) -> (bool, String) {
    match found {
        Ok(_) => (true, well.to_owned()),
        Err(why) => (false, why.clone()),
    }
}
