//! Bytes to documents, robots to models.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, SourceMap};
use periplus_scene::Model;
use periplus_urdf::Robot;
use periplus_xml::{Document, decode, parse};

use crate::setting::{Setting, shown};

/// The model of a robot.
pub(crate) fn model_of(
    robot: &Robot,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Model {
    // A robot includes nothing: it is one file once its xacro is expanded.
    let mut includes = periplus_sdf::NoIncludes;
    let mut context = periplus_sdf::Context { sources, diagnostics, includes: &mut includes };
    periplus_urdf::to_model(robot, periplus_urdf::Options::default(), &mut context)
}

/// Decodes and parses a file.
pub(crate) fn read_xml(
    path: &Path,
    bytes: &[u8],
    setting: &Setting<'_>,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Option<Document> {
    let name = shown(path, &setting.working_folder);
    let text = match decode(bytes) {
        Ok(text) => text,
        Err(words) => {
            // Readers of old files never looked at the encoding, so the rest is still of use.
            diagnostics.push(Diagnostic::warning("encoding", format!("`{name}`: {words}")));
            String::from_utf8_lossy(bytes)
        }
    };
    let file: FileId = sources.add(name, text);
    parse(file, sources, diagnostics)
}
