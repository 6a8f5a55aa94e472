//! Ray-cast scenes and camera images of simulated worlds.
//!
//! [`RenderScene`] puts the collision or visual shapes of a world into one
//! [`raycast::RaycastWorld`](periplus_raycast::RaycastWorld), moves them with their links, and maps
//! every hit to its model, link, colour, laser intensity and label. [`RenderScene::render`] renders
//! colour, depth and labels in one pass, with lights and shadows. An [`AssetLoader`] provides the
//! content of files; nothing here reads a file.
//!
//! ```
//! use periplus_geometry::{DVec3, Pose};
//! use periplus_raycast::{Filter, Ray};
//! use periplus_rendering::{NoAssets, RenderScene, SensedGeometry};
//! use periplus_scene::{Collision, Link, Model, Shape};
//!
//! let mut ball = Model::new("ball");
//! let collisions = vec![Collision::new("sphere", Shape::Sphere { radius_m: 0.1 })];
//! ball.links.push(Link { collisions, ..Link::new("link") });
//! let mut scene = RenderScene::empty(SensedGeometry::Collision, 1);
//! let parts = scene.add(&ball, Pose::from_xyz(1.0, 0.0, 0.0), &NoAssets).parts;
//! scene.set_link_poses(&[(parts[0], Pose::from_xyz(2.0, 0.0, 0.0))]);
//! let ray = Ray::new(DVec3::ZERO, DVec3::X);
//! let hit = scene.rays().cast(&ray, Filter::default()).expect("a hit");
//! assert!((hit.distance_m - 1.9).abs() < 1e-12);
//! assert_eq!(scene.surface(&hit).link, "link");
//! ```

mod asset_cache;
mod assets;
mod body;
mod heightmap;
mod images;
mod label;
mod lens;
mod light;
mod links;
mod mesh;
mod objects;
mod outline;
mod phong;
mod render_scene;

pub use assets::{AssetLoader, NoAssets};
pub use heightmap::{HeightmapError, HeightmapSamples, sample_heightmap};
pub use images::{ImageOutputs, RenderRequest, RenderedImages};
pub use label::is_label_plugin;
pub use lens::{Lens, LensError};
pub use mesh::{SelectedMesh, select_submesh};
pub use objects::{
    DetectedObject, LabelledObject, ObjectLabel, PixelBox, PixelRegion, box_corners,
};
pub use periplus_images::{BadImage, Grey, Image};
pub use render_scene::{
    AddedModel, HitSurface, ModelGroup, PartId, RenderModelId, RenderScene, SHADOW_MASK,
    SensedGeometry, TracedGeometry, TracedShape, filter,
};
