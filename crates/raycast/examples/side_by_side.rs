//! Rays per CPU second over scenes and loads of files, one JSON line each, to be laid beside the
//! lines of other ray casters over the same files.
//!
//! `side_by_side SCENES SCENE[,SCENE] [OUT [THREADS]]`: `SCENES/<scene>.mesh` is u32 vertices, u32
//! triangles, f32 positions, u32 corners; `SCENES/rays/<scene>.<load>.rays` is f32 origin and
//! direction of each ray. Distances go to `OUT/ours.<scene>.<load>.f32`. A scene called `dynamic` is
//! described in `SCENES/dynamic.json`: a house and moving boxes and links.

#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a program for developers, that reads files and the clock"
)]

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use periplus_base::{DQuat, DVec3, Pose};
use periplus_raycast::{Filter, Ray, Tags, TriangleMesh, World, WorldBuilder};
use serde_json::Value;

/// Name and rays in a row: rays of an image or a scan of several rings lie in rows.
const LOADS: [(&str, usize); 8] = [
    ("lidar2d_360", 360),
    ("lidar2d_1440", 1440),
    ("lidar3d_64x1024", 1024),
    ("lidar3d_128x2048", 2048),
    ("depth_640x480", 640),
    ("batch_1024x360", usize::MAX),
    ("random", usize::MAX),
    ("edges", usize::MAX),
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scenes, names, rest @ ..] = arguments.as_slice() else {
        println!("usage: side_by_side SCENES SCENE[,SCENE] [OUT [THREADS]]");
        return;
    };
    let threads = rest.get(1).map_or(1, |count| count.parse().unwrap());
    for name in names.split(',') {
        run(Path::new(scenes), name, rest.first().map(Path::new), threads);
    }
}

fn run(scenes: &Path, scene: &str, out: Option<&Path>, threads: usize) {
    let base = if scene == "dynamic" { "house" } else { scene };
    let (positions, triangles) = mesh(&scenes.join(format!("{base}.mesh")));
    let mut builds = Vec::new();
    let mut world = None;
    for _ in 0..3 {
        let mut builder = World::builder();
        builder.add_fixed(&positions, &triangles, &Pose::IDENTITY, Tags::default()).unwrap();
        let start = Instant::now();
        world = Some(builder.build(threads).unwrap());
        builds.push(start.elapsed().as_secs_f64() * 1e3);
    }
    let (mut world, build_ms) = (world.unwrap(), median(&mut builds));
    if scene == "dynamic" {
        world = dynamic(&scenes.join("dynamic.json"), positions, triangles);
    }
    for (load, columns) in LOADS {
        let file = scenes.join(format!("rays/{base}.{load}.rays"));
        let Ok(bytes) = std::fs::read(&file) else { continue };
        let rays = rays(&bytes);
        let mut distances = vec![0.0_f32; rays.len()];
        let inner = if rays.len() < 10_000 { 20 } else { 1 };
        let mut walls = Vec::new();
        let (begin, cpu) = (Instant::now(), cpu_s());
        while walls.len() < 3 || begin.elapsed().as_secs_f64() < 0.8 {
            let start = Instant::now();
            for _ in 0..inner {
                world.cast_grid(
                    &rays,
                    columns.min(rays.len()),
                    Filter::default(),
                    threads,
                    &mut distances,
                );
            }
            walls.push(start.elapsed().as_secs_f64() / f64::from(inner));
        }
        // Of the main thread, and only as fine as the scheduler's ticks: over all repeats.
        let cpu = (cpu_s() - cpu) / (walls.len() as f64 * f64::from(inner));
        let million = rays.len() as f64 / 1e6;
        let best = walls.iter().copied().fold(f64::INFINITY, f64::min);
        let line = serde_json::json!({
            "peer": "ours", "scene": scene, "load": load, "threads": threads, "rays": rays.len(),
            "mrays_per_s": million / median(&mut walls), "mrays_cpu": (threads == 1).then(|| million / cpu),
            "mrays_best": million / best, "build_ms": build_ms, "bytes": world.size_bytes(),
            "hits": distances.iter().filter(|distance| distance.is_finite()).count(),
        });
        println!("{line}");
        if let Some(out) = out {
            std::fs::create_dir_all(out).unwrap();
            let bytes: Vec<u8> = distances.iter().flat_map(|d| d.to_le_bytes()).collect();
            std::fs::write(out.join(format!("ours.{scene}.{load}.f32")), bytes).unwrap();
        }
    }
}

/// The house with its moving instances at their first poses; tells what a frame's update takes.
fn dynamic(file: &Path, positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> World {
    let json: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    let mut builder: WorldBuilder = World::builder();
    builder.add_fixed(&positions, &triangles, &Pose::IDENTITY, Tags::default()).unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let three = |value: &Value| [0, 1, 2].map(|axis: usize| number(&value[axis]));
    let shape = |value: &Value, size: [f64; 3]| {
        let positions: Vec<[f64; 3]> = value["v"]
            .as_array()
            .unwrap()
            .iter()
            .map(|p| {
                let p = three(p);
                [p[0] * size[0], p[1] * size[1], p[2] * size[2]]
            })
            .collect();
        let triangles: Vec<[u32; 3]> =
            value["t"].as_array().unwrap().iter().map(|t| three(t).map(|x| x as u32)).collect();
        Arc::new(TriangleMesh::new(&positions, &triangles, 1).unwrap())
    };
    let mut meshes = Vec::new();
    for size in json["box_size"].as_array().unwrap() {
        meshes.push(shape(&json["box"], three(size)));
    }
    for link in json["links"].as_array().unwrap() {
        meshes.push(shape(link, [1.0; 3]));
    }
    let ids: Vec<_> = meshes
        .into_iter()
        .map(|mesh| builder.add_mesh(mesh, &Pose::IDENTITY, Tags::default()).unwrap())
        .collect();
    let mut world = builder.build(1).unwrap();
    let mut times = Vec::new();
    for _ in 0..5 {
        for frame in json["frames"].as_array().unwrap() {
            let poses: Vec<_> = ids
                .iter()
                .zip(frame.as_array().unwrap())
                .map(|(&id, m)| {
                    let m = |index: usize| number(&m[index]);
                    // All of them turn about z only.
                    let yaw = m(4).atan2(m(0));
                    let turn = DQuat::from_rotation_z(yaw);
                    (id, Pose { translation: DVec3::new(m(3), m(7), m(11)), rotation: turn })
                })
                .collect();
            let start = Instant::now();
            world.move_to(&poses).unwrap();
            times.push(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    let line = serde_json::json!({
        "peer": "ours", "scene": "dynamic", "instances": ids.len(), "update_us": median(&mut times),
    });
    println!("{line}");
    world
}

fn mesh(file: &Path) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let bytes = std::fs::read(file).unwrap();
    let words: Vec<u32> =
        bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let split = 2 + 3 * words[0] as usize;
    let position = |p: &[u32]| [p[0], p[1], p[2]].map(|bits| f64::from(f32::from_bits(bits)));
    (
        words[2..split].chunks_exact(3).map(position).collect(),
        words[split..].chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    )
}

fn rays(bytes: &[u8]) -> Vec<Ray> {
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    bytes
        .chunks_exact(24)
        .map(|b| {
            let [ox, oy, oz, dx, dy, dz] = [0, 4, 8, 12, 16, 20].map(|at: usize| number(&b[at..]));
            Ray::new(DVec3::new(ox, oy, oz), DVec3::new(dx, dy, dz))
        })
        .collect()
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// CPU time of the main thread [s].
fn cpu_s() -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|ns| ns.parse::<f64>().ok()).unwrap_or(f64::NAN) / 1e9
}
