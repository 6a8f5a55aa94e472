//! Publishers of states.

use expect_test::expect;
use periplus_msgs::{geometry_msgs, nav_msgs, rosgraph_msgs, sensor_msgs, tf2_msgs};
use periplus_physics::PhysicsMode;
use periplus_sim_nodes::states::{ClockPublisher, JointStatePublisher};

use crate::bench::*;

/// Wheels that turn at 1 and 2 rad/s.
const TURNING: &str = "
    <plugin filename='gz-sim-joint-controller-system' name='gz::sim::systems::JointController'>
      <joint_name>left_joint</joint_name><initial_velocity>1</initial_velocity></plugin>
    <plugin filename='gz-sim-joint-controller-system' name='gz::sim::systems::JointController'>
      <joint_name>right_joint</joint_name><initial_velocity>2</initial_velocity></plugin>";

#[test]
fn joint_states_of_every_generation() {
    let of = |plugin: &str, topic: &str| {
        let mut bench = Bench::exact(&format!("{TURNING}{plugin}"));
        let states = bench.hear::<sensor_msgs::JointState>(topic);
        bench.run(1.0);
        let heard = states.drain();
        let last = heard.last().unwrap().clone();
        assert_eq!(last.header.frame_id, "");
        (heard.len(), last)
    };
    let (count, last) = of(
        "<plugin name='states' filename='libgazebo_ros_joint_state_publisher.so'>
           <ros><namespace>/demo</namespace></ros>
           <joint_name>right_joint</joint_name><joint_name>left_joint</joint_name>
           <update_rate>20</update_rate></plugin>",
        "/demo/joint_states",
    );
    assert_eq!((count, &*last.name), (20, &["right_joint".into(), "left_joint".into()][..]));
    near(&last.position, &[2.0, 1.0], 1e-9);
    near(&last.velocity, &[2.0, 1.0], 1e-9);
    assert!(last.effort.is_empty());

    let (count, last) = of(
        "<plugin name='states' filename='libgazebo_ros_joint_state_publisher.so'>
           <jointName>left_joint, right_joint</jointName><updateRate>5</updateRate></plugin>",
        "/joint_states",
    );
    assert_eq!((count, last.name.len()), (5, 2));

    let (count, last) = of(
        "<plugin filename='gz-sim-joint-state-publisher-system'
           name='gz::sim::systems::JointStatePublisher'/>",
        "/world/hall/model/robot/joint_state",
    );
    // Each step; efforts too; the fixed joint has no state.
    assert_eq!((count, last.name.len(), last.effort.len()), (1000, 2, 2));
}

#[test]
fn without_a_plugin_all_joints_50_times_a_second() {
    let mut bench = Bench::exact(TURNING);
    let publisher = JointStatePublisher::fallback(&bench.setting()).unwrap().unwrap();
    assert_eq!(publisher.topic(), "/joint_states");
    bench.devices.push(Box::new(publisher));
    let states = bench.hear::<sensor_msgs::JointState>("/joint_states");
    bench.run(1.0);
    assert_eq!(states.drain().len(), 50);
    let still = Bench::of("<link name='base'/>", PhysicsMode::Kinematic);
    assert!(JointStatePublisher::fallback(&still.setting()).unwrap().is_none());
}

/// The robot moves at 1 m/s along x and is at x = 1 m.
const GOING: &str = "<plugin filename='gz-sim-velocity-control-system'
    name='gz::sim::systems::VelocityControl'><initial_linear>1 0 0</initial_linear></plugin>";

#[test]
fn the_true_pose_of_a_link() {
    let p3d = |more: &str| {
        let plugin =
            format!("{GOING}<plugin name='truth' filename='libgazebo_ros_p3d.so'>{more}</plugin>");
        let mut bench = Bench::exact(&plugin);
        let odometry = bench.hear::<nav_msgs::Odometry>("/odom");
        bench.run(1.0);
        (odometry.drain(), bench)
    };
    let (heard, bench) = p3d("<body_name>left</body_name>");
    assert!(
        bench.topics().contains("/truth -> /odom nav_msgs/msg/Odometry best effort volatile 5")
            || bench
                .topics()
                .contains("/truth -> /odom nav_msgs/msg/Odometry best_effort volatile 5"),
        "{}",
        bench.topics()
    );
    let last = heard.last().unwrap();
    assert_eq!(
        (heard.len(), &*last.header.frame_id, &*last.child_frame_id),
        (1000, "world", "left")
    );
    near(&numbers(last), &[1.0, 0.2, 0.0, 1.0, 0.0, 0.0], 1e-9);
    let (heard, _) =
        p3d("<body_name>left</body_name><frame_name>base</frame_name><update_rate>10</update_rate>
         <xyz_offset>1 2 3</xyz_offset><gaussian_noise>0.1</gaussian_noise>");
    let last = heard.last().unwrap();
    assert_eq!((heard.len(), &*last.header.frame_id), (10, "base"));
    // 5 cm behind and 20 cm to the left of the base, and the offset.
    near(&numbers(last)[..2], &[0.95, 2.2], 1e-9);
    assert!((last.pose.pose.position.z - 2.95).abs() < 1e-9);
    near(&[last.pose.covariance[21], last.twist.covariance[0]], &[0.01, 0.01], 1e-12);
    // It does not move against the base, but for the noise, which differs from axis to axis.
    let noise = &last.twist.twist.linear;
    assert!(noise.x != 0.0 && noise.x != noise.y && noise.x.abs() < 0.6, "{noise:?}");
    assert!(heard[8].twist.twist.linear != *noise, "it is drawn anew each time");
}

#[test]
fn odometry_of_gz_in_two_and_three_dimensions() {
    let of = |dimensions: u32| {
        let plugin = format!(
            "<plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'>
               <initial_linear>1 0 0.5</initial_linear></plugin>
             <plugin filename='gz-sim-odometry-publisher-system'
               name='gz::sim::systems::OdometryPublisher'><dimensions>{dimensions}</dimensions>
               <xyz_offset>0 0 1</xyz_offset><gaussian_noise>0.001</gaussian_noise></plugin>"
        );
        let mut bench = Bench::exact(&plugin);
        if dimensions == 2 {
            expect![[r#"
                /VelocityControl <- /model/robot/cmd_vel geometry_msgs/msg/Twist reliable volatile 1
                /OdometryPublisher -> /model/robot/odometry nav_msgs/msg/Odometry reliable volatile 1
                /OdometryPublisher -> /model/robot/odometry_with_covariance nav_msgs/msg/Odometry reliable volatile 1
                /OdometryPublisher -> /model/robot/pose tf2_msgs/msg/TFMessage reliable volatile 100
            "#]]
            .assert_eq(&bench.topics());
        }
        let plain = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry");
        let full = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry_with_covariance");
        bench.run(1.0);
        let (plain, full) = (plain.drain(), full.drain());
        assert_eq!((plain.len(), full.len()), (50, 50));
        let (plain, full) = ((**plain.last().unwrap()).clone(), full.last().unwrap().clone());
        assert_eq!(plain.twist.twist, full.twist.twist);
        near(&[plain.pose.covariance[0], full.pose.covariance[0]], &[0.0, 1e-6], 1e-15);
        plain
    };
    let flat = of(2);
    assert_eq!(
        (&*flat.header.frame_id, &*flat.child_frame_id),
        ("robot/odom", "robot/base_footprint")
    );
    let heights = |odometry: &nav_msgs::Odometry| {
        [odometry.pose.pose.position.z, odometry.twist.twist.linear.z]
    };
    near(&numbers(&flat), &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0], 0.006);
    near(&heights(&flat), &[0.0, 0.0], 0.006);
    near(&heights(&of(3)), &[1.5, 0.5], 0.006);
}

#[test]
fn poses_of_parts_in_what_they_are_parts_of() {
    let plugin = "<plugin filename='gz-sim-pose-publisher-system'
        name='gz::sim::systems::PosePublisher'><use_pose_vector_msg>true</use_pose_vector_msg>
        <publish_nested_model_pose>true</publish_nested_model_pose>
        <publish_collision_pose>true</publish_collision_pose>
        <static_publisher>true</static_publisher><update_frequency>10</update_frequency></plugin>";
    let mut bench = Bench::exact(&format!("{GOING}{plugin}"));
    let moving = bench.hear::<tf2_msgs::TFMessage>("/model/robot/pose");
    let still = bench.hear::<tf2_msgs::TFMessage>("/model/robot/pose_static");
    bench.run(1.0);
    let list = |messages: Vec<std::sync::Arc<tf2_msgs::TFMessage>>| {
        assert_eq!(messages.len(), 10);
        let lines = messages.last().unwrap().transforms.iter().map(|one| {
            let at = &one.transform.translation;
            format!(
                "{} {} {:.2} {:.2} {:.2}\n",
                one.header.frame_id, one.child_frame_id, at.x, at.y, at.z
            )
        });
        lines.collect::<String>()
    };
    expect![[r#"
        robot robot::left 0.00 0.20 0.10
        robot robot::right 0.00 -0.20 0.10
    "#]]
    .assert_eq(&list(moving.drain()));
    expect![[r#"
        hall robot 1.00 0.00 0.00
        robot robot::base 0.05 0.00 0.15
        robot::left robot::left::tyre 0.00 0.00 0.00
        robot::right robot::right::tyre 0.00 0.00 0.00
        robot robot::caster 0.25 0.00 0.05
        robot::caster robot::caster::ball 0.00 0.00 0.00
    "#]]
    .assert_eq(&list(still.drain()));
    let plugin = "<plugin filename='gz-sim-pose-publisher-system'
        name='gz::sim::systems::PosePublisher'/>";
    let mut bench = Bench::exact(plugin);
    let each = bench.hear::<geometry_msgs::TransformStamped>("/model/robot/pose");
    bench.run(0.01);
    // Four links in each of ten steps.
    assert_eq!(each.drain().len(), 40);
}

#[test]
fn the_clock() {
    let mut bench = Bench::of("<link name='base'/>", PhysicsMode::Kinematic);
    bench.devices.push(Box::new(ClockPublisher::new(&bench.graph, 100.0, 0).unwrap()));
    let clock = bench.hear::<rosgraph_msgs::Clock>("/clock");
    bench.run(1.5);
    let heard = clock.drain();
    assert_eq!(heard.len(), 150);
    assert_eq!((heard[149].clock.sec, heard[149].clock.nanosec), (1, 500_000_000));
    assert!(bench.topics().contains("/clock -> /clock rosgraph_msgs/msg/Clock best"));
}

/// A robot from a URDF: its joint states are published without a plugin, and therefore its transforms.
#[test]
fn a_whole_robot_tells_its_frames() {
    let mut bench = Bench::exact(TURNING);
    let mut found = periplus_diagnostics::Diagnostics::new();
    bench.devices.clear();
    let devices = periplus_sim_nodes::devices(&bench.setting(), Some("<robot/>"), &mut found);
    bench.devices = devices;
    assert!(found.is_empty(), "{found:?}");
    let tf = bench.hear::<tf2_msgs::TFMessage>("/tf");
    bench.run(1.0);
    let heard = tf.drain();
    // Joint states come every 20 ms, frames every 50 ms at most: with every third state.
    assert_eq!(heard.len(), 16);
    let wheels: Vec<&str> = heard[15].transforms.iter().map(|one| &*one.child_frame_id).collect();
    assert_eq!(wheels, ["left", "right"]);
    let names: Vec<String> = bench.graph.nodes().into_iter().map(|node| node.name).collect();
    assert!(names.contains(&"/robot_state_publisher".to_owned()), "{names:?}");
}

/// Regression test: IMUs of ROS 1 that are plugins of a model published nothing, and no finding reported it.
#[test]
fn imus_that_are_plugins_of_a_model() {
    let of = |library: &str, settings: &str| {
        let mut bench = Bench::exact(&format!(
            "<plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'>
               <initial_angular>0 0 0.5</initial_angular></plugin>
             <plugin name='imu' filename='{library}'><bodyName>base</bodyName>
               <topicName>imu/data</topicName><updateRate>50</updateRate>{settings}</plugin>"
        ));
        assert_eq!(bench.said, "");
        let heard = bench.hear::<sensor_msgs::Imu>("/imu/data");
        bench.run(1.0);
        let heard = heard.drain();
        assert!((50..=51).contains(&heard.len()), "{}", heard.len());
        let mean = heard.iter().map(|it| it.angular_velocity.z).sum::<f64>() / heard.len() as f64;
        (heard.last().unwrap().clone(), mean)
    };
    let (last, _) = of("libgazebo_ros_imu.so", "");
    assert_eq!(last.header.frame_id, "base");
    near(&[last.angular_velocity.z, last.linear_acceleration.z], &[0.5, 0.0], 1e-6);
    near(&[2.0 * libm::atan2(last.orientation.z, last.orientation.w)], &[0.5], 0.02);

    let noise =
        "<rateGaussianNoise>0.005 0.005 0.005</rateGaussianNoise><rateOffset>0 0 0.1</rateOffset>
      <frameId>imu_link</frameId>";
    let (last, mean) = of("libhector_gazebo_ros_imu.so", noise);
    assert_eq!(last.header.frame_id, "imu_link");
    // The offset is an error of the measurement; gravity is felt.
    near(&[mean, last.linear_acceleration.z], &[0.6, 9.8], 0.003);
    assert!(last.angular_velocity.z != 0.6);
    near(&last.angular_velocity_covariance[8..], &[2.5e-5], 1e-12);
}
