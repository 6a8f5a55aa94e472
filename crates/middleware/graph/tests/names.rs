//! Names as written by nodes, and expanded.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use std::fmt::Write;

use expect_test::{Expect, expect};
use periplus_graph::{NodeSettings, check_topic, valid_node_name, valid_topic_name};
use proptest::prelude::*;

/// One line for each name: as written, and the full name or the error.
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
        /a/{ns}      ! the topic name `/a/{ns}` has two `/` in a row; `/a/_ns_` is valid
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
        /a/{ns}      ! the topic name `/a/{ns}` ends with `/`; `/a/_ns_` is valid
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
                         ! the topic name `` is empty
            a b          ! the topic name `a b` has ` `; only letters, digits, `_` and `/` are allowed; `a_b` is valid
            robot-1/scan ! the topic name `robot-1/scan` has `-`; only letters, digits, `_` and `/` are allowed; `robot_1/scan` is valid
            /scan/       ! the topic name `/scan/` ends with `/`; `/scan` is valid
            //scan       ! the topic name `//scan` has two `/` in a row; `/scan` is valid
            1scan        ! the topic name `1scan` has a part that begins with a digit, `1scan`; `_1scan` is valid
            a/2d         ! the topic name `a/2d` has a part that begins with a digit, `2d`; `a/_2d` is valid
            ~out         ! the topic name `~out` has no `/` after its `~`; `~/out` is valid
            a/~/b        ! the topic name `a/~/b` ` that is not its beginning~` that is not its beginning
            {who}        ! the topic name `{who}` has braces; only the substitutions `{node}`, `{ns}` and `{namespace}` exist
            /            ! the topic name `/` ends with `/`; `/_` is valid
            é            ! the topic name `é` has `é`; only letters, digits, `_` and `/` are allowed; `_` is valid
        "#]],
    );
    let long = "a".repeat(250);
    let error = check_topic("topic", &format!("/{long}")).unwrap_err().to_string();
    assert!(error.ends_with("has 251 bytes, at most 247 are allowed"), "{error}");
    check(
        NodeSettings::new("my node"),
        &[],
        expect![
            "the node name `my node` has ` `; only letters, digits and `_` are allowed; `my_node` is valid"
        ],
    );
    check(
        NodeSettings::new("2d"),
        &[],
        expect!["the node name `2d` begins with a digit; `_2d` is valid"],
    );
    check(
        NodeSettings::new("n").namespace("/a-b"),
        &[],
        expect![
            "the namespace name `/a-b` has `-`; only letters, digits, `_` and `/` are allowed; `/a_b` is valid"
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
                "the remapping `/a/*:=b` has a wildcard, which ROS 2 does not support; write `from:=to`, `node:from:=to`, `__node:=name` or `__ns:=/namespace`"
            ],
        ),
        (
            "a:=b-c",
            expect![
                "the topic name `b-c` has `-`; only letters, digits, `_` and `/` are allowed; `b_c` is valid"
            ],
        ),
        (
            "my node:a:=b",
            expect![
                "the node name `my node` has ` `; only letters, digits and `_` are allowed; `my_node` is valid"
            ],
        ),
        (
            "__ns:=a b",
            expect![
                "the namespace name `/a b` has ` `; only letters, digits, `_` and `/` are allowed; `/a_b` is valid"
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
        // Valid names are not changed.
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

/// Regression test: copies of a robot whose description has absolute names obeyed the same commands.
#[test]
fn the_names_of_a_confined_node_are_in_its_namespace() {
    let names = NodeSettings::new("drive")
        .namespace("/robot_1/wheels")
        .remap("cmd_vel", "/cmd_vel")
        .remap("/tf", "/robot_1/tf")
        .confine("robot_1")
        .names()
        .unwrap();
    let check = |written: &str, expected: &str| {
        assert_eq!(names.topic(written).unwrap(), expected);
    };
    check("cmd_vel", "/robot_1/cmd_vel");
    check("odom", "/robot_1/wheels/odom");
    check("/scan", "/robot_1/scan");
    check("/robot_10/scan", "/robot_1/robot_10/scan");
    check("/tf", "/robot_1/tf");
    check("/clock", "/clock");
    assert_eq!(names.service("/reset").unwrap(), "/robot_1/reset");
}
