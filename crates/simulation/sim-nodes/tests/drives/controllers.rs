//! Controllers of single joints.

use expect_test::expect;
use periplus_msgs::std_msgs;
use periplus_physics::PhysicsMode;

use crate::bench::*;

/// An arm that turns about a vertical axis: half a metre, 1 kg m² about it.
const ARM: &str = r#"
  <link name="base"><inertial><mass>1000</mass><inertia><ixx>100</ixx><iyy>100</iyy><izz>100</izz>
    </inertia></inertial></link>
  <link name="arm"><pose>0 0 1 0 0 0</pose>
    <inertial><mass>4</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>
  <joint name="world_joint" type="fixed"><parent>world</parent><child>base</child></joint>
  <joint name="elbow" type="revolute"><parent>base</parent><child>arm</child>
    <axis><xyz>0 0 1</xyz></axis></joint>
"#;

fn bench(plugin: &str, mode: PhysicsMode) -> Bench {
    Bench::of(&format!("{ARM}{plugin}"), mode)
}

fn state(bench: &Bench) -> [f64; 2] {
    let joint = bench.world.find_joint(bench.model, "elbow").unwrap();
    let state = bench.world.axis_state(joint).unwrap();
    [state.position, state.velocity]
}

#[test]
fn a_joint_turns_at_the_speed_it_is_told() {
    let plugin = "<plugin filename='gz-sim-joint-controller-system'
        name='gz::sim::systems::JointController'><joint_name>elbow</joint_name>
        <initial_velocity>2</initial_velocity></plugin>";
    for mode in [PhysicsMode::Kinematic, PhysicsMode::Rigid] {
        let mut bench = bench(plugin, mode);
        expect![[r#"
            /JointController <- /model/robot/joint/elbow/cmd_vel std_msgs/msg/Float64 reliable volatile 1
        "#]]
        .assert_eq(&bench.topics());
        bench.run(0.5);
        near(&state(&bench), &[1.0, 2.0], 0.01);
        bench.say("/model/robot/joint/elbow/cmd_vel").publish(std_msgs::Float64 { data: -1.0 });
        bench.run(1.0);
        near(&state(&bench), &[0.0, -1.0], 0.01);
        bench.reset();
        bench.run(0.5);
        near(&state(&bench), &[1.0, 2.0], 0.01);
    }
}

/// With a gain of 10 on 1 kg m², `exp(-10)` of a speed error is left after one second.
#[test]
fn a_speed_held_by_forces() {
    let plugin = "<plugin filename='gz-sim-joint-controller-system'
        name='gz::sim::systems::JointController'><joint_name>elbow</joint_name>
        <initial_velocity>1</initial_velocity><use_force_commands>true</use_force_commands>
        <p_gain>10</p_gain></plugin>";
    let mut bench = bench(plugin, PhysicsMode::Rigid);
    bench.run(0.1);
    near(&state(&bench)[1..], &[1.0 - libm::exp(-1.0f64)], 0.01);
    bench.run(0.9);
    near(&state(&bench)[1..], &[1.0], 0.001);
}

#[test]
fn a_position_held_by_forces() {
    let plugin = "<plugin filename='gz-sim-joint-position-controller-system'
        name='gz::sim::systems::JointPositionController'><joint_name>elbow</joint_name>
        <topic>elbow_to</topic><p_gain>100</p_gain><i_gain>0</i_gain><d_gain>20</d_gain></plugin>";
    let mut bench = bench(plugin, PhysicsMode::Rigid);
    bench.say("/elbow_to").publish(std_msgs::Float64 { data: 0.5 });
    // Critically damped at 10 rad/s: 1 - 11 exp(-10) after a second.
    bench.run(1.0);
    near(&state(&bench), &[0.5, 0.0], 0.003);
}

#[test]
fn a_position_reached_at_a_speed() {
    let plugin = "<plugin filename='gz-sim-joint-position-controller-system'
        name='gz::sim::systems::JointPositionController'><joint_name>elbow</joint_name>
        <use_velocity_commands>true</use_velocity_commands><cmd_max>0.5</cmd_max></plugin>";
    for mode in [PhysicsMode::Kinematic, PhysicsMode::Rigid] {
        let mut bench = bench(plugin, mode);
        let topic = "/model/robot/joint/elbow/_0/cmd_pos";
        let heard = bench.topics();
        assert!(heard.contains("/elbow/"), "{heard}");
        let topic = heard.split(' ').nth(2).unwrap_or(topic).to_owned();
        bench.say(&topic).publish(std_msgs::Float64 { data: 1.0 });
        bench.run(1.0);
        near(&state(&bench), &[0.5, 0.5], 0.01);
        bench.run(1.5);
        near(&state(&bench), &[1.0, 0.0], 0.001);
    }
}
