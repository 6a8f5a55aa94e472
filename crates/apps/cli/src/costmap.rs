//! Costmaps in simulations and on ROS 2: `periplus sim --costmap`, `periplus costmap` and `periplus
//! doctor costmap`.

pub(crate) mod doctor;
mod file;
pub(crate) mod serve;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use periplus_costmap::{Nav2Release, cost};
use periplus_graph::{Graph, LifecycleNode};
use periplus_images::{Layout, write_png};
use periplus_maps::palette::{Scheme, paint};
use periplus_nav_nodes::costmap_2d::{CostmapNode, VoxelMarkers};

use crate::error::CliError;
use crate::terminal;
use file::{File, read, read_text};

/// Costmap options of `periplus sim`.
#[derive(Debug, Args)]
pub(crate) struct CostmapOptions {
    /// Run the costmaps of a Nav2 parameter file beside the robot: `local_costmap` and
    /// `global_costmap`, if the file has them
    #[arg(long, value_name = "nav2_params.yaml")]
    costmap: Option<PathBuf>,
    /// At the end explain why the cell at this position is marked or free, for each costmap, in its
    /// frame [m]
    #[arg(long, value_name = "X,Y", value_parser = floor_point, allow_hyphen_values = true, requires = "costmap")]
    costmap_cell: Vec<FloorPoint>,
    /// At the end write each costmap to a folder as images in RViz's colours: costmap, map and raw
    #[arg(long, value_name = "FOLDER", requires = "costmap")]
    costmap_picture: Option<PathBuf>,
    /// Release of Nav2 whose behaviour is reproduced where releases differ
    #[arg(long, value_name = "humble|jazzy|main", requires = "costmap")]
    costmap_compat: Option<Nav2Release>,
}

/// Position on the floor \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
struct FloorPoint {
    x_m: f64,
    y_m: f64,
}

fn floor_point(word: &str) -> Result<FloorPoint, String> {
    let (x, y) = word.split_once(',').ok_or("give two numbers, such as `1.5,-0.2`")?;
    let number = |word: &str| {
        let number: Option<f64> = word.trim().parse().ok().filter(|it: &f64| it.is_finite());
        number.ok_or_else(|| format!("`{word}` is not a number"))
    };
    Ok(FloorPoint { x_m: number(x)?, y_m: number(y)? })
}

/// Costmap nodes of a run.
#[derive(Default)]
pub(crate) struct Costmaps {
    nodes: Vec<LifecycleNode<CostmapNode>>,
    _markers: Vec<VoxelMarkers>,
    cells: Vec<FloorPoint>,
    pictures: Option<PathBuf>,
}

impl Costmaps {
    /// Adds the costmap nodes to a graph, if requested. `usual` are the parameters used when no
    /// file is given.
    pub(crate) fn join(
        graph: &Graph,
        options: &CostmapOptions,
        usual: Option<&str>,
    ) -> Result<Self, CliError> {
        let Some(path) = &options.costmap else {
            return match usual {
                Some(text) => Self::of_text(graph, "the default costmaps", text, None),
                None => Ok(Self::default()),
            };
        };
        let costmaps = Self::of_file(graph, path, options.costmap_compat)?;
        costmaps.start();
        let (cells, pictures) = (options.costmap_cell.clone(), options.costmap_picture.clone());
        Ok(Self { cells, pictures, ..costmaps })
    }

    /// Creates the costmaps of a file, not yet configured.
    fn of_file(graph: &Graph, path: &Path, compat: Option<Nav2Release>) -> Result<Self, CliError> {
        Self::of_read(graph, read(path, compat))
    }

    /// Creates the costmaps of a named parameter text and activates them; their images go to a
    /// folder.
    pub(crate) fn of_text(
        graph: &Graph,
        name: &str,
        text: &str,
        pictures: Option<PathBuf>,
    ) -> Result<Self, CliError> {
        let costmaps = Self::of_read(graph, read_text(name, text.to_owned(), None))?;
        costmaps.start();
        Ok(Self { pictures, ..costmaps })
    }

    fn of_read(graph: &Graph, read: Result<File, String>) -> Result<Self, CliError> {
        let file = read?;
        terminal::diagnostics(&mut anstream::stderr().lock(), &file.diagnostics, &file.sources)?;
        let mut costmaps = Self::default();
        for (name, config) in file.configs {
            let made = CostmapNode::new(graph, name, config)
                .and_then(|node| Ok((node, VoxelMarkers::new(graph, &format!("/{name}"))?)));
            let (node, markers) =
                made.map_err(|error| CliError::failed(format!("{name} cannot run: {error}")))?;
            node.with(|node| node.name_lines_of(file.sources.clone()));
            costmaps.nodes.push(node);
            costmaps._markers.push(markers);
        }
        Ok(costmaps)
    }

    /// Returns true if one of them uses `/clock`.
    fn wants_simulated_time(&self) -> bool {
        self.nodes.iter().any(|node| node.with(|node| node.uses_simulated_time()))
    }

    /// Configures and activates them.
    fn start(&self) {
        self.nodes.iter().for_each(LifecycleNode::start);
    }

    /// Prints the report at the end of a run.
    pub(crate) fn tell(&self, out: &mut dyn Write) -> io::Result<()> {
        for node in &self.nodes {
            status(node, out)?;
            for FloorPoint { x_m, y_m } in &self.cells {
                match node.with(|node| node.inspect(*x_m, *y_m)) {
                    Some(report) => write!(out, "{report}")?,
                    None => writeln!(out, "({x_m}, {y_m}) is outside the costmap")?,
                }
            }
            if let Some(folder) = &self.pictures {
                for (scheme, suffix) in
                    [(Scheme::Costmap, ""), (Scheme::Map, "_map"), (Scheme::Raw, "_raw")]
                {
                    let name = format!("{}{suffix}.png", node.node().names().name());
                    match draw(node, scheme, &folder.join(&name)) {
                        Ok(()) => writeln!(out, "drawn: {}", folder.join(name).display())?,
                        Err(why) => terminal::complain(&why),
                    }
                }
            }
        }
        Ok(())
    }

    /// Writes images in costmap colours to the folder, if one was given.
    ///
    /// # Errors
    /// A message when an image cannot be written.
    pub(crate) fn write(&self) -> Result<(), String> {
        let Some(folder) = &self.pictures else { return Ok(()) };
        self.nodes.iter().try_for_each(|node| {
            let name = format!("{}.png", node.node().names().name());
            draw(node, Scheme::Costmap, &folder.join(name))
        })
    }
}

/// Renders an image in RViz colours, four pixels per cell.
fn draw(node: &LifecycleNode<CostmapNode>, scheme: Scheme, path: &Path) -> Result<(), String> {
    const PIXELS_PER_CELL: usize = 4;
    let drawn = node.with(|node| {
        let grid = node.costmap()?.costmap();
        let (width, height) = (grid.info().width, grid.info().height);
        let values: Vec<i8> = grid.costs().iter().map(|cost| cost::occupancy_of(*cost)).collect();
        let samples = paint(&scheme.palette(), width, &values, PIXELS_PER_CELL);
        let size = |cells: usize| (cells * PIXELS_PER_CELL) as u32;
        Some(write_png(size(width), size(height), Layout::Rgb, &samples))
    });
    let Some(bytes) = drawn else { return Err("the costmap has no data yet".into()) };
    if let Some(folder) = path.parent() {
        crate::paths::make_folder(folder)?;
    }
    crate::paths::write(path, &bytes)
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
