//! SDF, the format of Gazebo's robots and worlds: versions 1.0 to 1.12 are read into a
//! [`periplus_scene::Scene`], and a scene is written as SDF.
//!
//! Reading has three steps, each in its own module: `upgrade` converts old spellings, `read` turns elements
//! into drafts whose poses are as written, `frames` resolves them. No content is dropped silently: unread
//! content is kept verbatim (see `fields`).

mod builtin;
mod draft;
mod fields;
mod frames;
mod inertia;
mod plain_names;
mod pose;
mod read;
mod upgrade;
mod value;
mod verbatim;
mod version;
mod write;

pub use inertia::check as check_inertia;
pub use plain_names::use_plain_names;
pub use pose::{PosedElement, Reference, read_pose};
pub use read::{
    IncludeResolver, IncludeTarget, NoIncludes, PosedSensor, SdfContext, read_collision,
    read_document, read_geometry, read_inertial, read_light, read_material, read_plugin,
    read_sensor, read_surface, read_visual,
};
pub use verbatim::keep;
pub use version::Version;
pub use write::write;
