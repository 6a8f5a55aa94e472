//! Parser of interface texts, and the findings about faulty ones.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use expect_test::{Expect, expect};
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_rosidl::{
    ArrayShape, ElementType, InterfaceDialect, Registry, Scalar, TypeName, parse,
};

/// Findings about a text with this file name.
fn check(name: &str, text: &str, expected: Expect) {
    check_as(InterfaceDialect::Ros2, name, text, expected);
}

fn check_as(dialect: InterfaceDialect, name: &str, text: &str, expected: Expect) {
    let (_, found) = registry(dialect, &[(name, text)]);
    expected.assert_eq(&found);
}

fn registry(dialect: InterfaceDialect, texts: &[(&str, &str)]) -> (Registry, String) {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let mut registry = Registry::new();
    for (name, text) in texts {
        let name = TypeName::read(name).unwrap();
        let file = sources.add(format!("{}.{}", name.name, name.kind.word()), *text);
        if let Some(one) = parse(&name, file, &sources, dialect, &mut diagnostics) {
            registry.add(one);
        }
    }
    registry.check(&mut diagnostics);
    let found = diagnostics.iter().map(|one| render(one, &sources, RenderStyle::Plain));
    let found: Vec<String> = found.collect();
    (registry, found.join("\n"))
}

#[test]
fn slips_in_types_are_shown_with_what_was_meant() {
    check(
        "my_msgs/Scan",
        "flaot32 range\nfloat angle\nstrin<=5 name\nuint8 ok\n",
        expect![[r#"
            error[unknown-type]: `flaot32` is not a type
             --> Scan.msg:1:1
              |
            1 | flaot32 range
              | ^^^^^^^
              |
              = help: messages are named `package/Name`
            help: did you mean `float32`?
              |
            1 - flaot32 range
            1 + float32 range
              |

            error[unknown-type]: `float` is not a type
             --> Scan.msg:2:1
              |
            2 | float angle
              | ^^^^^
              |
              = help: messages are named `package/Name`
            help: did you mean `float32`?
              |
            2 | float32 angle
              |      ++

            error[unknown-type]: `strin` is not a type
             --> Scan.msg:3:1
              |
            3 | strin<=5 name
              | ^^^^^^^^
              |
              = help: messages are named `package/Name`
            help: did you mean `string`?
              |
            3 | string<=5 name
              |      +
        "#]],
    );
    check(
        "my_msgs/Scan",
        "int32[<3] a\nint32[0] b\nint32<=2 c\nstring<=0 d\n",
        expect![[r#"
        error[bad-array]: `[<3]` is not the size of an array
         --> Scan.msg:1:1
          |
        1 | int32[<3] a
          | ^^^^^^^^^
          |
          = help: write `[]`, `[3]` or `[<=3]`

        error[bad-array]: `[0]` is not the size of an array
         --> Scan.msg:2:1
          |
        2 | int32[0] b
          | ^^^^^^^^
          |
          = help: write `[]`, `[3]` or `[<=3]`

        error[bad-bound]: `int32` has no length to be bound
         --> Scan.msg:3:1
          |
        3 | int32<=2 c
          | ^^^^^^^^
          |
          = help: only `string` and `wstring` have

        error[bad-bound]: `0` is not the longest that a string may be
         --> Scan.msg:4:1
          |
        4 | string<=0 d
          | ^^^^^^^^^
          |
          = help: write a whole number above 0, such as `string<=255`
    "#]],
    );
}

#[test]
fn slips_in_names_and_values_are_shown() {
    check(
        "my_msgs/Scan",
        "int32 Range\nint32 a__b\nint8 low=-1\nint8 LOW=-129\nuint8\nbool b maybe\n",
        expect![[r#"
            error[bad-name]: `Range` cannot be the name of a field
             --> Scan.msg:1:7
              |
            1 | int32 Range
              |       ^^^^^
              |
              = help: lower case letters, digits and single underscores, a letter first

            error[bad-name]: `a__b` cannot be the name of a field
             --> Scan.msg:2:7
              |
            2 | int32 a__b
              |       ^^^^
              |
              = help: lower case letters, digits and single underscores, a letter first

            error[bad-name]: `low` cannot be the name of a constant
             --> Scan.msg:3:6
              |
            3 | int8 low=-1
              |      ^^^
              |
              = help: upper case letters, digits and single underscores, a letter first

            error[bad-value]: `-129` is not a value of this type
             --> Scan.msg:4:10
              |
            4 | int8 LOW=-129
              |          ^^^^ expected a whole number from -128 to 127

            error[missing-name]: `uint8` is followed by no name
             --> Scan.msg:5:1
              |
            5 | uint8
              | ^^^^^
              |
              = help: a line is `type name`, `type name default` or `type NAME=value`

            error[bad-value]: `maybe` is not a value of this type
             --> Scan.msg:6:8
              |
            6 | bool b maybe
              |        ^^^^^ expected `true` or `false`
        "#]],
    );
    check(
        "my_msgs/Scan",
        "int32 a\nstring b\nfloat64 a # again\n",
        expect![[r#"
        error[duplicate-name]: `a` is already defined
         --> Scan.msg:3:9
          |
        1 | int32 a
          |       - first defined here
        2 | string b
        3 | float64 a # again
          |         ^
    "#]],
    );
    check(
        "my_msgs/Scan",
        "float32[3] a [1, 2]\nPoint p 1\n",
        expect![[r#"
        error[bad-value]: `[1, 2]` is not a value of this type
         --> Scan.msg:1:14
          |
        1 | float32[3] a [1, 2]
          |              ^^^^^^ expected 3 values, not 2

        error[bad-value]: `1` is not a value of this type
         --> Scan.msg:2:9
          |
        2 | Point p 1
          |         ^ expected no value: only simple types have defaults
    "#]],
    );
}

#[test]
fn parts_are_counted() {
    check(
        "my_msgs/srv/Do",
        "int32 a\n",
        expect![[r#"
        error[missing-part]: `my_msgs/srv/Do_Response` is missing: the parts are separated by a line `---`
         --> Do.srv:2:1
          |
        2 |
          | ^
    "#]],
    );
    check(
        "my_msgs/srv/Do",
        "---\n---\n",
        expect![[r#"
        error[too-many-parts]: a `.srv` text has 2 parts, and this line begins another
         --> Do.srv:2:1
          |
        2 | ---
          | ^^^
    "#]],
    );
    check(
        "my_msgs/action/Do",
        "---\nbool done\n---\n",
        expect![[r#"
        error[unknown-type]: `my_msgs/action/Do_SendGoal_Request` needs the unknown type `unique_identifier_msgs/msg/UUID`
         |
         = help: add the package `unique_identifier_msgs`

        error[unknown-type]: `my_msgs/action/Do_SendGoal_Response` needs the unknown type `builtin_interfaces/msg/Time`
         |
         = help: add the package `builtin_interfaces`

        error[unknown-type]: `my_msgs/action/Do_SendGoal_Event` needs the unknown type `service_msgs/msg/ServiceEventInfo`
         |
         = help: add the package `service_msgs`

        error[unknown-type]: `my_msgs/action/Do_GetResult_Request` needs the unknown type `unique_identifier_msgs/msg/UUID`
         |
         = help: add the package `unique_identifier_msgs`

        error[unknown-type]: `my_msgs/action/Do_GetResult_Event` needs the unknown type `service_msgs/msg/ServiceEventInfo`
         |
         = help: add the package `service_msgs`

        error[unknown-type]: `my_msgs/action/Do_FeedbackMessage` needs the unknown type `unique_identifier_msgs/msg/UUID`
         |
         = help: add the package `unique_identifier_msgs`
    "#]],
    );
}

#[test]
fn unknown_and_endless_types_are_found() {
    let (registry, found) = registry(
        InterfaceDialect::Ros2,
        &[
            ("my_msgs/A", "B b\n"),
            ("my_msgs/B", "A[] more\n"),
            ("my_msgs/Wheel", "float64 radius\n"),
            ("my_msgs/Car", "Wheels[4] wheels\nother_msgs/Wheel spare\n"),
            ("my_msgs/Big", "Huge[1000] all\n"),
            ("my_msgs/Huge", "float64[2000] all\n"),
        ],
    );
    expect![[r#"
        error[endless-type]: `my_msgs/msg/B` contains itself through `my_msgs/msg/A`
         --> B.msg:1:1
          |
        1 | A[] more
          | ^^^

        error[large-type]: `my_msgs/msg/Big` has more than 1048576 elements of fixed number
         --> Big.msg:1:1
          |
        1 | Huge[1000] all
          | ^^^^^^^^^^

        error[unknown-type]: `my_msgs/msg/Car` needs the unknown type `my_msgs/msg/Wheels`
         --> Car.msg:1:1
          |
        1 | Wheels[4] wheels
          | ^^^^^^^^^
          |
          = help: did you mean `my_msgs/Wheel`?

        error[unknown-type]: `my_msgs/msg/Car` needs the unknown type `other_msgs/msg/Wheel`
         --> Car.msg:2:1
          |
        2 | other_msgs/Wheel spare
          | ^^^^^^^^^^^^^^^^
          |
          = help: there is `my_msgs/Wheel`
    "#]]
    .assert_eq(&found);
    let left: Vec<String> = registry.types().map(|one| one.name.short()).collect();
    assert_eq!(left, ["my_msgs/Huge", "my_msgs/Wheel"]);
}

#[test]
fn comments_become_documentation() {
    let text = "\
# A wheel.
# It turns.

# Above.
float64 radius # Beside; m.
               # And below.
# Of nothing.

string name 'a # b' # c
uint8 ROUND=1 # Best.
";
    let (registry, found) = registry(InterfaceDialect::Ros2, &[("my_msgs/Wheel", text)]);
    assert_eq!(found, "");
    let wheel = registry.get(&TypeName::message("my_msgs", "Wheel")).unwrap();
    assert_eq!(wheel.doc, "A wheel.\nIt turns.");
    assert_eq!(wheel.fields[0].doc, "Above.\nBeside; m.\nAnd below.");
    assert_eq!(wheel.fields[1].doc, "c");
    assert_eq!(wheel.constants[0].doc, "Best.");
    assert_eq!(wheel.text, text);
}

#[test]
fn texts_of_ros_1_are_read_by_its_rules() {
    let texts = [
        ("std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id\n"),
        ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"),
        ("my_msgs/Old", "Header header\nbyte level\nstring Name=a # b\ntime[2] when\n"),
    ];
    let (registry, found) = registry(InterfaceDialect::Ros1, &texts);
    assert_eq!(found, "");
    let old = registry.get(&TypeName::message("my_msgs", "Old")).unwrap();
    assert_eq!(old.fields[1].r#type.element, ElementType::Scalar(Scalar::Ros1Byte));
    assert_eq!(old.fields[2].r#type.shape, ArrayShape::Fixed(2));
    let time = TypeName::message("builtin_interfaces", "Time");
    assert_eq!(old.fields[2].r#type.element, ElementType::Nested(time));
    check_as(
        InterfaceDialect::Ros1,
        "my_msgs/Old",
        "int32 a 5\n",
        expect![[r#"
        error[bad-value]: `5` follows the field, and ROS 1 has no defaults
         --> Old.msg:1:9
          |
        1 | int32 a 5
          |         ^
    "#]],
    );
}

#[test]
fn any_text_is_read_or_refused() {
    use proptest::prelude::*;
    let word =
        "(int32|string|bool|Wheel|my_msgs/Wheel|a|B|=|1|\\[|\\]|<=|#|'|\"|---|\n|[ -~]|\\PC)";
    proptest!(|(words in prop::collection::vec(word, 0..60), spaced in any::<bool>())| {
        let text = words.join(if spaced { " " } else { "" });
        for name in ["my_msgs/Wheel", "my_msgs/srv/Do", "my_msgs/action/Do"] {
            registry(InterfaceDialect::Ros2, &[(name, &text)]);
            registry(InterfaceDialect::Ros1, &[(name, &text)]);
        }
    });
}
