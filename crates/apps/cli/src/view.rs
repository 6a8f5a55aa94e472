//! `periplus view`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use periplus_dds::RemoteTopic;
use periplus_graph::{Graph, NodeSettings};
use periplus_os::{Stopwatch, sleep};
use periplus_session::page::{Page, PageContext, PageError, browser};
use periplus_session::stop;

use crate::arguments;
use crate::error::CliError;
use crate::page::PageOptions;
use crate::run_options::LiveNetworkOptions;
use crate::terminal::{complain, say};

/// Polling period.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Period of sending remote topics to the page.
const REMOTE_UPDATE_PERIOD: Duration = Duration::from_millis(200);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(300);

/// Time in which a recording with an index is open; one without may take longer.
const OPEN_TIMEOUT: Duration = Duration::from_secs(2);

/// Show a running ROS 2 system or recordings in the browser
///
/// Without recordings it joins the network as a node and subscribes only to what the page shows. It
/// uses simulated time if `/clock` is published. With recordings it joins no network: the page
/// replays them.
#[derive(Debug, Args)]
pub(crate) struct ViewOptions {
    /// Recordings to replay: folders of `ros2 bag`, MCAP files, databases, ROS 1 bags or CARMEN logs;
    /// two are compared
    #[arg(value_name = "RUN")]
    recordings: Vec<PathBuf>,
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
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
}

pub(crate) fn run(options: &ViewOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let arguments = arguments::read(ros)?;
    if !options.recordings.is_empty() {
        return replay(options);
    }
    let stop = stop::on_signal();
    let mut live = options.network.open(arguments)?;
    let page = options.open_page(&live.graph)?;
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
            let ros1 = live.ros1.as_ref().map(|ros1| ros1.remote());
            page.set_remote(Some(&remote), ros1.as_deref());
            live.print_findings();
        }
        sleep(POLL_PERIOD);
    }
    drop(page);
    live.end(FLUSH_TIMEOUT);
    Ok(ExitCode::SUCCESS)
}

/// Serves recordings until Ctrl-C.
fn replay(options: &ViewOptions) -> Result<ExitCode, CliError> {
    let stop = stop::on_signal();
    let page = options.open_page(&Graph::live())?;
    let recordings = page.recordings().clone();
    let failure = || recordings.failures().into_iter().next();
    // Most failures show at once.
    let since = Stopwatch::start();
    while recordings.is_opening() && failure().is_none() && since.elapsed() < OPEN_TIMEOUT {
        sleep(POLL_PERIOD);
    }
    if let Some(why) = failure() {
        return Err(CliError::failed(why));
    }
    let url = page.url();
    say(&format!("replaying {}; page: {url} (Ctrl-C ends it)", options.names()));
    if !options.no_browser && !browser::open(&url) {
        say("no browser could be started; open the page yourself");
    }
    let mut reported = 0;
    while !stop.load(Ordering::Relaxed) {
        // The page shows them, too; others can still be replayed.
        let failures = recordings.failures();
        failures.iter().skip(reported).for_each(|why| complain(why));
        reported = reported.max(failures.len());
        sleep(REMOTE_UPDATE_PERIOD);
    }
    drop(page);
    Ok(ExitCode::SUCCESS)
}

impl ViewOptions {
    /// Paths of the recordings, for messages.
    fn names(&self) -> String {
        let names = self.recordings.iter().map(|path| path.display().to_string());
        names.collect::<Vec<_>>().join(", ")
    }

    fn open_page(&self, graph: &Graph) -> Result<Page, PageError> {
        let context = PageContext {
            recordings: self.recordings.clone(),
            resource_path: self.resource_path.clone(),
            view: self.display_config.clone(),
            fixed_frame: self.fixed_frame.clone(),
            ..PageContext::default()
        };
        Page::serve(graph, &self.page.settings(context))
    }
}
