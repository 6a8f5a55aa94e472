//! Files of the output folder.

use std::path::Path;

use periplus_migration::{bridge_yaml, clock_bridge};

use super::compare::Comparison;
use super::project::Project;
use super::report;
use crate::error::CliError;
use crate::paths;

/// Name of the report.
pub(super) const REPORT: &str = "MIGRATION.md";

/// Name of the report for programs.
const JSON_REPORT: &str = "migration.json";

/// Name of the topics for `ros_gz_bridge`.
const BRIDGE: &str = "ros_gz_bridge.yaml";

/// Writes all files; returns their names in the folder.
pub(super) fn write(
    project: &Project,
    comparison: &Comparison,
    folder: &Path,
) -> Result<Vec<String>, CliError> {
    let mut written = Vec::new();
    let mut add = |name: String, text: &str| -> Result<(), CliError> {
        let path = folder.join(&name);
        if let Some(parent) = path.parent() {
            paths::make_folder(parent).map_err(CliError::failed)?;
        }
        paths::write(&path, text.as_bytes()).map_err(CliError::failed)?;
        written.push(name);
        Ok(())
    };
    for file in &project.files {
        add(file.output.display().to_string(), &file.text)?;
    }
    if !project.bridge.is_empty() {
        let mut entries = vec![clock_bridge()];
        entries.extend(project.bridge.iter().cloned());
        add(BRIDGE.to_owned(), &bridge_yaml(&entries))?;
    }
    let mut names = written.clone();
    names.extend([REPORT.to_owned(), JSON_REPORT.to_owned()]);
    let add = |name: &str, text: String| {
        paths::write(&folder.join(name), text.as_bytes()).map_err(CliError::failed)
    };
    add(REPORT, report::markdown(project, &names, comparison))?;
    add(JSON_REPORT, format!("{:#}\n", report::json(project, &names, comparison)))?;
    Ok(names)
}
