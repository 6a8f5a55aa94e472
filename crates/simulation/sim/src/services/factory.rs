//! Spawning and deleting: services of `gazebo_ros_factory` and of ROS 1.

use periplus_geometry::Pose;
use periplus_graph::{GraphError, Node};
use periplus_msgs::gazebo_msgs::{
    DeleteEntity, DeleteEntityResponse, DeleteLight, DeleteLightResponse, DeleteModel,
    DeleteModelResponse, GetModelList, GetModelListResponse, GetWorldProperties,
    GetWorldPropertiesResponse, SpawnEntity, SpawnEntityResponse, SpawnModel, SpawnModelResponse,
};
use periplus_msgs::geometry_msgs;
use periplus_msgs::std_msgs::Header;

use super::convert::BAD_POSE;
use super::reading::{Search, Source};
use super::service_aliases::ServiceAliases;
use super::spawn::{SpawnPose, SpawnRequest, Spawned, delete, lights, spawn};
use super::{convert, entity};
use crate::Simulation;

pub(super) struct Factory {
    spawn: ServiceAliases<SpawnEntity>,
    spawn_model: ServiceAliases<SpawnModel>,
    delete: ServiceAliases<DeleteEntity>,
    delete_model: ServiceAliases<DeleteModel>,
    delete_light: ServiceAliases<DeleteLight>,
    list: ServiceAliases<GetModelList>,
    world: ServiceAliases<GetWorldProperties>,
}

impl Factory {
    pub(super) fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            spawn: ServiceAliases::new(node, ["/spawn_entity", "/gazebo/spawn_entity"])?,
            spawn_model: ServiceAliases::new(
                node,
                ["/gazebo/spawn_sdf_model", "/gazebo/spawn_urdf_model"],
            )?,
            delete: ServiceAliases::new(node, ["/delete_entity", "/gazebo/delete_entity"])?,
            delete_model: ServiceAliases::new(node, ["/gazebo/delete_model"])?,
            delete_light: ServiceAliases::new(node, ["/gazebo/delete_light"])?,
            list: ServiceAliases::new(node, ["/get_model_list", "/gazebo/get_model_list"])?,
            world: ServiceAliases::new(node, ["/gazebo/get_world_properties"])?,
        })
    }

    pub(super) fn serve(&self, simulation: &mut Simulation, search: &Search) {
        self.spawn.answer(|asked| {
            let spawned = Order {
                name: &asked.name,
                xml: &asked.xml,
                namespace: &asked.robot_namespace,
                pose: &asked.initial_pose,
                frame: &asked.reference_frame,
            };
            let (success, status_message) = said(spawned.fill(simulation, search));
            SpawnEntityResponse { success, status_message }
        });
        self.spawn_model.answer(|asked| {
            let spawned = Order {
                name: &asked.model_name,
                xml: &asked.model_xml,
                namespace: &asked.model_namespace,
                pose: &asked.initial_pose,
                frame: &asked.reference_frame,
            };
            let (success, status_message) = said(spawned.fill(simulation, search));
            SpawnModelResponse { success, status_message }
        });
        self.delete.answer(|asked| {
            let (success, status_message) = gone(delete(simulation, &asked.name), &asked.name);
            DeleteEntityResponse { success, status_message }
        });
        self.delete_model.answer(|asked| {
            let deleted = simulation.delete(&asked.model_name);
            let deleted = deleted.then_some(());
            let deleted = deleted.ok_or_else(|| entity::unknown(simulation, &asked.model_name));
            let (success, status_message) = gone(deleted, &asked.model_name);
            DeleteModelResponse { success, status_message }
        });
        self.delete_light.answer(|asked| {
            let name = &asked.light_name;
            let deleted = simulation.delete_light(name).then_some(());
            let deleted = deleted
                .ok_or_else(|| format!("there is no light `{name}` ({})", lights(simulation)));
            let (success, status_message) = gone(deleted, name);
            DeleteLightResponse { success, status_message }
        });
        self.list.answer(|_| GetModelListResponse {
            header: Header::at(simulation.time_ns(), ""),
            model_names: simulation.models().map(str::to_owned).collect(),
            success: true,
        });
        self.world.answer(|_| GetWorldPropertiesResponse {
            sim_time: seconds(simulation.time_ns()),
            model_names: simulation.models().map(str::to_owned).collect(),
            rendering_enabled: true,
            success: true,
            status_message: "GetWorldProperties: got properties".into(),
        });
    }
}

/// A spawn request.
struct Order<'a> {
    name: &'a str,
    xml: &'a str,
    namespace: &'a str,
    pose: &'a geometry_msgs::Pose,
    frame: &'a str,
}

impl Order<'_> {
    fn fill(&self, simulation: &mut Simulation, search: &Search) -> Result<Spawned, String> {
        let frame_from_here =
            convert::pose(self.pose).ok_or_else(|| format!("`initial_pose`: {BAD_POSE}"))?;
        let world_from_frame: Pose = entity::frame(simulation, self.frame)?.pose;
        let wish = SpawnRequest {
            source: Source::Text(self.xml, ""),
            name: self.name,
            may_rename: false,
            namespace: self.namespace,
            standing: SpawnPose::AsSeenFrom(world_from_frame * frame_from_here),
            with_frames: true,
        };
        spawn(simulation, search, &wish).map_err(|error| error.to_string())
    }
}

fn said(spawned: Result<Spawned, String>) -> (bool, String) {
    match spawned {
        Ok(Spawned { name, notes }) => {
            let message = format!("SpawnEntity: Successfully spawned entity [{name}]\n{notes}");
            (true, message.trim_end().to_owned())
        }
        Err(why) => (false, why.trim_end().to_owned()),
    }
}

fn gone(deleted: Result<(), String>, name: &str) -> (bool, String) {
    match deleted {
        Ok(()) => (true, format!("Successfully deleted entity [{name}]")),
        Err(why) => (false, why),
    }
}

#[expect(clippy::cast_precision_loss, reason = "a run lasts less than 2^53 ns")]
fn seconds(time_ns: i64) -> f64 {
    time_ns as f64 * 1e-9
}
