//! Mapping beside a simulation (`periplus sim --slam`), and parts shared with `periplus slam
//! --live`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Graph, GraphError, LifecycleNode, Node, NodeSettings, TopicInfo};
use periplus_maps::{Distro, Saving, render};
use periplus_msgs::Message as _;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_nav_nodes::slam_toolbox::{Pace, Program, SlamNode};
use periplus_os::Machine;
use periplus_params::{ParamValue, ParamValues};
use periplus_slam::{MapContradiction, Slam};

use crate::error::CliError;
use crate::sim::stack::RobotProfile;
use crate::{picture, terminal};

/// Number of loop closures that are printed.
const MAX_PRINTED: usize = 10;

/// Mapping options of `periplus sim`.
#[derive(Debug, Args)]
pub(crate) struct MappingOptions {
    /// Build a map while the robot drives, with a parameter file of `slam_toolbox` or
    /// `slam_gmapping` [default: default parameters]. At full speed every scan is processed
    #[arg(long, value_name = "FILE.yaml", num_args = 0..=1)]
    slam: Option<Option<PathBuf>>,
    #[command(flatten)]
    more: MoreMapping,
}

/// Additional options of mapping.
#[derive(Debug, Args)]
pub(crate) struct MoreMapping {
    /// Node to run: async, sync, localization, lifelong or gmapping [default: the one of the
    /// parameter file]
    #[arg(long, value_name = "PROGRAM")]
    slam_node: Option<Program>,
    /// At the end write map.yaml, map.pgm, map.session, and map.png with the poses of the graph and
    /// red rings at contradictions to a folder
    #[arg(long, value_name = "DIR")]
    slam_out: Option<PathBuf>,
}

impl MappingOptions {
    /// Returns true if mapping is requested.
    pub(crate) fn is_wanted(&self) -> bool {
        self.slam.is_some()
    }
}

impl MoreMapping {
    pub(crate) fn out(&self) -> Option<&Path> {
        self.slam_out.as_deref()
    }
}

/// SLAM node of a run.
pub(crate) struct Mapping {
    pub(crate) node: LifecycleNode<SlamNode>,
    out: Option<PathBuf>,
}

/// Reads a parameter file, detects its program and prints the findings.
pub(crate) fn parameters(
    path: Option<&Path>,
    wanted: Option<Program>,
) -> Result<(Program, ParamValues), CliError> {
    let mut diagnostics = Diagnostics::new();
    let Some(path) = path else {
        let program = wanted.unwrap_or(Program::Async);
        return Ok((program, program.table().check([], None, &mut diagnostics)));
    };
    let text = crate::paths::text(path)?;
    let mut sources = SourceMap::new();
    let file = sources.add(path.display().to_string(), text);
    let read = match periplus_yaml::parse(file, &sources) {
        Ok(Some(tree)) if tree.entries().is_none() => {
            return Err(CliError::failed(format!(
                "{} has no parameters: `--slam` takes a file of slam_toolbox or slam_gmapping",
                path.display()
            )));
        }
        Ok(Some(tree)) => {
            Some(periplus_nav_nodes::slam_toolbox::read(&tree, wanted, &mut diagnostics))
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
    terminal::diagnostics(&mut anstream::stderr().lock(), &diagnostics, &sources)?;
    if diagnostics.iter().any(|finding| finding.code == "no-parameters") {
        return Err(CliError::failed(format!(
            "{} has no parameters for slam_toolbox or slam_gmapping; leave the file out to map with the \
             defaults",
            path.display()
        )));
    }
    read.ok_or(CliError::Reported(1))
}

/// The only topic with scans, if `scan_topic` is not set and the default topic has none.
fn scan_topic(graph: &Graph, values: &ParamValues) -> Option<String> {
    const NAME: &str = "scan_topic";
    if values.table().find(NAME).is_some() && values.is_given(NAME) {
        return None;
    }
    let of_scans =
        |it: &TopicInfo| it.type_name == LaserScan::TYPE_NAME && !it.publishers.is_empty();
    let topics: Vec<TopicInfo> = graph.topics().into_iter().filter(of_scans).collect();
    match topics.as_slice() {
        [one] if one.name != "/scan" => Some(one.name.clone()),
        _ => None,
    }
}

impl Mapping {
    /// Adds the node to the graph of a run, if requested; `None` if not.
    pub(crate) fn join(
        graph: &Graph,
        options: &MappingOptions,
        is_paced: bool,
        (is_usual, profile): (bool, Option<&RobotProfile>),
    ) -> Result<Option<Self>, CliError> {
        let asked = options.slam.clone().or(is_usual.then_some(None));
        let Some(path) = &asked else {
            if options.more.slam_node.is_some() || options.more.slam_out.is_some() {
                let why = "`--slam-node` and `--slam-out` require `--slam`";
                return Err(CliError::failed(why));
            }
            return Ok(None);
        };
        let (program, mut values) = parameters(path.as_deref(), options.more.slam_node)?;
        if let Some(profile) = profile {
            // Scans have a separate rule below.
            profile.fill(&mut values, ["odom_frame", "base_frame", ""]);
        }
        let mut settings = NodeSettings::new(program.node_name());
        if let Some(topic) = scan_topic(graph, &values) {
            if program.is_toolbox() {
                terminal::say(&format!(
                    "mapping: using scans of {topic}; set `scan_topic` for another topic"
                ));
                values.set("scan_topic", ParamValue::Text(topic));
            } else {
                terminal::say(&format!(
                    "mapping: using scans of {topic}; use `-r scan:=` for another topic"
                ));
                settings = settings.remap("scan", &topic);
            }
        }
        let pace = if is_paced { Pace::Sliced } else { Pace::Whole };
        let node = graph.node(settings);
        Self::new(node, program, values, pace, options.more.out()).map(Some)
    }

    /// Starts this SLAM program.
    pub(crate) fn new(
        node: Result<Node, GraphError>,
        program: Program,
        values: ParamValues,
        pace: Pace,
        out: Option<&Path>,
    ) -> Result<Self, CliError> {
        let made =
            node.and_then(|node| SlamNode::at(node, program, values, Arc::new(Machine), pace));
        let node = made.map_err(|error| {
            CliError::failed(format!("{} cannot run: {error}", program.executable()))
        })?;
        node.start();
        Ok(Self { node, out: out.map(Path::to_owned) })
    }

    /// Prints the report at the end of a run.
    pub(crate) fn tell(&self, out: &mut dyn Write) -> io::Result<()> {
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

    /// Writes the requested results; a message if they cannot be written.
    pub(crate) fn write(&self) -> Result<Option<PathBuf>, String> {
        let Some(folder) = &self.out else { return Ok(None) };
        crate::paths::make_folder(folder)?;
        let put = |name: &str, bytes: &[u8]| crate::paths::write(&folder.join(name), bytes);
        let status = self.node.with(|node| node.status());
        let is_empty = status.counts.kept == 0 && status.graph.0 == 0;
        let Some(map) = self.node.with(|node| node.map()).filter(|_| !is_empty) else {
            return Err("there is no map to write: no scan was inserted".into());
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
