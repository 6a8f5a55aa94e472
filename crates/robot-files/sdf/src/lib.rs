//! SDF, the format of Gazebo's robots and worlds: versions 1.0 to 1.12 are read into a
//! [`periplus_scene::Scene`], and a scene is written as SDF.
//!
//! Reading has three steps, each in its own module: `upgrade` converts old spellings, `read` turns elements
//! into drafts whose poses are as written, `frames` resolves them. No content is dropped silently: unread
//! content is kept verbatim (see `fields`).
//!
//! ```
//! use periplus_diagnostics::{Diagnostics, SourceMap};
//! use periplus_sdf::{NoIncludes, SdfContext, read_document};
//!
//! let text = "<sdf version='1.9'><model name='cart'>
//!     <link name='base'><pose>1 0 0 0 0 0</pose></link>
//!     <link name='lidar'><pose relative_to='base'>0 0 0.5 0 0 0</pose></link>
//! </model></sdf>";
//! let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
//! let file = sources.add("cart.sdf", text);
//! let document = periplus_xml::parse(file, &sources, &mut diagnostics).expect("XML");
//! let includes = &mut NoIncludes;
//! let mut context = SdfContext { sources: &mut sources, diagnostics: &mut diagnostics, includes };
//! let scene = read_document(&document, &mut context);
//! assert_eq!(scene.models[0].links[1].model_from_link.translation.to_array(), [1.0, 0.0, 0.5]);
//! ```

mod builtin;
mod draft;
mod edit;
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

pub use edit::{WorldEdit, WorldEditError, edit_world};
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
