//! `periplus map serve`.

use std::ops::ControlFlow;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::NodeSettings;
use periplus_nav_nodes::map_server::{MapServer, MapServerParams};
use periplus_os::Machine;
use periplus_session::{PollSleep, stop};

use super::options::{SaveOptions, ServeOptions};
use crate::arguments;
use crate::error::CliError;
use crate::terminal::say;

/// Polling period.
const POLL_SLEEP: PollSleep = PollSleep::fixed(Duration::from_millis(20));

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(options: &ServeOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    if let Some(name) = &options.file {
        say(&format!("`-f` saves a map; running `periplus map save -f {name}`"));
        let words = vec!["-f".to_owned(), name.clone()];
        return super::save(
            &SaveOptions { distro: options.distro, timeout: None, network: options.network, words },
            &ros,
        );
    }
    let remaps = options.remaps.iter().flat_map(|rule| ["-r".to_owned(), rule.clone()]);
    let arguments = arguments::read(remaps.chain(ros).collect())?;
    let stop = stop::on_signal();
    let mut live = options.network.open(arguments)?;
    let node = live.graph.node(NodeSettings::new("map_server"))?;
    let server = MapServer::new(node, options.params(), options.distro, Arc::new(Machine))?;
    live.print_start_findings()?;
    let monitor = live.monitor(server.node(), false)?;
    if !options.managed {
        server.start();
    }
    let has_failed = live.spin(&stop, POLL_SLEEP, || {
        // The reason has been logged.
        let has_failed = monitor.print_log() && !options.managed;
        if has_failed { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    live.end(FLUSH_TIMEOUT);
    Ok(if has_failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

impl ServeOptions {
    fn params(&self) -> MapServerParams {
        let usual = MapServerParams::default();
        MapServerParams {
            yaml_filename: self.path.clone().unwrap_or_default(),
            topic_name: self.topic_name.clone().unwrap_or(usual.topic_name),
            frame_id: self.frame_id.clone().unwrap_or(usual.frame_id),
        }
    }
}
