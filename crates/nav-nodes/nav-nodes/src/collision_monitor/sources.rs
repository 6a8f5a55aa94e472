//! Sources of points and their topics.

use std::sync::Arc;

use periplus_costmap::Nav2Release;
use periplus_geometry::{DVec3, Pose};
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_motion::collision_monitor::{CollisionPoint, sources};
use periplus_motion::tables::{ExclusionZoneParams, MonitorSourceParams};
use periplus_msgs::geometry_msgs::PolygonInstanceStamped;
use periplus_msgs::nav2_msgs;
use periplus_msgs::sensor_msgs::{LaserScan, PointCloud2, Range};
use periplus_msgs::std_msgs::Header;

use crate::costmap_2d::clouds;
use crate::costmap_subscriber::read_costmap;

use super::config::MonitorSourceConfig;
use super::exclusions::ExclusionZone;
use super::perception::Frames;

/// Messages of a source with the newest one.
struct Newest<T: periplus_msgs::Message> {
    mailbox: Mailbox<T>,
    message: Option<Arc<T>>,
}

impl<T: periplus_msgs::Message> Newest<T> {
    fn new(node: &Node, topic: &str) -> Result<Self, GraphError> {
        Ok(Self { mailbox: node.mailbox(topic, Qos::sensor_data())?, message: None })
    }

    fn receive(&mut self) -> Option<&T> {
        if let Some(message) = self.mailbox.latest() {
            self.message = Some(message);
        }
        self.message.as_deref()
    }
}

/// Data of a source.
enum SourceInput {
    Scan(Newest<LaserScan>),
    PointCloud(Newest<PointCloud2>),
    Range(Newest<Range>),
    /// Polygons by their numbers.
    Polygon(Mailbox<PolygonInstanceStamped>, Vec<Arc<PolygonInstanceStamped>>),
    Costmap(Newest<nav2_msgs::Costmap>),
}

/// Source of points.
pub(super) struct SourcePort {
    pub(super) name: String,
    input: SourceInput,
    params: MonitorSourceParams,
    timeout_ns: i64,
    pub(super) exclusions: Vec<ExclusionZone>,
}

/// Reason why a source has no valid data.
pub(super) type InvalidSource = String;

impl SourcePort {
    /// Creates a source; `timeout_s` is that of the node.
    ///
    /// # Errors
    /// The mistake in the parameters.
    pub(super) fn open(
        node: &Node,
        config: &MonitorSourceConfig,
        timeout_s: f64,
        release: Nav2Release,
    ) -> Result<Self, String> {
        let (name, params) = (&config.name, config.params());
        let topic = &params.topic;
        let input = match params.source_type.as_str() {
            "scan" => Newest::new(node, topic).map(SourceInput::Scan),
            "pointcloud" => Newest::new(node, topic).map(SourceInput::PointCloud),
            "range" => Newest::new(node, topic).map(SourceInput::Range),
            "polygon" if release != Nav2Release::Humble => node
                .mailbox(topic, Qos::sensor_data())
                .map(|mailbox| SourceInput::Polygon(mailbox, Vec::new())),
            "costmap" if release == Nav2Release::Main => {
                Newest::new(node, topic).map(SourceInput::Costmap)
            }
            other => {
                return Err(format!(
                    "`{name}.type`: `{other}` is no source of Nav2 {release}; write `scan`, \
                     `pointcloud`, `range`, `polygon` or `costmap`"
                ));
            }
        };
        if params.transport_type != "raw" {
            return Err(format!("`{name}.transport_type` must be `raw`"));
        }
        let input = input.map_err(|error| error.to_string())?;
        let exclusion = |(name, values): &(String, periplus_params::ParamValues)| {
            ExclusionZone::from_params(node, name, &ExclusionZoneParams::from_values(values))
        };
        let exclusions = config.exclusions.iter().map(exclusion).collect::<Result<_, _>>()?;
        let timeout_s = params.source_timeout_s.unwrap_or(timeout_s);
        let timeout_ns = (timeout_s * 1e9) as i64;
        Ok(Self { name: name.clone(), input, params, timeout_ns, exclusions })
    }

    /// Applies changed parameters.
    pub(super) fn adopt(&mut self, params: MonitorSourceParams) {
        self.params = params;
    }

    pub(super) fn is_enabled(&self) -> bool {
        self.params.is_enabled
    }

    /// True if missing data has no effect.
    pub(super) fn is_optional(&self) -> bool {
        self.timeout_ns == 0
    }

    /// Points in the base frame now, without those in exclusion zones.
    ///
    /// # Errors
    /// The reason why the source is invalid.
    pub(super) fn points(
        &mut self,
        frames: &Frames<'_>,
    ) -> Result<Vec<CollisionPoint>, InvalidSource> {
        let mut points = self.all_points(frames)?;
        for zone in &self.exclusions {
            zone.apply(&mut points, frames);
        }
        Ok(points)
    }

    fn all_points(&mut self, frames: &Frames<'_>) -> Result<Vec<CollisionPoint>, InvalidSource> {
        let (params, timeout_ns) = (&self.params, self.timeout_ns);
        let base_from = |header: &Header| {
            check_age(header, timeout_ns, frames.now_ns)?;
            frames.base_from(&header.frame_id, header.stamp.ns())
        };
        let missing = || format!("no data was received on `{}`", params.topic);
        match &mut self.input {
            SourceInput::Scan(scans) => {
                let scan = scans.receive().ok_or_else(missing)?;
                let base_from_scan = base_from(&scan.header)?;
                let (first, step) = (scan.angle_min.into(), scan.angle_increment.into());
                let limits = [scan.range_min, scan.range_max];
                let points = sources::scan_points(&scan.ranges, first, step, limits);
                Ok(place(points, base_from_scan))
            }
            SourceInput::PointCloud(clouds) => {
                let cloud = clouds.receive().ok_or_else(missing)?;
                cloud_points(cloud, params, base_from(&cloud.header)?)
            }
            SourceInput::Range(ranges) => {
                let range = ranges.receive().ok_or_else(missing)?;
                let base_from_range = base_from(&range.header)?;
                let reading = f64::from(range.range);
                if reading > f64::from(range.max_range) {
                    return Ok(Vec::new());
                }
                // A reading below the minimum, or none, does not show that the cone is free.
                let is_valid = reading >= f64::from(range.min_range);
                let angle = params.obstacles_angle_rad;
                let points = is_valid
                    .then(|| sources::range_points(reading, range.field_of_view.into(), angle))
                    .flatten();
                let points = points.ok_or_else(|| {
                    format!("the reading of {reading} m on `{}` is not usable", params.topic)
                })?;
                Ok(place(points, base_from_range))
            }
            SourceInput::Polygon(mailbox, polygons) => {
                for polygon in mailbox.drain() {
                    polygons.retain(|other| other.polygon.id != polygon.polygon.id);
                    polygons.push(polygon);
                }
                if polygons.is_empty() {
                    return Err(missing());
                }
                polygons.retain(|it| check_age(&it.header, timeout_ns, frames.now_ns).is_ok());
                polygon_points(polygons, params, frames)
            }
            SourceInput::Costmap(costmaps) => {
                let message = costmaps.receive().ok_or_else(missing)?;
                let base_from_costmap = base_from(&message.header)?;
                let costmap = read_costmap(message)
                    .map_err(|why| format!("a costmap on `{}` {why}", params.topic))?;
                let min_cost = u8::try_from(params.cost_threshold).unwrap_or(u8::MAX);
                let unknown = params.treat_unknown_as_obstacle;
                let points = sources::costmap_points(&costmap, min_cost, unknown);
                Ok(place(points, base_from_costmap))
            }
        }
    }
}

/// # Errors
/// When the data is older than the timeout; 0 is no limit.
fn check_age(header: &Header, timeout_ns: i64, now_ns: i64) -> Result<(), InvalidSource> {
    let age_ns = now_ns - header.stamp.ns();
    if timeout_ns != 0 && age_ns > timeout_ns {
        let (age_s, limit_s) = (age_ns as f64 * 1e-9, timeout_ns as f64 * 1e-9);
        return Err(format!("its data is {age_s:.2} s old; at most {limit_s} s are allowed"));
    }
    Ok(())
}

fn place(points: Vec<[f64; 3]>, base_from_source: Pose) -> Vec<CollisionPoint> {
    let placed = points.into_iter().map(|point| in_base(point, base_from_source));
    placed.collect()
}

fn in_base([x, y, z]: [f64; 3], base_from_source: Pose) -> CollisionPoint {
    let point = base_from_source.transform_point(DVec3::new(x, y, z));
    CollisionPoint { x_m: point.x, y_m: point.y, z_m: point.z }
}

/// Points of a cloud within the limits of height and range.
fn cloud_points(
    cloud: &PointCloud2,
    params: &MonitorSourceParams,
    base_from_cloud: Pose,
) -> Result<Vec<CollisionPoint>, InvalidSource> {
    let malformed = |why| format!("a cloud on `{}` is malformed: {why}", params.topic);
    let heights = params.min_height_m..=params.max_height_m;
    let keep = |[x, y, z]: [f32; 3], height: Option<f32>| {
        let point = [x, y, z].map(f64::from);
        let range_m = libm::sqrt(point.iter().map(|part| part * part).sum());
        let placed = in_base(point, base_from_cloud);
        let height_m = height.map_or(placed.z_m, f64::from);
        // Points without coordinates are in no range.
        (range_m >= params.min_range_m && heights.contains(&height_m)).then_some(placed)
    };
    if params.use_global_height {
        let all = clouds::fields(cloud, ["x", "y", "z", "height"]).map_err(malformed)?;
        return Ok(all.filter_map(|[x, y, z, height]| keep([x, y, z], Some(height))).collect());
    }
    let all = clouds::points(cloud).map_err(malformed)?;
    Ok(all.filter_map(|point| keep(point, None)).collect())
}

/// Points on the sides of polygons.
fn polygon_points(
    polygons: &[Arc<PolygonInstanceStamped>],
    params: &MonitorSourceParams,
    frames: &Frames<'_>,
) -> Result<Vec<CollisionPoint>, InvalidSource> {
    let mut points = Vec::new();
    for polygon in polygons {
        let header = &polygon.header;
        let base_from_polygon = frames.base_from(&header.frame_id, header.stamp.ns())?;
        let corners: Vec<[f64; 2]> = polygon
            .polygon
            .polygon
            .points
            .iter()
            .map(|corner| {
                let corner = [corner.x, corner.y, corner.z].map(f64::from);
                let placed = in_base(corner, base_from_polygon);
                [placed.x_m, placed.y_m]
            })
            .collect();
        let sampled = sources::polygon_points(&corners, params.sampling_distance_m);
        points.extend(sampled.into_iter().map(|[x, y, _]| CollisionPoint::planar(x, y)));
    }
    Ok(points)
}
