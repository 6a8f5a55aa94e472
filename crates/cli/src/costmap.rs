//! Costmaps in runs: `periplus sim --costmap` and `periplus doctor costmap`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use periplus_costmap::{Compat, Config, cost};
use periplus_costmap_nodes::{CostmapNode, VoxelMarkers};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::Graph;
use periplus_maps::palette::Scheme;
use periplus_pictures::{Layout, write_png};
use periplus_resources::Host as _;

use crate::terminal;

/// The costmaps of Nav2, by the names of their nodes.
const NODES: [&str; 2] = ["local_costmap", "global_costmap"];

/// What `periplus sim` takes for costmaps.
#[derive(Debug, Args)]
pub(crate) struct CostmapOptions {
    /// Run the costmaps of a file with Nav2's parameters beside the robot: `local_costmap` and
    /// `global_costmap`, as far as they are in it
    #[arg(long, value_name = "nav2_params.yaml")]
    costmap: Option<PathBuf>,
    /// At the end tell why the cell at this place is marked, or is not; of each costmap, in its own
    /// frame [m]
    #[arg(long, value_name = "X,Y", value_parser = place, allow_hyphen_values = true, requires = "costmap")]
    costmap_cell: Vec<Place>,
    /// At the end write each costmap to a folder as a picture in RViz' colours
    #[arg(long, value_name = "FOLDER", requires = "costmap")]
    costmap_picture: Option<PathBuf>,
    /// Whose habits the costmaps have where distributions differ
    #[arg(long, value_name = "humble|jazzy|main", requires = "costmap")]
    costmap_compat: Option<Compat>,
}

/// A place on the ground [m].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    x_m: f64,
    y_m: f64,
}

fn place(word: &str) -> Result<Place, String> {
    let (x, y) = word.split_once(',').ok_or("it has to be two numbers, such as `1.5,-0.2`")?;
    let number = |word: &str| {
        let number: Option<f64> = word.trim().parse().ok().filter(|it: &f64| it.is_finite());
        number.ok_or_else(|| format!("`{word}` is no number"))
    };
    Ok(Place { x_m: number(x)?, y_m: number(y)? })
}

/// Costmaps of a run.
pub(crate) struct Costmaps {
    nodes: Vec<CostmapNode>,
    _markers: Vec<VoxelMarkers>,
    cells: Vec<Place>,
    pictures: Option<PathBuf>,
}

/// A file with parameters, and what is wrong with it.
struct File {
    configs: Vec<(&'static str, Config)>,
    diagnostics: Diagnostics,
    sources: SourceMap,
}

/// Reads the costmaps of a file; those that it does not name are left out.
///
/// # Errors
/// Why there is none.
fn read(path: &Path, compat: Option<Compat>) -> Result<File, String> {
    let bytes = periplus_host::Machine
        .read(path)
        .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let text = String::from_utf8(bytes).map_err(|_| format!("{} is no text", path.display()))?;
    let mut sources = SourceMap::new();
    let file = sources.add(path.display().to_string(), text);
    let mut diagnostics = Diagnostics::new();
    let tree = match periplus_yaml::parse(file, &sources) {
        Ok(Some(tree)) => tree,
        Ok(None) => return Err(format!("{} is empty", path.display())),
        Err(error) => {
            diagnostics.push(*error);
            return Ok(File { configs: Vec::new(), diagnostics, sources });
        }
    };
    let named = |node: &&&str| Config::is_in(&tree, node);
    let mut nodes: Vec<&&str> = NODES.iter().filter(named).collect();
    if nodes.is_empty() {
        // A file for one costmap, such as those of ROS 1.
        nodes = NODES.iter().take(1).collect();
    }
    let configs = nodes
        .into_iter()
        .map(|node| (*node, Config::read_yaml(&tree, node, compat, &mut diagnostics)))
        .collect();
    Ok(File { configs, diagnostics, sources })
}

impl Costmaps {
    /// As nodes of a graph, if they are wanted; none when they cannot be, which has been told.
    pub(crate) fn join(graph: &Graph, options: &CostmapOptions) -> io::Result<Option<Self>> {
        let mut costmaps = Self {
            nodes: Vec::new(),
            _markers: Vec::new(),
            cells: options.costmap_cell.clone(),
            pictures: options.costmap_picture.clone(),
        };
        let Some(path) = &options.costmap else { return Ok(Some(costmaps)) };
        let file = match read(path, options.costmap_compat) {
            Ok(file) => file,
            Err(why) => {
                terminal::complain(&why);
                return Ok(None);
            }
        };
        terminal::diagnostics(&mut anstream::stderr().lock(), &file.diagnostics, &file.sources)?;
        for (name, config) in file.configs {
            let made = CostmapNode::new(graph, name, config)
                .and_then(|node| Ok((node, VoxelMarkers::new(graph, &format!("/{name}"))?)));
            match made {
                Ok((node, markers)) => {
                    node.start();
                    costmaps.nodes.push(node);
                    costmaps._markers.push(markers);
                }
                Err(error) => {
                    terminal::complain(&format!("{name} cannot run: {error}"));
                    return Ok(None);
                }
            }
        }
        Ok(Some(costmaps))
    }

    /// What there is to say at the end of a run.
    pub(crate) fn tell(&self, out: &mut dyn Write) -> io::Result<()> {
        for node in &self.nodes {
            status(node, out)?;
            for Place { x_m, y_m } in &self.cells {
                match node.inspect(*x_m, *y_m) {
                    Some(report) => write!(out, "{report}")?,
                    None => writeln!(out, "({x_m}, {y_m}) is outside of the costmap")?,
                }
            }
            if let Some(folder) = &self.pictures {
                let name = format!("{}.png", node.node().names().name());
                match self.draw(node, &folder.join(&name)) {
                    Ok(()) => writeln!(out, "drawn: {}", folder.join(name).display())?,
                    Err(why) => terminal::complain(&why),
                }
            }
        }
        Ok(())
    }

    /// A picture in the colours of RViz, over white, four pixels for a cell.
    fn draw(&self, node: &CostmapNode, path: &Path) -> Result<(), String> {
        const PIXELS: usize = 4;
        let palette = Scheme::Costmap.palette();
        let drawn = node.look(|costmap| {
            let grid = costmap.costmap();
            let (width, height) = (grid.lattice().width, grid.lattice().height);
            let mut samples = Vec::with_capacity(width * height * PIXELS * PIXELS * 3);
            for row in (0..height * PIXELS).rev() {
                for column in 0..width * PIXELS {
                    let cost = grid.costs()[row / PIXELS * width + column / PIXELS];
                    let [r, g, b, a] = palette[usize::from(cost::occupancy_of(cost) as u8)];
                    samples.extend_from_slice(&if a == 0 { [255; 3] } else { [r, g, b] });
                }
            }
            let size = |cells: usize| (cells * PIXELS) as u32;
            write_png(size(width), size(height), Layout::Rgb, &samples)
        });
        let Some(bytes) = drawn else { return Err("there is no costmap to draw".into()) };
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)
                .map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
        }
        std::fs::write(path, bytes)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))
    }
}

/// What a costmap lives on, and what it lacks.
fn status(node: &CostmapNode, out: &mut dyn Write) -> io::Result<()> {
    let status = node.status();
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
            None if *messages == 0 => writeln!(out, "  {source} ({topic}): no message came")?,
            None => writeln!(out, "  {source} ({topic}): {messages} messages, none of use")?,
        }
    }
    for advice in &status.advice {
        writeln!(out, "  {advice}")?;
    }
    Ok(())
}

/// Tell what is wrong with a file of Nav2's parameters for its costmaps
///
/// Parameters nobody reads, layers that are not known, sources that can never mark or clear; each with
/// its place and what to write. With `periplus sim WORLD --costmap FILE` the costmaps run and tell
/// where points get lost. Exit code 1 when something is an error.
#[derive(Debug, Args)]
pub(crate) struct DoctorCostmapOptions {
    /// The file
    #[arg(value_name = "nav2_params.yaml")]
    file: PathBuf,
    /// Whose habits the costmaps have where distributions differ
    #[arg(long, value_name = "humble|jazzy|main")]
    compat: Option<Compat>,
}

pub(crate) fn doctor(options: &DoctorCostmapOptions) -> io::Result<ExitCode> {
    let file = match read(&options.file, options.compat) {
        Ok(file) => file,
        Err(why) => {
            terminal::complain(&why);
            return Ok(ExitCode::from(2));
        }
    };
    let mut out = anstream::stdout().lock();
    terminal::diagnostics(&mut out, &file.diagnostics, &file.sources)?;
    for (name, config) in &file.configs {
        let lattice = config.lattice();
        let frame = config.frame();
        writeln!(
            out,
            "{name}: {} x {} cells of {} m in `{}`{}, as {}",
            lattice.width,
            lattice.height,
            lattice.resolution_m,
            frame.global_frame,
            if frame.is_rolling { ", moving with the robot" } else { "" },
            config.compat,
        )?;
        for layer in config.layers.iter().chain(&config.filters) {
            writeln!(out, "  {} ({:?})", layer.name, layer.kind)?;
            for source in &layer.sources {
                let settings = source.settings();
                writeln!(
                    out,
                    "    {}: {:?} on {}, {}{} from {} m to {} m of height",
                    source.name,
                    settings.data_type,
                    settings.topic,
                    if settings.is_marking { "marks" } else { "marks nothing" },
                    if settings.is_clearing { " and clears" } else { " and clears nothing" },
                    settings.heights.min_m,
                    settings.heights.max_m,
                )?;
            }
        }
    }
    let is_sick = file.diagnostics.has_errors();
    Ok(if is_sick { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}
