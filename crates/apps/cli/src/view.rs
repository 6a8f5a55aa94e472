//! `periplus view`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use periplus_dds::RemoteTopic;
use periplus_graph::NodeSettings;
use periplus_os::{Stopwatch, sleep};
use periplus_session::page::{Page, PageContext, PageError, browser};
use periplus_session::{LiveGraph, stop};

use crate::arguments;
use crate::error::CliError;
use crate::page::PageOptions;
use crate::terminal::{complain, say};

/// Polling period.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Period of sending remote topics to the page.
const REMOTE_UPDATE_PERIOD: Duration = Duration::from_millis(200);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(300);

/// Show a running ROS 2 system in the browser
///
/// It joins the network as a node and subscribes only to what the page shows. It uses simulated
/// time if `/clock` is published.
#[derive(Debug, Args)]
pub(crate) struct ViewOptions {
    #[command(flatten)]
    page: PageOptions,
    /// Do not open a browser
    #[arg(long)]
    no_browser: bool,
    /// RViz file that the page opens
    #[arg(long, short = 'd', value_name = "FILE.rviz")]
    display_config: Option<PathBuf>,
    /// Fixed frame, in place of the one in the RViz file
    #[arg(long, short = 'f', value_name = "FRAME")]
    fixed_frame: Option<String>,
    /// Folder to search for packages with meshes, before those of the environment; repeatable
    #[arg(long, value_name = "DIR")]
    resource_path: Vec<PathBuf>,
}

pub(crate) fn run(options: &ViewOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let arguments = arguments::read(ros)?;
    let stop = stop::on_signal();
    let mut live = LiveGraph::open(arguments)?;
    let page = options.open_page(&live)?;
    let url = page.url();
    say(&format!("ROS 2 domain {}; page: {url} (Ctrl-C ends it)", live.domain_id));
    if !options.no_browser && !browser::open(&url) {
        say("no browser could be started; open the page yourself");
    }
    let node = live.graph.node(NodeSettings::new("periplus_view").bare());
    let mut looked: Option<Stopwatch> = None;
    let mut follows = false;
    while !stop.load(Ordering::Relaxed) {
        live.spin_once();
        if looked.as_ref().is_none_or(|looked| looked.elapsed() >= REMOTE_UPDATE_PERIOD) {
            looked = Some(Stopwatch::start());
            let remote = live.wire.remote();
            let tells = |topic: &RemoteTopic| !topic.publishers.is_empty();
            if !follows
                && remote.topic("/clock").is_some_and(tells)
                && let Ok(node) = &node
            {
                follows = true;
                if let Err(error) = live.follow_clock(node) {
                    complain(&error.to_string());
                }
            }
            page.set_remote(&remote);
            live.print_findings();
        }
        sleep(POLL_PERIOD);
    }
    drop(page);
    live.end(FLUSH_TIMEOUT);
    Ok(ExitCode::SUCCESS)
}

impl ViewOptions {
    fn open_page(&self, live: &LiveGraph) -> Result<Page, PageError> {
        let context = PageContext {
            resource_path: self.resource_path.clone(),
            view: self.display_config.clone(),
            fixed_frame: self.fixed_frame.clone(),
            ..PageContext::default()
        };
        Page::serve(&live.graph, &self.page.settings(context))
    }
}
