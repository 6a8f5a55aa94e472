//! `periplus tf`.

use std::io;
use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, Subcommand};
use periplus_verbs::tf::{self, Echo, Monitor, read_broadcast};

use super::common::{Common, rate, seconds};
use super::with_session;

/// See where frames are, and say where one is, as the programs of tf2 do
#[derive(Debug, Args)]
pub(crate) struct TfOptions {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Echo(EchoOptions),
    Monitor(MonitorOptions),
    Static(StaticOptions),
}

/// Print the pose of a frame in another, again and again, as `tf2_echo` does
///
/// As there, the first frame is that in which the pose of the second is told.
#[derive(Debug, Args)]
struct EchoOptions {
    /// The frame in which the pose is, such as `map`
    source_frame: String,
    /// The frame whose pose it is, such as `base_link`
    target_frame: String,
    /// Times in a second
    #[arg(default_value_t = 1.0, value_parser = rate)]
    echo_rate: f64,
    /// Print one pose and end
    #[arg(long)]
    once: bool,
    #[command(flatten)]
    common: Common,
}

/// Report how late frames come and how often, as `tf2_monitor` does
#[derive(Debug, Args)]
struct MonitorOptions {
    /// Two frames: only the chain between them
    #[arg(num_args = 2, value_name = "FRAME")]
    frames: Vec<String>,
    /// Gather so long for a report
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, value_parser = seconds)]
    gather: f64,
    /// Print one report and end
    #[arg(long)]
    once: bool,
    #[command(flatten)]
    common: Common,
}

/// Say where a frame is that never moves, with the words of `static_transform_publisher`
///
/// `--x --y --z --roll --pitch --yaw` or `--qx --qy --qz --qw`, `--frame-id PARENT
/// --child-frame-id CHILD`; or, as it was before, `X Y Z YAW PITCH ROLL PARENT CHILD`.
#[derive(Debug, Args)]
struct StaticOptions {
    #[arg(
        trailing_var_arg = true,
        allow_hyphen_values = true,
        value_name = "WORD",
        required = true
    )]
    words: Vec<String>,
}

impl TfOptions {
    pub(crate) fn run(&self) -> io::Result<ExitCode> {
        match &self.verb {
            Verb::Echo(options) => {
                let echo = Echo {
                    source: options.source_frame.clone(),
                    target: options.target_frame.clone(),
                    period: Duration::from_secs_f64(1.0 / options.echo_rate),
                    once: options.once,
                };
                with_session(&options.common, |session| tf::echo(session, &echo))
            }
            Verb::Monitor(options) => {
                let between = match options.frames.as_slice() {
                    [a, b] => Some((a.clone(), b.clone())),
                    _ => None,
                };
                let gather = Duration::from_secs_f64(options.gather.max(0.1));
                let monitor = Monitor { between, gather, once: options.once };
                with_session(&options.common, |session| tf::monitor(session, &monitor))
            }
            Verb::Static(options) => with_session(&Common::default(), |session| {
                tf::broadcast(session, &read_broadcast(&options.words)?)
            }),
        }
    }
}
