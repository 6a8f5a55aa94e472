//! Parameters from files: those of ROS 2 (`slam_toolbox: ros__parameters:`), and those of ROS 1.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_params::{Given, ParamValues};
use periplus_slam::{Method, tables};
use periplus_yaml::YamlNode;

use crate::node_parameters::{MAX_NAMESPACE_DEPTH, Written, flatten};
use crate::slam_toolbox::Program;

/// Names under which nodes that make maps have their parameters, with the method that each stands for.
const NODES: [(&str, Option<Method>); 5] = [
    ("slam_toolbox", Some(Method::Graph)),
    ("slam_gmapping", Some(Method::Gmapping)),
    ("gmapping", Some(Method::Gmapping)),
    ("turtlebot3_slam_gmapping", Some(Method::Gmapping)),
    ("slam", None),
];

/// Parameters of a file for a mapper.
#[derive(Clone, Debug, Default)]
pub struct InFile {
    /// The method that the name of its node stands for.
    pub method: Option<Method>,
    /// Its parameters, in their order.
    pub written: Vec<Written>,
    /// True if the file has parameters, and all of them are for other nodes.
    pub is_for_other_nodes: bool,
}

/// Program of a mapper with its parameters.
#[derive(Clone, Debug)]
pub struct MapperParameters {
    /// The requested program, or the one given by the names of nodes and parameters.
    pub program: Program,
    /// Values of the program's table.
    pub values: ParamValues,
    /// True if the file has parameters, and all of them are for other nodes.
    pub is_for_other_nodes: bool,
}

/// Finds the parameters for a mapper in a file; with `wanted` only those for that method. They are below
/// `slam_toolbox: ros__parameters:`, below `/**:`, in files of ROS 1 below `slam_gmapping:`, or are the
/// whole file if there is no such section. Reports if all are for other nodes.
#[must_use]
pub fn in_file(file: &YamlNode, wanted: Option<Method>, diagnostics: &mut Diagnostics) -> InFile {
    let fits = |method: Option<Method>| wanted.is_none() || method.is_none() || method == wanted;
    let names = NODES.into_iter().filter(|(_, method)| fits(*method));
    let mut sections = Sections::default();
    let mut method = None;
    for (name, of_name) in names.clone() {
        sections = Sections::default();
        sections.collect(file, name, 0);
        if sections.is_named {
            method = of_name;
            break;
        }
    }
    if !sections.is_named {
        // ROS 1: without `ros__parameters`.
        let of_ros1 = names.into_iter().find_map(|(name, method)| Some((method, file.get(name)?)));
        if let Some((of_name, section)) = of_ros1.filter(|(_, it)| it.entries().is_some()) {
            method = of_name;
            sections.found.push(section);
        } else if sections.found.is_empty() && sections.others.is_empty() {
            sections.found.push(file);
        }
    }
    let is_for_other_nodes = sections.found.is_empty();
    if is_for_other_nodes {
        diagnostics.push(
            Diagnostic::warning("no-parameters", "no node in here makes maps")
                .at(file.span)
                .note(format!("there are parameters for {}", sections.others.join(", ")))
                .help("write them below `slam_toolbox:` or `slam_gmapping:`, or below `/**:`"),
        );
    }
    let mut written = Vec::new();
    for section in sections.found {
        flatten(section, "", &mut written);
    }
    InFile { method, written, is_for_other_nodes }
}

/// Reads a file for a mapper: for the requested program, or the one given by the names of its nodes and
/// parameters, see [`in_file`]. Reports faults, and uses the defaults instead.
#[must_use]
pub fn read(
    file: &YamlNode,
    wanted: Option<Program>,
    diagnostics: &mut Diagnostics,
) -> MapperParameters {
    let InFile { method, written, is_for_other_nodes } =
        in_file(file, wanted.map(Program::method), diagnostics);
    let given: Vec<Given<'_>> = written.iter().map(Written::given).collect();
    let program = wanted.unwrap_or_else(|| match method.or_else(|| tables::method_of(&given)) {
        Some(Method::Gmapping) => Program::Gmapping,
        _ => {
            let mode = written.iter().find(|one| one.name == "mode").map(|one| one.text.as_str());
            if mode == Some("localization") { Program::Localization } else { Program::Async }
        }
    });
    let values = program.table().check(given, None, diagnostics);
    for finding in tables::idle(&values).into_iter().chain(tables::conflicts(&values)) {
        diagnostics.push(finding);
    }
    MapperParameters { program, values, is_for_other_nodes }
}

/// Content below `ros__parameters`.
#[derive(Default)]
struct Sections<'a> {
    /// For the node, and for all.
    found: Vec<&'a YamlNode>,
    /// True if a section is for the node by its name.
    is_named: bool,
    /// Names of other nodes.
    others: Vec<String>,
}

impl<'a> Sections<'a> {
    fn collect(&mut self, at: &'a YamlNode, node: &str, depth: usize) {
        for (key, value) in at.entries().filter(|_| depth < MAX_NAMESPACE_DEPTH).unwrap_or_default()
        {
            let Some(key) = key.text() else { continue };
            let name = key.trim_start_matches('/').rsplit('/').next().unwrap_or(key);
            match value.get("ros__parameters") {
                Some(parameters) if [node, "**", "*"].contains(&name) => {
                    self.is_named |= name == node;
                    self.found.push(parameters);
                }
                Some(_) => self.others.push(format!("`{name}`")),
                None => self.collect(value, node, depth + 1),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::SourceMap;

    use super::*;

    fn check(text: &str, program: Program, named: &[&str]) -> ParamValues {
        let mut sources = SourceMap::new();
        let file = sources.add("params.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).ok().flatten();
        let mut diagnostics = Diagnostics::new();
        let read = tree.map(|tree| read(&tree, None, &mut diagnostics));
        let read = read.unwrap_or_else(|| panic!("{text}"));
        let codes: Vec<&str> = diagnostics.iter().map(|it| it.code).collect();
        assert_eq!((read.program, codes.as_slice()), (program, named), "{text}");
        assert_eq!(read.is_for_other_nodes, named.contains(&"no-parameters"), "{text}");
        read.values
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
        check("amcl: {ros__parameters: {alpha1: 2}}", Program::Async, &["no-parameters"]);
        let in_a_namespace = "robot: {slam_toolbox: {ros__parameters: {resolution: 0.2}}}";
        assert_eq!(check(in_a_namespace, Program::Async, &[]).number("resolution"), Some(0.2));
        let beside =
            "amcl: {ros__parameters: {alpha1: 2}}\nslam: {ros__parameters: {particles: 8}}";
        assert_eq!(check(beside, Program::Gmapping, &[]).integer("particles"), Some(8));
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
