//! Parameters from files: those of ROS 2 (`slam_toolbox: ros__parameters:`), and those of ROS 1.

use periplus_diagnostics::{Diagnostics, Origin};
use periplus_params::{Given, Values};
use periplus_slam::{Method, tables};
use periplus_yaml::{Node, Value};

use crate::Program;

/// Namespaces around a node nest no deeper.
const DEEPEST: usize = 4;

/// Reads a file for a mapper: for the program that is asked for, or the one that the file is for by
/// the names of its nodes and parameters. `slam_toolbox: ros__parameters:`, `/**:` and, in files of ROS
/// 1, `slam_gmapping:` are found, or everything when there is no such section. What is wrong is told,
/// and the default stands in for it.
#[must_use]
pub fn read(
    file: &Node,
    wanted: Option<Program>,
    diagnostics: &mut Diagnostics,
) -> (Program, Values) {
    let names = ["slam_toolbox", "slam_gmapping"];
    let mut found = None;
    for name in
        names.into_iter().filter(|name| wanted.is_none_or(|program| program.node_name() == *name))
    {
        let mut sections = Vec::new();
        let mut is_named = false;
        collect(file, name, 0, &mut sections, &mut is_named);
        if is_named {
            found = Some((Some(name), sections));
            break;
        }
    }
    let (name, sections) = found.unwrap_or_else(|| {
        let mut sections = Vec::new();
        collect(file, "**", 0, &mut sections, &mut false);
        let of_ros1 = names.iter().find_map(|name| Some((*name, file.get(name)?)));
        match of_ros1 {
            Some((name, section)) => {
                sections.push(section);
                (Some(name), sections)
            }
            None => {
                let is_of_others = |(_, value): &(Node, Node)| value.entries().is_some();
                let entries = file.entries().unwrap_or_default();
                if sections.is_empty() && !entries.iter().all(is_of_others) {
                    sections.push(file);
                }
                (None, sections)
            }
        }
    });
    let mut flat = Vec::new();
    for section in sections {
        flatten(section, "", &mut flat);
    }
    let given: Vec<Given<'_>> = flat
        .iter()
        .map(|one| Given {
            name: &one.name,
            text: one.text.as_str().into(),
            name_origin: one.name_origin,
            origin: one.origin,
        })
        .collect();
    let by_name = match name {
        Some("slam_gmapping") => Some(Method::Gmapping),
        Some(_) => Some(Method::Graph),
        None => tables::method_of(&given),
    };
    let program = wanted.unwrap_or_else(|| match by_name {
        Some(Method::Gmapping) => Program::Gmapping,
        _ => {
            let mode = flat.iter().find(|one| one.name == "mode").map(|one| one.text.as_str());
            if mode == Some("localization") { Program::Localization } else { Program::Async }
        }
    });
    let values = program.table().check(given, None, diagnostics);
    for finding in tables::idle(&values).into_iter().chain(tables::conflicts(&values)) {
        diagnostics.push(finding);
    }
    (program, values)
}

fn collect<'a>(
    at: &'a Node,
    node: &str,
    depth: usize,
    found: &mut Vec<&'a Node>,
    is_named: &mut bool,
) {
    for (key, value) in at.entries().filter(|_| depth < DEEPEST).unwrap_or_default() {
        let Some(key) = key.text() else { continue };
        let name = key.trim_start_matches('/').rsplit('/').next().unwrap_or(key);
        match value.get("ros__parameters") {
            Some(parameters) if [node, "**", "*"].contains(&name) => {
                *is_named |= name == node;
                found.push(parameters);
            }
            Some(_) => {}
            None => collect(value, node, depth + 1, found, is_named),
        }
    }
}

struct Flat {
    name: String,
    text: String,
    name_origin: Origin,
    origin: Origin,
}

/// Names with dots; a list is its values side by side.
fn flatten(at: &Node, prefix: &str, flat: &mut Vec<Flat>) {
    for (key, value) in at.entries().unwrap_or_default() {
        let Some(last) = key.text() else { continue };
        let name = if prefix.is_empty() { last.to_owned() } else { format!("{prefix}.{last}") };
        let text = match &value.value {
            Value::Map(_) => {
                flatten(value, &name, flat);
                continue;
            }
            Value::Scalar { text, .. } => text.clone(),
            Value::List(list) => list.iter().filter_map(Node::text).collect::<Vec<_>>().join(" "),
        };
        flat.push(Flat { name, text, name_origin: key.span.into(), origin: value.span.into() });
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::SourceMap;

    use super::*;

    fn check(text: &str, program: Program, named: &[&str]) -> Values {
        let mut sources = SourceMap::new();
        let file = sources.add("params.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).ok().flatten();
        let mut diagnostics = Diagnostics::new();
        let read = tree.map(|tree| read(&tree, None, &mut diagnostics));
        let (found, values) = read.unwrap_or_else(|| panic!("{text}"));
        let codes: Vec<&str> = diagnostics.iter().map(|it| it.code).collect();
        assert_eq!((found, codes.as_slice()), (program, named), "{text}");
        values
    }

    #[test]
    fn a_file_tells_for_whom_it_is() {
        let of_toolbox =
            "slam_toolbox: {ros__parameters: {resolution: 0.1, map_start_pose: [1, 2, 3]}}";
        let values = check(of_toolbox, Program::Async, &[]);
        assert_eq!(values.number("resolution"), Some(0.1));
        assert_eq!(values.numbers("map_start_pose"), [1.0, 2.0, 3.0]);
        let localization = "slam_toolbox: {ros__parameters: {mode: localization}}";
        check(localization, Program::Localization, &[]);
        let of_ros1 = check("slam_gmapping: {particles: 50}", Program::Gmapping, &[]);
        assert_eq!(of_ros1.integer("particles"), Some(50));
        check("maxUrange: 5", Program::Gmapping, &[]);
        let all = "/**: {ros__parameters: {map_update_interval: 2}}";
        assert_eq!(check(all, Program::Async, &[]).number("map_update_interval"), Some(2.0));
        check("amcl: {ros__parameters: {alpha1: 2}}", Program::Async, &[]);
    }

    #[test]
    fn what_is_wrong_or_idle_is_told() {
        check(
            "slam_toolbox: {ros__parameters: {resolutoin: 1}}",
            Program::Async,
            &["unknown-parameter"],
        );
        let idle = "slam_toolbox: {ros__parameters: {ceres_loss_function: HuberLoss}}";
        check(idle, Program::Async, &["idle-parameter"]);
    }
}
