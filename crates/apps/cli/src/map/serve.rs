//! `periplus map serve`.

use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_diagnostics::SourceMap;
use periplus_graph::NodeSettings;
use periplus_nav_nodes::map_server::{MapServer, MapServerSettings};
use periplus_os::{Machine, sleep};

use super::options::{SaveOptions, ServeOptions};
use crate::arguments;
use crate::error::CliError;
use crate::live::{Live, NodeMonitor};
use crate::stop;
use crate::terminal::{diagnostics, say};

/// Polling period.
const POLL_PERIOD: Duration = Duration::from_millis(20);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(options: &ServeOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    if let Some(name) = &options.file {
        say(&format!("`-f` saves a map; running `periplus map save -f {name}`"));
        let words = vec!["-f".to_owned(), name.clone()];
        return super::save(&SaveOptions { distro: options.distro, timeout: None, words }, &ros);
    }
    let remaps = options.remaps.iter().flat_map(|rule| ["-r".to_owned(), rule.clone()]);
    let arguments = arguments::read(remaps.chain(ros).collect())?;
    let stop = stop::on_signal();
    let live = Live::open(arguments).map_err(CliError::failed)?;
    let graph = &live.graph;
    let usual = MapServerSettings::default();
    let settings = MapServerSettings {
        yaml_filename: options.path.clone().unwrap_or_default(),
        topic_name: options.topic_name.clone().unwrap_or(usual.topic_name),
        frame_id: options.frame_id.clone().unwrap_or(usual.frame_id),
        distro: options.distro,
    };
    let made = graph
        .node(NodeSettings::new("map_server"))
        .and_then(|node| MapServer::new(node, settings, Arc::new(Machine)));
    let server = made.map_err(CliError::failed)?;
    for findings in [graph.take_findings(), graph.unused_arguments()] {
        diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    }
    let monitor = NodeMonitor::new(server.node()).map_err(CliError::failed)?;
    if !options.managed {
        server.start();
    }
    let mut code = ExitCode::SUCCESS;
    while !stop.load(Ordering::Relaxed) {
        live.spin_once();
        sleep(POLL_PERIOD);
        if monitor.tell() && !options.managed {
            // The reason has been logged.
            code = ExitCode::FAILURE;
            break;
        }
    }
    live.end(FLUSH_TIMEOUT);
    Ok(code)
}
