//! What programs of Gazebo ask, answered by what the services for ROS do.

use periplus_gz_msgs::{
    AsRos, Boolean, Entity, EntityFactory, EntityFactoryV, Light, Message, Pose, PoseV, StringMsg,
    StringMsgV, WorldControl,
};
use periplus_msgs::geometry_msgs;

use super::super::harmonic::{control, create, remove};
use super::super::reading::Search;
use super::super::stage::save;
use super::super::tempo::Tempo;
use super::super::{Log, convert, entity, light};
use super::{Does, scene};
use crate::Simulation;

/// The answer; none for what is no question.
pub(super) fn answer(
    does: Does,
    request: &[u8],
    simulation: &mut Simulation,
    search: &Search,
    tempo: &mut Tempo,
    log: &mut Log,
) -> Option<Vec<u8>> {
    let mut is_done = |call: &str, done: Result<(), String>| Boolean::from(log.note(call, done));
    let answer = match does {
        Does::Control => {
            control(simulation, tempo, &WorldControl::decode(request).ok()?.to_ros()?);
            Boolean::from(true)
        }
        Does::Create => {
            let asked = EntityFactory::decode(request).ok()?;
            is_done("create", bring(simulation, search, &asked))
        }
        Does::CreateMany => {
            let asked = EntityFactoryV::decode(request).ok()?;
            let mut each = asked.data.iter();
            is_done("create_multiple", each.try_for_each(|one| bring(simulation, search, one)))
        }
        Does::Remove => {
            let asked = Entity::decode(request).ok()?.to_ros()?;
            is_done("remove", remove(simulation, &asked))
        }
        Does::SetPose => {
            let asked = Pose::decode(request).ok()?;
            is_done("set_pose", put(simulation, &asked))
        }
        Does::SetPoses => {
            let asked = PoseV::decode(request).ok()?;
            let mut each = asked.pose.iter();
            is_done("set_pose_vector", each.try_for_each(|one| put(simulation, one)))
        }
        Does::SetLight => {
            let asked = Light::decode(request).ok()?.to_ros()?;
            is_done("light_config", light::configure(simulation, &asked))
        }
        Does::TellScene => return Some(scene::scene(simulation).encode()),
        Does::TellSdf => {
            return match save::text(simulation) {
                Ok(text) => Some(StringMsg::from(text).encode()),
                Err(why) => {
                    log.refused("generate_world_sdf", &why);
                    None
                }
            };
        }
        Does::TellWorlds => {
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
        return Err("a model or light as a message is not understood; give `sdf`".into());
    }
    if asked.spherical_coordinates.is_some() {
        return Err("a place on the Earth is not understood; give `pose`".into());
    }
    let asked = asked.to_ros().ok_or("the message is none")?;
    create(simulation, search, &asked).map(drop)
}

fn put(simulation: &mut Simulation, asked: &Pose) -> Result<(), String> {
    let message: geometry_msgs::Pose = asked.to_ros().ok_or("the message is none")?;
    let pose = convert::pose(&message).ok_or(convert::BAD_POSE)?;
    let name = match asked.name.as_str() {
        "" => scene::name_of(simulation, asked.id)
            .ok_or("name the model: none has the number that is given")?,
        name => name.to_owned(),
    };
    let found = entity::find(simulation, &name)?;
    simulation.place(found, pose);
    Ok(())
}
