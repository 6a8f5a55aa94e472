//! Localization beside a simulation: the nodes `map_server` and `amcl`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use periplus_graph::{Graph, LifecycleNode, NodeSettings};
use periplus_nav_nodes::amcl::AmclNode;
use periplus_nav_nodes::map_server::{MapServer, MapServerSettings};
use periplus_os::Machine;
use periplus_params::ParamValues;
use periplus_yaml::YamlNode;

use super::options::{self, Yaml};
use crate::error::CliError;
use crate::sim::stack::RobotProfile;

/// Localization options of `periplus sim`.
#[derive(Debug, Args)]
pub(crate) struct BesideOptions {
    /// Run `map_server` and `amcl` of Nav2 beside the robot: the YAML of a map, a file with their
    /// parameters, or both, separated by a space
    #[arg(long, value_name = "MAP.yaml|FILE")]
    localize: Vec<PathBuf>,
}

/// Localization nodes.
pub(crate) struct Localization {
    amcl: LifecycleNode<AmclNode>,
    _server: Option<LifecycleNode<MapServer>>,
}

impl BesideOptions {
    /// Returns true if localization is requested.
    pub(crate) fn is_wanted(&self) -> bool {
        !self.localize.is_empty()
    }
}

impl Localization {
    /// Adds the nodes to a graph, if requested; `None` if not.
    pub(crate) fn join(
        graph: &Graph,
        options: &BesideOptions,
        profile: Option<&RobotProfile>,
    ) -> Result<Option<Self>, CliError> {
        if options.localize.is_empty() {
            return Ok(None);
        }
        let (mut map, mut file) = (None, None);
        for path in &options.localize {
            let yaml = options::yaml(path).map_err(cannot_run)?;
            if is_map(&yaml) {
                map = Some(path.clone());
            } else {
                map = map.or_else(|| map_of(&yaml, path));
                file = Some(yaml);
            }
        }
        let mut values = options::tell(file, &[]).map_err(|error| match error {
            CliError::Reported(_) => cannot_run("the parameters of `amcl` have errors".into()),
            error => error,
        })?;
        if let Some(profile) = profile {
            profile.fill(&mut values, ["odom_frame_id", "base_frame_id", "scan_topic"]);
        }
        Self::new(graph, map.as_deref(), values).map(Some).map_err(cannot_run)
    }

    /// Starts both nodes, `map_server` only if there is a map; a message if they cannot start.
    pub(crate) fn new(
        graph: &Graph,
        map: Option<&Path>,
        values: ParamValues,
    ) -> Result<Self, String> {
        let server = map.map(|path| {
            let settings = MapServerSettings {
                yaml_filename: path.display().to_string(),
                topic_name: values.text("map_topic").unwrap_or_else(|| "map".into()),
                frame_id: values.text("global_frame_id").unwrap_or_else(|| "map".into()),
                ..MapServerSettings::default()
            };
            let node = graph.node(NodeSettings::new("map_server"))?;
            MapServer::new(node, settings, Arc::new(Machine))
        });
        let server = server.transpose().map_err(|error| error.to_string())?;
        let amcl = AmclNode::new(graph, values, Arc::new(Machine));
        let amcl = amcl.map_err(|error| error.to_string())?;
        if let Some(server) = &server {
            server.start();
        }
        amcl.start();
        Ok(Self { amcl, _server: server })
    }

    /// The node `amcl`.
    pub(super) fn amcl(&self) -> &LifecycleNode<AmclNode> {
        &self.amcl
    }

    /// Prints the report at the end of a run.
    pub(crate) fn tell(&self, out: &mut dyn Write) -> io::Result<()> {
        let told = self.amcl.with(|node| {
            let amcl = node.amcl()?;
            let status = amcl.status();
            let place = amcl.estimate().zip(amcl.map_from_odom()).map(|(estimate, _)| {
                let (pose, spread_m) = (estimate.pose, estimate.covariance.radius_m());
                let degrees = pose.yaw_rad.to_degrees();
                format!(
                    "({:.3}, {:.3}), {degrees:.1} degrees, to {spread_m:.2} m",
                    pose.x_m, pose.y_m
                )
            });
            let place = place.unwrap_or_else(|| "no pose yet".into());
            Some(format!("localization: {place}: {:?}, {}", status.state, status.reason))
        });
        writeln!(out, "{}", told.unwrap_or_else(|| "localization: not configured".into()))?;
        if let Some(trouble) = self.amcl.with(|node| node.trouble().map(str::to_owned)) {
            writeln!(out, "  {trouble}")?;
        }
        Ok(())
    }
}

/// Error of localization that cannot start.
fn cannot_run(why: String) -> CliError {
    CliError::Failed(format!("localization cannot run: {why}"))
}

/// Returns true if a file describes a map.
fn is_map(yaml: &Yaml) -> bool {
    yaml.tree.as_ref().is_some_and(|tree| tree.get("image").is_some())
}

/// Map that a parameter file sets for `map_server`, relative to the file.
fn map_of(yaml: &Yaml, path: &Path) -> Option<PathBuf> {
    let parameters = yaml.tree.as_ref()?.get("map_server")?.get("ros__parameters")?;
    let name =
        parameters.get("yaml_filename").and_then(YamlNode::text).filter(|it| !it.is_empty())?;
    Some(path.parent().unwrap_or(Path::new("")).join(name))
}
