//! Actors in radars, and the truth about images and clouds.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use std::path::Path;
use std::sync::Arc;

use periplus_geometry::{DVec3, Pose};
use periplus_graph::{NodeSettings, Qos};
use periplus_loader::LoadContext;
use periplus_msgs::radar_msgs::{RadarScan, RadarTrack, RadarTracks};
use periplus_msgs::vision_msgs::Detection3DArray;
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{
    AssetFiles, LabellingError, ObjectLabel, Options, PixelBox, Simulation, compose,
};

/// A mast with a radar, a camera and a lidar 1 m above the floor, posts at rest around, and CONTENT.
const WORLD: &str = r#"<sdf version="1.9"><world name="w">
  <plugin filename="gz-sim-sensors-system" name="gz::sim::systems::Sensors"/>
  <light name="sun" type="directional"><diffuse>0.5 0.5 0.5 1</diffuse></light>
  <model name="mast"><static>true</static><pose>0 0 1 0 0 0</pose><link name="head">
    <sensor name="radar" type="radar"><topic>radar</topic><update_rate>20</update_rate><radar>
      <horizontal_fov>1.2</horizontal_fov><vertical_fov>0.1</vertical_fov>
      <range><min>0.2</min><max>40</max><resolution>0.2</resolution></range>
      <azimuth_resolution>0.02</azimuth_resolution>
      <velocity><max>20</max><resolution>0.1</resolution></velocity></radar></sensor>
    <sensor name="boxes" type="boundingbox_camera"><topic>boxes</topic><update_rate>10</update_rate>
      <camera><box_type>3d</box_type><horizontal_fov>1.5707963267948966</horizontal_fov>
        <image><width>100</width><height>100</height></image>
        <clip><near>0.1</near><far>40</far></clip></camera></sensor>
    <sensor name="eye" type="camera">
      <camera><horizontal_fov>1.5707963267948966</horizontal_fov>
        <image><width>100</width><height>100</height></image>
        <clip><near>0.1</near><far>40</far></clip></camera></sensor>
    <sensor name="lidar" type="lidar"><lidar>
      <scan><horizontal>
        <samples>3</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle>
      </horizontal></scan>
      <range><min>0.1</min><max>30</max></range>
    </lidar></sensor>
  </link></model>
  CONTENT
</world></sdf>"#;

const LABEL: &str = "<plugin filename='gz-sim-label-system' name='gz::sim::systems::Label'>
  <label>5</label></plugin>";

fn simulate(content: &str) -> Simulation {
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
    assert!(!composition.has_errors());
    Simulation::new(&mut composition, Arc::new(AssetFiles::default()), Options::default())
}

/// A model with a box of 1 m about this point.
fn cube(name: &str, x: f64, y: f64, more: &str) -> String {
    let shape = "<geometry><box><size>1 1 1</size></box></geometry>";
    format!(
        "<model name='{name}'><static>true</static><pose>{x} {y} 1 0 0 0</pose>{more}<link name='l'>
           <collision name='c'>{shape}</collision><visual name='v'>{shape}</visual></link></model>"
    )
}

/// An actor of one box that walks from 20 m to 8 m in 8 s.
fn walker() -> String {
    let shape = "<geometry><box><size>0.4 0.4 0.4</size></box></geometry>";
    format!(
        "<actor name='walker'>{LABEL}<link name='l'><pose>0 0 1 0 0 0</pose>
           <collision name='c'>{shape}</collision><visual name='v'>{shape}</visual></link>
           <script><trajectory id='0' type='walk'>
             <waypoint><time>0</time><pose>20 0 0 0 0 3.141592653589793</pose></waypoint>
             <waypoint><time>8</time><pose>8 0 0 0 0 3.141592653589793</pose></waypoint>
           </trajectory></script></actor>"
    )
}

/// The radial velocity of an actor is that of its motion, and its track is the only moving one.
#[test]
fn an_actor_has_a_radial_velocity() {
    let posts: String = (0..6)
        .map(|index| cube(&format!("post_{index}"), 15.0, f64::from(index) * 3.0 - 7.5, ""))
        .collect();
    let mut simulation = simulate(&(posts + &walker()));
    let node = simulation.graph().node(NodeSettings::new("user")).unwrap();
    let scans = node.mailbox::<RadarScan>("/radar/scan", Qos::best_effort(1000)).unwrap();
    let tracks = node.mailbox::<RadarTracks>("/radar/tracks", Qos::best_effort(1000)).unwrap();
    let position_m = |simulation: &Simulation| simulation.actors().next().unwrap().1.translation;
    while simulation.time_ns() < 4_000_000_000 {
        simulation.step().unwrap();
    }
    let before_m = position_m(&simulation);
    let _ = scans.drain();
    // The next scan is that of 4.05 s.
    let scan = loop {
        match scans.latest() {
            Some(scan) => break scan,
            None => simulation.step().unwrap(),
        }
    };
    let after_m = position_m(&simulation);
    let time_s = (simulation.time_ns() - 4_000_000_000) as f64 * 1e-9;
    let velocity = (after_m - before_m) / time_s;
    let towards = DVec3::new(after_m.x, after_m.y, 0.0).normalize();
    let radial_m_per_s = velocity.dot(towards);
    assert!(radial_m_per_s < -1.0, "{radial_m_per_s}");
    let moving: Vec<_> = scan.returns.iter().filter(|it| it.doppler_velocity != 0.0).collect();
    assert!(!moving.is_empty());
    for seen in moving {
        let face_m = DVec3::new(after_m.x - 0.2, after_m.y, 0.0).length();
        assert!((f64::from(seen.range) - face_m).abs() <= 0.1 + 0.05, "{seen:?} {face_m}");
        assert!(
            (f64::from(seen.doppler_velocity) - radial_m_per_s).abs() <= 0.05 + 0.02,
            "{seen:?}"
        );
    }
    let tracks = tracks.latest().unwrap();
    let moving: Vec<_> =
        tracks.tracks.iter().filter(|track| track.classification == RadarTrack::DYNAMIC).collect();
    let [track] = moving.as_slice() else { panic!("{tracks:?}") };
    // Within a cell of range, and of azimuth: 0.02 rad at 14 m.
    assert!((track.position.x - (after_m.x - 0.2)).abs() < 0.2, "{track:?} {after_m}");
    assert!((track.position.y - after_m.y).abs() < 0.28, "{track:?} {after_m}");
    assert!(tracks.tracks.iter().any(|track| track.classification == RadarTrack::STATIC));
}

/// The label of an actor is that of its shapes: at the start its centre is 20 m ahead.
#[test]
fn an_actor_has_a_box() {
    let mut simulation = simulate(&walker());
    let node = simulation.graph().node(NodeSettings::new("user")).unwrap();
    let boxes = node.mailbox::<Detection3DArray>("/boxes", Qos::best_effort(10)).unwrap();
    simulation.step().unwrap();
    let message = boxes.latest().unwrap();
    let [walker] = message.detections.as_slice() else { panic!("{message:?}") };
    assert_eq!(
        (walker.id.as_str(), walker.results[0].hypothesis.class_id.as_str()),
        ("walker", "5")
    );
    let (centre, size) = (&walker.bbox.center.position, &walker.bbox.size);
    assert!((centre.x - 20.0).abs() < 0.01 && centre.y.abs() < 1e-6, "{walker:?}");
    assert!(centre.z.abs() < 1e-6 && (size.x - 0.4).abs() < 1e-9, "{walker:?}");
}

/// The middle beam hits the labelled cube 5 m ahead, the left one the cube without a label, the right one nothing.
#[test]
fn points_have_the_label_of_their_surface() {
    let left = 5.0 * libm::tan(0.2);
    let world = cube("crate", 5.5, 0.0, LABEL) + &cube("plain", 6.5, left + 0.6, "");
    let mut simulation = simulate(&world);
    let mut lidar = simulation.labelling_lidar(None).unwrap();
    assert_eq!(lidar.name(), "mast::head::lidar");
    let frame = simulation.lidar_frame(&mut lidar).unwrap();
    assert_eq!(frame.world_from_lidar, Pose::from_xyz(0.0, 0.0, 1.0));
    let labels: Vec<_> = frame.points.iter().map(|point| point.label).collect();
    assert_eq!(labels, [Some(ObjectLabel { class: 5, instance: 1 }), None]);
    assert!((frame.points[0].position_m[0] - 5.0).abs() < 1e-5, "{frame:?}");
}

/// The face of a cube, 1 m at 5 m, has 10 of 100 columns; a second one behind it shows 3 of its 5.
#[test]
fn images_have_the_truth_about_their_objects() {
    let world = cube("near", 5.5, 0.0, LABEL) + &cube("far", 10.5, 1.1, LABEL);
    let mut simulation = simulate(&world);
    let objects = simulation.labelled_objects();
    assert_eq!(objects.iter().map(|it| it.model.as_str()).collect::<Vec<_>>(), ["near", "far"]);
    let mut camera = simulation.labelling_camera(Some("eye")).unwrap();
    let frame = simulation.camera_frame(&mut camera).unwrap();
    let boxes: Vec<_> = frame
        .objects
        .iter()
        .map(|it| (it.visible.bounds, it.full.bounds, it.visible.pixel_count))
        .collect();
    let pixels =
        |left_px, top_px, width_px, height_px| PixelBox { left_px, top_px, width_px, height_px };
    // The far one: y from 0.6 to 1.6 at 10 m are columns 42 to 47, of which the near one hides those from 45 on.
    let near = pixels(45, 45, 10, 10);
    assert_eq!(boxes[0], (near, near, 100));
    let (visible, full, count) = boxes[1];
    assert_eq!((visible.left_px, visible.width_px), (42, 3), "{boxes:?}");
    assert_eq!((full.left_px, full.width_px), (42, 5), "{boxes:?}");
    assert_eq!(count, 3 * visible.height_px, "{boxes:?}");
    assert_eq!(frame.images.rgb.len(), 3 * 100 * 100);
}

#[test]
fn unknown_sensors_are_errors_that_name_the_known_ones() {
    let simulation = simulate("");
    let error = simulation.labelling_camera(Some("nose")).unwrap_err();
    assert!(matches!(error, LabellingError::NoSensor { .. }));
    assert_eq!(error.to_string(), "no camera `nose`; there are mast::head::boxes, mast::head::eye");
}
