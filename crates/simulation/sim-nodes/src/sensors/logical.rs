//! Logical cameras.

use periplus_geometry::Pose;
use periplus_graph::Publisher;
use periplus_msgs::geometry_msgs;
use periplus_msgs::ros_gz_interfaces::{LogicalCameraImage, LogicalCameraImageModel};
use periplus_msgs::std_msgs::Header;
use periplus_scene::SensorKind;
use periplus_sensors::LogicalCamera;

use super::{DeviceResult, Mount, SensorBuildContext, Timer};
use crate::{Device, DeviceState, SenseContext};

struct LogicalDevice {
    mount: Mount,
    timer: Timer,
    camera: LogicalCamera,
    outputs: Vec<(String, Publisher<LogicalCameraImage>)>,
}

pub(super) fn device(context: SensorBuildContext<'_, '_>) -> DeviceResult {
    let SensorKind::LogicalCamera { near_m, far_m, aspect_ratio, horizontal_fov_rad } =
        context.sensor_context.sensor.kind
    else {
        return Err(super::SensorBuildError::unsupported(context.sensor_context.sensor));
    };
    let camera = LogicalCamera::new(near_m, far_m, aspect_ratio, horizontal_fov_rad)?;
    let mut outputs = Vec::new();
    for port in &context.ports {
        outputs.push((
            port.frame.clone(),
            port.publisher(&port.topic(context.sensor_context, "/logical_camera"))?,
        ));
    }
    Ok(Box::new(LogicalDevice {
        timer: Timer::new(context.sensor_context, &context.ports),
        mount: context.mount,
        camera,
        outputs,
    }))
}

impl Device for LogicalDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let time_ns = moment.time_ns();
        let due = self.timer.due(time_ns).is_some();
        if !due || !self.outputs.iter().any(|(_, out)| out.is_heard()) {
            return;
        }
        let world = moment.world;
        let Some(motion) = self.mount.motion(world) else { return };
        let own = world.model_of(self.mount.link);
        let models = world
            .models()
            .filter(|(id, _)| Some(*id) != own)
            .filter_map(|(id, name)| Some((name, world.model_pose(id)?)));
        let seen: Vec<LogicalCameraImageModel> = self
            .camera
            .see(motion.world_from_sensor, models)
            .map(|(name, pose)| LogicalCameraImageModel { name: name.into(), pose: pose_of(pose) })
            .collect();
        for (frame, out) in &self.outputs {
            out.publish(LogicalCameraImage {
                header: Header::at(time_ns, frame),
                pose: pose_of(motion.world_from_sensor),
                model: seen.clone(),
            });
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let has_subscribers = self.outputs.iter().any(|(_, out)| out.is_heard());
        self.timer.next_ns().filter(|_| has_subscribers)
    }

    fn reset(&mut self, time_ns: i64) {
        self.timer.reset(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.timer)
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.timer)
    }
}

fn pose_of(pose: Pose) -> geometry_msgs::Pose {
    let Pose { translation: t, rotation: q } = pose;
    geometry_msgs::Pose {
        position: geometry_msgs::Point { x: t.x, y: t.y, z: t.z },
        orientation: geometry_msgs::Quaternion { x: q.x, y: q.y, z: q.z, w: q.w },
    }
}
