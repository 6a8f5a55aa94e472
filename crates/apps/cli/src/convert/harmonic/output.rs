//! Files of the output folder.

use std::path::Path;

use periplus_migration::{BridgeEntry, bridge_yaml, clock_bridge};

use super::compare::Comparison;
use super::project::Project;
use super::report;
use crate::error::CliError;
use crate::paths;

/// Name of the report.
pub(super) const REPORT: &str = "MIGRATION.md";

/// Name of the report for programs.
pub(super) const JSON_REPORT: &str = "migration.json";

/// Name of the topics for `ros_gz_bridge`.
pub(super) const BRIDGE: &str = "ros_gz_bridge.yaml";

/// Writes a file of the folder.
pub(super) fn write_file(folder: &Path, name: &str, text: &str) -> Result<(), CliError> {
    let path = folder.join(name);
    if let Some(parent) = path.parent() {
        paths::make_folder(parent).map_err(CliError::failed)?;
    }
    paths::write(&path, text.as_bytes()).map_err(CliError::failed)
}

/// Writes all files; returns their names in the folder.
pub(super) fn write(
    project: &Project,
    comparison: &Comparison,
    folder: &Path,
) -> Result<Vec<String>, CliError> {
    let mut written = converted(project, folder)?;
    if !project.bridge.is_empty() {
        write_file(folder, BRIDGE, &bridge(&project.bridge))?;
        written.push(BRIDGE.to_owned());
    }
    written.extend([REPORT.to_owned(), JSON_REPORT.to_owned()]);
    write_file(folder, REPORT, &report::markdown(project, &written, comparison))?;
    let json = format!("{:#}\n", report::json(project, &written, comparison));
    write_file(folder, JSON_REPORT, &json)?;
    Ok(written)
}

/// Writes the converted files alone; returns their names.
pub(super) fn converted(project: &Project, folder: &Path) -> Result<Vec<String>, CliError> {
    let mut written = Vec::new();
    for file in &project.files {
        let name = file.output.display().to_string();
        write_file(folder, &name, &file.text)?;
        written.push(name);
    }
    Ok(written)
}

/// Text of the topics for `ros_gz_bridge`, with the clock.
pub(super) fn bridge(topics: &[BridgeEntry]) -> String {
    let mut entries = vec![clock_bridge()];
    entries.extend(topics.iter().cloned());
    bridge_yaml(&entries)
}
