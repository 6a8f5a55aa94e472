//! Recordings of a page.

use std::sync::Arc;

use periplus_os::fs;
use periplus_web::foxglove::{RecordingSettings, Recordings};

use super::PageContext;
use crate::description;
use crate::rerun::RerunJobs;
use crate::terminal;

/// Opens recordings in the background. Recordings of the graph are created in the working folder, as
/// by `periplus bag record`.
pub(super) fn open(context: &PageContext) -> Result<Arc<Recordings>, String> {
    let here = terminal::working_folder();
    let settings = RecordingSettings {
        custom_data: description::with_version(context.description.clone()),
        ..RecordingSettings::new(here, fs::temp_dir())
    };
    let recordings = Recordings::new(settings);
    recordings.set_jobs(Arc::new(RerunJobs::new(context.report)));
    for path in &context.recordings {
        recordings.open(path).map_err(|error| error.to_string())?;
    }
    Ok(recordings)
}
