//! Actors are seen by lidars and cameras where their scripts have them, and touch nothing.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use std::path::Path;
use std::sync::Arc;

use periplus_geometry::{DVec3, Pose};
use periplus_graph::{Mailbox, NodeSettings, Qos};
use periplus_loader::LoadContext;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_rendering::SensedGeometry;
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{AssetFiles, Options, PhotoRequest, Simulation, compose};

/// World with a lidar 0.3 m above the floor on the line of left legs, y = 0.1 m.
const WORLD: &str = r#"<sdf version="1.9"><world name="w">
  <plugin filename="gz-sim-sensors-system" name="gz::sim::systems::Sensors"/>
  <light name="sun" type="directional"><diffuse>0.5 0.5 0.5 1</diffuse></light>
  <model name="eye"><static>true</static><pose>0 0.1 0.3 0 0 0</pose><link name="head">
    <sensor name="lidar" type="gpu_lidar"><topic>scan</topic><update_rate>10</update_rate><lidar>
      <scan><horizontal>
        <samples>3</samples><min_angle>-0.1</min_angle><max_angle>0.1</max_angle>
      </horizontal></scan>
      <range><min>0.1</min><max>20</max></range>
    </lidar></sensor>
  </link></model>
  CONTENT
</world></sdf>"#;

const SKIN: &str = "<skin><filename>walk.dae</filename></skin>";

fn simulate(content: &str) -> (Simulation, Vec<&'static str>) {
    let host = MemoryHost::new().with_file("/w.sdf", WORLD.replace("CONTENT", content));
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: "/".into(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    let mut composition = compose(Path::new("/w.sdf"), &[], &setting);
    let files = Arc::new(AssetFiles::default());
    let simulation = Simulation::new(&mut composition, files, Options::default());
    let findings = composition.files.iter().flat_map(|file| file.diagnostics.iter());
    let codes = findings.map(|finding| finding.code).collect();
    (simulation, codes)
}

fn scans(simulation: &Simulation) -> Mailbox<LaserScan> {
    let node = simulation.graph().node(NodeSettings::new("user")).unwrap();
    node.mailbox("/scan", Qos::best_effort(1000)).unwrap()
}

fn run_to(simulation: &mut Simulation, time_ns: i64) {
    while simulation.time_ns() < time_ns {
        simulation.step().unwrap();
    }
}

/// Middle range of the scan at a time \[m\].
fn range_at(scans: &Mailbox<LaserScan>, time_s: f64) -> f64 {
    let all = scans.drain();
    let stamp_s = |scan: &LaserScan| {
        f64::from(scan.header.stamp.sec) + f64::from(scan.header.stamp.nanosec) * 1e-9
    };
    let scan = all.iter().find(|scan| (stamp_s(scan) - time_s).abs() < 1e-6);
    f64::from(scan.expect("a scan at the time").ranges[1])
}

#[test]
fn the_leg_of_one_who_stands_is_seen_by_lidar_and_camera() {
    let (mut simulation, codes) =
        simulate(&format!("<actor name='guard'><pose>3 0 0 0 0 0</pose>{SKIN}</actor>"));
    assert!(codes.contains(&"actor-figure"), "{codes:?}");
    let scans = scans(&simulation);
    run_to(&mut simulation, 500_000_000);
    // The axis of the left leg is at (3, 0.1), its radius 0.07 m.
    let range_m = range_at(&scans, 0.3);
    assert!((range_m - 2.93).abs() < 1e-5, "{range_m}");
    // The same leg in a picture: a pixel is about 0.001 rad, half of the leg asin(0.07 / 3) = 0.0233 rad.
    let request = PhotoRequest {
        world_from_camera: Pose::from_xyz(0.0, 0.1, 0.3),
        horizontal_fov_rad: 0.2,
        width_px: 201,
        height_px: 3,
        geometry: SensedGeometry::Visual,
    };
    let photo = simulation.photo(&request).unwrap();
    let pixel = |column: usize| &photo.rgb[3 * (201 + column)..3 * (201 + column) + 3];
    let sky = pixel(0).to_vec();
    for (offset, is_leg) in [(0, true), (20, true), (-20, true), (27, false), (-27, false)] {
        let column = usize::try_from(100 + offset).unwrap();
        assert_eq!(pixel(column) != sky.as_slice(), is_leg, "column {column}");
    }
}

#[test]
fn the_leg_of_one_who_walks_is_where_its_swing_has_it() {
    let (mut simulation, _) = simulate(&format!(
        "<actor name='walker'>{SKIN}<script><loop>false</loop><trajectory id='0' type='walk' tension='1'>
           <waypoint><time>0</time><pose>3 0 0 0 0 0</pose></waypoint>
           <waypoint><time>4</time><pose>7 0 0 0 0 0</pose></waypoint>
         </trajectory></script></actor>"
    ));
    let scans = scans(&simulation);
    run_to(&mut simulation, 2_200_000_000);
    // After 2 s it is in the middle, at x = 5, and has walked 2 m: a third of the second stride of 1.5 m. The left leg has
    // swung ahead by 0.4569 rad sin(120 degrees) about the hip, 0.55 m above the beam; its cut is an ellipse.
    let swing_rad = 0.4569 * libm::sqrt(0.75);
    let expected_m = 5.0 + 0.55 * libm::tan(swing_rad) - 0.07 / libm::cos(swing_rad);
    let range_m = range_at(&scans, 2.0);
    assert!((range_m - expected_m).abs() < 1e-3, "{range_m} {expected_m}");
    run_to(&mut simulation, 4_300_000_000);
    // At the end it is at rest: the legs hang down.
    let range_m = range_at(&scans, 4.2);
    assert!((range_m - 6.93).abs() < 1e-5, "{range_m}");
    // A reset brings it back.
    simulation.reset();
    assert_eq!(simulation.actors().next().unwrap().1.translation, DVec3::new(3.0, 0.0, 0.0));
}

#[test]
fn actors_touch_nothing() {
    let (mut simulation, _) = simulate(&format!(
        "<actor name='guard'><pose>3 0 0 0 0 0</pose>{SKIN}</actor>
         <model name='floor'><static>true</static><link name='l'><collision name='c'><geometry><plane/>
         </geometry></collision></link></model>
         <model name='ball'><pose>3 0 2 0 0 0</pose><link name='l'><collision name='c'><geometry><sphere>
         <radius>0.2</radius></sphere></geometry></collision></link></model>"
    ));
    run_to(&mut simulation, 2_000_000_000);
    let (ball, _) = simulation.motion().models().find(|(_, name)| *name == "ball").unwrap();
    let height_m = simulation.motion().model_pose(ball).unwrap().translation.z;
    assert!((height_m - 0.2).abs() < 0.01, "{height_m}");
}

#[test]
fn what_a_script_lacks_is_reported() {
    let check = |content: &str, code: &str| {
        let (_, codes) = simulate(&format!("<actor name='a'>{SKIN}{content}</actor>"));
        assert!(codes.contains(&code), "{content}: {codes:?}");
    };
    check(
        "<script><trajectory><waypoint><time>0</time></waypoint></trajectory></script>",
        "actor-script",
    );
    check(
        "<script><trajectory><waypoint><time>x</time><pose>0 0 0 0 0 0</pose></waypoint></trajectory></script>",
        "actor-script",
    );
    check("<script><auto_start>false</auto_start></script>", "actor-not-started");
    check("<plugin name='p' filename='libp.so'/>", "actor-plugin-ignored");
}
