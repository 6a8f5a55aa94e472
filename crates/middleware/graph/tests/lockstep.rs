//! Time and the order of events.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use std::sync::{Arc, Mutex};

use periplus_graph::{Actor, CallError, Graph, NodeSettings, Publisher, Qos};
use periplus_msgs::std_msgs::Int32;
use periplus_msgs::std_srvs::{SetBool, SetBoolRequest, SetBoolResponse, Trigger, TriggerResponse};

type Notes = Arc<Mutex<Vec<String>>>;

fn number(data: i32) -> Int32 {
    Int32 { data }
}

/// A node that records the messages it receives and the ticks of its timer of `period_ns`.
fn noter(graph: &Graph, name: &'static str, period_ns: i64, notes: &Notes) -> Actor<Notes> {
    let mut actor = graph.node(NodeSettings::new(name)).unwrap().actor(notes.clone());
    actor
        .subscribe("x", Qos::reliable(10), move |notes, message: Arc<Int32>, io| {
            notes.lock().unwrap().push(format!("{} {name} x{}", io.now_ns(), message.data));
        })
        .unwrap();
    actor
        .timer(period_ns, move |notes, io| {
            notes.lock().unwrap().push(format!("{} {name} tick", io.now_ns()));
        })
        .unwrap();
    actor
}

#[test]
fn things_happen_by_time_then_node_then_topic() {
    for order in [["a", "b"], ["b", "a"]] {
        let graph = Graph::new();
        let notes = Notes::default();
        let _actors: Vec<_> = order
            .iter()
            .map(|name| noter(&graph, name, if *name == "a" { 10 } else { 5 }, &notes))
            .collect();
        let outside = graph.node(NodeSettings::new("outside")).unwrap();
        let x = outside.publisher::<Int32>("x", Qos::reliable(1)).unwrap();
        graph.advance_to(7);
        x.publish(number(1));
        x.publish(number(2));
        graph.advance_to(10);
        assert_eq!(
            *notes.lock().unwrap(),
            ["5 b tick", "7 a x1", "7 a x2", "7 b x1", "7 b x2", "10 a tick", "10 b tick"]
        );
    }
}

#[test]
fn reactions_come_before_time_moves() {
    let graph = Graph::new();
    let notes = Notes::default();
    let source = graph.node(NodeSettings::new("source")).unwrap();
    let x = source.publisher::<Int32>("x", Qos::default()).unwrap();
    let mut source = source.actor(0);
    source
        .timer(10, move |count, _| {
            *count += 1;
            x.publish(number(*count));
        })
        .unwrap();
    let _listener = noter(&graph, "listener", 1000, &notes);
    graph.advance_to(35);
    assert_eq!(*notes.lock().unwrap(), ["10 listener x1", "20 listener x2", "30 listener x3"]);
    assert_eq!(source.with(|count| *count), 3);
    drop(source);
    graph.advance_to(100);
    assert_eq!(notes.lock().unwrap().len(), 3);
}

#[test]
fn a_circle_is_broken_and_named() {
    let graph = Graph::new();
    graph.limit_reactions(1000);
    let echo = |name: &str, from: &str, to: &str| {
        let node = graph.node(NodeSettings::new(name)).unwrap();
        let publisher: Publisher<Int32> = node.publisher(to, Qos::default()).unwrap();
        let mut actor = node.actor(0);
        actor
            .subscribe(from, Qos::default(), move |count, message: Arc<Int32>, _| {
                *count += 1;
                publisher.publish(number(message.data + 1));
            })
            .unwrap();
        actor
    };
    let ping = echo("ping", "x", "y");
    let _pong = echo("pong", "y", "x");
    let start = graph.node(NodeSettings::new("start")).unwrap();
    start.publisher("x", Qos::default()).unwrap().publish(number(0));
    graph.advance_to(1_000_000_000);
    assert_eq!(graph.now_ns(), 1_000_000_000);
    let count = ping.with(|count| *count);
    assert!((500..600).contains(&count), "{count}");
    let findings = graph.take_findings();
    let finding = findings.iter().next().unwrap();
    assert_eq!(
        finding.message,
        "at 0 s nodes react to each other in an endless loop; their messages were dropped: \
         `/ping` reacts to `/x`, `/pong` reacts to `/y`"
    );
    // The graph runs on afterwards.
    graph.advance_to(2_000_000_000);
    assert_eq!(ping.with(|count| *count), count);
}

#[test]
fn a_reset_starts_timers_anew() {
    let graph = Graph::new();
    let notes = Notes::default();
    let mut a = noter(&graph, "a", 10, &notes);
    a.on_jump(|notes, io| notes.lock().unwrap().push(format!("{} jump", io.now_ns())));
    graph.advance_to(25);
    graph.advance_to(0);
    assert_eq!(graph.now_ns(), 0);
    graph.advance_to(12);
    assert_eq!(*notes.lock().unwrap(), ["10 a tick", "20 a tick", "0 jump", "10 a tick"]);
}

#[test]
fn time_stands_still_while_paused_and_messages_flow() {
    let graph = Graph::new();
    let notes = Notes::default();
    let _a = noter(&graph, "a", 10, &notes);
    let outside = graph.node(NodeSettings::new("outside")).unwrap();
    let x = outside.publisher::<Int32>("x", Qos::reliable(1)).unwrap();
    graph.set_paused(true);
    x.publish(number(1));
    graph.advance_to(20);
    assert_eq!(graph.now_ns(), 0);
    graph.set_paused(false);
    graph.advance_to(20);
    assert_eq!(*notes.lock().unwrap(), ["0 a x1", "10 a tick", "20 a tick"]);
}

#[test]
fn calls_are_polled() {
    let graph = Graph::new();
    let a = graph.node(NodeSettings::new("a")).unwrap();
    let b = graph.node(NodeSettings::new("b")).unwrap();
    let client = a.client::<SetBool>("light").unwrap();
    let lost = client.call(SetBoolRequest { data: true });
    let error = lost.take().unwrap().unwrap_err();
    assert_eq!(error.to_string(), "no server for the service `/light`");
    let _other = b.server::<SetBool>("lihgt").unwrap();
    let error = client.call(SetBoolRequest { data: true }).take().unwrap().unwrap_err();
    assert!(error.to_string().ends_with("did you mean `/lihgt`?"));

    let calls = b.server::<SetBool>("light").unwrap();
    let pending = client.call(SetBoolRequest { data: true });
    assert!(pending.take().is_none());
    let call = calls.take().unwrap();
    assert!(call.request.data);
    call.answer(SetBoolResponse { success: true, message: "on".into() });
    assert_eq!(pending.take().unwrap().unwrap().message, "on");
    assert!(pending.take().is_none());

    let pending = client.call(SetBoolRequest { data: true });
    drop(calls.take());
    assert!(matches!(pending.take(), Some(Err(CallError::Unanswered { .. }))));
    let pending = client.call(SetBoolRequest { data: true });
    drop(calls);
    assert!(matches!(pending.take(), Some(Err(CallError::Unanswered { .. }))));
}

#[test]
fn calls_between_actors_are_answered_in_the_same_instant() {
    let graph = Graph::new();
    let mut server = graph.node(NodeSettings::new("server")).unwrap().actor(0);
    server
        .serve::<Trigger>("~/count", |count, _, _| {
            *count += 1;
            TriggerResponse { success: true, message: count.to_string() }
        })
        .unwrap();
    let node = graph.node(NodeSettings::new("caller")).unwrap();
    let client = node.client::<Trigger>("/server/count").unwrap();
    let mut caller = node.actor(Vec::new());
    caller
        .timer(10, move |_, io| {
            io.call(&client, Default::default(), |answers: &mut Vec<_>, answer, io| {
                answers.push((io.now_ns(), answer.unwrap().message.clone()));
            });
        })
        .unwrap();
    graph.advance_to(20);
    assert_eq!(caller.with(std::mem::take), [(10, "1".to_owned()), (20, "2".to_owned())]);
    drop(server);
    let services = graph.services().into_iter();
    let count = services.into_iter().find(|service| !service.clients.is_empty()).unwrap();
    assert_eq!((count.server.clone(), count.clients[0].as_str()), (None, "/caller"));
}

#[test]
fn wires_pass_calls_on_as_bytes() {
    let graph = Graph::new();
    let (wire, node) =
        (graph.node(NodeSettings::new("w")).unwrap(), graph.node(NodeSettings::new("n")).unwrap());
    let mut server = node.actor(());
    server
        .serve::<SetBool>("light", |(), request, _| SetBoolResponse {
            success: request.data,
            message: String::new(),
        })
        .unwrap();
    let inward = wire.raw_client("light", "std_srvs/srv/SetBool", None).unwrap();
    let answers = Arc::new(Mutex::new(Vec::new()));
    for cdr in [vec![0, 1, 0, 0, 1], vec![0, 1]] {
        let answers = answers.clone();
        inward.call(cdr, move |answer| {
            let answer = answer.map(|answer| answer.cdr().unwrap().to_vec());
            answers.lock().unwrap().push(answer.map_err(|error| error.to_string()));
        });
    }
    graph.settle();
    let answers = std::mem::take(&mut *answers.lock().unwrap());
    assert_eq!(answers[0], Ok(vec![0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0]));
    assert!(answers[1].as_ref().unwrap_err().contains("`/light` cannot be decoded"));

    let outward = wire.raw_server("far", "std_srvs/srv/SetBool", None).unwrap();
    let pending = node.client::<SetBool>("far").unwrap().call(SetBoolRequest { data: true });
    let call = outward.take().unwrap();
    assert_eq!(call.request.cdr().unwrap(), [0, 1, 0, 0, 1]);
    call.answer(answers[0].clone().unwrap());
    assert!(pending.take().unwrap().unwrap().success);
}

#[test]
fn moving_time_inside_a_callback_is_refused() {
    let graph = Graph::new();
    let mut actor = graph.node(NodeSettings::new("a")).unwrap().actor(());
    let inner = graph.clone();
    actor.timer(10, move |(), _| inner.advance_to(1000)).unwrap();
    graph.advance_to(10);
    assert_eq!(graph.now_ns(), 10);
    assert_eq!(graph.take_findings().iter().next().unwrap().code, "time-moved-twice");
}

#[test]
fn a_timer_needs_a_period() {
    let graph = Graph::new();
    let mut actor = graph.node(NodeSettings::new("a")).unwrap().actor(());
    let error = actor.timer(0, |(), _| ()).unwrap_err();
    assert_eq!(error.to_string(), "the timer of `/a` has a period of 0 ns; it must be at least 1");
}
