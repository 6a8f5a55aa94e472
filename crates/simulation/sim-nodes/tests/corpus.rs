//! Every robot of the corpus with a drive: the topics that it subscribes to, its odometry topics, and the
//! distance it travels in one second at 0.5 m/s.
#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "a test at the edge")]
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, Severity};
use periplus_graph::{Graph, Mailbox, NodeSettings, Qos};
use periplus_loader::{LoadedFile, load};
use periplus_msgs::geometry_msgs::{Twist, Vector3};
use periplus_msgs::{Message, nav_msgs};
use periplus_os::Machine;
use periplus_physics::{NoMeshes, PhysicsMode, PhysicsWorld};
use periplus_plugin_specs::{Role, interpret, model_sites};
use periplus_rendering::NoAssets;
use periplus_resources::Resolver;
use periplus_scene as scene;
use periplus_sensors::Quirks;
use periplus_sim_nodes::{
    Device, DeviceContext, NoParameterFiles, ParameterFiles, SenseContext, StepInterval, Views,
    drives,
};

const STEP_NS: i64 = 10_000_000;

#[test]
fn every_drive_of_the_corpus_drives() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/corpus");
    if !corpus.is_dir() {
        println!("SKIPPED: ../shared/corpus is not here");
        return;
    }
    let mut paths = Vec::new();
    collect(&corpus, &mut paths);
    paths.sort();
    let search = [corpus.join("gazebo_models")];
    let resolver = Resolver::new(&Machine, &search);
    let setting = periplus_loader::LoadContext {
        host: &Machine,
        resolver: &resolver,
        working_folder: corpus.clone(),
        arguments: Vec::new(),
        open_meshes: false,
    };
    let (mut drives, mut wrong) = (0, Vec::new());
    for path in &paths {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        if !["drive", "planar_move", "steering", "velocity-control"]
            .iter()
            .any(|it| text.contains(it))
        {
            continue;
        }
        let name = path.strip_prefix(&corpus).unwrap_or(path).display().to_string();
        let loaded = load(path, &setting);
        for model in models(&loaded) {
            let Some((table, ways_m)) = try_out(model) else { continue };
            drives += 1;
            println!("{name}: {}\n{table}", model.name);
            if ways_m.iter().any(|way_m| !way_m.is_finite() || *way_m > 10.0) {
                wrong.push(format!("{name}: odometry {ways_m:?}"));
            }
        }
    }
    println!("{drives} models with drives");
    assert!(drives > 0, "the corpus has robots that drive");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn models(loaded: &LoadedFile) -> Vec<&scene::Model> {
    let Some(scene) = &loaded.scene else { return Vec::new() };
    let worlds = scene.worlds.iter().flat_map(|world| &world.models);
    worlds.chain(&scene.models).filter(|model| !model.is_static).collect()
}

/// Topics of a model's drives, and their odometry after a second; `None` without drives.
fn try_out(model: &scene::Model) -> Option<(String, Vec<f64>)> {
    let mut file = scene::World::empty("corpus");
    file.models.push(scene::Model { parent_from_model: Default::default(), ..model.clone() });
    let (mut world, _) = PhysicsWorld::new(&file, PhysicsMode::Kinematic, &NoMeshes);
    let (id, _) = world.models().next()?;
    let graph = Graph::new();
    let root = &file.models[0];
    let files: Arc<dyn ParameterFiles> = Arc::new(NoParameterFiles);
    let setting = DeviceContext {
        graph: &graph,
        world: &world,
        scene: &file,
        root,
        model: id,
        model_name: &root.name,
        namespace: "/",
        is_confined: false,
        remaps: &[],
        seed: 0,
        quirks: Quirks::NONE,
        rolling_scans: false,
        start_ns: 0,
        publishes_joint_states: true,
        starts_controllers: true,
        bridges_transforms: true,
        floors: &[],
        parameter_files: &files,
    };
    let mut diagnostics = Diagnostics::new();
    let mut devices: Vec<Box<dyn Device>> = Vec::new();
    let mut table = String::new();
    let mut has_drive = false;
    for site in &model_sites(&file, root) {
        let Some(plugin) = interpret(site.plugin, &site.context, &mut diagnostics) else {
            continue;
        };
        let device = drives::build(&setting, site, &plugin, &mut diagnostics);
        if plugin.known.role == Role::Drive {
            has_drive = true;
            let fate = if device.is_some() { "drives" } else { "does not run" };
            let _ = writeln!(table, "  {} {fate}", plugin.known.id);
        }
        devices.extend(device);
    }
    if !has_drive {
        return None;
    }
    for finding in diagnostics.iter().filter(|finding| finding.severity == Severity::Error) {
        let _ = writeln!(table, "  {}: {}", finding.code, finding.message);
    }
    let ear = graph.node(NodeSettings::new("ear")).unwrap();
    let mut odometries: Vec<Mailbox<nav_msgs::Odometry>> = Vec::new();
    for topic in graph.topics() {
        if topic.type_name == <Twist as Message>::TYPE_NAME && !topic.subscriptions.is_empty() {
            let _ = writeln!(table, "  hears {}", topic.name);
            let x = Vector3 { x: 0.5, y: 0.0, z: 0.0 };
            let twist = Twist { linear: x, angular: Vector3::default() };
            ear.publisher(&topic.name, Qos::reliable(1)).unwrap().publish(twist);
        }
        if topic.type_name == <nav_msgs::Odometry as Message>::TYPE_NAME {
            odometries.push(ear.mailbox(&topic.name, Qos::best_effort(1)).unwrap());
        }
    }
    let views = Views::new(Arc::new(NoAssets), 1);
    for step in 0..100 {
        let span = StepInterval { start_ns: step * STEP_NS, length_ns: STEP_NS };
        devices.iter_mut().for_each(|device| device.act(&mut world, span));
        world.step(STEP_NS).unwrap();
        graph.advance_to(span.end_ns());
        let mut moment = SenseContext { span, world: &world, views: &views, threads: 1 };
        devices.iter_mut().for_each(|device| device.sense(&mut moment));
    }
    let mut ways_m = Vec::new();
    for odometry in &odometries {
        let Some(last) = odometry.latest() else { continue };
        let position = &last.pose.pose.position;
        ways_m.push(position.x.hypot(position.y));
        let _ = writeln!(
            table,
            "  {} {} -> {} {:.3} m",
            odometry.topic(),
            last.header.frame_id,
            last.child_frame_id,
            position.x
        );
    }
    Some((table, ways_m))
}

fn collect(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, into);
        } else if let Some(extension) = path.extension().and_then(|extension| extension.to_str())
            && ["xacro", "urdf", "sdf", "world", "gazebo"].contains(&extension)
        {
            into.push(path);
        }
    }
}
