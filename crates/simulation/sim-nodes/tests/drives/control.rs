//! `ros2_control` and `ros_control`: controllers that drive joints and the robot.

use expect_test::expect;
use periplus_graph::GoalProgress;
use periplus_msgs::builtin_interfaces::{Duration, Time};
use periplus_msgs::control_msgs::{FollowJointTrajectory, FollowJointTrajectoryGoal};
use periplus_msgs::controller_manager_msgs::{
    ListControllers, SwitchController, SwitchControllerRequest,
};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::std_msgs::{Float64MultiArray, Header};
use periplus_msgs::trajectory_msgs::{JointTrajectory, JointTrajectoryPoint};
use periplus_msgs::{nav_msgs, sensor_msgs};
use periplus_physics::PhysicsMode;

use crate::bench::*;

/// `<ros2_control>` with command and state interfaces of joints.
fn hardware(joints: &[(&str, &str)]) -> String {
    let joint = |(name, command): &(&str, &str)| {
        format!(
            "<joint name='{name}'><command_interface name='{command}'/>
               <state_interface name='position'/><state_interface name='velocity'/></joint>"
        )
    };
    let joints: String = joints.iter().map(joint).collect();
    format!(
        "<ros2_control name='robot' type='system'>
           <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>{joints}
         </ros2_control>"
    )
}

fn plugin(parameters: &str) -> String {
    format!(
        "<plugin filename='gz_ros2_control-system' name='gz_ros2_control::GazeboSimROS2ControlPlugin'>
           <parameters>FILE:{parameters}</parameters></plugin>"
    )
}

const WHEELS: [(&str, &str); 2] = [("left_joint", "velocity"), ("right_joint", "velocity")];

const DIFF_DRIVE: &str = "
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    base: {type: diff_drive_controller/DiffDriveController}
base:
  ros__parameters:
    left_wheel_names: [left_joint]
    right_wheel_names: [right_joint]
    wheel_separation: 0.4
    wheel_radius: 0.1
";

fn stamped(twist: Twist) -> TwistStamped {
    TwistStamped { header: Header::default(), twist }
}

/// Pose of the robot: x, y, yaw.
fn pose(bench: &Bench) -> [f64; 3] {
    let pose = bench.world.model_pose(bench.model).unwrap();
    [pose.translation.x, pose.translation.y, pose.rpy().yaw]
}

/// Sends a command every 0.1 s.
fn drive(bench: &mut Bench, topic: &str, command: Twist, time_s: f64) {
    let publisher = bench.say::<TwistStamped>(topic);
    for _ in 0..(time_s * 10.0).round() as usize {
        publisher.publish(stamped(command.clone()));
        bench.run(0.1);
    }
}

#[test]
fn a_differential_drive_goes_a_metre_and_turns() {
    // With physics the wheels slide a little when they brake from full speed.
    let modes = [(PhysicsMode::Kinematic, 1e-9, 0.011), (PhysicsMode::Rigid, 0.03, 0.03)];
    for (mode, error, lag) in modes {
        let robot = format!("{ROBOT}{}{}", hardware(&WHEELS), plugin(DIFF_DRIVE));
        let mut bench = Bench::of(&robot, mode);
        let odometry = bench.hear::<nav_msgs::Odometry>("/base/odom");
        drive(&mut bench, "/base/cmd_vel", twist(0.5, 0.0, 0.0), 2.0);
        near(&pose(&bench), &[1.0, 0.0, 0.0], error);
        drive(&mut bench, "/base/cmd_vel", twist(0.0, 0.0, 0.0), 0.5);
        drive(&mut bench, "/base/cmd_vel", twist(0.0, 0.0, 0.5), 2.0);
        let pose = pose(&bench);
        near(&pose[2..], &[1.0], error);
        near(&pose[..2], &[1.0, 0.0], error);
        let told = odometry.drain();
        let last = told.last().unwrap();
        assert_eq!((&*last.header.frame_id, &*last.child_frame_id), ("odom", "base_link"));
        // One update late: 0.005 m and 0.005 rad.
        near(&numbers(last)[..3], &[1.0, 0.0, 1.0], lag);
    }
}

#[test]
fn topics_and_services_of_jazzy() {
    let robot = format!("{ROBOT}{}{}", hardware(&WHEELS), plugin(DIFF_DRIVE));
    let bench = Bench::of(&robot, PhysicsMode::Kinematic);
    expect![[r#"
        /base <- /base/cmd_vel geometry_msgs/msg/TwistStamped reliable volatile 10
        /base -> /base/odom nav_msgs/msg/Odometry reliable volatile 10
        /controller_manager -> /controller_manager/activity controller_manager_msgs/msg/ControllerManagerActivity reliable transient_local 1
        /joint_state_broadcaster -> /dynamic_joint_states control_msgs/msg/DynamicJointState reliable volatile 10
        /joint_state_broadcaster -> /joint_states sensor_msgs/msg/JointState reliable volatile 10
        /base -> /tf tf2_msgs/msg/TFMessage reliable volatile 100
    "#]].assert_eq(&bench.topics());
    expect![[r#"
        hint[controllers-started]: plugin `gz_ros2_control::GazeboSimROS2ControlPlugin`: no spawner is run, so these controllers of the parameter files are started: `joint_state_broadcaster`, `base`
          --> robot.sdf:40:25
           |
        40 |          </ros2_control><plugin filename='gz_ros2_control-system' name='gz_ros2_control::GazeboSimROS2ControlPlugin'>
           |                         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
           |
           = note: `base` receives `/base/cmd_vel` (geometry_msgs/msg/TwistStamped)

    "#]].assert_eq(&bench.said);
}

#[test]
fn a_command_expires_and_old_ones_are_dropped() {
    let robot = format!("{ROBOT}{}{}", hardware(&WHEELS), plugin(DIFF_DRIVE));
    let mut bench = Bench::of(&robot, PhysicsMode::Kinematic);
    bench.run(2.0);
    let publisher = bench.say::<TwistStamped>("/base/cmd_vel");
    let at = |time_s: i32| TwistStamped {
        header: Header { stamp: Time { sec: time_s, nanosec: 0 }, ..Header::default() },
        twist: twist(1.0, 0.0, 0.0),
    };
    publisher.publish(at(1));
    bench.run(1.0);
    near(&pose(&bench), &[0.0; 3], 1e-12);
    publisher.publish(at(3));
    bench.run(2.0);
    // It applies for 0.5 s, and until the next update.
    near(&pose(&bench), &[0.5, 0.0, 0.0], 0.0101);
}

#[test]
fn humble_takes_a_twist_without_a_stamp() {
    let parameters = format!("{DIFF_DRIVE}    use_stamped_vel: false\n");
    let classic = format!(
        "<plugin filename='libgazebo_ros2_control.so' name='control'>
           <parameters>FILE:{parameters}</parameters>
           <ros><namespace>bot</namespace><remapping>~/odom:=odom</remapping></ros></plugin>"
    );
    let robot = format!("{ROBOT}{}{classic}", hardware(&WHEELS));
    // Names of the file without a namespace.
    let mut bench = Bench::of(
        &robot
            .replace("\ncontroller_manager:", "\n/**/controller_manager:")
            .replace("\nbase:", "\n/**/base:"),
        PhysicsMode::Kinematic,
    );
    assert_eq!(bench.said.matches("controllers-started").count(), 1, "{}", bench.said);
    let odometry = bench.hear::<nav_msgs::Odometry>("/bot/odom");
    bench.say::<Twist>("/bot/base/cmd_vel_unstamped").publish(twist(1.0, 0.0, 0.0));
    bench.run(0.4);
    near(&pose(&bench), &[0.4, 0.0, 0.0], 1e-9);
    // The namespace is the prefix of the frames.
    assert_eq!(&*odometry.latest().unwrap().child_frame_id, "bot/base_link");
}

#[test]
fn a_claimed_interface_refuses_a_second_controller() {
    let second = format!(
        "{DIFF_DRIVE}wheels:
  ros__parameters:
    type: velocity_controllers/JointGroupVelocityController
    joints: [left_joint, right_joint]
"
    );
    let robot = format!("{ROBOT}{}{}", hardware(&WHEELS), plugin(&second));
    let mut bench = Bench::of(&robot, PhysicsMode::Kinematic);
    // The drive precedes the group, which stays inactive.
    assert!(bench.said.contains("controller-not-started"), "{}", bench.said);
    let client = bench.graph.node(periplus_graph::NodeSettings::new("client")).unwrap();
    let switch =
        client.client::<SwitchController>("/controller_manager/switch_controller").unwrap();
    let mut request = |activate: &[&str], deactivate: &[&str]| {
        let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
        let pending = switch.call(SwitchControllerRequest {
            activate_controllers: owned(activate),
            deactivate_controllers: owned(deactivate),
            strictness: SwitchControllerRequest::STRICT,
            ..SwitchControllerRequest::default()
        });
        bench.run(0.01);
        let answer = pending.take().unwrap().unwrap();
        (answer.ok, answer.message.clone())
    };
    let reason = "`wheels` cannot be activated: `left_joint/velocity` is claimed by the active \
                  controller `base`; deactivate it first";
    assert_eq!(request(&["wheels"], &[]), (false, reason.to_owned()));
    assert_eq!(request(&["wheels"], &["base"]), (true, String::new()));
    let list = client.client::<ListControllers>("/controller_manager/list_controllers").unwrap();
    let pending = list.call(Default::default());
    bench.run(0.01);
    let answer = pending.take().unwrap().unwrap();
    let states: Vec<String> =
        answer.controller.iter().map(|one| format!("{} {}", one.name, one.state)).collect();
    assert_eq!(states, ["joint_state_broadcaster active", "base inactive", "wheels active"]);
    assert_eq!(answer.controller[2].claimed_interfaces.len(), 2);
    // Both wheels at 5 rad/s.
    let joints = bench.hear::<sensor_msgs::JointState>("/joint_states");
    let data = vec![5.0, 5.0];
    bench
        .say::<Float64MultiArray>("/wheels/commands")
        .publish(Float64MultiArray { data, ..Float64MultiArray::default() });
    bench.run(0.1);
    near(&joints.latest().unwrap().velocity, &[5.0, 5.0], 1e-9);
    // Without physics the base rolls on them: 0.5 m/s, from the next update on.
    bench.run(0.9);
    near(&pose(&bench), &[0.5, 0.0, 0.0], 0.0051);
}

/// An arm that turns about a vertical axis.
const ARM: &str = r#"
  <link name="base"><inertial><mass>1000</mass><inertia><ixx>100</ixx><iyy>100</iyy><izz>100</izz>
    </inertia></inertial></link>
  <link name="arm"><pose>0 0 1 0 0 0</pose>
    <inertial><mass>4</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>
  <joint name="world_joint" type="fixed"><parent>world</parent><child>base</child></joint>
  <joint name="elbow" type="revolute"><parent>base</parent><child>arm</child>
    <axis><xyz>0 0 1</xyz></axis></joint>
"#;

const TRAJECTORY: &str = "
controller_manager:
  ros__parameters:
    update_rate: 100
arm:
  ros__parameters:
    type: joint_trajectory_controller/JointTrajectoryController
    joints: [elbow]
    command_interfaces: [position]
    state_interfaces: [position, velocity]
    constraints: {elbow: {goal: 0.01}, goal_time: 2.0}
";

fn elbow(bench: &Bench) -> f64 {
    let joint = bench.world.find_joint(bench.model, "elbow").unwrap();
    bench.world.axis_state(joint).unwrap().position
}

#[test]
fn a_joint_trajectory_reaches_its_points() {
    for mode in [PhysicsMode::Kinematic, PhysicsMode::Rigid] {
        let robot = format!("{ARM}{}{}", hardware(&[("elbow", "position")]), plugin(TRAJECTORY));
        let mut bench = Bench::of(&robot, mode);
        let client = bench.graph.node(periplus_graph::NodeSettings::new("client")).unwrap();
        let action =
            client.action_client::<FollowJointTrajectory>("/arm/follow_joint_trajectory").unwrap();
        let point = |position: f64, sec: i32| JointTrajectoryPoint {
            positions: vec![position],
            time_from_start: Duration { sec, nanosec: 0 },
            ..JointTrajectoryPoint::default()
        };
        let goal = FollowJointTrajectoryGoal {
            trajectory: JointTrajectory {
                joint_names: vec!["elbow".into()],
                points: vec![point(0.5, 1), point(-0.5, 3)],
                ..JointTrajectory::default()
            },
            ..FollowJointTrajectoryGoal::default()
        };
        let sent = action.send(goal);
        bench.run(1.0);
        assert!(matches!(sent.look(), GoalProgress::Accepted));
        // The speed of a position error is 10/s: 0.5 rad/s lag by 0.05 rad.
        near(&[elbow(&bench)], &[0.45], 0.02);
        bench.run(3.5);
        near(&[elbow(&bench)], &[-0.5], 0.01);
        let GoalProgress::Over(_, result) = sent.look() else { panic!("{mode:?} goes on") };
        assert_eq!((result.error_code, &*result.error_string), (0, "goal reached"));
    }
}

/// A car: two driven wheels behind, two steered ones 0.5 m ahead; wheels of 0.1 m.
fn car() -> String {
    let wheel = |name: &str, x: f64, y: f64| {
        format!(
            "<link name='{name}'><pose>{x} {y} 0.1 0 0 0</pose>
               <inertial><mass>0.5</mass>
                 <inertia><ixx>0.0013</ixx><iyy>0.0025</iyy><izz>0.0013</izz></inertia></inertial>
               <collision name='c'><pose>0 0 0 1.5707963267948966 0 0</pose><geometry>
                 <cylinder><radius>0.1</radius><length>0.04</length></cylinder></geometry></collision>
             </link>"
        )
    };
    let upright = |name: &str, x: f64, y: f64| {
        format!(
            "<link name='{name}'><pose>{x} {y} 0.1 0 0 0</pose><inertial><mass>0.5</mass>
               <inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial></link>"
        )
    };
    let joint = |name: &str, parent: &str, child: &str, axis: &str| {
        format!(
            "<joint name='{name}' type='revolute'><parent>{parent}</parent><child>{child}</child>
               <axis><xyz>{axis}</xyz></axis></joint>"
        )
    };
    let mut text = "<link name='base'><pose>0.25 0 0.15 0 0 0</pose><inertial><mass>10</mass>
        <inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia></inertial></link>"
        .to_owned();
    for (side, y) in [("left", 0.2), ("right", -0.2)] {
        text += &wheel(&format!("rear_{side}"), 0.0, y);
        text += &upright(&format!("kingpin_{side}"), 0.5, y);
        text += &wheel(&format!("front_{side}"), 0.5, y);
        text += &joint(&format!("rear_{side}_joint"), "base", &format!("rear_{side}"), "0 1 0");
        text += &joint(&format!("steer_{side}"), "base", &format!("kingpin_{side}"), "0 0 1");
        let (kingpin, front) = (format!("kingpin_{side}"), format!("front_{side}"));
        text += &joint(&format!("front_{side}_joint"), &kingpin, &front, "0 1 0");
    }
    text
}

#[test]
fn an_ackermann_car_follows_a_circle() {
    let joints = [
        ("rear_right_joint", "velocity"),
        ("rear_left_joint", "velocity"),
        ("steer_right", "position"),
        ("steer_left", "position"),
    ];
    let parameters = "
car:
  ros__parameters:
    type: ackermann_steering_controller/AckermannSteeringController
    traction_joints_names: [rear_right_joint, rear_left_joint]
    steering_joints_names: [steer_right, steer_left]
    wheelbase: 0.5
    traction_track_width: 0.4
    steering_track_width: 0.4
    traction_wheels_radius: 0.1
";
    for (mode, error) in [(PhysicsMode::Kinematic, 0.02), (PhysicsMode::Rigid, 0.06)] {
        let robot = format!("{}{}{}", car(), hardware(&joints), plugin(parameters));
        let mut bench = Bench::of(&robot, mode);
        // 2 m of radius. The steering first needs some time.
        drive(&mut bench, "/car/reference", twist(0.01, 0.0, 0.005), 2.0);
        let [x, y, yaw] = pose(&bench);
        drive(&mut bench, "/car/reference", twist(0.5, 0.0, 0.25), 4.0);
        let [x_end, y_end, yaw_end] = pose(&bench);
        // One radian on 2 m: a chord of 4 sin(0.5).
        near(&[yaw_end - yaw], &[1.0], error);
        let chord_m = libm::hypot(x_end - x, y_end - y);
        near(&[chord_m], &[4.0 * libm::sin(0.5)], 2.0 * error);
    }
}

#[test]
fn mecanum_wheels_move_sideways() {
    let names = ["rear_left_joint", "rear_right_joint", "front_left_joint", "front_right_joint"];
    let joints = names.map(|name| (name, "velocity"));
    let wheels: String = ["front_left", "front_right", "rear_right", "rear_left"]
        .iter()
        .map(|wheel| format!("    {wheel}_wheel_command_joint_name: {wheel}_joint\n"))
        .collect();
    let parameters = format!(
        "
mecanum:
  ros__parameters:
    type: mecanum_drive_controller/MecanumDriveController
    reference_timeout: 0.5
    kinematics.wheels_radius: 0.1
    kinematics.sum_of_robot_center_projection_on_X_Y_axis: 0.45
{wheels}"
    );
    let robot = format!("{}{}{}", car(), hardware(&joints), plugin(&parameters));
    let mut bench = Bench::of(&robot, PhysicsMode::Kinematic);
    let odometry = bench.hear::<nav_msgs::Odometry>("/mecanum/odometry");
    drive(&mut bench, "/mecanum/reference", twist(0.0, 0.5, 0.0), 2.0);
    near(&pose(&bench), &[0.0, 1.0, 0.0], 1e-9);
    near(&numbers(&odometry.latest().unwrap())[..3], &[0.0, 1.0, 0.0], 0.011);
}

#[test]
fn a_robot_of_ros_1_without_parameters_is_told_what_to_do() {
    let robot = format!(
        "{ROBOT}<transmission name='left'><joint name='left_joint'>
           <hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint>
         </transmission>
         <plugin filename='libgazebo_ros_control.so' name='gazebo_ros_control'/>"
    );
    let bench = Bench::of(&robot, PhysicsMode::Kinematic);
    expect![[r#"
        warning[no-controllers]: plugin `gazebo_ros_control` has no controllers to start
          --> robot.sdf:39:10
           |
        39 |          <plugin filename='libgazebo_ros_control.so' name='gazebo_ros_control'/></model></world></sdf>
           |          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
           |
           = note: controllers of ROS 1 are in the parameter server, which launch files fill
           = help: run the robot's launch file: `periplus launch PACKAGE FILE`, or give their parameters in the form of ROS 2: `--ros-args --params-file FILE.yaml`

    "#]].assert_eq(&bench.said);
}

#[test]
fn a_saved_drive_goes_on() {
    let robot = format!("{ROBOT}{}{}", hardware(&WHEELS), plugin(DIFF_DRIVE));
    let mut bench = Bench::of(&robot, PhysicsMode::Kinematic);
    let odometry = bench.hear::<nav_msgs::Odometry>("/base/odom");
    drive(&mut bench, "/base/cmd_vel", twist(0.5, 0.0, 0.2), 1.0);
    let saved: Vec<_> = bench.devices.iter().map(|device| device.save()).collect();
    let (world, now_ns) = (bench.world.clone(), bench.now_ns());
    drop(odometry.drain());
    bench.run(0.3);
    let first = odometry.drain();
    bench.world = world;
    bench.go_back_to(now_ns);
    for (device, saved) in bench.devices.iter_mut().zip(&saved) {
        assert!(device.restore(saved));
    }
    bench.run(0.3);
    let again = odometry.drain();
    assert_eq!(first.len(), again.len());
    assert!(!first.is_empty() && first == again);
}

#[test]
fn a_reset_starts_the_odometry_at_zero() {
    let robot = format!("{ROBOT}{}{}", hardware(&WHEELS), plugin(DIFF_DRIVE));
    let mut bench = Bench::of(&robot, PhysicsMode::Kinematic);
    let odometry = bench.hear::<nav_msgs::Odometry>("/base/odom");
    drive(&mut bench, "/base/cmd_vel", twist(0.5, 0.0, 0.0), 1.0);
    bench.reset();
    drop(odometry.drain());
    bench.run(0.1);
    near(&numbers(&odometry.latest().unwrap()), &[0.0; 6], 1e-9);
    drive(&mut bench, "/base/cmd_vel", twist(0.5, 0.0, 0.0), 1.0);
    near(&pose(&bench), &[0.5, 0.0, 0.0], 1e-9);
}
