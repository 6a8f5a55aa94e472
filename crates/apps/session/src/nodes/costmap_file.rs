//! Costmaps of Nav2 parameter files.

use std::path::Path;

use periplus_costmap::{CostmapConfig, Nav2Release};
use periplus_diagnostics::{Diagnostics, SourceMap};

use crate::error::RunError;
use crate::files;

/// Costmap nodes of Nav2, by name.
const NODES: [&str; 2] = ["local_costmap", "global_costmap"];

/// Parameter file of costmaps, with its findings.
pub struct CostmapFile {
    /// Costmaps, by the name of their node.
    pub configs: Vec<(&'static str, CostmapConfig)>,
    /// Findings on the parameters.
    pub diagnostics: Diagnostics,
    /// The text that the findings refer to.
    pub sources: SourceMap,
}

impl CostmapFile {
    /// Adds the findings that only the layers know.
    pub fn add_layer_findings(&mut self) {
        for (_, config) in &self.configs {
            let mut costmap = config.build();
            for finding in costmap.all_mut().flat_map(|layer| layer.diagnostics()) {
                self.diagnostics.push(finding);
            }
        }
    }
}

/// Reads the costmaps of a file; those without parameters are left out.
///
/// # Errors
/// When the file cannot be read, or has no costmap.
pub fn read(path: &Path, compat: Option<Nav2Release>) -> Result<CostmapFile, RunError> {
    let text = files::text(path)?;
    read_text(&path.display().to_string(), text, compat)
}

/// Parameter names of which a file of a single costmap has at least one.
const COSTMAP_PARAMETERS: [&str; 9] = [
    "global_frame",
    "robot_base_frame",
    "update_frequency",
    "rolling_window",
    "resolution",
    "plugins",
    "footprint",
    "robot_radius",
    "obstacle_layer",
];

/// Returns true if any part of a tree has a costmap parameter.
fn looks_like_costmap(tree: &periplus_yaml::YamlNode) -> bool {
    let Some(entries) = tree.entries() else { return false };
    entries.iter().any(|(key, value)| {
        key.text().is_some_and(|name| COSTMAP_PARAMETERS.contains(&name))
            || looks_like_costmap(value)
    })
}

/// Reads the costmaps of a named text, as [`read`] does.
///
/// # Errors
/// As for [`read`].
pub fn read_text(
    name: &str,
    text: String,
    compat: Option<Nav2Release>,
) -> Result<CostmapFile, RunError> {
    let mut sources = SourceMap::new();
    let file = sources.add(name.to_owned(), text);
    let mut diagnostics = Diagnostics::new();
    let tree = match periplus_yaml::parse(file, &sources) {
        Ok(Some(tree)) => tree,
        Ok(None) => return Err(RunError::NoParameters(format!("{name} is empty"))),
        Err(error) => {
            diagnostics.push(*error);
            return Ok(CostmapFile { configs: Vec::new(), diagnostics, sources });
        }
    };
    let named = |node: &&&str| CostmapConfig::is_in(&tree, node);
    let mut nodes: Vec<&&str> = NODES.iter().filter(named).collect();
    if nodes.is_empty() {
        // A file of a single costmap, such as those of ROS 1.
        if !looks_like_costmap(&tree) {
            return Err(RunError::NoParameters(format!(
                "{name} has no costmap: neither `local_costmap` nor `global_costmap`, nor a costmap \
                 parameter such as `resolution` or `plugins`; give a file with Nav2's parameters"
            )));
        }
        nodes = NODES.iter().take(1).collect();
    }
    let configs = nodes
        .into_iter()
        .map(|node| (*node, CostmapConfig::read_yaml(&tree, node, compat, &mut diagnostics)))
        .collect();
    Ok(CostmapFile { configs, diagnostics, sources })
}
