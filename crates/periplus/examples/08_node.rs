//! A node of your own: an emergency stop that passes velocity commands on, until a scan shows an
//! obstacle near the robot.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;

use periplus::graph::{Actor, Graph, GraphError, Node, NodeSettings, Qos};
use periplus::msgs::geometry_msgs::Twist;
use periplus::msgs::sensor_msgs::LaserScan;

/// Range that stops the robot \[m\].
const STOP_RANGE_M: f32 = 0.5;

/// State of the node.
struct EmergencyStop {
    is_blocked: bool,
}

/// Subscribes to `scan` and `cmd_vel_in`, and publishes `cmd_vel`.
fn emergency_stop(node: Node) -> Result<Actor<EmergencyStop>, GraphError> {
    let commands = node.publisher("cmd_vel", Qos::reliable(1))?;
    let mut actor = node.actor(EmergencyStop { is_blocked: false });
    actor.subscribe::<LaserScan>("scan", Qos::sensor_data(), |state, scan, _| {
        let is_valid = |range: &f32| *range >= scan.range_min;
        let nearest = scan.ranges.iter().copied().filter(is_valid).fold(f32::INFINITY, f32::min);
        state.is_blocked = nearest < STOP_RANGE_M;
    })?;
    actor.subscribe::<Twist>("cmd_vel_in", Qos::reliable(1), move |state, command, _| {
        let command = if state.is_blocked { Twist::default() } else { (*command).clone() };
        commands.publish(command);
    })?;
    Ok(actor)
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let graph = Graph::new();
    let _stop = emergency_stop(graph.node(NodeSettings::new("emergency_stop"))?)?;

    let user = graph.node(NodeSettings::new("user"))?;
    let scans = user.publisher("scan", Qos::sensor_data())?;
    let commands = user.publisher("cmd_vel_in", Qos::reliable(1))?;
    let wheels = user.mailbox::<Twist>("cmd_vel", Qos::reliable(1))?;
    let mut passed = Vec::new();
    for (tick, nearest_m) in [2.0, 1.0, 0.4, 0.3, 0.8].into_iter().enumerate() {
        scans.publish(LaserScan {
            range_min: 0.1,
            range_max: 10.0,
            ranges: vec![10.0, nearest_m, 10.0],
            ..LaserScan::default()
        });
        graph.settle();
        let mut forward = Twist::default();
        forward.linear.x = 0.5;
        commands.publish(forward);
        graph.advance_to(100_000_000 * (tick as i64 + 1));
        passed.push(wheels.latest().ok_or("no command was passed on")?.linear.x);
    }
    println!("velocities: {passed:?}");
    assert_eq!(passed, [0.5, 0.5, 0.0, 0.0, 0.5]);
    Ok(())
}
