//! World of a launch file.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Origin, RenderStyle, SourceMap, render};
use periplus_launch::bringup::WorldRequest;
use periplus_loader::LoadContext;
use periplus_resources::EntryKind;
use periplus_sim::{Composition, Search, compose as compose_file, compose_plain};

/// Worlds that Gazebo installs and that are a plane under a sun.
const PLANE_WORLDS: [&str; 4] = ["empty.world", "empty.sdf", "empty", "default.sdf"];

/// Reads the world, with the environment and working folder in which it is started.
///
/// # Errors
/// A message when there is no such file.
pub(super) fn compose(wish: &WorldRequest, search: &Search) -> Result<Composition, String> {
    let host = search.host();
    let resolver = search.resolver(&host);
    let setting = search.setting(&host, &resolver, true);
    let Some(file) = wish.file.as_deref() else { return Ok(compose_plain(&setting)) };
    match find(file, &setting) {
        Ok(path) => Ok(compose_file(&path, &[], &setting)),
        Err(_) if PLANE_WORLDS.contains(&file.rsplit('/').next().unwrap_or(file)) => {
            Ok(compose_plain(&setting))
        }
        Err(why) => Err(match &wish.written {
            Some(written) => format!("{why}  = started at {written}"),
            None => why,
        }),
    }
}

fn find(file: &str, setting: &LoadContext<'_>) -> Result<PathBuf, String> {
    let from = setting.working_folder.join("launch");
    let plain = setting.working_folder.join(Path::new(file));
    if !file.contains("://") && setting.host.kind(&plain) == Some(EntryKind::File) {
        return Ok(plain);
    }
    setting.resolver.resolve(file, &from).map_err(|miss| {
        let finding = miss.into_diagnostic(Origin::default());
        format!(
            "world {file} does not exist\n{}",
            render(&finding, &SourceMap::new(), RenderStyle::Plain)
        )
    })
}
