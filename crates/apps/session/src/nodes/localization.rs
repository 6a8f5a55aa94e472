//! Localization nodes: `map_server` and `amcl`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::Pose2;
use periplus_graph::{Graph, LifecycleNode, NodeSettings};
use periplus_localization::{AmclParams, SharedMaps};
use periplus_maps::Distro;
use periplus_nav_nodes::amcl::{AmclNode, read_parameters};
use periplus_nav_nodes::map_server::{MapServer, MapServerParams};
use periplus_os::Machine;
use periplus_params::{ParamValue, ParamValues};
use periplus_yaml::YamlNode;

use super::namespace::RobotNamespace;
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
        let files = LocalizationFiles::read(paths)?;
        let server = files.serve_map(graph)?;
        Self::beside(graph, files.values, profile, server, Arc::default())
    }

    /// Starts both nodes, `map_server` only if there is a map.
    ///
    /// # Errors
    /// When the graph refuses a node.
    pub fn new(graph: &Graph, map: Option<&Path>, values: ParamValues) -> Result<Self, RunError> {
        let files = LocalizationFiles { map: map.map(Path::to_owned), values };
        let server = files.serve_map(graph)?;
        Self::beside(graph, files.values, None, server, Arc::default())
    }

    /// Starts `amcl` beside a robot. It keeps the map server, if it is given one.
    fn beside(
        graph: &Graph,
        mut values: ParamValues,
        profile: Option<&RobotProfile>,
        server: Option<LifecycleNode<MapServer>>,
        maps: Arc<SharedMaps>,
    ) -> Result<Self, RunError> {
        let mut namespace = RobotNamespace::default();
        if let Some(profile) = profile {
            profile.fill(&mut values, ["odom_frame_id", "base_frame_id", "scan_topic"]);
            namespace = profile.namespace.clone();
            if let Some(start) = profile.start {
                set_start(&mut values, start);
            }
        }
        let amcl = AmclNode::at(namespace.node(graph, "amcl")?, values, Arc::new(Machine))?;
        amcl.with(|node| node.share_maps(maps));
        amcl.start();
        Ok(Self { amcl, _server: server })
    }

    /// Starts `amcl` beside each robot, and one map server for all of them.
    ///
    /// # Errors
    /// When a file cannot be used, or a node cannot start.
    pub(crate) fn of_fleet(
        graph: &Graph,
        paths: &[PathBuf],
        profiles: &[RobotProfile],
    ) -> Result<Vec<Self>, RunError> {
        let start = || {
            let files = LocalizationFiles::read(paths)?;
            let mut server = files.serve_map(graph)?;
            let maps = Arc::<SharedMaps>::default();
            let robots = profiles.iter().map(|profile| {
                let values = files.values.clone();
                Self::beside(graph, values, Some(profile), server.take(), maps.clone())
            });
            robots.collect::<Result<Vec<_>, RunError>>()
        };
        start().map_err(|error| RunError::node(NAME, error))
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

/// Map and parameters of `amcl`.
struct LocalizationFiles {
    map: Option<PathBuf>,
    values: ParamValues,
}

impl LocalizationFiles {
    /// Reads the YAML of a map, a file with parameters, or both.
    fn read(paths: &[PathBuf]) -> Result<Self, RunError> {
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
        let values = amcl_parameters(file, &[]).map_err(|error| match error {
            RunError::Reported => {
                RunError::NoParameters("the parameters of `amcl` have errors".into())
            }
            error => error,
        })?;
        Ok(Self { map, values })
    }

    /// Starts `map_server` if there is a map.
    fn serve_map(&self, graph: &Graph) -> Result<Option<LifecycleNode<MapServer>>, RunError> {
        let Some(path) = &self.map else { return Ok(None) };
        let amcl = AmclParams::from_values(&self.values);
        let params = MapServerParams {
            yaml_filename: path.display().to_string(),
            topic_name: amcl.map_topic,
            frame_id: amcl.global_frame_id,
        };
        let node = graph.node(NodeSettings::new("map_server"))?;
        let server = MapServer::new(node, params, Distro::Jazzy, Arc::new(Machine))?;
        server.start();
        Ok(Some(server))
    }
}

/// Lets `amcl` start at a pose, unless its parameters set one.
fn set_start(values: &mut ParamValues, start: Pose2) {
    if values.is_given("set_initial_pose") {
        return;
    }
    values.set("set_initial_pose", ParamValue::Bool(true));
    let numbers = [
        ("initial_pose.x", start.x_m),
        ("initial_pose.y", start.y_m),
        ("initial_pose.yaw", start.yaw_rad),
    ];
    for (name, value) in numbers {
        values.set(name, ParamValue::Number(value));
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
