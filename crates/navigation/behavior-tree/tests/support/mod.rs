//! Leaves with scripted results, and their counts.

#![allow(dead_code, reason = "each test uses a part")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use periplus_behavior_tree::{
    BehaviorNode, BehaviorTree, Blackboard, NodeKind, NodeModel, NodeRegistry, NodeRun, NodeStatus,
    TreeError, TreeFiles, nav2,
};

/// Results of leaves by name, and how often each was ticked and halted while running.
#[derive(Clone, Default)]
pub(crate) struct Scripted(Arc<Mutex<State>>);

#[derive(Default)]
struct State {
    results: BTreeMap<String, Vec<NodeStatus>>,
    ticks: BTreeMap<String, usize>,
    halts: BTreeMap<String, usize>,
    /// Names in the order of their ticks and halts.
    calls: Vec<String>,
}

/// Statuses of letters: R running, S success, F failure, K skipped.
pub(crate) fn statuses(letters: &str) -> Vec<NodeStatus> {
    let status = |letter| match letter {
        'R' => NodeStatus::Running,
        'S' => NodeStatus::Success,
        'F' => NodeStatus::Failure,
        'K' => NodeStatus::Skipped,
        other => panic!("no status: {other}"),
    };
    letters.chars().map(status).collect()
}

impl Scripted {
    /// Sets the results of a leaf; the last one is repeated.
    pub(crate) fn set(&self, name: &str, letters: &str) {
        let mut state = self.0.lock().unwrap();
        state.results.insert(name.to_owned(), statuses(letters));
        state.ticks.remove(name);
    }

    pub(crate) fn ticks(&self, name: &str) -> usize {
        self.0.lock().unwrap().ticks.get(name).copied().unwrap_or_default()
    }

    pub(crate) fn halts(&self, name: &str) -> usize {
        self.0.lock().unwrap().halts.get(name).copied().unwrap_or_default()
    }

    /// Ticks and halts since the last call: `name` and `!name`.
    pub(crate) fn calls(&self) -> Vec<String> {
        std::mem::take(&mut self.0.lock().unwrap().calls)
    }

    /// Registers a leaf whose results are scripted by its name.
    pub(crate) fn register(&self, registry: &mut NodeRegistry, model: NodeModel) {
        let scripted = self.clone();
        registry.register(model, move || Leaf(scripted.clone()));
    }
}

struct Leaf(Scripted);

impl BehaviorNode for Leaf {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let name = run.name().to_owned();
        let mut state = self.0.0.lock().unwrap();
        state.calls.push(name.clone());
        let count = state.ticks.entry(name.clone()).or_default();
        *count += 1;
        let count = *count;
        let results = state.results.get(&name);
        let result = results.and_then(|results| results.get(count - 1).or(results.last()));
        Ok(result.copied().unwrap_or(NodeStatus::Success))
    }

    fn halt(&mut self, run: &mut NodeRun<'_>) -> Result<(), TreeError> {
        if run.status() == NodeStatus::Running {
            let name = run.name().to_owned();
            let mut state = self.0.0.lock().unwrap();
            state.calls.push(format!("!{name}"));
            *state.halts.entry(name).or_default() += 1;
        }
        Ok(())
    }
}

/// Registry with all nodes of this crate by the rules of main, and the leaf `Leaf`.
pub(crate) fn registry(scripted: &Scripted) -> NodeRegistry {
    let mut registry = NodeRegistry::new();
    nav2::register(&mut registry, nav2::Nav2NodeRules::MAIN);
    scripted.register(&mut registry, NodeModel::new("Leaf", NodeKind::Action));
    registry
}

/// Tree of the XML of its root node.
pub(crate) fn tree(root: &str, scripted: &Scripted) -> BehaviorTree {
    let xml =
        format!(r#"<root BTCPP_format="4"><BehaviorTree ID="T">{root}</BehaviorTree></root>"#);
    file(&xml, scripted)
}

/// Main tree of a file.
pub(crate) fn file(xml: &str, scripted: &Scripted) -> BehaviorTree {
    let registry = registry(scripted);
    let files = TreeFiles::parse("t.xml", xml, &registry);
    files.tree("", &registry, Blackboard::new()).unwrap_or_else(|findings| panic!("{findings:#?}"))
}

/// Folder of the shared data; `None` with a loud message where it is missing.
pub(crate) fn shared(folder: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared").join(folder);
    if !path.is_dir() {
        eprintln!("SKIPPED: {} is missing", path.display());
        return None;
    }
    Some(path)
}
