//! Export to URDF, and the errors about data that URDF cannot express.

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_scene::Model;
use periplus_sdf::{NoIncludes, SdfContext};

use crate::{JointType, UrdfRobot, from_model};

fn model(content: &str) -> Model {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let text = format!("<sdf version='1.9'><model name='m'>{content}</model></sdf>");
    let file = sources.add("m.sdf", text);
    let document = periplus_xml::parse(file, &sources, &mut diagnostics).unwrap();
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    let scene = periplus_sdf::read_document(&document, &mut context);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    scene.models.into_iter().next().unwrap()
}

fn export(content: &str) -> (Option<UrdfRobot>, Vec<String>) {
    let mut diagnostics = Diagnostics::new();
    let robot = from_model(&model(content), &mut diagnostics);
    for one in diagnostics.iter() {
        assert!(one.span.is_some(), "{one:?} has no place");
    }
    let findings = diagnostics.iter().map(|one| format!("{}: {}", one.code, one.message));
    (robot, findings.collect())
}

/// Checks that a model is not a URDF, and why.
fn refused(content: &str, expected: &str) {
    let (robot, findings) = export(content);
    assert_eq!(robot, None, "{content}");
    assert_eq!(findings, [expected], "{content}");
}

const TWO: &str = "<link name='a'/><link name='b'><pose>1 0 0 0 0 0</pose></link>";

fn joint(kind: &str, parent: &str, child: &str) -> String {
    format!(
        "<joint name='{parent}_{child}' type='{kind}'><parent>{parent}</parent>\
         <child>{child}</child><axis><xyz>0 0 1</xyz></axis></joint>"
    )
}

#[test]
fn models_that_are_no_tree_of_urdf_joints() {
    refused(
        &format!("{TWO}{}", joint("ball", "a", "b")),
        "not-in-urdf: a URDF has no ball joints, and `a_b` is one",
    );
    refused(TWO, "not-in-urdf: a URDF is one tree, and the link `b` has no parent joint");
    refused(
        &format!(
            "{TWO}<link name='c'/>{}{}{}",
            joint("revolute", "a", "b"),
            joint("revolute", "a", "c"),
            joint("revolute", "b", "c")
        ),
        "not-in-urdf: a URDF is a tree, and the joint `b_c` closes a loop at `c`",
    );
    refused(
        "<link name='a'/><model name='arm'><link name='b'/></model>",
        "not-in-urdf: a URDF has no models in it, and here is `arm`",
    );
}

#[test]
fn a_hinge_becomes_a_continuous_joint_and_a_fixed_one_is_preserved() {
    let (robot, findings) = export(&format!(
        "{TWO}<link name='c'/>{}{}",
        joint("revolute", "a", "b"),
        joint("fixed", "a", "c")
    ));
    assert_eq!(findings, [""; 0]);
    let robot = robot.unwrap();
    let turning = robot.joint("a_b").unwrap();
    assert_eq!((turning.kind, &turning.limit), (JointType::Continuous, &None));
    assert_eq!(turning.parent_from_joint.xyz_m, [1.0, 0.0, 0.0]);
    let block = robot.gazebo.iter().find(|block| block.reference.as_deref() == Some("a_c"));
    assert_eq!(block.unwrap().content[0].name, "preserveFixedJoint");
}

#[test]
fn the_world_becomes_the_root() {
    let (robot, findings) = export(&format!("<link name='a'/>{}", joint("fixed", "world", "a")));
    assert_eq!(findings, [""; 0]);
    let robot = robot.unwrap();
    assert_eq!(robot.links[0].name, "world");
    assert_eq!(robot.joint("world_a").unwrap().parent, "world");
}

#[test]
fn a_link_moves_to_its_joint_with_all_that_is_on_it() {
    let (robot, findings) = export(
        "<link name='a'/><link name='b'><pose>0 0 1 0 0 0</pose><collision name='c'>\
         <geometry><sphere><radius>1</radius></sphere></geometry></collision></link>\
         <joint name='j' type='revolute'><pose>0 0 -1 0 0 0</pose><parent>a</parent>\
         <child>b</child><axis><xyz>0 1 0</xyz></axis></joint>",
    );
    assert_eq!(findings, ["frame-moved: the frame of the link `b` moves to its joint, `j`"]);
    let robot = robot.unwrap();
    assert_eq!(robot.joint("j").unwrap().parent_from_joint.xyz_m, [0.0; 3]);
    let link = robot.link("b").unwrap();
    assert_eq!(link.collisions[0].link_from_collision.xyz_m, [0.0, 0.0, 1.0]);
    assert_eq!(link.inertial.as_ref().unwrap().link_from_inertial.xyz_m, [0.0, 0.0, 1.0]);
}

#[test]
fn frames_become_links_and_sensors_go_into_blocks() {
    let (robot, findings) = export(
        "<link name='a'><gravity>false</gravity><sensor name='s' type='imu'>\
         <update_rate>5</update_rate></sensor></link>\
         <frame name='mark' attached_to='a'><pose>0 1 0 0 0 0</pose></frame>\
         <plugin name='p' filename='libp.so'><x>1</x></plugin>",
    );
    assert_eq!(findings, [""; 0]);
    let robot = robot.unwrap();
    let mark = robot.joint("mark_joint").unwrap();
    assert_eq!((&*mark.parent, &*mark.child, mark.kind), ("a", "mark", JointType::Fixed));
    assert_eq!(mark.parent_from_joint.xyz_m, [0.0, 1.0, 0.0]);
    let blocks: Vec<(Option<&str>, Vec<&str>)> = robot
        .gazebo
        .iter()
        .map(|block| {
            let names = block.content.iter().map(|part| &*part.name);
            (block.reference.as_deref(), names.collect())
        })
        .collect();
    assert_eq!(blocks, [(Some("a"), vec!["gravity", "sensor"]), (None, vec!["plugin"])]);
}

#[test]
fn shapes_that_urdf_lacks_are_lost_aloud() {
    let (robot, findings) = export(
        "<link name='a'><visual name='v'><geometry><plane/></geometry></visual>\
         <visual name='w'><geometry><sphere><radius>1</radius></sphere></geometry></visual></link>",
    );
    assert_eq!(findings, ["not-in-urdf: URDF has no plane, and `v` is one"]);
    assert_eq!(robot.unwrap().links[0].visuals.len(), 1);
}
