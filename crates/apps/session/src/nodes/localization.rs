//! Localization nodes: `map_server` and `amcl`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Graph, LifecycleNode, NodeSettings};
use periplus_localization::AmclParams;
use periplus_maps::Distro;
use periplus_nav_nodes::amcl::{AmclNode, read_parameters};
use periplus_nav_nodes::map_server::{MapServer, MapServerParams};
use periplus_os::Machine;
use periplus_params::ParamValues;
use periplus_yaml::YamlNode;

use super::profile::RobotProfile;
use crate::error::RunError;
use crate::{files, terminal};

/// Localization nodes.
pub struct Localization {
    amcl: LifecycleNode<AmclNode>,
    _server: Option<LifecycleNode<MapServer>>,
}

impl Localization {
    /// Adds the nodes to a graph and starts them. The files are the YAML of a map, a file with
    /// parameters, or both.
    ///
    /// # Errors
    /// When a file cannot be used, or a node cannot start.
    pub fn from_files(
        graph: &Graph,
        paths: &[PathBuf],
        profile: Option<&RobotProfile>,
    ) -> Result<Self, RunError> {
        Self::of_files(graph, paths, profile).map_err(|error| RunError::node(NAME, error))
    }

    fn of_files(
        graph: &Graph,
        paths: &[PathBuf],
        profile: Option<&RobotProfile>,
    ) -> Result<Self, RunError> {
        let (mut map, mut file) = (None, None);
        for path in paths {
            let yaml = ParameterFile::read(path)?;
            if is_map(&yaml) {
                map = Some(path.clone());
            } else {
                map = map.or_else(|| map_of(&yaml, path));
                file = Some(yaml);
            }
        }
        let mut values = amcl_parameters(file, &[]).map_err(|error| match error {
            RunError::Reported => {
                RunError::NoParameters("the parameters of `amcl` have errors".into())
            }
            error => error,
        })?;
        if let Some(profile) = profile {
            profile.fill(&mut values, ["odom_frame_id", "base_frame_id", "scan_topic"]);
        }
        Self::new(graph, map.as_deref(), values)
    }

    /// Starts both nodes, `map_server` only if there is a map.
    ///
    /// # Errors
    /// When the graph refuses a node.
    pub fn new(graph: &Graph, map: Option<&Path>, values: ParamValues) -> Result<Self, RunError> {
        let server = map.map(|path| {
            let amcl = AmclParams::from_values(&values);
            let params = MapServerParams {
                yaml_filename: path.display().to_string(),
                topic_name: amcl.map_topic,
                frame_id: amcl.global_frame_id,
            };
            let node = graph.node(NodeSettings::new("map_server"))?;
            MapServer::new(node, params, Distro::Jazzy, Arc::new(Machine))
        });
        let server = server.transpose()?;
        let amcl = AmclNode::new(graph, values, Arc::new(Machine))?;
        if let Some(server) = &server {
            server.start();
        }
        amcl.start();
        Ok(Self { amcl, _server: server })
    }

    /// The node `amcl`.
    pub fn amcl(&self) -> &LifecycleNode<AmclNode> {
        &self.amcl
    }

    /// Writes the report at the end of a run.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_report(&self, out: &mut dyn Write) -> io::Result<()> {
        let text = self.amcl.with(|node| {
            let amcl = node.amcl()?;
            let status = amcl.status();
            let pose = amcl.estimate().zip(amcl.map_from_odom()).map(|(estimate, _)| {
                let (pose, spread_m) = (estimate.pose, estimate.covariance.radius_m());
                let degrees = pose.yaw_rad.to_degrees();
                format!(
                    "({:.3}, {:.3}), {degrees:.1} degrees, to {spread_m:.2} m",
                    pose.x_m, pose.y_m
                )
            });
            let pose = pose.unwrap_or_else(|| "no pose yet".into());
            Some(format!("localization: {pose}: {:?}, {}", status.state, status.reason))
        });
        writeln!(out, "{}", text.unwrap_or_else(|| "localization: not configured".into()))?;
        if let Some(trouble) = self.amcl.with(|node| node.trouble().map(str::to_owned)) {
            writeln!(out, "  {trouble}")?;
        }
        Ok(())
    }
}

/// Name of the task in errors.
const NAME: &str = "localization";

/// YAML file of parameters with its findings.
#[derive(Debug)]
pub struct ParameterFile {
    /// Content, if the file is valid YAML.
    pub tree: Option<YamlNode>,
    diagnostics: Diagnostics,
    sources: SourceMap,
}

impl ParameterFile {
    /// Reads a file.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn read(path: &Path) -> Result<Self, RunError> {
        let text = files::text(path)?;
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add(path.display().to_string(), text);
        let tree = match periplus_yaml::parse(file, &sources) {
            Ok(tree) => tree,
            Err(error) => {
                diagnostics.push(*error);
                None
            }
        };
        Ok(Self { tree, diagnostics, sources })
    }
}

/// Parameters of `amcl` from a file and the command line; prints the findings.
///
/// # Errors
/// When they have errors, which are printed.
pub fn amcl_parameters(
    file: Option<ParameterFile>,
    words: &[(String, String)],
) -> Result<ParamValues, RunError> {
    let none =
        || ParameterFile { tree: None, diagnostics: Diagnostics::new(), sources: SourceMap::new() };
    let ParameterFile { tree, mut diagnostics, sources } = file.unwrap_or_else(none);
    let values = read_parameters(tree.as_ref(), "amcl", words, &mut diagnostics);
    terminal::diagnostics(&mut terminal::messages(), &diagnostics, &sources)?;
    if diagnostics.has_errors() { Err(RunError::Reported) } else { Ok(values) }
}

/// Returns true if a file describes a map.
fn is_map(yaml: &ParameterFile) -> bool {
    yaml.tree.as_ref().is_some_and(|tree| tree.get("image").is_some())
}

/// Map that a parameter file sets for `map_server`, relative to the file.
fn map_of(yaml: &ParameterFile, path: &Path) -> Option<PathBuf> {
    let parameters = yaml.tree.as_ref()?.get("map_server")?.get("ros__parameters")?;
    let name =
        parameters.get("yaml_filename").and_then(YamlNode::text).filter(|it| !it.is_empty())?;
    Some(path.parent().unwrap_or(Path::new("")).join(name))
}
