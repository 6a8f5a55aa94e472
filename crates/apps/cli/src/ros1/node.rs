//! `periplus ros1 node`: what `rosnode` does beyond `periplus node --ros1`.

use std::collections::BTreeSet;
use std::io::{self, BufRead as _, Write as _};
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Subcommand;
use periplus_os::{Stopwatch, sleep};
use periplus_ros1::{MasterClient, RpcError, SystemState, ask};
use periplus_session::stop;

use super::{CALLER, client, failed, full};
use crate::error::CliError;
use crate::terminal;

/// Timeout of a call to a node.
const PATIENCE: Duration = Duration::from_secs(3);

/// Pause between two calls of `ping`.
const PING_PERIOD: Duration = Duration::from_secs(1);

/// Call nodes of ROS 1
#[derive(Debug, Subcommand)]
pub(crate) enum NodeCommand {
    /// Ask nodes to end
    Kill {
        /// Nodes
        #[arg(required_unless_present = "all")]
        nodes: Vec<String>,
        /// All nodes but /rosout
        #[arg(long, short, conflicts_with = "nodes")]
        all: bool,
    },
    /// Measure how long nodes take to answer
    Ping {
        /// Node
        #[arg(required_unless_present = "all")]
        node: Option<String>,
        /// All nodes, once
        #[arg(long, short, conflicts_with = "node")]
        all: bool,
        /// Number of calls [default: until Ctrl-C]
        #[arg(short, value_name = "COUNT")]
        count: Option<usize>,
    },
    /// List the machines, or the nodes of one
    Machine {
        /// Host name
        host: Option<String>,
    },
    /// Unregister nodes that do not answer
    Cleanup {
        /// Do not ask before
        #[arg(long, short)]
        yes: bool,
    },
}

pub(super) fn run(command: &NodeCommand) -> Result<ExitCode, CliError> {
    let client = client()?;
    let state = client.system_state().map_err(|error| failed(&client, error))?;
    let nodes = nodes_of(&state);
    match command {
        NodeCommand::Kill { nodes: named, all } => {
            let named: Vec<String> = if *all {
                nodes.into_iter().filter(|node| node != "/rosout").collect()
            } else {
                named.iter().map(|name| full(name)).collect()
            };
            kill(&client, &named)
        }
        NodeCommand::Ping { all: true, .. } => {
            let answers: Vec<bool> =
                nodes.iter().map(|node| ping(&client, node)).collect::<Result<_, _>>()?;
            Ok(code_of(answers.into_iter().all(|is_answered| is_answered)))
        }
        NodeCommand::Ping { node, count, .. } => {
            let node = full(node.as_deref().unwrap_or_default());
            let stop = stop::on_signal();
            let mut is_answered = true;
            let mut rounds = 0;
            while !stop.load(Ordering::Relaxed) && count.is_none_or(|count| rounds < count) {
                if rounds > 0 {
                    sleep(PING_PERIOD);
                }
                is_answered &= ping(&client, &node)?;
                rounds += 1;
            }
            Ok(code_of(is_answered))
        }
        NodeCommand::Machine { host } => {
            let mut out = io::stdout().lock();
            let mut machines = BTreeSet::new();
            for node in nodes {
                let Ok(uri) = client.node(&node) else { continue };
                let machine = uri.trim_start_matches("http://");
                let machine = machine.rsplit_once(':').map_or(machine, |(host, _)| host);
                if host.as_deref() == Some(machine) {
                    writeln!(out, "{node}")?;
                }
                machines.insert(machine.to_owned());
            }
            if host.is_none() {
                for machine in machines {
                    writeln!(out, "{machine}")?;
                }
            }
            Ok(ExitCode::SUCCESS)
        }
        NodeCommand::Cleanup { yes } => cleanup(&client, &state, &nodes, *yes),
    }
}

fn code_of(is_done: bool) -> ExitCode {
    if is_done { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn nodes_of(state: &SystemState) -> BTreeSet<String> {
    let all = [&state.publishers, &state.subscribers, &state.services];
    all.into_iter().flatten().flat_map(|(_, nodes)| nodes.iter().cloned()).collect()
}

fn kill(client: &MasterClient, nodes: &[String]) -> Result<ExitCode, CliError> {
    let mut is_done = true;
    for node in nodes {
        let params = vec![CALLER.into(), "asked by the user".into()];
        let ended = client.node(node).and_then(|uri| ask(&uri, "shutdown", params, PATIENCE));
        match ended {
            Ok(_) => writeln!(io::stdout().lock(), "killed {node}")?,
            Err(error) => {
                is_done = false;
                terminal::say(&format!("error: {node} is not ended: {error}"));
            }
        }
    }
    Ok(code_of(is_done))
}

/// Calls a node once and prints the time it took; false if it does not answer.
fn ping(client: &MasterClient, node: &str) -> Result<bool, CliError> {
    let uri = match client.node(node) {
        Ok(uri) => uri,
        Err(error) => {
            terminal::say(&format!("error: {node}: {error}"));
            return Ok(false);
        }
    };
    let clock = Stopwatch::start();
    match ask(&uri, "getPid", vec![CALLER.into()], PATIENCE) {
        Ok(_) => {
            let time_ms = clock.elapsed().as_secs_f64() * 1e3;
            writeln!(io::stdout().lock(), "{node}: reply from {uri} in {time_ms:.3} ms")?;
            Ok(true)
        }
        Err(error) => {
            terminal::say(&format!("error: {node}: {error}"));
            Ok(false)
        }
    }
}

/// Unregisters everything of nodes that do not answer.
fn cleanup(
    client: &MasterClient,
    state: &SystemState,
    nodes: &BTreeSet<String>,
    is_sure: bool,
) -> Result<ExitCode, CliError> {
    let mut silent = Vec::new();
    for node in nodes {
        let Ok(uri) = client.node(node) else { continue };
        if let Err(RpcError::Unreachable(_)) = ask(&uri, "getPid", vec![CALLER.into()], PATIENCE) {
            silent.push((node.as_str(), uri));
        }
    }
    let mut out = io::stdout().lock();
    if silent.is_empty() {
        writeln!(out, "all nodes answer")?;
        return Ok(ExitCode::SUCCESS);
    }
    for (node, uri) in &silent {
        writeln!(out, "{node} does not answer at {uri}")?;
    }
    if !is_sure {
        write!(out, "Unregister them? [y/n] ")?;
        out.flush()?;
        let mut answer = String::new();
        io::stdin().lock().read_line(&mut answer)?;
        if !answer.trim().eq_ignore_ascii_case("y") {
            return Ok(ExitCode::FAILURE);
        }
    }
    for (node, uri) in &silent {
        let unregister = |method: &str, name: &str, address: &str| {
            let params = vec![(*node).into(), name.into(), address.into()];
            ask(client.uri(), method, params, PATIENCE).map_err(|error| failed(client, error))
        };
        let has = |nodes: &[String]| nodes.iter().any(|one| one == node);
        for (topic, _) in state.publishers.iter().filter(|(_, nodes)| has(nodes)) {
            unregister("unregisterPublisher", topic, uri)?;
        }
        for (topic, _) in state.subscribers.iter().filter(|(_, nodes)| has(nodes)) {
            unregister("unregisterSubscriber", topic, uri)?;
        }
        for (service, _) in state.services.iter().filter(|(_, nodes)| has(nodes)) {
            let address = client.service(service).map_err(|error| failed(client, error))?;
            unregister("unregisterService", service, &address)?;
        }
        writeln!(out, "unregistered {node}")?;
    }
    Ok(ExitCode::SUCCESS)
}
