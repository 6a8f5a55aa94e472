//! Lidars: `ray`, `gpu_ray`, `lidar`, `gpu_lidar`, as scans, clouds and single ranges.

mod message;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_graph::{GraphError, Publisher, Qos};
use periplus_msgs::{Message, sensor_msgs};
use periplus_physics::LinkId;
use periplus_plugin_specs::Interpreted;
use periplus_rendering::{SensedGeometry, filter};
use periplus_sensors::{Lidar, Schedule, Streams, Sweep, View};

use super::post::Post;
use crate::{Device, Moment, SensorMount, node_of, plain_node, publisher_qos};
use message::Told;

/// Most poses of a moving lidar that are kept for one scan.
const MOST_POSES: usize = 4096;

/// Where the measurement goes.
struct Output {
    to: Channel,
    told: Told,
}

enum Channel {
    Scan(Publisher<sensor_msgs::LaserScan>),
    /// All rows of beams one after the other, as ROS 1 plugins of flat lasers publish them.
    Rows(Publisher<sensor_msgs::LaserScan>),
    Points(Publisher<sensor_msgs::PointCloud2>),
    /// As Gazebo itself lays out points: nothing left out, with the number of the row.
    Rings(Publisher<sensor_msgs::PointCloud2>),
    OldPoints(Publisher<sensor_msgs::PointCloud>),
    Range(Publisher<sensor_msgs::Range>),
}

impl Channel {
    fn is_heard(&self) -> bool {
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
    lidar: Lidar,
    streams: Streams,
    schedule: Schedule,
    link: LinkId,
    link_from_sensor: Pose,
    geometry: SensedGeometry,
    visibility_mask: u32,
    outputs: Vec<Output>,
    /// Number of the last measurement that was due.
    last_tick: u64,
    /// Whether it had subscribers then.
    was_heard: bool,
    /// Where the sensor was at the ends of the steps of this scan, if that is wanted.
    track: Option<Vec<(i64, Pose)>>,
    rebuild: Box<dyn Fn(i64) -> Schedule + Send>,
}

/// The device of a lidar; none, with an error, for one that cannot measure.
pub(super) fn build(
    post: &Post<'_>,
    spec: &periplus_scene::Lidar,
    plugins: &[Interpreted],
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Device>> {
    let streams = post.streams();
    let lidar = match Lidar::new(spec, &streams) {
        Ok(lidar) => lidar,
        Err(wrong) => {
            diagnostics.push(wrong.at(post.sensor.origin));
            return None;
        }
    };
    let mut outputs = Vec::new();
    let mut rate_hz = None;
    for plugin in plugins {
        match output(post, plugin, diagnostics) {
            Ok(Some(output)) => outputs.push(output),
            Ok(None) => {}
            Err(error) => diagnostics
                .push(Diagnostic::error("sensor-topic", error.to_string()).at(post.sensor.origin)),
        }
        // The velodyne plugin and its like throttle below the sensor's own rate.
        let throttle = number(plugin, "updateRate").filter(|rate| *rate > 0.0);
        rate_hz = throttle
            .filter(|rate| *rate < post.sensor.update_rate_hz || post.sensor.update_rate_hz <= 0.0);
    }
    if outputs.is_empty() {
        match own_outputs(post, diagnostics) {
            Ok(own) => outputs = own,
            Err(error) => {
                diagnostics.push(
                    Diagnostic::error("sensor-topic", error.to_string()).at(post.sensor.origin),
                );
                return None;
            }
        }
    }
    let rate_hz = rate_hz.unwrap_or(post.sensor.update_rate_hz);
    let quirks = post.setting.quirks;
    Some(Box::new(LidarDevice {
        name: post.full_name(),
        lidar,
        streams,
        schedule: post.schedule(Some(rate_hz)),
        link: post.id,
        link_from_sensor: post.link_from_sensor(),
        // As in Gazebo: the graphics card renders what is seen, the others ask physics.
        geometry: if post.sensor.type_name.starts_with("gpu") {
            SensedGeometry::Visual
        } else {
            SensedGeometry::Collision
        },
        visibility_mask: spec.visibility_mask,
        outputs,
        last_tick: 0,
        was_heard: false,
        track: post.setting.rolling_scans.then(Vec::new),
        rebuild: Box::new(move |time_ns| Schedule::new(rate_hz, time_ns, quirks)),
    }))
}

/// What a plugin publishes of it; none for plugins that are no publishers.
fn output(
    post: &Post<'_>,
    plugin: &Interpreted,
    diagnostics: &mut Diagnostics,
) -> Result<Option<Output>, GraphError> {
    let values = &plugin.values;
    let quirks = post.setting.quirks;
    // `SensorDataQoS().reliable()` of the ROS 2 plugins.
    let qos = publisher_qos(&plugin.ros, "~/out", Qos::reliable(5));
    let mut told = Told { quirks, ..Told::default() };
    let to = match plugin.known.id {
        "gazebo_ros_ray_sensor" => {
            told.frame_id = post.frame_id(values.text("frame_name"), diagnostics);
            told.least_intensity = values.number("min_intensity").unwrap_or(0.0);
            told.is_ultrasound = values.text("radiation_type").as_deref() == Some("ultrasound");
            let node = node_of(post.setting, plugin)?;
            match values.text("output_type").as_deref() {
                Some("sensor_msgs/LaserScan") => Channel::Scan(node.publisher("~/out", qos)?),
                Some("sensor_msgs/PointCloud") => Channel::OldPoints(node.publisher("~/out", qos)?),
                Some("sensor_msgs/Range") => Channel::Range(node.publisher("~/out", qos)?),
                _ => Channel::Points(node.publisher("~/out", qos)?),
            }
        }
        "gazebo_ros_laser" | "gazebo_ros_gpu_laser" => {
            told.frame_id = ros1_frame(post, plugin, diagnostics);
            told.least_intensity = number(plugin, "hokuyoMinIntensity").unwrap_or(0.0);
            Channel::Rows(ros1_publisher(post, plugin, "/world")?)
        }
        "gazebo_ros_block_laser" => {
            told.frame_id = ros1_frame(post, plugin, diagnostics);
            told.least_intensity = number(plugin, "hokuyoMinIntensity").unwrap_or(101.0);
            Channel::OldPoints(ros1_publisher(post, plugin, "/world")?)
        }
        "gazebo_ros_velodyne_laser" | "gazebo_ros_velodyne_gpu_laser" => {
            told.frame_id = ros1_frame(post, plugin, diagnostics);
            Channel::Points(ros1_publisher(post, plugin, "/velodyne_points")?)
        }
        "gazebo_ros_range" => {
            told.frame_id = ros1_frame(post, plugin, diagnostics);
            told.field_of_view_rad = values.number("fov");
            told.is_ultrasound = values.text("radiation").as_deref() == Some("ultrasound");
            Channel::Range(ros1_publisher(post, plugin, "/range")?)
        }
        _ => return Ok(None),
    };
    Ok(Some(Output { to, told }))
}

fn ros1_frame(post: &Post<'_>, plugin: &Interpreted, diagnostics: &mut Diagnostics) -> String {
    // The default of these plugins, `world`, would put every scan at the origin.
    let given = plugin.values.is_given("frameName");
    post.frame_id(plugin.values.text("frameName").filter(|_| given), diagnostics)
}

/// A number of a plugin; none where it has no such parameter.
fn number(plugin: &Interpreted, name: &str) -> Option<f64> {
    plugin.values.table().find(name)?;
    plugin.values.number(name)
}

/// ROS 1 topics are given by a parameter, and know no QoS: reliable, as TCP is.
fn ros1_publisher<T: Message>(
    post: &Post<'_>,
    plugin: &Interpreted,
    usual: &str,
) -> Result<Publisher<T>, GraphError> {
    let topic = plugin.values.text("topicName").unwrap_or_else(|| usual.to_owned());
    node_of(post.setting, plugin)?.publisher(&topic, Qos::reliable(1))
}

/// Without a plugin: what Gazebo's own lidar publishes, a scan and the points beside it.
fn own_outputs(post: &Post<'_>, diagnostics: &mut Diagnostics) -> Result<Vec<Output>, GraphError> {
    let node = plain_node(post.setting, &post.sensor.name)?;
    let frame_id = post.frame_id(None, diagnostics);
    let told = Told { frame_id, quirks: post.setting.quirks, ..Told::default() };
    let scan = post.gz_topic("/scan");
    let qos = Qos::sensor_data().with_reliability(periplus_graph::Reliability::Reliable);
    let points = node.publisher(&format!("{scan}/points"), qos)?;
    Ok(vec![
        Output { to: Channel::Scan(node.publisher(&scan, qos)?), told: told.clone() },
        Output { to: Channel::Rings(points), told },
    ])
}

impl Device for LidarDevice {
    fn name(&self) -> &str {
        &self.name
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let now_ns = moment.time_ns();
        let world_from_sensor = moment
            .world
            .link_state(self.link)
            .map(|state| state.world_from_link * self.link_from_sensor);
        let Some(world_from_sensor) = world_from_sensor else { return };
        if let Some(track) = &mut self.track
            && track.len() < MOST_POSES
        {
            track.push((now_ns, world_from_sensor));
        }
        let Some(tick) = self.schedule.due(now_ns) else { return };
        self.last_tick = tick;
        self.was_heard = self.is_heard();
        if self.was_heard {
            self.measure(moment, tick, world_from_sensor);
        }
        if let Some(track) = &mut self.track {
            track.clear();
            track.push((now_ns, world_from_sensor));
        }
    }

    fn sense_paused(&mut self, moment: &mut Moment<'_>) {
        let is_heard = self.is_heard();
        let had_subscribers = std::mem::replace(&mut self.was_heard, is_heard);
        let state = moment.world.link_state(self.link);
        if let Some(state) = state.filter(|_| is_heard && !had_subscribers) {
            let world_from_sensor = state.world_from_link * self.link_from_sensor;
            self.measure(moment, self.last_tick, world_from_sensor);
        }
    }

    fn mounts(&self) -> Vec<SensorMount> {
        let of = |output: &Output| SensorMount {
            topic: output.to.topic().to_owned(),
            frame_id: output.told.frame_id.clone(),
            link: self.link,
            link_from_data: self.link_from_sensor,
        };
        self.outputs.iter().map(of).collect()
    }

    fn next_ns(&self) -> Option<i64> {
        self.schedule.next_ns().filter(|_| self.is_heard())
    }

    fn reset(&mut self, time_ns: i64) {
        self.lidar.reset();
        self.schedule = (self.rebuild)(time_ns);
        if let Some(track) = &mut self.track {
            track.clear();
        }
    }
}

impl LidarDevice {
    fn is_heard(&self) -> bool {
        self.outputs.iter().any(|output| output.to.is_heard())
    }

    fn measure(&mut self, moment: &mut Moment<'_>, tick: u64, world_from_sensor: Pose) {
        let now_ns = moment.time_ns();
        let part = moment.part(self.geometry, self.link);
        let threads = moment.threads;
        let seen = moment.seen(self.geometry);
        let retro = |instance| seen.laser_retro(instance);
        let view = View {
            rays: seen.rays(),
            filter: filter(self.visibility_mask, None),
            own_group: part.and_then(|part| seen.model_of(part)).map_or(0, |model| model.group().0),
            retro: if seen.has_laser_retro() { Some(&retro) } else { None },
            threads,
        };
        let (start_ns, poses) = self.swept(now_ns);
        let sweep = match &poses {
            Some(poses) => Sweep::Moving(poses),
            None => Sweep::Still(world_from_sensor),
        };
        self.lidar.scan(&view, sweep, &mut self.streams.tick(tick));
        for output in &self.outputs {
            let told = &output.told;
            let span_ns = now_ns - start_ns;
            match &output.to {
                to if !to.is_heard() => {}
                Channel::Scan(publisher) => {
                    let row = self.lidar.beams().middle_row();
                    publisher.publish(told.scan(&self.lidar, row, start_ns, span_ns));
                }
                Channel::Rows(publisher) => {
                    let all = 0..self.lidar.last().ranges_m.len();
                    publisher.publish(told.scan(&self.lidar, all, start_ns, span_ns));
                }
                Channel::Points(publisher) => publisher.publish(told.points(&self.lidar, start_ns)),
                Channel::Rings(publisher) => publisher.publish(told.rings(&self.lidar, start_ns)),
                Channel::OldPoints(publisher) => {
                    publisher.publish(told.old_points(&self.lidar, start_ns));
                }
                Channel::Range(publisher) => publisher.publish(told.range(&self.lidar, start_ns)),
            }
        }
    }

    /// When the scan began, and the poses of the sensor since then with the part of the scan at
    /// which it was there; none of a scan that is measured at once.
    fn swept(&self, now_ns: i64) -> (i64, Option<Vec<(f64, Pose)>>) {
        let Some(track) = &self.track else { return (now_ns, None) };
        let Some(&(start_ns, _)) = track.first() else { return (now_ns, None) };
        if start_ns >= now_ns {
            return (now_ns, None);
        }
        #[expect(clippy::cast_precision_loss, reason = "a scan lasts seconds")]
        let part = |time_ns: i64| (time_ns - start_ns) as f64 / (now_ns - start_ns) as f64;
        (start_ns, Some(track.iter().map(|&(time_ns, pose)| (part(time_ns), pose)).collect()))
    }
}
