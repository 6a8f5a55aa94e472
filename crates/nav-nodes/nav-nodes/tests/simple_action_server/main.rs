//! One running goal, one pending: acceptance, preemption, cancellation and results.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

use periplus_costmap::Nav2Release;
use periplus_graph::{
    ActionSettings, Actor, Alarm, GoalProgress, GoalState, Graph, Io, NodeSettings,
};
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::nav2_msgs_main::{Wait, WaitGoal, WaitResult};
use periplus_nav_nodes::nav2_actions::{Nav2ActionClient, Nav2SentGoal};
use periplus_nav_nodes::simple_action_server::{SimpleActionServer, serve_simple_action};

/// Period of the work loop \[ns\].
const CYCLE_NS: i64 = 100_000_000;

/// Waits for the seconds of a goal, and takes over pending goals on the fly.
#[derive(Default)]
struct Waiter {
    server: SimpleActionServer<Wait>,
    started: Vec<i32>,
    cycles_left: i32,
    alarm: Option<Alarm>,
}

impl Waiter {
    fn start(&mut self, io: &Io<'_, Self>) {
        let Some(goal) = self.server.current_goal() else { return };
        self.started.push(goal.time.sec);
        self.cycles_left = goal.time.sec * 10;
        self.cycle(io);
    }

    fn cycle(&mut self, io: &Io<'_, Self>) {
        self.alarm = None;
        if self.server.is_cancel_requested() {
            self.server.terminate_all(WaitResult { error_code: 7, ..WaitResult::default() });
            return self.finish(io);
        }
        if self.server.is_preempt_requested()
            && let Some(goal) = self.server.accept_pending_goal()
        {
            self.started.push(goal.time.sec);
            self.cycles_left = goal.time.sec * 10;
        }
        if self.cycles_left == 0 {
            self.server.succeeded_current(WaitResult::default());
            return self.finish(io);
        }
        self.cycles_left -= 1;
        self.alarm = Some(io.alarm(io.now_ns() + CYCLE_NS, |state, io| state.cycle(io)));
    }

    fn finish(&mut self, io: &Io<'_, Self>) {
        if self.server.finish() {
            self.start(io);
        }
    }
}

struct Stage {
    graph: Graph,
    waiter: Actor<Waiter>,
    client: Nav2ActionClient<Wait>,
}

impl Stage {
    fn new(release: Nav2Release) -> Self {
        let graph = Graph::new();
        let mut waiter = graph.node(NodeSettings::new("waiter")).unwrap().actor(Waiter::default());
        serve_simple_action::<Wait, Waiter>(
            &mut waiter,
            release,
            "wait",
            ActionSettings::default(),
            |state| Some(&mut state.server),
            |_, goal, _| match goal.time.sec {
                0.. => Ok(()),
                _ => Err("the time is negative".to_owned()),
            },
            |state, io| state.start(io),
        )
        .unwrap();
        waiter.with(|state| state.server.activate());
        let node = graph.node(NodeSettings::new("client")).unwrap();
        let client = Nav2ActionClient::new(&node, release, "wait").unwrap();
        Self { graph, waiter, client }
    }

    fn send(&self, seconds: i32) -> Nav2SentGoal<Wait> {
        let time = Duration { sec: seconds, ..Duration::default() };
        let sent = self.client.send(WaitGoal { time });
        self.graph.settle();
        // A second look sends the request for the result.
        let _ = sent.look();
        self.graph.settle();
        sent
    }

    fn run(&self, seconds: f64) {
        self.graph.advance_to(self.graph.now_ns() + (seconds * 1e9) as i64);
    }

    fn started(&self) -> Vec<i32> {
        self.waiter.with(|state| state.started.clone())
    }
}

#[track_caller]
fn check(sent: &Nav2SentGoal<Wait>, expected: GoalState) {
    match sent.look() {
        GoalProgress::Over(state, _) => assert_eq!(state, expected),
        other => panic!("{other:?}, expected {expected}"),
    }
}

#[test]
fn a_goal_is_executed() {
    for release in Nav2Release::ALL {
        let stage = Stage::new(release);
        let sent = stage.send(1);
        stage.run(0.9);
        assert_eq!(sent.look(), GoalProgress::Accepted);
        stage.run(0.1);
        check(&sent, GoalState::Succeeded);
    }
}

#[test]
fn goals_are_rejected_by_the_node_and_while_inactive() {
    let stage = Stage::new(Nav2Release::Main);
    assert_eq!(stage.send(-1).look(), GoalProgress::Rejected);
    let running = stage.send(1);
    assert!(stage.waiter.with(|state| state.server.deactivate()));
    stage.graph.settle();
    check(&running, GoalState::Aborted);
    assert_eq!(stage.send(1).look(), GoalProgress::Rejected);
    assert_eq!(stage.started(), [1]);
}

#[test]
fn a_new_goal_preempts_and_only_the_newest_is_pending() {
    let stage = Stage::new(Nav2Release::Main);
    let goals = [5, 3, 1].map(|seconds| stage.send(seconds));
    // The second one was overtaken while it was pending.
    check(&goals[1], GoalState::Aborted);
    assert_eq!(goals[0].look(), GoalProgress::Accepted);
    stage.run(0.2);
    check(&goals[0], GoalState::Aborted);
    assert_eq!(goals[2].look(), GoalProgress::Accepted);
    stage.run(1.0);
    check(&goals[2], GoalState::Succeeded);
    assert_eq!(stage.started(), [5, 1]);
}

#[test]
fn a_canceled_goal_ends_as_canceled_with_its_result() {
    let stage = Stage::new(Nav2Release::Main);
    let sent = stage.send(5);
    let _ = stage.client.cancel(sent.id());
    stage.run(0.1);
    match sent.look() {
        GoalProgress::Over(state, result) => {
            assert_eq!((state, result.error_code), (GoalState::Canceled, 7));
        }
        other => panic!("{other:?}"),
    }
    let next = stage.send(1);
    stage.run(1.0);
    check(&next, GoalState::Succeeded);
}

#[test]
fn a_pending_goal_starts_when_the_current_one_ends() {
    let stage = Stage::new(Nav2Release::Main);
    // The pending goal arrives in the last cycle.
    let first = stage.send(1);
    stage.run(0.95);
    let second = stage.send(2);
    stage.waiter.with(|state| state.server.terminate_current(WaitResult::default()));
    stage.run(0.05);
    check(&first, GoalState::Aborted);
    stage.run(2.0);
    check(&second, GoalState::Succeeded);
    assert_eq!(stage.started(), [1, 2]);
}
