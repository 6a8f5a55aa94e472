//! Conversion of a robot to a scene, with Gazebo's rules.
//!
//! The conversion takes Gazebo's own steps: the robot becomes a `<model>` of SDF (libsdformat 14,
//! parser_urdf.cc), which the SDF reader turns into a scene. Settings in `<gazebo>` blocks, which are SDF,
//! are therefore read, defaulted and checked as in any other file, and every element keeps its location in
//! the URDF. Data that SDF cannot express is added afterwards.
//!
//! Differences from libsdformat: merged links keep their own `<gazebo>` settings for their own shapes,
//! whatever their names (there, names decide); links without mass stay as frames; `floating` and `planar`
//! joints are kept; textures are kept; plugins are copied verbatim, as the links that they name still exist
//! as frames.

mod element;
mod extension;
mod joint;
mod link;
mod lost;
mod model;
mod names;
mod parts;
mod settings;
mod shape;
mod state;

pub(crate) use link::LUMP;
use periplus_diagnostics::Diagnostics;
use periplus_scene::Model;
use periplus_sdf::{SdfContext, read_document};
use periplus_xml::{Document, Element};

use crate::robot::UrdfRobot;
pub(crate) use settings::BUILTIN_MATERIALS;
use state::ConversionState;

/// Options of the conversion from robot to model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ConversionOptions {
    /// Merge no link into its parent, as libsdformat's `URDFPreserveFixedJoint`.
    pub preserve_fixed_joints: bool,
}

/// Returns the model that Gazebo would make of a robot, with every merged link and joint kept as a frame.
/// Its poses are resolved; its mesh URIs are as written.
#[must_use]
pub fn to_model(
    robot: &UrdfRobot,
    options: ConversionOptions,
    context: &mut SdfContext<'_>,
) -> Model {
    let situation = ConversionState::new(robot, options);
    let element = situation.model_element(context.diagnostics);
    let sdf = Element::new("sdf").with_attribute("version", VERSION).with_child(element);
    let document = Document { before: Vec::new(), root: sdf, after: Vec::new() };
    let mut found = Diagnostics::new();
    let scene = {
        let mut inner = SdfContext {
            sources: &mut *context.sources,
            diagnostics: &mut found,
            includes: &mut *context.includes,
        };
        read_document(&document, &mut inner)
    };
    context.diagnostics.append(situation.without_repetitions(found));
    let mut model = scene.models.into_iter().next().unwrap_or_else(|| Model::new(situation.name()));
    situation.complete(&mut model);
    model
}

/// Returns the `<model>` that [`to_model`] reads, for callers that need SDF but no scene. Poses are
/// relative to the model, with quaternions for rotations.
#[must_use]
pub fn to_sdf(
    robot: &UrdfRobot,
    options: ConversionOptions,
    diagnostics: &mut Diagnostics,
) -> Element {
    let model = ConversionState::new(robot, options).model_element(diagnostics);
    Element::new("sdf").with_attribute("version", VERSION).with_child(model)
}

/// Nothing written here needs a newer version, and libsdformat 12 reads this one.
const VERSION: &str = "1.9";

#[cfg(test)]
mod tests;
