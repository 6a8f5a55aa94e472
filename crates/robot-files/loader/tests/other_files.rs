//! Files that are neither robot nor world: each is identified by its format, without an XML error.

mod common;

use std::path::Path;

use periplus_loader::{FileFormat, LoadedFile};
use periplus_resources::MemoryHost;

fn read(name: &str, bytes: &[u8]) -> LoadedFile {
    let host = MemoryHost::new()
        .with_file(Path::new("/r").join(name), bytes)
        .with_file("/r/room.pgm", b"P5 2 2 255\n\x00\xfe\xfe\xcd");
    common::read(&host, Path::new("/r"), Path::new(name), &[])
}

fn check(name: &str, text: &str, language: FileFormat, codes: &[&str], contents: &[&str]) {
    let loaded = read(name, text.as_bytes());
    assert_eq!(loaded.language, language, "{name}");
    let found: Vec<_> = loaded.diagnostics.iter().map(|one| one.code).collect();
    assert_eq!(found, codes, "{name}: {}", common::shown(&loaded));
    assert_eq!(loaded.contents, contents, "{name}");
    assert!(loaded.language.advice().is_some(), "{name}");
}

const MAP: &str = "image: room.pgm\nresolution: 0.05\norigin: [-1, 2, 0]\nnegate: 0\n\
                   occupied_thresh: 0.65\nfree_thresh: 0.196\n";

#[test]
fn yaml_files_are_told_apart_by_what_they_hold() {
    check(
        "room.yaml",
        MAP,
        FileFormat::Map,
        &[],
        &[
            "2 x 2 cells of 0.05 m: 0.10 x 0.10 m",
            "1 occupied, 1 unknown, the rest free; origin -1 2 0",
        ],
    );
    check("bad.yaml", &MAP.replace("0.05", "-1"), FileFormat::Map, &["bad-map"], &[]);
    check(
        "nav2_params.yaml",
        "amcl:\n  ros__parameters:\n    a: 1\n    b: 2\nns:\n  costmap:\n    ros__parameters: {c: 1}\n",
        FileFormat::Parameters,
        &[],
        &["/amcl: 2 parameters", "/ns/costmap: 1 parameters"],
    );
    check(
        "params.yaml",
        "amcl:\n  ros__parameters:\n    a: 1\nmap_server:\n  yaml_filename: m.yaml\n",
        FileFormat::Parameters,
        &["no-ros-parameters"],
        &["/amcl: 1 parameters"],
    );
    check(
        "bridge.yaml",
        "- ros_topic_name: scan\n  gz_topic_name: lidar\n- topic_name: clock\n",
        FileFormat::Bridge,
        &[],
        &["2 topics"],
    );
    check("a.launch.yaml", "launch:\n- node: {pkg: a}\n", FileFormat::LaunchYaml, &[], &[]);
    check("b.yaml", "1: 2\n", FileFormat::Yaml, &[], &[]);
    check("c.yaml", "a: [\n", FileFormat::Yaml, &["bad-yaml"], &[]);
    check("d.yaml", "", FileFormat::Yaml, &["empty-file"], &[]);
}

#[test]
fn a_map_opens_pictures_only() {
    let secret = MAP.replace("room.pgm", "/etc/passwd");
    let loaded = read("room.yaml", secret.as_bytes());
    let found = loaded.diagnostics.iter().next().expect("a finding");
    assert_eq!(
        found.message,
        "the image `/etc/passwd` of the map is not opened: it is not an image file"
    );
}

#[test]
fn configurations_pictures_programs_and_packed_files() {
    check(
        "view.rviz",
        "Visualization Manager:\n  Global Options: {Fixed Frame: map}\n  Displays:\n    \
         - {Class: rviz_default_plugins/LaserScan, Name: Scan}\n",
        FileFormat::Rviz,
        &[],
        &["fixed frame map", "display Scan (rviz_default_plugins/LaserScan)"],
    );
    check("view.rviz", "Panels: []\n", FileFormat::Rviz, &["bad-rviz"], &[]);
    check("plan.pgm", "P5 2 1 255\nab", FileFormat::Picture, &[], &["2 x 1 pixels, 1 channels"]);
    check("room.png", "<html/>", FileFormat::Picture, &["picture"], &[]);
    check("a.launch.py", "", FileFormat::LaunchPython, &[], &[]);
    check("a.py", "def generate_launch_description(): pass\n", FileFormat::LaunchPython, &[], &[]);
    check("b.py", "print(1)\n", FileFormat::Python, &[], &[]);
    check("a.zip", "PK\u{3}\u{4}", FileFormat::Archive, &["archive"], &[]);
    check("a.mcap", "", FileFormat::Recording, &[], &[]);
    check(
        "package.xml",
        "<package format='3'><name>my_robot</name></package>",
        FileFormat::Package,
        &[],
        &["package my_robot"],
    );
}

#[test]
fn folders_are_told_apart() {
    let host = MemoryHost::new()
        .with_file("/r/bag/metadata.yaml", "a: 1")
        .with_file("/r/pkg/package.xml", "<package/>")
        .with_file("/r/empty/x", "");
    for (name, language) in
        [("bag", FileFormat::Recording), ("pkg", FileFormat::Folder), ("empty", FileFormat::Folder)]
    {
        let loaded = common::read(&host, Path::new("/r"), Path::new(name), &[]);
        assert_eq!(loaded.language, language, "{name}");
        assert_eq!(loaded.diagnostics.iter().next().map(|one| one.code), Some("folder"));
    }
}
