//! Services of models, joints, links and lights: those of `gazebo_ros_properties` and of ROS 1.

use periplus_graph::{GraphError, Node};
use periplus_msgs::gazebo_msgs::{
    GetJointProperties, GetJointPropertiesResponse, GetLightProperties, GetLightPropertiesResponse,
    GetLinkProperties, GetLinkPropertiesResponse, GetModelProperties, GetModelPropertiesResponse,
    SetJointProperties, SetJointPropertiesRequest, SetJointPropertiesResponse, SetLightProperties,
    SetLightPropertiesRequest, SetLightPropertiesResponse, SetLinkProperties,
    SetLinkPropertiesResponse,
};
use periplus_scene::{Joint, JointKind, Link, Model};

use super::convert::{colour, colour_message, pose_message};
use super::service_aliases::ServiceAliases;
use super::state_plugin::StatePlugin;
use super::{entity, light};
use crate::Simulation;

pub(super) struct Properties {
    model: ServiceAliases<GetModelProperties>,
    get_joint: ServiceAliases<GetJointProperties>,
    set_joint: ServiceAliases<SetJointProperties>,
    get_link: ServiceAliases<GetLinkProperties>,
    set_link: ServiceAliases<SetLinkProperties>,
    get_light: ServiceAliases<GetLightProperties>,
    set_light: ServiceAliases<SetLightProperties>,
}

/// Returns the names of a service of `gazebo_ros_properties`.
pub(super) fn names(plugins: &[StatePlugin], name: &str) -> Vec<String> {
    let own = plugins.iter().map(|plugin| plugin.resolve(name));
    [format!("/{name}"), format!("/gazebo/{name}")].into_iter().chain(own).collect()
}

impl Properties {
    pub(super) fn new(node: &Node, plugins: &[StatePlugin]) -> Result<Self, GraphError> {
        let names = |name| names(plugins, name);
        Ok(Self {
            model: ServiceAliases::new(
                node,
                names("get_model_properties").iter().map(String::as_str),
            )?,
            get_joint: ServiceAliases::new(
                node,
                names("get_joint_properties").iter().map(String::as_str),
            )?,
            set_joint: ServiceAliases::new(
                node,
                names("set_joint_properties").iter().map(String::as_str),
            )?,
            get_link: ServiceAliases::new(
                node,
                names("get_link_properties").iter().map(String::as_str),
            )?,
            set_link: ServiceAliases::new(
                node,
                names("set_link_properties").iter().map(String::as_str),
            )?,
            get_light: ServiceAliases::new(
                node,
                names("get_light_properties").iter().map(String::as_str),
            )?,
            set_light: ServiceAliases::new(
                node,
                names("set_light_properties").iter().map(String::as_str),
            )?,
        })
    }

    pub(super) fn serve(&self, simulation: &mut Simulation) {
        self.model.answer(|asked| match simulation.place_of(&asked.model_name) {
            Some(place) => describe(&simulation.running[place].member.model),
            None => GetModelPropertiesResponse {
                status_message: entity::unknown(simulation, &asked.model_name),
                ..Default::default()
            },
        });
        self.get_joint.answer(|asked| {
            get_joint(simulation, &asked.joint_name).unwrap_or_else(|status_message| {
                GetJointPropertiesResponse { status_message, ..Default::default() }
            })
        });
        self.set_joint.answer(|asked| {
            let done = set_joint(simulation, asked);
            let success = done.is_ok();
            let well = || "SetJointProperties: nothing to set".to_owned();
            let status_message = done.map_or_else(|why| why, |()| well());
            SetJointPropertiesResponse { success, status_message }
        });
        self.get_link.answer(|asked| {
            get_link(simulation, &asked.link_name).unwrap_or_else(|status_message| {
                GetLinkPropertiesResponse { status_message, ..Default::default() }
            })
        });
        self.set_link.answer(|asked| {
            let known = find_link(simulation, &asked.link_name).map(|_| ());
            let status_message = known.err().unwrap_or_else(|| {
                "masses cannot be changed in a running world; delete the model and spawn it with \
                 the new ones"
                    .into()
            });
            SetLinkPropertiesResponse { success: false, status_message }
        });
        self.get_light.answer(|asked| match light::light(simulation, &asked.light_name) {
            Ok(light) => GetLightPropertiesResponse {
                diffuse: colour_message(light.diffuse),
                attenuation_constant: light.attenuation.constant,
                attenuation_linear: light.attenuation.linear,
                attenuation_quadratic: light.attenuation.quadratic,
                success: true,
                status_message: String::new(),
            },
            Err(status_message) => {
                GetLightPropertiesResponse { status_message, ..Default::default() }
            }
        });
        self.set_light.answer(|asked| {
            let done = set_light(simulation, asked);
            let success = done.is_ok();
            let status_message = done.err().unwrap_or_default();
            SetLightPropertiesResponse { success, status_message }
        });
    }
}

fn describe(model: &Model) -> GetModelPropertiesResponse {
    let scoped = |link: &Link| format!("{}::{}", model.name, link.name);
    let canonical = model.canonical_link.clone();
    let canonical = canonical.or_else(|| model.links.first().map(|link| link.name.clone()));
    let collisions = model.links.iter().flat_map(|link| &link.collisions);
    GetModelPropertiesResponse {
        parent_model_name: String::new(),
        canonical_body_name: canonical
            .map(|link| format!("{}::{link}", model.name))
            .unwrap_or_default(),
        body_names: model.links.iter().map(scoped).collect(),
        geom_names: collisions.map(|collision| collision.name.clone()).collect(),
        joint_names: model.joints.iter().map(|joint| joint.name.clone()).collect(),
        child_model_names: model.models.iter().map(|inner| inner.name.clone()).collect(),
        is_static: model.is_static,
        success: true,
        status_message: "GetModelProperties: got properties".into(),
    }
}

/// Finds a joint by its name within its model, or by `model::joint`; as in Gazebo, the first match
/// of all models.
fn find_joint<'a>(simulation: &'a Simulation, name: &str) -> Option<(usize, String, &'a Joint)> {
    simulation.running.iter().enumerate().find_map(|(place, running)| {
        let model = &running.member.model;
        let within = name.strip_prefix(&model.name).and_then(|rest| rest.strip_prefix("::"));
        [Some(name), within].into_iter().flatten().find_map(|name| {
            let (inner, short) = innermost(model, name);
            Some((place, name.to_owned(), inner.joint(short)?))
        })
    })
}

/// Returns the nested model of a scoped name, and the rest of the name.
fn innermost<'a, 'n>(mut model: &'a Model, mut name: &'n str) -> (&'a Model, &'n str) {
    while let Some((head, rest)) = name.split_once("::") {
        let Some(inner) = model.models.iter().find(|inner| inner.name == head) else { break };
        (model, name) = (inner, rest);
    }
    (model, name)
}

fn no_joint(simulation: &Simulation, name: &str) -> String {
    let joints = simulation.running.iter().flat_map(|running| {
        let model = &running.member.model;
        model.joints.iter().map(move |joint| format!("{}::{}", model.name, joint.name))
    });
    let joints: Vec<String> = joints.collect();
    format!("there is no joint `{name}` (joints: {})", entity::listed(&joints))
}

fn get_joint(simulation: &Simulation, name: &str) -> Result<GetJointPropertiesResponse, String> {
    let (place, scoped, joint) =
        find_joint(simulation, name).ok_or_else(|| no_joint(simulation, name))?;
    let motion = simulation.motion();
    let id = motion.find_joint(simulation.running[place].model, &scoped);
    let axes = id.map(|id| motion.joint_state(id)).unwrap_or_default();
    let damping = [&joint.axis, &joint.axis2].into_iter().flatten().map(|axis| axis.damping);
    type Response = GetJointPropertiesResponse;
    Ok(Response {
        r#type: match joint.kind {
            JointKind::Revolute | JointKind::Screw | JointKind::Gearbox => Response::REVOLUTE,
            JointKind::Continuous => Response::CONTINUOUS,
            JointKind::Prismatic => Response::PRISMATIC,
            JointKind::Fixed => Response::FIXED,
            JointKind::Ball | JointKind::Floating | JointKind::Planar => Response::BALL,
            JointKind::Universal | JointKind::Revolute2 => Response::UNIVERSAL,
        },
        damping: damping.take(axes.len()).collect(),
        position: axes.iter().map(|axis| axis.position).collect(),
        rate: axes.iter().map(|axis| axis.velocity).collect(),
        success: true,
        status_message: "GetJointProperties: got properties".into(),
    })
}

fn set_joint(simulation: &Simulation, asked: &SetJointPropertiesRequest) -> Result<(), String> {
    let name = &asked.joint_name;
    find_joint(simulation, name).ok_or_else(|| no_joint(simulation, name))?;
    let new = &asked.ode_joint_config;
    let asked_for = [
        ("damping", &new.damping),
        ("hi_stop", &new.hi_stop),
        ("lo_stop", &new.lo_stop),
        ("erp", &new.erp),
        ("cfm", &new.cfm),
        ("stop_erp", &new.stop_erp),
        ("stop_cfm", &new.stop_cfm),
        ("fudge_factor", &new.fudge_factor),
        ("fmax", &new.fmax),
        ("vel", &new.vel),
    ];
    let asked_for: Vec<&str> =
        asked_for.iter().filter(|(_, values)| !values.is_empty()).map(|(name, _)| *name).collect();
    if asked_for.is_empty() {
        return Ok(());
    }
    Err(format!(
        "{} of a joint cannot be changed in a running world; delete the model and spawn it with \
         other joints",
        asked_for.join(", ")
    ))
}

fn find_link<'a>(simulation: &'a Simulation, name: &str) -> Result<&'a Link, String> {
    entity::find_link(simulation, name)?;
    let (model, link) = name.split_once("::").unwrap_or(("", name));
    let place = simulation.place_of(model);
    let link = place.and_then(|place| {
        let (inner, short) = innermost(&simulation.running[place].member.model, link);
        inner.link(short)
    });
    link.ok_or_else(|| entity::unknown(simulation, name))
}

fn get_link(simulation: &Simulation, name: &str) -> Result<GetLinkPropertiesResponse, String> {
    let link = find_link(simulation, name)?;
    let [ixx, ixy, ixz, iyy, iyz, izz] = link.inertial.inertia_kg_m2;
    Ok(GetLinkPropertiesResponse {
        com: pose_message(link.inertial.link_from_inertial),
        gravity_mode: link.gravity,
        mass: link.inertial.mass_kg,
        ixx,
        ixy,
        ixz,
        iyy,
        iyz,
        izz,
        success: true,
        status_message: "GetLinkProperties: got properties".into(),
    })
}

fn set_light(simulation: &mut Simulation, asked: &SetLightPropertiesRequest) -> Result<(), String> {
    let [constant, linear, quadratic] = light::attenuation(
        asked.attenuation_constant,
        asked.attenuation_linear,
        asked.attenuation_quadratic,
    )?;
    let light = light::light(simulation, &asked.light_name)?;
    light.diffuse = colour(&asked.diffuse);
    light.attenuation.constant = constant;
    light.attenuation.linear = linear;
    light.attenuation.quadratic = quadratic;
    simulation.show_light(&asked.light_name);
    Ok(())
}
