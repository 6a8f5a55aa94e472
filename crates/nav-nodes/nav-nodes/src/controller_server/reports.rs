//! Topics on which controllers show intermediate results.

use std::collections::BTreeMap;

use periplus_controllers::ControlReport;
use periplus_controllers::dwb::{LocalPlanEvaluation, TrajectoryScore};
use periplus_controllers::mppi::Mppi;
use periplus_costmap::Nav2Release;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{GraphError, Level, Node, Publisher, Qos};
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::{Point, PointStamped, Pose2D};
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs::CriticsStats;
use periplus_msgs::std_msgs::{Bool, Header};
use periplus_msgs::visualization_msgs::MarkerArray;
use periplus_msgs::{Message, dwb_msgs, dwb_msgs_main, nav_2d_msgs};
use periplus_tf_ros::pose;

use super::outputs::path;
use super::samples;

/// Publishers, created when a controller has a result for them.
pub(super) struct ReportPublishers {
    node: Node,
    forms: Nav2Release,
    points: BTreeMap<&'static str, Publisher<PointStamped>>,
    paths: BTreeMap<&'static str, Publisher<Path>>,
    flags: BTreeMap<&'static str, Publisher<Bool>>,
    markers: BTreeMap<&'static str, Publisher<MarkerArray>>,
    statistics: BTreeMap<&'static str, Publisher<CriticsStats>>,
    evaluation: BTreeMap<&'static str, Publisher<dwb_msgs::LocalPlanEvaluation>>,
    evaluation_main: BTreeMap<&'static str, Publisher<dwb_msgs_main::LocalPlanEvaluation>>,
}

/// Headers of the frames of reports.
pub(super) struct ReportFrames {
    /// Frame of the robot.
    pub(super) base: Header,
    /// Frame of the costmap.
    pub(super) global: Header,
}

impl ReportPublishers {
    pub(super) fn new(node: &Node, forms: Nav2Release) -> Self {
        Self {
            node: node.clone(),
            forms,
            points: BTreeMap::new(),
            paths: BTreeMap::new(),
            flags: BTreeMap::new(),
            markers: BTreeMap::new(),
            statistics: BTreeMap::new(),
            evaluation: BTreeMap::new(),
            evaluation_main: BTreeMap::new(),
        }
    }

    /// Publishes the results of a cycle.
    pub(super) fn publish(&mut self, report: &ControlReport<'_>, frames: &ReportFrames) {
        match report {
            ControlReport::PurePursuit(report) => {
                self.point("lookahead_point", &frames.base, Some(report.lookahead_point));
                let curvature = report.curvature_lookahead_point;
                self.point("curvature_lookahead_point", &frames.base, curvature);
                self.path("lookahead_collision_arc", &frames.global, &report.collision_arc);
                let data = report.is_rotating_to_heading;
                publish(&self.node, &mut self.flags, "is_rotating_to_heading", || Bool { data });
            }
            ControlReport::Graceful(report) => {
                self.point("motion_target", &frames.base, report.motion_target);
                self.path("local_plan", &frames.base, &report.local_plan);
            }
            ControlReport::Trajectories(evaluation) => {
                let best = evaluation.best().map(|best| best.trajectory.poses.as_slice());
                self.path("local_plan", &frames.global, best.unwrap_or_default());
                let header = &frames.global;
                if self.forms == Nav2Release::Main {
                    publish(&self.node, &mut self.evaluation_main, "evaluation", || {
                        evaluation_main(evaluation, header)
                    });
                } else {
                    publish(&self.node, &mut self.evaluation, "evaluation", || {
                        evaluation_before(evaluation, header)
                    });
                }
            }
            ControlReport::Samples(report) => self.samples(report.0, &frames.global),
            ControlReport::None => {}
        }
    }

    /// Trajectories and statistics of MPPI if `visualize` is set.
    fn samples(&mut self, mppi: &Mppi, header: &Header) {
        let is_main = self.forms == Nav2Release::Main;
        if mppi.values().flag("visualize") == Some(true) {
            let (trajectories, optimal) = if is_main {
                ("~/candidate_trajectories", "~/optimal_path")
            } else {
                ("/trajectories", "optimal_trajectory")
            };
            let node = &self.node;
            publish(node, &mut self.markers, trajectories, || samples::markers(mppi, header));
            publish(node, &mut self.paths, optimal, || path(header, &samples::optimal_path(mppi)));
            if is_main {
                publish(&self.node, &mut self.statistics, "~/critics_stats", || {
                    samples::statistics(mppi, header)
                });
            }
        }
    }

    fn point(&mut self, topic: &'static str, header: &Header, point: Option<Pose2>) {
        let Some(Pose2 { x_m, y_m, .. }) = point else { return };
        publish(&self.node, &mut self.points, topic, || PointStamped {
            header: header.clone(),
            // Slightly above the map, as Nav2 shows it.
            point: Point { x: x_m, y: y_m, z: 0.01 },
        });
    }

    fn path(&mut self, topic: &'static str, header: &Header, poses: &[Pose2]) {
        publish(&self.node, &mut self.paths, topic, || path(header, poses));
    }
}

/// Publishes a message if the topic has subscribers.
fn publish<T: Message>(
    node: &Node,
    publishers: &mut BTreeMap<&'static str, Publisher<T>>,
    topic: &'static str,
    message: impl FnOnce() -> T,
) {
    if !publishers.contains_key(topic) {
        let made: Result<Publisher<T>, GraphError> = node.publisher(topic, Qos::reliable(1));
        match made {
            Ok(publisher) => _ = publishers.insert(topic, publisher),
            Err(error) => return node.log(Level::Error, error),
        }
    }
    if let Some(publisher) = publishers.get(topic).filter(|publisher| publisher.is_heard()) {
        publisher.publish(message());
    }
}

fn index(index: Option<usize>) -> u16 {
    index.and_then(|index| u16::try_from(index).ok()).unwrap_or_default()
}

fn velocity(velocity: Twist2) -> nav_2d_msgs::Twist2D {
    nav_2d_msgs::Twist2D { x: velocity.vx_m_s, y: velocity.vy_m_s, theta: velocity.wz_rad_s }
}

fn times(times_s: &[f64]) -> Vec<Duration> {
    times_s.iter().map(|time_s| Duration::of_ns((time_s * 1e9) as i64)).collect()
}

fn scores(score: &TrajectoryScore) -> Vec<dwb_msgs::CriticScore> {
    let each = score.scores.iter().map(|critic| dwb_msgs::CriticScore {
        name: critic.name.to_string(),
        raw_score: critic.raw_score as f32,
        scale: critic.scale as f32,
    });
    each.collect()
}

fn evaluation_before(
    evaluation: &LocalPlanEvaluation,
    header: &Header,
) -> dwb_msgs::LocalPlanEvaluation {
    let twists = evaluation.twists.iter().map(|score| dwb_msgs::TrajectoryScore {
        traj: dwb_msgs::Trajectory2D {
            velocity: velocity(score.trajectory.velocity),
            time_offsets: times(&score.trajectory.times_s),
            poses: score
                .trajectory
                .poses
                .iter()
                .map(|it| Pose2D { x: it.x_m, y: it.y_m, theta: it.yaw_rad })
                .collect(),
        },
        scores: scores(score),
        total: score.total as f32,
    });
    dwb_msgs::LocalPlanEvaluation {
        header: header.clone(),
        twists: twists.collect(),
        best_index: index(evaluation.best_index),
        worst_index: index(evaluation.worst_index),
    }
}

fn evaluation_main(
    evaluation: &LocalPlanEvaluation,
    header: &Header,
) -> dwb_msgs_main::LocalPlanEvaluation {
    let twists = evaluation.twists.iter().map(|score| dwb_msgs_main::TrajectoryScore {
        traj: dwb_msgs_main::Trajectory2D {
            velocity: velocity(score.trajectory.velocity),
            time_offsets: times(&score.trajectory.times_s),
            poses: score.trajectory.poses.iter().map(|it| pose(*it)).collect(),
        },
        scores: scores(score),
        total: score.total as f32,
    });
    dwb_msgs_main::LocalPlanEvaluation {
        header: header.clone(),
        twists: twists.collect(),
        best_index: index(evaluation.best_index),
        worst_index: index(evaluation.worst_index),
    }
}
