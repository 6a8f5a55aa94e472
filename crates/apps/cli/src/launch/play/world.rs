//! World of a launch file.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Origin, RenderStyle, SourceMap, render};
use periplus_launch::bringup::WorldRequest;
use periplus_loader::LoadContext;
use periplus_resources::EntryKind;
use periplus_sim::{Composition, Search, compose as compose_file, compose_plain};

use crate::error::CliError;

/// Worlds that Gazebo installs and that are a plane under a sun.
const PLANE_WORLDS: [&str; 4] = ["empty.world", "empty.sdf", "empty", "default.sdf"];

/// Reads the world, with the environment and working folder in which it is started.
///
/// # Errors
/// When there is no such file.
pub(super) fn compose(request: &WorldRequest, search: &Search) -> Result<Composition, CliError> {
    search.with_context(true, |context| {
        let Some(file) = request.file.as_deref() else { return Ok(compose_plain(&[], context)) };
        match find(file, context) {
            Ok(path) => Ok(compose_file(&path, &[], context)),
            Err(_) if PLANE_WORLDS.contains(&file.rsplit('/').next().unwrap_or(file)) => {
                Ok(compose_plain(&[], context))
            }
            Err(why) => Err(CliError::Failed(match &request.written {
                Some(written) => format!("{why}  = started at {written}"),
                None => why,
            })),
        }
    })
}

fn find(file: &str, context: &LoadContext<'_>) -> Result<PathBuf, String> {
    let from = context.working_folder.join("launch");
    let plain = context.working_folder.join(Path::new(file));
    if !file.contains("://") && context.host.kind(&plain) == Some(EntryKind::File) {
        return Ok(plain);
    }
    context.resolver.resolve(file, &from).map_err(|miss| {
        let finding = miss.into_diagnostic(Origin::default());
        format!(
            "world {file} does not exist\n{}",
            render(&finding, &SourceMap::new(), RenderStyle::Plain)
        )
    })
}
