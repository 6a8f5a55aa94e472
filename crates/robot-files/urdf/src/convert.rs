//! Robot to scene, as Gazebo means it.
//!
//! The way is Gazebo's own: the robot becomes a `<model>` of SDF (libsdformat 14,
//! parser_urdf.cc), and the reader of SDF makes a scene of it. So settings in `<gazebo>` blocks,
//! which are SDF, are read, defaulted and checked as in any other file; every element keeps the
//! place in the URDF that it came from. What SDF cannot say is added afterwards.
//!
//! Where this is kinder than libsdformat: merged links keep their own `<gazebo>` settings for
//! their own shapes whatever their names are (there, names decide); links without mass stay as
//! frames; `floating` and `planar` joints are kept; textures are kept; plugins are left word for
//! word, for the links they name are still there, as frames.

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
mod situation;

pub(crate) use link::LUMP;
use periplus_diagnostics::Diagnostics;
use periplus_scene::Model;
use periplus_sdf::{Context, read_document};
use periplus_xml::{Document, Element};

use crate::robot::Robot;
pub(crate) use settings::BUILTIN_MATERIALS;
use situation::Situation;

/// How a robot becomes a model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Merge no link into its parent, as libsdformat's `URDFPreserveFixedJoint`.
    pub preserve_fixed_joints: bool,
}

/// The model that Gazebo would make of a robot, with every link and joint that is merged kept as
/// a frame. Its poses are resolved; its mesh URIs stand as written.
#[must_use]
pub fn to_model(robot: &Robot, options: Options, context: &mut Context<'_>) -> Model {
    let situation = Situation::new(robot, options);
    let element = situation.model_element(context.diagnostics);
    let sdf = Element::new("sdf").with_attribute("version", VERSION).with_child(element);
    let document = Document { before: Vec::new(), root: sdf, after: Vec::new() };
    let mut found = Diagnostics::new();
    let scene = {
        let mut inner = Context {
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

/// The `<model>` that [`to_model`] reads, for who wants SDF without a scene. Its poses are
/// relative to the model, quaternions where they turn.
#[must_use]
pub fn to_sdf(robot: &Robot, options: Options, diagnostics: &mut Diagnostics) -> Element {
    let model = Situation::new(robot, options).model_element(diagnostics);
    Element::new("sdf").with_attribute("version", VERSION).with_child(model)
}

/// What is written here needs nothing newer, and libsdformat 12 reads it.
const VERSION: &str = "1.9";

#[cfg(test)]
mod tests;
