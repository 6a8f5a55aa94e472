//! Descriptions and schema texts.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use expect_test::expect;
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_rosidl::{InterfaceDialect, Registry, TypeName, parse};

fn registry(texts: &[(&str, &str)]) -> Registry {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let mut registry = Registry::new();
    for (name, text) in texts {
        let name = TypeName::read(name).unwrap();
        let file = sources.add("text", *text);
        let one = parse(&name, file, &sources, InterfaceDialect::Ros2, &mut diagnostics);
        registry.add(one.unwrap());
    }
    registry
}

const DURATION: (&str, &str) = ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n");

#[test]
fn what_is_hashed() {
    let registry = registry(&[
        (
            "my_msgs/Wait",
            "# Words.\nuint8 MOST=3\nbuiltin_interfaces/Duration[<=3] times # s\nstring<=9 why 'x'\n",
        ),
        DURATION,
        ("my_msgs/Nothing", ""),
    ]);
    let of = |name| registry.description(&TypeName::read(name).unwrap()).unwrap();
    expect![[r#"{"type_description": {"type_name": "my_msgs/msg/Wait", "fields": [{"name": "times", "type": {"type_id": 97, "capacity": 3, "string_capacity": 0, "nested_type_name": "builtin_interfaces/msg/Duration"}}, {"name": "why", "type": {"type_id": 21, "capacity": 0, "string_capacity": 9, "nested_type_name": ""}}]}, "referenced_type_descriptions": [{"type_name": "builtin_interfaces/msg/Duration", "fields": [{"name": "sec", "type": {"type_id": 6, "capacity": 0, "string_capacity": 0, "nested_type_name": ""}}, {"name": "nanosec", "type": {"type_id": 7, "capacity": 0, "string_capacity": 0, "nested_type_name": ""}}]}]}"#]].assert_eq(&of("my_msgs/Wait"));
    expect![[r#"{"type_description": {"type_name": "my_msgs/msg/Nothing", "fields": [{"name": "structure_needs_at_least_one_member", "type": {"type_id": 3, "capacity": 0, "string_capacity": 0, "nested_type_name": ""}}]}, "referenced_type_descriptions": []}"#]].assert_eq(&of("my_msgs/Nothing"));
}

/// As in the build of `std_msgs` for ROS 2 Jazzy.
#[test]
fn a_published_hash() {
    let registry = registry(&[("std_msgs/String", "string data\n")]);
    let hash = registry.hash(&TypeName::message("std_msgs", "String")).unwrap();
    let published = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18";
    assert_eq!(hash, published);
}

#[test]
fn a_schema_reads_back() {
    let first = registry(&[
        ("my_msgs/Wait", "builtin_interfaces/Duration first\nOther other\n"),
        ("my_msgs/Other", "builtin_interfaces/Duration again\n"),
        DURATION,
    ]);
    let name = TypeName::message("my_msgs", "Wait");
    let text = first.schema_text(&name).unwrap();
    expect![[r#"
        builtin_interfaces/Duration first
        Other other
        ================================================================================
        MSG: builtin_interfaces/Duration
        int32 sec
        uint32 nanosec
        ================================================================================
        MSG: my_msgs/Other
        builtin_interfaces/Duration again
    "#]]
    .assert_eq(&text);
    let mut sources = SourceMap::new();
    let file = sources.add("schema", text);
    let mut second = Registry::new();
    let mut found = Diagnostics::new();
    assert!(
        second.add_schema(&name, file, &sources, InterfaceDialect::Ros2, &mut found),
        "{found:?}"
    );
    assert_eq!(second.hash(&name), first.hash(&name));
}

#[test]
fn code_of_a_package() {
    let registry = registry(&[
        (
            "my_msgs/Wheel",
            "# A wheel.\n\nfloat32 radius 0.5 # m.\nfloat64[3] self\nstring<=5 type 'a'\nWheel2[<=2] others\nint8 LOW=-1\n",
        ),
        ("my_msgs/Wheel2", ""),
    ]);
    expect![[r#"
        //! `my_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/my_msgs`
        //! instead.

        crate::message! {
            /// A wheel.
            "my_msgs/msg/Wheel" "RIHS01_e87de75195edb7f1a13b023daf53841f2a4a029715c662ac7a171ed9aa21be8b"
            Wheel {
                /// m.
                radius: f32 = 0.5,
                /// self
                self_: [f64; 3],
                /// type
                r#type: std::string::String | 5 = "a".into(),
                /// others
                others: Vec<Wheel2> | 2,
            }
            /// LOW
            LOW: i8 = -1;
        }

        crate::message! {
            /// `my_msgs/msg/Wheel2`.
            "my_msgs/msg/Wheel2" "RIHS01_6894fdb66e65c91bdb1ba4542484ac7077505626c2590ae567459f48d3a0559f"
            Wheel2 {
            }
        }
    "#]].assert_eq(&periplus_rosidl::rust::package(&registry, "my_msgs").unwrap());
}
