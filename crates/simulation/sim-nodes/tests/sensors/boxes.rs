//! Bounding box cameras: boxes with answers by hand.

use periplus_msgs::sensor_msgs::{CameraInfo, Image};
use periplus_msgs::vision_msgs::{BoundingBox2D, Detection2DArray, Detection3DArray};

use crate::bench::Bench;

/// A box of 1 m with a label, or none, its face towards the camera at this distance.
fn labelled(name: &str, distance_m: f64, y: f64, label: Option<u8>) -> String {
    let plugin = label.map_or(String::new(), |label| {
        format!(
            "<plugin filename='gz-sim-label-system' name='gz::sim::systems::Label'>
               <label>{label}</label></plugin>"
        )
    });
    format!(
        "<model name='{name}'><static>true</static><pose>{} {y} 1.2 0 0 0</pose>{plugin}<link name='l'>
           <visual name='v'><geometry><box><size>1 1 1</size></box></geometry></visual>
         </link></model>",
        -distance_m - 0.5
    )
}

/// A camera at (0, 0, 1.2) that looks back, 100 pixels wide and high with 90°: f = 50 px.
fn camera(box_type: &str) -> String {
    format!(
        "<sensor name='eye' type='boundingbox_camera'><update_rate>10</update_rate>
           <topic>boxes</topic><gz_frame_id>eye</gz_frame_id><pose>0 0 1 0 0 3.141592653589793</pose>
           <camera><box_type>{box_type}</box_type><horizontal_fov>1.5707963267948966</horizontal_fov>
             <image><width>100</width><height>100</height></image>
             <clip><near>0.1</near><far>20</far></clip></camera></sensor>"
    )
}

/// Class, model, and left, top, width and height \[px\] of all boxes.
fn boxes(in_world: &str, box_type: &str) -> Vec<(String, String, [f64; 4])> {
    let mut bench = Bench::still(in_world, &camera(box_type));
    assert_eq!(bench.said, "");
    let heard = bench.hear::<Detection2DArray>("/boxes");
    bench.run(0.01);
    let message = heard.latest().unwrap();
    assert_eq!(message.header.frame_id, "eye");
    let edges = |it: &BoundingBox2D| {
        let (x, y) = (it.center.position.x, it.center.position.y);
        [x - it.size_x / 2.0, y - it.size_y / 2.0, it.size_x, it.size_y]
    };
    let found = message
        .detections
        .iter()
        .map(|it| (it.results[0].hypothesis.class_id.clone(), it.id.clone(), edges(&it.bbox)));
    found.collect()
}

fn found(class: &str, model: &str, edges: [f64; 4]) -> (String, String, [f64; 4]) {
    (class.into(), model.into(), edges)
}

/// A face of 1 m at 5 m has 50 / 5 = 10 pixels about the middle. That at y = 2.1 m is 21 pixels to the right, since the
/// camera looks back: from 66 to 76.
#[test]
fn boxes_around_visible_pixels() {
    let world = labelled("far", 5.0, 0.0, Some(7)) + &labelled("side", 5.0, 2.1, Some(3));
    // The inner side of the second box is seen, too: its edge at 6 m and y = 1.6 m is 13.3 px to the right.
    assert_eq!(
        boxes(&world, "2d"),
        [found("3", "side", [63.0, 45.0, 13.0, 10.0]), found("7", "far", [45.0, 45.0, 10.0, 10.0])]
    );
}

/// A box at 2.5 m from y = 0 on hides the right half of the box behind it: 5 of 10 columns remain. Its full box has all,
/// also with the part that is hidden.
#[test]
fn occluded_boxes_shrink() {
    let world = labelled("near", 2.5, 0.5, None) + &labelled("far", 5.0, 0.0, Some(7));
    assert_eq!(boxes(&world, "visible_2d"), [found("7", "far", [45.0, 45.0, 5.0, 10.0])]);
    assert_eq!(boxes(&world, "full_2d"), [found("7", "far", [45.0, 45.0, 10.0, 10.0])]);
}

/// A box in front hides all of the one behind it; one outside of the image is not seen either.
#[test]
fn hidden_models_have_no_box() {
    let hidden = labelled("near", 2.5, 0.0, Some(1)) + &labelled("far", 5.0, 0.0, Some(7));
    let aside = labelled("aside", 2.0, 9.0, Some(2));
    for box_type in ["2d", "full_2d"] {
        let seen = boxes(&(hidden.clone() + &aside), box_type);
        assert_eq!(seen, [found("1", "near", [40.0, 40.0, 20.0, 20.0])], "{box_type}");
    }
}

/// The camera frame looks along x: the centre of a cube of 1 m whose face is 5 m ahead is at 5.5 m, 2 m to the right.
#[test]
fn oriented_boxes_in_space() {
    let world = labelled("cube", 5.0, 2.0, Some(7)) + &labelled("hidden", 15.0, 6.0, Some(7));
    let mut bench = Bench::still(&world, &camera("3d"));
    let heard = bench.hear::<Detection3DArray>("/boxes");
    let (images, info) =
        (bench.hear::<Image>("/boxes_image"), bench.hear::<CameraInfo>("/camera_info"));
    bench.run(0.01);
    let message = heard.latest().unwrap();
    let [cube] = message.detections.as_slice() else { panic!("{message:?}") };
    let (centre, size) = (&cube.bbox.center.position, &cube.bbox.size);
    for (seen, expected) in [(centre.x, 5.5), (centre.y, -2.0), (centre.z, 0.0)] {
        assert!((seen - expected).abs() < 1e-9, "{cube:?}");
    }
    assert_eq!([size.x, size.y, size.z], [1.0; 3]);
    // The cube looks along x of the world, the camera against it.
    assert!((cube.bbox.center.orientation.z.abs() - 1.0).abs() < 1e-9, "{cube:?}");
    assert_eq!((images.latest().unwrap().width, info.latest().unwrap().k[0].round()), (100, 50.0));
}

#[test]
fn an_unknown_box_type_is_reported() {
    let bench = Bench::still("", &camera("4d"));
    assert!(bench.said.contains("`4d` is not a box type"), "{}", bench.said);
    assert!(bench.said.contains("hall.sdf:"), "{}", bench.said);
}
