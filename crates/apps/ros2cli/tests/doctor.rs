//! Findings of the doctor on systems with one deliberate fault each, in lockstep in this program,
//! so that the output is deterministic.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::collections::BTreeMap;
use std::time::Duration;

use expect_test::{Expect, expect};
use periplus_graph::{Graph, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Quaternion, Transform, TransformStamped};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_ros2cli::doctor::{NetworkSettings, SystemObservation, SystemObserver, examine};
use periplus_ros2cli::{Seen, SeenTopic, TopicEndpoint};

const SECOND_NS: i64 = 1_000_000_000;

/// A faultless robot: a clock, dynamic `map -> odom -> base_link`, a static lidar frame, a scan at
/// 10 Hz. Each test breaks one thing.
struct Robot {
    graph: Graph,
    tf: Publisher<TFMessage>,
    fixed: Publisher<TFMessage>,
    clock: Option<Publisher<Clock>>,
    scan: Publisher<LaserScan>,
    /// Dynamic frames: parent, child, time of the last transform \[ns\].
    moving: Vec<(&'static str, &'static str, i64)>,
    says_fixed: bool,
    scan_frame: &'static str,
    ranges: Vec<f32>,
    /// One scan per this number of steps of 0.1 s; 0 for none.
    every: i64,
    /// Offset of the stamps of scans \[ns\].
    stamp_shift_ns: i64,
    simulated: BTreeMap<String, bool>,
    network_settings: Option<NetworkSettings>,
    is_alone: bool,
}

fn node(graph: &Graph, name: &str) -> Node {
    graph.node(NodeSettings::new(name).bare()).unwrap()
}

fn transform(parent: &str, child: &str, stamp_ns: i64) -> TFMessage {
    TFMessage {
        transforms: vec![TransformStamped {
            header: Header { stamp: Time::of_ns(stamp_ns), frame_id: parent.into() },
            child_frame_id: child.into(),
            transform: Transform {
                rotation: Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 },
                ..Transform::default()
            },
        }],
    }
}

impl Robot {
    fn new() -> Self {
        let graph = Graph::new();
        let publisher = node(&graph, "robot_state_publisher");
        let lidar = node(&graph, "lidar");
        Self {
            tf: node(&graph, "localization").publisher("/tf", Qos::reliable(100)).unwrap(),
            fixed: publisher.publisher("/tf_static", Qos::latched(1)).unwrap(),
            clock: Some(node(&graph, "gazebo").publisher("/clock", Qos::sensor_data()).unwrap()),
            scan: lidar.publisher("/scan", Qos::sensor_data()).unwrap(),
            moving: vec![("map", "odom", i64::MAX), ("odom", "base_link", i64::MAX)],
            says_fixed: true,
            scan_frame: "lidar_link",
            ranges: vec![1.5; 36],
            every: 1,
            stamp_shift_ns: 0,
            simulated: BTreeMap::from([("/amcl".into(), true), ("/lidar".into(), true)]),
            network_settings: None,
            is_alone: false,
            graph,
        }
    }

    /// Collects three seconds.
    fn observation(&self) -> SystemObservation {
        let own = node(&self.graph, "_doctor");
        let look = || Seen::of_graph(&self.graph, |name| name.ends_with("_doctor"));
        let mut ears = SystemObserver::open(&own, &look()).unwrap();
        if self.says_fixed {
            self.fixed.publish(transform("base_link", "lidar_link", 0));
        }
        for step in 1..=30 {
            let now_ns = step * SECOND_NS / 10;
            self.graph.advance_to(now_ns);
            if let Some(clock) = &self.clock {
                clock.publish(Clock { clock: Time::of_ns(now_ns) });
            }
            for (parent, child, until_ns) in &self.moving {
                if now_ns <= *until_ns {
                    self.tf.publish(transform(parent, child, now_ns));
                }
            }
            if self.every > 0 && step % self.every == 0 {
                self.scan.publish(LaserScan {
                    header: Header {
                        stamp: Time::of_ns(now_ns + self.stamp_shift_ns),
                        frame_id: self.scan_frame.into(),
                    },
                    scan_time: 0.1,
                    range_min: 0.12,
                    range_max: 3.5,
                    ranges: self.ranges.clone(),
                    ..LaserScan::default()
                });
            }
            self.graph.advance_to(now_ns + 1);
            ears.hear();
        }
        let mut observation =
            ears.observation(look(), self.simulated.clone(), Duration::from_secs(3));
        observation.network_settings = self.network_settings.clone();
        observation.is_alone = self.is_alone;
        observation
    }

    fn check(&self, expected: Expect) {
        check(&self.observation(), expected);
    }
}

fn check(observation: &SystemObservation, expected: Expect) {
    let mut text = String::new();
    for finding in examine(observation).iter() {
        text += &format!("{} {}: {}\n", finding.severity.name(), finding.code, finding.message);
        for help in &finding.help {
            text += &format!("  {help}\n");
        }
    }
    expected.assert_eq(&text);
}

#[test]
fn a_sound_robot_has_nothing() {
    Robot::new().check(expect![[""]]);
}

#[test]
fn reliability_that_nobody_offers() {
    let robot = Robot::new();
    let rviz = node(&robot.graph, "rviz");
    let _scans = rviz.mailbox::<LaserScan>("/scan", Qos::reliable(5)).unwrap();
    robot.check(expect![[r#"
        error qos-mismatch: `/rviz` receives nothing on `/scan`: it requests reliability reliable, and `/lidar` offers best_effort
          set reliability of the subscription to best_effort: parameter `qos_overrides./scan.subscription.reliability` of `/rviz`, in RViz the display's Reliability Policy; or `qos_overrides./scan.publisher.reliability` of `/lidar` to reliable
    "#]]);
}

#[test]
fn a_map_that_is_not_kept_for_latecomers() {
    let robot = Robot::new();
    let server = node(&robot.graph, "mapper");
    let _map = server.publisher::<OccupancyGrid>("/map", Qos::reliable(1)).unwrap();
    let costmap = node(&robot.graph, "global_costmap");
    let _maps = costmap.mailbox::<OccupancyGrid>("/map", Qos::latched(1)).unwrap();
    robot.check(expect![[r#"
        error qos-mismatch: `/global_costmap` receives nothing on `/map`: it requests durability transient_local, and `/mapper` offers volatile
          set durability of the subscription to volatile: parameter `qos_overrides./map.subscription.durability` of `/global_costmap`, in RViz the display's Durability Policy; or `qos_overrides./map.publisher.durability` of `/mapper` to transient_local
    "#]]);
}

#[test]
fn odometry_that_nobody_tells() {
    let mut robot = Robot::new();
    robot.moving.remove(1);
    robot.check(expect![[r#"
        error frame-missing: no transform from `odom` to `base_link` is published: 2 disconnected trees with the roots `base_link`, `map`
          let the drive publish it: `publish_odom_tf` true (Classic), `<tf_topic>/tf</tf_topic>` (Harmonic), or `publish_tf` true of robot_localization; its `odom_frame` and `base_link_frame` must be these names
    "#]]);
}

#[test]
fn two_nodes_that_place_the_robot() {
    let mut robot = Robot::new();
    robot.moving.push(("map", "base_link", i64::MAX));
    robot.check(expect![[r#"
        error frame-two-parents: `base_link` has more than one parent: `map`, `odom`
          let only one node publish it: `publish_tf` of robot_localization, `publish_odom_tf` (Classic) or `<tf_topic>` (Harmonic) of the drive, `tf_broadcast` of AMCL; or the joint to `map` is in the URDF besides
    "#]]);
}

#[test]
fn a_localization_that_has_stopped() {
    let mut robot = Robot::new();
    robot.moving[0].2 = SECOND_NS / 2;
    robot.check(expect![[r#"
        warning frame-stale: `odom` in `map` was last published 2.5 s before the newest transform
          its broadcaster has stopped, receives no input, or uses another clock (`use_sim_time`)
    "#]]);
}

#[test]
fn a_circle_of_frames() {
    let mut robot = Robot::new();
    robot.moving.push(("base_link", "map", i64::MAX));
    robot.check(expect![[r#"
        error frame-circle: frames form a loop: `base_link` -> `odom` -> `map` -> `base_link`
          one of these transforms has parent and child exchanged
    "#]]);
}

#[test]
fn simulated_time_that_nobody_tells() {
    let mut robot = Robot::new();
    robot.clock = None;
    robot.check(expect![[r#"
        error no-clock: `/clock` has no publisher, and `/amcl`, `/lidar` wait for it: their time stays at 0
          start the simulation (or `periplus bag play BAG --clock`), or set `use_sim_time` of these nodes to false
    "#]]);
}

#[test]
fn a_driver_that_lives_by_the_wall_clock() {
    let mut robot = Robot::new();
    robot.simulated.insert("/lidar".into(), false);
    robot.stamp_shift_ns = 1_700_000_000 * SECOND_NS;
    robot.check(expect![[r#"
        warning wall-time: `/gazebo` publishes simulated time on `/clock`, and `/lidar` use the wall clock
          set `use_sim_time` of these nodes to true: `-p use_sim_time:=true`
        error other-clock: stamps on `/scan` are 1700000000 s away from the time on `/clock`
          set `use_sim_time` of `/lidar` to true
    "#]]);
}

#[test]
fn a_lidar_in_a_frame_of_gazebo() {
    let mut robot = Robot::new();
    robot.scan_frame = "pong-bot/lidar_link/gpu_lidar";
    robot.check(expect![[r#"
        error frame-unknown: messages on `/scan` are in the frame `pong-bot/lidar_link/gpu_lidar`, which has no transform
          set the sensor's frame to `lidar_link`: `<frame_name>` (Classic), `<gz_frame_id>` (Harmonic); or publish its pose: `periplus tf static 0 0 0 0 0 0 lidar_link pong-bot/lidar_link/gpu_lidar`
    "#]]);
}

#[test]
fn a_robot_whose_frames_nobody_tells() {
    let mut robot = Robot::new();
    robot.moving.clear();
    robot.says_fixed = false;
    robot.check(expect![[r#"
        hint no-frames: no transforms are published on `/tf` or `/tf_static`
          start robot_state_publisher with the robot's `robot_description`; in Gazebo Harmonic `gz::sim::systems::PosePublisher` publishes them
    "#]]);
}

#[test]
fn a_frame_with_a_slash() {
    let mut robot = Robot::new();
    robot.scan_frame = "/lidar_link";
    robot.check(expect![[r#"
        error frame-slash: messages on `/scan` have the frame_id `/lidar_link` with a leading slash
          set the sensor's frame to `lidar_link` (`frame_name`, `frame_id`)
    "#]]);
}

#[test]
fn a_lidar_that_says_nothing() {
    let mut robot = Robot::new();
    robot.every = 0;
    robot.check(expect![[r#"
        warning sensor-silent: `/lidar` has a publisher on `/scan`, and no message was received in 3.0 s
          the sensor is off (`<always_on>`, `<update_rate>`), the simulation is paused, a driver waits for its device, or packets are lost: large messages need `net.core.rmem_max`
    "#]]);
}

#[test]
fn a_lidar_without_a_gpu() {
    let mut robot = Robot::new();
    robot.ranges = vec![0.0, f32::NAN, 0.0, 0.0];
    robot.check(expect![[r#"
        warning scan-useless: `/scan` has NaN or 0 in every reading (all of 120 readings)
          it measures nothing: a GPU lidar without a GPU, or a driver without its device; in a world file `type="ray"` instead of `gpu_ray`
    "#]]);
}

#[test]
fn a_lidar_that_looks_at_its_own_robot() {
    let mut robot = Robot::new();
    robot.ranges = vec![0.12; 36];
    robot.check(expect![[r#"
        warning scan-useless: `/scan` has only readings below its `range_min` (all of 1080 readings)
          it detects the robot itself, or is inside a shape: move the sensor's link out of the collision shape, or set `range/min` above it
    "#]]);
}

#[test]
fn a_lidar_that_is_too_slow() {
    let mut robot = Robot::new();
    robot.every = 3;
    robot.check(expect![[r#"
        warning sensor-slow: `/scan` has a rate of 3.3 Hz instead of 10.0 Hz
          the machine is too slow for `<update_rate>` (a lower one, fewer samples), the simulation runs below real time, or messages are lost (reliability, `net.core.rmem_max`)
    "#]]);
}

#[test]
fn another_domain() {
    let around = NetworkSettings {
        domain_id: 7,
        is_loopback: true,
        domains: [0, 7].into(),
        ..NetworkSettings::default()
    };
    check(
        &SystemObservation { network_settings: Some(around), ..SystemObservation::default() },
        expect![[r#"
        error nobody: no participant found in domain 7
          set ROS_DOMAIN_ID=0
    "#]],
    );
}

#[test]
fn multicast_that_is_blocked() {
    let around = NetworkSettings { has_multicast: Some(false), ..NetworkSettings::default() };
    check(
        &SystemObservation { network_settings: Some(around), ..Robot::new().observation() },
        expect![[r#"
        warning multicast: packets to 239.255.0.1 are not received: multicast is blocked
          allow UDP to 239.255.0.1 in the firewall, or list the other machines in ROS_STATIC_PEERS
    "#]],
    );
}

#[test]
fn one_name_for_two_types() {
    let end = |node: &str, type_name: &str| TopicEndpoint {
        node: Some(node.to_owned()),
        type_name: type_name.to_owned(),
        type_hash: None,
        gid: String::new(),
        qos: Qos::reliable(10),
    };
    let (plain, stamped) = ("geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped");
    let topic = SeenTopic {
        name: "/cmd_vel".into(),
        types: vec![plain.into(), stamped.into()],
        publishers: vec![end("/teleop", plain)],
        subscriptions: vec![end("/drive", stamped)],
    };
    let seen = Seen { topics: vec![topic], ..Seen::default() };
    check(
        &SystemObservation { seen, ..SystemObservation::default() },
        expect![[r#"
            error topic-types: `/cmd_vel` has endpoints of different types: geometry_msgs/msg/Twist, geometry_msgs/msg/TwistStamped
              remap one of them: `-r /cmd_vel:=/cmd_vel_other`
        "#]],
    );
}

/// A robot file alone is on an empty plane, where a lidar has no returns; in a world that is a
/// finding.
#[test]
fn a_lidar_on_an_empty_plane() {
    let mut robot = Robot::new();
    robot.ranges = vec![f32::INFINITY; 36];
    robot.check(expect![[r#"
        warning scan-useless: `/scan` has no reading within its `range_max` (all of 1080 readings)
          no surface is that near at its height: check the pose of the sensor, raise `range/max`, or add obstacles to the world
    "#]]);
    robot.is_alone = true;
    robot.check(expect![[""]]);
}

/// A mapper publishes scans when it has input; a silent sensor is reported nevertheless.
#[test]
fn a_mapper_that_shows_nothing_yet() {
    let robot = Robot::new();
    let mapper = node(&robot.graph, "mapper");
    let _scans = mapper.mailbox::<LaserScan>("/scan", Qos::sensor_data()).unwrap();
    let _shown = mapper.publisher::<LaserScan>("/mapper/shown", Qos::reliable(1)).unwrap();
    robot.check(expect![[""]]);
    let driver = node(&robot.graph, "driver");
    let _silent = driver.publisher::<LaserScan>("/rear_scan", Qos::sensor_data()).unwrap();
    robot.check(expect![[r#"
        warning sensor-silent: `/driver` has a publisher on `/rear_scan`, and no message was received in 3.0 s
          the sensor is off (`<always_on>`, `<update_rate>`), the simulation is paused, a driver waits for its device, or packets are lost: large messages need `net.core.rmem_max`
    "#]]);
}

/// A node in the process of the simulation has its time, whatever its parameter is; one in another
/// process does not.
#[test]
fn nodes_in_the_process_of_the_simulation() {
    let process = |byte: &str| [byte; 12].join(".") + ".00.00.01.03";
    let end = |node: &str, gid: String| TopicEndpoint {
        node: Some(node.to_owned()),
        type_name: "rosgraph_msgs/msg/Clock".into(),
        type_hash: None,
        gid,
        qos: Qos::reliable(1),
    };
    let topic = |name: &str, publishers: Vec<TopicEndpoint>| SeenTopic {
        name: name.into(),
        types: vec!["rosgraph_msgs/msg/Clock".into()],
        publishers,
        subscriptions: Vec::new(),
    };
    let observation = |amcl: &str| SystemObservation {
        seen: Seen {
            topics: vec![
                topic("/clock", vec![end("/gazebo", process("01"))]),
                topic("/other", vec![end("/amcl", process(amcl))]),
            ],
            ..Seen::default()
        },
        simulated: BTreeMap::from([("/amcl".to_owned(), false)]),
        ..SystemObservation::default()
    };
    check(&observation("01"), expect![[""]]);
    assert!(examine(&observation("02")).iter().any(|finding| finding.code == "wall-time"));
}
