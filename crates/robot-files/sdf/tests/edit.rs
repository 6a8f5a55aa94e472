//! Edits of a world's text.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use periplus_diagnostics::{Diagnostics, Origin, SourceMap};
use periplus_geometry::{Pose, Rpy};
use periplus_sdf::{WorldEdit, WorldEditError, edit_world};
use periplus_xml::Element;

const WORLD: &str = "<?xml version='1.0'?>
<sdf version='1.9'>
  <!-- my  world -->
  <world name='w'>
    <model name='a'><pose>1 2 0  0 0 0</pose> <static>true</static></model>

    <!-- the second -->
    <model name='b'>
      <link name='link'/>
    </model>
    <include><uri>model://sun</uri></include>
    <model name='c'><pose relative_to='b'>0 1 0 0 0 0</pose></model>
    <light name='d' type='point'><pose degrees='true'>0 0 1 0 0 90</pose></light>
  </world>
</sdf>
";

/// Returns the origin of a child of the world, by its position among all of them.
fn origin(text: &str, index: usize) -> Origin {
    let mut sources = SourceMap::new();
    let file = sources.add("w", text);
    let document = periplus_xml::parse(file, &sources, &mut Diagnostics::new()).unwrap();
    document.root.child("world").unwrap().elements().nth(index).unwrap().origin
}

fn check(edits: &[WorldEdit], from: &str, to: &str) {
    let expected = WORLD.replacen(from, to, 1);
    assert_ne!(expected, WORLD);
    assert_eq!(edit_world(WORLD, edits).unwrap(), expected);
}

fn moved(index: usize, from: Pose, to: Pose) -> WorldEdit {
    WorldEdit::Move { origin: origin(WORLD, index), from, to }
}

fn turned(x: f64, y: f64, z: f64, yaw: f64) -> Pose {
    Pose::from_xyz_rpy([x, y, z], Rpy { roll: 0.0, pitch: 0.0, yaw })
}

#[test]
fn a_move_changes_the_numbers_that_differ() {
    let from = Pose::from_xyz(1.0, 2.0, 0.0);
    check(&[moved(0, from, Pose::from_xyz(1.5, 2.0, 0.0))], "1 2 0  0 0 0", "1.5 2 0  0 0 0");
    check(&[moved(0, from, turned(1.0, 2.0, 0.0, 0.5))], "0  0 0 0", "0  0 0 0.5");
}

#[test]
fn a_missing_pose_becomes_the_first_child() {
    check(
        &[moved(1, Pose::IDENTITY, Pose::from_xyz(0.0, 0.0, 3.0))],
        "<model name='b'>",
        "<model name='b'>\n      <pose>0 0 3 0 0 0</pose>",
    );
    check(
        &[moved(2, Pose::IDENTITY, Pose::from_xyz(0.0, 0.0, 3.0))],
        "<include>",
        "<include><pose>0 0 3 0 0 0</pose>",
    );
}

#[test]
fn a_relative_pose_stays_relative() {
    // `b` is at the origin and turned by 90 degrees: its y is -x of the world.
    let b = turned(0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2);
    let from = b * Pose::from_xyz(0.0, 1.0, 0.0);
    let to = Pose { translation: from.translation * 2.0, ..from };
    check(&[moved(3, from, to)], ">0 1 0 0 0 0<", ">0 2 0 0 0 0<");
    let error = edit_world(WORLD, &[moved(3, from, to), moved(1, b, to)]).unwrap_err();
    assert_eq!(error, WorldEditError::RelativePose { frame: "b".into() });
}

#[test]
fn degrees_stay_degrees() {
    let from = turned(0.0, 0.0, 1.0, std::f64::consts::FRAC_PI_2);
    let to = turned(0.0, 0.0, 1.0, std::f64::consts::FRAC_PI_4);
    check(&[moved(4, from, to)], "0 0 90", "0 0 45");
}

#[test]
fn a_removed_element_takes_its_lines_along() {
    let remove = |index| WorldEdit::Remove { origin: origin(WORLD, index) };
    let b = "    <model name='b'>\n      <link name='link'/>\n    </model>\n";
    check(&[remove(1)], b, "");
    check(&[remove(2)], "    <include><uri>model://sun</uri></include>\n", "");
    let one_line =
        "<sdf><world name='w'><model name='a'><x><!-- </model> --></x></model> </world></sdf>";
    let remove = WorldEdit::Remove { origin: origin(one_line, 0) };
    assert_eq!(edit_world(one_line, &[remove]).unwrap(), "<sdf><world name='w'> </world></sdf>");
}

#[test]
fn a_renamed_element_keeps_its_content() {
    let rename = |index| WorldEdit::Rename { origin: origin(WORLD, index), name: "n<".into() };
    check(&[rename(0)], "'a'", "'n&lt;'");
    check(&[rename(2)], "<include>", "<include><name>n&lt;</name>");
}

#[test]
fn an_inserted_element_is_the_last_one() {
    let element = Element::new("model")
        .with_attribute("name", "n")
        .with_child(Element::new("static").with_text("true"));
    let lines = "    <model name=\"n\">\n      <static>true</static>\n    </model>\n  </world>";
    check(&[WorldEdit::Insert(element)], "  </world>", lines);
    let short = "<sdf><world name='w'></world></sdf>";
    let inserted = edit_world(short, &[WorldEdit::Insert(Element::new("model"))]).unwrap();
    assert_eq!(inserted, "<sdf><world name='w'>\n  <model/>\n</world></sdf>");
}

#[test]
fn line_breaks_of_windows_stay() {
    let world = WORLD.replace('\n', "\r\n");
    let inserted = edit_world(&world, &[WorldEdit::Insert(Element::new("model"))]).unwrap();
    assert_eq!(inserted, world.replace("  </world>", "    <model/>\r\n  </world>"));
}

#[test]
fn an_element_of_another_file_is_refused() {
    let remove = WorldEdit::Remove { origin: Origin::default() };
    assert_eq!(edit_world(WORLD, &[remove]), Err(WorldEditError::NotInText));
    assert_eq!(edit_world("<sdf/>", &[]), Err(WorldEditError::NoWorld));
}
