//! Exclusion zones of sources, which main has.

use periplus_geometry::Pose;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_motion::collision_monitor::{
    CollisionPoint, ExclusionMask, MonitorShape, exclude, read_corners,
};
use periplus_motion::tables::ExclusionZoneParams;
use periplus_msgs::geometry_msgs::PolygonStamped;
use periplus_msgs::nav2_msgs::ExclusionZoneDescription;

use super::perception::Frames;
use super::zones::outline;

/// Minimum number of corners of an exclusion zone.
const MIN_CORNER_COUNT: usize = 3;

/// Exclusion zone of a source.
pub(super) struct ExclusionZone {
    pub(super) name: String,
    mask: ExclusionMask,
    is_enabled: bool,
    /// Frame of the shape; empty for the base.
    frame: String,
    frame_hold_ns: i64,
    output: Option<Publisher<PolygonStamped>>,
}

impl ExclusionZone {
    /// Creates a zone from parameters.
    ///
    /// # Errors
    /// The mistake in them.
    pub(super) fn from_params(
        node: &Node,
        name: &str,
        params: &ExclusionZoneParams,
    ) -> Result<Self, String> {
        let shape = match params.shape_type.as_str() {
            "circle" if params.radius_m > 0.0 => MonitorShape::Circle { radius_m: params.radius_m },
            "circle" => return Err(format!("`{name}.radius` must be above 0")),
            "polygon" => {
                let corners = read_corners(&params.points, MIN_CORNER_COUNT);
                MonitorShape::Polygon(corners.map_err(|why| format!("`{name}.points`: {why}"))?)
            }
            other => {
                return Err(format!("`{name}.type`: `{other}` is not `polygon` or `circle`"));
            }
        };
        let heights_m =
            [params.min_height_m.unwrap_or(f64::MIN), params.max_height_m.unwrap_or(f64::MAX)];
        Ok(Self {
            name: name.to_owned(),
            mask: ExclusionMask { shape, heights_m },
            is_enabled: params.is_enabled,
            frame: params.frame_id.clone(),
            frame_hold_ns: (params.frame_hold_timeout_s * 1e9) as i64,
            output: publisher(node, name, params.visualize).map_err(|why| why.to_string())?,
        })
    }

    /// Creates a zone from a request.
    ///
    /// # Errors
    /// The mistake in it.
    pub(super) fn from_description(
        node: &Node,
        zone: &ExclusionZoneDescription,
    ) -> Result<Self, String> {
        let corners = || zone.points.iter().map(|it| [f64::from(it.x), f64::from(it.y)]).collect();
        let shape = match zone.r#type.as_str() {
            "circle" if zone.radius > 0.0 => MonitorShape::Circle { radius_m: zone.radius },
            "polygon" if zone.points.len() >= MIN_CORNER_COUNT => MonitorShape::Polygon(corners()),
            _ => {
                return Err("it must be a `polygon` of at least 3 points or a `circle` with a \
                            radius above 0"
                    .to_owned());
            }
        };
        let heights_m = [zone.min_height, zone.max_height];
        Ok(Self {
            name: zone.zone_name.clone(),
            mask: ExclusionMask { shape, heights_m },
            is_enabled: zone.enabled,
            frame: zone.frame_id.clone(),
            frame_hold_ns: (zone.frame_hold_timeout * 1e9) as i64,
            output: publisher(node, &zone.zone_name, zone.visualize)
                .map_err(|why| why.to_string())?,
        })
    }

    /// Pose of the zone in the base frame. A frame that is not published for a short time is held
    /// where it was in the world.
    fn base_from_zone(&self, frames: &Frames<'_>) -> Option<Pose> {
        if self.frame.is_empty() || self.frame == frames.base {
            return Some(Pose::IDENTITY);
        }
        let (odom_from_zone, time_ns) = frames.tf.at(frames.odom, &self.frame, 0).ok()?;
        let max_age_ns = self.frame_hold_ns.max(frames.tolerance_ns);
        if time_ns != 0 && frames.now_ns - time_ns > max_age_ns {
            return None;
        }
        Some(frames.base_from_odom().ok()? * odom_from_zone)
    }

    /// Removes the points inside.
    pub(super) fn apply(&self, points: &mut Vec<CollisionPoint>, frames: &Frames<'_>) {
        if self.is_enabled
            && let Some(base_from_zone) = self.base_from_zone(frames)
        {
            exclude(points, &self.mask, base_from_zone);
        }
    }

    /// Publishes the shape for display.
    pub(super) fn publish(&self, frames: &Frames<'_>) {
        let Some(output) = self.output.as_ref().filter(|_| self.is_enabled) else { return };
        if let Some(base_from_zone) = self.base_from_zone(frames) {
            let corners = self.mask.outline(base_from_zone);
            output.publish(outline(&corners, frames.base, frames.now_ns));
        }
    }
}

fn publisher(
    node: &Node,
    name: &str,
    visualize: bool,
) -> Result<Option<Publisher<PolygonStamped>>, GraphError> {
    visualize.then(|| node.publisher(&format!("~/{name}"), Qos::reliable(10))).transpose()
}
