//! Estimated motion of the robot: localization, odometry, and the distance from the planned path.

use periplus_evaluation::{StampedPose, Trajectory};
use periplus_geometry::{Pose, Pose2};
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_sim::Simulation;
use periplus_tf::TransformKind;
use periplus_tf_ros::{Frames, pose2};

/// Time between two samples \[ns\].
const SAMPLE_PERIOD_NS: i64 = 100_000_000;

/// Messages with transforms that wait between two samples.
const TRANSFORM_DEPTH: usize = 10_000;

/// Frames of the robot and of its map.
#[derive(Clone, Debug)]
pub(super) struct EstimateFrames {
    pub(super) map: Option<String>,
    pub(super) odom: String,
    pub(super) base: String,
    /// `world_from_map` of a perfect estimate.
    pub(super) world_from_map: Pose2,
}

/// Estimates of a running robot.
pub(super) struct Estimates {
    frames: EstimateFrames,
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    plans: Option<Mailbox<Path>>,
    plan: Vec<[f64; 2]>,
    buffer: Frames,
    next_ns: i64,
    in_map: Vec<StampedPose>,
    in_odom: Vec<StampedPose>,
    tracking_errors_m: Vec<f64>,
}

/// Estimates of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct EstimateRecord {
    /// Poses by the estimate in the map, converted to the world.
    pub(crate) localization: Trajectory,
    /// Poses in the odometry frame.
    pub(crate) odometry: Trajectory,
    /// Distances of the true position from the planned path \[m\], while there was a goal.
    pub(crate) tracking_errors_m: Vec<f64>,
}

impl Estimates {
    pub(super) fn new(
        node: &Node,
        frames: EstimateFrames,
        has_plans: bool,
    ) -> Result<Self, GraphError> {
        let plans = has_plans.then(|| node.mailbox("/plan", Qos::reliable(1)));
        Ok(Self {
            frames,
            moving: node.mailbox("/tf", Qos::best_effort(TRANSFORM_DEPTH))?,
            fixed: node.mailbox("/tf_static", Qos::latched(TRANSFORM_DEPTH))?,
            plans: plans.transpose()?,
            plan: Vec::new(),
            buffer: Frames::default(),
            next_ns: 0,
            in_map: Vec::new(),
            in_odom: Vec::new(),
            tracking_errors_m: Vec::new(),
        })
    }

    /// Takes a sample if one is due. `has_goal` is true while the robot drives to a goal.
    pub(super) fn sample(&mut self, simulation: &Simulation, has_goal: bool) {
        if simulation.time_ns() < self.next_ns {
            return;
        }
        self.next_ns = simulation.time_ns() + SAMPLE_PERIOD_NS;
        for message in self.fixed.drain() {
            self.buffer.take(&message, TransformKind::Fixed);
        }
        for message in self.moving.drain() {
            self.buffer.take(&message, TransformKind::Moving);
        }
        let EstimateFrames { map, odom, base, world_from_map } = &self.frames;
        if let Some(map) = map
            && let Ok((pose, time_ns)) = self.buffer.at(map, base, 0)
            && time_ns > 0
        {
            let pose = Pose::from(*world_from_map) * pose;
            self.in_map.push(StampedPose { stamp_s: time_ns as f64 * 1e-9, pose });
        }
        if let Ok((pose, time_ns)) = self.buffer.at(odom, base, 0)
            && time_ns > 0
        {
            self.in_odom.push(StampedPose { stamp_s: time_ns as f64 * 1e-9, pose });
        }
        self.sample_tracking(simulation, has_goal);
    }

    fn sample_tracking(&mut self, simulation: &Simulation, has_goal: bool) {
        let Some(plans) = &self.plans else { return };
        if let Some(plan) = plans.latest() {
            let in_world = |pose: Pose2| {
                let pose = self.frames.world_from_map * pose;
                [pose.x_m, pose.y_m]
            };
            let poses = plan.poses.iter().filter_map(|pose| pose2(&pose.pose).ok());
            self.plan = poses.map(in_world).collect();
        }
        if !has_goal {
            self.plan.clear();
        }
        let Some(robot) = simulation.robot_pose() else { return };
        let at = [robot.translation.x, robot.translation.y];
        self.tracking_errors_m.extend(distance_m(at, &self.plan));
    }

    pub(super) fn finish(self) -> EstimateRecord {
        EstimateRecord {
            localization: Trajectory::new(self.in_map),
            odometry: Trajectory::new(self.in_odom),
            tracking_errors_m: self.tracking_errors_m,
        }
    }
}

/// Distance of a point from a line of segments \[m\]; `None` without a point on it.
fn distance_m([x, y]: [f64; 2], line: &[[f64; 2]]) -> Option<f64> {
    let [first, ..] = line else { return None };
    let to_point = libm::hypot(x - first[0], y - first[1]);
    let to_segment = |ends: &[[f64; 2]]| {
        let ([ax, ay], [bx, by]) = (ends[0], ends[1]);
        let (along_x, along_y) = (bx - ax, by - ay);
        let square = along_x * along_x + along_y * along_y;
        let part = if square > 0.0 {
            (((x - ax) * along_x + (y - ay) * along_y) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        libm::hypot(x - ax - part * along_x, y - ay - part * along_y)
    };
    Some(line.windows(2).map(to_segment).fold(to_point, f64::min))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_is_that_of_the_nearest_segment() {
        let line = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
        assert_eq!(distance_m([1.0, 0.5], &line), Some(0.5));
        assert_eq!(distance_m([2.25, 1.0], &line), Some(0.25));
        assert_eq!(distance_m([-3.0, 4.0], &line), Some(5.0));
        assert_eq!(distance_m([1.0, 0.0], &[[0.0, 0.0]]), Some(1.0));
        assert_eq!(distance_m([1.0, 0.0], &[]), None);
    }
}
