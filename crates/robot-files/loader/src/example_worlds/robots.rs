//! Vehicles and mechanisms of the example worlds.

use std::fmt::Write as _;

use super::parts::{DARK, Rgb, YELLOW, ball, cuboid, cylinder};

/// Radius of the vehicles' wheels [m].
const WHEEL_RADIUS_M: f64 = 0.15;

/// Distance between left and right wheels [m].
const WHEEL_SEPARATION_M: f64 = 0.6;

/// Distance between front and rear axle of vehicles with four wheels [m].
const WHEEL_BASE_M: f64 = 0.7;

/// Frictionless surface: a caster is a ball without friction.
const SLIPPERY: &str = "<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>";

fn wheel(name: &str, x_m: f64, y_m: f64, surface: &str) -> String {
    format!(
        "<link name=\"{name}\"><pose>{x_m} {y_m} {WHEEL_RADIUS_M} -1.5707963267948966 0 0</pose>{}\
         </link>",
        cylinder(WHEEL_RADIUS_M, 0.06).on_link(1.0, "", DARK, surface)
    )
}

/// Revolute joint about the child's z: the axle of a wheel and the kingpin of a steered one.
fn hinge(name: &str, parent: &str, child: &str, limit_rad: Option<f64>) -> String {
    let limit = limit_rad.map_or(String::new(), |limit| {
        format!("<limit><lower>-{limit}</lower><upper>{limit}</upper></limit>")
    });
    format!(
        "<joint name=\"{name}\" type=\"revolute\"><parent>{parent}</parent><child>{child}</child>\
         <axis><xyz>0 0 1</xyz>{limit}</axis></joint>"
    )
}

fn chassis(colour: Rgb, sensors: &str) -> String {
    format!(
        "<link name=\"chassis\"><pose>0 0 0.25 0 0 0</pose>{}{sensors}</link>",
        cuboid([1.0, 0.5, 0.2]).on_link(8.0, "", colour, "")
    )
}

/// Two driven wheels and a caster, with the given plugins.
pub(super) fn two_wheels(
    name: &str,
    pose: &str,
    colour: Rgb,
    sensors: &str,
    plugins: &str,
) -> String {
    let half = WHEEL_SEPARATION_M / 2.0;
    [
        format!("<model name=\"{name}\"><pose>{pose}</pose>"),
        chassis(colour, sensors),
        wheel("left_wheel", 0.2, half, ""),
        wheel("right_wheel", 0.2, -half, ""),
        format!(
            "<link name=\"caster\"><pose>-0.35 0 0.075 0 0 0</pose>{}</link>",
            ball(0.075).on_link(0.5, "", DARK, SLIPPERY)
        ),
        hinge("left_wheel_joint", "chassis", "left_wheel", None),
        hinge("right_wheel_joint", "chassis", "right_wheel", None),
        "<joint name=\"caster_wheel\" type=\"ball\"><parent>chassis</parent><child>caster</child>\
         </joint>"
            .to_owned(),
        format!("{plugins}</model>\n"),
    ]
    .concat()
}

pub(super) fn diff_drive() -> String {
    format!(
        "<plugin filename=\"gz-sim-diff-drive-system\" name=\"gz::sim::systems::DiffDrive\">\
         <left_joint>left_wheel_joint</left_joint><right_joint>right_wheel_joint</right_joint>\
         <wheel_separation>{WHEEL_SEPARATION_M}</wheel_separation>\
         <wheel_radius>{WHEEL_RADIUS_M}</wheel_radius>\
         <odom_publish_frequency>20</odom_publish_frequency></plugin>"
    )
}

pub(super) fn velocity_control() -> String {
    "<plugin filename=\"gz-sim-velocity-control-system\" \
     name=\"gz::sim::systems::VelocityControl\"/>"
        .to_owned()
}

pub(super) fn battery() -> String {
    "<plugin filename=\"gz-sim-linearbatteryplugin-system\" \
     name=\"gz::sim::systems::LinearBatteryPlugin\"><battery_name>linear_battery</battery_name>\
     <voltage>12.6</voltage><open_circuit_voltage_constant_coef>12.6\
     </open_circuit_voltage_constant_coef><open_circuit_voltage_linear_coef>-3.1\
     </open_circuit_voltage_linear_coef><initial_charge>1.2</initial_charge>\
     <capacity>1.2</capacity><resistance>0.06</resistance>\
     <smooth_current_tau>2</smooth_current_tau><power_load>6</power_load></plugin>"
        .to_owned()
}

/// Positions of four wheels: front or rear, left or right, x and y [m].
fn four_places() -> [(&'static str, &'static str, f64, f64); 4] {
    let (x, y) = (WHEEL_BASE_M / 2.0, WHEEL_SEPARATION_M / 2.0);
    [
        ("front", "left", x, y),
        ("front", "right", x, -y),
        ("rear", "left", -x, y),
        ("rear", "right", -x, -y),
    ]
}

/// Four mecanum wheels.
pub(super) fn mecanum(name: &str, colour: Rgb) -> String {
    let mut text = format!("<model name=\"{name}\">{}", chassis(colour, ""));
    for (end, side, x_m, y_m) in four_places() {
        // The rollers are at 45 degrees: along front left to rear right, and the mirror image.
        let along = if (x_m > 0.0) == (y_m > 0.0) { "1 -1 0" } else { "1 1 0" };
        let surface = format!(
            "<surface><friction><ode><mu>1</mu><mu2>0</mu2><fdir1 gz:expressed_in=\"chassis\">\
             {along}</fdir1></ode></friction></surface>"
        );
        text.push_str(&wheel(&format!("{end}_{side}_wheel"), x_m, y_m, &surface));
        let joint = format!("{end}_{side}_wheel_joint");
        text.push_str(&hinge(&joint, "chassis", &format!("{end}_{side}_wheel"), None));
    }
    let _ = writeln!(
        text,
        "<plugin filename=\"gz-sim-mecanum-drive-system\" name=\"gz::sim::systems::MecanumDrive\">\
         <front_left_joint>front_left_wheel_joint</front_left_joint>\
         <front_right_joint>front_right_wheel_joint</front_right_joint>\
         <back_left_joint>rear_left_wheel_joint</back_left_joint>\
         <back_right_joint>rear_right_wheel_joint</back_right_joint>\
         <wheel_separation>{WHEEL_SEPARATION_M}</wheel_separation>\
         <wheelbase>{WHEEL_BASE_M}</wheelbase><wheel_radius>{WHEEL_RADIUS_M}</wheel_radius>\
         </plugin></model>"
    );
    text
}

/// Car with steered front wheels.
pub(super) fn car(name: &str, colour: Rgb) -> String {
    let mut text = format!("<model name=\"{name}\">{}", chassis(colour, ""));
    for (end, side, x_m, y_m) in four_places() {
        let wheel_name = format!("{end}_{side}_wheel");
        text.push_str(&wheel(&wheel_name, x_m, y_m, ""));
        let parent = if end == "front" {
            let upright = format!("{end}_{side}_upright");
            let _ = write!(
                text,
                "<link name=\"{upright}\"><pose>{x_m} {y_m} {WHEEL_RADIUS_M} 0 0 0</pose>\
                 <inertial><mass>0.5</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz>\
                 </inertia></inertial></link>"
            );
            let steering = format!("{end}_{side}_wheel_steering_joint");
            text.push_str(&hinge(&steering, "chassis", &upright, Some(0.6)));
            upright
        } else {
            "chassis".to_owned()
        };
        text.push_str(&hinge(&format!("{wheel_name}_joint"), &parent, &wheel_name, None));
    }
    let _ = writeln!(
        text,
        "<plugin filename=\"gz-sim-ackermann-steering-system\" \
         name=\"gz::sim::systems::AckermannSteering\">\
         <left_joint>front_left_wheel_joint</left_joint>\
         <left_joint>rear_left_wheel_joint</left_joint>\
         <right_joint>front_right_wheel_joint</right_joint>\
         <right_joint>rear_right_wheel_joint</right_joint>\
         <left_steering_joint>front_left_wheel_steering_joint</left_steering_joint>\
         <right_steering_joint>front_right_wheel_steering_joint</right_steering_joint>\
         <kingpin_width>{WHEEL_SEPARATION_M}</kingpin_width><steering_limit>0.5</steering_limit>\
         <wheel_base>{WHEEL_BASE_M}</wheel_base>\
         <wheel_separation>{WHEEL_SEPARATION_M}</wheel_separation>\
         <wheel_radius>{WHEEL_RADIUS_M}</wheel_radius></plugin></model>"
    );
    text
}

/// Arm that rotates about a vertical axis, with a plugin for its joint `j1`.
pub(super) fn rotor(name: &str, pose: &str, plugin: &str) -> String {
    format!(
        "<model name=\"{name}\"><pose>{pose}</pose><link name=\"base_link\">{}</link>\
         <link name=\"rotor\"><pose>0 0 0.55 0 0 0</pose>{}</link>\
         <joint name=\"world_fixed\" type=\"fixed\"><parent>world</parent><child>base_link</child>\
         </joint>{}{plugin}</model>\n",
        cylinder(0.1, 0.5).on_link(2.0, "0 0 0.25 0 0 0", DARK, ""),
        cuboid([0.8, 0.1, 0.05]).on_link(0.4, "", YELLOW, ""),
        hinge("j1", "base_link", "rotor", None)
    )
}

/// Double pendulum on a stand.
pub(super) fn pendulum(name: &str, plugin: &str) -> String {
    let rod = |name: &str, z_m: f64| {
        format!(
            "<link name=\"{name}\"><pose>0.3 0 {z_m} -1.5707963267948966 0 0</pose>{}</link>",
            cylinder(0.05, 0.8).on_link(1.0, "0 0.4 0 1.5707963267948966 0 0", YELLOW, "")
        )
    };
    format!(
        "<model name=\"{name}\"><link name=\"base\">{}</link>{}{}{}{}\
         <joint name=\"stand\" type=\"fixed\"><parent>world</parent><child>base</child></joint>\
         {plugin}</model>\n",
        cuboid([0.2, 0.2, 2.2]).on_link(50.0, "0 0 1.1 0 0 0", DARK, ""),
        rod("upper_link", 2.0),
        rod("lower_link", 1.2),
        hinge("upper_joint", "base", "upper_link", None),
        hinge("lower_joint", "upper_link", "lower_link", None),
    )
}
