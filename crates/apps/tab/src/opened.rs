//! A session that was started from options, before its client joins.

use std::path::{Path, PathBuf};

use periplus_bags::Compression;
use periplus_os::{Stopwatch, fs};
use periplus_session::demo::{self, DemoTask, WORLD_NAME};
use periplus_session::{PageContext, RecordingRequest, RunError, SimulationSession};
use periplus_sim::{Options, Search};

use crate::options::{DemoOptions, TabOptions};
use crate::run;
use crate::tab::TabError;

/// A started session.
pub(crate) struct OpenedSession {
    pub(crate) session: SimulationSession,
    /// Work between its steps; empty except for the demo.
    pub(crate) task: DemoTask,
    /// Contents of the page; none for a session without one.
    pub(crate) context: Option<PageContext>,
}

impl OpenedSession {
    /// Starts a session.
    pub(crate) fn open(options: &TabOptions) -> Result<Self, TabError> {
        match options {
            TabOptions::Demo(options) => demo(options),
            TabOptions::Run(options) => run::open(options),
        }
    }
}

fn demo(options: &DemoOptions) -> Result<OpenedSession, TabError> {
    if options.explore && options.navigation {
        return Err(TabError::Refused(
            "`explore` and `navigation` would both drive the robot; choose one of them".to_owned(),
        ));
    }
    let simulation = Options { seed: options.seed, ..Options::default() };
    let out = options.out.as_deref();
    if let Some(out) = out {
        make_folder(out)?;
    }
    let recording = out.map(|out| RecordingRequest {
        compression: Compression::None,
        ..demo::recording(&out.join("demo.mcap"))
    });
    let search = Search { working_folder: PathBuf::from("/"), ..Search::default() };
    let mut builder = demo::builder(simulation, out, Stopwatch::start());
    if options.navigation {
        builder = builder.estimators(demo::navigation(out));
    }
    let session = builder
        .factor(options.is_paced.then_some(1.0))
        .search(search)
        .recording(recording)
        .build()?;
    let end_ns = options.duration_s.map(|seconds| (seconds * 1e9).round() as i64);
    let task = DemoTask::join(session.graph(), options.explore, out.is_some(), end_ns)
        .map_err(RunError::from)?;
    let context = (!options.headless)
        .then(|| PageContext { world: Some(WORLD_NAME.to_owned()), ..PageContext::default() });
    Ok(OpenedSession { session, task, context })
}

/// Creates a folder of results.
pub(crate) fn make_folder(folder: &Path) -> Result<(), TabError> {
    fs::create_dir_all(folder).map_err(TabError::Folder)
}
