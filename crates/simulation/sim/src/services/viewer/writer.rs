//! The changed world, written to a file that the user has named when the simulation was started.

use std::path::{Path, PathBuf};

use periplus_diagnostics::plain_words;
use periplus_graph::{GraphError, Node};
use periplus_msgs::std_srvs::Trigger;
use periplus_os::fs;

use super::super::reading::Search;
use super::super::service_aliases::ServiceAliases;
use super::{changes, response};
use crate::Simulation;

/// Service that writes the world.
pub(super) struct WorldWriter {
    service: ServiceAliases<Trigger>,
    file: PathBuf,
    /// Text that was written to the world's own file.
    written: Option<String>,
}

impl WorldWriter {
    pub(super) fn new(node: &Node, name: &str, file: PathBuf) -> Result<Self, GraphError> {
        Ok(Self { service: ServiceAliases::new(node, [name])?, file, written: None })
    }

    /// Returns the text that the world's own file has since it was written.
    pub(super) fn written(&self) -> Option<&str> {
        self.written.as_deref()
    }

    /// Answers requests with the path, or the reason for which the file was not written.
    pub(super) fn serve(&mut self, simulation: &Simulation, search: &Search) {
        let Self { service, file, written } = self;
        service.answer(|_| response(write(simulation, search, file, written)));
    }
}

fn write(
    simulation: &Simulation,
    search: &Search,
    file: &Path,
    written: &mut Option<String>,
) -> Result<String, String> {
    let changed = changes::of(simulation, search, written.as_deref())?;
    let path = search.working_folder.join(file);
    let own = simulation.world_file().source.as_ref();
    let own = own.map(|(own, _)| search.working_folder.join(own));
    let is_own = own.is_some_and(|own| {
        search.with_context(false, |context| {
            context.host.canonical(&own) == context.host.canonical(&path)
        })
    });
    if let Some(note) = changed.note.as_ref().filter(|_| is_own) {
        return Err(note.clone());
    }
    // Complete or not at all: the file may be the only copy of the world.
    let mut part = path.clone().into_os_string();
    part.push(".part");
    fs::write(&part, &changed.text).and_then(|()| fs::rename(&part, &path)).map_err(|error| {
        format!("`{}` cannot be written: {}", path.display(), plain_words(&error))
    })?;
    if is_own {
        *written = Some(changed.text);
    }
    Ok(path.display().to_string())
}
