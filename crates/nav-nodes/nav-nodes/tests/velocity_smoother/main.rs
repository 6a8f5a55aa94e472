//! The velocity smoother as controllers and robots see it.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

use periplus_diagnostics::Diagnostics;
use periplus_graph::{
    Graph, LifecycleNode, Mailbox, Node, NodeSettings, Publisher, Qos, Transition,
};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::rcl_interfaces::{
    Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_nav_nodes::velocity_smoother::{VELOCITY_SMOOTHER, VelocitySmootherNode};
use periplus_params::Given;

struct Stage {
    graph: Graph,
    user: Node,
    smoother: LifecycleNode<VelocitySmootherNode>,
    commands: Publisher<TwistStamped>,
    outputs: Mailbox<TwistStamped>,
}

impl Stage {
    fn new(given: &[(&str, &str)]) -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let mut diagnostics = Diagnostics::new();
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let values = VELOCITY_SMOOTHER.check(given, None, &mut diagnostics);
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        let smoother = VelocitySmootherNode::new(&graph, values).unwrap();
        let commands = user.publisher("cmd_vel", Qos::reliable(1)).unwrap();
        let outputs = user.mailbox("cmd_vel_smoothed", Qos::reliable(100)).unwrap();
        smoother.start();
        graph.settle();
        Self { graph, user, smoother, commands, outputs }
    }

    fn command(&self, vx: f64, wz: f64) {
        let mut command = TwistStamped::default();
        command.header.frame_id = "base_link".to_owned();
        (command.twist.linear.x, command.twist.angular.z) = (vx, wz);
        self.commands.publish(command);
        self.graph.settle();
    }

    /// Speeds that are published within a time.
    fn run(&self, seconds: f64) -> Vec<f64> {
        self.graph.advance_to(self.graph.now_ns() + (seconds * 1e9) as i64);
        self.outputs.drain().iter().map(|output| output.twist.linear.x).collect()
    }
}

#[test]
fn commands_are_smoothed_at_the_rate_of_the_node() {
    let stage = Stage::new(&[]);
    assert_eq!(stage.run(1.0), [0.0; 0], "there was no command");
    stage.command(1.0, 0.0);
    assert_eq!(stage.run(0.3), [0.125, 0.25, 0.375, 0.5, 0.5, 0.5]);
    stage.command(0.0, 0.0);
    stage.graph.advance_to(stage.graph.now_ns() + 50_000_000);
    let output = stage.outputs.latest().unwrap();
    assert_eq!(output.twist.linear.x, 0.375);
    assert_eq!(output.header.stamp, Time::of_ns(stage.graph.now_ns()));
    assert_eq!(output.header.frame_id, "base_link");
}

#[test]
fn a_silent_controller_stops_the_robot_and_then_the_output() {
    let stage = Stage::new(&[("velocity_timeout", "0.5")]);
    stage.command(0.25, 0.0);
    let speeds = stage.run(2.0);
    // Ten outputs up to 0.5 s, then two to slow down.
    assert_eq!(speeds.len(), 12, "{speeds:?}");
    assert_eq!(speeds[9..], [0.25, 0.125, 0.0]);
}

#[test]
fn a_stamped_command_ages_from_its_stamp() {
    let stage = Stage::new(&[("velocity_timeout", "0.5")]);
    stage.graph.advance_to(10_000_000_000);
    let mut command = TwistStamped::default();
    command.header.stamp = Time::of_ns(9_600_000_000);
    command.twist.linear.x = 0.25;
    stage.commands.publish(command);
    // It is 0.4 s old when it arrives.
    assert_eq!(stage.run(1.0), [0.125, 0.25, 0.125, 0.0]);
}

#[test]
fn closed_loop_follows_odometry() {
    let stage = Stage::new(&[("feedback", "CLOSED_LOOP")]);
    let odometry = stage.user.publisher::<Odometry>("odom", Qos::reliable(1)).unwrap();
    let mut measured = Odometry::default();
    measured.twist.twist.linear.x = 0.2;
    odometry.publish(measured);
    stage.command(0.5, 0.0);
    let speeds = stage.run(0.1);
    assert!(speeds.iter().all(|speed| (speed - 0.325).abs() < 1e-12), "{speeds:?}");
}

#[test]
fn releases_before_kilted_have_plain_twists() {
    let graph = Graph::new();
    let user = graph.node(NodeSettings::new("user")).unwrap();
    let commands = user.publisher::<Twist>("cmd_vel", Qos::reliable(1)).unwrap();
    let outputs = user.mailbox::<Twist>("cmd_vel_smoothed", Qos::reliable(100)).unwrap();
    let given = [Given::new("compat", "humble"), Given::new("enable_stamped_cmd_vel", "true")];
    let values = VELOCITY_SMOOTHER.check(given, None, &mut Diagnostics::new());
    let smoother = VelocitySmootherNode::new(&graph, values).unwrap();
    smoother.start();
    graph.settle();
    let mut command = Twist::default();
    command.angular.z = -1.0;
    commands.publish(command);
    graph.advance_to(100_000_000);
    let turns: Vec<f64> = outputs.drain().iter().map(|output| output.angular.z).collect();
    assert_eq!(turns, [-0.16, -0.32]);
}

#[test]
fn wrong_limits_fail_to_configure_and_wrong_changes_are_refused() {
    let graph = Graph::new();
    let given = [Given::new("max_accel", "[-1.0, 0.0, 1.0]")];
    let values = VELOCITY_SMOOTHER.check(given, None, &mut Diagnostics::new());
    let smoother = VelocitySmootherNode::new(&graph, values).unwrap();
    smoother.start();
    graph.settle();
    assert!(!smoother.lifecycle().is_active());

    let stage = Stage::new(&[]);
    let set = |name: &str, numbers: &[f64]| {
        let client =
            stage.user.client::<SetParameters>("velocity_smoother/set_parameters").unwrap();
        let value = ParameterValue {
            r#type: ParameterType::PARAMETER_DOUBLE_ARRAY,
            double_array_value: numbers.to_vec(),
            ..ParameterValue::default()
        };
        let parameters = vec![Parameter { name: name.to_owned(), value }];
        let pending = client.call(SetParametersRequest { parameters });
        stage.graph.settle();
        pending.take().unwrap().unwrap().results[0].clone()
    };
    assert!(!set("max_accel", &[1.0, 1.0]).successful);
    assert!(!set("max_decel", &[1.0, 0.0, 0.0]).successful);
    assert!(set("max_accel", &[5.0, 0.0, 3.2]).successful);
    stage.command(1.0, 0.0);
    assert_eq!(stage.run(0.1), [0.25, 0.5]);
    assert!(stage.smoother.lifecycle().is_active());
}

#[test]
fn a_smoother_that_is_stopped_stops_the_robot() {
    for transition in [Transition::Deactivate, Transition::Shutdown] {
        let stage = Stage::new(&[]);
        stage.command(0.5, 0.0);
        assert_eq!(stage.run(0.2), [0.125, 0.25, 0.375, 0.5]);
        stage.smoother.lifecycle().change(transition);
        assert_eq!(stage.run(0.5), [0.0], "{transition:?}");
    }
    // It starts from rest the next time, and a robot that stands is left alone.
    let stage = Stage::new(&[]);
    stage.command(0.5, 0.0);
    stage.run(0.2);
    for transition in [Transition::Deactivate, Transition::Activate] {
        stage.smoother.lifecycle().change(transition);
        stage.graph.settle();
    }
    assert_eq!(stage.run(0.2), [0.0], "of the deactivation");
    stage.command(0.5, 0.0);
    assert_eq!(stage.run(0.1), [0.125, 0.25]);
    stage.command(0.0, 0.0);
    stage.run(0.5);
    stage.smoother.lifecycle().change(Transition::Deactivate);
    assert_eq!(stage.run(0.5), [0.0; 0]);
}
