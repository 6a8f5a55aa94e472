//! Mapping nodes: those of `slam_toolbox` and `slam_gmapping`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Graph, GraphError, LifecycleNode, Node, NodeSettings, TopicInfo};
use periplus_maps::{Distro, Saving, render};
use periplus_msgs::Message as _;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_nav_nodes::slam_toolbox::{Pace, Program, SlamNode};
use periplus_os::Machine;
use periplus_params::{ParamValue, ParamValues};
use periplus_slam::{MapContradiction, Slam};

use super::namespace::RobotNamespace;
use super::profile::RobotProfile;
use crate::error::RunError;
use crate::{files, picture, terminal};

/// Number of loop closures that are printed.
const MAX_PRINTED: usize = 10;

/// Program and parameters of a mapping node.
#[derive(Clone, Debug)]
pub enum MappingSource {
    /// Parameter file (default parameters without one) and the program (that of the file without
    /// one).
    File(Option<PathBuf>, Option<Program>),
    /// Program and parameters.
    Values(Program, ParamValues),
}

impl MappingSource {
    /// Reads the file, if it is one, so that several nodes can start with its parameters.
    pub(super) fn read_once(&mut self) -> Result<(), RunError> {
        if let Self::File(path, program) = self {
            let (program, values) = slam_parameters(path.as_deref(), *program)?;
            *self = Self::Values(program, values);
        }
        Ok(())
    }

    /// Reads the file, if it is one, and prints its findings.
    fn read(self) -> Result<(Program, ParamValues), RunError> {
        match self {
            Self::File(path, program) => slam_parameters(path.as_deref(), program),
            Self::Values(program, values) => Ok((program, values)),
        }
    }
}

/// Mapping node to run, and where its results are written.
#[derive(Clone, Debug)]
pub struct MappingRequest {
    /// Program and parameters.
    pub source: MappingSource,
    /// Folder of the results; none are written without it.
    pub out: Option<PathBuf>,
}

/// SLAM node of a session.
pub struct MappingNode {
    /// The node.
    pub node: LifecycleNode<SlamNode>,
    out: Option<PathBuf>,
}

/// Reads a parameter file, detects its program and prints the findings.
///
/// # Errors
/// When the file cannot be read or has errors, or no parameters of a mapping node.
pub fn slam_parameters(
    path: Option<&Path>,
    wanted: Option<Program>,
) -> Result<(Program, ParamValues), RunError> {
    let mut diagnostics = Diagnostics::new();
    let Some(path) = path else {
        let program = wanted.unwrap_or(Program::Async);
        return Ok((program, program.table().check([], None, &mut diagnostics)));
    };
    let text = files::text(path)?;
    let mut sources = SourceMap::new();
    let file = sources.add(path.display().to_string(), text);
    let mut is_for_other_nodes = false;
    let read = match periplus_yaml::parse(file, &sources) {
        Ok(Some(tree)) if tree.entries().is_none() => {
            return Err(RunError::NoParameters(format!(
                "{} has no parameters: `--slam` takes a file of slam_toolbox or slam_gmapping",
                path.display()
            )));
        }
        Ok(Some(tree)) => {
            let read = periplus_nav_nodes::slam_toolbox::read(&tree, wanted, &mut diagnostics);
            is_for_other_nodes = read.is_for_other_nodes;
            Some((read.program, read.values))
        }
        Ok(None) => {
            let program = wanted.unwrap_or(Program::Async);
            Some((program, program.table().check([], None, &mut diagnostics)))
        }
        Err(error) => {
            diagnostics.push(*error);
            None
        }
    };
    terminal::diagnostics(&mut terminal::messages(), &diagnostics, &sources)?;
    if is_for_other_nodes {
        return Err(RunError::NoParameters(format!(
            "{} has no parameters for slam_toolbox or slam_gmapping; leave the file out to map with the \
             defaults",
            path.display()
        )));
    }
    read.ok_or(RunError::Reported)
}

/// The only topic with scans, if `scan_topic` is not set and the default topic has none.
fn scan_topic(graph: &Graph, namespace: &RobotNamespace, values: &ParamValues) -> Option<String> {
    const NAME: &str = "scan_topic";
    if values.table().find(NAME).is_some() && values.is_given(NAME) {
        return None;
    }
    let of_scans = |it: &TopicInfo| {
        let is_own = namespace.contains(&it.name);
        is_own && it.type_name == LaserScan::TYPE_NAME && !it.publishers.is_empty()
    };
    let topics: Vec<TopicInfo> = graph.topics().into_iter().filter(of_scans).collect();
    match topics.as_slice() {
        [one] if !namespace.is_root() || one.name != "/scan" => Some(one.name.clone()),
        _ => None,
    }
}

impl MappingNode {
    /// Adds the node to the graph of a simulation and starts it. Unset frames are those of the
    /// robot; without `scan_topic` and without `/scan` it uses the only topic with scans.
    ///
    /// # Errors
    /// When the graph refuses the node.
    pub fn in_simulation(
        graph: &Graph,
        request: MappingRequest,
        pace: Pace,
        profile: Option<&RobotProfile>,
    ) -> Result<Self, RunError> {
        let (program, mut values) = request.source.read()?;
        let namespace = profile.map(|profile| profile.namespace.clone()).unwrap_or_default();
        let namespace = &namespace;
        if let Some(profile) = profile {
            // Scans have a separate rule below.
            profile.fill(&mut values, ["odom_frame", "base_frame", ""]);
        }
        let mut settings = namespace.settings(program.node_name());
        if let Some(topic) = scan_topic(graph, namespace, &values) {
            if namespace.is_root() {
                let option =
                    if program.is_toolbox() { "set `scan_topic`" } else { "use `-r scan:=`" };
                terminal::say(&format!(
                    "mapping: using scans of {topic}; {option} for another topic"
                ));
            }
            if program.is_toolbox() {
                values.set("scan_topic", ParamValue::Text(topic));
            } else {
                settings = settings.remap("scan", &topic);
            }
        }
        Self::start(graph.node(settings), (program, values), request.out, pace)
    }

    /// Adds the node to a live graph and starts it.
    ///
    /// # Errors
    /// When the graph refuses the node.
    pub fn live(graph: &Graph, request: MappingRequest) -> Result<Self, RunError> {
        let (program, values) = request.source.read()?;
        let node = graph.node(NodeSettings::new(program.node_name()));
        Self::start(node, (program, values), request.out, Pace::Whole)
    }

    fn start(
        node: Result<Node, GraphError>,
        (program, values): (Program, ParamValues),
        out: Option<PathBuf>,
        pace: Pace,
    ) -> Result<Self, RunError> {
        let node = node
            .and_then(|node| SlamNode::at(node, program, values, Arc::new(Machine), pace))
            .map_err(|error| RunError::node(program.executable(), error))?;
        node.start();
        Ok(Self { node, out })
    }

    /// Writes the report at the end of a run.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_report(&self, out: &mut dyn Write) -> io::Result<()> {
        let status = self.node.with(|node| node.status());
        let counts = status.counts;
        writeln!(
            out,
            "{}, as {}: {} scans, {} kept",
            status.node,
            status.program.executable(),
            counts.scans,
            counts.kept
        )?;
        let (scans, links) = status.graph;
        if scans > 0 {
            writeln!(
                out,
                "  a graph of {scans} scans and {links} links, {} of them ties",
                counts.proximity
            )?;
        }
        if counts.kept <= 1 {
            terminal::warn(&format!(
                "the map contains {}: the robot has not moved, or its scans did not match; drive it \
                 (`--cmd FILE`, `periplus teleop`)",
                if counts.kept == 0 { "no scan" } else { "one scan" }
            ));
        }
        let lost = [
            (counts.lost, "did not match"),
            (counts.ignored, "had no usable range"),
            (status.left_out as usize, "were dropped for newer ones"),
            (status.dropped as usize, "had no transforms"),
        ];
        for (count, what) in lost.into_iter().filter(|it| it.0 > 0) {
            writeln!(out, "  {count} scans {what}")?;
        }
        if let Some(trouble) = &status.trouble {
            writeln!(out, "  {trouble}")?;
        }
        if let Some(remedy) = &status.correction {
            terminal::warn(&format!("the map was restarted: {remedy}"));
        }
        for found in self.contradictions() {
            terminal::warn(&found.remark().to_string());
        }
        let accepted = status.closures.iter().filter(|it| it.is_accepted).count();
        if !status.closures.is_empty() {
            let refused = status.closures.len() - accepted;
            writeln!(out, "  {accepted} loops closed, {refused} refused")?;
        }
        for closure in status.closures.iter().rev().take(MAX_PRINTED) {
            let verdict = if closure.is_accepted { "closed" } else { "refused" };
            writeln!(
                out,
                "    {} - {} {verdict}: {}",
                closure.keyframes.0, closure.keyframes.1, closure.reason
            )?;
        }
        Ok(())
    }

    /// Regions of the current map in which two passes contradict each other.
    fn contradictions(&self) -> Vec<MapContradiction> {
        self.node.with(|node| node.graph().map(Slam::audit)).unwrap_or_default()
    }

    /// Writes the requested results and returns their folder.
    ///
    /// # Errors
    /// When there is no map, or a file cannot be written.
    pub fn write_results(&self) -> Result<Option<PathBuf>, RunError> {
        let Some(folder) = &self.out else { return Ok(None) };
        files::make_folder(folder)?;
        let put = |name: &str, bytes: &[u8]| files::write(&folder.join(name), bytes);
        let status = self.node.with(|node| node.status());
        let is_empty = status.counts.kept == 0 && status.graph.0 == 0;
        let Some(map) = self.node.with(|node| node.map()).filter(|_| !is_empty) else {
            return Err(RunError::NoData("there is no map to write: no scan was inserted"));
        };
        let files = render(&map, &Saving::new("map", Distro::Jazzy));
        put(&files.image_path, &files.image)?;
        put(&files.yaml_path, files.yaml.as_bytes())?;
        let poses = self.node.with(|node| node.graph().map(|slam| slam.poses().to_vec()));
        let poses = poses.unwrap_or_default();
        let marked = self.contradictions().into_iter().map(|it| it.map_from_base);
        let marked: Vec<(f64, f64)> = marked.map(|it| (it.x_m, it.y_m)).collect();
        put("map.png", &picture::draw(&map, &poses, &marked))?;
        if let Some(session) = self.node.with(|node| node.graph().map(Slam::save)) {
            put("map.session", &session)?;
        }
        Ok(Some(folder.clone()))
    }
}
