//! Our rays over scenes and loads of files, one JSON line each, as the peers write them.
//!
//! `SCENES/<scene>.mesh` is u32 vertices, u32 triangles, f32 positions, u32 corners;
//! `SCENES/rays/<scene>.<load>.rays` is f32 origin and direction of each ray. Distances go to
//! `OUT/<peer>.<scene>.<load>.f32`. A scene called `dynamic` is described in `SCENES/dynamic.json`:
//! a house and moving boxes and links.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_raycast::{
    Filter, Ray, RaycastShape, RaycastWorld, RaycastWorldBuilder, Tags, TriangleMesh,
};
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Value, json};

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

/// Runs all loads of a scene with one thread, then with two; `"-prim"` after a scene's name takes
/// its shapes instead of its triangles.
pub(crate) fn run(scenes: &Path, scene: &str, out: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(out)?;
    let (base, peer) = match scene.strip_suffix("-prim") {
        Some(base) => (base, "ours-prim"),
        None if scene == "dynamic" => ("house", "ours"),
        None => (scene, "ours"),
    };
    let mut build_ms = [f64::INFINITY; 2];
    let world = if peer == "ours-prim" {
        primitives(&json(&scenes.join(format!("{base}.json")))?)
    } else {
        let (positions, triangles) = mesh(&scenes.join(format!("{base}.mesh")))?;
        if scene == "dynamic" {
            dynamic(&json(&scenes.join("dynamic.json"))?, &positions, &triangles)
        } else {
            let build = |threads| {
                let mut builder = RaycastWorld::builder();
                let (pose, tags) = (Pose::IDENTITY, Tags::default());
                builder.add_fixed(&positions, &triangles, &pose, tags).expect(SOUND);
                let start = Instant::now();
                let world = builder.build(threads).expect(SOUND);
                (world, start.elapsed().as_secs_f64() * 1e3)
            };
            let (mut world, _) = build(1);
            for _ in 0..3 {
                for threads in [1, 2] {
                    let (new, ms) = build(threads);
                    world = new;
                    build_ms[threads - 1] = build_ms[threads - 1].min(ms);
                }
            }
            world
        }
    };
    for (load, columns) in LOADS {
        let Ok(bytes) = std::fs::read(scenes.join(format!("rays/{base}.{load}.rays"))) else {
            continue;
        };
        let rays = rays(&bytes);
        for threads in [1, 2] {
            let times = measure(&world, &rays, columns, threads);
            let million = rays.len() as f64 / 1e6;
            let hits = times.distances_m.iter().filter(|distance| distance.is_finite()).count();
            let line = json!({
                "peer": peer, "scene": if scene == "dynamic" { scene } else { base },
                "load": load, "threads": threads, "rays": rays.len(),
                "mrays_per_s": million / times.wall_s, "mrays_cpu": million / times.cpu_s,
                "mrays_best": million / times.best_s, "build_ms": finite(build_ms[threads - 1]),
                "bytes": world.size_bytes(), "hits": hits,
            });
            println!("{line}");
            if threads == 1 {
                let bytes: Vec<u8> =
                    times.distances_m.iter().flat_map(|d| d.to_le_bytes()).collect();
                std::fs::write(out.join(format!("{peer}.{base}.{load}.f32")), bytes)?;
            }
        }
    }
    Ok(())
}

const SOUND: &str = "scenes are sound";

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

struct Times {
    /// Medians of the repeats.
    wall_s: f64,
    cpu_s: f64,
    best_s: f64,
    distances_m: Vec<f32>,
}

fn measure(world: &RaycastWorld, rays: &[Ray], columns: usize, threads: usize) -> Times {
    let mut distances_m = vec![0.0_f32; rays.len()];
    let inner = if rays.len() < 10_000 { 20 } else { 1 };
    let (mut walls, mut cpus) = (Vec::new(), Vec::new());
    let begin = Instant::now();
    while walls.len() < 3 || walls.len() < 15 && begin.elapsed().as_secs_f64() < 0.8 {
        let (start, cpu) = (Instant::now(), cpu_s());
        for _ in 0..inner {
            world.cast_grid(rays, columns, Filter::default(), threads, &mut distances_m);
        }
        walls.push(start.elapsed().as_secs_f64() / f64::from(inner));
        cpus.push((cpu_s() - cpu) / f64::from(inner));
    }
    let best_s = walls.iter().copied().fold(f64::INFINITY, f64::min);
    Times { wall_s: median(&mut walls), cpu_s: median(&mut cpus), best_s, distances_m }
}

/// The shapes of a scene, in closed form.
fn primitives(scene: &Value) -> RaycastWorld {
    let mut builder = RaycastWorld::builder();
    for each in list(&scene["primitives"]) {
        let number = |name: &str| each[name].as_f64().unwrap_or_default();
        let shape = match each["type"].as_str() {
            Some("plane") => RaycastShape::Plane { size_m: None },
            Some("box") => RaycastShape::Box { size_m: DVec3::from_array(three(&each["size"])) },
            Some("sphere") => RaycastShape::Sphere { radius_m: number("radius") },
            _ => RaycastShape::Cylinder { radius_m: number("radius"), length_m: number("length") },
        };
        let middle = if each["center"].is_null() { [0.0; 3] } else { three(&each["center"]) };
        let pose = Pose::from_xyz(middle[0], middle[1], middle[2]);
        builder.add_shape(&shape, &pose, Tags::default()).expect(SOUND);
    }
    builder.build(1).expect(SOUND)
}

fn json(file: &Path) -> std::io::Result<Value> {
    Ok(serde_json::from_slice(&std::fs::read(file)?)?)
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn three(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|axis: usize| value[axis].as_f64().unwrap_or_default())
}

/// The house with moving instances after some frames; prints the time of a frame's update.
fn dynamic(scene: &Value, positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> RaycastWorld {
    let mut builder: RaycastWorldBuilder = RaycastWorld::builder();
    builder.add_fixed(positions, triangles, &Pose::IDENTITY, Tags::default()).expect(SOUND);
    let shape = |value: &Value, size: [f64; 3]| {
        let positions: Vec<[f64; 3]> = list(&value["v"])
            .iter()
            .map(|p| {
                let p = three(p);
                [p[0] * size[0], p[1] * size[1], p[2] * size[2]]
            })
            .collect();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "indices")]
        let triangles: Vec<[u32; 3]> =
            list(&value["t"]).iter().map(|t| three(t).map(|x| x as u32)).collect();
        Arc::new(TriangleMesh::new(&positions, &triangles, 1).expect(SOUND))
    };
    let boxes = list(&scene["box_size"]).iter().map(|size| shape(&scene["box"], three(size)));
    let links = list(&scene["links"]).iter().map(|link| shape(link, [1.0; 3]));
    let ids: Vec<_> = boxes
        .chain(links)
        .map(|mesh| builder.add_mesh(mesh, &Pose::IDENTITY, Tags::default()).expect(SOUND))
        .collect();
    let mut world = builder.build(1).expect(SOUND);
    let mut times = Vec::new();
    for _ in 0..5 {
        for frame in list(&scene["frames"]) {
            let poses: Vec<_> = ids
                .iter()
                .zip(list(frame))
                .map(|(&id, m)| {
                    let m = |index: usize| m[index].as_f64().unwrap_or_default();
                    // All of them turn about z only.
                    let yaw = m(4).atan2(m(0));
                    let turn = DQuat::from_rotation_z(yaw);
                    (id, Pose { translation: DVec3::new(m(3), m(7), m(11)), rotation: turn })
                })
                .collect();
            let start = Instant::now();
            world.move_to(&poses).expect(SOUND);
            times.push(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    let line = json!({
        "peer": "ours", "scene": "dynamic", "instances": ids.len(), "update_us": median(&mut times),
    });
    println!("{line}");
    world
}

#[expect(clippy::type_complexity, reason = "positions and corners")]
fn mesh(file: &Path) -> std::io::Result<(Vec<[f64; 3]>, Vec<[u32; 3]>)> {
    let bytes = std::fs::read(file)?;
    let words: Vec<u32> =
        bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let split = 2 + 3 * words[0] as usize;
    let position = |p: &[u32]| [p[0], p[1], p[2]].map(|bits| f64::from(f32::from_bits(bits)));
    Ok((
        words[2..split].chunks_exact(3).map(position).collect(),
        words[split..].chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    ))
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

/// CPU time of all threads \[s\].
#[expect(clippy::cast_precision_loss, reason = "it has run for less than a year")]
fn cpu_s() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
