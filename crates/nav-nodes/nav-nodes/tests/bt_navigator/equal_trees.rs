//! Built-in trees beside the files of Nav2.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use periplus_behavior_tree::{
    Blackboard, NodeModel, NodeRegistry, NodeStatus, PortType, TreeContext, TreeFiles, nav2,
};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::Stream;
use periplus_nav_nodes::bt_navigator::{built_in_tree, built_in_tree_files};
use periplus_resources::MemoryHost;

use crate::world::World;

const RELEASES: [(&str, Nav2Release); 3] =
    [("humble", Nav2Release::Humble), ("jazzy", Nav2Release::Jazzy), ("main", Nav2Release::Main)];
/// Number of random sequences of results.
const SEEDS: u64 = 40;
/// Number of ticks of each.
const TICKS: i64 = 200;

fn trees() -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/nav/behavior_trees");
    if !path.is_dir() {
        eprintln!("SKIPPED: {} is missing", path.display());
        return None;
    }
    Some(path)
}

/// Robot at a distance from its start \[m\].
struct Moving(f64);

impl TreeContext for Moving {
    fn robot_position_m(&mut self, _: Option<&str>, _: Option<&str>) -> Option<[f64; 2]> {
        Some([self.0, 0.0])
    }

    fn speed_m_s(&mut self) -> f64 {
        0.1
    }
}

/// Calls of leaves in each tick, by type, when their results are random by seed, type and number of the call.
fn calls(xml: &str, models: &[NodeModel], release: Nav2Release, seed: u64) -> Vec<String> {
    let calls: Arc<Mutex<Vec<String>>> = Arc::default();
    let mut registry = NodeRegistry::new();
    let is_main = release == Nav2Release::Main;
    let rules = if is_main { nav2::Nav2NodeRules::MAIN } else { nav2::Nav2NodeRules::JAZZY };
    nav2::register(&mut registry, rules);
    // It needs a topic; without a message it ticks its child.
    let updater = models.iter().find(|model| model.name == "GoalUpdater").unwrap();
    registry.register_leaf(updater.clone(), |run| run.tick_child(0));
    for model in models.iter().filter(|model| model.kind.is_leaf()) {
        let mut model = model.clone();
        for port in ["error_code_id", "error_msg", "input_path", "tracking_feedback", "is_recovery"]
        {
            if model.find(port).is_none() {
                model = model.input(port, PortType::Any);
            }
        }
        let can_run = model.kind == periplus_behavior_tree::NodeKind::Action;
        let calls = calls.clone();
        registry.register_leaf(model, move |run| {
            let mut calls = calls.lock().unwrap();
            // Ports as written distinguish several nodes of a type.
            let port = run.port_text("service_name").unwrap_or_default();
            let call = format!("{} {port}", run.type_name());
            let number = calls.iter().filter(|other| **other == call).count() as u64;
            let bits = Stream::keyed(seed, &call, number).bits();
            calls.push(call);
            Ok(match bits % 10 {
                0..=3 => NodeStatus::Success,
                4..=6 if can_run => NodeStatus::Running,
                _ => NodeStatus::Failure,
            })
        });
    }
    let files = TreeFiles::parse("tree.xml", xml, &registry);
    let mut tree =
        files.tree("", &registry, Blackboard::new()).unwrap_or_else(|it| panic!("{it:#?}"));
    for tick in 0..TICKS {
        let mut robot = Moving(tick as f64 * 0.3);
        let status = tree.tick(tick * 100_000_000, &mut robot).unwrap();
        calls.lock().unwrap().push(status.name().to_owned());
    }
    let calls = calls.lock().unwrap();
    calls.clone()
}

#[test]
fn built_in_trees_are_equal_to_those_of_nav2_tick_for_tick() {
    let Some(folder) = trees() else { return };
    for (distro, release) in RELEASES {
        let text = fs::read_to_string(folder.join(distro).join("nav2_tree_nodes.xml")).unwrap();
        let mut sources = SourceMap::new();
        let id = sources.add("nav2_tree_nodes.xml", text);
        let document = periplus_xml::parse(id, &sources, &mut Diagnostics::new()).unwrap();
        let models = NodeModel::read_all(&document.root);
        for file in built_in_tree_files() {
            let theirs = fs::read_to_string(folder.join(distro).join(file)).unwrap();
            let ours = built_in_tree(release, file).unwrap();
            let mut longest = 0;
            for seed in 0..SEEDS {
                let ours = calls(&ours, &models, release, seed);
                assert_eq!(ours, calls(&theirs, &models, release, seed), "{distro} {file} {seed}");
                longest = longest.max(ours.len());
            }
            assert!(longest > 250, "{distro} {file} {longest}");
        }
    }
}

#[test]
fn trees_of_nav2_load_with_the_own_nodes() {
    let Some(folder) = trees() else { return };
    let mut count = 0;
    for (distro, release) in RELEASES {
        for entry in fs::read_dir(folder.join(distro)).unwrap() {
            let path = entry.unwrap().path();
            if path.ends_with("nav2_tree_nodes.xml") {
                continue;
            }
            let name = format!("/t/{}", path.file_name().unwrap().to_str().unwrap());
            let files = MemoryHost::new().with_file(&name, fs::read(&path).unwrap());
            let world =
                World::with(release, files, &[("default_nav_to_pose_bt_xml", name.as_str())]);
            assert!(world.navigator.lifecycle().is_active(), "{}", path.display());
            count += 1;
        }
    }
    assert_eq!(count, 39);
}
