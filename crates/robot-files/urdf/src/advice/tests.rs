//! First robots, each with one mistake.

use super::advise;
use crate::read::tests::load;
use periplus_diagnostics::Diagnostics;

/// The findings about a robot's content, as `code: message; help`.
fn advice(content: &str) -> Vec<String> {
    let (robot, ..) = load(&format!("<robot name='r'>{content}</robot>"));
    let mut diagnostics = Diagnostics::new();
    advise(&robot.expect("a robot"), &mut diagnostics);
    let shown = diagnostics.iter().map(|one| {
        let help = one.help.first().cloned().unwrap_or_default();
        format!("{}: {}; {help}", one.code, one.message)
    });
    shown.collect()
}

fn check(content: &str, expected: &[&str]) {
    let found = advice(content);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.contains(expected), "{found} lacks {expected}");
    }
}

const MASS: &str = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' \
                    izz='1'/></inertial>";

/// A body with its lowest face at z 0.05 and two wheels of radius 0.1 on the axle `x = 0`.
fn rover(more: &str, body_x_m: f64) -> String {
    let wheel = |name: &str, y: f64| {
        format!(
            "<link name='{name}'>{MASS}<collision><origin rpy='1.5707963 0 0'/><geometry>\
             <cylinder radius='0.1' length='0.04'/></geometry></collision></link>\
             <joint name='{name}_joint' type='continuous'><parent link='base'/><child \
             link='{name}'/><origin xyz='0 {y} 0.1'/><axis xyz='0 1 0'/></joint>"
        )
    };
    format!(
        "<link name='base'>{MASS}<collision><origin xyz='{body_x_m} 0 0.1'/><geometry>\
         <box size='0.3 0.2 0.1'/></geometry></collision></link>{}{}{more}",
        wheel("left", 0.15),
        wheel("right", -0.15)
    )
}

#[test]
fn a_robot_that_can_only_be_seen() {
    let seen = "<visual><geometry><box size='1 1 1'/></geometry></visual>";
    check(&format!("<link name='a'>{MASS}{seen}</link>"), &["no-collision: no link"]);
    check(&format!("<link name='a'>{seen}</link>"), &[]);
    let touched = seen.replace("visual", "collision");
    check(&format!("<link name='a'>{MASS}{seen}{touched}</link>"), &[]);
}

#[test]
fn a_joint_that_turns_about_x_by_default() {
    let joint = |kind: &str, rpy: &str, axis: &str| {
        format!(
            "<link name='a'/><link name='w'><visual><origin rpy='{rpy}'/><geometry><cylinder \
             radius='0.1' length='0.04'/></geometry></visual></link><joint name='j' type='{kind}'>\
             <parent link='a'/><child link='w'/><limit lower='0' upper='1' effort='1' velocity='1'/>\
             {axis}</joint>"
        )
    };
    check(&joint("continuous", "1.5708 0 0", ""), &["write <axis xyz=\"0 1 0\"/>: the cylinder"]);
    check(&joint("revolute", "0 0 0", ""), &["write <axis xyz=\"0 0 1\"/>: the cylinder"]);
    check(&joint("prismatic", "0 0 0", ""), &["slides along the x axis"]);
    check(&joint("continuous", "0 1.5708 0", ""), &[]);
    check(&joint("continuous", "1.5708 0 0", "<axis xyz='0 1 0'/>"), &[]);
    check(&joint("fixed", "0 0 0", ""), &[]);
}

#[test]
fn two_wheels_without_a_caster_tip_over() {
    check(
        &rover("", 0.05),
        &[
            "unstable: the robot stands on `left` and `right` alone, so it tips over; add a caster: \
           a link on a fixed joint with a <sphere> as <collision> whose lowest point is at z 0 of \
           `base`",
        ],
    );
}

#[test]
fn a_caster_on_the_right_side_holds_it() {
    let caster = |x: f64| {
        format!(
            "<link name='caster'><collision><geometry><sphere radius='0.02'/></geometry>\
             </collision></link><joint name='c' type='fixed'><parent link='base'/><child \
             link='caster'/><origin xyz='{x} 0 0.02'/></joint>"
        )
    };
    check(&rover(&caster(0.12), 0.05), &[]);
    // Behind the axle it holds nothing, but then the caster is what the robot stands on as well,
    // and only wheels are judged.
    check(&rover(&caster(-0.12), 0.05), &[]);
}

#[test]
fn three_wheels_and_a_mesh_are_no_finding() {
    let mesh = "<link name='m'><collision><geometry><mesh filename='a.stl'/></geometry>\
                </collision></link><joint name='c' type='fixed'><parent link='base'/><child \
                link='m'/></joint>";
    check(&rover(mesh, 0.05), &[]);
    let front = "<link name='front'>MASS<collision><geometry><sphere radius='0.1'/></geometry>\
                 </collision></link><joint name='c' type='continuous'><parent link='base'/><child \
                 link='front'/><origin xyz='0.3 0 0.1'/><axis xyz='0 1 0'/></joint>";
    check(&rover(&front.replace("MASS", MASS), 0.05), &[]);
}

#[test]
fn the_advised_mass_fits_the_size_of_the_link() {
    let (robot, ..) = load(
        "<robot name='r'><link name='base'><visual><origin xyz='0 0 0.1'/><geometry>\
         <box size='0.4 0.3 0.1'/></geometry></visual></link><link name='mark'/></robot>",
    );
    let robot = robot.expect("a robot");
    // 0.012 m³ of 300 kg/m³; ixx = 3.6/12 (0.3² + 0.1²).
    let base = super::mass::advised(&robot.links[0]);
    assert!(
        base.contains(
            "<inertial><origin xyz=\"0 0 0.1\" rpy=\"0 0 0\"/><mass value=\"3.6\"/><inertia \
             ixx=\"0.03\" ixy=\"0\" ixz=\"0\" iyy=\"0.051\" iyz=\"0\" izz=\"0.075\"/></inertial>"
        ),
        "{base}"
    );
    assert!(super::mass::advised(&robot.links[1]).contains("0.001 kg"));
}
