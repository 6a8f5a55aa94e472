//! Points as markers for `RViz`.

use periplus_motion::collision_monitor::{CollisionPoint, MonitorAction, SourcePoints};
use periplus_msgs::geometry_msgs::{Point, Vector3};
use periplus_msgs::std_msgs::ColorRGBA;
use periplus_msgs::visualization_msgs::{Marker, MarkerArray};

/// Size of a point that a source sees, and of one that triggers a zone \[m\].
const POINT_SIZE_M: f64 = 0.02;
const TRIGGER_SIZE_M: f64 = 0.05;

const RED: [f32; 3] = [1.0, 0.0, 0.0];

/// Colour of the points that cause an action.
pub(super) fn colour(action: MonitorAction) -> [f32; 3] {
    match action {
        MonitorAction::DoNothing => [0.0; 3],
        MonitorAction::Stop => RED,
        MonitorAction::Slowdown => [1.0, 1.0, 0.0],
        MonitorAction::Approach => [0.0, 0.5, 1.0],
        MonitorAction::Limit => [1.0, 0.5, 0.0],
    }
}

fn marker(frame: &str, namespace: String, colour: [f32; 3], size_m: f64) -> Marker {
    let [r, g, b] = colour;
    let mut marker = Marker {
        ns: namespace,
        r#type: Marker::POINTS,
        action: Marker::ADD,
        scale: Vector3 { x: size_m, y: size_m, z: 0.0 },
        color: ColorRGBA { r, g, b, a: 1.0 },
        frame_locked: true,
        ..Marker::default()
    };
    marker.header.frame_id = frame.to_owned();
    marker.pose.orientation.w = 1.0;
    marker
}

fn point(point: &CollisionPoint, has_height: bool) -> Point {
    Point { x: point.x_m, y: point.y_m, z: if has_height { point.z_m } else { 0.0 } }
}

/// Points of all sources, a marker for each.
pub(super) fn seen(points: &[SourcePoints], frame: &str, has_height: bool) -> MarkerArray {
    let each = points.iter().map(|source| {
        let namespace = format!("collision_points_{}", source.source);
        Marker {
            points: source.points.iter().map(|it| point(it, has_height)).collect(),
            ..marker(frame, namespace, RED, POINT_SIZE_M)
        }
    });
    MarkerArray { markers: each.collect() }
}

/// Points of all sources in one marker, as the detector publishes them.
pub(super) fn seen_in_one(points: &[SourcePoints], frame: &str, has_height: bool) -> MarkerArray {
    let all = points.iter().flat_map(|source| &source.points);
    let one = Marker {
        points: all.map(|it| point(it, has_height)).collect(),
        ..marker(frame, "collision_points".to_owned(), RED, POINT_SIZE_M)
    };
    MarkerArray { markers: vec![one] }
}

/// Points that trigger zones, with the name of the zone: a marker for each zone and source, after one
/// that removes those before.
pub(super) fn triggering(
    zones: &[(&str, &[(usize, CollisionPoint)])],
    seen: &[SourcePoints],
    frame: &str,
    colour: [f32; 3],
) -> MarkerArray {
    let mut markers = vec![Marker { action: Marker::DELETEALL, ..Marker::default() }];
    for (zone, points) in zones {
        for (index, source) in seen.iter().enumerate() {
            let own = points.iter().filter(|(from, _)| *from == index);
            let points: Vec<Point> = own.map(|(_, it)| point(it, true)).collect();
            if !points.is_empty() {
                let namespace = format!("{zone}/{}", source.source);
                markers.push(Marker { points, ..marker(frame, namespace, colour, TRIGGER_SIZE_M) });
            }
        }
    }
    MarkerArray { markers }
}
