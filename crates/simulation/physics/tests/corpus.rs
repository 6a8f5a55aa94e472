//! Every robot and world of the corpus that loads: it is simulated for a fifth of a second, or the reason
//! why it cannot is reported.
#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "a test at the edge")]
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use periplus_diagnostics::Severity;
use periplus_loader::{LoadContext, load, read_mesh};
use periplus_os::Machine;
use periplus_physics::{Heights, Meshes, PhysicsMode, PhysicsWorld, Triangles};
use periplus_resources::{Host as _, Resolver};
use periplus_scene::{DVec3, Heightmap, Link, MeshShape, Model, Pose, Scene, Shape};

const STEP_NS: i64 = 1_000_000;
const STEPS: usize = 200;

/// Meshes from files, each read once.
#[derive(Default)]
struct Files {
    read: Mutex<BTreeMap<PathBuf, Option<periplus_meshes::Mesh>>>,
}

impl Meshes for Files {
    fn triangles(&self, mesh: &MeshShape) -> Option<Triangles> {
        let path = mesh.path.clone()?;
        let mut read = self.read.lock().unwrap();
        let file = read.entry(path.clone()).or_insert_with(|| {
            let bytes = Machine.read(&path).ok()?;
            read_mesh(&path, &bytes, &Machine)
        });
        let mut triangles = Triangles::default();
        for part in &file.as_ref()?.submeshes {
            if mesh.submesh.as_ref().is_some_and(|name| *name != part.name) {
                continue;
            }
            let first = triangles.points_m.len() as u32;
            let points = part.positions_m.iter().map(|&point| DVec3::from(point) * mesh.scale);
            triangles.points_m.extend(points);
            triangles.triangles.extend(part.triangles.iter().map(|it| it.map(|it| it + first)));
        }
        Some(triangles)
    }

    fn heights(&self, _: &Heightmap) -> Option<Heights> {
        None
    }
}

fn floor() -> Model {
    let plane = Shape::Plane { normal: DVec3::Z, size_m: [100.0, 100.0] };
    let collision = periplus_scene::Collision::new("plane", plane);
    let link = Link { collisions: vec![collision], ..Link::new("link") };
    Model { is_static: true, links: vec![link], ..Model::new("floor") }
}

/// Worlds of a scene; each of its robots alone, half a metre above a floor.
fn worlds(scene: &Scene, mode: PhysicsMode, files: &Files) -> (Vec<PhysicsWorld>, Vec<String>) {
    let mut made = Vec::new();
    let mut refused = Vec::new();
    let mut told = |diagnostics: &periplus_diagnostics::Diagnostics| {
        let errors = diagnostics.iter().filter(|it| it.severity == Severity::Error);
        refused.extend(errors.map(|error| format!("{}: {}", error.code, error.message)));
    };
    for world in &scene.worlds {
        let (world, diagnostics) = PhysicsWorld::new(world, mode, files);
        told(&diagnostics);
        made.push(world);
    }
    for model in &scene.models {
        let mut world = PhysicsWorld::empty(DVec3::new(0.0, 0.0, -9.8), mode);
        world.add(&floor(), Pose::IDENTITY, files);
        told(&world.add(model, Pose::from_xyz(0.0, 0.0, 0.5), files).diagnostics);
        made.push(world);
    }
    (made, refused)
}

#[test]
fn every_robot_and_world_stands_and_moves() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/corpus");
    if !corpus.is_dir() {
        println!("SKIPPED: ../shared/corpus is not here");
        return;
    }
    let mut paths = Vec::new();
    collect(&corpus, &mut paths);
    paths.sort();
    let host = Machine;
    let search = [corpus.join("gazebo_models")];
    let resolver = Resolver::new(&host, &search);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: corpus.clone(),
        arguments: Vec::new(),
        open_meshes: false,
    };
    let files = Files::default();
    let [mut loaded_files, mut scenes, mut still] = [0; 3];
    let mut refusals: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let (mut diverged, mut wrong, mut slow) = (Vec::new(), Vec::new(), Vec::new());
    for path in &paths {
        let name = path.strip_prefix(&corpus).unwrap_or(path).display().to_string();
        let loaded = load(path, &setting);
        let Some(scene) = &loaded.scene else { continue };
        loaded_files += 1;
        for mode in [PhysicsMode::Rigid, PhysicsMode::Kinematic] {
            let started = Instant::now();
            let (worlds, refused) = worlds(scene, mode, &files);
            for why in refused {
                let (code, message) = why.split_once(": ").unwrap();
                refusals.entry(code.into()).or_default().insert(format!("{name}: {message}"));
            }
            for mut world in worlds {
                scenes += 1;
                let outcome = (0..STEPS).try_for_each(|_| world.step(STEP_NS));
                if let Err(why) = outcome {
                    diverged.push(format!("{name}: {why}"));
                    continue;
                }
                let states = world.snapshot();
                let sound = states.iter().all(|(_, state)| {
                    state.world_from_link.is_finite()
                        && state.linear_m_s.is_finite()
                        && state.angular_rad_s.is_finite()
                });
                let fastest =
                    states.iter().map(|(_, state)| state.linear_m_s.length()).fold(0.0, f64::max);
                still += usize::from(fastest < 1e-3);
                if !sound {
                    wrong.push(format!("{name}: not finite"));
                }
                // A fall of 0.2 s gives 2 m/s.
                if fastest > 10.0 {
                    wrong.push(format!("{name}: something flies off at {fastest:.1} m/s"));
                }
            }
            let took = started.elapsed().as_secs_f64();
            if took > 2.0 {
                slow.push(format!("{name} ({mode:?}): {took:.1} s"));
            }
        }
    }
    println!("{loaded_files} files, {scenes} worlds and robots, {still} at rest");
    for (code, who) in &refusals {
        println!(
            "error {code}: {}\n  {}",
            who.len(),
            who.iter().take(12).cloned().collect::<Vec<_>>().join("\n  ")
        );
    }
    println!("slow: {}\n  {}", slow.len(), slow.join("\n  "));
    println!("diverged: {}\n  {}", diverged.len(), diverged.join("\n  "));
    println!("wrong: {}\n  {}", wrong.len(), wrong.join("\n  "));
    assert!(wrong.is_empty() && diverged.is_empty());
}

fn collect(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the corpus can be listed").flatten() {
        let path = entry.path();
        let extension = path.extension().and_then(|it| it.to_str()).unwrap_or_default();
        if path.is_dir() {
            collect(&path, into);
        } else if ["xacro", "urdf", "sdf", "world"].contains(&extension) {
            into.push(path);
        }
    }
}
