//! Robot and world files, checked and converted as by the commands `periplus check` and `periplus convert`.

use std::fmt;
use std::path::{Path, PathBuf};

use periplus_diagnostics::Severity;
use periplus_loader::LoadedFile;
pub use periplus_session::check::CheckedFile;

use crate::options::{ConvertOptions, Format, SearchOptions};
use crate::terminal::with_setting;

/// Checks a file of any format. `arguments` are those of xacro; `resource_path` are folders to search.
#[must_use]
pub fn check_file(
    file: &Path,
    arguments: Vec<(String, String)>,
    resource_path: &[PathBuf],
) -> CheckedFile {
    with_setting(resource_path, arguments, |setting| CheckedFile::read_alone(file, setting))
}

/// Target of a conversion.
#[derive(Clone, Debug)]
pub struct ConversionTarget {
    /// Format: `urdf`, `sdf` or `json`.
    pub format: String,
    /// Path of the new file, to which paths in its text are relative; none for the source's folder.
    pub output: Option<PathBuf>,
    /// Model to convert; none for all.
    pub model: Option<String>,
    /// Pixel size of a floor plan \[m\].
    pub resolution_m: Option<f64>,
    /// Height of the walls of a map \[m\].
    pub wall_height_m: f64,
}

impl ConversionTarget {
    /// Target of a format, with the defaults of the command.
    #[must_use]
    pub fn new(format: &str) -> Self {
        let format = format.to_owned();
        Self { format, output: None, model: None, resolution_m: None, wall_height_m: 2.5 }
    }
}

/// Reason that a conversion did not start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConversionError {
    /// The target has a format that does not exist.
    UnknownFormat(String),
    /// The settings do not fit the file.
    Settings(String),
}

impl fmt::Display for ConversionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownFormat(name) => {
                write!(f, "the format is `urdf`, `sdf` or `json`, not `{name}`")
            }
            Self::Settings(reason) => f.write_str(reason),
        }
    }
}

impl std::error::Error for ConversionError {}

/// Reads and converts a file. Without a text the findings have an error.
///
/// # Errors
/// For an unknown format, and settings that do not fit the file.
pub fn convert_file(
    file: &Path,
    arguments: Vec<(String, String)>,
    target: &ConversionTarget,
    resource_path: &[PathBuf],
) -> Result<(LoadedFile, Option<String>), ConversionError> {
    let to = match target.format.as_str() {
        "urdf" => Format::Urdf,
        "sdf" => Format::Sdf,
        "json" => Format::Json,
        other => return Err(ConversionError::UnknownFormat(other.to_owned())),
    };
    let options = ConvertOptions {
        words: Vec::new(),
        to,
        model: target.model.clone(),
        output: target.output.clone(),
        out: None,
        no_compare: false,
        json: false,
        resolution: target.resolution_m,
        wall_height: target.wall_height_m,
        search: SearchOptions { resource_path: resource_path.to_vec() },
    };
    let (mut loaded, text, _) = crate::convert::convert_file(file, arguments.clone(), &options)
        .map_err(ConversionError::Settings)?;
    let unknown: Vec<String> =
        loaded.unknown_arguments(&arguments).into_iter().map(str::to_owned).collect();
    unknown.iter().for_each(|name| loaded.warn_of_argument(name));
    debug_assert!(text.is_some() || loaded.diagnostics.count(Severity::Error) > 0);
    Ok((loaded, text))
}
