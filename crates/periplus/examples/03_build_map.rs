//! Builds a map from a bag: the scans and transforms of a drive through a room are played to
//! `slam_toolbox`.
#![allow(clippy::print_stdout, reason = "an example")]

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use periplus::bags::files::{Bag, PlaySettings, Player};
use periplus::diagnostics::Diagnostics;
use periplus::graph::Graph;
use periplus::nav_nodes::slam_toolbox::{Pace, Program, SlamNode};
use periplus::os::Machine;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let graph = Graph::new();
    let program = Program::Async;
    let parameters = program.table().check([], None, &mut Diagnostics::new());
    let slam = SlamNode::new(&graph, program, parameters, Arc::new(Machine), Pace::Whole)?;
    slam.start();

    let bag = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/data/room.mcap");
    let mut player = Player::new(Bag::open(bag)?, &graph, PlaySettings::default())?;
    let mut now_ns = 0;
    while let Some(next_ns) = player.advance_to(now_ns)? {
        graph.advance_to(next_ns);
        now_ns = next_ns;
    }
    graph.settle();

    let (status, map) = slam.with(|slam| (slam.status(), slam.map()));
    let map = map.ok_or("no scan was used")?;
    // Percent; unknown cells are negative.
    let occupied = map.cells.iter().filter(|&&cell| cell > 50).count();
    let (x_m, y_m) = (status.map_from_base.x_m, status.map_from_base.y_m);
    println!("map of {} by {} cells, {occupied} occupied", map.info.width, map.info.height);
    println!("the robot is at {x_m:.3}, {y_m:.3}");
    // The drive ends where it began, within the tolerance of its last goal; odometry alone is 0.2 m off.
    assert!(libm::hypot(x_m, y_m) < 0.1, "{x_m}, {y_m}");
    assert!((300..1500).contains(&occupied), "{occupied} occupied cells");
    Ok(())
}
