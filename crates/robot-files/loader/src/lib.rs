//! Loader for all robot and world files: recognise, expand, read, check, summarise.
//!
//! [`load`] reads any robot, world or related file and returns a [`LoadedFile`]: the scene, the findings, and
//! the texts that they refer to. It always returns; a broken file gives findings.
//!
//! ```
//! use periplus_loader::{LoadContext, load};
//! use periplus_resources::{MemoryHost, Resolver};
//!
//! let robot = "<robot name='cart'><link name='base_link'/></robot>";
//! let host = MemoryHost::new().with_file("/cart.urdf", robot);
//! let resolver = Resolver::new(&host, &[]);
//! let (working_folder, arguments, open_meshes) = ("/".into(), Vec::new(), true);
//! let context =
//!     LoadContext { host: &host, resolver: &resolver, working_folder, arguments, open_meshes };
//! let loaded = load("/cart.urdf".as_ref(), &context);
//! assert!(!loaded.diagnostics.has_errors());
//! assert_eq!(loaded.scene.expect("a robot").models[0].name, "cart");
//! ```

mod detect;
mod documents;
mod example_worlds;
mod images;
mod includes;
mod interfaces;
mod load;
mod map_world;
mod mesh_files;
mod other_files;
mod parameter_files;
mod rebase;
mod setting;
mod shapes;
mod summary;

pub use detect::FileFormat;
pub use example_worlds::names as example_worlds;
pub use images::settle_images;
pub use interfaces::{Interfaces, load_interfaces};
pub use load::{LoadedFile, load, load_bytes};
pub use map_world::map_world;
pub use mesh_files::{MeshSummary, read_beside, read_mesh};
pub use parameter_files::settle_parameter_files;
pub use rebase::rebase;
pub use setting::LoadContext;
pub use summary::{ModelSummary, SensorSummary, Summary, WorldSummary, describe, summarise};
