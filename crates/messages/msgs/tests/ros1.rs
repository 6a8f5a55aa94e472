//! Conversion of types and bytes between ROS 1 and ROS 2.
#![allow(clippy::unwrap_used, reason = "a test may stop")]

use periplus_msgs::visualization_msgs::Marker;
use periplus_msgs::{
    Adaptation, DynamicMessage, Encapsulation, Format, Message, TypeRegistry, recode,
};
use periplus_rosidl::TypeName;

/// Sums of ROS 1 Noetic, as PyPI `rosbags` 0.11.9 computes them over its definitions.
#[test]
fn sums_are_those_of_noetic() {
    let mut wrong = Vec::new();
    for line in include_str!("data/ros1_md5.tsv").lines() {
        let (name, md5) = line.split_once('\t').unwrap();
        let text = TypeRegistry::ros1().registry().ros1_text(&TypeName::read(name).unwrap());
        if text.unwrap().md5 != md5 {
            wrong.push(name);
        }
    }
    assert_eq!(wrong, Vec::<&str>::new());
}

#[test]
fn texts_are_those_of_ros_1() {
    let text = |name| {
        let name = TypeName::read(name).unwrap();
        TypeRegistry::ros1().registry().ros1_text(&name).unwrap().text
    };
    expect_test::expect![[r"
        std_msgs/Header header
        geometry_msgs/Point point
        ================================================================================
        MSG: std_msgs/Header
        uint32 seq
        time stamp
        string frame_id
        ================================================================================
        MSG: geometry_msgs/Point
        float64 x
        float64 y
        float64 z
    "]]
    .assert_eq(&text("geometry_msgs/PointStamped"));
    assert!(text("sensor_msgs/CameraInfo").contains("\nfloat64[] D\nfloat64[9] K\n"));
}

/// Every type: from CDR to ROS 1 and back, and to the other order of bytes and back.
#[test]
fn bytes_go_there_and_back() {
    let types = TypeRegistry::builtin();
    let big = Format::Cdr(Encapsulation::BigEndian);
    for line in include_str!("data/oracle.jsonl").lines() {
        let line: serde_json::Value = serde_json::from_str(line).unwrap();
        let layout = types.layout(line["type"].as_str().unwrap()).unwrap();
        let message = DynamicMessage::from_json(layout, &line["json"]).unwrap();
        let encoded = |format| {
            let mut bytes = Vec::new();
            message.encode(format, &mut bytes).unwrap();
            bytes
        };
        for from in [Format::CDR, big, Format::Ros1] {
            for to in [Format::CDR, big, Format::Ros1] {
                let mut bytes = Vec::new();
                recode(layout, from, &encoded(from), to, &mut bytes).unwrap();
                assert_eq!(bytes, encoded(to), "{} {from:?} {to:?}", layout.type_name());
            }
        }
    }
}

#[test]
fn what_both_revisions_have_is_kept() {
    let name = Marker::TYPE_NAME;
    let (new, old) = (TypeRegistry::builtin().layout(name), TypeRegistry::ros1().layout(name));
    let (new, old) = (new.unwrap(), old.unwrap());
    assert!(!new.has_bytes_of(old) && new.has_bytes_of(new));
    let down = Adaptation::new(new, old);
    assert_eq!(down.lost(), ["texture_resource", "texture", "uv_coordinates", "mesh_file"]);
    assert_eq!(down.blank(), [""; 0]);
    let up = Adaptation::new(old, new);
    assert_eq!(up.blank(), down.lost());
    let mut marker = Marker { id: 7, text: "here".into(), ..Marker::default() };
    marker.points.resize_with(3, Default::default);
    marker.uv_coordinates.resize_with(2, Default::default);
    let message = DynamicMessage::of(&marker).unwrap();
    let mut bytes = Vec::new();
    up.apply(down.apply(message)).encode(Format::CDR, &mut bytes).unwrap();
    marker.uv_coordinates.clear();
    assert_eq!(Marker::decode_cdr(&bytes).unwrap(), marker);
    // Names in another case are the same fields.
    let camera = "sensor_msgs/msg/CameraInfo";
    let (new, old) = (TypeRegistry::builtin().layout(camera), TypeRegistry::ros1().layout(camera));
    assert!(new.unwrap().has_bytes_of(old.unwrap()));
}
