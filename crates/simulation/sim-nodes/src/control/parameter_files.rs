//! Access to parameter files.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, RenderStyle, SourceMap, render};
use periplus_graph::{Arguments, ParameterFileError};

/// Reader of the parameter files that plugins and spawners name.
pub trait ParameterFiles: Send + Sync {
    /// Returns the text of a file.
    ///
    /// # Errors
    /// When it cannot be read.
    fn parameter_text(&self, path: &Path) -> Result<String, ParameterFileError>;
}

/// A machine without files.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoParameterFiles;

impl ParameterFiles for NoParameterFiles {
    fn parameter_text(&self, _: &Path) -> Result<String, ParameterFileError> {
        Err(ParameterFileError::Missing)
    }
}

/// Reads arguments of `--ros-args`. Findings are returned as texts.
pub(super) fn arguments(words: &[String], files: &dyn ParameterFiles) -> (Arguments, Vec<String>) {
    let (mut sources, mut found) = (SourceMap::new(), Diagnostics::new());
    let mut read = |path: &Path| files.parameter_text(path);
    let arguments = Arguments::read(words, &mut sources, &mut found, &mut read);
    let text =
        |finding: &Diagnostic| render(finding, &sources, RenderStyle::Plain).trim_end().to_owned();
    (arguments, found.iter().map(text).collect())
}
