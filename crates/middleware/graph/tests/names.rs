//! Names, as nodes write them and as they end up.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

use std::fmt::Write;

use expect_test::{Expect, expect};
use periplus_graph::{NodeSettings, check_topic, valid_node_name, valid_topic_name};
use proptest::prelude::*;

/// One line for each name: as written, and the full name or what is wrong.
fn check(settings: NodeSettings, written: &[&str], expected: Expect) {
    let mut text = String::new();
    let names = match settings.names() {
        Ok(names) => names,
        Err(error) => return expected.assert_eq(&error.to_string()),
    };
    writeln!(text, "{}:", names.full_name()).unwrap();
    for written in written {
        match names.topic(written) {
            Ok(full) => writeln!(text, "{written:12} {full}").unwrap(),
            Err(error) => writeln!(text, "{written:12} ! {error}").unwrap(),
        }
    }
    expected.assert_eq(&text);
}

#[test]
fn names_are_relative_absolute_or_private() {
    let written = ["scan", "/scan", "~/out", "~", "a/b", "{node}/x", "{ns}/x", "/a/{ns}"];
    check(
        NodeSettings::new("lidar").namespace("demo/front"),
        &written,
        expect![[r#"
        /demo/front/lidar:
        scan         /demo/front/scan
        /scan        /scan
        ~/out        /demo/front/lidar/out
        ~            /demo/front/lidar
        a/b          /demo/front/a/b
        {node}/x     /demo/front/lidar/x
        {ns}/x       /demo/front/x
        /a/{ns}      ! the name `/a/{ns}` of a topic has two `/` in a row; `/a/_ns_` would do
    "#]],
    );
    check(
        NodeSettings::new("lidar"),
        &written,
        expect![[r#"
        /lidar:
        scan         /scan
        /scan        /scan
        ~/out        /lidar/out
        ~            /lidar
        a/b          /a/b
        {node}/x     /lidar/x
        {ns}/x       /x
        /a/{ns}      ! the name `/a/{ns}` of a topic ends with `/`; `/a/_ns_` would do
    "#]],
    );
}

#[test]
fn names_that_ros_refuses_are_explained() {
    let written = [
        "",
        "a b",
        "robot-1/scan",
        "/scan/",
        "//scan",
        "1scan",
        "a/2d",
        "~out",
        "a/~/b",
        "{who}",
        "/",
        "é",
    ];
    check(
        NodeSettings::new("n"),
        &written,
        expect![[r#"
        /n:
                     ! the name `` of a topic is empty
        a b          ! the name `a b` of a topic has ` `; only letters, digits, `_` and `/` are allowed; `a_b` would do
        robot-1/scan ! the name `robot-1/scan` of a topic has `-`; only letters, digits, `_` and `/` are allowed; `robot_1/scan` would do
        /scan/       ! the name `/scan/` of a topic ends with `/`; `/scan` would do
        //scan       ! the name `//scan` of a topic has two `/` in a row; `/scan` would do
        1scan        ! the name `1scan` of a topic has a part that begins with a digit, `1scan`; `_1scan` would do
        a/2d         ! the name `a/2d` of a topic has a part that begins with a digit, `2d`; `a/_2d` would do
        ~out         ! the name `~out` of a topic has no `/` after its `~`; `~/out` would do
        a/~/b        ! the name `a/~/b` of a topic has a `~` that is not its beginning
        {who}        ! the name `{who}` of a topic has braces; only `{node}`, `{ns}` and `{namespace}` have a meaning
        /            ! the name `/` of a topic ends with `/`; `/_` would do
        é            ! the name `é` of a topic has `é`; only letters, digits, `_` and `/` are allowed; `_` would do
    "#]],
    );
    let long = "a".repeat(250);
    let error = check_topic("topic", &format!("/{long}")).unwrap_err().to_string();
    assert!(error.ends_with("has 251 bytes, at most 247 are allowed"), "{error}");
    check(
        NodeSettings::new("my node"),
        &[],
        expect![
            "the name `my node` of a node has ` `; only letters, digits and `_` are allowed; `my_node` would do"
        ],
    );
    check(
        NodeSettings::new("2d"),
        &[],
        expect!["the name `2d` of a node begins with a digit; `_2d` would do"],
    );
    check(
        NodeSettings::new("n").namespace("/a-b"),
        &[],
        expect![
            "the name `/a-b` of a namespace has `-`; only letters, digits, `_` and `/` are allowed; `/a_b` would do"
        ],
    );
}

#[test]
fn the_first_remapping_that_fits_wins() {
    let settings = || NodeSettings::new("lidar").namespace("demo");
    check(
        settings().remap("~/out", "scan").rule("/demo/scan:=first").rule("scan:=second"),
        &["~/out", "scan", "/demo/scan", "/scan", "other"],
        expect![[r#"
            /demo/lidar:
            ~/out        /demo/scan
            scan         /demo/first
            /demo/scan   /demo/first
            /scan        /scan
            other        /demo/other
        "#]],
    );
    // Rules for other nodes, for services, and for the node itself.
    check(
        settings()
            .rule("camera:scan:=wrong")
            .rule("lidar:scan:=right")
            .rule("rosservice://image:=wrong")
            .rule("rostopic://image:=picture"),
        &["scan", "image"],
        expect![[r#"
            /demo/lidar:
            scan         /demo/right
            image        /demo/picture
        "#]],
    );
    check(
        settings().rule("__node:=radar").rule("lidar:__ns:=/far/away").rule("~/a:=~/b"),
        &["scan", "~/a"],
        expect![[r#"
            /far/away/radar:
            scan         /far/away/scan
            ~/a          /far/away/radar/b
        "#]],
    );
    let names = settings().rule("rosservice://x:=y").names().unwrap();
    assert_eq!(names.service("x").unwrap(), "/demo/y");
    assert_eq!(names.topic("x").unwrap(), "/demo/x");
}

#[test]
fn remappings_that_mean_nothing_are_explained() {
    for (rule, expected) in [
        (
            "scan",
            expect![
                "the remapping `scan` has no `:=`; write `from:=to`, `node:from:=to`, `__node:=name` or `__ns:=/namespace`"
            ],
        ),
        (
            "scan:=",
            expect![
                "the remapping `scan:=` has nothing after its `:=`; write `from:=to`, `node:from:=to`, `__node:=name` or `__ns:=/namespace`"
            ],
        ),
        (
            ":=scan",
            expect![
                "the remapping `:=scan` has nothing before its `:=`; write `from:=to`, `node:from:=to`, `__node:=name` or `__ns:=/namespace`"
            ],
        ),
        (
            "/a/*:=b",
            expect![
                "the remapping `/a/*:=b` has a wildcard, which ROS 2 does not know either; write `from:=to`, `node:from:=to`, `__node:=name` or `__ns:=/namespace`"
            ],
        ),
        (
            "a:=b-c",
            expect![
                "the name `b-c` of a topic has `-`; only letters, digits, `_` and `/` are allowed; `b_c` would do"
            ],
        ),
        (
            "my node:a:=b",
            expect![
                "the name `my node` of a node has ` `; only letters, digits and `_` are allowed; `my_node` would do"
            ],
        ),
        (
            "__ns:=a b",
            expect![
                "the name `/a b` of a namespace has ` `; only letters, digits, `_` and `/` are allowed; `/a_b` would do"
            ],
        ),
    ] {
        check(NodeSettings::new("n").rule(rule), &[], expected);
    }
}

#[test]
fn names_of_gazebo_become_valid() {
    for (gazebo, ros) in [
        ("/scan", "/scan"),
        ("/model/robot-1/link/base::lidar", "/model/robot_1/link/base__lidar"),
        ("/world/my world/stats", "/world/my_world/stats"),
        ("2d/scan", "_2d/scan"),
        ("//a//b/", "/a/b"),
        ("~/set pose", "~/set_pose"),
        ("", "_"),
        ("/", "/_"),
        ("Ö", "_"),
    ] {
        assert_eq!(valid_topic_name(gazebo), ros);
    }
    assert_eq!(valid_node_name("front/lidar 2"), "front_lidar_2");
}

proptest! {
    #[test]
    fn any_text_becomes_a_name(text: String) {
        prop_assume!(text.len() < 100);
        let names = NodeSettings::new(valid_node_name(&text)).namespace("/ns").names();
        let full = names.unwrap().topic(&valid_topic_name(&text)).unwrap();
        prop_assert!(check_topic("topic", &full).is_ok());
        // What is valid stays as it is.
        prop_assert_eq!(valid_topic_name(&full), full);
    }

    #[test]
    fn any_rule_is_read_or_refused(name: String, namespace: String, rule: String, topic: String) {
        let settings = NodeSettings::new(name).namespace(&namespace).rule(&rule);
        if let Ok(names) = settings.names()
            && let Ok(full) = names.topic(&topic)
        {
            prop_assert!(check_topic("topic", &full).is_ok());
        }
    }

    #[test]
    fn any_rule_of_its_parts_is_read_or_refused(
        parts in prop::collection::vec("[a-b/~:={}_]{0,6}|:=|__ns|__node|rostopic://", 0..6),
    ) {
        let rule: String = parts.concat();
        if let Ok(names) = NodeSettings::new("a").namespace("b").rule(&rule).names() {
            for topic in ["a", "~/a", "/b/a", &rule] {
                if let Ok(full) = names.topic(topic) {
                    prop_assert!(check_topic("topic", &full).is_ok());
                }
            }
        }
    }
}
