//! Findings of `check` for the mistakes that the tutorials teach.

mod common;

use expect_test::expect_file;

use common::said_of;

fn check(name: &str) {
    let said = said_of(&format!("tests/broken/{name}"));
    expect_file![format!("broken/{name}.txt")].assert_eq(&said);
}

#[test]
fn an_expression_of_xacro_in_a_plain_urdf() {
    check("raw_expression.urdf");
}

#[test]
fn parameters_of_ros_1_in_a_camera_of_ros_2() {
    check("unread_camera_parameters.urdf");
}

#[test]
fn a_remap_of_launch_files_in_a_plugin() {
    check("remap_in_ros_element.urdf");
}

#[test]
fn a_tag_that_ends_like_a_comment() {
    check("teleop.launch");
}

#[test]
fn a_lidar_in_a_world_without_the_sensors_system() {
    check("silent_lidar.sdf");
}

#[test]
fn a_property_misspelt_in_a_macro() {
    check("misspelt_property.urdf.xacro");
}

#[test]
fn a_slip_in_a_file_that_is_included() {
    check("included_slip/world.sdf");
}
