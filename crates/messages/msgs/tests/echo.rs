//! Printed messages, and types known only at run time.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use expect_test::{Expect, expect};
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_msgs::{
    DynamicMessage, Format, Message, TypeRegistry, YamlStyle, diagnostic_msgs, geometry_msgs,
    sensor_msgs, std_msgs, tf2_msgs,
};
use periplus_rosidl::{InterfaceDialect, Registry, TypeName};
use serde_json::json;

fn check<T: Message>(message: &T, style: &YamlStyle, expected: Expect) {
    expected.assert_eq(&DynamicMessage::of(message).unwrap().to_yaml(style));
}

#[test]
fn yaml_as_topic_echo_prints_it() {
    let mut transform = geometry_msgs::TransformStamped::default();
    transform.header.frame_id = "odom".into();
    transform.header.stamp.sec = 12;
    transform.child_frame_id = "base_link".into();
    transform.transform.translation.x = 1e-7;
    transform.transform.translation.y = 1e16;
    let message = tf2_msgs::TFMessage { transforms: vec![transform] };
    check(
        &message,
        &YamlStyle::default(),
        expect![[r#"
        transforms:
        - header:
            stamp:
              sec: 12
              nanosec: 0
            frame_id: odom
          child_frame_id: base_link
          transform:
            translation:
              x: 1.0e-07
              y: 1.0e+16
              z: 0.0
            rotation:
              x: 0.0
              y: 0.0
              z: 0.0
              w: 1.0
    "#]],
    );
}

#[test]
fn numbers_texts_and_lists_in_yaml() {
    let scan = sensor_msgs::LaserScan {
        ranges: vec![0.1, f32::INFINITY, f32::NAN, 2.0],
        ..Default::default()
    };
    let short = YamlStyle { longest: Some(3), ..YamlStyle::default() };
    check(
        &scan,
        &short,
        expect![[r#"
        header:
          stamp:
            sec: 0
            nanosec: 0
          frame_id: ''
        angle_min: 0.0
        angle_max: 0.0
        angle_increment: 0.0
        time_increment: 0.0
        scan_time: 0.0
        range_min: 0.0
        range_max: 0.0
        ranges:
        - 0.10000000149011612
        - .inf
        - .nan
        - '...'
        intensities: []
    "#]],
    );
    let without = YamlStyle { no_arrays: true, no_texts: true, ..YamlStyle::default() };
    check(
        &scan,
        &without,
        expect![[r#"
        header:
          stamp:
            sec: 0
            nanosec: 0
          frame_id: ''
        angle_min: 0.0
        angle_max: 0.0
        angle_increment: 0.0
        time_increment: 0.0
        scan_time: 0.0
        range_min: 0.0
        range_max: 0.0
        ranges: '<array type: float32[4]>'
        intensities: []
    "#]],
    );
    let status = diagnostic_msgs::DiagnosticStatus {
        level: 1,
        name: "true".into(),
        message: "a: b".into(),
        hardware_id: "two\nlines".into(),
        values: vec![diagnostic_msgs::KeyValue { key: "it's".into(), value: "1.5".into() }],
    };
    check(
        &status,
        &YamlStyle::default(),
        expect![[r#"
        level: "\x01"
        name: 'true'
        message: 'a: b'
        hardware_id: "two\nlines"
        values:
        - key: it's
          value: '1.5'
    "#]],
    );
    check(
        &std_msgs::Empty {},
        &YamlStyle::default(),
        expect![[r#"
        {}
    "#]],
    );
}

#[test]
fn json_keeps_defaults_and_names_strangers() {
    let twist = geometry_msgs::Twist::from_json(&json!({"linear": {"x": 1}})).unwrap();
    assert_eq!(twist.linear.x, 1.0);
    let pose = geometry_msgs::Pose::from_json(&json!({})).unwrap();
    assert_eq!(pose.orientation.w, 1.0);
    let wrong = |json| geometry_msgs::Twist::from_json(&json).unwrap_err().to_string();
    expect!["there is no field `linaer`, did you mean `linear`?"]
        .assert_eq(&wrong(json!({"linaer": {}})));
    expect!["expected a value of type float64, found the text \"fast\" (at `linear.x`)"]
        .assert_eq(&wrong(json!({"linear": {"x": "fast"}})));
    let byte = std_msgs::UInt8::from_json(&json!({"data": 256})).unwrap_err().to_string();
    expect!["expected a value of type uint8, found 256 (at `data`)"].assert_eq(&byte);
}

#[test]
fn schema_text_as_mcap_wants_it() {
    expect![[r#"
        # Accel with a time and a frame.

        std_msgs/Header header
        Accel accel
        ================================================================================
        MSG: std_msgs/Header
        # When and in which frame.

        builtin_interfaces/Time stamp # When it was so.
        string frame_id # The frame of all coordinates beside it.
        ================================================================================
        MSG: geometry_msgs/Accel
        # Acceleration along and about the axes.

        Vector3 linear # m/s2.
        Vector3 angular # rad/s2.
        ================================================================================
        MSG: builtin_interfaces/Time
        # A moment, on the clock of the sender: the machine's or the simulation's.

        int32 sec # Whole seconds; 0 is 1970 or the start of the simulation.
        uint32 nanosec # The rest; ns below one second.
        ================================================================================
        MSG: geometry_msgs/Vector3
        # A direction with a length; unlike a point it is never moved, only turned.

        float64 x
        float64 y
        float64 z
    "#]]
    .assert_eq(geometry_msgs::AccelStamped::schema_text());
}

/// Every kind of field, as a user's package might have them.
const ZOO: &str = "\
int32 MOST=3
string NAME=\"zoo\"
bool b true
byte o 7
char c 65
float32[2] pair [0.5, -1.5]
int16[<=3] few [1, 2]
string<=5 short 'abc'
wstring wide \"wïde\"
string[] names [\"a\", 'b c']
Animal[<=2] animals
geometry_msgs/Point[2] corners
uint64 big 18446744073709551615
================================================================================
MSG: zoo_msgs/Animal
string name
uint8[] code
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
";

fn zoo() -> TypeRegistry {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let mut registry = Registry::new();
    let name = TypeName::message("zoo_msgs", "Zoo");
    let file = sources.add("zoo", ZOO);
    registry.add_schema(&name, file, &sources, InterfaceDialect::Ros2, &mut diagnostics);
    let types = TypeRegistry::new(registry, &mut diagnostics);
    let findings: Vec<_> =
        diagnostics.iter().map(|one| render(one, &sources, RenderStyle::Plain)).collect();
    assert!(findings.is_empty(), "{}", findings.join("\n"));
    types
}

#[test]
fn a_type_from_a_bag_is_read_and_written() {
    let types = zoo();
    let layout = types.layout("zoo_msgs/msg/Zoo").unwrap();
    let json = json!({
        "animals": [{"name": "ape", "code": [1, 2]}],
        "short": "12345",
        "corners": [{"x": 1.0, "y": 2.0, "z": 3.0}, {"x": 0.0, "y": 0.0, "z": 0.0}],
    });
    let message = DynamicMessage::from_json(layout, &json).unwrap();
    for format in [Format::CDR, Format::Ros1] {
        let mut bytes = Vec::new();
        message.encode(format, &mut bytes).unwrap();
        assert_eq!(DynamicMessage::decode(layout, format, &bytes).unwrap(), message);
    }
    expect![[r#"
        b: true
        o: "\a"
        c: 65
        pair:
        - 0.5
        - -1.5
        few:
        - 1
        - 2
        short: '12345'
        wide: wïde
        names:
        - a
        - b c
        animals:
        - name: ape
          code:
          - 1
          - 2
        corners:
        - x: 1.0
          y: 2.0
          z: 3.0
        - x: 0.0
          y: 0.0
          z: 0.0
        big: 18446744073709551615
    "#]]
    .assert_eq(&message.to_yaml(&YamlStyle::default()));
    let long = DynamicMessage::from_json(layout, &json!({"short": "123456"})).unwrap_err();
    expect!["6 elements where the type allows 5 (at `short`)"].assert_eq(&long.to_string());
    assert!(message.get("animals[0].name").is_some());
    assert_eq!(message.get("animals[1].name"), None);
    assert_eq!(message.get("corners[0].x"), Some(periplus_msgs::Value::Number(1.0.into())));
}

/// Regression test: a text that begins with a multi-byte character caused a panic.
#[test]
fn any_text_can_be_shown() {
    use proptest::prelude::*;
    proptest!(|(data in "(\\PC|[ -~]|[\u{0}-\u{ff}]|\u{2028}|→){0,12}")| {
        let message = DynamicMessage::of(&std_msgs::String { data }).unwrap();
        let yaml = message.to_yaml(&YamlStyle::default());
        // One line, whatever is in it.
        prop_assert_eq!(yaml.chars().filter(|c| "\n\r\u{85}\u{2028}\u{2029}".contains(*c)).count(), 1);
    });
}

/// Result of PyYAML for the same values.
#[test]
fn texts_and_numbers_as_pyyaml_writes_them() {
    for (data, expected) in [
        ("", "''"),
        ("base_link", "base_link"),
        ("/camera/image", "/camera/image"),
        ("→ b", "→ b"),
        ("Yes", "'Yes'"),
        ("yEs", "yEs"),
        ("y", "y"),
        ("null", "'null'"),
        ("12:30", "'12:30'"),
        ("1e5", "1e5"),
        ("a #b", "'a #b'"),
        ("a#b", "a#b"),
        ("- a", "'- a'"),
        ("-a", "-a"),
        ("it's: so", "'it''s: so'"),
        ("tab\t", "\"tab\\t\""),
    ] {
        let message = DynamicMessage::of(&std_msgs::String { data: data.into() }).unwrap();
        assert_eq!(message.to_yaml(&YamlStyle::default()), format!("data: {expected}\n"));
    }
    for (data, expected) in
        [(1e16, "1.0e+16"), (1.5e-5, "1.5e-05"), (1e15, "1000000000000000.0"), (-0.0, "-0.0")]
    {
        let message = DynamicMessage::of(&std_msgs::Float64 { data }).unwrap();
        assert_eq!(message.to_yaml(&YamlStyle::default()), format!("data: {expected}\n"));
    }
}
