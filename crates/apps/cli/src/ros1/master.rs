//! `periplus ros1 master`.

use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use periplus_os::{Machine, sleep};
use periplus_ros1::{Master, Ros1Reach, Settings};
use periplus_session::stop;

use crate::error::CliError;
use crate::terminal;

/// Polling period of the interrupt flag.
const POLL_PERIOD: Duration = Duration::from_millis(50);

/// Run a master with a parameter server and /rosout, as `roscore` does, until Ctrl-C
#[derive(Debug, Args)]
pub(crate) struct MasterOptions {
    /// Port [default: that of ROS_MASTER_URI, or 11311]
    #[arg(long, short, value_name = "PORT", value_parser = clap::value_parser!(u16).range(1..))]
    port: Option<u16>,
    /// Answer programs on other machines, too; by default those of this machine only
    #[arg(long)]
    network: bool,
}

pub(super) fn run(options: &MasterOptions) -> Result<ExitCode, CliError> {
    let reach = if options.network { Ros1Reach::Network } else { Ros1Reach::Machine };
    let (settings, findings) = Settings::from_environment(&Machine, reach);
    terminal::print_findings(&findings)?;
    let port = match options.port {
        Some(port) => port,
        None => settings.master().map_err(CliError::failed)?.1,
    };
    let stop = stop::on_signal();
    let master =
        Master::open(settings.address(), &settings.host, port).map_err(CliError::failed)?;
    terminal::say(&format!("ROS_MASTER_URI={}", master.uri()));
    while !stop.load(Ordering::Relaxed) {
        sleep(POLL_PERIOD);
    }
    Ok(ExitCode::SUCCESS)
}
