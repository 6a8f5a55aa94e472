//! Results of a running session.

use std::path::PathBuf;

use periplus_session::RunError;
use periplus_session::nodes::MappingNode;

use crate::tab::Tab;

impl Tab {
    /// Writes map, session and costmaps of the nodes that were asked for them, and returns the folder of the map; none
    /// where no node maps into a folder.
    ///
    /// # Errors
    /// When there is no map yet, or a file cannot be written.
    pub fn write_results(&self) -> Result<Option<PathBuf>, RunError> {
        let mapping = self.session().mapping();
        mapping.map_or(Ok(None), MappingNode::write_results)
    }
}
