//! Nodes of a rerun.

use std::path::Path;
use std::sync::Arc;

use periplus_bags::files::Bag;
use periplus_geometry::Pose2;
use periplus_graph::{Graph, LifecycleNode, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_localization::AmclParams;
use periplus_maps::{Distro, load};
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::rcl_interfaces::{ParameterType, ParameterValue};
use periplus_nav_nodes::costmap_2d::CostmapNode;
use periplus_nav_nodes::slam_toolbox::{Pace, Program, SlamNode};
use periplus_os::Machine;
use periplus_params::ParamValue;
use periplus_slam::tables::SlamToolboxParams;
use periplus_tf_ros::pose2;

use super::error::RerunError;
use super::parameters::{MAP_FILE, RerunParameters, costmap_configs, given_to};
use super::robot::RecordedRobot;
use super::trajectory::TrajectoryPublisher;
use crate::error::RunError;
use crate::nodes::Localization;
use crate::recorded::each;

/// Scans without transforms that are no problem: the first ones, before the first odometry.
const MAX_DROPPED_COUNT: u64 = 10;

/// Running estimators.
pub(super) enum Estimator {
    Slam(SlamRerun),
    Amcl(AmclRerun),
    Costmap(Vec<LifecycleNode<CostmapNode>>),
}

/// The node of `slam_toolbox`.
pub(super) struct SlamRerun {
    graph: Graph,
    node: LifecycleNode<SlamNode>,
    trajectory: TrajectoryPublisher,
}

/// `amcl` with its map.
pub(super) struct AmclRerun {
    graph: Graph,
    localization: Localization,
    poses: Mailbox<PoseWithCovarianceStamped>,
    /// Stamps \[ns\] and poses in the map.
    trajectory: Vec<(i64, Pose2)>,
    publisher: TrajectoryPublisher,
    _map: Option<(Node, Publisher<OccupancyGrid>)>,
}

impl Estimator {
    pub(super) fn start(
        graph: &Graph,
        parameters: &RerunParameters,
        bag: &Bag,
        robot: &RecordedRobot,
    ) -> Result<Self, RerunError> {
        match parameters {
            RerunParameters::Slam(values) => {
                let frame = SlamToolboxParams::from_values(values).map_frame;
                let files = Arc::new(Machine);
                let node = SlamNode::new(graph, Program::Async, values.clone(), files, Pace::Whole)
                    .map_err(|error| RunError::node(Program::Async.executable(), error))?;
                node.start();
                let trajectory = TrajectoryPublisher::new(graph, frame)?;
                Ok(Self::Slam(SlamRerun { graph: graph.clone(), node, trajectory }))
            }
            RerunParameters::Amcl { values, map_file } => {
                let params = AmclParams::from_values(values);
                let map = match map_file {
                    Some(path) => {
                        check_map(path)?;
                        None
                    }
                    None => Some(publish_map(graph, bag, (robot, params.map_topic.as_str()))?),
                };
                let localization = Localization::new(graph, map_file.as_deref(), values.clone())
                    .map_err(|error| RunError::node("amcl", error))?;
                let node = graph.node(NodeSettings::new("rerun_poses").bare().keep_names())?;
                Ok(Self::Amcl(AmclRerun {
                    graph: graph.clone(),
                    localization,
                    poses: node.mailbox("/amcl_pose", Qos::reliable(1000))?,
                    trajectory: Vec::new(),
                    publisher: TrajectoryPublisher::new(graph, params.global_frame_id)?,
                    _map: map,
                }))
            }
            RerunParameters::Costmap { given, profile } => {
                let mut nodes = Vec::new();
                for (name, config) in costmap_configs(profile)? {
                    let mut settings = NodeSettings::new(name).namespace(&format!("/{name}"));
                    for (parameter, value) in given_to(given, name) {
                        settings = settings.parameter(parameter, parameter_value(value.clone()));
                    }
                    let node = CostmapNode::at(graph.node(settings)?, config)
                        .map_err(|error| RunError::node(name, error))?;
                    node.start();
                    nodes.push(node);
                }
                Ok(Self::Costmap(nodes))
            }
        }
    }

    /// Publishes what is due at the time of the graph.
    pub(super) fn observe(&mut self) {
        self.publish(false);
    }

    /// Publishes the final estimates.
    pub(super) fn finish(&mut self) {
        self.publish(true);
        if let Self::Slam(slam) = self {
            slam.node.with(|node| node.publish_present_map());
        }
    }

    fn publish(&mut self, is_end: bool) {
        match self {
            Self::Slam(slam) => {
                let poses = || slam.node.with(|node| node.graph().map(|graph| graph.trajectory()));
                let now_ns = slam.graph.now_ns();
                slam.trajectory.publish(now_ns, is_end, || poses().unwrap_or_default());
            }
            Self::Amcl(amcl) => {
                for message in amcl.poses.drain() {
                    if let Ok(pose) = pose2(&message.pose.pose) {
                        amcl.trajectory.push((message.header.stamp.ns(), pose));
                    }
                }
                let trajectory = &amcl.trajectory;
                amcl.publisher.publish(amcl.graph.now_ns(), is_end, || trajectory.clone());
            }
            Self::Costmap(_) => {}
        }
    }

    /// Returns the reasons for which there is no estimate.
    pub(super) fn problems(&self) -> Vec<String> {
        match self {
            Self::Slam(slam) => {
                let status = slam.node.with(|node| node.status());
                let mut problems = Vec::new();
                // The trouble at the end, such as a recording without scans in its last seconds, is none of the map.
                if status.counts.kept <= 1 {
                    problems.extend(status.trouble);
                    problems.push(format!("the map contains {} scans", status.counts.kept));
                }
                if status.dropped > MAX_DROPPED_COUNT {
                    problems.push(format!("{} scans had no transforms", status.dropped));
                }
                problems
            }
            Self::Amcl(amcl) => {
                let mut problems = Vec::new();
                if amcl.trajectory.is_empty() {
                    let node = amcl.localization.amcl();
                    problems.extend(node.with(|node| node.trouble().map(str::to_owned)));
                    problems.push(
                        "the robot was not localized; set `set_initial_pose` and `initial_pose.x`, \
                         `initial_pose.y`, `initial_pose.yaw`"
                            .to_owned(),
                    );
                }
                problems
            }
            Self::Costmap(nodes) => nodes
                .iter()
                .filter_map(|node| {
                    let status = node.with(|node| node.status());
                    Some(format!("{}: {}", status.node, status.trouble?))
                })
                .collect(),
        }
    }
}

/// Reads a map file before a node does, so that its errors are those of the rerun.
fn check_map(path: &Path) -> Result<(), RerunError> {
    let name = path.display().to_string();
    let loaded = load(&name, Distro::Jazzy, &Machine);
    if loaded.map.is_some() {
        return Ok(());
    }
    let findings: Vec<&str> = loaded.diagnostics.iter().map(|it| it.message.as_str()).collect();
    Err(RerunError::Missing(format!(
        "`{}`: the map {name} cannot be read: {}",
        MAP_FILE.name,
        findings.join("; ")
    )))
}

/// Publishes the last map of the recording.
fn publish_map(
    graph: &Graph,
    bag: &Bag,
    (robot, topic): (&RecordedRobot, &str),
) -> Result<(Node, Publisher<OccupancyGrid>), RerunError> {
    let mut last = None;
    if let Some(recorded) = &robot.map_topic {
        each::<OccupancyGrid>(bag, &[recorded.as_str()], |_, map| last = Some(map))
            .map_err(RerunError::Recording)?;
    }
    let Some(map) = last else {
        return Err(RerunError::Missing(format!(
            "the recording has no map; set `{}` to the YAML file of a map",
            MAP_FILE.name
        )));
    };
    let node = graph.node(NodeSettings::new("rerun_map").keep_names())?;
    let name = format!("/{}", topic.trim_start_matches('/'));
    let publisher = node.publisher(&name, Qos::latched(1))?;
    publisher.publish(map);
    Ok((node, publisher))
}

/// Converts a value to that of a node's parameter.
fn parameter_value(value: ParamValue) -> ParameterValue {
    let of = |r#type: u8| ParameterValue { r#type, ..ParameterValue::default() };
    match value {
        ParamValue::Bool(bool_value) => {
            ParameterValue { bool_value, ..of(ParameterType::PARAMETER_BOOL) }
        }
        ParamValue::Integer(integer_value) => {
            ParameterValue { integer_value, ..of(ParameterType::PARAMETER_INTEGER) }
        }
        ParamValue::Number(double_value) => {
            ParameterValue { double_value, ..of(ParameterType::PARAMETER_DOUBLE) }
        }
        ParamValue::Text(string_value) => {
            ParameterValue { string_value, ..of(ParameterType::PARAMETER_STRING) }
        }
        ParamValue::Numbers(double_array_value) => {
            ParameterValue { double_array_value, ..of(ParameterType::PARAMETER_DOUBLE_ARRAY) }
        }
        ParamValue::Texts(string_array_value) => {
            ParameterValue { string_array_value, ..of(ParameterType::PARAMETER_STRING_ARRAY) }
        }
    }
}
