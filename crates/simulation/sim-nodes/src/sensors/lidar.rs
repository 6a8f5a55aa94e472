//! Lidars: `ray`, `gpu_ray`, `lidar`, `gpu_lidar`, as scans, point clouds and single ranges.

mod message;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_graph::{GraphError, Publisher, Qos};
use periplus_msgs::{Message, sensor_msgs};
use periplus_physics::LinkId;
use periplus_plugin_specs::InterpretedPlugin;
use periplus_rendering::{SensedGeometry, filter};
use periplus_sensors::{LidarSensor, RayView, Schedule, Streams, Sweep};

use super::sensor_context::SensorContext;
use crate::{
    Device, DeviceState, SenseContext, SensorMount, device_node, plugin_node, publisher_qos,
};
use message::PublishSettings;

/// Maximum number of poses of a moving lidar per scan.
const MAX_POSE_COUNT: usize = 4096;

/// A publisher of a lidar with its settings.
struct Output {
    to: Channel,
    settings: PublishSettings,
}

enum Channel {
    Scan(Publisher<sensor_msgs::LaserScan>),
    /// All rows of beams concatenated, as ROS 1 plugins of planar lasers publish them.
    Rows(Publisher<sensor_msgs::LaserScan>),
    Points(Publisher<sensor_msgs::PointCloud2>),
    /// Gazebo's own point layout: all points, with the ring number.
    Rings(Publisher<sensor_msgs::PointCloud2>),
    OldPoints(Publisher<sensor_msgs::PointCloud>),
    Range(Publisher<sensor_msgs::Range>),
}

impl Channel {
    fn has_subscribers(&self) -> bool {
        match self {
            Self::Scan(publisher) | Self::Rows(publisher) => publisher.is_heard(),
            Self::Points(publisher) | Self::Rings(publisher) => publisher.is_heard(),
            Self::OldPoints(publisher) => publisher.is_heard(),
            Self::Range(publisher) => publisher.is_heard(),
        }
    }

    fn topic(&self) -> &str {
        match self {
            Self::Scan(publisher) | Self::Rows(publisher) => publisher.topic(),
            Self::Points(publisher) | Self::Rings(publisher) => publisher.topic(),
            Self::OldPoints(publisher) => publisher.topic(),
            Self::Range(publisher) => publisher.topic(),
        }
    }
}

struct LidarDevice {
    name: String,
    lidar: LidarSensor,
    streams: Streams,
    state: LidarState,
    link: LinkId,
    link_from_sensor: Pose,
    geometry: SensedGeometry,
    visibility_mask: u32,
    outputs: Vec<Output>,
    rebuild: Box<dyn Fn(i64) -> Schedule + Send>,
}

#[derive(Clone)]
struct LidarState {
    schedule: Schedule,
    /// Number of the last due measurement.
    last_tick: u64,
    /// True if that measurement had subscribers.
    had_subscribers: bool,
    /// Poses of the sensor at the ends of this scan's steps; `None` without rolling scans.
    pose_history: Option<Vec<(i64, Pose)>>,
}

/// Builds the device of a lidar; reports an error and returns `None` for one that cannot measure.
pub(super) fn build(
    sensor_context: &SensorContext<'_>,
    spec: &periplus_scene::LidarSpec,
    plugins: &[InterpretedPlugin],
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Device>> {
    let streams = sensor_context.streams();
    let lidar = match LidarSensor::new(spec, &streams) {
        Ok(lidar) => lidar,
        Err(wrong) => {
            diagnostics.push(wrong.at(sensor_context.sensor.origin));
            return None;
        }
    };
    let mut outputs = Vec::new();
    let mut rate_hz = None;
    for plugin in plugins {
        match output(sensor_context, plugin, diagnostics) {
            Ok(Some(output)) => outputs.push(output),
            Ok(None) => {}
            Err(error) => diagnostics.push(
                Diagnostic::error("sensor-topic", error.to_string())
                    .at(sensor_context.sensor.origin),
            ),
        }
        // Plugins such as velodyne throttle below the sensor's own rate.
        let throttle = number(plugin, "updateRate").filter(|rate| *rate > 0.0);
        rate_hz = throttle.filter(|rate| {
            *rate < sensor_context.sensor.update_rate_hz
                || sensor_context.sensor.update_rate_hz <= 0.0
        });
    }
    if outputs.is_empty() {
        match own_outputs(sensor_context, diagnostics) {
            Ok(own) => outputs = own,
            Err(error) => {
                diagnostics.push(
                    Diagnostic::error("sensor-topic", error.to_string())
                        .at(sensor_context.sensor.origin),
                );
                return None;
            }
        }
    }
    let rate_hz = rate_hz.unwrap_or(sensor_context.sensor.update_rate_hz);
    let quirks = sensor_context.setting.quirks;
    Some(Box::new(LidarDevice {
        name: sensor_context.full_name(),
        lidar,
        streams,
        state: LidarState {
            schedule: sensor_context.schedule(Some(rate_hz)),
            last_tick: 0,
            had_subscribers: false,
            pose_history: sensor_context.setting.rolling_scans.then(Vec::new),
        },
        link: sensor_context.id,
        link_from_sensor: sensor_context.link_from_sensor(),
        // As in Gazebo: GPU lidars sense visuals, others collisions.
        geometry: if sensor_context.sensor.type_name.starts_with("gpu") {
            SensedGeometry::Visual
        } else {
            SensedGeometry::Collision
        },
        visibility_mask: spec.visibility_mask,
        outputs,
        rebuild: Box::new(move |time_ns| Schedule::new(rate_hz, time_ns, quirks)),
    }))
}

/// Returns the output of a plugin; `None` for plugins that do not publish.
fn output(
    sensor_context: &SensorContext<'_>,
    plugin: &InterpretedPlugin,
    diagnostics: &mut Diagnostics,
) -> Result<Option<Output>, GraphError> {
    let values = &plugin.values;
    let quirks = sensor_context.setting.quirks;
    // `SensorDataQoS().reliable()` of the ROS 2 plugins.
    let qos = publisher_qos(&plugin.ros, "~/out", Qos::reliable(5));
    let mut settings = PublishSettings { quirks, ..PublishSettings::default() };
    let to = match plugin.known.id {
        "gazebo_ros_ray_sensor" => {
            settings.frame_id = sensor_context.frame_id(values.text("frame_name"), diagnostics);
            settings.min_intensity = values.number("min_intensity").unwrap_or(0.0);
            settings.is_ultrasound = values.text("radiation_type").as_deref() == Some("ultrasound");
            let node = plugin_node(sensor_context.setting, plugin)?;
            match values.text("output_type").as_deref() {
                Some("sensor_msgs/LaserScan") => Channel::Scan(node.publisher("~/out", qos)?),
                Some("sensor_msgs/PointCloud") => Channel::OldPoints(node.publisher("~/out", qos)?),
                Some("sensor_msgs/Range") => Channel::Range(node.publisher("~/out", qos)?),
                _ => Channel::Points(node.publisher("~/out", qos)?),
            }
        }
        "gazebo_ros_laser" | "gazebo_ros_gpu_laser" => {
            settings.frame_id = ros1_frame(sensor_context, plugin, diagnostics);
            settings.min_intensity = number(plugin, "hokuyoMinIntensity").unwrap_or(0.0);
            Channel::Rows(ros1_publisher(sensor_context, plugin, "/world")?)
        }
        "gazebo_ros_block_laser" => {
            settings.frame_id = ros1_frame(sensor_context, plugin, diagnostics);
            settings.min_intensity = number(plugin, "hokuyoMinIntensity").unwrap_or(101.0);
            Channel::OldPoints(ros1_publisher(sensor_context, plugin, "/world")?)
        }
        "gazebo_ros_velodyne_laser" | "gazebo_ros_velodyne_gpu_laser" => {
            settings.frame_id = ros1_frame(sensor_context, plugin, diagnostics);
            Channel::Points(ros1_publisher(sensor_context, plugin, "/velodyne_points")?)
        }
        "gazebo_ros_range" => {
            settings.frame_id = ros1_frame(sensor_context, plugin, diagnostics);
            settings.field_of_view_rad = values.number("fov");
            settings.is_ultrasound = values.text("radiation").as_deref() == Some("ultrasound");
            Channel::Range(ros1_publisher(sensor_context, plugin, "/range")?)
        }
        _ => return Ok(None),
    };
    Ok(Some(Output { to, settings }))
}

fn ros1_frame(
    sensor_context: &SensorContext<'_>,
    plugin: &InterpretedPlugin,
    diagnostics: &mut Diagnostics,
) -> String {
    // The default of these plugins, `world`, would place every scan at the origin.
    let given = plugin.values.is_given("frameName");
    sensor_context.frame_id(plugin.values.text("frameName").filter(|_| given), diagnostics)
}

/// Returns a numeric parameter; `None` where the plugin does not have it.
fn number(plugin: &InterpretedPlugin, name: &str) -> Option<f64> {
    plugin.values.table().find(name)?;
    plugin.values.number(name)
}

/// ROS 1 topics are named by a parameter and have no QoS: reliable, like TCP.
fn ros1_publisher<T: Message>(
    sensor_context: &SensorContext<'_>,
    plugin: &InterpretedPlugin,
    fallback: &str,
) -> Result<Publisher<T>, GraphError> {
    let topic = plugin.values.text("topicName").unwrap_or_else(|| fallback.to_owned());
    plugin_node(sensor_context.setting, plugin)?.publisher(&topic, Qos::reliable(1))
}

/// Outputs without a plugin: Gazebo's own scan and points.
fn own_outputs(
    sensor_context: &SensorContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Output>, GraphError> {
    let node = device_node(sensor_context.setting, &sensor_context.sensor.name)?;
    let frame_id = sensor_context.frame_id(None, diagnostics);
    let settings = PublishSettings {
        frame_id,
        quirks: sensor_context.setting.quirks,
        ..PublishSettings::default()
    };
    let scan = sensor_context.gz_topic("/scan");
    let qos = Qos::sensor_data().with_reliability(periplus_graph::Reliability::Reliable);
    let points = node.publisher(&format!("{scan}/points"), qos)?;
    Ok(vec![
        Output { to: Channel::Scan(node.publisher(&scan, qos)?), settings: settings.clone() },
        Output { to: Channel::Rings(points), settings },
    ])
}

impl Device for LidarDevice {
    fn name(&self) -> &str {
        &self.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let now_ns = moment.time_ns();
        let world_from_sensor = moment
            .world
            .link_state(self.link)
            .map(|state| state.world_from_link * self.link_from_sensor);
        let Some(world_from_sensor) = world_from_sensor else { return };
        if let Some(pose_history) = &mut self.state.pose_history
            && pose_history.len() < MAX_POSE_COUNT
        {
            pose_history.push((now_ns, world_from_sensor));
        }
        let Some(tick) = self.state.schedule.due(now_ns) else { return };
        self.state.last_tick = tick;
        self.state.had_subscribers = self.has_subscribers();
        if self.state.had_subscribers {
            self.measure(moment, tick, world_from_sensor);
        }
        if let Some(pose_history) = &mut self.state.pose_history {
            pose_history.clear();
            pose_history.push((now_ns, world_from_sensor));
        }
    }

    fn sense_paused(&mut self, moment: &mut SenseContext<'_>) {
        let has_subscribers = self.has_subscribers();
        let had_subscribers = std::mem::replace(&mut self.state.had_subscribers, has_subscribers);
        let state = moment.world.link_state(self.link);
        if let Some(state) = state.filter(|_| has_subscribers && !had_subscribers) {
            let world_from_sensor = state.world_from_link * self.link_from_sensor;
            self.measure(moment, self.state.last_tick, world_from_sensor);
        }
    }

    fn mounts(&self) -> Vec<SensorMount> {
        let of = |output: &Output| SensorMount {
            topic: output.to.topic().to_owned(),
            frame_id: output.settings.frame_id.clone(),
            link: self.link,
            link_from_data: self.link_from_sensor,
        };
        self.outputs.iter().map(of).collect()
    }

    fn next_ns(&self) -> Option<i64> {
        self.state.schedule.next_ns().filter(|_| self.has_subscribers())
    }

    fn reset(&mut self, time_ns: i64) {
        self.lidar.reset();
        self.state.schedule = (self.rebuild)(time_ns);
        if let Some(pose_history) = &mut self.state.pose_history {
            pose_history.clear();
        }
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.state.clone())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.state)
    }
}

impl LidarDevice {
    fn has_subscribers(&self) -> bool {
        self.outputs.iter().any(|output| output.to.has_subscribers())
    }

    fn measure(&mut self, moment: &mut SenseContext<'_>, tick: u64, world_from_sensor: Pose) {
        let now_ns = moment.time_ns();
        let part = moment.part(self.geometry, self.link);
        let threads = moment.threads;
        let seen = moment.seen(self.geometry);
        let retro = |instance| seen.laser_retro(instance);
        let view = RayView {
            rays: seen.rays(),
            filter: filter(self.visibility_mask, None),
            own_group: part.and_then(|part| seen.model_of(part)).map_or(0, |model| model.group().0),
            retro: if seen.has_laser_retro() { Some(&retro) } else { None },
            threads,
        };
        let (start_ns, poses) = self.scan_poses(now_ns);
        let sweep = match &poses {
            Some(poses) => Sweep::Moving(poses),
            None => Sweep::AtOnce(world_from_sensor),
        };
        self.lidar.scan(&view, sweep, &mut self.streams.tick(tick));
        for output in &self.outputs {
            let settings = &output.settings;
            let span_ns = now_ns - start_ns;
            match &output.to {
                to if !to.has_subscribers() => {}
                Channel::Scan(publisher) => {
                    let row = self.lidar.beams().middle_row();
                    publisher.publish(settings.scan(&self.lidar, row, start_ns, span_ns));
                }
                Channel::Rows(publisher) => {
                    let all = 0..self.lidar.last().ranges_m.len();
                    publisher.publish(settings.scan(&self.lidar, all, start_ns, span_ns));
                }
                Channel::Points(publisher) => {
                    publisher.publish(settings.points(&self.lidar, start_ns));
                }
                Channel::Rings(publisher) => {
                    publisher.publish(settings.rings(&self.lidar, start_ns));
                }
                Channel::OldPoints(publisher) => {
                    publisher.publish(settings.old_points(&self.lidar, start_ns));
                }
                Channel::Range(publisher) => {
                    publisher.publish(settings.range(&self.lidar, start_ns));
                }
            }
        }
    }

    /// Returns the start of the scan, and the poses of the sensor since then with their fractions of
    /// the scan; `None` for a scan that is measured at once.
    fn scan_poses(&self, now_ns: i64) -> (i64, Option<Vec<(f64, Pose)>>) {
        let Some(pose_history) = &self.state.pose_history else { return (now_ns, None) };
        let Some(&(start_ns, _)) = pose_history.first() else { return (now_ns, None) };
        if start_ns >= now_ns {
            return (now_ns, None);
        }
        #[expect(clippy::cast_precision_loss, reason = "a scan lasts seconds")]
        let part = |time_ns: i64| (time_ns - start_ns) as f64 / (now_ns - start_ns) as f64;
        (
            start_ns,
            Some(pose_history.iter().map(|&(time_ns, pose)| (part(time_ns), pose)).collect()),
        )
    }
}
