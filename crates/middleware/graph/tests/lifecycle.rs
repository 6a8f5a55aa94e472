//! Managed nodes, seen from other nodes.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use std::sync::Arc;

use periplus_graph::{
    Actor, Graph, Io, Lifecycle, LifecycleCallbacks, LifecycleNode, LifecycleState, Mailbox, Node,
    NodeSettings, Qos, Step, StepOutcome, Transition,
};
use periplus_msgs::Service;
use periplus_msgs::lifecycle_msgs::*;

/// Callbacks that ran, and the outcomes of the next ones.
#[derive(Default)]
struct Doings {
    steps: Vec<Step>,
    next: Vec<StepOutcome>,
}

struct Stage {
    graph: Graph,
    user: Node,
    actor: Actor<Doings>,
    life: Lifecycle,
    events: Mailbox<TransitionEvent>,
}

impl Stage {
    fn new() -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let node = graph.node(NodeSettings::new("map_server")).unwrap();
        let mut actor = node.actor(Doings::default());
        let life = actor
            .managed(|doings, step, _| {
                doings.steps.push(step);
                doings.next.pop().unwrap_or(StepOutcome::Success)
            })
            .unwrap();
        let events = user.mailbox("/map_server/transition_event", Qos::reliable(100)).unwrap();
        Self { graph, user, actor, life, events }
    }

    fn ask<S: Service>(&self, name: &str, request: S::Request) -> Arc<S::Response> {
        let asked = self.user.client::<S>(&format!("/map_server/{name}")).unwrap().call(request);
        self.graph.settle();
        asked.take().unwrap().unwrap()
    }

    fn change(&self, id: u8, label: &str) -> bool {
        let transition = periplus_msgs::lifecycle_msgs::Transition { id, label: label.into() };
        self.ask::<ChangeState>("change_state", ChangeStateRequest { transition }).success
    }

    /// Sets the outcomes of the next callbacks.
    fn next(&self, outcomes: &[StepOutcome]) {
        self.actor.with(|doings| doings.next = outcomes.iter().rev().copied().collect());
    }

    fn summary(&self) -> Vec<String> {
        let events = self.events.drain();
        let line = |event: &Arc<TransitionEvent>| {
            format!("{} {}", event.transition.id, event.goal_state.label)
        };
        events.iter().map(line).collect()
    }
}

#[test]
fn a_node_is_led_through_its_life() {
    let stage = Stage::new();
    assert_eq!(stage.life.state(), LifecycleState::Unconfigured);
    assert!(!stage.change(3, ""), "it has to be configured first");
    assert!(stage.change(1, ""));
    assert!(stage.change(0, "activate"), "a label is enough");
    assert!(stage.life.is_active());
    let state = stage.ask::<GetState>("get_state", GetStateRequest::default());
    assert_eq!((state.current_state.id, state.current_state.label.as_str()), (3, "active"));
    assert_eq!(stage.summary(), ["1 configuring", "10 inactive", "3 activating", "30 active"]);
    assert!(stage.change(4, "") && stage.change(2, "") && stage.change(0, "shutdown"));
    assert_eq!(stage.life.state(), LifecycleState::Finalized);
    assert!(!stage.change(1, ""));
    let steps = stage.actor.with(|doings| std::mem::take(&mut doings.steps));
    let all = [Step::Configure, Step::Activate, Step::Deactivate, Step::Cleanup, Step::Shutdown];
    assert_eq!(steps, all);
}

#[test]
fn errors_are_cleaned_up_or_the_end() {
    let stage = Stage::new();
    stage.next(&[StepOutcome::Failure]);
    assert!(!stage.change(1, ""));
    assert_eq!(stage.life.state(), LifecycleState::Unconfigured);
    stage.next(&[StepOutcome::Error, StepOutcome::Success]);
    assert!(!stage.change(1, ""));
    assert_eq!(stage.life.state(), LifecycleState::Unconfigured);
    let _ = stage.events.drain();
    stage.next(&[StepOutcome::Error, StepOutcome::Failure]);
    assert!(!stage.change(1, ""));
    assert_eq!(stage.summary(), ["1 configuring", "12 errorprocessing", "61 finalized"]);
    assert_eq!(stage.actor.with(|doings| doings.steps.last().copied()), Some(Step::Error));
}

#[test]
fn others_see_what_is_possible() {
    let stage = Stage::new();
    let name = "get_available_states";
    let states = stage.ask::<GetAvailableStates>(name, Default::default());
    assert_eq!(states.available_states.len(), 11);
    let possible = |name: &str| {
        let answer = stage.ask::<GetAvailableTransitions>(name, Default::default());
        answer
            .available_transitions
            .iter()
            .map(|one| format!("{} {}", one.transition.label, one.goal_state.label))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        possible("get_available_transitions"),
        ["configure configuring", "shutdown shuttingdown"]
    );
    assert_eq!(possible("get_transition_graph").len(), 25);
    assert!(!stage.change(10, ""), "what ends a step is not for others");
}

#[test]
fn a_program_changes_the_state_itself() {
    let stage = Stage::new();
    stage.life.change(Transition::Configure);
    stage.life.change(Transition::Activate);
    assert_eq!(stage.life.state(), LifecycleState::Unconfigured);
    stage.graph.settle();
    assert!(stage.life.is_active());
    stage.life.change(Transition::Configure);
    stage.graph.settle();
    assert!(stage.life.is_active());
    assert!(stage.user.actor(()).managed(|(), _, _| StepOutcome::Success).is_ok());
}

/// A node that records its callbacks and whether it was active in them.
#[derive(Default)]
struct Recorder {
    calls: Vec<(&'static str, bool)>,
    outcome: Option<StepOutcome>,
}

impl Recorder {
    fn record(&mut self, call: &'static str, io: &Io<'_, Self>) -> StepOutcome {
        self.calls.push((call, io.node().is_active()));
        self.outcome.take().unwrap_or(StepOutcome::Success)
    }
}

impl LifecycleCallbacks for Recorder {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.record("configure", io)
    }

    fn on_activate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.record("activate", io)
    }

    fn on_cleanup(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.record("cleanup", io)
    }
}

fn recorder(graph: &Graph) -> LifecycleNode<Recorder> {
    let node = graph.node(NodeSettings::new("recorder")).unwrap();
    LifecycleNode::new(node.actor(Recorder::default())).unwrap()
}

#[test]
fn a_lifecycle_node_runs_the_callback_of_each_transition() {
    let graph = Graph::new();
    let node = recorder(&graph);
    assert!(!node.node().is_active());
    node.start();
    graph.settle();
    assert!(node.node().is_active() && node.lifecycle().is_active());
    // A transition without a callback succeeds; a shutdown cleans up.
    for transition in [Transition::Deactivate, Transition::Activate, Transition::Shutdown] {
        node.lifecycle().change(transition);
        graph.settle();
    }
    assert!(!node.node().is_active());
    assert_eq!(node.lifecycle().state(), LifecycleState::Finalized);
    let calls = node.with(|recorder| std::mem::take(&mut recorder.calls));
    let all = ["configure", "activate", "activate", "cleanup"];
    assert_eq!(calls, all.map(|call| (call, false)), "it is active between transitions only");
}

#[test]
fn a_lifecycle_node_cleans_up_after_an_error() {
    let graph = Graph::new();
    let node = recorder(&graph);
    node.lifecycle().change(Transition::Configure);
    graph.settle();
    node.with(|recorder| recorder.outcome = Some(StepOutcome::Error));
    node.lifecycle().change(Transition::Activate);
    graph.settle();
    assert_eq!(node.lifecycle().state(), LifecycleState::Unconfigured);
    let calls: Vec<_> = node.with(|it| it.calls.iter().map(|it| it.0).collect());
    assert_eq!(calls, ["configure", "activate", "cleanup"]);
}

#[test]
fn a_node_has_one_lifecycle_and_others_are_always_active() {
    let graph = Graph::new();
    let plain = graph.node(NodeSettings::new("plain")).unwrap();
    assert!(plain.is_active(), "not managed");
    let managed = recorder(&graph);
    let again = LifecycleNode::new(managed.node().actor(Recorder::default()));
    assert!(again.is_err());
    managed.start();
    graph.settle();
    assert!(managed.node().is_active(), "the first lifecycle stays");
}
