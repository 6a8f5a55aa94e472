//! Materials of Gazebo Classic: scripts of OGRE, which current Gazebo does not read.

use std::path::Path;

use periplus_resources::{EntryKind, Host, Resolver};
use periplus_scene::builtin_material;
use periplus_xml::Element;

use crate::ogre::{OgreMaterial, find_material};
use crate::replacement::leaf;

/// Access to the files that a material names.
pub(crate) struct MaterialFiles<'a> {
    pub(crate) host: &'a dyn Host,
    pub(crate) resolver: &'a Resolver<'a>,
    /// Folder of the file that is converted.
    pub(crate) folder: &'a Path,
}

/// Colours and textures instead of a script; `None` for an unknown material.
pub(crate) fn without_script(
    name: &str,
    uris: &[String],
    files: &MaterialFiles<'_>,
) -> Option<Vec<Element>> {
    if let Some(material) = builtin_material(name) {
        let colours = [
            ("ambient", material.ambient),
            ("diffuse", material.diffuse),
            ("specular", material.specular),
            ("emissive", material.emissive),
        ];
        let written = colours.into_iter().filter_map(|(name, colour)| {
            let [r, g, b, a] = colour?.0;
            (name != "emissive" || r + g + b > 0.0).then(|| leaf(name, format!("{r} {g} {b} {a}")))
        });
        return Some(written.collect());
    }
    let script = uris.iter().find_map(|uri| script(uri, name, files))?;
    let mut elements = Vec::new();
    for (name, colour) in [
        ("ambient", &script.ambient),
        ("diffuse", &script.diffuse),
        ("specular", &script.specular),
        ("emissive", &script.emissive),
    ] {
        if let Some(colour) = colour {
            elements.push(leaf(name, colour));
        } else if name == "diffuse" && script.texture.is_some() {
            elements.push(leaf(name, "1 1 1 1"));
        }
    }
    if let Some(texture) = &script.texture {
        let map = leaf("albedo_map", texture_uri(texture, uris, files)?);
        let metal = Element::new("metal")
            .with_child(map)
            .with_child(leaf("roughness", "1.0"))
            .with_child(leaf("metalness", "0.0"));
        elements.push(Element::new("pbr").with_child(metal));
    }
    (!elements.is_empty()).then_some(elements)
}

/// Material of a script file, or of a folder of them.
fn script(uri: &str, name: &str, files: &MaterialFiles<'_>) -> Option<OgreMaterial> {
    let path = files.resolver.resolve(uri, files.folder).ok()?;
    let scripts = match files.host.kind(&path)? {
        EntryKind::File => vec![path],
        EntryKind::Folder => {
            let names =
                files.host.list(&path).into_iter().filter(|name| name.ends_with(".material"));
            names.map(|name| path.join(name)).collect()
        }
    };
    scripts.iter().find_map(|script| {
        let bytes = files.host.read(script).ok()?;
        find_material(&String::from_utf8_lossy(&bytes), name)
    })
}

/// URI of a texture: below the first folder that has it.
fn texture_uri(texture: &str, uris: &[String], files: &MaterialFiles<'_>) -> Option<String> {
    let beside = uris.iter().flat_map(|uri| {
        let uri = uri.trim_end_matches('/');
        let above = uri.rsplit_once('/').map_or("", |(above, _)| above);
        let above_script = above.rsplit_once('/').map_or("", |(above, _)| above);
        [
            format!("{uri}/{texture}"),
            format!("{above}/textures/{texture}"),
            format!("{above_script}/textures/{texture}"),
        ]
    });
    let mut found = beside.filter(|uri| {
        let path = files.resolver.resolve(uri, files.folder).ok();
        path.is_some_and(|path| files.host.kind(&path) == Some(EntryKind::File))
    });
    found.next()
}
