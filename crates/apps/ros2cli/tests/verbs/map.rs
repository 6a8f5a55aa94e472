//! `map`.

use std::path::{Path, PathBuf};
use std::time::Duration;

use expect_test::expect;
use periplus_graph::{Node, Qos};
use periplus_maps::{Distro, Wish};
use periplus_msgs::nav_msgs::{MapMetaData, OccupancyGrid, Odometry};
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_ros2cli::map::{Convert, Diff, Save, convert, diff, info, save};

use crate::bench::Bench;

/// A folder that is removed when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let name = format!("periplus-verbs-map-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().unwrap().to_owned()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn map() -> OccupancyGrid {
    OccupancyGrid {
        info: MapMetaData { resolution: 0.05, width: 3, height: 2, ..MapMetaData::default() },
        data: vec![0, 0, 100, -1, 50, 100],
        ..OccupancyGrid::default()
    }
}

fn wanted(topic: &str, name: String) -> Save {
    Save {
        topic: topic.into(),
        wish: Wish { name, ..Wish::default() },
        distro: Distro::Jazzy,
        timeout: Some(Duration::from_millis(300)),
    }
}

/// Output without the folder.
fn run(bench: &Bench, folder: &Folder, what: &Save) -> String {
    bench.run(|session| save(session, what)).replace(folder.0.to_str().unwrap(), "FOLDER")
}

#[test]
fn a_map_is_saved_however_it_is_published() {
    for qos in [Qos::latched(1), Qos::sensor_data()] {
        let (bench, folder) = (Bench::new(), Folder::new("saved"));
        let node = bench.node("slam");
        let publisher = node.publisher("/map", qos).unwrap();
        publisher.publish(map());
        let feeder = std::thread::spawn(move || {
            // Best-effort messages without a subscriber are lost.
            for _ in 0..20 {
                std::thread::sleep(Duration::from_millis(10));
                publisher.publish(map());
            }
        });
        let what = wanted("map", folder.path("room"));
        expect![[r#"
            | Received a 3 X 2 map @ 0.05 m/pix
            | Map saved to FOLDER/room.pgm and FOLDER/room.yaml
        "#]]
        .assert_eq(&run(&bench, &folder, &what));
        let pgm = Machine.read(&folder.0.join("room.pgm")).unwrap();
        assert_eq!(pgm, b"P5\n3 2\n255\n\xcd\xcd\x00\xfe\xfe\x00");
        assert!(Path::new(&folder.path("room.yaml")).exists());
        feeder.join().unwrap();
    }
}

#[test]
fn without_a_map_it_says_why() {
    let (bench, folder) = (Bench::new(), Folder::new("why"));
    let what = wanted("map", folder.path("room"));
    expect![[r#"
        ! no map received on `/map` within 0.3 s: no map is published; is the map server or SLAM running?
    "#]]
    .assert_eq(&run(&bench, &folder, &what));
    let node: Node = bench.node("slam");
    let _odometry = node.publisher::<Odometry>("/odom", Qos::reliable(1)).unwrap();
    let _map = node.publisher::<OccupancyGrid>("/slam/map", Qos::latched(1)).unwrap();
    expect![[r#"
        ! no map received on `/map` within 0.3 s: the topic has no publisher; maps are published on /slam/map
    "#]]
    .assert_eq(&run(&bench, &folder, &what));
    let silent = Save { topic: "/slam/map".into(), ..what };
    let said = run(&bench, &folder, &silent);
    assert!(said.contains("published nothing new"), "{said}");
    let odd = Save { wish: Wish { free_thresh: 0.9, ..silent.wish.clone() }, ..silent };
    assert!(run(&bench, &folder, &odd).starts_with("! the thresholds are 0.9"));
}

#[test]
fn maps_are_told_converted_and_compared() {
    let (bench, folder) = (Bench::new(), Folder::new("told"));
    let publisher = bench.node("slam").publisher("/map", Qos::latched(1)).unwrap();
    publisher.publish(map());
    run(&bench, &folder, &wanted("map", folder.path("a")));
    let text = bench.run(|session| info(session, &folder.path("a.yaml"), Distro::Jazzy));
    expect![[r#"
        picture     FOLDER/a.pgm
        size        3 x 2 cells of 0.05 m: 0.15 x 0.10 m
        origin      x 0 m, y 0 m, yaw 0 rad
        corners     (0.00, 0.00) to (0.15, 0.10) m
        mode        trinary, free up to 0.196, occupied from 0.65 (jazzy rules)
        free        2 cells (33.3 %)
        occupied    2 cells (33.3 %)
        unknown     2 cells (33.3 %)
    "#]]
    .assert_eq(&text.replace(folder.0.to_str().unwrap(), "FOLDER"));
    let conversion = Convert {
        path: folder.path("a.yaml"),
        from: Distro::Jazzy,
        wish: Wish { name: folder.path("b"), mode: "scale".into(), ..Wish::default() },
        to: Distro::Jazzy,
    };
    let text = bench.run(|session| convert(session, &conversion));
    assert!(text.contains("b.png"), "{text}");
    let comparison = Diff {
        first: folder.path("a.yaml"),
        other: folder.path("b.yaml"),
        distro: Distro::Jazzy,
        options: Default::default(),
        picture: Some(folder.0.join("both.png")),
    };
    let json = Bench::new().json().run(|session| diff(session, &comparison));
    let found: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(found["walls"]["iou"], 1.0, "{json}");
    assert_eq!(found["first_to_other"]["largest_m"], 0.0);
    assert!(folder.0.join("both.png").exists());
    let text = bench.run(|session| info(session, &folder.path("c.yaml"), Distro::Jazzy));
    assert!(text.contains("did you mean") && text.contains("INVALID_MAP_METADATA"), "{text}");
}
