//! Servers of Nav2's navigation, and stand-alone costmaps.

use std::path::Path;
use std::sync::Arc;

use periplus_costmap::CostmapConfig;
use periplus_diagnostics::{Diagnostics, plain_words};
use periplus_graph::{Graph, GraphError, LifecycleNode, Node};
use periplus_nav_nodes::costmap_2d::CostmapNode;
use periplus_nav_nodes::navigation::{NavigationNode, NavigationServer, NavigationSetup};
use periplus_nav_nodes::navigation_plugins::NavigationPlugins;
use periplus_os::Machine;
use periplus_resources::{FileWriteError, Store as _};

use crate::bringup::make::{self, ParameterFile};
use crate::bringup::parameters::NamedParameters;
use crate::bringup::parts::BuiltInRequest;

/// Creates a server, not yet configured; its costmap gets a separate node in the namespace of the server.
///
/// # Errors
/// A message when it cannot be created.
pub(crate) fn server(
    ask: &BuiltInRequest,
    (server, node): (NavigationServer, Node),
    graph: &Graph,
    named: &NamedParameters,
    notes: &mut Vec<String>,
) -> Result<NavigationNode, String> {
    let mut sections = vec![(node.names().name().to_owned(), named.clone())];
    if let Some(costmap) = server.costmap_name() {
        let around = node.names().namespace().trim_end_matches('/');
        let full_name = format!("{around}/{costmap}/{costmap}");
        sections.push((costmap.to_owned(), make::parameters_as(ask, &full_name, notes)));
    }
    let written = ParameterFile::of_nodes(&sections, node.full_name())?;
    let created = written.read(notes, |file, found| {
        let setup = NavigationSetup {
            graph,
            file,
            release: None,
            stamped_velocities: None,
            files: Arc::new(Machine),
            save_photo: Arc::new(save),
            plugins: NavigationPlugins::new(),
        };
        let costmap_node = |settings| graph.node(make::remapped(settings, ask));
        setup.create(server, node, costmap_node, found)
    });
    let created = created.map_err(|error: GraphError| error.to_string())?;
    created.with_costmap(|costmap| costmap.name_lines_of(written.sources));
    Ok(created)
}

/// Saves the photo of a waypoint, in a folder that may not exist yet.
fn save(path: &Path, bytes: &[u8]) -> Result<(), FileWriteError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)
            .map_err(|error| FileWriteError::Other(plain_words(&error)))?;
    }
    Machine.replace(path, bytes)
}

/// Creates a stand-alone costmap.
///
/// # Errors
/// A message when it cannot be created.
pub(crate) fn costmap_alone(
    ask: &BuiltInRequest,
    node: Node,
    notes: &mut Vec<String>,
) -> Result<LifecycleNode<CostmapNode>, String> {
    let name = node.names().name().to_owned();
    let named = make::parameters_as(ask, node.full_name(), notes);
    let written = ParameterFile::new(&named, node.full_name())?;
    let config = written.read(notes, |tree, found: &mut Diagnostics| match tree {
        Some(tree) => CostmapConfig::read_yaml(tree, &name, None, found),
        None => CostmapConfig::read([], None, found),
    });
    let costmap = CostmapNode::at(node, config).map_err(|error| error.to_string())?;
    costmap.with(|costmap| costmap.name_lines_of(written.sources));
    Ok(costmap)
}
