//! Zones and the topics of their shapes.

use std::sync::Arc;

use periplus_costmap::Nav2Release;
use periplus_geometry::{DVec3, Pose};
use periplus_graph::{GraphError, Mailbox, Node, Publisher, Qos};
use periplus_motion::collision_monitor::{
    ApproachLimits, MonitorShape, MonitorZone, TriggerFilter, VelocityPart, VelocityParts,
    ZoneAction, read_corners,
};
use periplus_motion::tables::{MonitorZoneParams, VelocityPartParams};
use periplus_msgs::geometry_msgs::{Point32, PolygonStamped};
use periplus_msgs::std_msgs::{Float32, Header};
use periplus_params::ParamValues;

use crate::costmap_2d::frames::Listener;
use crate::costmap_subscriber::FootprintSubscriber;

use super::config::MonitorZoneConfig;

/// Minimum number of corners of a zone; the value of Nav2.
const MIN_CORNER_COUNT: usize = 4;

/// Topic from which a shape is received.
enum ShapeInput {
    /// None: the shape is a parameter.
    Fixed,
    /// Polygons, in any frame; the last one is kept.
    Polygon(Mailbox<PolygonStamped>, Option<Arc<PolygonStamped>>),
    /// Radius of a circle.
    Radius(Mailbox<Float32>),
    /// Footprint of the robot.
    Footprint(FootprintSubscriber),
}

/// Topics of a zone.
pub(super) struct ZonePort {
    input: ShapeInput,
    output: Option<Publisher<PolygonStamped>>,
}

/// Creates a zone and its topics.
///
/// # Errors
/// The mistake in the parameters.
pub(super) fn open(
    node: &Node,
    config: &MonitorZoneConfig,
    all_sources: &[String],
    release: Nav2Release,
) -> Result<(MonitorZone, ZonePort), String> {
    let (name, params) = (&config.name, config.params());
    let action = action(name, &params, release)?;
    let sources = params.sources_names.clone().unwrap_or_else(|| all_sources.to_vec());
    if let Some(unknown) = sources.iter().find(|source| !all_sources.contains(source)) {
        return Err(format!("`{name}.sources_names`: `{unknown}` is no observation source"));
    }
    let mut zone = MonitorZone { sources, ..MonitorZone::new(name, action, 1) };
    let input = match params.shape_type.as_str() {
        "polygon" => polygon(node, name, &params, &mut zone, release)?,
        "circle" => circle(node, name, &params, &mut zone)?,
        "velocity_polygon" if release != Nav2Release::Humble => {
            zone.parts = Some(parts(name, &params, &config.parts)?);
            ShapeInput::Fixed
        }
        other => {
            return Err(format!(
                "`{name}.type`: `{other}` is not one of `polygon`, `circle`, `velocity_polygon`"
            ));
        }
    };
    adopt(&mut zone, &params, release);
    let topic = params.polygon_pub_topic.as_deref().unwrap_or(name);
    let output = params.visualize.then(|| node.publisher(topic, Qos::reliable(10))).transpose();
    Ok((zone, ZonePort { input, output: output.map_err(|error| error.to_string())? }))
}

fn action(
    name: &str,
    params: &MonitorZoneParams,
    release: Nav2Release,
) -> Result<ZoneAction, String> {
    match params.action_type.as_str() {
        "stop" => Ok(ZoneAction::Stop),
        "slowdown" => Ok(ZoneAction::Slowdown { ratio: params.slowdown_ratio }),
        "limit" if release != Nav2Release::Humble => Ok(ZoneAction::Limit {
            linear_m_s: params.linear_limit_m_s,
            angular_rad_s: params.angular_limit_rad_s,
        }),
        "approach" => Ok(ZoneAction::Approach(ApproachLimits {
            time_before_collision_s: params.time_before_collision_s,
            simulation_time_step_s: params.simulation_time_step_s,
        })),
        "none" if release != Nav2Release::Humble => Ok(ZoneAction::None),
        other => Err(format!(
            "`{name}.action_type`: `{other}` is no action of Nav2 {release}; write `stop`, \
             `slowdown`, `limit`, `approach` or `none`"
        )),
    }
}

/// Applies the parameters that can change while the node runs.
pub(super) fn adopt(zone: &mut MonitorZone, params: &MonitorZoneParams, release: Nav2Release) {
    // In Humble `max_points` is 3 by default, which is the same as `min_points` 4.
    let min_points = params.max_points.map_or(params.min_points, |max| max.saturating_add(1));
    let min_points = usize::try_from(min_points.max(1)).unwrap_or(1);
    let count = |number: i64| usize::try_from(number).unwrap_or(1);
    let filter = TriggerFilter::new(
        count(params.trigger_consecutive_points),
        count(params.release_consecutive_points),
    );
    if zone.min_points != min_points || zone.is_enabled != params.is_enabled {
        zone.filter.reset();
    }
    let mut fresh = zone.filter;
    fresh.reset();
    if fresh != filter {
        zone.filter = filter;
    }
    zone.min_points = min_points;
    zone.min_points_at_once =
        if release == Nav2Release::Humble { min_points - 1 } else { min_points };
    zone.is_enabled = params.is_enabled;
}

fn polygon(
    node: &Node,
    name: &str,
    params: &MonitorZoneParams,
    zone: &mut MonitorZone,
    release: Nav2Release,
) -> Result<ShapeInput, String> {
    let text = params.points.trim();
    let mistake = match read_corners(text, MIN_CORNER_COUNT) {
        Ok(corners) => {
            zone.shape = Some(MonitorShape::Polygon(corners));
            return Ok(ShapeInput::Fixed);
        }
        Err(_) if text.is_empty() => "it is not set".to_owned(),
        Err(error) => error.to_string(),
    };
    let opened = if matches!(zone.action, ZoneAction::Approach(_)) {
        FootprintSubscriber::new(node, &params.footprint_topic).map(ShapeInput::Footprint)
    } else if let Some(topic) = params.polygon_sub_topic.as_deref()
        && release != Nav2Release::Humble
    {
        mailbox(node, topic, params).map(|mailbox| ShapeInput::Polygon(mailbox, None))
    } else {
        return Err(format!(
            "`{name}.points`: {mistake}; write \"[[x, y], ...]\" with at least \
             {MIN_CORNER_COUNT} corners, or set `{name}.polygon_sub_topic`"
        ));
    };
    opened.map_err(|error| error.to_string())
}

fn circle(
    node: &Node,
    name: &str,
    params: &MonitorZoneParams,
    zone: &mut MonitorZone,
) -> Result<ShapeInput, String> {
    if let Some(radius_m) = params.radius_m {
        zone.shape = Some(MonitorShape::Circle { radius_m });
        return Ok(ShapeInput::Fixed);
    }
    let Some(topic) = params.polygon_sub_topic.as_deref() else {
        return Err(format!("set `{name}.radius`, or `{name}.polygon_sub_topic` to receive it"));
    };
    mailbox(node, topic, params).map(ShapeInput::Radius).map_err(|error| error.to_string())
}

fn mailbox<T: periplus_msgs::Message>(
    node: &Node,
    topic: &str,
    params: &MonitorZoneParams,
) -> Result<Mailbox<T>, GraphError> {
    let is_latched = params.polygon_subscribe_transient_local;
    node.mailbox(topic, if is_latched { Qos::latched(1) } else { Qos::reliable(1) })
}

fn parts(
    name: &str,
    params: &MonitorZoneParams,
    configs: &[(String, ParamValues)],
) -> Result<VelocityParts, String> {
    let part = |(part, values): &(String, ParamValues)| {
        let for_message = |error| format!("`{name}.{part}.points`: {error}");
        let params = VelocityPartParams::from_values(values);
        let corners = read_corners(&params.points, MIN_CORNER_COUNT).map_err(for_message)?;
        Ok(VelocityPart {
            corners,
            linear_m_s: [params.linear_min_m_s, params.linear_max_m_s],
            theta_rad_s: [params.theta_min_rad_s, params.theta_max_rad_s],
            direction_rad: [params.direction_start_rad, params.direction_end_rad],
        })
    };
    if configs.is_empty() {
        return Err(format!("`{name}.velocity_polygons` names no parts"));
    }
    let parts = configs.iter().map(part).collect::<Result<_, String>>()?;
    Ok(VelocityParts { parts, is_holonomic: params.is_holonomic })
}

impl ZonePort {
    /// Processes received shapes.
    pub(super) fn receive(&mut self, zone: &mut MonitorZone, tf: &Listener, base_frame: &str) {
        match &mut self.input {
            ShapeInput::Fixed => {}
            ShapeInput::Radius(radii) => {
                if let Some(radius) = radii.latest() {
                    zone.shape = Some(MonitorShape::Circle { radius_m: radius.data.into() });
                    zone.filter.reset();
                }
            }
            ShapeInput::Footprint(footprint) => {
                footprint.receive(tf, base_frame);
                let corners = footprint.latest().map(|it| it.points().to_vec());
                zone.shape = corners.map(MonitorShape::Polygon);
            }
            ShapeInput::Polygon(polygons, kept) => {
                if let Some(polygon) =
                    polygons.latest().filter(|polygon| polygon.polygon.points.len() > 2)
                {
                    *kept = Some(polygon);
                    zone.filter.reset();
                }
                let placed = kept.as_ref().and_then(|it| place(it, tf, base_frame));
                if let Some(corners) = placed {
                    zone.shape = Some(MonitorShape::Polygon(corners));
                }
            }
        }
    }

    /// Publishes the shape for display.
    pub(super) fn publish(&self, zone: &MonitorZone, base_frame: &str, now_ns: i64) {
        let (Some(output), Some(shape)) = (&self.output, &zone.shape) else { return };
        output.publish(outline(&shape.outline(), base_frame, now_ns));
    }
}

/// Message of corners.
pub(super) fn outline(corners: &[[f64; 2]], frame: &str, now_ns: i64) -> PolygonStamped {
    let point = |[x, y]: &[f64; 2]| Point32 { x: *x as f32, y: *y as f32, z: 0.0 };
    let mut message =
        PolygonStamped { header: Header::at(now_ns, frame), ..PolygonStamped::default() };
    message.polygon.points = corners.iter().map(point).collect();
    message
}

/// Corners of a polygon in the base frame now.
fn place(polygon: &PolygonStamped, tf: &Listener, base_frame: &str) -> Option<Vec<[f64; 2]>> {
    let frame = polygon.header.frame_id.as_str();
    let base_from_frame = if frame == base_frame || frame.is_empty() {
        Pose::IDENTITY
    } else {
        tf.at(base_frame, frame, 0).ok()?.0
    };
    let corner = |point: &Point32| {
        let point = DVec3::new(point.x.into(), point.y.into(), 0.0);
        let placed = base_from_frame.transform_point(point);
        [placed.x, placed.y]
    };
    Some(polygon.polygon.points.iter().map(corner).collect())
}
