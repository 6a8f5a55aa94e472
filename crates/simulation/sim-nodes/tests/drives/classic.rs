//! Drives of Gazebo Classic.

use expect_test::expect;
use periplus_msgs::{geometry_msgs, nav_msgs, sensor_msgs, std_msgs, tf2_msgs};
use periplus_physics::PhysicsMode;

use crate::bench::*;

fn diff_drive(more: &str) -> String {
    format!(
        "<plugin name='wheels' filename='libgazebo_ros_diff_drive.so'>
           <ros><namespace>/demo</namespace></ros>
           <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
           <wheel_separation>0.4</wheel_separation><wheel_diameter>0.2</wheel_diameter>
           <publish_odom>true</publish_odom><publish_odom_tf>true</publish_odom_tf>
           {more}</plugin>"
    )
}

const ENCODERS: &str = "<odometry_source>0</odometry_source>";

#[test]
fn its_topics_types_and_qualities() {
    let more = "<publish_wheel_tf>true</publish_wheel_tf>";
    expect![[r#"
        /demo/wheels <- /demo/cmd_vel geometry_msgs/msg/Twist reliable volatile 1
        /demo/wheels -> /demo/odom nav_msgs/msg/Odometry reliable volatile 1
        /demo/wheels -> /tf tf2_msgs/msg/TFMessage reliable volatile 100
        /demo/wheels -> /tf tf2_msgs/msg/TFMessage reliable volatile 100
    "#]]
    .assert_eq(&Bench::exact(&diff_drive(more)).topics());
}

/// One metre per second for one second; the wheels of 0.1 m turn at 10 rad/s.
#[test]
fn one_metre_in_one_second() {
    for source in ["", ENCODERS] {
        let mut bench = Bench::exact(&diff_drive(source));
        let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
        let tf = bench.hear::<tf2_msgs::TFMessage>("/tf");
        bench.say("/demo/cmd_vel").publish(twist(1.0, 0.0, 0.0));
        bench.run(1.0);
        let heard = odometry.drain();
        // Every 10 ms, first after 10 ms.
        assert_eq!(heard.len(), 100);
        assert_eq!(heard[0].header.stamp.nanosec, 10_000_000);
        let last = &heard[99];
        assert_eq!((&*last.header.frame_id, &*last.child_frame_id), ("odom", "base_footprint"));
        near(&numbers(last), &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0], 1e-9);
        let covariance = last.pose.covariance;
        assert_eq!([0, 7, 14, 35].map(|index| covariance[index]), [1e-5, 1e-5, 1e12, 1e-3]);
        assert_eq!(last.twist.covariance, covariance);
        let transforms = tf.drain();
        let transform = &transforms.last().unwrap().transforms[0];
        assert_eq!(transform.child_frame_id, "base_footprint");
        assert!((transform.transform.translation.x - 1.0).abs() < 1e-9);
        let left = bench.world.find_joint(bench.model, "left_joint").unwrap();
        let state = bench.world.axis_state(left).unwrap();
        near(&[state.position, state.velocity], &[10.0, 10.0], 1e-9);
    }
}

/// Odometry of type world starts at the true pose, odometry of wheels at zero.
#[test]
fn truth_starts_where_the_robot_stands_and_wheels_at_zero() {
    for (source, start_m) in [("", 2.0), (ENCODERS, 0.0)] {
        let mut bench = Bench::exact(&format!("<pose>2 0 0 0 0 0</pose>{}", diff_drive(source)));
        let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
        bench.say("/demo/cmd_vel").publish(twist(0.5, 0.0, 0.0));
        bench.run(1.0);
        near(&numbers(&odometry.latest().unwrap())[..1], &[start_m + 0.5], 1e-9);
    }
}

/// Half a circle of 1 m radius ends 2 m to the left.
#[test]
fn half_a_circle_by_wheels_and_by_truth() {
    let pi = std::f64::consts::PI;
    for source in ["", ENCODERS] {
        let mut bench = Bench::exact(&diff_drive(source));
        let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
        bench.say("/demo/cmd_vel").publish(twist(1.0, 0.0, 1.0));
        bench.run(pi);
        let [x, y, yaw, ..] = numbers(&odometry.latest().unwrap());
        // The last message is 1.6 ms old.
        near(&[x, y, yaw.abs()], &[0.0, 2.0, pi], 0.01);
    }
}

#[test]
fn with_physics_it_does_nearly_the_same() {
    let mut bench = Bench::rigid(&diff_drive(ENCODERS));
    let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
    bench.run(0.5);
    bench.say("/demo/cmd_vel").publish(twist(0.5, 0.0, 0.0));
    bench.run(2.0);
    let [x, y, yaw, speed, ..] = numbers(&odometry.latest().unwrap());
    near(&[x, y, yaw, speed], &[1.0, 0.0, 0.0, 0.5], 0.02);
    let true_twist = bench.world.model_pose(bench.model).unwrap().translation;
    near(&[true_twist.x, true_twist.y], &[x, y], 0.02);
}

/// 1 m/s² reaches 0.5 m/s in half a second, on 12.5 cm; without physics it is the same ramp.
#[test]
fn a_limit_of_acceleration() {
    let more = format!("{ENCODERS}<max_wheel_acceleration>1</max_wheel_acceleration>");
    let mut bench = Bench::exact(&diff_drive(&more));
    let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
    bench.say("/demo/cmd_vel").publish(twist(0.5, 0.0, 0.0));
    bench.run(0.25);
    let [x, _, _, speed, ..] = numbers(&odometry.latest().unwrap());
    near(&[x, speed], &[0.03125, 0.25], 0.015);
    bench.run(0.75);
    let [x, ..] = numbers(&odometry.latest().unwrap());
    near(&[x], &[0.375], 0.015);
}

/// Steps of 10 ms, as without physics, give what steps of 1 ms give.
#[test]
fn long_steps_give_the_same() {
    let position = |step_ns: i64| {
        let mut bench = Bench::exact(&diff_drive(ENCODERS));
        let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
        bench.say("/demo/cmd_vel").publish(twist(0.5, 0.0, 0.3));
        bench.run_in_steps(2.0, step_ns);
        numbers(&odometry.latest().unwrap())
    };
    near(&position(10_000_000), &position(STEP_NS), 1e-5);
}

#[test]
fn the_last_command_holds_and_nonsense_is_passed_over() {
    let mut bench = Bench::exact(&diff_drive(""));
    let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
    let commands = bench.say("/demo/cmd_vel");
    commands.publish(twist(0.1, 0.0, 0.0));
    bench.run(1.0);
    commands.publish(twist(f64::NAN, 0.0, 0.0));
    bench.run(9.0);
    near(&numbers(&odometry.latest().unwrap())[..1], &[1.0], 1e-9);
}

#[test]
fn stamped_commands_where_the_plugin_asks_for_them() {
    let plugin = diff_drive("")
        .replace("</ros>", "<parameter name='use_stamped_vel' type='bool'>true</parameter></ros>");
    let mut bench = Bench::exact(&plugin);
    let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
    let stamped = geometry_msgs::TwistStamped { twist: twist(0.5, 0.0, 0.0), ..Default::default() };
    bench.say("/demo/cmd_vel").publish(stamped);
    bench.run(1.0);
    near(&numbers(&odometry.latest().unwrap())[..1], &[0.5], 1e-9);
}

#[test]
fn a_reset_run_is_the_same_run() {
    let mut bench = Bench::rigid(&diff_drive(ENCODERS));
    let odometry = bench.hear::<nav_msgs::Odometry>("/demo/odom");
    let commands = bench.say("/demo/cmd_vel");
    let mut runs = Vec::new();
    for _ in 0..2 {
        bench.reset();
        commands.publish(twist(0.4, 0.0, 0.7));
        bench.run(1.0);
        runs.push(odometry.drain());
    }
    assert!(runs[0].len() == 100 && runs[0] == runs[1]);
}

#[test]
fn wheels_are_told_on_the_link_that_carries_them() {
    let mut bench = Bench::exact(&diff_drive("<publish_wheel_tf>true</publish_wheel_tf>"));
    let tf = bench.hear::<tf2_msgs::TFMessage>("/tf");
    bench.run(0.01);
    let heard = tf.drain();
    let wheels = &heard.last().unwrap().transforms;
    let found: Vec<_> = wheels
        .iter()
        .map(|one| {
            let at = &one.transform.translation;
            let rounded = [at.x, at.y, at.z].map(|value| (value * 1e6).round() / 1e6);
            (&*one.header.frame_id, &*one.child_frame_id, rounded)
        })
        .collect();
    assert_eq!(
        found,
        [("base", "left", [-0.05, 0.2, -0.05]), ("base", "right", [-0.05, -0.2, -0.05])]
    );
}

/// In Noetic `publishTf` applies to all transforms, and the twist has no covariance.
#[test]
fn diff_drive_of_ros_1() {
    let plugin = "<plugin name='old' filename='libgazebo_ros_diff_drive.so'>
        <robotNamespace>bot</robotNamespace><commandTopic>go</commandTopic>
        <leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>
        <wheelSeparation>0.4</wheelSeparation><wheelDiameter>0.2</wheelDiameter>
        <odometrySource>encoder</odometrySource><legacyMode>false</legacyMode>
        <publishWheelJointState>true</publishWheelJointState></plugin>";
    let mut bench = Bench::exact(plugin);
    expect![[r#"
        /bot/old <- /bot/go geometry_msgs/msg/Twist reliable volatile 1
        /bot/old -> /bot/joint_states sensor_msgs/msg/JointState reliable volatile 1000
        /bot/old -> /bot/odom nav_msgs/msg/Odometry reliable volatile 1
        /bot/old -> /tf tf2_msgs/msg/TFMessage reliable volatile 100
    "#]]
    .assert_eq(&bench.topics());
    let odometry = bench.hear::<nav_msgs::Odometry>("/bot/odom");
    let states = bench.hear::<sensor_msgs::JointState>("/bot/joint_states");
    bench.say("/bot/go").publish(twist(0.0, 0.0, 1.0));
    bench.run(1.0);
    let last = odometry.latest().unwrap();
    near(&numbers(&last), &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 1e-9);
    assert_eq!(last.pose.covariance[35], 1e-3);
    assert_eq!(last.twist.covariance, [0.0; 36]);
    // 1 rad/s at 0.2 m is 0.2 m/s: 2 rad/s on 0.1 m, and 2 rad after a second.
    let last = states.latest().unwrap();
    assert_eq!(last.name, ["right_joint", "left_joint"]);
    near(&last.position, &[2.0, -2.0], 1e-9);
}

/// A robot without `legacyMode` turns left on a positive command, for any names of its joints.
#[test]
fn legacy_mode_follows_the_wheels_where_nobody_says() {
    for (left, right, wanted) in
        [("left_joint", "right_joint", "false"), ("right_joint", "left_joint", "true")]
    {
        let plugin = format!(
            "<plugin name='old' filename='libgazebo_ros_diff_drive.so'>
             <leftJoint>{left}</leftJoint><rightJoint>{right}</rightJoint>
             <wheelSeparation>0.4</wheelSeparation><wheelDiameter>0.2</wheelDiameter></plugin>"
        );
        let mut bench = Bench::exact(&plugin);
        assert!(bench.said.contains(&format!("taken as `{wanted}`")), "{}", bench.said);
        let odometry = bench.hear::<nav_msgs::Odometry>("/odom");
        bench.say("/cmd_vel").publish(twist(0.0, 0.0, 1.0));
        bench.run(1.0);
        near(&numbers(&odometry.latest().unwrap())[2..3], &[1.0], 1e-9);
        let plugin = plugin.replace("</plugin>", "<legacyMode>true</legacyMode></plugin>");
        let mut told = Bench::exact(&plugin);
        assert_eq!(told.said, "");
        told.say("/cmd_vel").publish(twist(0.0, 0.0, 1.0));
        told.run(1.0);
        let left = told.world.find_joint(told.model, "left_joint").unwrap();
        let sign = if wanted == "true" { -1.0 } else { 1.0 };
        near(&[told.world.axis_state(left).unwrap().position], &[2.0 * sign], 1e-9);
    }
}

#[test]
fn skid_steering_moves_both_pairs_alike() {
    let plugin = "<plugin name='skid' filename='libgazebo_ros_skid_steer_drive.so'>
        <leftFrontJoint>left_joint</leftFrontJoint><rightFrontJoint>right_joint</rightFrontJoint>
        <leftRearJoint>left_joint</leftRearJoint><rightRearJoint>right_joint</rightRearJoint>
        <wheelSeparation>0.4</wheelSeparation><wheelDiameter>0.2</wheelDiameter>
        <broadcastTF>true</broadcastTF></plugin>";
    let mut bench = Bench::exact(plugin);
    let odometry = bench.hear::<nav_msgs::Odometry>("/odom");
    bench.say("/cmd_vel").publish(twist(0.5, 0.0, 0.0));
    bench.run(1.0);
    let last = odometry.latest().unwrap();
    near(&numbers(&last), &[0.5, 0.0, 0.0, 0.5, 0.0, 0.0], 1e-9);
    assert_eq!([0, 35].map(|index| last.pose.covariance[index]), [1e-4, 1e-2]);
    assert_eq!(last.twist.covariance, last.pose.covariance);
}

#[test]
fn a_planar_robot_slides_sideways() {
    let plugin = "<plugin name='slide' filename='libgazebo_ros_planar_move.so'>
        <robot_base_frame>base</robot_base_frame><update_rate>0</update_rate></plugin>";
    for mode in [PhysicsMode::Kinematic, PhysicsMode::Rigid] {
        let mut bench = match mode {
            PhysicsMode::Kinematic => Bench::exact(plugin),
            PhysicsMode::Rigid => Bench::rigid(plugin),
        };
        let odometry = bench.hear::<nav_msgs::Odometry>("/odom");
        let tf = bench.hear::<tf2_msgs::TFMessage>("/tf");
        bench.say("/cmd_vel").publish(twist(0.0, 0.5, 0.0));
        bench.run(1.0);
        let heard = odometry.drain();
        // Every 50 ms.
        assert_eq!((heard.len(), tf.drain().len()), (20, 20));
        let error = if mode == PhysicsMode::Kinematic { 1e-9 } else { 0.01 };
        near(&numbers(&heard[19])[..2], &[0.0, 0.5], error);
        assert_eq!(heard[19].pose.covariance[35], 1e-3);
    }
}

/// Only the plugin of ROS 1 has a command timeout, and only if it is set.
#[test]
fn a_command_is_forgotten_after_its_time() {
    let plugin = "<plugin name='slide' filename='libgazebo_ros_planar_move.so'>
        <commandTopic>cmd_vel</commandTopic><odometryRate>10</odometryRate>
        <cmdTimeout>0.5</cmdTimeout></plugin>";
    let mut bench = Bench::exact(plugin);
    let odometry = bench.hear::<nav_msgs::Odometry>("/odom");
    bench.say("/cmd_vel").publish(twist(1.0, 0.0, 0.0));
    bench.run(2.0);
    near(&numbers(&odometry.latest().unwrap())[..1], &[0.5], 0.002);
}

/// A tricycle: the base's origin is between the wheels behind, a steered wheel 0.5 m ahead.
const TRICYCLE: &str = r#"
  <link name="base"/>
  <link name="left"><pose>0 0.25 0.1 0 0 0</pose></link>
  <link name="right"><pose>0 -0.25 0.1 0 0 0</pose></link>
  <link name="fork"><pose>0.5 0 0.1 0 0 0</pose></link>
  <link name="front"><pose>0.5 0 0.1 0 0 0</pose></link>
  <joint name="l" type="revolute"><parent>base</parent><child>left</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="r" type="revolute"><parent>base</parent><child>right</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="s" type="revolute"><parent>base</parent><child>fork</child>
    <axis><xyz>0 0 1</xyz></axis></joint>
  <joint name="f" type="revolute"><parent>fork</parent><child>front</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
"#;

/// Steered by 45 degrees, 0.5 m ahead of the axle, it turns about a point 0.5 m to the left:
/// √½ m/s of 1 m/s go ahead, and it turns by √2 rad/s.
#[test]
fn a_tricycle_steered_by_45_degrees() {
    for source in ["", ENCODERS] {
        tricycle_steered_by_45_degrees(source);
    }
}

fn tricycle_steered_by_45_degrees(source: &str) {
    let plugin = "<plugin name='tri' filename='libgazebo_ros_tricycle_drive.so'>
        <steering_joint>s</steering_joint><actuated_wheel_joint>f</actuated_wheel_joint>
        <encoder_wheel_left_joint>l</encoder_wheel_left_joint>
        <encoder_wheel_right_joint>r</encoder_wheel_right_joint>
        <actuated_wheel_diameter>0.2</actuated_wheel_diameter>
        <encoder_wheel_diameter>0.2</encoder_wheel_diameter>
        <publish_odom>true</publish_odom>
        <publish_wheel_joint_state>true</publish_wheel_joint_state></plugin>";
    let mut bench = Bench::of(
        &format!("{TRICYCLE}{}", plugin.replace("</plugin>", &format!("{source}</plugin>"))),
        PhysicsMode::Kinematic,
    );
    let odometry = bench.hear::<nav_msgs::Odometry>("/odom");
    let states = bench.hear::<sensor_msgs::JointState>("/joint_states");
    bench.say("/cmd_vel").publish(twist(1.0, 0.0, std::f64::consts::FRAC_PI_4));
    bench.run(1.0);
    let last = odometry.latest().unwrap();
    let root = std::f64::consts::SQRT_2;
    near(&numbers(&last)[3..], &[root / 2.0, 0.0, root], 0.001);
    assert_eq!(last.child_frame_id, "base_link");
    let states = states.latest().unwrap();
    assert_eq!(states.name, ["s", "f", "l", "r"]);
    near(&states.velocity[1..2], &[10.0], 1e-9);
}

/// A car 2 m long, its origin under the middle of the rear axle.
const CAR: &str = r#"
  <link name="base"/>
  <link name="fl_fork"><pose>2 0.5 0.3 0 0 0</pose></link>
  <link name="fr_fork"><pose>2 -0.5 0.3 0 0 0</pose></link>
  <link name="fl"><pose>2 0.5 0.3 0 0 0</pose></link>
  <link name="fr"><pose>2 -0.5 0.3 0 0 0</pose></link>
  <link name="rl"><pose>0 0.5 0.3 0 0 0</pose></link>
  <link name="rr"><pose>0 -0.5 0.3 0 0 0</pose>
    <collision name="tyre"><geometry><sphere><radius>0.3</radius></sphere></geometry></collision>
  </link>
  <joint name="left_steering_joint" type="revolute"><parent>base</parent><child>fl_fork</child>
    <axis><xyz>0 0 1</xyz></axis></joint>
  <joint name="right_steering_joint" type="revolute"><parent>base</parent><child>fr_fork</child>
    <axis><xyz>0 0 1</xyz></axis></joint>
  <joint name="front_left_joint" type="revolute"><parent>fl_fork</parent><child>fl</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="front_right_joint" type="revolute"><parent>fr_fork</parent><child>fr</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="rear_left_joint" type="revolute"><parent>base</parent><child>rl</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="rear_right_joint" type="revolute"><parent>base</parent><child>rr</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
"#;

/// `angular.z` is the angle of the steering; `atan(0.5)` on 2 m turns about a point 4 m away.
#[test]
fn a_car_steers_by_an_angle() {
    let plugin = "<plugin name='car' filename='libgazebo_ros_ackermann_drive.so'>
        <publish_odom>true</publish_odom><publish_distance>true</publish_distance>
        <linear_velocity_pid_gain>1 0 0</linear_velocity_pid_gain>
        <left_steering_pid_gain>1 0 0</left_steering_pid_gain>
        <right_steering_pid_gain>1 0 0</right_steering_pid_gain></plugin>";
    let mut bench = Bench::of(&format!("{CAR}{plugin}"), PhysicsMode::Kinematic);
    assert_eq!(bench.said, "");
    let odometry = bench.hear::<nav_msgs::Odometry>("/odom");
    let distance = bench.hear::<std_msgs::Float32>("/distance");
    let steer_rad = libm::atan(0.5f64);
    bench.say("/cmd_vel").publish(twist(2.0, 0.0, steer_rad));
    bench.run(1.0);
    near(&numbers(&odometry.latest().unwrap())[3..], &[2.0, 0.0, 0.5], 1e-9);
    near(&[f64::from(distance.latest().unwrap().data)], &[2.0], 0.005);
    let angle = |joint: &str| {
        let joint = bench.world.find_joint(bench.model, joint).unwrap();
        bench.world.axis_state(joint).unwrap().position
    };
    // 3.5 m and 4.5 m from the centre's line.
    let expected = [libm::atan(2.0f64 / 3.5), libm::atan(2.0f64 / 4.5)];
    near(&[angle("left_steering_joint"), angle("right_steering_joint")], &expected, 1e-6);
    let standing = Bench::of(
        &format!("{CAR}<plugin name='car' filename='libgazebo_ros_ackermann_drive.so'/>"),
        PhysicsMode::Kinematic,
    );
    assert!(standing.said.contains("the car will not move"), "{}", standing.said);
}
