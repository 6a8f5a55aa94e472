//! Costmap nodes.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use periplus_costmap::{Nav2Release, cost};
use periplus_graph::{Graph, LifecycleNode, NodeSettings};
use periplus_images::{Layout, write_png};
use periplus_maps::palette::{Scheme, paint};
use periplus_nav_nodes::costmap_2d::{CostmapNode, VoxelMarkers};

use super::costmap_file::{CostmapFile, read, read_text};
use super::namespace::RobotNamespace;
use crate::error::RunError;
use crate::{files, terminal};

/// Source of the parameters of costmaps.
#[derive(Clone, Debug)]
pub enum CostmapSource {
    /// A parameter file of Nav2, and the release whose behaviour is reproduced.
    File(PathBuf, Option<Nav2Release>),
    /// A text with its name in findings.
    Text(&'static str, String),
}

/// Costmap nodes to run, and what is reported at the end.
#[derive(Clone, Debug)]
pub struct CostmapRequest {
    /// Parameters.
    pub source: CostmapSource,
    /// Cells whose costs are explained.
    pub cells: Vec<FloorPoint>,
    /// Folder for images of the costmaps.
    pub images: Option<PathBuf>,
}

/// Position on the floor \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorPoint {
    /// Along the x axis.
    pub x_m: f64,
    /// Along the y axis.
    pub y_m: f64,
}

/// Costmap nodes of a session.
#[derive(Default)]
pub struct Costmaps {
    nodes: Vec<LifecycleNode<CostmapNode>>,
    _markers: Vec<VoxelMarkers>,
    cells: Vec<FloorPoint>,
    images: Option<PathBuf>,
}

impl Costmaps {
    /// Adds the costmap nodes to a graph, not yet configured.
    ///
    /// # Errors
    /// When the parameters cannot be read, or a node cannot start.
    pub fn new(graph: &Graph, request: CostmapRequest) -> Result<Self, RunError> {
        Self::within(graph, &RobotNamespace::default(), request)
    }

    /// Adds the costmap nodes of a robot to a graph, not yet configured.
    ///
    /// # Errors
    /// As [`Costmaps::new`].
    pub fn within(
        graph: &Graph,
        namespace: &RobotNamespace,
        request: CostmapRequest,
    ) -> Result<Self, RunError> {
        let file = match request.source {
            CostmapSource::File(path, compat) => read(&path, compat)?,
            CostmapSource::Text(name, text) => read_text(name, text, None)?,
        };
        Self::of_file(graph, namespace, file, request.cells, request.images)
    }

    fn of_file(
        graph: &Graph,
        namespace: &RobotNamespace,
        file: CostmapFile,
        cells: Vec<FloorPoint>,
        images: Option<PathBuf>,
    ) -> Result<Self, RunError> {
        terminal::diagnostics(&mut terminal::messages(), &file.diagnostics, &file.sources)?;
        let mut costmaps = Self { cells, images, ..Self::default() };
        for (name, config) in file.configs {
            // As in Nav2 in a namespace of its name: `/local_costmap/local_costmap`.
            let around = namespace.topic(name);
            let settings = namespace.with_rules(NodeSettings::new(name).namespace(&around));
            let made = graph
                .node(settings)
                .and_then(|node| CostmapNode::at(node, config))
                .and_then(|node| Ok((node, VoxelMarkers::new(graph, &around)?)));
            let (node, markers) = made.map_err(|error| RunError::node(name, error))?;
            node.with(|node| node.name_lines_of(file.sources.clone()));
            costmaps.nodes.push(node);
            costmaps._markers.push(markers);
        }
        Ok(costmaps)
    }

    /// Returns true if one of them uses `/clock`.
    #[must_use]
    pub fn wants_simulated_time(&self) -> bool {
        self.nodes.iter().any(|node| node.with(|node| node.uses_simulated_time()))
    }

    /// Configures and activates them.
    pub fn start(&self) {
        self.nodes.iter().for_each(LifecycleNode::start);
    }

    /// The nodes.
    pub fn nodes(&self) -> &[LifecycleNode<CostmapNode>] {
        &self.nodes
    }

    /// Writes the report at the end of a run, and the requested images.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_report(&self, out: &mut dyn Write) -> io::Result<()> {
        for node in &self.nodes {
            status(node, out)?;
            for FloorPoint { x_m, y_m } in &self.cells {
                match node.with(|node| node.inspect(*x_m, *y_m)) {
                    Some(report) => write!(out, "{report}")?,
                    None => writeln!(out, "({x_m}, {y_m}) is outside the costmap")?,
                }
            }
            if let Some(folder) = &self.images {
                for (scheme, suffix) in
                    [(Scheme::Costmap, ""), (Scheme::Map, "_map"), (Scheme::Raw, "_raw")]
                {
                    let name = format!("{}{suffix}.png", node.node().names().name());
                    match draw(node, scheme, &folder.join(&name)) {
                        Ok(()) => writeln!(out, "drawn: {}", folder.join(name).display())?,
                        Err(error) => terminal::complain(&error.to_string()),
                    }
                }
            }
        }
        Ok(())
    }

    /// Writes images in costmap colours to the folder, if one was given.
    ///
    /// # Errors
    /// When an image cannot be written.
    pub fn write_images(&self) -> Result<(), RunError> {
        let Some(folder) = &self.images else { return Ok(()) };
        self.nodes.iter().try_for_each(|node| {
            let name = format!("{}.png", node.node().names().name());
            draw(node, Scheme::Costmap, &folder.join(name))
        })
    }
}

/// Renders an image in RViz colours, four pixels per cell.
fn draw(node: &LifecycleNode<CostmapNode>, scheme: Scheme, path: &Path) -> Result<(), RunError> {
    const PIXELS_PER_CELL: usize = 4;
    let drawn = node.with(|node| {
        let grid = node.costmap()?.costmap();
        let (width, height) = (grid.info().width, grid.info().height);
        let values: Vec<i8> = grid.costs().iter().map(|cost| cost::occupancy_of(*cost)).collect();
        let samples = paint(&scheme.palette(), width, &values, PIXELS_PER_CELL);
        let size = |cells: usize| (cells * PIXELS_PER_CELL) as u32;
        Some(write_png(size(width), size(height), Layout::Rgb, &samples))
    });
    let Some(bytes) = drawn else { return Err(RunError::NoData("the costmap has no data yet")) };
    if let Some(folder) = path.parent() {
        files::make_folder(folder)?;
    }
    Ok(files::write(path, &bytes)?)
}

/// Prints the inputs of a costmap and the missing ones.
fn status(node: &LifecycleNode<CostmapNode>, out: &mut dyn Write) -> io::Result<()> {
    let status = node.with(|node| node.status());
    let (width, height) = status.size;
    writeln!(out, "{}: {width} x {height} cells, {} updates", status.node, status.updates)?;
    if let Some(trouble) = &status.trouble {
        writeln!(out, "  no update: {trouble}")?;
    }
    for (source, topic, messages, age_s) in &status.sources {
        match age_s {
            Some(age_s) => {
                writeln!(
                    out,
                    "  {source} ({topic}): {messages} messages, the last {age_s:.2} s ago"
                )?;
            }
            None if *messages == 0 => writeln!(out, "  {source} ({topic}): no messages received")?,
            None => writeln!(out, "  {source} ({topic}): {messages} messages, none usable")?,
        }
    }
    for advice in &status.advice {
        writeln!(out, "  {advice}")?;
    }
    Ok(())
}
