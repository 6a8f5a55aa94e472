//! Control and state of a world.

use periplus_msgs::ros_gz_interfaces as ros;
use periplus_msgs::std_msgs;

use super::{AsRos, from_all, part, to_all};
use crate::{
    Color, Contact, Contacts, Entity, EntityFactory, EntityKind, EntityWrench, GuiCamera, Header,
    JointWrench, Light, LightKind, Pose, Time, TrackVisual, Vector3d, VideoRecord, WorldControl,
    WorldReset, WorldStatistics, Wrench,
};

impl AsRos<ros::Entity> for Entity {
    fn to_ros(&self) -> Option<ros::Entity> {
        // An entity type without a number in ROS becomes none.
        let kind = u8::try_from(self.r#type.0).unwrap_or_default();
        Some(ros::Entity { id: self.id, name: self.name.clone(), r#type: kind })
    }

    fn from_ros(ros: &ros::Entity) -> Option<Self> {
        let (id, name) = (ros.id, ros.name.clone());
        Some(Self { header: None, id, name, r#type: EntityKind(ros.r#type.into()) })
    }
}

impl AsRos<ros::JointWrench> for JointWrench {
    fn to_ros(&self) -> Option<ros::JointWrench> {
        let name = |name: &str| std_msgs::String { data: name.to_owned() };
        Some(ros::JointWrench {
            header: part(self.header.as_ref()),
            body_1_name: name(&self.body_1_name),
            body_1_id: std_msgs::UInt32 { data: self.body_1_id },
            body_2_name: name(&self.body_2_name),
            body_2_id: std_msgs::UInt32 { data: self.body_2_id },
            body_1_wrench: part(self.body_1_wrench.as_ref()),
            body_2_wrench: part(self.body_2_wrench.as_ref()),
        })
    }

    fn from_ros(ros: &ros::JointWrench) -> Option<Self> {
        let wrench = |ros: &periplus_msgs::geometry_msgs::Wrench| Wrench::from_ros(ros);
        Some(Self {
            header: Header::from_ros(&ros.header),
            body_1_name: ros.body_1_name.data.clone(),
            body_1_id: ros.body_1_id.data,
            body_2_name: ros.body_2_name.data.clone(),
            body_2_id: ros.body_2_id.data,
            body_1_wrench: wrench(&ros.body_1_wrench),
            body_2_wrench: wrench(&ros.body_2_wrench),
        })
    }
}

impl AsRos<ros::Contact> for Contact {
    fn to_ros(&self) -> Option<ros::Contact> {
        Some(ros::Contact {
            collision1: part(self.collision1.as_ref()),
            collision2: part(self.collision2.as_ref()),
            positions: to_all(&self.position),
            normals: to_all(&self.normal),
            depths: self.depth.clone(),
            wrenches: to_all(&self.wrench),
        })
    }

    fn from_ros(ros: &ros::Contact) -> Option<Self> {
        Some(Self {
            collision1: Entity::from_ros(&ros.collision1),
            collision2: Entity::from_ros(&ros.collision2),
            position: from_all(&ros.positions),
            normal: from_all(&ros.normals),
            depth: ros.depths.clone(),
            wrench: from_all(&ros.wrenches),
            ..Self::default()
        })
    }
}

impl AsRos<ros::Contacts> for Contacts {
    fn to_ros(&self) -> Option<ros::Contacts> {
        Some(ros::Contacts { header: part(self.header.as_ref()), contacts: to_all(&self.contact) })
    }

    fn from_ros(ros: &ros::Contacts) -> Option<Self> {
        Some(Self { header: Header::from_ros(&ros.header), contact: from_all(&ros.contacts) })
    }
}

impl AsRos<ros::EntityWrench> for EntityWrench {
    fn to_ros(&self) -> Option<ros::EntityWrench> {
        Some(ros::EntityWrench {
            header: part(self.header.as_ref()),
            entity: part(self.entity.as_ref()),
            wrench: part(self.wrench.as_ref()),
        })
    }

    fn from_ros(ros: &ros::EntityWrench) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            entity: Entity::from_ros(&ros.entity),
            wrench: AsRos::from_ros(&ros.wrench),
        })
    }
}

impl AsRos<ros::Light> for Light {
    fn to_ros(&self) -> Option<ros::Light> {
        Some(ros::Light {
            header: part(self.header.as_ref()),
            name: self.name.clone(),
            r#type: u8::try_from(self.r#type.0).ok()?,
            pose: part(self.pose.as_ref()),
            diffuse: part(self.diffuse.as_ref()),
            specular: part(self.specular.as_ref()),
            attenuation_constant: self.attenuation_constant,
            attenuation_linear: self.attenuation_linear,
            attenuation_quadratic: self.attenuation_quadratic,
            direction: part(self.direction.as_ref()),
            range: self.range,
            cast_shadows: self.cast_shadows,
            spot_inner_angle: self.spot_inner_angle,
            spot_outer_angle: self.spot_outer_angle,
            spot_falloff: self.spot_falloff,
            id: self.id,
            parent_id: self.parent_id,
            intensity: self.intensity,
        })
    }

    fn from_ros(ros: &ros::Light) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            name: ros.name.clone(),
            r#type: LightKind(ros.r#type.into()),
            pose: AsRos::from_ros(&ros.pose),
            diffuse: Color::from_ros(&ros.diffuse),
            specular: Color::from_ros(&ros.specular),
            attenuation_constant: ros.attenuation_constant,
            attenuation_linear: ros.attenuation_linear,
            attenuation_quadratic: ros.attenuation_quadratic,
            direction: Vector3d::from_ros(&ros.direction),
            range: ros.range,
            cast_shadows: ros.cast_shadows,
            spot_inner_angle: ros.spot_inner_angle,
            spot_outer_angle: ros.spot_outer_angle,
            spot_falloff: ros.spot_falloff,
            id: ros.id,
            parent_id: ros.parent_id,
            intensity: ros.intensity,
            ..Self::default()
        })
    }
}

impl AsRos<ros::EntityFactory> for EntityFactory {
    fn to_ros(&self) -> Option<ros::EntityFactory> {
        Some(ros::EntityFactory {
            name: self.name.clone(),
            allow_renaming: self.allow_renaming,
            sdf: self.sdf.clone(),
            sdf_filename: self.sdf_filename.clone(),
            clone_name: self.clone_name.clone(),
            pose: part(self.pose.as_ref()),
            relative_to: self.relative_to.clone(),
        })
    }

    fn from_ros(ros: &ros::EntityFactory) -> Option<Self> {
        Some(Self {
            name: ros.name.clone(),
            allow_renaming: ros.allow_renaming,
            sdf: ros.sdf.clone(),
            sdf_filename: ros.sdf_filename.clone(),
            clone_name: ros.clone_name.clone(),
            pose: <Pose as AsRos<periplus_msgs::geometry_msgs::Pose>>::from_ros(&ros.pose),
            relative_to: ros.relative_to.clone(),
            ..Self::default()
        })
    }
}

impl AsRos<ros::WorldReset> for WorldReset {
    fn to_ros(&self) -> Option<ros::WorldReset> {
        let Self { all, time_only, model_only, .. } = *self;
        Some(ros::WorldReset { all, time_only, model_only })
    }

    fn from_ros(ros: &ros::WorldReset) -> Option<Self> {
        let ros::WorldReset { all, time_only, model_only } = *ros;
        Some(Self { header: None, all, time_only, model_only })
    }
}

impl AsRos<ros::WorldControl> for WorldControl {
    fn to_ros(&self) -> Option<ros::WorldControl> {
        Some(ros::WorldControl {
            pause: self.pause,
            step: self.step,
            multi_step: self.multi_step,
            reset: part(self.reset.as_ref()),
            seed: self.seed,
            run_to_sim_time: part(self.run_to_sim_time.as_ref()),
        })
    }

    fn from_ros(ros: &ros::WorldControl) -> Option<Self> {
        let run_to = &ros.run_to_sim_time;
        Some(Self {
            header: None,
            pause: ros.pause,
            step: ros.step,
            multi_step: ros.multi_step,
            reset: WorldReset::from_ros(&ros.reset),
            seed: ros.seed,
            // The presence of the field matters: Gazebo would run to the time 0.
            run_to_sim_time: if run_to.ns() == 0 { None } else { Time::from_ros(run_to) },
        })
    }
}

impl AsRos<ros::WorldStatistics> for WorldStatistics {
    fn to_ros(&self) -> Option<ros::WorldStatistics> {
        Some(ros::WorldStatistics {
            header: part(self.header.as_ref()),
            sim_time: part(self.sim_time.as_ref()),
            pause_time: part(self.pause_time.as_ref()),
            real_time: part(self.real_time.as_ref()),
            paused: self.paused,
            iterations: self.iterations,
            model_count: self.model_count,
            real_time_factor: self.real_time_factor,
            step_size: part(self.step_size.as_ref()),
            stepping: self.stepping,
            ..ros::WorldStatistics::default()
        })
    }

    fn from_ros(ros: &ros::WorldStatistics) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            sim_time: Time::from_ros(&ros.sim_time),
            pause_time: Time::from_ros(&ros.pause_time),
            real_time: Time::from_ros(&ros.real_time),
            paused: ros.paused,
            iterations: ros.iterations,
            model_count: ros.model_count,
            real_time_factor: ros.real_time_factor,
            step_size: Time::from_ros(&ros.step_size),
            stepping: ros.stepping,
        })
    }
}

impl AsRos<ros::TrackVisual> for TrackVisual {
    fn to_ros(&self) -> Option<ros::TrackVisual> {
        Some(ros::TrackVisual {
            header: part(self.header.as_ref()),
            name: self.name.clone(),
            id: self.id,
            inherit_orientation: self.inherit_orientation,
            min_dist: self.min_dist,
            max_dist: self.max_dist,
            is_static: self.r#static,
            use_model_frame: self.use_model_frame,
            xyz: part(self.xyz.as_ref()),
            inherit_yaw: self.inherit_yaw,
        })
    }

    fn from_ros(ros: &ros::TrackVisual) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            name: ros.name.clone(),
            id: ros.id,
            inherit_orientation: ros.inherit_orientation,
            min_dist: ros.min_dist,
            max_dist: ros.max_dist,
            r#static: ros.is_static,
            use_model_frame: ros.use_model_frame,
            xyz: Vector3d::from_ros(&ros.xyz),
            inherit_yaw: ros.inherit_yaw,
        })
    }
}

impl AsRos<ros::GuiCamera> for GuiCamera {
    fn to_ros(&self) -> Option<ros::GuiCamera> {
        Some(ros::GuiCamera {
            header: part(self.header.as_ref()),
            name: self.name.clone(),
            view_controller: self.view_controller.clone(),
            pose: part(self.pose.as_ref()),
            track: part(self.track.as_ref()),
            projection_type: self.projection_type.clone(),
        })
    }

    fn from_ros(ros: &ros::GuiCamera) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            name: ros.name.clone(),
            view_controller: ros.view_controller.clone(),
            pose: AsRos::from_ros(&ros.pose),
            track: TrackVisual::from_ros(&ros.track),
            projection_type: ros.projection_type.clone(),
        })
    }
}

impl AsRos<ros::VideoRecord> for VideoRecord {
    fn to_ros(&self) -> Option<ros::VideoRecord> {
        Some(ros::VideoRecord {
            header: part(self.header.as_ref()),
            start: self.start,
            stop: self.stop,
            format: self.format.clone(),
            save_filename: self.save_filename.clone(),
        })
    }

    fn from_ros(ros: &ros::VideoRecord) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            start: ros.start,
            stop: ros.stop,
            format: ros.format.clone(),
            save_filename: ros.save_filename.clone(),
        })
    }
}
