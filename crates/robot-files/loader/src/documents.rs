//! Parsing of bytes to documents, and conversion of robots to models.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, SourceMap};
use periplus_scene::Model;
use periplus_urdf::UrdfRobot;
use periplus_xml::{Document, decode, parse};

use crate::setting::{LoadContext, shown};

/// Converts a robot to a model.
pub(crate) fn model_of(
    robot: &UrdfRobot,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Model {
    // A robot has no includes: after xacro it is one document.
    let mut includes = periplus_sdf::NoIncludes;
    let mut context = periplus_sdf::SdfContext { sources, diagnostics, includes: &mut includes };
    periplus_urdf::to_model(robot, periplus_urdf::ConversionOptions::default(), &mut context)
}

/// Decodes and parses a file.
pub(crate) fn read_xml(
    path: &Path,
    bytes: &[u8],
    setting: &LoadContext<'_>,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Option<Document> {
    let name = shown(path, &setting.working_folder);
    let text = match decode(bytes) {
        Ok(text) => text,
        Err(words) => {
            // Older readers ignored the encoding, so the content is still used.
            diagnostics.push(Diagnostic::warning("encoding", format!("`{name}`: {words}")));
            String::from_utf8_lossy(bytes)
        }
    };
    let file: FileId = sources.add(name, text);
    parse(file, sources, diagnostics)
}
