//! Checks of parameter files.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};
use periplus_yaml::YamlNode;

use crate::error::RunError;
use crate::files;
use crate::nodes::read_costmap_text;

/// Returns the findings of clocks and costmaps of a parameter file.
///
/// # Errors
/// When the file cannot be read or has no parameters.
pub fn examine_parameters(path: &Path) -> Result<Vec<(Diagnostics, SourceMap)>, RunError> {
    let text = files::text(path)?;
    let mut sources = SourceMap::new();
    let mut found = Diagnostics::new();
    let file = sources.add(path.display().to_string(), text.clone());
    let mut all = Vec::new();
    match periplus_yaml::parse(file, &sources) {
        Ok(Some(tree)) => {
            times(&tree, &mut found);
            let has_costmap = text.contains("costmap");
            all.push((found, sources));
            if has_costmap {
                let mut costmaps = read_costmap_text(&path.display().to_string(), text, None)?;
                costmaps.add_layer_findings();
                all.push((costmaps.diagnostics, costmaps.sources));
            }
        }
        Ok(None) => return Err(RunError::NoParameters(format!("{} is empty", path.display()))),
        Err(error) => {
            found.push(*error);
            all.push((found, sources));
        }
    }
    Ok(all)
}

/// Reports nodes of one file that use different clocks.
fn times(tree: &YamlNode, found: &mut Diagnostics) {
    let mut said = Vec::new();
    collect(tree, "", &mut said);
    let (yes, no): (Vec<_>, Vec<_>) = said.into_iter().partition(|(_, value, _)| *value);
    let (Some((simulated, _, _)), false) = (yes.first(), no.is_empty()) else { return };
    for (name, _, node) in no {
        found.push(
            Diagnostic::error(
                "wall-time",
                format!("`{name}` uses the wall clock and `{simulated}` uses simulated time"),
            )
            .at(node.span)
            .note("their stamps differ by decades, so transforms cannot be looked up")
            .help("set `use_sim_time` to the same value for all nodes of the file"),
        );
    }
}

fn collect<'t>(node: &'t YamlNode, name: &str, said: &mut Vec<(String, bool, &'t YamlNode)>) {
    let Some(entries) = node.entries() else { return };
    for (key, value) in entries {
        let Some(key) = key.text() else { continue };
        if key == "use_sim_time" {
            if let Some(value_of) = value.truth() {
                said.push((name.to_owned(), value_of, value));
            }
        } else if key == "ros__parameters" {
            collect(value, name, said);
        } else {
            // The YAML reader limits the depth of the tree.
            collect(value, &format!("{name}/{key}"), said);
        }
    }
}
