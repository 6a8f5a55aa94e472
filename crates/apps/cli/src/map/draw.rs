//! `periplus map draw`.

use std::process::ExitCode;
use std::sync::Arc;

use periplus_loader::LoadContext;
use periplus_maps::{Distro, Saving, render};
use periplus_sim::{AssetFiles, MapDrawing, Options, Simulation, compose};

use super::options::DrawOptions;
use crate::error::CliError;
use crate::sim::Robots;
use crate::{paths, terminal};

pub(super) fn run(options: &DrawOptions) -> Result<ExitCode, CliError> {
    let (world, arguments) = Robots::default().world(&options.words, "map draw")?;
    let search = terminal::search(&options.search.resource_path);
    let mut composition = search.with_context(true, |context| {
        compose(&world, &[], &LoadContext { arguments, ..context.clone() })
    });
    let mut err = anstream::stderr().lock();
    for loaded in &composition.files {
        terminal::findings(&mut err, loaded)?;
    }
    drop(err);
    if composition.has_errors() {
        return Err(CliError::failed("the world has errors"));
    }
    let files = Arc::new(AssetFiles::default());
    let mut simulation = Simulation::new(&mut composition, files, Options::default());
    let drawing = MapDrawing {
        start_m: options.start,
        height_m: options.height,
        resolution_m: options.resolution,
        max_side_m: options.max_side,
    };
    let map = simulation.draw_map(drawing).map_err(CliError::failed)?;
    let name = options.name.display().to_string();
    let saved = render(&map, &Saving::new(name.as_str(), Distro::Jazzy));
    paths::write(saved.image_path.as_ref(), &saved.image)?;
    paths::write(saved.yaml_path.as_ref(), saved.yaml.as_bytes())?;
    let (width, height) = (map.info.width, map.info.height);
    terminal::say(&format!(
        "{}: {width} x {height} cells of {} m",
        saved.yaml_path, options.resolution
    ));
    Ok(ExitCode::SUCCESS)
}
