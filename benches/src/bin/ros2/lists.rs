//! Lists of nodes, services and parameters of rclpy nodes: how many of them are complete.

use std::fmt::Write as _;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::Setup;
use crate::process::{Running, command, median, output, quantile};

/// Numbers of rclpy nodes, each with its own participant.
const NODES: [usize; 2] = [5, 55];

/// Processes that keep a core busy for the load of ten.
const BUSY: usize = 10;

/// Tries of each command.
const TRIES: usize = 50;

/// The nodes start one after the other, under load slowly.
const PATIENCE: Duration = Duration::from_secs(300);

/// A command, and a test for the completeness of its output with N nodes.
type List = (&'static str, &'static [&'static str], fn(&str, usize) -> bool);

const LISTS: [List; 4] = [
    ("node list", &["node", "list"], |text, count| {
        text.lines().count() == count && (0..count).all(|it| has_line(text, &format!("/n{it}")))
    }),
    ("service list", &["service", "list"], |text, count| {
        (0..count).all(|it| {
            has_line(text, &format!("/n{it}/trigger"))
                && has_line(text, &format!("/n{it}/list_parameters"))
        })
    }),
    ("topic info -v", &["topic", "info", "-v", "/chatter"], |text, count| {
        (0..count).all(|it| has_line(text, &format!("Node name: n{it}")))
            && has_line(text, &format!("Publisher count: {count}"))
    }),
    ("param list", &["param", "list"], |text, count| {
        (0..count).all(|it| has_line(text, &format!("/n{it}:")))
            && text.lines().filter(|line| line.trim() == "number").count() == count
    }),
];

fn has_line(text: &str, wanted: &str) -> bool {
    text.lines().any(|line| line == wanted)
}

/// Runs all lists, at rest and beside a load of ten; returns a table in Markdown.
pub(crate) fn measure(setup: &Setup) -> Result<String, String> {
    let tries = if setup.is_quick { 3 } else { TRIES };
    let mut table = String::from(
        "| nodes of rclpy | beside | command | right | time p50, slowest \\[s\\] |\n\
         |---|---|---|---|---|\n",
    );
    let mut domain_id = 191;
    for count in NODES {
        domain_id += 1;
        let peer = setup.peer.to_string_lossy();
        let words = [&*peer, "nodes", &count.to_string(), "n"];
        let nodes = Running::start(&mut command(&setup.python, domain_id, &words))?;
        nodes.expect("ready", PATIENCE)?;
        for is_busy in [false, true] {
            let busy = (0..if is_busy { BUSY } else { 0 })
                .map(|_| Running::start(Command::new(&setup.own).arg("busy")))
                .collect::<Result<Vec<_>, _>>()?;
            let beside = if is_busy { "ten busy processes" } else { "nothing" };
            for (name, words, is_right) in LISTS {
                eprintln!("{name} with {count} nodes beside {beside}");
                let (mut right, mut spent_s) = (0, Vec::new());
                for _ in 0..tries {
                    let start = Instant::now();
                    let result = output(&mut command(&setup.periplus, domain_id, words))?;
                    spent_s.push(start.elapsed().as_secs_f64());
                    let text = String::from_utf8_lossy(&result.stdout);
                    let is_whole = result.status.success() && is_right(&text, count);
                    right += usize::from(is_whole);
                    if !is_whole {
                        let errors = String::from_utf8_lossy(&result.stderr);
                        eprintln!("not right: {} lines; {errors}", text.lines().count());
                    }
                }
                let _ = writeln!(
                    table,
                    "| {count} | {beside} | `{name}` | {right} of {tries} | {:.2}, {:.2} |",
                    median(&spent_s),
                    quantile(&spent_s, 1.0),
                );
            }
            drop(busy);
        }
    }
    Ok(table)
}

/// Keeps a core busy until it is killed.
pub(crate) fn busy() -> ! {
    let mut number = 1_u64;
    loop {
        number =
            std::hint::black_box(number.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1));
    }
}
