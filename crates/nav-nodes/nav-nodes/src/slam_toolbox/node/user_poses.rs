//! Poses that a user sets: of the robot, on a stored map or during the run, and of keyframes.

use periplus_geometry::Pose2;
use periplus_graph::{Level, Node};
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::visualization_msgs::{InteractiveMarker, InteractiveMarkerFeedback};
use periplus_tf_ros::{plain, pose2};

use super::SlamNode;
use crate::slam_toolbox::engine::{Engine, Start};
use crate::slam_toolbox::markers;
use crate::slam_toolbox::messages::covariance;

impl SlamNode {
    /// Initial pose on the stored graph, by the rules of `slam_toolbox`: a given pose takes
    /// precedence over the dock, and an invalid one is replaced by the origin.
    pub(super) fn map_start(&self, node: &Node) -> Start {
        let dock = self.params.map_start_at_dock;
        match self.params.map_start_pose.as_slice() {
            [x_m, y_m, yaw_rad] => {
                if dock == Some(true) {
                    let words = "`map_start_at_dock` has no effect beside `map_start_pose`: take one \
                                 of them away";
                    node.log(Level::Warn, words);
                }
                Start::At(Pose2::new(*x_m, *y_m, *yaw_rad))
            }
            [] if dock == Some(false) => Start::At(Pose2::IDENTITY),
            [] => Start::First,
            others => {
                let words = format!(
                    "`map_start_pose` has {} numbers and needs three, [x, y, yaw] in m and rad; the \
                     robot starts at the origin of the map",
                    others.len()
                );
                node.log(Level::Error, words);
                Start::At(Pose2::IDENTITY)
            }
        }
    }

    /// Handles an initial pose.
    pub(super) fn set_pose(&mut self, message: &PoseWithCovarianceStamped, node: &Node) {
        if !self.program.is_toolbox() {
            node.log(
                Level::Warn,
                "the initial pose is ignored: each particle has its own map around its own pose, \
                 and cannot be moved on it; to set the pose on an existing map, localize on it, or \
                 run `slam_toolbox`",
            );
            return;
        }
        let names = self.names();
        let frame = plain(&message.header.frame_id);
        if !frame.is_empty() && frame != names.map {
            node.log(
                Level::Warn,
                format!(
                    "the initial pose is in `{frame}`, but must be in `{}`: it is ignored; select \
                     that frame where you set it",
                    names.map
                ),
            );
            return;
        }
        match pose2(&message.pose.pose) {
            Ok(pose) => {
                let is_placed = self
                    .engine
                    .as_mut()
                    .is_some_and(|it| it.place(pose, covariance(&message.pose.covariance)));
                let said = format!("({:.2}, {:.2}, {:.2})", pose.x_m, pose.y_m, pose.yaw_rad);
                if is_placed {
                    self.said = Some(pose);
                    let words =
                        format!("the initial pose is {said}; the next scan is matched around it");
                    node.log(Level::Info, words);
                } else {
                    let words = format!("there is no map yet for the initial pose {said}");
                    node.log(Level::Warn, words);
                }
            }
            Err(why) => node.log(Level::Warn, format!("the initial pose is refused: {why}")),
        }
    }

    /// Handles a dragged keyframe.
    pub(super) fn drag(&mut self, message: &InteractiveMarkerFeedback, node: &Node) {
        let is_move = [InteractiveMarkerFeedback::POSE_UPDATE, InteractiveMarkerFeedback::MOUSE_UP]
            .contains(&message.event_type);
        if !is_move {
            return;
        }
        let kept =
            self.engine.as_ref().and_then(Engine::graph).map_or(0, |slam| slam.poses().len());
        let key = message.marker_name.parse::<usize>().ok().filter(|&key| key < kept);
        let refusal = match (self.is_interactive, key, pose2(&message.pose)) {
            (false, _, _) => {
                "interactive mode is off: call `slam_toolbox/toggle_interactive_mode` \
                              first"
                    .to_owned()
            }
            (true, None, _) => format!(
                "`{}` is not a stored scan; they are numbered from 0, and there are {kept}",
                message.marker_name
            ),
            (true, Some(_), Err(error)) => error.to_string(),
            (true, Some(key), Ok(pose)) => {
                self.moved.insert(key, pose);
                return;
            }
        };
        node.log(Level::Warn, format!("a scan is not moved: {refusal}"));
    }

    /// Publishes the keyframes as handles while interactive mode is on.
    pub(crate) fn handles(&self, now_ns: i64) -> Vec<InteractiveMarker> {
        let graph = self.engine.as_ref().and_then(Engine::graph).filter(|_| self.is_interactive);
        graph.map_or_else(Vec::new, |slam| {
            markers::handles(slam, &self.moved, &self.names().map, now_ns)
        })
    }
}
