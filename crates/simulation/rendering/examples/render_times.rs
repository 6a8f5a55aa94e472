//! Render times over scenes from files, in milliseconds, one JSON line each, for comparison with
//! another renderer.
//!
//! `render_times SCENES SCENE[,SCENE] [THREADS [OUT]]`: `room` is a closed room of boxes under the
//! sun. For other scenes `SCENES/<scene>.mesh` is u32 vertices, u32 triangles, f32 positions, u32
//! corners. The first and the middle ray of `SCENES/rays/<scene>.depth_640x480.rays` (f32 origin and
//! direction) define the camera's pose. The light is a point light 1.6 m above it, or the sun in a
//! city. Images are written to `OUT/<scene>.png`.

#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a program for developers, that reads files and the clock"
)]

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use periplus_diagnostics::Origin;
use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_meshes::Submesh;
use periplus_rendering::{
    AssetLoader, ImageOutputs, Lens, NoAssets, RenderRequest, RenderScene, RenderedImages,
    SensedGeometry,
};
use periplus_scene::{
    Attenuation, Colour, Light, LightKind, Link, Material, MeshShape, Model, Shape, Visual,
};

struct One(Arc<periplus_meshes::Mesh>);

impl AssetLoader for One {
    fn mesh(&self, _: &MeshShape) -> Option<Arc<periplus_meshes::Mesh>> {
        Some(Arc::clone(&self.0))
    }
    fn image(&self, _: &str, _: Origin) -> Option<Arc<[u8]>> {
        None
    }
    fn texture(&self, _: &MeshShape, _: &str) -> Option<Arc<[u8]>> {
        None
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scenes, names, rest @ ..] = arguments.as_slice() else {
        println!("usage: render_times SCENES SCENE[,SCENE] [THREADS [OUT]]");
        return;
    };
    let threads = rest.first().map_or(1, |count| count.parse().unwrap());
    for name in names.split(',') {
        run(Path::new(scenes), name, threads, rest.get(1).map(Path::new));
    }
}

fn run(scenes: &Path, scene: &str, threads: usize, out: Option<&Path>) {
    let mut render_scene = RenderScene::empty(SensedGeometry::Visual, threads);
    let sun = scene == "city" || scene == "room";
    let world_from_camera = if scene == "room" {
        render_scene.add(&room(), Pose::IDENTITY, &NoAssets);
        Pose::from_xyz(0.2, 0.0, 0.3)
    } else {
        let shapes = One(Arc::new(mesh(&scenes.join(format!("{scene}.mesh")))));
        render_scene.add(&model(), Pose::IDENTITY, &shapes);
        camera(&scenes.join(format!("rays/{scene}.depth_640x480.rays")))
    };
    let lens = Lens::pinhole(640, 480, 75_f64.to_radians()).unwrap();
    let loads = [
        ("depth 640x480", ImageOutputs { depth: true, ..ImageOutputs::default() }, true),
        ("depth+labels 640x480", ImageOutputs { depth: true, labels: true, colour: false }, true),
        (
            "rgb+depth+labels 640x480, shadows",
            ImageOutputs { colour: true, depth: true, labels: true },
            true,
        ),
        (
            "rgb+depth+labels 640x480",
            ImageOutputs { colour: true, depth: true, labels: true },
            false,
        ),
    ];
    for (load, outputs, shadows) in loads {
        let mut light = lamp(sun, world_from_camera.translation);
        light.cast_shadows = shadows;
        render_scene.set_light(&light);
        let request = RenderRequest {
            lens: &lens,
            world_from_camera,
            near_m: 0.05,
            far_m: 1000.0,
            visibility_mask: u32::MAX,
            own: None,
            outputs,
            threads,
        };
        let mut picture = RenderedImages::default();
        let (mut walls, mut cpus) = (Vec::new(), Vec::new());
        let begin = Instant::now();
        while walls.len() < 9 || begin.elapsed().as_secs_f64() < 0.8 {
            let (start, cpu) = (Instant::now(), cpu_s());
            for _ in 0..4 {
                render_scene.render(&request, &mut picture);
            }
            walls.push(start.elapsed().as_secs_f64() * 250.0);
            cpus.push((cpu_s() - cpu) * 250.0);
        }
        walls.sort_by(f64::total_cmp);
        cpus.sort_by(f64::total_cmp);
        println!(
            "{{\"peer\":\"periplus\",\"scene\":\"{scene}\",\"load\":\"{load}\",\"threads\":{threads},\
             \"ms_cpu\":{:.2},\"ms_cpu_best\":{:.2},\"ms_wall_best\":{:.2},\"sum\":\"{:016x}\"}}",
            cpus[cpus.len() / 2],
            cpus[0],
            walls[0],
            sum(&picture)
        );
        if let (Some(out), true, true) = (out, outputs.colour, shadows) {
            let file = std::fs::File::create(out.join(format!("{scene}.png"))).unwrap();
            let mut encoder = png::Encoder::new(file, picture.width, picture.height);
            encoder.set_color(png::ColorType::Rgb);
            encoder.write_header().unwrap().write_image_data(&picture.rgb).unwrap();
        }
    }
}

/// Returns a checksum (FNV) for comparing images.
fn sum(picture: &RenderedImages) -> u64 {
    let depths = picture.depth_m.iter().flat_map(|depth_m| depth_m.to_bits().to_le_bytes());
    let bytes = picture.rgb.iter().copied().chain(depths).chain(picture.classes.iter().copied());
    bytes.fold(0xcbf2_9ce4_8422_2325, |sum: u64, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Returns CPU time of all threads of this process \[s\]; wall time where the system has no counter.
fn cpu_s() -> f64 {
    let mut sum = 0.0;
    if let Ok(tasks) = std::fs::read_dir("/proc/self/task") {
        for task in tasks.flatten() {
            let text = std::fs::read_to_string(task.path().join("schedstat")).unwrap_or_default();
            sum += text.split(' ').next().and_then(|t| t.parse::<f64>().ok()).unwrap_or(0.0);
        }
    }
    sum * 1e-9
}

fn model() -> Model {
    let mut link = Link::new("link");
    let shape = Shape::Mesh(MeshShape {
        uri: "scene".into(),
        path: None,
        submesh: None,
        center_submesh: false,
        scale: DVec3::ONE,
        extra: Vec::new(),
        origin: Origin::default(),
    });
    link.visuals.push(Visual::new("visual", shape));
    let mut model = Model::new("scene");
    model.is_static = true;
    model.links.push(link);
    model
}

/// Four walls and two boxes on a plane, with a slightly specular material.
fn room() -> Model {
    let grey = |shade: f64| Some(Colour([shade, shade, shade, 1.0]));
    let material = |shade: f64| Material {
        ambient: grey(shade),
        diffuse: grey(shade),
        specular: grey(0.01),
        shininess: Some(20.0),
        ..Material::default()
    };
    let mut model = Model::new("room");
    let mut put = |shape: Shape, at: [f64; 3], shade: f64| {
        let mut link = Link::new("link");
        link.name = format!("link_{}", model.links.len());
        link.model_from_link.translation = DVec3::from_array(at);
        let mut visual = Visual::new("visual", shape);
        visual.material = Some(material(shade));
        visual.cast_shadows = at != [0.0; 3];
        link.visuals.push(visual);
        model.links.push(link);
    };
    put(Shape::Plane { normal: DVec3::Z, size_m: [100.0; 2] }, [0.0; 3], 0.3);
    let boxes = [
        ([0.0, 2.4, 1.25], [7.0, 0.15, 2.5]),
        ([0.0, -2.4, 1.25], [7.0, 0.15, 2.5]),
        ([3.4, 0.0, 1.25], [0.15, 5.0, 2.5]),
        ([-3.4, 0.0, 1.25], [0.15, 5.0, 2.5]),
        ([2.0, 0.8, 0.3], [0.6, 0.5, 0.6]),
        ([2.4, -0.9, 0.5], [0.4, 0.8, 1.0]),
    ];
    for (at, [x, y, z]) in boxes {
        put(Shape::Box { size_m: DVec3::new(x, y, z) }, at, 0.7);
    }
    model
}

fn lamp(sun: bool, camera_m: DVec3) -> Light {
    Light {
        name: "lamp".into(),
        parent_from_light: Pose { translation: camera_m + DVec3::Z * 1.6, ..Pose::IDENTITY },
        kind: if sun { LightKind::Directional } else { LightKind::Point },
        direction_in_light: DVec3::new(-0.5, 0.1, -0.9),
        is_on: true,
        visualize: true,
        cast_shadows: true,
        intensity: 1.0,
        diffuse: Colour([0.8, 0.8, 0.8, 1.0]),
        specular: Colour([0.2, 0.2, 0.2, 1.0]),
        attenuation: Attenuation { range_m: 1000.0, constant: 1.0, linear: 0.02, quadratic: 0.0 },
        extra: Vec::new(),
        origin: Origin::default(),
    }
}

fn camera(rays: &Path) -> Pose {
    let bytes = std::fs::read(rays).unwrap();
    let numbers: Vec<f64> = bytes
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]).into())
        .collect();
    let middle = &numbers[6 * (240 * 640 + 320)..];
    let yaw = middle[4].atan2(middle[3]);
    Pose::from_xyz_rpy([numbers[0], numbers[1], numbers[2]], Rpy { roll: 0.0, pitch: 0.0, yaw })
}

fn mesh(path: &Path) -> periplus_meshes::Mesh {
    let bytes = std::fs::read(path).unwrap();
    let words: Vec<[u8; 4]> = bytes.chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]).collect();
    let (corners, triangles) =
        (u32::from_le_bytes(words[0]) as usize, u32::from_le_bytes(words[1]) as usize);
    let (positions, rest) = words[2..].split_at(3 * corners);
    let part = Submesh {
        positions_m: positions
            .chunks_exact(3)
            .map(|p| [0, 1, 2].map(|k: usize| f64::from(f32::from_le_bytes(p[k]))))
            .collect(),
        triangles: rest[..3 * triangles]
            .chunks_exact(3)
            .map(|t| [0, 1, 2].map(|k: usize| u32::from_le_bytes(t[k])))
            .collect(),
        ..Submesh::default()
    };
    periplus_meshes::Mesh { submeshes: vec![part], ..Default::default() }
}
