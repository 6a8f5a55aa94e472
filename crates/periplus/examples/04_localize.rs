//! Localizes a robot in a map without an initial pose: AMCL gets the map of a room and the
//! recording of a drive.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use periplus::bags::files::{Bag, PlaySettings, Player};
use periplus::diagnostics::Diagnostics;
use periplus::graph::{Graph, NodeSettings, Qos};
use periplus::localization::AMCL;
use periplus::maps::Distro;
use periplus::msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus::nav_nodes::amcl::AmclNode;
use periplus::nav_nodes::map_server::{MapServer, MapServerParams};
use periplus::os::Machine;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/data");
    let graph = Graph::new();
    let yaml_filename = data.join("room.yaml").display().to_string();
    let params = MapServerParams { yaml_filename, ..MapServerParams::default() };
    let node = graph.node(NodeSettings::new("map_server"))?;
    let map_server = MapServer::new(node, params, Distro::Jazzy, Arc::new(Machine))?;
    map_server.start();
    let parameters = AMCL.check([], None, &mut Diagnostics::new());
    let amcl = AmclNode::new(&graph, parameters, Arc::new(Machine))?;
    amcl.start();
    let user = graph.node(NodeSettings::new("user"))?;
    let poses = user.mailbox::<PoseWithCovarianceStamped>("amcl_pose", Qos::latched(1))?;

    let bag = Bag::open(data.join("room.mcap"))?;
    let mut player = Player::new(bag, &graph, PlaySettings::default())?;
    let mut now_ns = 0;
    while let Some(next_ns) = player.advance_to(now_ns)? {
        graph.advance_to(next_ns);
        now_ns = next_ns;
    }
    graph.settle();

    let pose = poses.latest().ok_or("AMCL published no pose")?;
    let position = &pose.pose.pose.position;
    let (x_m, y_m) = (position.x, position.y);
    println!("the robot is at {x_m:.3}, {y_m:.3}");
    // AMCL publishes after a quarter of a metre, last on the straight line from -0.8, 0.3 to the origin.
    let off_m = (0.3 * x_m + 0.8 * y_m).abs() / libm::hypot(0.8_f64, 0.3);
    assert!(off_m < 0.05 && (-0.6..0.1).contains(&x_m), "{x_m}, {y_m}");
    Ok(())
}
