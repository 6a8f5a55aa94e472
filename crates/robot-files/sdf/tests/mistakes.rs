//! Common mistakes, and the findings about them.
#![allow(clippy::disallowed_methods, reason = "one test measures time")]

mod common;

use common::{findings, model};
use expect_test::{Expect, expect};

fn check(content: &str, expected: Expect) {
    expected.assert_eq(&findings(&model(content)));
}

fn link(content: &str) -> String {
    format!("<link name=\"l\">\n{content}\n</link>")
}

#[test]
fn unknown_elements_are_told_with_the_nearest_name() {
    check(
        &link("<colision name=\"c\"/>"),
        expect![[r#"
        warning[unknown-element]: `<colision>` is not known inside `<link>`
         --> test.sdf:2:2
          |
        2 | <colision name="c"/>
          |  ^^^^^^^^
          |
          = note: it is kept, but not used
        help: did you mean `collision`?
          |
        2 | <collision name="c"/>
          |     +
    "#]],
    );
}

#[test]
fn elements_with_a_prefix_are_let_alone() {
    check(&link("<gz:system_priority>1</gz:system_priority>"), expect![[""]]);
}

#[test]
fn unknown_attributes_are_told() {
    check(
        &link("<sensor name=\"s\" typ=\"imu\"/>"),
        expect![[r#"
        error[missing-attribute]: `<sensor>` lacks the attribute `type`
         --> test.sdf:2:1
          |
        2 | <sensor name="s" typ="imu"/>
          | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
          |
          = help: write `<sensor type="...">`
        warning[unknown-attribute]: `<sensor>` has no attribute `typ`
         --> test.sdf:2:18
          |
        2 | <sensor name="s" typ="imu"/>
          |                  ^^^^^^^^^
          |
          = note: it is left out
        help: did you mean `type`?
          |
        2 | <sensor name="s" type="imu"/>
          |                     +
    "#]],
    );
}

#[test]
fn text_that_is_no_number_is_marked_at_the_word() {
    check(
        "<link name=\"l\">\n<pose>0 0 0 ${-pi/2} 0 0</pose>\n</link>",
        expect![[r#"
        error[not-a-number]: `${-pi/2}` in `<pose>` is not a number
         --> test.sdf:2:13
          |
        2 | <pose>0 0 0 ${-pi/2} 0 0</pose>
          |             ^^^^^^^^
          |
          = help: this is a xacro expression: run xacro on the file first
    "#]],
    );
}

#[test]
fn a_comma_in_a_number_is_explained() {
    check(
        &link("<inertial><mass>1,5</mass></inertial>"),
        expect![[r#"
        error[not-a-number]: `1,5` in `<mass>` is not a number
         --> test.sdf:2:17
          |
        2 | <inertial><mass>1,5</mass></inertial>
          |                 ^^^
          |
          = help: separate numbers by spaces and write a decimal point, not a comma
    "#]],
    );
}

#[test]
fn sizes_below_zero_are_refused() {
    check(
        &link(
            "<collision name=\"c\"><geometry>\n<sphere><radius>-1</radius></sphere>\n</geometry></collision>",
        ),
        expect![[r#"
            error[out-of-range]: `<radius>` must be above 0, not -1
             --> test.sdf:3:17
              |
            3 | <sphere><radius>-1</radius></sphere>
              |                 ^^
        "#]],
    );
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    check(
        &link("<inertial><mass>inf</mass></inertial>"),
        expect![[r#"
        error[not-finite]: `<mass>` must be finite, not inf
         --> test.sdf:2:17
          |
        2 | <inertial><mass>inf</mass></inertial>
          |                 ^^^
    "#]],
    );
    check(
        &link("<inertial><mass>nan</mass></inertial>"),
        expect![[r#"
        error[not-finite]: `<mass>` must not be NaN
         --> test.sdf:2:17
          |
        2 | <inertial><mass>nan</mass></inertial>
          |                 ^^^
          |
          = note: the program that wrote this file divided by zero
    "#]],
    );
}

#[test]
fn a_lidar_without_samples_is_refused() {
    check(
        &link(
            "<sensor name=\"s\" type=\"gpu_lidar\"><lidar><scan><horizontal>\n<samples>0</samples>\n\
             </horizontal></scan><range><min>0.1</min><max>10</max></range></lidar></sensor>",
        ),
        expect![[r#"
            error[out-of-range]: a lidar without samples measures nothing
             --> test.sdf:3:10
              |
            3 | <samples>0</samples>
              |          ^
              |
              = note: 1 is assumed
        "#]],
    );
}

#[test]
fn an_impossible_inertia_is_told() {
    check(
        &link(
            "<inertial><mass>1</mass>\n<inertia><ixx>1</ixx><iyy>1</iyy><izz>3</izz></inertia>\n\
             </inertial>",
        ),
        expect![[r#"
            warning[bad-inertia]: the inertia of link `l` breaks the triangle inequality
             --> test.sdf:3:1
              |
            3 | <inertia><ixx>1</ixx><iyy>1</iyy><izz>3</izz></inertia>
              | ^^^^^^^^^
              |
              = note: the sum of any two principal moments must be at least the third
              = help: for a box of mass m: ixx = m/12 (y² + z²), and so on
        "#]],
    );
}

#[test]
fn a_name_that_is_taken_is_told_with_both_places() {
    check(
        "<link name=\"a\"/>\n<joint name=\"j\" type=\"fixed\"><parent>world</parent><child>a</child></joint>\n<link name=\"a\"/>",
        expect![[r#"
            error[duplicate-name]: the name `a` is already used
             --> test.sdf:3:1
              |
            1 | <sdf version="1.9"><model name="m"><link name="a"/>
              |                                    ---------------- by this link
            2 | <joint name="j" type="fixed"><parent>world</parent><child>a</child></joint>
            3 | <link name="a"/></model></sdf>
              | ^^^^^^^^^^^^^^^^
              |
              = note: this link is called `a_1` instead
        "#]],
    );
}

#[test]
fn missing_attributes_are_told() {
    check(
        "<link/>",
        expect![[r#"
        error[missing-attribute]: `<link>` lacks the attribute `name`
         --> test.sdf:1:36
          |
        1 | <sdf version="1.9"><model name="m"><link/></model></sdf>
          |                                    ^^^^^^^
          |
          = help: write `<link name="...">`
    "#]],
    );
}

#[test]
fn an_empty_script_uri_is_forgiven() {
    check(
        &link(
            "<visual name=\"v\"><geometry><empty/></geometry><material><script>\n<uri/>\n\
             <name>Gazebo/Gery</name></script></material></visual>",
        ),
        expect![[r#"
            warning[empty-value]: the `<uri>` of this script is empty
             --> test.sdf:3:1
              |
            3 | <uri/>
              | ^^^^^^
              |
              = note: Gazebo Classic loads this, newer Gazebo refuses the whole file
            hint[unknown-material]: `Gazebo/Gery` is none of Gazebo's built-in materials that are known here
             --> test.sdf:4:7
              |
            4 | <name>Gazebo/Gery</name></script></material></visual>
              |       ^^^^^^^^^^^
              |
            help: did you mean `Gazebo/Grey`?
              |
            4 - <name>Gazebo/Gery</name></script></material></visual>
            4 + <name>Gazebo/Grey</name></script></material></visual>
              |
        "#]],
    );
}

#[test]
fn other_formats_are_recognised() {
    expect![[r#"
        error[not-sdf]: an SDF file starts with `<sdf>`, this one with `<robot>`
         --> test.sdf:1:1
          |
        1 | <robot name="r"/>
          | ^^^^^^^^^^^^^^^^^
          |
          = help: this is a robot description: read it as URDF, or as xacro
    "#]]
    .assert_eq(&findings("<robot name=\"r\"/>"));
    expect![[r#"
        error[not-sdf]: an SDF file starts with `<sdf>`, this one with `<model>`
         --> test.sdf:1:1
          |
        1 | <model name="m"/>
          | ^^^^^^^^^^^^^^^^^
          |
          = help: wrap it in `<sdf version="1.9">...</sdf>`
    "#]]
    .assert_eq(&findings("<model name=\"m\"/>"));
    expect![[r#"
        error[unknown-version]: `2.0` is not a version of SDF
         --> test.sdf:1:15
          |
        1 | <sdf version="2.0"><model name="m"/></sdf>
          |               ^^^
          |
          = note: known are 1.0 to 1.12; 1.12 is assumed
        warning[no-links]: model `m` has no link
         --> test.sdf:1:20
          |
        1 | <sdf version="2.0"><model name="m"/></sdf>
          |                    ^^^^^^^^^^^^^^^^^
          |
          = note: Gazebo refuses a model without links unless it is static
    "#]]
    .assert_eq(&findings("<sdf version=\"2.0\"><model name=\"m\"/></sdf>"));
}

#[test]
fn deep_files_need_no_deep_stack() {
    let nested = |name: &str| {
        let open = format!("<{name} name=\"x\">").repeat(190);
        findings(&format!(
            "<sdf version=\"1.7\"><model name=\"m\"><link name=\"l\"/>{open}{}</model></sdf>",
            format!("</{name}>").repeat(190)
        ))
    };
    assert!(nested("model").contains("too-deep"));
    for name in ["gz:x", "plugin", "unknown", "joint", "link"] {
        nested(name);
    }
}

#[test]
fn a_hundred_thousand_mistakes_take_no_time() {
    let mut content = String::from("<link name=\"l\"/>");
    for index in 0..20_000 {
        content.push_str(&format!("<frame name=\"f{index}\" attached_to=\"g{index}\"/><fram/>"));
    }
    let started = std::time::Instant::now();
    findings(&model(&content));
    assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
}
