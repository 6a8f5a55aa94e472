//! `periplus tf`.

mod recorded;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, Subcommand};
use periplus_os::unix_ns;
use periplus_ros2cli::tf::{self, Monitor, Pictures, TfEchoOptions, Tree, read_broadcast};

use super::common::{Common, rate, seconds};
use super::with_session;

use crate::error::CliError;

/// Inspect and publish transforms, as the programs of tf2 do
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
    #[command(visible_alias = "view_frames")]
    Tree(TreeOptions),
}

/// Draw the frame tree as `view_frames` does: a .gv file for Graphviz and a .pdf file
///
/// Subscribes to the running system, or reads a recording. Errors of the tree (several trees, a
/// frame with two parents, cycles) are reported.
#[derive(Debug, Args)]
struct TreeOptions {
    /// Recording to examine, in place of the running system
    #[arg(value_name = "BAG")]
    recording: Option<PathBuf>,
    /// Duration of the measurement [s]
    #[arg(long, short = 't', value_name = "SECONDS", default_value_t = 5.0, value_parser = seconds)]
    wait_time: f64,
    /// Name of the output files, without extension [default: `frames_` and the date (UTC)]
    #[arg(long, short, value_name = "NAME")]
    output: Option<PathBuf>,
    /// Write an .svg file too
    #[arg(long)]
    svg: bool,
    /// Topic of dynamic transforms
    #[arg(long, value_name = "TOPIC", default_value = "/tf", alias = "tf_topic")]
    tf_topic: String,
    /// Topic of static transforms
    #[arg(long, value_name = "TOPIC", default_value = "/tf_static", alias = "tf_static_topic")]
    tf_static_topic: String,
    #[command(flatten)]
    common: Common,
}

impl TreeOptions {
    fn pictures(&self) -> Pictures {
        let stem = self.output.clone().unwrap_or_else(|| dated(unix_ns()));
        Pictures { stem, svg: self.svg }
    }
}

/// `frames_2026-11-21_15.04.05`, as `view_frames` names files.
fn dated(time_ns: i64) -> PathBuf {
    let stamp = periplus_bags::files::stamp_name(time_ns);
    let (date, time) = stamp.split_once('-').unwrap_or((&stamp, ""));
    format!("frames_{}_{}", date.replace('_', "-"), time.replace('_', ".")).into()
}

/// Print the pose of a frame in another frame repeatedly, as `tf2_echo` does
///
/// The pose of the second frame is printed in the first frame.
#[derive(Debug, Args)]
struct EchoOptions {
    /// Reference frame, such as `map`
    source_frame: String,
    /// Frame whose pose is printed, such as `base_link`
    target_frame: String,
    /// Rate [Hz]
    #[arg(default_value_t = 1.0, value_parser = rate)]
    echo_rate: f64,
    /// Print one pose and exit
    #[arg(long)]
    once: bool,
    #[command(flatten)]
    common: Common,
}

/// Report delays and rates of transforms, as `tf2_monitor` does
#[derive(Debug, Args)]
struct MonitorOptions {
    /// Two frames: report only the chain between them
    #[arg(num_args = 2, value_name = "FRAME")]
    frames: Vec<String>,
    /// Collect data for this time before each report [s]
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, value_parser = seconds)]
    gather: f64,
    /// Print one report and exit
    #[arg(long)]
    once: bool,
    #[command(flatten)]
    common: Common,
}

/// Publish a static transform, with the arguments of `static_transform_publisher`
///
/// `--x --y --z --roll --pitch --yaw` or `--qx --qy --qz --qw`, `--frame-id PARENT --child-frame-id
/// CHILD`; or the old form `X Y Z YAW PITCH ROLL PARENT CHILD`.
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
    pub(crate) fn run(&self) -> Result<ExitCode, CliError> {
        match &self.verb {
            Verb::Echo(options) => {
                let echo = TfEchoOptions {
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
            Verb::Tree(options) => match &options.recording {
                Some(path) => recorded::tree(path, &options.pictures(), &options.common),
                None => {
                    let tree = Tree {
                        wait: Duration::from_secs_f64(options.wait_time),
                        moving: options.tf_topic.clone(),
                        fixed: options.tf_static_topic.clone(),
                        pictures: options.pictures(),
                    };
                    with_session(&options.common, |session| tf::tree(session, &tree))
                }
            },
            Verb::Static(options) => with_session(&Common::default(), |session| {
                tf::broadcast(session, &read_broadcast(&options.words)?)
            }),
        }
    }
}

#[test]
fn files_are_dated_as_view_frames_dates_them() {
    let path = dated(1_795_273_445_123_456_789);
    assert_eq!(path.to_str(), Some("frames_2026-11-21_15.04.05"));
}
