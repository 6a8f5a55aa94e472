//! Nodes of behavior trees.

use std::sync::{Arc, Mutex};

use periplus_behavior_tree::nav2::{self, Nav2NodeRules, RecoveryServer, would_recovery_help};
use periplus_behavior_tree::{
    BehaviorNode, Blackboard, NodeKind, NodeModel, NodeRegistry, NodeRun, NodeStatus, TreeError,
    TreeFiles,
};
use serde_json::json;

use super::Setting;
use crate::reader::CaseReader;
use crate::{Case, Differences, Unreadable};

/// Attributes of each node that has some.
const ATTRIBUTES: [(&str, &[&str]); 6] = [
    ("RecoveryNode", &["number_of_retries"]),
    ("RoundRobin", &["wrap_around"]),
    ("RateController", &["hz"]),
    ("Parallel", &["success_count", "failure_count"]),
    ("RetryUntilSuccessful", &["num_attempts"]),
    ("Repeat", &["num_cycles"]),
];

/// Observations of a node and its children.
#[derive(Default)]
struct Observed {
    /// Last status of the node.
    status: NodeStatus,
    /// Statuses that each child returns; the last one is repeated.
    script: Vec<Vec<NodeStatus>>,
    ticks: Vec<usize>,
    halts: Vec<usize>,
}

type Shared = Arc<Mutex<Observed>>;

/// Parent of the node: it halts the node on request, and is never finished.
struct Parent(Shared);

impl BehaviorNode for Parent {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if run.entry("reset").and_then(|reset| reset.as_bool()) == Some(true) {
            run.halt_children()?;
            run.set_entry("reset", false)?;
        }
        let status = run.tick_child(0)?;
        if let Ok(mut observed) = self.0.lock() {
            observed.status = status;
        }
        Ok(NodeStatus::Running)
    }
}

/// Child with scripted statuses; its name is its index.
struct Child(Shared);

impl Child {
    fn index(run: &NodeRun<'_>) -> Result<usize, TreeError> {
        run.name().parse().map_err(|_| run.error("the name is not an index"))
    }
}

impl BehaviorNode for Child {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let index = Self::index(run)?;
        let Ok(mut observed) = self.0.lock() else { return Ok(NodeStatus::Failure) };
        let count = observed.ticks[index];
        observed.ticks[index] += 1;
        let script = &observed.script[index];
        let status = script.get(count).or(script.last());
        status.copied().ok_or_else(|| run.error("the child has no statuses"))
    }

    fn halt(&mut self, run: &mut NodeRun<'_>) -> Result<(), TreeError> {
        let index = Self::index(run)?;
        if run.status() == NodeStatus::Running
            && let Ok(mut observed) = self.0.lock()
        {
            observed.halts[index] += 1;
        }
        Ok(())
    }
}

fn status(value: &CaseReader<'_>) -> Result<NodeStatus, Unreadable> {
    NodeStatus::of_name(value.text()?).ok_or_else(|| value.unreadable("a status such as RUNNING"))
}

/// Control nodes and decorators, tick by tick.
pub(super) fn check_control(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let node = given.get("node")?.text()?;
    let script = given.get("children")?.each(|child| child.each(status))?;
    let count = script.len();
    let shared = Arc::new(Mutex::new(Observed {
        script,
        ticks: vec![0; count],
        halts: vec![0; count],
        ..Observed::default()
    }));
    let registry = registry(distro, &shared);
    let xml = xml(node, &given.get("attributes")?, count);
    let files = TreeFiles::parse("case.xml", &xml, &registry);
    let tree = files.tree("", &registry, Blackboard::new());
    let mut tree = tree.map_err(|findings| {
        let first = findings.iter().next().map_or("no tree", |finding| &finding.message);
        Unreadable(format!("{first}: {xml}"))
    })?;
    let times = given.get("tick_times")?.numbers()?;
    let resets = given.get("reset_before")?.each(CaseReader::truth)?;
    let (mut returns, mut ticks, mut halts) = (Vec::new(), Vec::new(), Vec::new());
    for (time_s, reset) in times.into_iter().zip(resets) {
        let failed = |message: String| Unreadable(format!("{node}: {message}"));
        tree.blackboard_mut().set("reset", reset).map_err(|error| failed(error.to_string()))?;
        #[allow(clippy::cast_possible_truncation, reason = "saturates")]
        let now_ns = (time_s * 1e9).round() as i64;
        tree.tick(now_ns, &mut ()).map_err(|error| failed(error.to_string()))?;
        if let Ok(observed) = shared.lock() {
            returns.push(observed.status.name());
            ticks.push(observed.ticks.clone());
            halts.push(observed.halts.clone());
        }
    }
    differences.compare_members(
        &[
            (&["returns"], json!(returns)),
            (&["child_ticks"], json!(ticks)),
            (&["halts_while_running"], json!(halts)),
        ],
        &case.expect(),
    );
    Ok(())
}

fn registry(distro: &str, shared: &Shared) -> NodeRegistry {
    let mut registry = NodeRegistry::new();
    let wraps = matches!(distro, "humble" | "jazzy" | "kilted");
    nav2::register(&mut registry, if wraps { Nav2NodeRules::JAZZY } else { Nav2NodeRules::MAIN });
    let parent = shared.clone();
    registry
        .register(NodeModel::new("CaseParent", NodeKind::Control), move || Parent(parent.clone()));
    let child = shared.clone();
    registry.register(NodeModel::new("CaseChild", NodeKind::Action), move || Child(child.clone()));
    registry
}

/// The node with its attributes and children. Attributes of other nodes have no influence.
fn xml(node: &str, attributes: &CaseReader<'_>, count: usize) -> String {
    let own = ATTRIBUTES.iter().find(|(name, _)| *name == node).map_or(&[][..], |(_, own)| own);
    let mut written = String::new();
    for (name, value) in attributes.members().unwrap_or_default() {
        if own.contains(&name) {
            written += &format!(" {name}=\"{}\"", value.written());
        } else {
            value.skip();
        }
    }
    let children: String =
        (0..count).map(|child| format!("<CaseChild name=\"{child}\"/>")).collect();
    format!(
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Case\"><CaseParent>\
         <{node}{written}>{children}</{node}></CaseParent></BehaviorTree></root>"
    )
}

/// Error codes against which a recovery may help.
pub(super) fn check_recovery(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let server = given.get("server")?;
    let server = match server.text()? {
        "controller" => RecoveryServer::Controller,
        "planner" => RecoveryServer::Planner,
        "smoother" => RecoveryServer::Smoother,
        "route" => RecoveryServer::Route,
        _ => return Err(server.unreadable("controller, planner, smoother or route")),
    };
    let help = given.get("error_codes")?.each(|code| {
        let number =
            u16::try_from(code.integer()?).map_err(|_| code.unreadable("an error code"))?;
        Ok(would_recovery_help(server, number))
    })?;
    differences.compare_members(&[(&["help"], json!(help))], &case.expect());
    Ok(())
}
