//! Goals from clients to servers.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use periplus_graph::{
    ActionClient, ActionServer, ActionSettings, DynamicProgress, GoalEvent, GoalHandle, GoalId,
    GoalProgress, GoalState, Graph, Node, NodeSettings, SentGoal,
};
use periplus_msgs::TypeRegistry;
use periplus_msgs::action_msgs::CancelGoalResponse;
use periplus_msgs::example_interfaces::{
    Fibonacci, FibonacciFeedback, FibonacciGoal, FibonacciResult,
};
use proptest::prelude::*;

struct Pair {
    graph: Graph,
    user: Node,
    server: ActionServer<Fibonacci>,
    client: ActionClient<Fibonacci>,
}

impl Pair {
    fn new() -> Self {
        let graph = Graph::new();
        let worker = graph.node(NodeSettings::new("worker")).unwrap();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let server = worker.action_server("fibonacci", ActionSettings::default()).unwrap();
        let client = user.action_client("fibonacci").unwrap();
        Self { graph, user, server, client }
    }

    fn send(&self, order: i32) -> SentGoal<Fibonacci> {
        let sent = self.client.send(FibonacciGoal { order });
        self.graph.settle();
        sent
    }

    fn begin(&self, order: i32) -> (SentGoal<Fibonacci>, GoalHandle<Fibonacci>) {
        let sent = self.send(order);
        let handle = self.server.take().unwrap().accept().unwrap();
        assert!(handle.execute());
        (sent, handle)
    }

    fn look(&self, sent: &SentGoal<Fibonacci>) -> GoalProgress<FibonacciResult> {
        // The first call requests the result, the second returns it.
        let _ = sent.look();
        self.graph.settle();
        sent.look()
    }

    fn cancel(&self, id: GoalId) -> CancelGoalResponse {
        let asked = self.client.cancel(id);
        self.graph.settle();
        (*asked.take().unwrap().unwrap()).clone()
    }
}

fn result(sequence: &[i32]) -> FibonacciResult {
    FibonacciResult { sequence: sequence.to_vec() }
}

#[test]
fn a_goal_goes_its_way() {
    let pair = Pair::new();
    assert!(pair.client.is_ready());
    let (sent, handle) = pair.begin(3);
    assert_eq!(handle.goal().order, 3);
    assert_eq!(handle.id(), sent.id());
    assert_eq!(pair.look(&sent), GoalProgress::Accepted);
    assert_eq!(pair.client.states().unwrap(), [(sent.id(), GoalState::Executing)]);
    handle.feedback(FibonacciFeedback { sequence: vec![0, 1] });
    let told = pair.client.feedback();
    assert_eq!((told[0].0, told[0].1.sequence.as_slice()), (sent.id(), &[0, 1][..]));
    assert!(!handle.canceled(result(&[])), "nobody asked");
    assert!(handle.succeed(result(&[0, 1, 1])));
    assert!(!handle.abort(result(&[])), "it is over");
    let expected = GoalProgress::Over(GoalState::Succeeded, result(&[0, 1, 1]).into());
    assert_eq!(pair.look(&sent), expected);
    assert_eq!(pair.client.states().unwrap(), [(sent.id(), GoalState::Succeeded)]);
    let info = &pair.graph.actions()[0];
    assert_eq!((info.name.as_str(), info.servers[0].as_str()), ("/fibonacci", "/worker"));
    assert_eq!(info.type_name, "example_interfaces/action/Fibonacci");
    assert_eq!(info.clients, ["/user"]);
}

#[test]
fn goals_are_refused_stopped_and_dropped() {
    let pair = Pair::new();
    let refused = pair.send(1);
    pair.server.take().unwrap().reject();
    assert_eq!(pair.look(&refused), GoalProgress::Rejected);

    let (sent, handle) = pair.begin(2);
    let answer = pair.cancel(sent.id());
    assert_eq!((answer.return_code, answer.goals_canceling.len()), (0, 1));
    assert!(handle.is_canceling());
    assert_eq!(pair.cancel(sent.id()).return_code, CancelGoalResponse::ERROR_GOAL_TERMINATED);
    assert!(handle.canceled(result(&[7])));
    let expected = GoalProgress::Over(GoalState::Canceled, result(&[7]).into());
    assert_eq!(pair.look(&sent), expected);

    let (sent, handle) = pair.begin(3);
    drop(handle);
    let expected = GoalProgress::Over(GoalState::Canceled, result(&[]).into());
    assert_eq!(pair.look(&sent), expected);
    let unknown = pair.cancel(GoalId([9; 16]));
    assert_eq!(unknown.return_code, CancelGoalResponse::ERROR_UNKNOWN_GOAL_ID);
}

#[test]
fn results_are_forgotten_after_a_time() {
    let pair = Pair::new();
    let (sent, handle) = pair.begin(1);
    assert!(handle.abort(result(&[4])));
    pair.graph.advance_to(9_000_000_000);
    let (late, _handle) = pair.begin(1);
    assert_eq!(pair.client.states().unwrap().len(), 2);
    pair.graph.advance_to(11_000_000_000);
    assert_eq!(pair.look(&sent), GoalProgress::Over(GoalState::Unknown, result(&[]).into()));
    let (_newer, _work) = pair.begin(1);
    let states = pair.client.states().unwrap();
    assert_eq!((states.len(), states[0].0), (2, late.id()));
}

#[test]
fn who_works_may_refuse_to_stop() {
    let graph = Graph::new();
    let mut worker = graph.node(NodeSettings::new("worker")).unwrap().actor(Vec::new());
    worker
        .serve_action::<Fibonacci>(
            "fibonacci",
            ActionSettings::default(),
            |work, goal, _| {
                if goal.goal().order < 0 {
                    return goal.reject();
                }
                work.extend(goal.accept());
            },
            |work, id, _| work.iter().any(|one| one.id() == id && one.goal().order != 5),
        )
        .unwrap();
    let user = graph.node(NodeSettings::new("user")).unwrap();
    let client = user.action_client::<Fibonacci>("fibonacci").unwrap();
    let sent: Vec<_> =
        [5, -1, 6].map(|order| client.send(FibonacciGoal { order })).into_iter().collect();
    graph.settle();
    assert_eq!(sent[1].look(), GoalProgress::Rejected);
    let one = client.cancel(sent[0].id());
    let all = client.cancel_all();
    graph.settle();
    assert_eq!(one.take().unwrap().unwrap().return_code, CancelGoalResponse::ERROR_REJECTED);
    let canceling = &all.take().unwrap().unwrap().goals_canceling;
    assert_eq!(canceling.len(), 1);
    assert_eq!(GoalId::from(&canceling[0].goal_id), sent[2].id());
    drop(worker);
    let _ = (sent[0].look(), graph.settle());
    assert!(matches!(sent[0].look(), GoalProgress::Failed(_) | GoalProgress::Over(..)));
}

#[test]
fn goals_are_sent_by_the_name_of_their_type() {
    let pair = Pair::new();
    let types = TypeRegistry::builtin();
    let name = "example_interfaces/action/Fibonacci";
    let client = pair.user.dynamic_action_client("fibonacci", name, types).unwrap();
    let wrong = client.send(&serde_json::json!({ "ordre": 3 }));
    assert!(wrong.is_err());
    let sent = client.send(&serde_json::json!({ "order": 3 })).unwrap();
    pair.graph.settle();
    assert_eq!(sent.look(), DynamicProgress::Sent);
    let handle = pair.server.take().unwrap().accept().unwrap();
    assert!(handle.execute());
    pair.graph.settle();
    assert_eq!(sent.look(), DynamicProgress::Accepted);
    handle.feedback(FibonacciFeedback { sequence: vec![0, 1] });
    let (id, told) = client.feedback().remove(0);
    assert_eq!(id, sent.id());
    assert_eq!(told.to_json()["feedback"]["sequence"], serde_json::json!([0, 1]));
    assert!(handle.succeed(result(&[0, 1, 1])));
    pair.graph.settle();
    let DynamicProgress::Over(state, answer) = sent.look() else { panic!("it is over") };
    assert_eq!(state, GoalState::Succeeded);
    assert_eq!(answer.to_json()["result"]["sequence"], serde_json::json!([0, 1, 1]));
    let unknown = pair.user.dynamic_action_client("f", "example_interfaces/action/Fibonaci", types);
    let told = unknown.err().unwrap().to_string();
    assert!(told.contains("did you mean `example_interfaces/action/Fibonacci`?"), "{told}");
}

#[test]
fn ids_are_made_of_random_bits_and_come_again() {
    let ids = || {
        let pair = Pair::new();
        [pair.send(1).id(), pair.send(2).id()]
    };
    let [a, b] = ids();
    assert_ne!(a, b);
    assert_eq!(ids(), [a, b]);
    assert_eq!((a.0[6] >> 4, a.0[8] >> 6), (4, 2));
    assert_eq!(a.to_string().len(), 32);
}

#[derive(Clone, Copy, Debug)]
enum Act {
    Send,
    Accept,
    Do(usize, GoalEvent),
    Ask(usize),
    Wait(i64),
}

fn act() -> impl Strategy<Value = Act> {
    let event = prop::sample::select(vec![
        GoalEvent::Execute,
        GoalEvent::Cancel,
        GoalEvent::Succeed,
        GoalEvent::Abort,
        GoalEvent::Canceled,
    ]);
    prop_oneof![
        Just(Act::Send),
        Just(Act::Accept),
        (0..4usize, event).prop_map(|(goal, event)| Act::Do(goal, event)),
        (0..4usize).prop_map(Act::Ask),
        (1..6i64).prop_map(Act::Wait),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// For any sequence of events, goals change only along the state machine, the published states
    /// match, and each result is sent once it exists.
    #[test]
    fn goals_keep_to_their_states(acts in prop::collection::vec(act(), 1..40)) {
        let pair = Pair::new();
        let mut sent: Vec<SentGoal<Fibonacci>> = Vec::new();
        let mut handles: Vec<(GoalHandle<Fibonacci>, GoalState)> = Vec::new();
        let mut now_ns = 0;
        for act in acts {
            match act {
                Act::Send => sent.push(pair.send(1)),
                Act::Accept => {
                    if let Some(goal) = pair.server.take() {
                        handles.push((goal.accept().unwrap(), GoalState::Accepted));
                    }
                }
                Act::Do(goal, event) => {
                    let Some((handle, state)) = handles.get_mut(goal) else { continue };
                    let done = match event {
                        GoalEvent::Execute => handle.execute(),
                        GoalEvent::Cancel => pair.cancel(handle.id()).return_code == 0,
                        GoalEvent::Succeed => handle.succeed(result(&[1])),
                        GoalEvent::Abort => handle.abort(result(&[2])),
                        GoalEvent::Canceled => handle.canceled(result(&[3])),
                    };
                    prop_assert_eq!(done, state.after(event).is_some());
                    *state = state.after(event).unwrap_or(*state);
                }
                Act::Ask(goal) => {
                    let Some((handle, state)) = handles.get(goal) else { continue };
                    let one = sent.iter().find(|one| one.id() == handle.id()).unwrap();
                    match pair.look(one) {
                        GoalProgress::Accepted => prop_assert!(!state.is_over()),
                        GoalProgress::Over(GoalState::Unknown, _) => prop_assert!(state.is_over()),
                        GoalProgress::Over(told, result) => {
                            prop_assert_eq!(told, *state);
                            prop_assert_eq!(result.sequence.len(), 1);
                        }
                        other => prop_assert!(false, "{:?}", other),
                    }
                }
                Act::Wait(seconds) => {
                    now_ns += seconds * 1_000_000_000;
                    pair.graph.advance_to(now_ns);
                }
            }
            for (handle, state) in &handles {
                let is = handle.state();
                prop_assert!(is == *state || is == GoalState::Unknown && state.is_over());
            }
        }
    }
}
