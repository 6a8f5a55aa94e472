//! Launch without a world, on the ROS 2 network.

use std::io::{self, Write as _};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_graph::{Node, NodeSettings};
use periplus_launch::Dialect;
use periplus_launch::bringup::LaunchRunner;
use periplus_os::{Stopwatch, sleep};
use periplus_session::{LiveGraph, Page, PageContext, Ros1Reach, stop};
use serde_json::json;

use super::log::LogPrinter;
use super::{Launched, PlayOptions, parameter_server};
use crate::error::CliError;
use crate::options::SearchOptions;
use crate::terminal;

/// Polling period.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Timeout of discovery.
const DISCOVERY_TIMEOUT: Duration = Duration::from_millis(1500);

/// Period of sending remote topics to the page.
const REMOTE_UPDATE_PERIOD: Duration = Duration::from_millis(200);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(
    launched: Launched,
    mut bringup: LaunchRunner,
    options: &PlayOptions,
    ros1: Option<Ros1Reach>,
    search: &SearchOptions,
) -> Result<ExitCode, CliError> {
    if options.record.is_some() {
        return Err(CliError::usage(
            "this launch simulates no world; record it with `periplus bag record`",
        ));
    }
    let stop = stop::on_signal();
    let mut live = match ros1 {
        Some(reach) => {
            let parameters = parameter_server::parameters(&launched.plan);
            LiveGraph::start_ros1(launched.arguments, reach, parameters, options.quiet)?
        }
        None => LiveGraph::open(launched.arguments)?,
    };
    bringup.set_wired(true);
    if !options.quiet && live.ros1.is_none() {
        terminal::say(&format!("ROS 2: domain {}", live.domain_id));
    }
    let node = live.graph.node(NodeSettings::new("periplus_launch").bare());
    if let Ok(node) = &node
        && uses_clock(&live, &bringup, launched.dialect)
    {
        follow_clock(&mut live, node, options.quiet)?;
    }
    let context =
        || PageContext { resource_path: search.resource_path.clone(), ..PageContext::default() };
    let page = options.page(&bringup, true, context);
    let page = page.map(|page| Page::open(&live.graph, &page)).transpose();
    let page = page.map_err(CliError::failed)?.flatten();
    let mut log = LogPrinter::new(options.quiet);
    spin(&live, &mut bringup, &mut log, page.as_ref(), (&stop, options.duration));
    drop(page);
    bringup.end_all(&live.graph, i64::MAX);
    log.print(&mut bringup, None);
    if options.json {
        let json = json!({ "launch": bringup.lines() });
        writeln!(io::stdout().lock(), "{json:#}")?;
    }
    drop(bringup);
    live.end(FLUSH_TIMEOUT);
    if log.has_failed {
        return Err(CliError::failed("parts of the launch have failed: see the errors above"));
    }
    Ok(ExitCode::SUCCESS)
}

/// Runs the plan until it ends, a signal arrives, or the duration \[s\] has passed.
fn spin(
    live: &LiveGraph,
    bringup: &mut LaunchRunner,
    log: &mut LogPrinter,
    page: Option<&Page>,
    (stop, duration_s): (&AtomicBool, Option<f64>),
) {
    let mut checked = Stopwatch::start();
    let since = Stopwatch::start();
    let is_over = || duration_s.is_some_and(|seconds| since.elapsed().as_secs_f64() >= seconds);
    while !stop.load(Ordering::Relaxed) && !bringup.is_over() && !is_over() {
        live.spin_once();
        // Timers of launch files use wall time, whatever clock the nodes use.
        let now_ns = i64::try_from(since.elapsed().as_nanos()).unwrap_or(i64::MAX);
        bringup.work(&live.graph, now_ns, None);
        log.print(bringup, None);
        if bringup.is_idle() {
            terminal::say("all nodes and programs of the launch have ended");
            break;
        }
        live.print_findings();
        if let Some(page) = page.filter(|_| checked.elapsed() >= REMOTE_UPDATE_PERIOD) {
            checked = Stopwatch::start();
            let ros1 = live.ros1.as_ref().map(|ros1| ros1.remote());
            page.set_remote(Some(&live.wire.remote()), ros1.as_deref());
        }
        sleep(POLL_PERIOD);
    }
}

/// Returns true if the nodes use simulated time. In ROS 1 all nodes use `/clock` once
/// `/use_sim_time` is set; there is no master here that stores it, so a publisher of `/clock` is
/// searched for.
fn uses_clock(live: &LiveGraph, bringup: &LaunchRunner, dialect: Dialect) -> bool {
    let is_published = dialect == Dialect::Ros1 && has_clock(live);
    let is_simulated = live.ros1.as_ref().is_some_and(|ros1| {
        let set = ros1.client().ask("getParam", vec!["/use_sim_time".into()]);
        set == Ok(true.into())
    });
    bringup.follows_clock() || is_published || is_simulated
}

fn follow_clock(live: &mut LiveGraph, node: &Node, is_quiet: bool) -> Result<(), CliError> {
    live.follow_clock(node)?;
    if !is_quiet {
        terminal::say("using the time of /clock");
    }
    Ok(())
}

/// Returns true if `/clock` has a publisher on the network, after some time for discovery.
fn has_clock(live: &LiveGraph) -> bool {
    let since = Stopwatch::start();
    while since.elapsed() < DISCOVERY_TIMEOUT {
        let remote = live.wire.remote();
        if remote.topic("/clock").is_some_and(|topic| !topic.publishers.is_empty()) {
            return true;
        }
        sleep(POLL_PERIOD);
    }
    false
}
