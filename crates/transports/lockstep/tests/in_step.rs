//! A graph with processes in step; threads stand for the processes.

use std::io;
use std::sync::mpsc;
use std::thread::{JoinHandle, spawn};

use periplus_graph::{Graph, NodeSettings, Qos};
use periplus_lockstep::{LockstepClient, LockstepHost, NodeWords};
use periplus_msgs::Message as _;
use periplus_msgs::std_msgs::String as Text;
use periplus_msgs::std_srvs::{Trigger, TriggerRequest, TriggerResponse};

const TEXT: &str = "std_msgs/msg/String";
const TRIGGER: &str = "std_srvs/srv/Trigger";
const SECOND_NS: i64 = 1_000_000_000;

fn words(name: &str) -> NodeWords {
    NodeWords { name: name.into(), namespace: String::new() }
}

/// Starts a process that ends when the graph has gone.
fn process(
    host: &LockstepHost,
    label: &str,
    work: impl FnOnce(&LockstepClient) -> io::Result<()> + Send + 'static,
) -> JoinHandle<io::Result<()>> {
    let link = host.expect(label);
    spawn(move || work(&LockstepClient::connect(&link)?))
}

/// Publishes what comes on `/ping` on `/pong`, until the graph has gone.
fn echo(client: &LockstepClient) -> io::Result<()> {
    let node = client.node(&words("echo"))?;
    let pong = client.publisher(node, "/pong", TEXT, None, Qos::reliable(10))?;
    let (_, pings) = client.subscription(node, "/ping", TEXT, None, Qos::reliable(10))?;
    loop {
        client.wait(None, true)?;
        while let Some(ping) = pings.take() {
            client.publish(pong, &ping.cdr)?;
        }
    }
}

#[test]
fn answers_come_at_the_time_of_their_questions() {
    let graph = Graph::new();
    let host = LockstepHost::new(&graph).expect("a socket");
    let _echo = process(&host, "echo", echo);
    host.admit(&mut |_| true);
    let node = graph.node(NodeSettings::new("caller")).expect("a free name");
    let pings = node.publisher::<Text>("/ping", Qos::reliable(10)).expect("a topic");
    let pongs = node.mailbox::<Text>("/pong", Qos::reliable(10)).expect("a topic");
    for second in 1..=3 {
        graph.advance_to(second * SECOND_NS);
        pings.publish(Text { data: second.to_string() });
        graph.settle();
    }
    graph.advance_to(10 * SECOND_NS);
    let heard: Vec<(i64, String)> = pongs
        .drain_samples()
        .into_iter()
        .map(|(sample, text)| (sample.time_ns / SECOND_NS, text.data.clone()))
        .collect();
    assert_eq!(heard, [(1, "1".into()), (2, "2".into()), (3, "3".into())]);
}

#[test]
fn a_process_that_sleeps_gets_its_messages_when_it_wakes() {
    let graph = Graph::new();
    let host = LockstepHost::new(&graph).expect("a socket");
    let (tell, told) = mpsc::channel();
    let _sleeper = process(&host, "sleeper", move |client| {
        let node = client.node(&words("sleeper"))?;
        let (_, inbox) = client.subscription(node, "/ping", TEXT, None, Qos::reliable(10))?;
        client.wait(Some(5 * SECOND_NS), false)?;
        let received = inbox.take().map(|it| it.time_ns);
        tell.send((client.now_ns(), received)).map_err(io::Error::other)?;
        client.wait(None, true)
    });
    host.admit(&mut |_| true);
    let node = graph.node(NodeSettings::new("caller")).expect("a free name");
    let pings = node.publisher::<Text>("/ping", Qos::reliable(10)).expect("a topic");
    graph.advance_to(2 * SECOND_NS);
    pings.publish(Text::default());
    graph.advance_to(4 * SECOND_NS);
    assert!(told.try_recv().is_err());
    graph.advance_to(6 * SECOND_NS);
    assert_eq!(told.recv(), Ok((5 * SECOND_NS, Some(2 * SECOND_NS))));
}

#[test]
fn services_work_in_both_directions() {
    let graph = Graph::new();
    let host = LockstepHost::new(&graph).expect("a socket");
    let node = graph.node(NodeSettings::new("own")).expect("a free name");
    let own = node.server::<Trigger>("/own").expect("a service");
    let (tell, told) = mpsc::channel();
    let _process = process(&host, "both", move |client| {
        let node = client.node(&words("both"))?;
        let (_, requests) = client.server(node, "/theirs", TRIGGER, None)?;
        let (caller, responses) = client.client(node, "/own", TRIGGER, None)?;
        assert_eq!(client.matched(caller)?, 1);
        let request = TriggerRequest::default().to_cdr().map_err(io::Error::other)?;
        let number = client.call(caller, &request)?;
        loop {
            client.wait(None, true)?;
            while let Some(response) = responses.take() {
                tell.send((number, response.number)).map_err(io::Error::other)?;
            }
            while let Some(request) = requests.take() {
                let response = TriggerResponse { success: true, message: "done".into() };
                let cdr = response.to_cdr().map_err(io::Error::other)?;
                client.answer(request.number, Some(&cdr))?;
            }
        }
    });
    host.admit(&mut |_| true);
    own.take().expect("the request of the process").answer(TriggerResponse::default());
    graph.advance_to(SECOND_NS);
    let (asked, answered) = told.recv().expect("a response");
    assert_eq!(asked, answered);
    let client = node.client::<Trigger>("/theirs").expect("a service");
    let pending = client.call(TriggerRequest::default());
    graph.advance_to(2 * SECOND_NS);
    let response = pending.take().expect("an answer").expect("a response");
    assert_eq!((response.success, response.message.as_str()), (true, "done"));
}

#[test]
fn a_process_that_ends_leaves_the_graph() {
    let graph = Graph::new();
    let host = LockstepHost::new(&graph).expect("a socket");
    let process = process(&host, "short", |client| {
        let node = client.node(&words("short"))?;
        client.publisher(node, "/chatter", TEXT, None, Qos::reliable(1))?;
        client.wait(Some(SECOND_NS), false)
    });
    host.admit(&mut |_| true);
    assert_eq!((host.running(), host.is_gone("short")), (1, false));
    graph.advance_to(2 * SECOND_NS);
    process.join().expect("a thread").expect("a connection");
    assert_eq!((host.running(), host.is_gone("short")), (0, true));
    assert!(graph.nodes().iter().all(|node| node.name != "/short"));
    assert!(host.take_findings().is_empty());
}

#[test]
fn a_process_that_does_not_start_is_not_waited_for() {
    let graph = Graph::new();
    let host = LockstepHost::new(&graph).expect("a socket");
    let _link = host.expect("broken");
    host.admit(&mut |_| false);
    assert_eq!(host.running(), 0);
}

#[test]
fn wrong_names_and_types_are_errors_of_the_process() {
    let graph = Graph::new();
    let host = LockstepHost::new(&graph).expect("a socket");
    let own = graph.node(NodeSettings::new("own")).expect("a free name");
    let _own = own.publisher::<Text>("/chatter", Qos::reliable(1)).expect("a topic");
    let (tell, told) = mpsc::channel();
    let _process = process(&host, "wrong", move |client| {
        let name = client.node(&words("1 wrong")).expect_err("not a name").to_string();
        let node = client.node(&words("right"))?;
        let of = client.publisher(node, "/chatter", "std_msgs/msg/Bool", None, Qos::reliable(1));
        tell.send((name, of.expect_err("another type").to_string())).map_err(io::Error::other)?;
        client.wait(None, true)
    });
    host.admit(&mut |_| true);
    let (name, of) = told.recv().expect("two errors");
    assert!(name.contains("1 wrong"), "{name}");
    assert!(of.contains("std_msgs/msg/Bool") && of.contains("std_msgs/msg/String"), "{of}");
}

#[test]
fn a_process_whose_graph_has_gone_is_alone() {
    let graph = Graph::new();
    let host = LockstepHost::new(&graph).expect("a socket");
    let process = process(&host, "last", |client| {
        let node = client.node(&words("last"))?;
        let chatter = client.publisher(node, "/chatter", TEXT, None, Qos::reliable(1))?;
        client.wait(None, true).expect_err("the graph goes");
        assert_eq!(
            (client.matched(chatter)?, client.topics()?, client.nodes()?),
            (0, vec![], vec![])
        );
        assert!(
            client.endpoints("/chatter", true)?.is_empty() && client.events(chatter)?.is_empty()
        );
        let (_, inbox) = client.subscription(node, "/late", TEXT, None, Qos::reliable(1))?;
        client.publish(chatter, &vec![0; 1 << 20])?;
        assert!(inbox.take().is_none());
        client.wait(None, true).map(|()| unreachable!()).or(Ok(()))
    });
    host.admit(&mut |_| true);
    drop((host, graph));
    process.join().expect("a thread").expect("answers of nobody");
}
