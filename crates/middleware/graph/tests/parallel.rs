//! Namespaces that run side by side do the same on any number of threads.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use std::sync::{Arc, Barrier, Mutex};
use std::time::Duration;

use periplus_graph::{
    Actor, Graph, InterceptedMessage, Interceptor, NodeSettings, Publisher, Qos, Sample, Sink,
    TopicInfo,
};
use periplus_msgs::std_msgs::Int32;
use periplus_msgs::std_srvs::{SetBool, SetBoolRequest, SetBoolResponse};
use proptest::prelude::*;

/// Topics of three robots, of one robot with a similar name, and of all.
const TOPICS: [&str; 6] = ["/r1/x", "/r1/y", "/r2/x", "/r10/x", "/shared", "/other"];

/// A node that forwards what it receives with a smaller number, and publishes and calls from a timer.
#[derive(Clone, Debug)]
struct Plan {
    namespace: &'static str,
    hears: Vec<usize>,
    says: Vec<usize>,
    calls: usize,
    period_ns: i64,
}

fn plan() -> impl Strategy<Value = Plan> {
    let topics = || prop::collection::vec(0..TOPICS.len(), 0..3);
    let namespace = prop::sample::select(vec!["/", "/r1", "/r2", "/r10"]);
    (namespace, topics(), topics(), 0..6usize, 3..9i64).prop_map(
        |(namespace, hears, says, calls, period_ns)| Plan {
            namespace,
            hears,
            says,
            calls,
            period_ns,
        },
    )
}

type Lines = Vec<String>;

fn make(graph: &Graph, index: usize, plan: &Plan) -> Actor<Lines> {
    let settings = NodeSettings::new(format!("node{index}")).namespace(plan.namespace);
    let node = graph.node(settings).unwrap();
    let outs: Arc<[Publisher<Int32>]> = plan
        .says
        .iter()
        .map(|topic| node.publisher(TOPICS[*topic], Qos::reliable(3)).unwrap())
        .collect();
    let client = node.client::<SetBool>(&format!("/node{}/set", plan.calls)).unwrap();
    let mut actor = node.actor(Vec::new());
    for topic in &plan.hears {
        let (outs, topic) = (outs.clone(), *topic);
        let react = move |lines: &mut Lines,
                          message: Arc<Int32>,
                          io: &mut periplus_graph::Io<'_, Lines>| {
            lines.push(format!("{} {topic} {}", io.now_ns(), message.data));
            for out in outs.iter().filter(|_| message.data > 0) {
                out.publish(Int32 { data: message.data / 3 });
            }
        };
        actor.subscribe(TOPICS[topic], Qos::reliable(4), react).unwrap();
    }
    let number = i32::try_from(index).unwrap();
    actor
        .timer(plan.period_ns, move |lines, io| {
            // Time in which other threads run.
            std::thread::sleep(Duration::from_micros(20));
            lines.push(format!("{} tick", io.now_ns()));
            for out in outs.iter() {
                out.publish(Int32 { data: 9 + number });
            }
            io.call(&client, SetBoolRequest { data: true }, |lines, answer, io| {
                let answer = answer.map(|answer| answer.message.clone());
                lines.push(format!("{} answer {answer:?}", io.now_ns()));
            });
        })
        .unwrap();
    actor
        .serve::<SetBool>(&format!("/node{index}/set"), move |lines, _, _| {
            lines.push("call".into());
            SetBoolResponse { success: true, message: lines.len().to_string() }
        })
        .unwrap();
    actor
}

/// Records every message.
struct Recorder(Arc<Mutex<Lines>>);

impl Sink for Recorder {
    fn wants(&self, topic: &TopicInfo) -> bool {
        topic.type_name.ends_with("Int32")
    }

    fn take(&self, topic: &TopicInfo, sample: &Sample) {
        let data = sample.message::<Int32>().unwrap().data;
        let line = format!("{} {} {} {data}", sample.time_ns, topic.name, sample.sequence);
        self.0.lock().unwrap().push(line);
    }
}

/// Drops every third message of all topics together.
#[derive(Default)]
struct EveryThird(Mutex<u64>);

impl Interceptor for EveryThird {
    fn wants(&self, topic: &TopicInfo) -> bool {
        topic.type_name.ends_with("Int32")
    }

    fn intercept(&self, message: InterceptedMessage) {
        let mut count = self.0.lock().unwrap();
        *count += 1;
        if !count.is_multiple_of(3) {
            drop(count);
            message.forward();
        }
    }
}

/// Returns the events of 30 ns at each node, and the record.
fn run(plans: &[Plan], threads: usize, is_intercepted: bool, is_recorded: bool) -> Vec<Lines> {
    let graph = Graph::new();
    graph.run_in_parallel(&["/r10".into(), "/r2".into(), "/r1".into()], threads);
    let record = Arc::new(Mutex::new(Vec::new()));
    if is_recorded {
        graph.tap(Box::new(Recorder(record.clone())));
    }
    if is_intercepted {
        graph.set_interceptor(Some(Arc::new(EveryThird::default())));
    }
    let actors: Vec<_> =
        plans.iter().enumerate().map(|(index, plan)| make(&graph, index, plan)).collect();
    graph.advance_to(30);
    let mut lines: Vec<Lines> = actors.iter().map(|actor| actor.with(|it| it.clone())).collect();
    lines.push(record.lock().unwrap().clone());
    lines
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_number_of_threads_does_the_same(
        plans in prop::collection::vec(plan(), 1..6),
        is_intercepted in any::<bool>(),
    ) {
        let one = run(&plans, 1, is_intercepted, true);
        for threads in [2, 8] {
            prop_assert_eq!(&run(&plans, threads, is_intercepted, true), &one);
        }
        // To be recorded changes nothing, except for an interceptor, which sees what is only recorded.
        if !is_intercepted {
            let mut quiet = run(&plans, 2, false, false);
            quiet.pop();
            prop_assert_eq!(&quiet[..], &one[..plans.len()]);
        }
    }
}

/// Each of two callbacks waits until the other one runs, too.
#[test]
fn nodes_of_two_namespaces_run_at_the_same_time() {
    let graph = Graph::new();
    graph.run_in_parallel(&["/a".into(), "/b".into()], 2);
    let both = Arc::new(Barrier::new(2));
    let actors: Vec<_> = ["/a", "/b"]
        .map(|namespace| {
            let node = graph.node(NodeSettings::new("node").namespace(namespace)).unwrap();
            let (mut actor, both) = (node.actor(0), both.clone());
            actor
                .timer(10, move |count, _| {
                    both.wait();
                    *count += 1;
                })
                .unwrap();
            actor
        })
        .into();
    graph.advance_to(30);
    assert!(actors.iter().all(|actor| actor.with(|count| *count) == 3));
}

/// Nodes outside run before; a message to all arrives at the same time, after all have run.
#[test]
fn messages_beyond_a_namespace_wait_until_all_have_run() {
    let graph = Graph::new();
    graph.run_in_parallel(&["/a".into(), "/b".into()], 1);
    let plan = |namespace, hears: &[usize], says: &[usize]| Plan {
        namespace,
        hears: hears.to_vec(),
        says: says.to_vec(),
        calls: 9,
        period_ns: 1000,
    };
    let shared = TOPICS.iter().position(|topic| *topic == "/shared").unwrap();
    let other = TOPICS.iter().position(|topic| *topic == "/other").unwrap();
    let forwards = [
        make(&graph, 0, &plan("/a", &[shared], &[other])),
        make(&graph, 1, &plan("/b", &[shared], &[other])),
    ];
    let listens = make(&graph, 2, &plan("/", &[other], &[]));
    let outside = graph.node(NodeSettings::new("outside")).unwrap();
    let publisher = outside.publisher::<Int32>("/shared", Qos::reliable(4)).unwrap();
    publisher.publish(Int32 { data: 30 });
    publisher.publish(Int32 { data: 60 });
    graph.settle();
    for actor in &forwards {
        assert_eq!(
            actor.with(|it| it.clone()),
            [format!("0 {shared} 30"), format!("0 {shared} 60")]
        );
    }
    let numbers = [10, 20, 10, 20].map(|data| format!("0 {other} {data}"));
    assert_eq!(listens.with(|it| it.clone()), numbers);
}

/// A panic of a node ends the program in lockstep, on whatever thread the node ran.
#[test]
fn a_panic_reaches_the_caller() {
    let graph = Graph::new();
    graph.run_in_parallel(&["/a".into(), "/b".into()], 2);
    let actors = ["/a", "/b"].map(|namespace| {
        let node = graph.node(NodeSettings::new("node").namespace(namespace)).unwrap();
        let mut actor = node.actor(());
        actor.timer(10, move |(), _| assert!(namespace != "/b", "as expected")).unwrap();
        actor
    });
    let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| graph.advance_to(10)));
    assert!(outcome.is_err());
    drop(actors);
}
