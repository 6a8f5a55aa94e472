//! Large and hostile robots cost time in proportion to their size.
#![allow(clippy::unwrap_used, reason = "helpers of a test")]

use std::fmt::Write as _;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_scene::{Scene, tf_tree};
use periplus_sdf::{NoIncludes, SdfContext};
use periplus_urdf::{ConversionOptions, from_model, read, to_model, write};

const BODY: &str = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' \
                    izz='1'/></inertial>";

/// Runs all operations on a text; returns the numbers of links of the model and of the tree.
fn all(text: &str) -> (usize, usize) {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let file = sources.add("large.urdf", text);
    let document = periplus_xml::parse(file, &sources, &mut diagnostics).unwrap();
    let robot = read(&document, &mut diagnostics).unwrap();
    let written = write(&robot);
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    let model = to_model(&robot, ConversionOptions::default(), &mut context);
    let tree = tf_tree(&model).len();
    let links = model.links.len();
    let again = from_model(&model, &mut diagnostics);
    let scene = Scene { models: vec![model], ..Scene::default() };
    periplus_sdf::write(&scene, &mut diagnostics);
    assert!(
        written.root.elements().count() >= links && again.is_none_or(|one| !one.links.is_empty())
    );
    (links, tree)
}

/// A robot whose links form a chain of joints of one kind.
fn row(count: usize, kind: &str, body: impl Fn(usize) -> &'static str) -> String {
    let mut text = String::from("<robot name='row'>");
    for index in 0..count {
        let _ = write!(text, "<link name='l{index}'>{}</link>", body(index));
        if index > 0 {
            let above = index - 1;
            let _ = write!(
                text,
                "<joint name='j{index}' type='{kind}'><parent link='l{above}'/>\
                 <child link='l{index}'/></joint>"
            );
        }
    }
    text.push_str("</robot>");
    text
}

const MANY: usize = 2_000;

#[test]
fn a_long_arm() {
    assert_eq!(all(&row(MANY, "continuous", |_| BODY)), (MANY, MANY - 1));
}

#[test]
fn a_long_stack_of_merged_links() {
    assert_eq!(all(&row(MANY, "fixed", |_| BODY)), (1, MANY - 1));
}

#[test]
fn a_long_row_without_mass() {
    let first = |index| if index == 0 { BODY } else { "" };
    assert_eq!(all(&row(MANY, "continuous", first)), (1, MANY - 1));
}

#[test]
fn many_wrong_names() {
    let mut text = row(MANY, "fixed", |_| BODY).replace("</robot>", "");
    for index in 0..MANY {
        let _ = write!(
            text,
            "<joint name='w{index}' type='continuous'><parent link='nobody{index}'/>\
             <child link='l{index}x'/><mimic joint='k{index}'/></joint>\
             <gazebo reference='m{index}'/>"
        );
    }
    text.push_str("</robot>");
    assert_eq!(all(&text).0, 1);
}
