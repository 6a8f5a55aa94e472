//! Handlers of Gazebo requests, based on the services for ROS.

use periplus_gz_msgs::{
    AsRos, Boolean, Entity, EntityFactory, EntityFactoryV, Light, Message, Pose, PoseV, StringMsg,
    StringMsgV, WorldControl,
};
use periplus_msgs::geometry_msgs;

use super::super::gz_sim::{control, create, remove};
use super::super::pause_state::PauseState;
use super::super::reading::Search;
use super::super::viewer::save;
use super::super::{RejectionLog, convert, entity, light};
use super::{GazeboAction, scene};
use crate::Simulation;

/// Returns the response; `None` for an invalid request.
pub(super) fn answer(
    does: GazeboAction,
    request: &[u8],
    simulation: &mut Simulation,
    search: &Search,
    tempo: &mut PauseState,
    log: &mut RejectionLog,
) -> Option<Vec<u8>> {
    let mut is_done = |call: &str, done: Result<(), String>| Boolean::from(log.note(call, done));
    let answer = match does {
        GazeboAction::Control => {
            control(simulation, tempo, &WorldControl::decode(request).ok()?.to_ros()?);
            Boolean::from(true)
        }
        GazeboAction::Create => {
            let asked = EntityFactory::decode(request).ok()?;
            is_done("create", bring(simulation, search, &asked))
        }
        GazeboAction::CreateMany => {
            let asked = EntityFactoryV::decode(request).ok()?;
            let mut each = asked.data.iter();
            is_done("create_multiple", each.try_for_each(|one| bring(simulation, search, one)))
        }
        GazeboAction::Remove => {
            let asked = Entity::decode(request).ok()?.to_ros()?;
            is_done("remove", remove(simulation, &asked))
        }
        GazeboAction::SetPose => {
            let asked = Pose::decode(request).ok()?;
            is_done("set_pose", put(simulation, &asked))
        }
        GazeboAction::SetPoses => {
            let asked = PoseV::decode(request).ok()?;
            let mut each = asked.pose.iter();
            is_done("set_pose_vector", each.try_for_each(|one| put(simulation, one)))
        }
        GazeboAction::SetLight => {
            let asked = Light::decode(request).ok()?.to_ros()?;
            is_done("light_config", light::configure(simulation, &asked))
        }
        GazeboAction::TellScene => return Some(scene::scene(simulation).encode()),
        GazeboAction::TellSdf => {
            return match save::text(simulation) {
                Ok(text) => Some(StringMsg::from(text).encode()),
                Err(why) => {
                    log.refused("generate_world_sdf", &why);
                    None
                }
            };
        }
        GazeboAction::TellWorlds => {
            let data = vec![simulation.scene.name.clone()];
            return Some(StringMsgV { header: None, data }.encode());
        }
    };
    Some(answer.encode())
}

fn bring(
    simulation: &mut Simulation,
    search: &Search,
    asked: &EntityFactory,
) -> Result<(), String> {
    if asked.model.is_some() || asked.light.is_some() {
        return Err("models and lights as messages are not supported; use `sdf`".into());
    }
    if asked.spherical_coordinates.is_some() {
        return Err("spherical coordinates are not supported; use `pose`".into());
    }
    let asked = asked.to_ros().ok_or("the message is invalid")?;
    create(simulation, search, &asked).map(drop)
}

fn put(simulation: &mut Simulation, asked: &Pose) -> Result<(), String> {
    let message: geometry_msgs::Pose = asked.to_ros().ok_or("the message is invalid")?;
    let pose = convert::pose(&message).ok_or(convert::BAD_POSE)?;
    let name = match asked.name.as_str() {
        "" => scene::name_of(simulation, asked.id)
            .ok_or("set the name of the model: no model has this id")?,
        name => name.to_owned(),
    };
    let found = entity::find(simulation, &name)?;
    simulation.place(found, pose);
    Ok(())
}
