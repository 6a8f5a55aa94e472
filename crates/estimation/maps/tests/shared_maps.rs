//! Published maps load, or fail as they should.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test states its preconditions, and reports skipped cases"
)]

use std::path::Path;

use periplus_maps::{Distro, Loaded, Saving, Status, load, render};
use periplus_os::Machine;
use periplus_resources::Host as _;

fn folder() -> Option<&'static Path> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../../shared/maps"));
    if folder.is_dir() {
        return Some(folder);
    }
    println!("SKIPPED: there are no maps in {}", folder.display());
    None
}

fn read(name: &str, distro: Distro) -> Option<Loaded> {
    Some(load(folder()?.join(name).to_str()?, distro, &Machine))
}

const ALL: [Distro; 3] = [Distro::Noetic, Distro::Humble, Distro::Jazzy];

#[test]
fn maps_load_by_every_rule() {
    for (name, width, height) in [
        ("nav2_map_server/testmap.yaml", 10, 10),
        ("nav2_costmap_2d/TenByTen.yaml", 10, 10),
        ("nav2_costmap_filters_demo/keepout_mask.yaml", 38, 42),
        ("nav2_costmap_filters_demo/speed_mask.yaml", 384, 384),
        ("ros1_map_server/testmap.yaml", 10, 10),
        ("ros1_map_server/testmap2.yaml", 12, 12),
    ] {
        for distro in ALL {
            let Some(loaded) = read(name, distro) else { return };
            let map = loaded.map.unwrap_or_else(|| panic!("{name}: {:?}", loaded.diagnostics));
            let info = map.grid.info;
            assert_eq!((info.width, info.height), (width, height), "{name}");
        }
    }
}

#[test]
fn a_picture_that_is_not_there_is_told_by_name() {
    for distro in ALL {
        let Some(loaded) = read("nav2_map_server/invalid_image.yaml", distro) else { return };
        assert_eq!(loaded.status, Status::InvalidMapData);
        let finding = loaded.diagnostics.iter().next().unwrap();
        assert!(finding.message.contains("invalid.png") && finding.span.is_some(), "{finding:?}");
    }
}

#[test]
fn png_bmp_and_pgm_hold_the_same_map() {
    let Some(folder) = folder() else { return };
    let cells = |name: &str| {
        let path = folder.join("nav2_map_server").join(name);
        let path = path.to_str().unwrap();
        periplus_maps::load_image(path, 0.1, Distro::Jazzy, &Machine).map.unwrap().grid.cells
    };
    let pgm = cells("testmap.pgm");
    assert_eq!(pgm, cells("testmap.png"));
    assert_eq!(pgm, cells("testmap.bmp"));
}

#[test]
fn negated_maps_turn_round() {
    let Some(loaded) = read("ros1_map_server/testmap2.yaml", Distro::Noetic) else { return };
    let map = loaded.map.unwrap();
    assert!(map.description.negate);
    let first = map.grid.cells.iter().filter(|&&cell| cell == 100).count();
    assert!(first > 0 && first < map.grid.cells.len());
}

/// A map of a real robot, saved by `map_saver` of ROS 1.
#[test]
fn a_map_of_ros_1_is_written_again_byte_for_byte() {
    let folder = Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../../shared/corpus/turtlebot3/turtlebot3_navigation2/map"
    ));
    let read = |name: &str| Machine.read(&folder.join(name)).ok();
    let (Some(yaml), Some(pgm)) = (read("map.yaml"), read("map.pgm")) else {
        println!("SKIPPED: there is no map in {}", folder.display());
        return;
    };
    let path = folder.join("map.yaml");
    let map = load(path.to_str().unwrap(), Distro::Noetic, &Machine).map.unwrap();
    let files = render(&map.grid, &Saving::new("map", Distro::Noetic));
    assert!(files.image == pgm, "the picture is another");
    assert_eq!(files.yaml.as_bytes(), yaml);
}
