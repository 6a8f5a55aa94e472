//! Samples of MPPI as markers, path and statistics.
//!
//! Source of names: `nav2_mppi_controller/src/trajectory_visualizer.cpp` (main, jazzy).

use periplus_controllers::mppi::{CandidateTrajectory, Mppi};
use periplus_geometry::Pose2;
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::{Point, Quaternion, Vector3};
use periplus_msgs::nav2_msgs::CriticsStats;
use periplus_msgs::std_msgs::{ColorRGBA, Header};
use periplus_msgs::visualization_msgs::{Marker, MarkerArray};

/// Width of the lines \[m\].
const LINE_WIDTH_M: f64 = 0.01;

/// Width of the line of the optimal trajectory \[m\].
const OPTIMAL_WIDTH_M: f64 = 0.03;

/// Height of the lines above the map \[m\].
const LINE_HEIGHT_M: f64 = 0.03;

/// Time after which the lines disappear, unless a later cycle replaces them \[ns\]: after the end of a goal none is left.
/// Those of Nav2 stay.
const LIFETIME_NS: i64 = 500_000_000;

/// Lines of the samples, green for low costs and red for high ones or a collision, and of the optimal trajectory.
pub(super) fn markers(mppi: &Mppi, header: &Header) -> MarkerArray {
    let mut markers: Vec<Marker> = mppi
        .candidates()
        .iter()
        .map(|candidate| {
            let name = "Candidate Trajectories";
            line(header, name, candidate.sample, LINE_WIDTH_M, color(candidate), &candidate.poses)
        })
        .collect();
    let blue = ColorRGBA { r: 0.0, g: 0.5, b: 1.0, a: 1.0 };
    let optimal = optimal_path(mppi);
    markers.push(line(header, "Optimal Trajectory", 0, OPTIMAL_WIDTH_M, blue, &optimal));
    MarkerArray { markers }
}

/// Poses of the optimal trajectory, in the frame of the costmap.
pub(super) fn optimal_path(mppi: &Mppi) -> Vec<Pose2> {
    mppi.optimal_trajectory().iter().map(|point| point.pose).collect()
}

/// Statistics of the critics.
pub(super) fn statistics(mppi: &Mppi, header: &Header) -> CriticsStats {
    let statistics = mppi.statistics();
    CriticsStats {
        stamp: header.stamp.clone(),
        critics: statistics.iter().map(|one| one.critic.name().to_owned()).collect(),
        changed: statistics.iter().map(|one| one.has_changed).collect(),
        costs_sum: statistics.iter().map(|one| one.costs_sum).collect(),
    }
}

fn color(candidate: &CandidateTrajectory) -> ColorRGBA {
    if candidate.collides {
        return ColorRGBA { r: 1.0, g: 0.0, b: 0.0, a: 0.3 };
    }
    let red = candidate.relative_cost.clamp(0.0, 1.0);
    ColorRGBA { r: red, g: 1.0 - red, b: 0.0, a: 1.0 }
}

fn line(
    header: &Header,
    name: &str,
    id: usize,
    width_m: f64,
    color: ColorRGBA,
    poses: &[Pose2],
) -> Marker {
    let mut marker = Marker {
        header: header.clone(),
        ns: name.to_owned(),
        id: i32::try_from(id).unwrap_or(i32::MAX),
        r#type: Marker::LINE_STRIP,
        action: Marker::ADD,
        scale: Vector3 { x: width_m, y: 0.0, z: 0.0 },
        color,
        lifetime: Duration::of_ns(LIFETIME_NS),
        points: poses
            .iter()
            .map(|pose| Point { x: pose.x_m, y: pose.y_m, z: LINE_HEIGHT_M })
            .collect(),
        ..Marker::default()
    };
    marker.pose.orientation = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };
    marker
}
