//! Plugins that cannot work are reported with position and reason, and the others run.

use expect_test::expect;

use crate::bench::*;

#[test]
fn a_wheel_joint_that_is_not_there() {
    let plugin = "
<plugin name='wheels' filename='libgazebo_ros_diff_drive.so'>
  <left_joint>left_jiont</left_joint><right_joint>caster_joint</right_joint>
</plugin>
<plugin filename='gz-sim-joint-state-publisher-system'
  name='gz::sim::systems::JointStatePublisher'><joint_name>elbow</joint_name>
  <joint_name>left_joint</joint_name></plugin>";
    let bench = Bench::exact(plugin);
    assert_eq!(bench.devices.len(), 1, "the other still publishes");
    expect![[r#"
        error[joint-missing]: plugin `wheels` uses the joint `left_jiont`, which does not exist
          --> robot.sdf:38:15
           |
        38 |   <left_joint>left_jiont</left_joint><right_joint>caster_joint</right_joint>
           |               ^^^^^^^^^^
           |
           = note: the joint is neither moved nor published; the rest of the model runs
           = help: movable joints: `left_joint`, `right_joint`
        help: did you mean `left_joint`?
           |
        38 -   <left_joint>left_jiont</left_joint><right_joint>caster_joint</right_joint>
        38 +   <left_joint>left_joint</left_joint><right_joint>caster_joint</right_joint>
           |

        error[joint-fixed]: plugin `wheels` uses the joint `caster_joint`, which is fixed
          --> robot.sdf:38:51
           |
        38 |   <left_joint>left_jiont</left_joint><right_joint>caster_joint</right_joint>
           |                                                   ^^^^^^^^^^^^
           |
           = help: use a revolute or prismatic joint

        error[joint-missing]: plugin `gz::sim::systems::JointStatePublisher` uses the joint `elbow`, which does not exist
          --> robot.sdf:41:60
           |
        41 |   name='gz::sim::systems::JointStatePublisher'><joint_name>elbow</joint_name>
           |                                                            ^^^^^
           |
           = note: the joint is neither moved nor published; the rest of the model runs
           = help: movable joints: `left_joint`, `right_joint`

    "#]].assert_eq(&bench.said);
}

#[test]
fn pairs_that_do_not_match() {
    let plugin = "
<plugin name='wheels' filename='libgazebo_ros_diff_drive.so'>
  <num_wheel_pairs>2</num_wheel_pairs>
  <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint></plugin>";
    let bench = Bench::exact(plugin);
    assert!(bench.devices.is_empty());
    expect![[r#"
        error[wheel-pairs]: plugin `wheels` has 1 left and 1 right joints for 2 pairs of wheels
          --> robot.sdf:37:1
           |
        37 | <plugin name='wheels' filename='libgazebo_ros_diff_drive.so'>
           | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
           |
           = note: the plugin is disabled; the rest of the model runs
           = help: give `left_joint` and `right_joint` once for each of `num_wheel_pairs`

    "#]]
    .assert_eq(&bench.said);
}

#[test]
fn the_same_name_twice_is_refused_as_in_ros_2() {
    let plugin = "<plugin name='truth' filename='libgazebo_ros_p3d.so'>
        <body_name>base</body_name></plugin>";
    let bench = Bench::exact(&plugin.repeat(2));
    assert_eq!(bench.devices.len(), 1);
    expect![[r#"
        error[plugin-refused]: plugin `truth` cannot be started: there is already a node `/truth`; give one of them another name (`__node:=`) or namespace (`__ns:=`)
          --> robot.sdf:37:45
           |
        37 |         <body_name>base</body_name></plugin><plugin name='truth' filename='libgazebo_ros_p3d.so'>
           |                                             ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^

    "#]].assert_eq(&bench.said);
}

#[test]
fn a_link_that_is_not_there() {
    let bench = Bench::exact(
        "<plugin name='truth' filename='libgazebo_ros_p3d.so'><body_name>bose</body_name></plugin>",
    );
    expect![[r#"
        error[link-missing]: plugin `truth` uses the link `bose`, which does not exist
          --> robot.sdf:36:65
           |
        36 | <plugin name='truth' filename='libgazebo_ros_p3d.so'><body_name>bose</body_name></plugin></model></world></sdf>
           |                                                                 ^^^^
           |
           = note: the plugin is disabled; the rest of the model runs
           = help: links of the model: `base`, `left`, `right`, `caster`
        help: did you mean `base`?
           |
        36 - <plugin name='truth' filename='libgazebo_ros_p3d.so'><body_name>bose</body_name></plugin></model></world></sdf>
        36 + <plugin name='truth' filename='libgazebo_ros_p3d.so'><body_name>base</body_name></plugin></model></world></sdf>
           |

    "#]].assert_eq(&bench.said);
}

#[test]
fn a_robot_without_controllers_is_told_what_to_do() {
    let bench = Bench::exact(
        "<plugin filename='gz_ros2_control-system'
           name='gz_ros2_control::GazeboSimROS2ControlPlugin'/>",
    );
    expect![[r#"
        warning[no-hardware]: plugin `gz_ros2_control::GazeboSimROS2ControlPlugin` finds no `<ros2_control>` in the robot's description, so it controls no joints
          --> robot.sdf:36:1
           |
        36 | <plugin filename='gz_ros2_control-system'
           | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
           |
           = help: add `<ros2_control>` with the joints and their interfaces

        warning[no-controllers]: plugin `gz_ros2_control::GazeboSimROS2ControlPlugin` has no controllers to start
          --> robot.sdf:36:1
           |
        36 | <plugin filename='gz_ros2_control-system'
           | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
           |
           = help: name a parameter file with controllers in `<parameters>` or by `--ros-args --params-file FILE.yaml`, or run the robot's launch file

    "#]].assert_eq(&bench.said);
}
