//! Names and the tree.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_xml::Element;

use crate::robot::{UrdfJoint, UrdfRobot};
use crate::tree::Tree;

/// Maximum number of names compared with misspelt ones, all together: a hostile file must not cost
/// quadratic time.
pub(super) const MAX_COMPARED_NAMES: usize = 100_000;

/// No two links and no two joints may share a name; a link and a joint may.
pub(super) fn unique_names(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    let links = robot.links.iter().map(|link| (&*link.name, link.origin));
    unique("link", "duplicate-link", links, diagnostics);
    let joints = robot.joints.iter().map(|joint| (&*joint.name, joint.origin));
    unique("joint", "duplicate-joint", joints, diagnostics);
    let materials = robot.materials.iter().map(|material| (&*material.name, material.origin));
    unique("material", "duplicate-material", materials, diagnostics);
}

fn unique<'a>(
    kind: &str,
    code: &'static str,
    names: impl Iterator<Item = (&'a str, Origin)>,
    diagnostics: &mut Diagnostics,
) {
    let mut known: BTreeMap<&str, Origin> = BTreeMap::new();
    for (name, origin) in names {
        match known.get(name) {
            Some(first) => diagnostics.push(
                Diagnostic::error(code, format!("there are two {kind}s named `{name}`"))
                    .at(origin)
                    .label("left out")
                    .related(*first, "the first")
                    .help(format!("give every {kind} a unique name")),
            ),
            None => {
                known.insert(name, origin);
            }
        }
    }
}

/// The joints must make one tree of the links.
pub(super) fn one_tree(robot: &UrdfRobot, root: &Element, diagnostics: &mut Diagnostics) {
    if robot.links.is_empty() {
        // The reader has reported links that could not be read.
        if root.child("link").is_none() {
            diagnostics.push(
                Diagnostic::error("no-links", "the robot has no links")
                    .at(root.origin)
                    .help("write at least <link name=\"base_link\"/>"),
            );
        }
        return;
    }
    let tree = Tree::new(robot);
    let mut above: BTreeMap<&str, &UrdfJoint> = BTreeMap::new();
    let mut suggestions = MAX_COMPARED_NAMES;
    let mut complete = true;
    for (place, joint) in robot.joints.iter().enumerate() {
        let known = missing_ends(&tree, joint, &mut suggestions, diagnostics);
        complete &= known;
        if !known || tree.child[place].is_some() {
            above.entry(&joint.child).or_insert(joint);
            continue;
        }
        match above.get(&*joint.child) {
            Some(first) => diagnostics.push(two_parents(joint, first)),
            None => diagnostics.push(cycle(robot, &tree, joint)),
        }
    }
    if let [first, others @ ..] = &*tree.roots
        && !others.is_empty()
        // A joint that is missing because of a wrong `<parent>` or `<child>` explains the second root.
        && complete
    {
        diagnostics.push(two_roots(robot, *first, others));
    }
}

/// Reports an error for each end of a joint that is not a link. Returns true if both are links.
fn missing_ends(
    tree: &Tree<'_>,
    joint: &UrdfJoint,
    suggestions: &mut usize,
    diagnostics: &mut Diagnostics,
) -> bool {
    let ends = [
        ("parent", &joint.parent, joint.parent_origin),
        ("child", &joint.child, joint.child_origin),
    ];
    let mut known = true;
    for (end, name, origin) in ends {
        if tree.index.contains_key(&**name) {
            continue;
        }
        known = false;
        // A missing name has been reported.
        if !name.is_empty() {
            let names = tree.index.keys().copied().take(*suggestions);
            *suggestions = suggestions.saturating_sub(tree.index.len());
            let error = Diagnostic::error(
                "unknown-link",
                format!("the {end} of the joint `{}` is not a link: `{name}`", joint.name),
            )
            .at(origin)
            .did_you_mean(origin, name, names);
            diagnostics.push(if error.replacement.is_none() {
                error.help(format!("write <link name=\"{name}\"/>, or correct the name"))
            } else {
                error
            });
        }
    }
    known
}

fn two_parents(joint: &UrdfJoint, first: &UrdfJoint) -> Diagnostic {
    Diagnostic::error(
        "two-parents",
        format!(
            "the link `{}` is the child of two joints, `{}` and `{}`",
            joint.child, first.name, joint.name
        ),
    )
    .at(joint.child_origin)
    .label("left out")
    .related(first.child_origin, "it is a child here already")
    .note("a URDF is a tree; closed loops can be written in SDF")
    .help("give the second joint another child link, or remove it")
}

fn cycle(robot: &UrdfRobot, tree: &Tree<'_>, joint: &UrdfJoint) -> Diagnostic {
    let error = Diagnostic::error(
        "cycle",
        if joint.parent == joint.child {
            format!("the joint `{}` attaches the link `{}` to itself", joint.name, joint.child)
        } else {
            format!(
                "the joint `{}` closes a loop: `{}` is already below `{}`",
                joint.name, joint.parent, joint.child
            )
        },
    )
    .at(joint.child_origin)
    .help("a URDF is a tree; remove one of the joints, or turn its parent and child around");
    // Joint that attaches the parent somewhere below the child.
    let above = tree.index.get(&*joint.parent).and_then(|&link| tree.joint_above[link]);
    match above {
        Some(above) => error.related(
            robot.joints[above].child_origin,
            format!("`{}` is attached here", joint.parent),
        ),
        None => error,
    }
}

fn two_roots(robot: &UrdfRobot, first: usize, others: &[usize]) -> Diagnostic {
    let name = |link: usize| &*robot.links[link].name;
    let list: Vec<String> =
        others.iter().take(4).map(|&other| format!("`{}`", name(other))).collect();
    let more = if others.len() > 4 { ", ..." } else { "" };
    let mut error = Diagnostic::error(
        "two-roots",
        format!(
            "the links are not one tree: `{}` and {}{more} have no parent joint",
            name(first),
            list.join(", ")
        ),
    )
    .at(robot.links[others[0]].origin)
    .label("no joint has this link as its child")
    .related(robot.links[first].origin, "the root");
    for &other in others.iter().skip(1).take(3) {
        error = error.related(robot.links[other].origin, "nor this one");
    }
    error.help(format!(
        "add <joint name=\"{0}_joint\" type=\"fixed\"><parent link=\"{1}\"/><child link=\"{0}\"/>\
         </joint>",
        name(others[0]),
        name(first)
    ))
}
