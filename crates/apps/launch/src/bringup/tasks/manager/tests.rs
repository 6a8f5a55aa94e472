//! Commands to a manager of two nodes.

use std::sync::{Arc, Mutex};

use periplus_graph::{Graph, Io, LifecycleCallbacks, LifecycleNode, NodeSettings, StepOutcome};
use periplus_msgs::nav2_msgs::{ManageLifecycleNodes, ManageLifecycleNodesRequest as Command};
use periplus_msgs::std_srvs::{Trigger, TriggerRequest};

use periplus_sim::Search;

use super::*;

/// Node that notes its transitions; one of them fails.
struct Managed {
    name: &'static str,
    failing: &'static str,
    made: Arc<Mutex<Vec<String>>>,
}

impl Managed {
    fn step(&self, transition: &str) -> StepOutcome {
        let step = format!("{}:{transition}", self.name);
        let outcome =
            if step == self.failing { StepOutcome::Failure } else { StepOutcome::Success };
        self.made.lock().unwrap().push(step);
        outcome
    }
}

impl LifecycleCallbacks for Managed {
    fn on_configure(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.step("configure")
    }

    fn on_activate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.step("activate")
    }

    fn on_deactivate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.step("deactivate")
    }

    fn on_cleanup(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.step("cleanup")
    }

    fn on_shutdown(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.step("shutdown")
    }
}

struct Stage {
    graph: Graph,
    manager: Manager,
    user: Node,
    made: Arc<Mutex<Vec<String>>>,
    _nodes: Vec<LifecycleNode<Managed>>,
}

impl Stage {
    fn new(failing: &'static str) -> Self {
        let graph = Graph::new();
        let made = Arc::new(Mutex::new(Vec::new()));
        let node = |name| {
            let node = graph.node(NodeSettings::new(name)).unwrap();
            LifecycleNode::new(node.actor(Managed { name, failing, made: made.clone() })).unwrap()
        };
        let nodes = vec![node("a"), node("b")];
        let settings = ManagerSettings {
            node_names: vec!["a".to_owned(), "b".to_owned()],
            autostart: false,
            bond_timeout_s: 0.0,
            attempt_respawn_reconnection: false,
            bond_respawn_max_duration_s: 0.0,
        };
        let manager_node = graph.node(NodeSettings::new("manager")).unwrap();
        let manager = Manager::new(manager_node, settings, 0).unwrap();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        Self { graph, manager, user, made, _nodes: nodes }
    }

    fn work(&mut self) {
        let (search, mut said) = (Search::default(), Vec::new());
        for _ in 0..20 {
            let mut stage = TaskContext {
                graph: &self.graph,
                now_ns: self.graph.now_ns(),
                simulation: None,
                search: &search,
                said: &mut said,
                has_printed: false,
            };
            self.manager.work(&mut stage);
            self.graph.settle();
        }
    }

    /// Executes commands that are sent at once: transitions, results, and if the system is active.
    fn command(&mut self, commands: &[u8]) -> (String, Vec<bool>, bool) {
        self.made.lock().unwrap().clear();
        let client = self.user.client::<ManageLifecycleNodes>("manager/manage_nodes").unwrap();
        let call = |command: &u8| client.call(Command { command: *command });
        let pending: Vec<_> = commands.iter().map(call).collect();
        self.graph.settle();
        self.work();
        let results = pending.iter().map(|it| it.take().unwrap().unwrap().success).collect();
        let client = self.user.client::<Trigger>("manager/is_active").unwrap();
        let pending = client.call(TriggerRequest::default());
        self.graph.settle();
        self.work();
        let is_active = pending.take().unwrap().unwrap().success;
        (self.made.lock().unwrap().join(" "), results, is_active)
    }
}

#[test]
fn a_caller_gets_the_result_once_the_command_is_done() {
    let mut stage = Stage::new("");
    let mut check = |commands: &[u8], steps: &str, results: &[bool], is_active: bool| {
        let expected = (steps.to_owned(), results.to_vec(), is_active);
        assert_eq!(stage.command(commands), expected, "{commands:?}");
    };
    let startup = "a:configure b:configure a:activate b:activate";
    check(&[Command::STARTUP], startup, &[true], true);
    check(&[Command::PAUSE], "b:deactivate a:deactivate", &[true], false);
    check(&[Command::RESUME], "a:activate b:activate", &[true], true);
    // Commands that arrive together are executed one after the other.
    let reset = "b:deactivate a:deactivate b:cleanup a:cleanup";
    let both = format!("{reset} {startup}");
    check(&[Command::RESET, Command::STARTUP], &both, &[true, true], true);
    check(&[77], "", &[false], true);
    let shutdown = format!("{reset} b:shutdown a:shutdown");
    check(&[Command::SHUTDOWN], &shutdown, &[true], false);
}

#[test]
fn the_first_failure_ends_a_startup() {
    let mut stage = Stage::new("a:activate");
    let steps = "a:configure b:configure a:activate".to_owned();
    assert_eq!(stage.command(&[Command::STARTUP]), (steps, vec![false], false));
}
