//! One check per finding, then the round trip.

use expect_test::{Expect, expect};
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};

use crate::{UrdfRobot, read, write};

/// Reads a text; gives the robot and what was found.
pub(crate) fn load(text: &str) -> (Option<UrdfRobot>, Diagnostics, SourceMap) {
    let mut sources = SourceMap::new();
    let file = sources.add("robot.urdf", text);
    let mut diagnostics = Diagnostics::new();
    let robot = periplus_xml::parse(file, &sources, &mut diagnostics)
        .and_then(|document| read(&document, &mut diagnostics));
    (robot, diagnostics, sources)
}

/// Checks all findings of a text, as a person sees them.
fn check(text: &str, expected: Expect) {
    let (_, diagnostics, sources) = load(text);
    let shown: Vec<String> =
        diagnostics.iter().map(|one| render(one, &sources, RenderStyle::Plain)).collect();
    expected.assert_eq(&shown.join("\n"));
}

/// Checks the codes of all findings of a robot's content.
fn codes(content: &str, expected: &[&str]) {
    let (_, diagnostics, _) = load(&format!("<robot name='r'>{content}</robot>"));
    let codes: Vec<&str> = diagnostics.iter().map(|one| one.code).collect();
    assert_eq!(codes, expected, "{content}");
}

const TWO: &str = "<link name='a'/><link name='b'/>";

#[test]
fn a_small_robot_is_read_without_findings() {
    let (robot, diagnostics, _) = load(
        "<robot name='r'><link name='a'/><link name='b'><inertial><origin xyz='1 2 3'/>\
         <mass value='2'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>\
         </link><joint name='j' type='revolute'><parent link='a'/><child link='b'/>\
         <axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='3' velocity='4'/></joint></robot>",
    );
    assert!(diagnostics.is_empty());
    let robot = robot.unwrap();
    assert_eq!(robot.link("b").unwrap().inertial.as_ref().unwrap().mass_kg, 2.0);
    assert_eq!(robot.joint("j").unwrap().limit.as_ref().unwrap().velocity, 4.0);
}

#[test]
fn raw_xacro_says_what_to_do() {
    check(
        "<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='fixed'>\n\
         <origin rpy='${-pi/2} 0 0'/>\n<parent link='a'/><child link='b'/></joint></robot>",
        expect![[r#"
            error[unexpanded-xacro]: `rpy` of this `origin` is a xacro expression, not 3 numbers separated by spaces
             --> robot.urdf:3:14
              |
            3 | <origin rpy='${-pi/2} 0 0'/>
              |              ^^^^^^^^^^^^ only xacro understands this
              |
              = note: a file whose <robot> declares xmlns:xacro="http://www.ros.org/wiki/xacro" is expanded by `periplus check` without being asked
              = help: run xacro first (`xacro FILE > robot.urdf`), or name the file `.xacro`: then it is expanded here
        "#]],
    );
}

#[test]
fn two_parents_names_both_places() {
    check(
        "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>\n\
         <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\n\
         <joint name='k' type='fixed'><parent link='a'/><child link='c'/></joint>\n\
         <joint name='l' type='fixed'><parent link='c'/><child link='b'/></joint></robot>",
        expect![[r#"
            error[two-parents]: the link `b` is the child of two joints, `j` and `l`
             --> robot.urdf:4:61
              |
            2 | <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>
              |                                                             - it is a child here already
            3 | <joint name='k' type='fixed'><parent link='a'/><child link='c'/></joint>
            4 | <joint name='l' type='fixed'><parent link='c'/><child link='b'/></joint></robot>
              |                                                             ^ left out
              |
              = note: a URDF is a tree; closed loops can be written in SDF
              = help: give the second joint another child link, or remove it
        "#]],
    );
}

#[test]
fn a_cycle_and_the_rest_of_it() {
    check(
        "<robot name='r'><link name='a'/><link name='b'/>\n\
         <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\n\
         <joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
        expect![[r#"
            error[cycle]: the joint `k` closes a loop: `b` is already below `a`
             --> robot.urdf:3:61
              |
            2 | <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>
              |                                                             - `b` is attached here
            3 | <joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>
              |                                                             ^
              |
              = help: a URDF is a tree; remove one of the joints, or turn its parent and child around
        "#]],
    );
}

#[test]
fn two_roots_suggest_a_joint() {
    check(
        "<robot name='r'>\n<link name='base'/>\n<link name='lidar'/>\n</robot>",
        expect![[r#"
            error[two-roots]: the links are not one tree: `base` and `lidar` have no parent joint
             --> robot.urdf:3:1
              |
            2 | <link name='base'/>
              | ------------------- the root
            3 | <link name='lidar'/>
              | ^^^^^^^^^^^^^^^^^^^^ no joint has this link as its child
              |
              = help: add <joint name="lidar_joint" type="fixed"><parent link="base"/><child link="lidar"/></joint>
        "#]],
    );
}

#[test]
fn a_misspelt_link_is_corrected() {
    check(
        "<robot name='r'><link name='base_link'/><link name='wheel'/>\n\
         <joint name='j' type='continuous'><parent link='baselink'/><child link='wheel'/></joint>\
         </robot>",
        expect![[r#"
            error[unknown-link]: the parent of the joint `j` is not a link: `baselink`
             --> robot.urdf:2:49
              |
            2 | <joint name='j' type='continuous'><parent link='baselink'/><child link='wheel'/></joint></robot>
              |                                                 ^^^^^^^^
              |
            help: did you mean `base_link`?
              |
            2 | <joint name='j' type='continuous'><parent link='base_link'/><child link='wheel'/></joint></robot>
              |                                                     +
        "#]],
    );
}

#[test]
fn a_root_that_is_no_robot() {
    check(
        "<sdf version='1.6'/>",
        expect![[r#"
            error[not-urdf]: the root of a URDF is `robot`, and here it is `sdf`
             --> robot.urdf:1:2
              |
            1 | <sdf version='1.6'/>
              |  ^^^
              |
              = help: this looks like SDF; name the file .sdf or .world
        "#]],
    );
}

#[test]
fn every_slip_has_its_code() {
    let joint = |rest: &str| {
        format!("{TWO}<joint name='j' {rest}<parent link='a'/><child link='b'/></joint>")
    };
    codes("", &["no-links"]);
    codes("<link/>", &["missing-attribute"]);
    codes("<link name='a'/><link name='a'/>", &["duplicate-link"]);
    codes("<link name='a'/><lnik name='b'/>", &["unknown-element"]);
    codes("<link nmae='a'/>", &["missing-attribute"]);
    codes(&joint("type='revolute'>"), &["missing-limit"]);
    codes(&joint("type='prismatic'>"), &["missing-limit"]);
    codes(&joint("type='hinge'>"), &["unknown-joint-type"]);
    codes(&joint(">"), &["missing-attribute"]);
    codes(&joint("type='continuous'><axis xyz='0 0 0'/>"), &["zero-axis"]);
    codes(&joint("type='fixed'><axis xyz='0 0 0'/>"), &[]);
    codes(&joint("type='continuous'><axis xyz='0 1'/>"), &["bad-number"]);
    codes(&joint("type='continuous'><axis xyz='0,0,1'/>"), &["bad-number"]);
    codes(&joint("type='continuous'><axis xyz='0 0 inf'/>"), &["bad-number"]);
    codes(&joint("type='continuous'><mimic joint='k'/>"), &["unknown-joint"]);
    codes(&joint("type='continuous'><mimic joint='j'/>"), &["unknown-joint"]);
    codes(&joint("type='continuous'><dynamics/>"), &["missing-attribute"]);
    codes(
        &joint("type='revolute'><limit lower='1' upper='0' effort='1' velocity='1'/>"),
        &["swapped-limits"],
    );
    codes(&joint("type='revolute'><limit lower='0' upper='1'/>"), &["missing-attribute"; 2]);
    codes("<link name='a'/><gazebo reference='b'/>", &["unknown-reference"]);
    codes("<link name='a'/><material name='m'/>", &["empty-material"]);
    codes(
        "<link name='a'/><link name='b'/><joint name='j' type='fixed'/>",
        &["missing-element", "missing-element"],
    );
    codes("<link name='a'><visual/></link>", &["missing-element"]);
    codes("<link name='a'><visual><geometry/></visual></link>", &["missing-element"]);
    let visual = |shape: &str| {
        format!("<link name='a'><visual><geometry>{shape}</geometry></visual></link>")
    };
    codes(&visual("<cone radius='1' length='1'/>"), &["unknown-element"]);
    codes(&visual("<box size='1 1'/>"), &["bad-number"]);
    codes(&visual("<box size='1 1 -1'/>"), &["bad-size"]);
    codes(&visual("<sphere raduis='1'/>"), &["missing-attribute", "unknown-attribute"]);
    codes(&visual("<sphere radius='1'/><sphere radius='2'/>"), &["two-shapes"]);
    codes(&visual("<mesh filename='$(find p)/m.dae'/>"), &["unexpanded-xacro"]);
    codes("<xacro:wheel/><link name='a'/>", &["unexpanded-xacro"]);
    codes(
        "<property name='x' value='1'/><link name='a'/>",
        &["unknown-element", "unexpanded-xacro"],
    );
}

#[test]
fn masses_are_checked() {
    let inertial = |mass: &str, izz: &str| {
        format!(
            "<link name='a'><inertial><mass value='{mass}'/><inertia ixx='1' ixy='0' ixz='0' \
             iyy='1' iyz='0' izz='{izz}'/></inertial></link>"
        )
    };
    codes(&inertial("1", "1"), &[]);
    codes(&inertial("0", "1"), &["zero-mass"]);
    codes(&inertial("-1", "1"), &["negative-mass"]);
    codes(&inertial("1", "9"), &["impossible-inertia"]);
    codes(&inertial("1kg", "1"), &["bad-number", "zero-mass"]);
    codes(
        "<link name='a'><inertial/></link>",
        &["missing-element", "missing-element", "zero-mass"],
    );
}

#[test]
fn a_material_is_found_wherever_it_is_defined() {
    let visual = |material: &str| {
        format!("<visual><geometry><sphere radius='1'/></geometry>{material}</visual>")
    };
    let red = visual("<material name='m'><color rgba='1 0 0 1'/></material>");
    let blue = visual("<material name='m'><color rgba='0 0 1 1'/></material>");
    let named = visual("<material name='m'/>");
    codes(&format!("<link name='a'>{red}{named}</link>"), &[]);
    codes(&format!("<link name='a'>{red}{red}</link>"), &[]);
    codes(&format!("<link name='a'>{red}{blue}</link>"), &["material-redefined"]);
    codes(&format!("<link name='a'>{named}</link>"), &["unknown-material"]);
}

#[test]
fn what_nobody_knows_is_kept() {
    let text = "<robot name='r' xmlns:drake='d'><link name='a' weight='1'><verbose value='1'/>\
                <inertial><mass value='1' unit='kg'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' \
                iyz='0' izz='1'/></inertial></link><drake:thing x='1'/><mujoco><compiler/>\
                </mujoco><transmission name='t'><type>x</type></transmission>\
                <gazebo reference='a' tag='x'><sensor name='s' type='ray'/></gazebo></robot>";
    let (robot, _, _) = load(text);
    let robot = robot.unwrap();
    let again = read(&write(&robot), &mut Diagnostics::new()).unwrap();
    assert_eq!(again, robot);
    let written = periplus_xml::write_document(&write(&robot));
    for kept in ["weight", "verbose", "unit=\"kg\"", "drake:thing", "compiler", "<type>x", "tag"] {
        assert!(written.contains(kept), "{kept} is lost in {written}");
    }
}

#[test]
fn a_blank_after_a_joint_name_made_a_frame_that_nobody_found() {
    codes(
        "<link name='a'/><link name=' b'/>\
         <joint name='j ' type='fixed'><parent link='a'/><child link='b'/></joint>",
        &["blank-in-name", "blank-in-name"],
    );
}
