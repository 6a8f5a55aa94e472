//! Drives of gz-sim.

use expect_test::expect;
use periplus_msgs::{nav_msgs, std_msgs, tf2_msgs};
use periplus_physics::PhysicsMode;

use crate::bench::*;

fn diff_drive(more: &str) -> String {
    format!(
        "<plugin filename='gz-sim-diff-drive-system' name='gz::sim::systems::DiffDrive'>
           <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
           <wheel_separation>0.4</wheel_separation><wheel_radius>0.1</wheel_radius>{more}</plugin>"
    )
}

#[test]
fn its_topics_and_frames() {
    let mut bench = Bench::exact(&diff_drive(""));
    expect![[r#"
        /DiffDrive <- /model/robot/cmd_vel geometry_msgs/msg/Twist reliable volatile 1
        /DiffDrive <- /model/robot/enable std_msgs/msg/Bool reliable volatile 1
        /DiffDrive -> /model/robot/odometry nav_msgs/msg/Odometry reliable volatile 1
        /DiffDrive -> /model/robot/tf tf2_msgs/msg/TFMessage reliable volatile 100
    "#]]
    .assert_eq(&bench.topics());
    let odometry = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry");
    let tf = bench.hear::<tf2_msgs::TFMessage>("/model/robot/tf");
    bench.say("/model/robot/cmd_vel").publish(twist(1.0, 0.0, 0.0));
    bench.run(1.0);
    let heard = odometry.drain();
    // 50 Hz.
    assert_eq!(heard.len(), 50);
    near(&numbers(&heard[49]), &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0], 1e-9);
    assert_eq!(
        (&*heard[49].header.frame_id, &*heard[49].child_frame_id),
        ("robot/odom", "robot/base")
    );
    assert_eq!(tf.latest().unwrap().transforms[0].child_frame_id, "robot/base");
}

#[test]
fn topics_and_frames_as_the_file_says() {
    let more = "<topic>cmd_vel</topic><odom_topic>/odom</odom_topic><tf_topic>tf</tf_topic>
                <frame_id>odom</frame_id><child_frame_id>base_link</child_frame_id>
                <odom_publish_frequency>10</odom_publish_frequency>";
    let mut bench = Bench::exact(&diff_drive(more));
    let odometry = bench.hear::<nav_msgs::Odometry>("/odom");
    let tf = bench.hear::<tf2_msgs::TFMessage>("/tf");
    bench.say("/cmd_vel").publish(twist(0.0, 0.0, 0.5));
    bench.run(1.0);
    let heard = odometry.drain();
    assert_eq!((heard.len(), tf.drain().len()), (10, 10));
    near(&numbers(&heard[9]), &[0.0, 0.0, 0.5, 0.0, 0.0, 0.5], 1e-9);
    assert_eq!((&*heard[9].header.frame_id, &*heard[9].child_frame_id), ("odom", "base_link"));
}

/// 0.5 m/s² for 1 s: 0.5 m/s, 0.25 m; then the limit of 0.5 m/s.
#[test]
fn limits_of_speed_and_acceleration() {
    let more = "<max_linear_acceleration>0.5</max_linear_acceleration>
                <max_velocity>0.5</max_velocity>";
    let mut bench = Bench::exact(&diff_drive(more));
    let odometry = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry");
    bench.say("/model/robot/cmd_vel").publish(twist(2.0, 0.0, 0.0));
    bench.run(1.0);
    near(&numbers(&odometry.latest().unwrap())[..1], &[0.25], 0.001);
    bench.run(1.0);
    near(&numbers(&odometry.latest().unwrap())[..4], &[0.75, 0.0, 0.0, 0.5], 0.001);
    assert_eq!(bench.devices[0].next_ns(), Some(2_020_000_000), "it has settled");
}

#[test]
fn disabled_it_stops_and_hears_nothing() {
    let mut bench = Bench::exact(&diff_drive(""));
    let odometry = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry");
    let commands = bench.say("/model/robot/cmd_vel");
    let enable = bench.say("/model/robot/enable");
    commands.publish(twist(1.0, 0.0, 0.0));
    bench.run(0.1);
    enable.publish(std_msgs::Bool { data: false });
    bench.run(0.1);
    commands.publish(twist(1.0, 0.0, 0.0));
    bench.run(0.1);
    enable.publish(std_msgs::Bool { data: true });
    bench.run(0.1);
    near(&numbers(&odometry.latest().unwrap())[..1], &[0.1], 1e-9);
    commands.publish(twist(1.0, 0.0, 0.0));
    bench.run(0.1);
    near(&numbers(&odometry.latest().unwrap())[..1], &[0.2], 1e-9);
}

/// Without subscribers it publishes nothing, and requests no step.
#[test]
fn unheard_it_asks_for_nothing() {
    let mut bench = Bench::exact(&diff_drive(""));
    bench.run(0.1);
    assert_eq!(bench.devices[0].next_ns(), None);
    let _ear = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry");
    assert_eq!(bench.devices[0].next_ns(), Some(120_000_000));
}

#[test]
fn with_physics_a_quarter_turn() {
    let mut bench = Bench::rigid(&diff_drive(""));
    let odometry = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry");
    bench.run(0.2);
    bench.say("/model/robot/cmd_vel").publish(twist(0.0, 0.0, std::f64::consts::FRAC_PI_2));
    bench.run(1.0);
    near(&numbers(&odometry.latest().unwrap())[2..3], &[1.57], 0.02);
    let yaw = bench.world.model_pose(bench.model).unwrap().rpy().yaw;
    near(&[yaw], &[1.57], 0.03);
}

/// Four wheels at the corners of a square of 1 m.
fn four_wheels(plugin: &str) -> String {
    let mut model = "<link name='base'/>".to_owned();
    for (name, x, y) in [("fl", 0.5, 0.5), ("fr", 0.5, -0.5), ("bl", -0.5, 0.5), ("br", -0.5, -0.5)]
    {
        model.push_str(&format!(
            "<link name='{name}'><pose>{x} {y} 0.2 0 0 0</pose></link>
             <joint name='{name}_joint' type='revolute'><parent>base</parent><child>{name}</child>
             <axis><xyz>0 1 0</xyz></axis></joint>"
        ));
    }
    model + plugin
}

/// To the left at 0.2 m/s on wheels of 0.2 m: the diagonals turn against each other at 1 rad/s.
#[test]
fn mecanum_wheels_go_sideways() {
    let plugin =
        "<plugin filename='gz-sim-mecanum-drive-system' name='gz::sim::systems::MecanumDrive'>
        <front_left_joint>fl_joint</front_left_joint><front_right_joint>fr_joint</front_right_joint>
        <back_left_joint>bl_joint</back_left_joint><back_right_joint>br_joint</back_right_joint>
        </plugin>";
    let mut bench = Bench::of(&four_wheels(plugin), PhysicsMode::Kinematic);
    let odometry = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry");
    bench.say("/model/robot/cmd_vel").publish(twist(0.0, 0.2, 0.0));
    bench.run(1.0);
    let angle = |joint: &str| {
        let joint = bench.world.find_joint(bench.model, joint).unwrap();
        bench.world.axis_state(joint).unwrap().position
    };
    near(
        &["fl_joint", "fr_joint", "bl_joint", "br_joint"].map(angle),
        &[-1.0, 1.0, 1.0, -1.0],
        1e-9,
    );
    near(&numbers(&odometry.latest().unwrap()), &[0.0, 0.2, 0.0, 0.0, 0.2, 0.0], 1e-9);
    let true_twist = bench.world.model_pose(bench.model).unwrap().translation;
    near(&[true_twist.x, true_twist.y], &[0.0, 0.2], 1e-9);
}

/// Wheel base 1 m, pivots 0.8 m apart: a circle of 4 m needs 1/3.6 and 1/4.4 as tangents.
#[test]
fn ackermann_steering() {
    let plugin = "<plugin filename='gz-sim-ackermann-steering-system'
          name='gz::sim::systems::AckermannSteering'>
        <left_joint>bl_joint</left_joint><right_joint>br_joint</right_joint>
        <left_steering_joint>fl_joint</left_steering_joint>
        <right_steering_joint>fr_joint</right_steering_joint>
        <steer_p_gain>10</steer_p_gain></plugin>";
    let mut bench = Bench::of(&four_wheels(plugin), PhysicsMode::Kinematic);
    let odometry = bench.hear::<nav_msgs::Odometry>("/model/robot/odometry");
    bench.say("/model/robot/cmd_vel").publish(twist(1.0, 0.0, 0.25));
    bench.run(2.0);
    let state = |joint: &str| {
        let joint = bench.world.find_joint(bench.model, joint).unwrap();
        bench.world.axis_state(joint).unwrap()
    };
    let tangents = ["fl_joint", "fr_joint"].map(|joint| libm::tan(state(joint).position));
    near(&tangents, &[1.0 / 3.6, 1.0 / 4.4], 1e-6);
    near(&["bl_joint", "br_joint"].map(|joint| state(joint).velocity), &[4.375, 5.625], 1e-9);
    let [.., speed, _, turning] = numbers(&odometry.latest().unwrap());
    // Counted along the mean of the two angles, which is a little more than the turn itself.
    let middle_rad = (libm::atan(1.0f64 / 3.6) + libm::atan(1.0f64 / 4.4)) / 2.0;
    near(&[speed, turning], &[1.0, libm::tan(middle_rad)], 1e-6);
}

#[test]
fn velocity_control_flies() {
    let plugin = "<plugin filename='gz-sim-velocity-control-system'
        name='gz::sim::systems::VelocityControl'><initial_linear>0.5 0 0.1</initial_linear></plugin>";
    for mode in [PhysicsMode::Kinematic, PhysicsMode::Rigid] {
        let model = format!("<pose>0 0 1 0 0 0</pose><link name='base'/>{plugin}");
        let mut bench = Bench::of(&model, mode);
        bench.run(1.0);
        let at = bench.world.model_pose(bench.model).unwrap().translation;
        // Gravity pulls for one step at a time.
        near(&at.to_array(), &[0.5, 0.0, 1.1], 0.012);
        bench.say("/model/robot/cmd_vel").publish(twist(0.0, 0.0, 0.0));
        bench.run(1.0);
        let still = bench.world.model_pose(bench.model).unwrap().translation;
        near(&still.to_array(), &at.to_array(), 0.012);
    }
}
