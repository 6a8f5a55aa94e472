//! Images of materials and heightmaps.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, Severity, SourceMap};
use periplus_scene::{Model, Scene, Shape, Visual};

use crate::setting::{LoadContext, mentioned_in};
use crate::shapes::for_each_shape;

/// Replaces the URIs of textures and heightmap images by the paths of their files, so that they can be
/// opened without the file that refers to them. A missing image is a warning, and the surface keeps its
/// plain colour.
pub fn settle_images(
    scene: &mut Scene,
    sources: &SourceMap,
    setting: &LoadContext<'_>,
    diagnostics: &mut Diagnostics,
) {
    let models = scene.worlds.iter_mut().flat_map(|world| &mut world.models);
    for model in models.chain(&mut scene.models) {
        each_visual(model, &mut |visual| {
            let origin = visual.origin;
            let pbr = visual.material.as_mut().and_then(|material| material.pbr.as_mut());
            let Some(map) = pbr.and_then(|pbr| pbr.albedo_map.as_mut()) else { return };
            if map.is_empty() || Path::new(map.as_str()).is_absolute() {
                return;
            }
            if let Some(path) = find(map, origin, sources, setting, diagnostics) {
                *map = path;
            }
        });
    }
    for_each_shape(scene, &mut |shape, _| {
        if let Shape::Heightmap(heightmap) = shape
            && let Some(path) = &heightmap.path
        {
            heightmap.uri = path.display().to_string();
        }
    });
}

fn find(
    uri: &str,
    origin: Origin,
    sources: &SourceMap,
    setting: &LoadContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let from = mentioned_in(origin, sources, &setting.working_folder);
    match setting.resolver.resolve(uri, &from) {
        Ok(path) => Some(path.display().to_string()),
        Err(miss) => {
            let mut diagnostic: Diagnostic = miss.into_diagnostic(origin);
            diagnostic.severity = Severity::Warning;
            diagnostics.push(diagnostic);
            None
        }
    }
}

fn each_visual(model: &mut Model, visit: &mut dyn FnMut(&mut Visual)) {
    model.links.iter_mut().flat_map(|link| &mut link.visuals).for_each(&mut *visit);
    model.models.iter_mut().for_each(|inner| each_visual(inner, visit));
}
