//! Round trips from a topic through a process to a topic, per second.
//!
//! The process is given as a command. It must publish each `std_msgs/msg/String` of `/ping` on `/pong`.
//!
//! `cargo run --release -p periplus-lockstep --example round_trips -- 20000 python3 echo.py`

#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "a benchmark")]

use std::process::Command;
use std::time::Instant;

use periplus_graph::{Graph, NodeSettings, Qos};
use periplus_lockstep::LockstepHost;
use periplus_msgs::std_msgs::String as Text;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let count: u32 = words.next().ok_or("the number of round trips is missing")?.parse()?;
    let program = words.next().ok_or("the command is missing")?;
    let graph = Graph::new();
    let host = LockstepHost::new(&graph)?;
    let link = host.expect("echo");
    let mut child = Command::new(program).args(words).env("PERIPLUS_LOCKSTEP", link).spawn()?;
    host.admit(&mut |_| matches!(child.try_wait(), Ok(None)));
    let node = graph.node(NodeSettings::new("bench"))?;
    let pings = node.publisher::<Text>("/ping", Qos::reliable(10))?;
    let pongs = node.mailbox::<Text>("/pong", Qos::reliable(10))?;
    let message = Text { data: "ping".into() };
    let mut trips = 0_u32;
    let start = Instant::now();
    for index in 1..=count {
        pings.publish(message.clone());
        graph.advance_to(i64::from(index) * 1_000_000);
        trips += u32::try_from(pongs.drain().len())?;
    }
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{trips} of {count} round trips in {seconds:.3} s: {:.0} per second",
        f64::from(trips) / seconds
    );
    drop(host);
    let _ = child.kill();
    let _ = child.wait();
    Ok(())
}
