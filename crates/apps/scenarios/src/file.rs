//! Scenario files.

mod events;
mod nodes;

use std::path::{Component, Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap, Span};
use periplus_faults::{InjectedFault, flat_text, read_section};
use periplus_geometry::Pose2;
use periplus_os::Machine;
use periplus_params::{ParamValues, Table};
use periplus_resources::Host as _;
use periplus_sim::script::DriveScript;
use periplus_yaml::{YamlNode, YamlValue};

use crate::tables::{ASSERTIONS, ROBOT, SCENARIO, ScenarioParams, ScenarioRobotParams};
use crate::variables::{self, Variables};

pub use events::{EventAction, EventTrigger, ScenarioEvent};
pub use nodes::ScenarioNodes;

/// A scenario that was read from a file.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Name.
    pub name: String,
    /// File from which it was read, as the user wrote it.
    pub path: PathBuf,
    /// Folders in which its files are.
    pub folders: ScenarioFolders,
    /// Values without a section.
    pub params: ScenarioParams,
    /// The robot; `None` where the world has it.
    pub robot: Option<ScenarioRobot>,
    /// Nodes beside the robot.
    pub nodes: ScenarioNodes,
    /// Parameters of nodes: full or relative name, parameter, value.
    pub parameters: Vec<[String; 3]>,
    /// Faults with their time windows.
    pub faults: Vec<InjectedFault>,
    /// Scripted driving.
    pub drive: Option<DriveScript>,
    /// Events.
    pub events: Vec<ScenarioEvent>,
    /// Assertions.
    pub assertions: Vec<ScenarioAssertion>,
    /// Variables with their values in this run.
    pub variables: Variables,
    /// Text of the file.
    pub(crate) text: String,
    /// Source text, for findings of the run.
    pub sources: SourceMap,
}

/// Folders in which the files of a scenario are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ScenarioFolders {
    /// Folder of the scenario file: the first base of relative paths.
    pub scenario: PathBuf,
    /// Working folder: the second base of relative paths; empty for that of the process.
    pub working: PathBuf,
    /// Folder with copies of all files by their absolute paths, in place of the root of the file system.
    pub root: Option<PathBuf>,
}

impl ScenarioFolders {
    /// Folders of a scenario file that is not a copy.
    #[must_use]
    pub fn of_file(path: &Path) -> Self {
        let scenario = path.parent().unwrap_or(Path::new("")).to_owned();
        Self { scenario, working: PathBuf::new(), root: None }
    }

    fn resolve(&self, written: &str) -> PathBuf {
        let path = Path::new(written);
        if written.contains("://") {
            // Names of packages and models are resolved when the file is read.
            return path.to_owned();
        }
        if let Some(root) = self.root.as_deref().filter(|_| path.is_absolute()) {
            return root.join(below_root(path));
        }
        let beside = self.scenario.join(path);
        if Machine.kind(&beside).is_some() { beside } else { self.working.join(path) }
    }
}

/// Relative path of an absolute one below a folder that stands for the root of the file system: `/a/b` is `a/b`,
/// and `C:\a` is `C/a`.
#[must_use]
pub fn below_root(path: &Path) -> PathBuf {
    path.components()
        .filter_map(|part| match part {
            Component::Normal(name) => Some(PathBuf::from(name)),
            Component::Prefix(prefix) => {
                let text = prefix.as_os_str().to_string_lossy();
                Some(text.chars().filter(|it| it.is_alphanumeric()).collect::<String>().into())
            }
            _ => None,
        })
        .collect()
}

/// Robot of a scenario.
#[derive(Clone, Debug)]
pub struct ScenarioRobot {
    /// File and pose.
    pub params: ScenarioRobotParams,
    /// Arguments of its xacro.
    pub arguments: Vec<(String, String)>,
}

/// An assertion with its parameters.
#[derive(Clone, Debug)]
pub struct ScenarioAssertion {
    /// Word, such as `min_clearance`.
    pub word: &'static str,
    /// Parameters, by the table of the word.
    pub values: ParamValues,
    /// Source location.
    pub span: Span,
}

/// A scenario file that cannot be run.
#[derive(Debug)]
pub struct ScenarioFileError {
    /// Findings.
    pub diagnostics: Diagnostics,
    /// Source text of the findings.
    pub sources: SourceMap,
}

/// Names of the sections, besides those of the table.
const SECTIONS: [&str; 8] =
    ["robot", "nodes", "parameters", "variables", "faults", "drive", "events", "assertions"];

impl Scenario {
    /// Reads a scenario. `path` is its name in findings, and the base of relative paths; `set` has other values of its
    /// variables.
    ///
    /// # Errors
    /// The findings, if the scenario has errors.
    pub fn read(
        path: &Path,
        text: String,
        set: &[(String, String)],
    ) -> Result<Self, ScenarioFileError> {
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add(path.display().to_string(), text.clone());
        let tree = match periplus_yaml::parse(file, &sources) {
            Ok(Some(tree)) => Some(tree),
            Ok(None) => {
                let message = "the scenario is empty";
                let help = "a scenario needs at least `world` and `assertions`";
                diagnostics.push(Diagnostic::error("empty", message).help(help));
                None
            }
            Err(error) => {
                diagnostics.push(*error);
                None
            }
        };
        let scenario = tree
            .map(|tree| Self::of_tree(path, tree, set, (text, sources.clone()), &mut diagnostics));
        match scenario {
            Some(scenario) if !diagnostics.has_errors() => Ok(scenario),
            _ => Err(ScenarioFileError { diagnostics, sources }),
        }
    }

    fn of_tree(
        path: &Path,
        mut tree: YamlNode,
        set: &[(String, String)],
        (text, sources): (String, SourceMap),
        diagnostics: &mut Diagnostics,
    ) -> Self {
        if tree.entries().is_none() {
            let message = format!("a scenario is a mapping, not {}", tree.kind());
            diagnostics.push(Diagnostic::error("bad-scenario", message).at(tree.span));
            tree.value = YamlValue::Map(Vec::new());
        }
        let variables = variables::read(tree.get("variables"), set, diagnostics);
        let variables = variables.unwrap_or_else(|message| {
            diagnostics.push(Diagnostic::error("unknown-variable", message));
            Variables::new()
        });
        variables::substitute(&mut tree, &variables, diagnostics);
        let params = top_level(&tree, diagnostics);
        let section = |name: &str| tree.get(name).filter(|node| !node.is_null());
        let faults = section("faults")
            .map(|node| periplus_faults::read_list(node, diagnostics))
            .unwrap_or_default();
        let drive = section("drive").filter(|node| node.list().is_some());
        let drive = drive.map(|node| periplus_sim::script::read_node(node, diagnostics));
        if let Some(node) = section("drive").filter(|node| node.list().is_none()) {
            let message = format!("`drive` is {}; it must be a list of commands", node.kind());
            let help = "write `- {at: 0, until: 5, linear: 0.3}` or `- {goto: [1, 0]}`";
            diagnostics.push(Diagnostic::error("bad-drive", message).at(node.span).help(help));
        }
        let scenario = Self {
            name: params.name.clone().unwrap_or_else(|| {
                let name = path.file_stem().map(|it| it.to_string_lossy().into_owned());
                let name = name.unwrap_or_else(|| "scenario".to_owned());
                name.strip_suffix(".scenario").map(str::to_owned).unwrap_or(name)
            }),
            path: path.to_owned(),
            folders: ScenarioFolders::of_file(path),
            robot: section("robot").map(|node| robot(node, diagnostics)),
            nodes: section("nodes")
                .map(|node| ScenarioNodes::read(node, diagnostics))
                .unwrap_or_default(),
            parameters: section("parameters")
                .map(|node| parameters(node, diagnostics))
                .unwrap_or_default(),
            faults,
            drive,
            events: section("events")
                .map(|node| events::read_list(node, diagnostics))
                .unwrap_or_default(),
            assertions: section("assertions")
                .map(|node| assertions(node, diagnostics))
                .unwrap_or_default(),
            params,
            variables,
            text,
            sources,
        };
        scenario.check(&tree, diagnostics);
        scenario
    }

    /// Checks what needs several sections.
    fn check(&self, tree: &YamlNode, diagnostics: &mut Diagnostics) {
        let at = |name: &str| tree.get(name).map_or(tree.span, |node| node.span);
        if self.assertions.is_empty() {
            diagnostics.push(
                Diagnostic::error("no-assertions", "the scenario asserts nothing")
                    .at(tree.span)
                    .help("add `assertions`, such as `- no_collision`"),
            );
        }
        let mut need = |is_given: bool, what: &str, node: &str, span: Span| {
            if !is_given {
                diagnostics.push(
                    Diagnostic::error(
                        "missing-node",
                        format!("{what} needs `nodes: {{{node}: }}`"),
                    )
                    .at(span),
                );
            }
        };
        let nodes = &self.nodes;
        for event in &self.events {
            if matches!(event.action, EventAction::Goal(_)) {
                need(nodes.navigation.is_some(), "a goal", "navigation", event.span);
            }
        }
        for assertion in &self.assertions {
            match assertion.word {
                "map_iou" => need(nodes.slam.is_some(), "`map_iou`", "slam", assertion.span),
                "spl" => need(nodes.navigation.is_some(), "`spl`", "navigation", assertion.span),
                "tracking_error" => {
                    need(
                        nodes.navigation.is_some(),
                        "`tracking_error`",
                        "navigation",
                        assertion.span,
                    );
                }
                "localization_error" => {
                    let is_given = nodes.slam.is_some() || nodes.localization.is_some();
                    need(is_given, "`localization_error`", "localization", assertion.span);
                }
                _ => {}
            }
        }
        if nodes.slam.is_some() && nodes.localization.is_some() {
            let message = "`slam` and `localization` both publish the pose in the map";
            diagnostics.push(
                Diagnostic::error("two-localizations", message)
                    .at(at("nodes"))
                    .help("remove one of them"),
            );
        }
        if !matches!(self.params.region_m.len(), 0 | 4) {
            let message = "`region` needs four numbers: [min_x, min_y, max_x, max_y]";
            diagnostics.push(Diagnostic::error("bad-value", message).at(at("region")));
        }
    }

    /// Pose of the robot at the start.
    #[must_use]
    pub fn start(&self) -> Pose2 {
        self.robot.as_ref().map_or(Pose2::IDENTITY, |robot| planar_pose(&robot.params.pose))
    }

    /// Path of a file: relative to the scenario if it exists there, otherwise to the working folder.
    #[must_use]
    pub fn resolve(&self, written: &str) -> PathBuf {
        self.folders.resolve(written)
    }
}

/// Pose of two or three numbers.
pub(crate) fn planar_pose(numbers: &[f64]) -> Pose2 {
    let number = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
    Pose2::new(number(0), number(1), number(2))
}

/// Reports a list that is not a pose.
pub(crate) fn check_pose(numbers: &[f64], name: &str, span: Span, diagnostics: &mut Diagnostics) {
    if !matches!(numbers.len(), 2 | 3) {
        let count = numbers.len();
        let message = format!("`{name}` has {count} numbers; write [x, y] or [x, y, yaw]");
        diagnostics.push(Diagnostic::error("bad-pose", message).at(span));
    }
}

/// Reads the values without a section, and reports unknown names of sections.
fn top_level(tree: &YamlNode, diagnostics: &mut Diagnostics) -> ScenarioParams {
    let entries = tree.entries().unwrap_or_default();
    let mut own = Vec::new();
    for (key, value) in entries {
        let name = key.text().unwrap_or_default();
        if SECTIONS.contains(&name) {
            continue;
        }
        if SCENARIO.find(name).is_some() {
            own.push((key.clone(), value.clone()));
            continue;
        }
        let known = || SCENARIO.names().chain(SECTIONS);
        diagnostics.push(
            Diagnostic::error("unknown-section", format!("a scenario has no `{name}`"))
                .at(key.span)
                .did_you_mean(key.span, name, known())
                .note(format!("it has {}", known().collect::<Vec<_>>().join(", "))),
        );
    }
    let own = YamlNode { value: YamlValue::Map(own), ..tree.clone() };
    // The whole file is too long to be shown for a missing value.
    let own = YamlNode { span: Span { end: tree.span.start, ..tree.span }, ..own };
    ScenarioParams::from_values(&read_section(&SCENARIO, &own, diagnostics))
}

fn robot(node: &YamlNode, diagnostics: &mut Diagnostics) -> ScenarioRobot {
    let (own, arguments) = split(node, "arguments");
    let params = ScenarioRobotParams::from_values(&read_section(&ROBOT, &own, diagnostics));
    let at = node.get("pose").map_or(node.span, |pose| pose.span);
    check_pose(&params.pose, "pose", at, diagnostics);
    let mut texts = Vec::new();
    for (key, value) in arguments.as_ref().and_then(YamlNode::entries).unwrap_or_default() {
        match (key.text(), flat_text(value)) {
            (Some(name), Some(text)) => texts.push((name.to_owned(), text)),
            _ => diagnostics.push(
                Diagnostic::error("bad-argument", "an argument of xacro is a name and a value")
                    .at(key.span),
            ),
        }
    }
    ScenarioRobot { params, arguments: texts }
}

/// Splits an entry off a mapping.
pub(crate) fn split(node: &YamlNode, name: &str) -> (YamlNode, Option<YamlNode>) {
    let Some(entries) = node.entries() else { return (node.clone(), None) };
    let (with, without): (Vec<_>, Vec<_>) =
        entries.iter().cloned().partition(|(key, _)| key.text() == Some(name));
    let value = with.into_iter().next().map(|(_, value)| value);
    (YamlNode { value: YamlValue::Map(without), ..node.clone() }, value)
}

/// Reads `parameters`: parameters by node.
fn parameters(node: &YamlNode, diagnostics: &mut Diagnostics) -> Vec<[String; 3]> {
    let mut all = Vec::new();
    for (name, section) in node.entries().unwrap_or_default() {
        let Some(entries) = section.entries() else {
            let message = "parameters are listed by node";
            let help = "write `controller_server: {FollowPath.max_speed: 0.3}`";
            diagnostics
                .push(Diagnostic::error("bad-parameters", message).at(section.span).help(help));
            continue;
        };
        for (parameter, value) in entries {
            match (name.text(), parameter.text(), value_text(value)) {
                (Some(node), Some(parameter), Some(value)) => {
                    all.push([node.to_owned(), parameter.to_owned(), value]);
                }
                _ => diagnostics.push(
                    Diagnostic::error("bad-parameters", "a parameter is a name and a value")
                        .at(value.span)
                        .help("join the names of nested parameters by dots"),
                ),
            }
        }
    }
    all
}

/// Value of a parameter in YAML: a scalar or a list.
fn value_text(node: &YamlNode) -> Option<String> {
    match &node.value {
        YamlValue::List(items) => {
            let texts: Option<Vec<&str>> = items.iter().map(YamlNode::text).collect();
            texts.map(|texts| format!("[{}]", texts.join(", ")))
        }
        _ => flat_text(node),
    }
}

/// Reads the assertions: each is a word, or a word with its parameters.
fn assertions(node: &YamlNode, diagnostics: &mut Diagnostics) -> Vec<ScenarioAssertion> {
    let Some(items) = node.list() else {
        let message = format!("`assertions` is {}; it must be a list", node.kind());
        diagnostics.push(
            Diagnostic::error("bad-assertions", message)
                .at(node.span)
                .help("write `- no_collision`"),
        );
        return Vec::new();
    };
    items.iter().filter_map(|item| assertion(item, diagnostics)).collect()
}

fn assertion(item: &YamlNode, diagnostics: &mut Diagnostics) -> Option<ScenarioAssertion> {
    let (word, span, value) = word_of(item, "an assertion", "no_collision", diagnostics)?;
    let table = find_table(&ASSERTIONS, word, span, "assertion", diagnostics)?;
    let empty = YamlNode { value: YamlValue::Map(Vec::new()), ..item.clone() };
    let values = read_section(table, value.unwrap_or(&empty), diagnostics);
    Some(ScenarioAssertion { word: table.name, values, span })
}

/// Word of an item that is a word, or a mapping with one word and its value.
fn word_of<'a>(
    item: &'a YamlNode,
    what: &str,
    example: &str,
    diagnostics: &mut Diagnostics,
) -> Option<(&'a str, Span, Option<&'a YamlNode>)> {
    if let Some(word) = item.text() {
        return Some((word, item.span, None));
    }
    match item.entries() {
        Some([(key, value)]) => key.text().map(|word| (word, key.span, Some(value))),
        _ => {
            let message =
                format!("{what} is {}; it must be one word with its parameters", item.kind());
            let help = format!("write `- {example}`, one for each list item");
            diagnostics.push(Diagnostic::error("bad-item", message).at(item.span).help(help));
            None
        }
    }
}

/// Table of a word among several.
fn find_table(
    tables: &[&'static Table],
    word: &str,
    span: Span,
    what: &str,
    diagnostics: &mut Diagnostics,
) -> Option<&'static Table> {
    let found = tables.iter().copied().find(|table| table.name == word);
    if found.is_none() {
        let names = || tables.iter().map(|table| table.name);
        diagnostics.push(
            Diagnostic::error("unknown-word", format!("there is no {what} `{word}`"))
                .at(span)
                .did_you_mean(span, word, names())
                .note(format!("known: {}", names().collect::<Vec<_>>().join(", "))),
        );
    }
    found
}
