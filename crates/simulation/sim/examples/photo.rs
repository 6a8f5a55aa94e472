//! Renders an image of a world: `photo WORLD X,Y,Z,ROLL,PITCH,YAW OUT.png`, from this pose along
//! its x axis.
#![allow(clippy::print_stderr, clippy::expect_used, reason = "a small program for people")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_geometry::{Pose, Rpy};
use periplus_loader::LoadContext;
use periplus_os::Machine;
use periplus_rendering::{ImageOutputs, Lens, RenderRequest, RenderedImages, SensedGeometry};
use periplus_resources::Resolver;
use periplus_sim::{AssetFiles, compose};

const WIDTH_PX: usize = 960;
const HEIGHT_PX: usize = 540;
/// Rays along each side of a pixel, for smooth edges.
const RAYS: usize = 3;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [world, pose, out] = words.as_slice() else {
        eprintln!("usage: photo WORLD X,Y,Z,ROLL,PITCH,YAW OUT.png");
        std::process::exit(2);
    };
    let numbers: Vec<f64> = pose.split(',').filter_map(|word| word.parse().ok()).collect();
    let [x, y, z, roll, pitch, yaw] = numbers[..] else {
        eprintln!("`{pose}` is not a pose");
        std::process::exit(2);
    };
    let world_from_camera = Pose::from_xyz_rpy([x, y, z], Rpy { roll, pitch, yaw });
    let picture = take(Path::new(world), world_from_camera);
    let file = std::fs::File::create(out).expect("the file can be created");
    let mut encoder =
        png::Encoder::new(std::io::BufWriter::new(file), WIDTH_PX as u32, HEIGHT_PX as u32);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&smaller(&picture.rgb)).expect("a whole image");
}

/// Each pixel the mean of its rays.
fn smaller(rgb: &[u8]) -> Vec<u8> {
    let mean = |row: usize, column: usize, colour: usize| {
        let rays =
            (0..RAYS).flat_map(|y| (0..RAYS).map(move |x| (row * RAYS + y, column * RAYS + x)));
        let sum: usize =
            rays.map(|(y, x)| usize::from(rgb[(y * WIDTH_PX * RAYS + x) * 3 + colour])).sum();
        (sum / (RAYS * RAYS)) as u8
    };
    let pixels = (0..HEIGHT_PX).flat_map(|row| (0..WIDTH_PX).map(move |column| (row, column)));
    pixels.flat_map(|(row, column)| [0, 1, 2].map(|colour| mean(row, column, colour))).collect()
}

fn take(world: &Path, world_from_camera: Pose) -> RenderedImages {
    let resolver = Resolver::new(&Machine, &[]);
    let setting = LoadContext {
        host: &Machine,
        resolver: &resolver,
        working_folder: std::env::current_dir().unwrap_or_else(|_| PathBuf::new()),
        arguments: Vec::new(),
        open_meshes: false,
    };
    let composition = compose(world, &[], &setting);
    let files = Arc::new(AssetFiles::default());
    let mut motion = periplus_physics::PhysicsWorld::empty(
        composition.world.gravity_m_s2,
        periplus_physics::PhysicsMode::Kinematic,
    );
    let mut views = periplus_sim_nodes::Views::new(Arc::clone(&files) as _, 2)
        .with_lights_of(&composition.world);
    for member in &composition.members {
        let added = motion.add(&member.model, member.world_from_model, &*files);
        if let Some(id) = added.model {
            views.add(Arc::new(member.model.clone()), id, &motion);
        }
    }
    let lens =
        Lens::pinhole((WIDTH_PX * RAYS) as u32, (HEIGHT_PX * RAYS) as u32, 1.2).expect("a lens");
    let shot = RenderRequest {
        lens: &lens,
        world_from_camera,
        near_m: 0.05,
        far_m: 100.0,
        visibility_mask: u32::MAX,
        own: None,
        outputs: ImageOutputs { colour: true, ..ImageOutputs::default() },
        threads: 2,
    };
    let mut picture = RenderedImages::default();
    views.at(SensedGeometry::Visual, 0, &motion).render(&shot, &mut picture);
    picture
}
