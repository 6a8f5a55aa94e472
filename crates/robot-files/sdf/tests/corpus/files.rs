//! Files, with includes resolved as by libsdformat.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, Origin, SourceMap};
use periplus_sdf::{IncludeResolver, IncludeTarget, Version};
use periplus_xml::Document;
use serde_json::Value;

/// Resolves includes as the oracle did.
pub(crate) struct Recorded {
    paths: BTreeMap<String, String>,
    /// True if an included file is not SDF.
    pub(crate) other_format: bool,
}

impl Recorded {
    pub(crate) fn new(answer: &Value) -> Self {
        let pairs = answer["includes"].as_array().map_or(&[][..], Vec::as_slice);
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        let paths = pairs.iter().map(|pair| (text(&pair[0]), text(&pair[1]))).collect();
        Self { paths, other_format: false }
    }
}

impl IncludeResolver for Recorded {
    fn open(
        &mut self,
        uri: &str,
        _: Origin,
        sources: &mut SourceMap,
        diagnostics: &mut Diagnostics,
    ) -> IncludeTarget {
        let path = match self.paths.get(uri) {
            Some(path) if !path.is_empty() => PathBuf::from(path),
            // Built-in models are found under these too, but not by the oracle.
            _ if uri.starts_with("http") => return IncludeTarget::Broken,
            _ => return IncludeTarget::Missing { tried: Vec::new(), advice: None },
        };
        let path = if path.is_dir() { best_file(&path) } else { Some(path) };
        let Some(path) = path else { return IncludeTarget::Broken };
        let key = path.to_string_lossy().into_owned();
        let Some(document) = parse(&key, sources, diagnostics) else {
            return IncludeTarget::Broken;
        };
        if document.root.name == "robot" {
            self.other_format = true;
            return IncludeTarget::Broken;
        }
        IncludeTarget::Sdf { document: Arc::new(document), key }
    }
}

/// The file of a model's folder with the highest version that libsdformat 12 knows.
fn best_file(folder: &Path) -> Option<PathBuf> {
    let mut sources = SourceMap::new();
    let mut manifest = folder.join("model.config");
    if !manifest.exists() {
        manifest = folder.join("manifest.xml");
    }
    let manifest = parse(manifest.to_str()?, &mut sources, &mut Diagnostics::new())?;
    manifest
        .root
        .named("sdf")
        .map(|it| {
            let version = it.value("version").and_then(Version::parse);
            (version.unwrap_or(Version::new(0)), it.text().into_owned())
        })
        .filter(|(version, _)| *version <= Version::new(9))
        .max_by_key(|(version, _)| *version)
        .map(|(_, file)| folder.join(file))
}

pub(crate) fn parse(
    path: &str,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Option<Document> {
    let bytes = std::fs::read(path).ok()?;
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let file = sources.add(path, text);
    periplus_xml::parse(file, sources, diagnostics)
}
