//! Topics and frames of a robot, detected by running it.
//!
//! The world runs briefly before the run begins. Its messages give the topics of scans, odometry
//! and IMU, the frames, and whether the odometry transform is published. Then the simulation is
//! reset to time zero.

use std::collections::BTreeMap;

use periplus_diagnostics::Diagnostics;
use periplus_ekf::Settings;
use periplus_geometry::Pose2;
use periplus_graph::{Graph, GraphError, Mailbox, Node, Qos, TopicInfo};
use periplus_msgs::Message;
use periplus_msgs::geometry_msgs::{Point, Pose, Transform, Vector3};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::{Imu, LaserScan};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_nav_nodes::ekf_node::EkfNode;
use periplus_params::{Given, ParamValue, ParamValues};
use periplus_sim::{Simulation, VelocityTopic, velocity_topics};

use super::namespace::RobotNamespace;
use crate::error::RunError;
use crate::terminal;

/// Longest detection phase \[ns\]: odometry and scans are published several times per second.
const MAX_DETECTION_NS: i64 = 2_000_000_000;

/// Shortest detection phase \[ns\], for slow publishers of transforms.
const MIN_DETECTION_NS: i64 = 500_000_000;

/// Radius of a robot whose collisions give no size \[m\], the default of Nav2's example.
pub(crate) const DEFAULT_RADIUS_M: f64 = 0.22;

/// Maximum depth of a chain of frames.
const MAX_DEPTH: usize = 100;

/// Topics and frames of a robot that the stack needs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotProfile {
    /// Namespace of its nodes.
    pub namespace: RobotNamespace,
    /// Pose at the start, in the world; set for several robots, each of which localizes from there.
    pub start: Option<Pose2>,
    /// Topic of laser scans.
    pub scan: Option<String>,
    /// Largest range of the scans \[m\].
    pub scan_range_max_m: Option<f64>,
    /// Topic of odometry.
    pub odometry: Option<String>,
    /// Topic of an IMU.
    pub imu: Option<String>,
    /// Odometry frame.
    pub odom_frame: Option<String>,
    /// Root of the robot's frames.
    pub base_frame: Option<String>,
    /// True if a transform connects `base_frame` to `odom_frame`.
    pub has_odom_transform: bool,
    /// Pose at the start in the odometry frame. Odometry of Gazebo Classic with `odometry_source` 1 has the frame of the
    /// world; else the identity.
    pub odom_from_start: Pose2,
    /// Radius of a circle around the robot \[m\].
    pub radius_m: f64,
    /// Convex outline of the robot in its base frame \[m\]; none if its collisions do not define one.
    pub footprint: Option<Vec<[f64; 2]>>,
    /// Topic of velocity commands, and whether they are stamped.
    pub velocity: Option<VelocityTopic>,
}

/// Subscriptions of the detection phase of a robot.
struct DetectionSubscriptions {
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    odometry: Option<Mailbox<Odometry>>,
    scan: Option<Mailbox<LaserScan>>,
    profile: RobotProfile,
    /// Parent of each frame, and the first pose in it.
    parents: BTreeMap<String, (String, Pose2)>,
}

impl RobotProfile {
    /// Runs the world briefly, detects topics and frames of its first robot, and resets it. The robot is the only one,
    /// or the topics of all robots are taken for its own.
    ///
    /// # Errors
    /// When the world cannot run, or the graph refuses a name.
    pub fn detect(simulation: &mut Simulation) -> Result<Self, RunError> {
        let mut profiles = Self::detect_all(simulation, &[RobotNamespace::default()])?;
        let mut profile = profiles.pop().unwrap_or_default();
        profile.radius_m = simulation.robot_radius_m().unwrap_or(DEFAULT_RADIUS_M);
        profile.footprint = simulation.robot_footprint_m();
        Ok(profile)
    }

    /// Detects topics and frames of all robots in their namespaces, as [`RobotProfile::detect`].
    ///
    /// # Errors
    /// When two robots share a namespace; as [`RobotProfile::detect`].
    pub fn detect_fleet(simulation: &mut Simulation) -> Result<Vec<Self>, RunError> {
        let robots = simulation.robots();
        let spaces: Vec<_> =
            robots.iter().map(|robot| RobotNamespace::new(&robot.namespace)).collect();
        for (index, space) in spaces.iter().enumerate() {
            if let Some(before) = spaces[..index].iter().position(|other| other == space) {
                return Err(RunError::SharedNamespace {
                    namespace: robots[index].namespace.clone(),
                    robots: [before, index].map(|index| robots[index].name.clone()),
                });
            }
        }
        let mut profiles = Self::detect_all(simulation, &spaces)?;
        for (profile, robot) in profiles.iter_mut().zip(robots) {
            profile.radius_m = robot.radius_m.unwrap_or(DEFAULT_RADIUS_M);
            profile.footprint = simulation.model_footprint_m(&robot.name);
            profile.start = Some(Pose2::from(robot.world_from_robot));
        }
        Ok(profiles)
    }

    /// The same for several robots by their namespaces; radius and footprint are not set.
    ///
    /// # Errors
    /// As [`RobotProfile::detect`].
    fn detect_all(
        simulation: &mut Simulation,
        namespaces: &[RobotNamespace],
    ) -> Result<Vec<Self>, RunError> {
        let looks = namespaces
            .iter()
            .map(|namespace| DetectionSubscriptions::new(simulation.graph(), namespace));
        let mut looks = looks.collect::<Result<Vec<_>, _>>()?;
        while simulation.time_ns() < MAX_DETECTION_NS {
            simulation.step()?;
            looks.iter_mut().for_each(DetectionSubscriptions::read);
            if simulation.time_ns() >= MIN_DETECTION_NS
                && looks.iter().all(DetectionSubscriptions::has_all)
            {
                break;
            }
        }
        let graph = simulation.graph();
        let profiles = looks.into_iter().map(|look| {
            let velocity = velocity_topic(graph, &look.profile.namespace);
            Self { velocity, ..look.finish() }
        });
        let profiles = profiles.collect();
        simulation.reset();
        Ok(profiles)
    }

    /// Prints the detected topics and frames.
    pub(crate) fn print(&self) {
        let named = |topic: &Option<String>| topic.clone().unwrap_or_else(|| "none".to_owned());
        terminal::say(&format!(
            "stack: scans on {}, odometry on {}, IMU on {}, frames {} and {}, radius {:.2} m",
            named(&self.scan),
            named(&self.odometry),
            named(&self.imu),
            self.odom(),
            self.base(),
            self.radius_m
        ));
    }

    /// Prints why an EKF runs, and its inputs.
    pub(crate) fn print_filter(&self) {
        let inputs: Vec<&str> =
            [&self.odometry, &self.imu].into_iter().flatten().map(String::as_str).collect();
        terminal::say(&format!(
            "the robot publishes no transform from {} to {}: the EKF of robot_localization \
             publishes it, from {}",
            self.base(),
            self.odom(),
            inputs.join(" and ")
        ));
    }

    /// Returns true if an EKF has to publish the odometry transform, and has the inputs.
    #[must_use]
    pub fn needs_filter(&self) -> bool {
        !self.has_odom_transform && self.odometry.is_some()
    }

    /// EKF of `robot_localization` on the robot's topics: wheel velocities and the yaw rate of the
    /// IMU.
    ///
    /// # Errors
    /// An error when it cannot run.
    pub fn filter(&self, graph: &Graph) -> Result<EkfNode, GraphError> {
        const WHEELS: &str = "[false, false, false, false, false, false, true, true, false, \
                              false, false, true, false, false, false]";
        const TURNS: &str = "[false, false, false, false, false, false, false, false, false, \
                             false, false, true, false, false, false]";
        let mut given: Vec<(&str, &str)> = vec![
            ("two_d_mode", "true"),
            ("world_frame", self.odom()),
            ("odom_frame", self.odom()),
            ("base_link_frame", self.base()),
        ];
        if let Some(topic) = &self.odometry {
            given.extend([("odom0", topic.as_str()), ("odom0_config", WHEELS)]);
        }
        if let Some(topic) = &self.imu {
            given.extend([("imu0", topic.as_str()), ("imu0_config", TURNS)]);
        }
        let given = given.into_iter().map(|(name, text)| Given::new(name, text));
        let (settings, values) = Settings::read(given, &mut Diagnostics::new());
        EkfNode::at(self.namespace.node(graph, "ekf_filter_node")?, settings, values)
    }

    /// Sets unset parameters of a node: the frames of odometry and robot, and the topic of scans,
    /// by these names.
    pub fn fill(&self, values: &mut ParamValues, names: [&'static str; 3]) {
        let known = [&self.odom_frame, &self.base_frame, &self.scan];
        for (name, known) in names.into_iter().zip(known) {
            if let Some(text) = known
                && values.table().find(name).is_some()
                && !values.is_given(name)
            {
                values.set(name, ParamValue::Text(text.clone()));
            }
        }
    }

    /// Topic of velocity commands.
    #[must_use]
    pub fn velocity_topic(&self) -> Option<&str> {
        self.velocity.as_ref().map(|topic| topic.name.as_str())
    }

    /// Returns true if velocity commands must be stamped.
    #[must_use]
    pub fn takes_stamped_velocities(&self) -> bool {
        self.velocity.as_ref().is_some_and(|topic| topic.is_stamped)
    }

    /// Odometry frame, or its default name.
    #[must_use]
    pub fn odom(&self) -> &str {
        self.odom_frame.as_deref().unwrap_or("odom")
    }

    /// Base frame, or its default name.
    #[must_use]
    pub fn base(&self) -> &str {
        self.base_frame.as_deref().unwrap_or("base_link")
    }

    /// Both costmaps of Nav2 with the values of Nav2's example, for this robot.
    #[must_use]
    pub fn costmap_parameters(&self) -> String {
        let (odom, base, radius_m) = (self.odom(), self.base(), self.radius_m);
        let scan = self.scan.as_deref().unwrap_or("/scan");
        let common = |frame: &str| {
            format!(
                "      use_sim_time: true\n      global_frame: {frame}\n      robot_base_frame: {base}\n\
                 \x20     robot_radius: {radius_m:.3}\n      resolution: 0.05\n"
            )
        };
        let layers = format!(
            "      obstacle_layer:\n        plugin: nav2_costmap_2d::ObstacleLayer\n\
             \x20       observation_sources: scan\n\
             \x20       scan: {{topic: {scan}, data_type: LaserScan, marking: true, clearing: true, \
             obstacle_max_range: 2.5, raytrace_max_range: 3.0, max_obstacle_height: 2.0}}\n\
             \x20     inflation_layer:\n        plugin: nav2_costmap_2d::InflationLayer\n\
             \x20       cost_scaling_factor: 3.0\n        inflation_radius: {:.3}\n",
            2.5 * radius_m
        );
        format!(
            "local_costmap:\n  local_costmap:\n    ros__parameters:\n{}\
             \x20     update_frequency: 5.0\n      publish_frequency: 2.0\n      rolling_window: true\n\
             \x20     width: 3\n      height: 3\n      plugins: [obstacle_layer, inflation_layer]\n{layers}\
             global_costmap:\n  global_costmap:\n    ros__parameters:\n{}\
             \x20     update_frequency: 1.0\n      publish_frequency: 1.0\n      track_unknown_space: true\n\
             \x20     plugins: [static_layer, obstacle_layer, inflation_layer]\n\
             \x20     static_layer:\n        plugin: nav2_costmap_2d::StaticLayer\n\
             \x20       map_subscribe_transient_local: true\n{layers}",
            common(odom),
            common("map"),
        )
    }
}

impl DetectionSubscriptions {
    fn new(graph: &Graph, namespace: &RobotNamespace) -> Result<Self, GraphError> {
        let node = graph.node(namespace.settings("stack").bare().keep_names())?;
        let mut topics = graph.topics();
        topics.retain(|topic| namespace.contains(&topic.name));
        let profile = RobotProfile {
            namespace: namespace.clone(),
            scan: of_type::<LaserScan>(&topics, "scan"),
            odometry: of_type::<Odometry>(&topics, "odom"),
            imu: of_type::<Imu>(&topics, "imu"),
            ..RobotProfile::default()
        };
        Ok(Self {
            moving: node.mailbox("/tf", Qos::reliable(1000))?,
            fixed: node.mailbox("/tf_static", Qos::latched(100))?,
            odometry: mailbox(&node, profile.odometry.as_deref())?,
            scan: mailbox(&node, profile.scan.as_deref())?,
            profile,
            parents: BTreeMap::new(),
        })
    }

    /// Reads received messages.
    fn read(&mut self) {
        for message in self.moving.drain().into_iter().chain(self.fixed.drain()) {
            for edge in &message.transforms {
                let plain = |frame: &str| frame.trim_start_matches('/').to_owned();
                let (child, parent) = (plain(&edge.child_frame_id), plain(&edge.header.frame_id));
                if self.parents.get(&child).is_none_or(|(known, _)| *known != parent) {
                    self.parents.insert(child, (parent, planar(&edge.transform)));
                }
            }
        }
        if let Some(odometry) = self.odometry.as_ref().and_then(Mailbox::latest) {
            let plain = |frame: &str| Some(frame.trim_start_matches('/').to_owned());
            self.profile.odom_frame = plain(&odometry.header.frame_id);
            self.profile.base_frame = plain(&odometry.child_frame_id);
            self.odometry = None;
        }
        if let Some(scan) = self.scan.as_ref().and_then(Mailbox::latest) {
            self.profile.scan_range_max_m = Some(f64::from(scan.range_max));
            self.scan = None;
        }
    }

    /// Returns true if everything was detected.
    fn has_all(&self) -> bool {
        self.odometry.is_none() && self.scan.is_none()
    }

    fn finish(mut self) -> RobotProfile {
        let odom = self.profile.odom_frame.clone().filter(|frame| !frame.is_empty());
        let odom = odom.unwrap_or_else(|| "odom".to_owned());
        let mut base = self.profile.base_frame.clone().filter(|frame| !frame.is_empty());
        let of_odom = self.parents.iter().find(|(_, (parent, _))| *parent == odom);
        if let Some((child, (_, first))) = of_odom {
            self.profile.has_odom_transform = true;
            self.profile.odom_from_start = *first;
            base = Some(child.clone());
        } else if let Some(start) = base.take() {
            // All frames of the robot are descendants of its root frame.
            let mut top = start;
            for _ in 0..MAX_DEPTH {
                match self.parents.get(&top) {
                    Some((parent, _)) => top.clone_from(parent),
                    None => break,
                }
            }
            base = Some(top);
        }
        self.profile.odom_frame = Some(odom);
        self.profile.base_frame = base;
        self.profile
    }
}

/// Transform as a pose on the floor; the identity if it is malformed.
fn planar(transform: &Transform) -> Pose2 {
    let Vector3 { x, y, z } = transform.translation;
    let orientation = transform.rotation.clone();
    periplus_tf_ros::pose2(&Pose { position: Point { x, y, z }, orientation }).unwrap_or_default()
}

fn mailbox<M: Message>(node: &Node, topic: Option<&str>) -> Result<Option<Mailbox<M>>, GraphError> {
    topic.map(|topic| node.mailbox(topic, Qos::best_effort(10))).transpose()
}

/// Published topic of a type: the one whose name ends with this word, else the first.
fn of_type<M: Message>(topics: &[TopicInfo], word: &str) -> Option<String> {
    let all = || {
        let is_it = |it: &&TopicInfo| it.type_name == M::TYPE_NAME && !it.publishers.is_empty();
        topics.iter().filter(is_it).map(|it| it.name.as_str())
    };
    all().find(|name| name.ends_with(word)).or_else(|| all().next()).map(str::to_owned)
}

/// Returns the topic on which a robot takes velocity commands; of several that of a `cmd_vel` with the shortest name.
fn velocity_topic(graph: &Graph, namespace: &RobotNamespace) -> Option<VelocityTopic> {
    let is_named = |topic: &VelocityTopic| topic.name.ends_with("/cmd_vel");
    let topics = velocity_topics(graph).into_iter().filter(|it| namespace.contains(&it.name));
    topics.min_by_key(|topic| (!is_named(topic), topic.name.len(), topic.name.clone()))
}
