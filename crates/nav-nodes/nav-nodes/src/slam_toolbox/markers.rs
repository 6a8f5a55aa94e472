//! The pose graph as markers for `RViz`.

use std::collections::BTreeMap;

use periplus_geometry::Pose2;
use periplus_msgs::geometry_msgs::{Point, Quaternion, Vector3};
use periplus_msgs::std_msgs::ColorRGBA;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::visualization_msgs::{
    InteractiveMarker, InteractiveMarkerControl, Marker, MarkerArray,
};
use periplus_slam::{ConstraintKind, MapContradiction, Slam};
use periplus_tf_ros::pose;

/// Colours: kept scans, those moved by hand, chains, ties, closures, closures that were refused.
const NODE: [f32; 3] = [1.0, 0.1, 0.1];
const MOVED: [f32; 3] = [1.0, 0.6, 0.0];
const CHAIN: [f32; 3] = [0.2, 0.4, 1.0];
const TIE: [f32; 3] = [0.1, 0.7, 0.3];
const CLOSURE: [f32; 3] = [0.9, 0.8, 0.1];
const REFUSED: [f32; 3] = [0.8, 0.2, 0.8];
/// Contradictions of the map, their radius and the corners of a ring.
const CONTRADICTION: [f32; 3] = [1.0, 0.0, 0.0];
const RING_M: f64 = 1.5;
const RING_CORNERS: u32 = 32;
/// Number of newest closures labelled with their reasons.
const TOLD: usize = 30;

/// The graph: a sphere for each kept scan, lines for the constraints, and the decisions on the
/// newest loop closures, with the reason as text.
pub(crate) fn graph(
    slam: &Slam,
    moved: &BTreeMap<usize, Pose2>,
    frame: &str,
    time_ns: i64,
) -> MarkerArray {
    let poses = slam.poses();
    let place = |key: usize| poses.get(key).map(|pose| point(*pose));
    let base = |ns: &str, id: usize, r#type: i32, colour: [f32; 3], size_m: f64| {
        marker((frame, time_ns), (ns, id), r#type, colour, size_m)
    };
    let mut markers = vec![nothing((frame, time_ns))];
    let mut spheres = base("slam_toolbox", 0, Marker::SPHERE_LIST, NODE, 0.1);
    spheres.points = poses.iter().map(|pose| point(*pose)).collect();
    markers.push(spheres);
    if !moved.is_empty() {
        let mut spheres = base("moved", 0, Marker::SPHERE_LIST, MOVED, 0.15);
        spheres.points = moved.values().map(|pose| point(*pose)).collect();
        markers.push(spheres);
    }
    for (ns, wanted, colour) in [
        ("chain", ConstraintKind::Sequential, CHAIN),
        ("ties", ConstraintKind::Proximity, TIE),
        ("closures", ConstraintKind::LoopClosure, CLOSURE),
    ] {
        let mut lines = base(ns, 0, Marker::LINE_LIST, colour, 0.02);
        let between = slam.links().filter(|(_, _, link)| *link == wanted);
        lines.points =
            between.flat_map(|(from, to, _)| [place(from), place(to)]).flatten().collect();
        if !lines.points.is_empty() {
            markers.push(lines);
        }
    }
    let closures = slam.closures();
    let mut refused = base("refused_closures", 0, Marker::LINE_LIST, REFUSED, 0.01);
    for (id, closure) in closures.iter().rev().take(TOLD).enumerate() {
        let (Some(old), Some(new)) = (place(closure.keyframes.0), place(closure.keyframes.1))
        else {
            continue;
        };
        let colour = if closure.is_accepted { CLOSURE } else { REFUSED };
        let mut text = base("reasons", id, Marker::TEXT_VIEW_FACING, colour, 0.2);
        text.pose.position = Point { x: 0.5 * (old.x + new.x), y: 0.5 * (old.y + new.y), z: 0.3 };
        let verdict = if closure.is_accepted { "closed" } else { "refused" };
        text.text = format!(
            "{} - {} {verdict}: {}",
            closure.keyframes.0, closure.keyframes.1, closure.reason
        );
        markers.push(text);
        if !closure.is_accepted {
            refused.points.extend([old, new]);
        }
    }
    if !refused.points.is_empty() {
        markers.push(refused);
    }
    MarkerArray { markers }
}

/// Contradictions: a ring around each position, the stretch of path, and a text with the agreement and the
/// times of both passes. Without one, all earlier markers are deleted.
pub(crate) fn contradictions(
    found: &[MapContradiction],
    times: &[String],
    poses: &[Pose2],
    frame: &str,
    time_ns: i64,
) -> MarkerArray {
    let at = (frame, time_ns);
    let mut markers = vec![nothing(at)];
    for (id, (found, times)) in found.iter().zip(times).enumerate() {
        let Point { x, y, .. } = point(found.map_from_base);
        let mut ring = marker(at, ("places", id), Marker::LINE_STRIP, CONTRADICTION, 0.08);
        ring.points = (0..=RING_CORNERS)
            .map(|corner| {
                let angle_rad = f64::from(corner) * std::f64::consts::TAU / f64::from(RING_CORNERS);
                let (sine, cosine) = libm::sincos(angle_rad);
                Point { x: x + RING_M * cosine, y: y + RING_M * sine, z: 0.05 }
            })
            .collect();
        markers.push(ring);
        for (ns, (first, last)) in
            [("passes", found.keyframes), ("earlier_passes", found.earlier_keyframes)]
        {
            let stretch = poses.get(first..=last).unwrap_or_default();
            if stretch.len() > 1 {
                let mut line = marker(at, (ns, id), Marker::LINE_STRIP, CONTRADICTION, 0.05);
                line.points = stretch.iter().map(|pose| point(*pose)).collect();
                markers.push(line);
            }
        }
        let mut text = marker(at, ("reasons", id), Marker::TEXT_VIEW_FACING, CONTRADICTION, 0.3);
        text.pose.position = Point { x, y, z: 0.5 };
        text.text = format!(
            "contradiction: {:.0} % of what both passes see agrees\n{times}",
            100.0 * found.agreeing_ratio
        );
        markers.push(text);
    }
    MarkerArray { markers }
}

/// A marker in a frame at a time, with its name, colour and size.
fn marker(
    (frame, time_ns): (&str, i64),
    (ns, id): (&str, usize),
    r#type: i32,
    colour: [f32; 3],
    size_m: f64,
) -> Marker {
    Marker {
        header: Header::at(time_ns, frame),
        ns: ns.to_owned(),
        id: i32::try_from(id).unwrap_or(i32::MAX),
        r#type,
        action: Marker::ADD,
        pose: pose(Pose2::IDENTITY),
        scale: Vector3 { x: size_m, y: size_m, z: size_m },
        color: ColorRGBA { r: colour[0], g: colour[1], b: colour[2], a: 1.0 },
        ..Marker::default()
    }
}

/// Deletes all earlier markers.
fn nothing((frame, time_ns): (&str, i64)) -> Marker {
    Marker {
        header: Header::at(time_ns, frame),
        action: Marker::DELETEALL,
        pose: pose(Pose2::IDENTITY),
        ..Marker::default()
    }
}

/// Keyframes as handles that can be dragged in the plane and rotated, by their numbers.
pub(crate) fn handles(
    slam: &Slam,
    moved: &BTreeMap<usize, Pose2>,
    frame: &str,
    time_ns: i64,
) -> Vec<InteractiveMarker> {
    // A control acts in the plane perpendicular to its x axis: here the floor.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let orientation = Quaternion { x: 0.0, y: half, z: 0.0, w: half };
    let handle = |(key, place): (usize, &Pose2)| {
        let place = moved.get(&key).unwrap_or(place);
        let colour = if moved.contains_key(&key) { MOVED } else { NODE };
        let sphere = Marker {
            r#type: Marker::SPHERE,
            scale: Vector3 { x: 0.15, y: 0.15, z: 0.15 },
            color: ColorRGBA { r: colour[0], g: colour[1], b: colour[2], a: 1.0 },
            ..Marker::default()
        };
        InteractiveMarker {
            header: Header::at(time_ns, frame),
            pose: pose(*place),
            name: key.to_string(),
            description: String::new(),
            scale: 0.5,
            controls: vec![InteractiveMarkerControl {
                name: "ground".to_owned(),
                orientation: orientation.clone(),
                interaction_mode: InteractiveMarkerControl::MOVE_ROTATE,
                always_visible: true,
                markers: vec![sphere],
                ..InteractiveMarkerControl::default()
            }],
            ..InteractiveMarker::default()
        }
    };
    slam.poses().iter().enumerate().map(handle).collect()
}

fn point(pose: Pose2) -> Point {
    Point { x: pose.x_m, y: pose.y_m, z: 0.0 }
}
