//! `docs/move-base-parameters.md` is made from the tables:
//! `UPDATE_EXPECT=1 cargo test -p periplus-nav-nodes --test move_base`.

use std::fmt::Write as _;
use std::path::Path;

use periplus_controllers::ros1::{DWA_PLANNER, TEB_PLANNER, TRAJECTORY_PLANNER};
use periplus_nav_nodes::move_base::{
    CLEAR_COSTMAP_RECOVERY, GLOBAL_PLANNER, MOVE_BASE, MOVE_SLOW_AND_CLEAR, NAVFN_ROS,
    ROTATE_RECOVERY,
};

const HEAD: &str = "# move_base parameters

Private parameters of the node `move_base` of ROS 1, with its names and defaults; see [Drive to
goals](navigate.md#move_base-of-ros-1). Those of planners and recoveries are in groups of their names, such as
`DWAPlannerROS/max_vel_x`; those of the costmaps are in `global_costmap` and `local_costmap`. This page is generated from tables:
`UPDATE_EXPECT=1 cargo test -p periplus-nav-nodes --test move_base` rewrites it.
";

#[test]
fn the_reference_is_up_to_date() {
    let mut page = HEAD.to_owned();
    let groups = [
        ("Node", &[&MOVE_BASE][..]),
        ("Global planners", &[&NAVFN_ROS, &GLOBAL_PLANNER]),
        ("Local planners", &[&TRAJECTORY_PLANNER, &DWA_PLANNER, &TEB_PLANNER]),
        ("Recoveries", &[&CLEAR_COSTMAP_RECOVERY, &ROTATE_RECOVERY, &MOVE_SLOW_AND_CLEAR]),
    ];
    for (title, tables) in groups {
        let _ = write!(page, "\n## {title}\n");
        for table in tables {
            let _ = write!(page, "\n{}", table.to_markdown());
        }
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/move-base-parameters.md");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&file, &page).unwrap();
    }
    let written = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(written == page, "{} is out of date; run the command in it", file.display());
}
