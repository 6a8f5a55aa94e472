//! Manifests: `package.xml` and `model.config`.

use std::path::Path;

use quick_xml::Reader;
use quick_xml::events::Event;

use crate::host::Host;

/// Maximum size of a manifest that is read [bytes]; they usually have a few kilobytes.
const MAX_MANIFEST_BYTES: usize = 1 << 20;

/// Elements in `<export>` with which packages declare folders for Gazebo (`gazebo_ros` and `ros_gz_sim`
/// read the first).
const EXPORT_TAGS: [&str; 3] = ["gazebo_ros", "gz_ros", "ros_gz_sim"];

/// Their attributes for folders of models, worlds and meshes.
const EXPORT_PATHS: [&str; 5] = [
    "gazebo_model_path",
    "gazebo_media_path",
    "gazebo_resource_path",
    "model_path",
    "resource_path",
];

/// Content of the manifest of a ROS package (REP 140, REP 149).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct PackageManifest {
    pub(crate) name: String,
    /// Model and resource paths of `<export><gazebo_ros/>`, entries of colon-separated lists with
    /// `${prefix}` for the package's own folder, and those of the package's environment hooks.
    pub(crate) gazebo_paths: Vec<String>,
    /// True for packages of ROS 1, which catkin or rosbuild builds.
    pub(crate) is_ros1: bool,
}

/// Name of the package in a folder, from its `package.xml`, or from rosbuild's `manifest.xml`.
#[must_use]
pub fn package_name(host: &dyn Host, folder: &Path) -> Option<String> {
    in_folder(host, folder).map(|manifest| manifest.name)
}

/// Manifest of the package in a folder. A package of rosbuild has a `manifest.xml` and the name of its folder.
pub(crate) fn in_folder(host: &dyn Host, folder: &Path) -> Option<PackageManifest> {
    if let Ok(bytes) = host.read(&folder.join("package.xml")) {
        return Some(package(&bytes)).filter(|manifest| !manifest.name.is_empty());
    }
    let bytes = host.read(&folder.join("manifest.xml")).ok()?;
    // Gazebo's model database has manifests of that name too.
    let mut is_package = false;
    walk(&bytes, |path, _, _| is_package |= path.first() == Some(&"package"));
    let name = folder.file_name()?.to_str()?.to_owned();
    is_package.then(|| PackageManifest { name, is_ros1: true, ..package(&bytes) })
}

pub(crate) fn package(bytes: &[u8]) -> PackageManifest {
    let mut manifest = PackageManifest::default();
    walk(bytes, |path, attributes, text| match (path, text) {
        (["package", "name"], Some(text)) if manifest.name.is_empty() => {
            manifest.name = text.trim().to_owned();
        }
        (["package", "buildtool_depend"], Some(text)) if text.trim() == "catkin" => {
            manifest.is_ros1 = true;
        }
        (["package", "export", tag], None) if EXPORT_TAGS.contains(tag) => {
            let paths = attributes
                .iter()
                .filter(|(name, _)| EXPORT_PATHS.contains(&name.as_str()))
                .flat_map(|(_, value)| value.split(':'))
                .filter(|entry| !entry.is_empty());
            manifest.gazebo_paths.extend(paths.map(str::to_owned));
        }
        _ => {}
    });
    manifest
}

/// One `<sdf>` entry of a `model.config`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ModelEntry {
    /// Major and minor `version`; 0.0 if missing.
    pub(crate) version: (u32, u32),
    pub(crate) file: String,
}

/// `<sdf>` entries of a `model.config`, in file order.
pub(crate) fn model_config(bytes: &[u8]) -> Vec<ModelEntry> {
    let mut entries: Vec<ModelEntry> = Vec::new();
    let mut version = (0, 0);
    walk(bytes, |path, attributes, text| match (path, text) {
        (["model", "sdf"], None) => {
            let written = attributes.iter().find(|(name, _)| name == "version");
            version = written.map_or((0, 0), |(_, value)| version_of(value));
        }
        (["model", "sdf"], Some(text)) if !text.trim().is_empty() => {
            entries.push(ModelEntry { version, file: text.trim().to_owned() });
        }
        _ => {}
    });
    entries
}

fn version_of(text: &str) -> (u32, u32) {
    let mut parts = text.trim().split('.').map(|part| part.parse().unwrap_or(0));
    (parts.next().unwrap_or(0), parts.next().unwrap_or(0))
}

/// Calls `see` for each element with its path and attributes, and for each piece of text. Stops at the
/// first XML error; entities are not resolved, so the expansion is bounded.
fn walk(bytes: &[u8], mut see: impl FnMut(&[&str], &[(String, String)], Option<&str>)) {
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(MAX_MANIFEST_BYTES)]);
    let mut reader = Reader::from_str(&text);
    reader.config_mut().allow_dangling_amp = true;
    let mut path: Vec<String> = Vec::new();
    let mut visit = |path: &[String], attributes: &[(String, String)], text: Option<&str>| {
        // Deeper elements are not needed, and a hostile file may nest a hundred thousand times.
        if path.len() <= 3 {
            let path: Vec<&str> = path.iter().map(String::as_str).collect();
            see(&path, attributes, text);
        }
    };
    loop {
        match reader.read_event() {
            Ok(Event::Start(tag)) => {
                path.push(tag.name().as_ref().to_owned());
                visit(&path, &attributes(&tag), None);
            }
            Ok(Event::Empty(tag)) => {
                path.push(tag.name().as_ref().to_owned());
                visit(&path, &attributes(&tag), None);
                path.pop();
            }
            Ok(Event::End(_)) => {
                path.pop();
            }
            Ok(Event::Text(text)) => visit(&path, &[], Some(&text.xml10_content())),
            Ok(Event::CData(text)) => visit(&path, &[], Some(&text.xml10_content())),
            Ok(Event::Eof) | Err(_) => return,
            Ok(_) => {}
        }
    }
}

fn attributes(tag: &quick_xml::events::BytesStart<'_>) -> Vec<(String, String)> {
    tag.attributes()
        .filter_map(Result::ok)
        .map(|attribute| {
            let name = attribute.key.as_ref().to_owned();
            (name, attribute.value.into_owned())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_has_a_name_and_exports() {
        let manifest = package(
            b"<?xml version='1.0'?><!-- a --><package format='3'><name> bot </name>
              <author><name>nobody</name></author>
              <export><gazebo_ros gazebo_model_path='${prefix}/..:${prefix}/models'/></export>
              </package>",
        );
        assert_eq!(manifest.name, "bot");
        assert_eq!(manifest.gazebo_paths, ["${prefix}/..", "${prefix}/models"]);
    }

    #[test]
    fn a_model_lists_its_versions() {
        let entries = model_config(
            b"<model><name>m</name><sdf version='1.10'>new.sdf</sdf><sdf>old.sdf</sdf></model>",
        );
        let entry = |version, file: &str| ModelEntry { version, file: file.into() };
        assert_eq!(entries, [entry((1, 10), "new.sdf"), entry((0, 0), "old.sdf")]);
    }

    #[test]
    fn broken_manifests_say_nothing() {
        for bytes in [&b""[..], b"<package><name>", b"\xff\xfe", b"</a></b>", b"<a b=<c>&x;"] {
            assert_eq!(package(bytes), PackageManifest::default());
            assert_eq!(model_config(bytes), []);
        }
        let deep = "<a>".repeat(100_000);
        assert_eq!(package(deep.as_bytes()), PackageManifest::default());
    }
}
