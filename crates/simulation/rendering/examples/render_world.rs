//! Renders an image of a world file.
//!
//! `render_world WORLD OUT.png X Y Z YAW PITCH [ROLL]`: metres and degrees. Models are read from the
//! folder `models` beside the world.

#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a program for developers, that reads and writes files"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::Origin;
use periplus_geometry::{Pose, Rpy};
use periplus_loader::{LoadContext, load};
use periplus_meshes::MeshFormat;
use periplus_os::Machine;
use periplus_rendering::{
    AssetLoader, ImageOutputs, Lens, RenderRequest, RenderScene, RenderedImages, SensedGeometry,
};
use periplus_resources::Resolver;
use periplus_scene::MeshShape;

struct Files;

impl AssetLoader for Files {
    fn mesh(&self, mesh: &MeshShape) -> Option<Arc<periplus_meshes::Mesh>> {
        let path = mesh.path.as_ref()?;
        let bytes = std::fs::read(path).ok()?;
        let format = MeshFormat::from_path_and_bytes(&path.to_string_lossy(), &bytes).ok()?;
        let folder = path.parent()?.to_owned();
        let mut beside = |name: &str| std::fs::read(folder.join(name)).ok();
        periplus_meshes::read(&bytes, format, &mut beside).ok().map(Arc::new)
    }

    fn image(&self, _: &str, _: Origin) -> Option<Arc<[u8]>> {
        None
    }

    fn texture(&self, mesh: &MeshShape, name: &str) -> Option<Arc<[u8]>> {
        let folder = mesh.path.as_ref()?.parent()?;
        std::fs::read(folder.join(name)).ok().map(Into::into)
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [world, out, numbers @ ..] = arguments.as_slice() else {
        println!("usage: render_world WORLD OUT.png X Y Z YAW PITCH [ROLL]");
        return;
    };
    let number = |set_link_poses: usize| {
        numbers.get(set_link_poses).map_or(0.0, |text| text.parse::<f64>().unwrap())
    };
    let rpy = Rpy {
        roll: number(5).to_radians(),
        pitch: number(4).to_radians(),
        yaw: number(3).to_radians(),
    };
    let here = std::env::current_dir().unwrap();
    let models: PathBuf = here.join(world).parent().unwrap().join("models");
    let resolver = Resolver::new(&Machine, &[models]);
    let setting = LoadContext {
        host: &Machine,
        resolver: &resolver,
        working_folder: here,
        arguments: Vec::new(),
        open_meshes: true,
    };
    let loaded = load(Path::new(world), &setting);
    let scene = &loaded.scene.as_ref().unwrap().worlds[0];
    let (scene, diagnostics) = RenderScene::new(scene, SensedGeometry::Visual, &Files, 2);
    for diagnostic in diagnostics.iter() {
        println!("{}: {}", diagnostic.code, diagnostic.message);
    }
    let lens = Lens::pinhole(960, 720, 1.4).unwrap();
    let request = RenderRequest {
        lens: &lens,
        world_from_camera: Pose::from_xyz_rpy([number(0), number(1), number(2)], rpy),
        near_m: 0.05,
        far_m: 1000.0,
        visibility_mask: u32::MAX,
        own: None,
        outputs: ImageOutputs { colour: true, depth: true, labels: true },
        threads: 2,
    };
    let mut picture = RenderedImages::default();
    scene.render(&request, &mut picture);
    let file = std::fs::File::create(out).unwrap();
    let mut encoder = png::Encoder::new(file, picture.width, picture.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&picture.rgb).unwrap();
}
