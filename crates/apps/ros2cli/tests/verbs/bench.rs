//! Test bench of verbs.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use expect_test::Expect;
use periplus_graph::{Graph, Node, NodeSettings};
use periplus_ros2cli::{InGraph, Network, Outcome, Progress, Seen, Session, Types};

pub(crate) struct Bench {
    pub(crate) graph: Graph,
    pub(crate) json: bool,
    /// Include the topics and services that every node has.
    pub(crate) all: bool,
    pub(crate) types: Types,
    /// Time after which the verb is interrupted.
    pub(crate) stop_after: Option<Duration>,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self {
            graph: Graph::live(),
            json: false,
            all: false,
            types: Types::Builtin,
            stop_after: None,
        }
    }

    pub(crate) fn json(self) -> Self {
        Self { json: true, ..self }
    }

    pub(crate) fn node(&self, name: &str) -> Node {
        self.graph.node(NodeSettings::new(name).bare()).unwrap()
    }

    /// Output of a verb: results, then notes (lines with a leading `| `), then the error if it
    /// fails.
    pub(crate) fn run(&self, verb: impl FnOnce(&mut Session<'_>) -> Outcome) -> String {
        let (own, all) = (InGraph(self.graph.clone()), InGraph(self.graph.clone()));
        let quiet = Quiet(own);
        let network: &dyn Network = if self.all { &all } else { &quiet };
        let (mut out, mut talk) = (Vec::new(), Vec::new());
        let stop = AtomicBool::new(false);
        let stopping = &stop;
        let outcome = std::thread::scope(|scope| {
            if let Some(time) = self.stop_after {
                scope.spawn(move || {
                    std::thread::sleep(time);
                    stopping.store(true, Ordering::Relaxed);
                });
            }
            let mut session = Session {
                network,
                types: &self.types,
                out: &mut out,
                talk: &mut talk,
                stop: &stop,
                json: self.json,
                spin_time: Some(Duration::from_millis(20)),
            };
            verb(&mut session)
        });
        let mut text = String::from_utf8(out).unwrap();
        for line in String::from_utf8(talk).unwrap().lines() {
            text.push_str(&format!("| {line}\n"));
        }
        if let Err(failure) = outcome {
            text.push_str(&format!("! {failure}\n"));
        }
        text
    }

    pub(crate) fn check(&self, verb: impl FnOnce(&mut Session<'_>) -> Outcome, expected: Expect) {
        expected.assert_eq(&self.run(verb));
    }
}

/// Network without the topics and services that every node has, which would be in every snapshot.
struct Quiet(InGraph);

fn quiet(mut seen: Seen) -> Seen {
    seen.topics.retain(|topic| topic.name != "/rosout" && topic.name != "/parameter_events");
    seen.services.retain(|service| !service.types[0].starts_with("rcl_interfaces/"));
    seen
}

impl Network for Quiet {
    fn graph(&self) -> &Graph {
        self.0.graph()
    }

    fn seen(&self) -> Seen {
        quiet(self.0.seen())
    }

    fn progress(&self) -> Progress {
        self.0.progress()
    }

    fn wait(&self, timeout: Duration, wanted: &mut dyn FnMut(&Seen) -> bool) -> bool {
        self.0.wait(timeout, &mut |seen| wanted(&quiet(seen.clone())))
    }

    fn flush(&self, timeout: Duration) -> bool {
        self.0.flush(timeout)
    }
}
