//! Changes of a running world as a diff of its file.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, reason = "reads written files")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_graph::{Node, NodeSettings};
use periplus_msgs::Service;
use periplus_msgs::geometry_msgs::{Point, Pose, Quaternion};
use periplus_msgs::ros_gz_interfaces::{
    DeleteEntity, DeleteEntityRequest, Entity, EntityFactory, SetEntityPose, SetEntityPoseRequest,
    SpawnEntity, SpawnEntityRequest,
};
use periplus_msgs::std_srvs::{Trigger, TriggerRequest};
use periplus_sim::{AssetFiles, Options, Search, Services, Simulation, compose};

const WORLD: &str = "<?xml version='1.0'?>
<sdf version='1.9'>
  <world name='lab'>
    <!-- a floor -->
    <include><uri>model://ground_plane</uri></include>
    <light name='sun' type='directional'/>
    <model name='table'>
      <static>true</static>
      <pose>1  2 0   0 0 0</pose><!-- beside the door -->
      <link name='link'><collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link>
    </model>

    <model name='ball'>
      <pose>0 5 4 0 0 0</pose>
      <link name='link'><collision name='c'><geometry><sphere><radius>0.5</radius></sphere></geometry></collision></link>
    </model>
  </world>
</sdf>
";

const CUP: &str = "<sdf version='1.9'><model name='cup'><static>true</static><link name='link'>\
<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>";

struct Lab {
    simulation: Simulation,
    services: Services,
    node: Node,
    path: PathBuf,
}

impl Lab {
    /// A world in a file of the test's name.
    fn new(test: &str, world: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{test}.sdf"));
        std::fs::write(&path, world).unwrap();
        let search =
            Search { working_folder: env!("CARGO_TARGET_TMPDIR").into(), ..Search::default() };
        let mut composition = search.with_context(true, |context| compose(&path, &[], context));
        assert!(!composition.has_errors(), "{:?}", composition.files[0].diagnostics);
        let files = Arc::new(AssetFiles::default());
        let simulation = Simulation::new(&mut composition, files, Options::default());
        let mut services = Services::new(&simulation, search).unwrap();
        services.show(&simulation, Vec::new()).unwrap();
        let node = simulation.graph().node(NodeSettings::new("user")).unwrap();
        Self { simulation, services, node, path }
    }

    fn call<S: Service>(&mut self, name: &str, request: S::Request) -> Arc<S::Response> {
        let answer = self.node.client::<S>(name).unwrap().call(request);
        self.services.serve(&mut self.simulation);
        answer.take().expect("an answer").unwrap_or_else(|error| panic!("{error}"))
    }

    fn move_to(&mut self, name: &str, at: [f64; 3]) {
        let entity = Entity { name: name.into(), r#type: Entity::MODEL, ..Entity::default() };
        let request = SetEntityPoseRequest { entity, pose: pose(at) };
        assert!(self.call::<SetEntityPose>("/world/lab/set_pose", request).success);
    }

    fn remove(&mut self, name: &str) {
        let entity = Entity { name: name.into(), r#type: Entity::MODEL, ..Entity::default() };
        assert!(
            self.call::<DeleteEntity>("/world/lab/remove", DeleteEntityRequest { entity }).success
        );
    }

    fn insert(&mut self, name: &str, sdf: &str, at: [f64; 3]) {
        let entity_factory = EntityFactory {
            name: name.into(),
            sdf: sdf.into(),
            pose: pose(at),
            ..EntityFactory::default()
        };
        let request = SpawnEntityRequest { entity_factory };
        assert!(self.call::<SpawnEntity>("/world/lab/create", request).success);
    }

    fn changes(&mut self) -> serde_json::Value {
        let answer = self.call::<Trigger>("/world/lab/changes", TriggerRequest::default());
        assert!(answer.success, "{}", answer.message);
        serde_json::from_str(&answer.message).unwrap()
    }

    /// Checks the text of the changed file, and their list as `kind name`.
    fn check(&mut self, expected: &str, list: &[&str]) {
        let changes = self.changes();
        assert_eq!(changes["text"], expected, "{changes}");
        assert_eq!(changes["file"], self.path.display().to_string());
        assert_eq!(changes["diff"] == "", expected == WORLD);
        assert_eq!(listed(&changes), list);
    }
}

fn listed(changes: &serde_json::Value) -> Vec<String> {
    let text = |value: &serde_json::Value| value.as_str().unwrap().to_owned();
    let all = changes["changes"].as_array().unwrap().iter();
    all.map(|one| format!("{} {}", text(&one["kind"]), text(&one["model"]))).collect()
}

fn pose([x, y, z]: [f64; 3]) -> Pose {
    let orientation = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };
    Pose { position: Point { x, y, z }, orientation }
}

fn replaced(from: &str, to: &str) -> String {
    assert!(WORLD.contains(from));
    WORLD.replacen(from, to, 1)
}

#[test]
fn motion_is_no_change() {
    let mut lab = Lab::new("motion", WORLD);
    for _ in 0..100 {
        lab.services.serve(&mut lab.simulation);
        lab.simulation.step().unwrap();
    }
    lab.check(WORLD, &[]);
}

#[test]
fn a_moved_model_changes_its_pose_and_nothing_else() {
    let mut lab = Lab::new("moved", WORLD);
    lab.move_to("table", [1.0, 2.5, 0.0]);
    lab.check(&replaced("1  2 0   0 0 0", "1  2.5 0   0 0 0"), &["moved table"]);
    let diff = lab.changes()["diff"].as_str().unwrap().to_owned();
    let lines: Vec<&str> = diff.lines().filter(|line| line.starts_with(['+', '-'])).collect();
    assert_eq!(
        lines[2..],
        [
            "-      <pose>1  2 0   0 0 0</pose><!-- beside the door -->",
            "+      <pose>1  2.5 0   0 0 0</pose><!-- beside the door -->",
        ]
    );
    lab.move_to("table", [1.0, 2.0, 0.0]);
    lab.check(WORLD, &[]);
    // A ball that is placed in the air falls; its file has the pose that was requested.
    lab.move_to("ball", [0.0, 6.0, 4.0]);
    lab.simulation.step().unwrap();
    lab.check(&replaced("0 5 4", "0 6 4"), &["moved ball"]);
    lab.simulation.reset();
    lab.check(WORLD, &[]);
}

#[test]
fn a_removed_model_loses_its_element() {
    let mut lab = Lab::new("removed", WORLD);
    lab.remove("ball");
    let start = WORLD.find("    <model name='ball'>").unwrap();
    let end = WORLD.find("  </world>").unwrap();
    lab.check(&format!("{}{}", &WORLD[..start], &WORLD[end..]), &["removed ball"]);
    lab.remove("ground_plane");
    let changes = lab.changes();
    assert_eq!(listed(&changes), ["removed ground_plane", "removed ball"]);
    assert!(!changes["text"].as_str().unwrap().contains("<include>"));
    assert!(changes["text"].as_str().unwrap().contains("<!-- a floor -->"));
}

#[test]
fn an_inserted_model_is_the_last_element() {
    let mut lab = Lab::new("inserted", WORLD);
    lab.insert("mug", CUP, [1.0, 0.0, 0.25]);
    let text = lab.changes()["text"].as_str().unwrap().to_owned();
    let (before, after) = WORLD.split_at(WORLD.find("  </world>").unwrap());
    let model = text.strip_prefix(before).unwrap().strip_suffix(after).unwrap();
    assert!(model.starts_with("    <model name=\"mug\">\n") && model.ends_with("    </model>\n"));
    assert!(model.contains("<pose>1 0 0.25 0 0 0</pose>"), "{model}");
    assert_eq!(listed(&lab.changes()), ["inserted mug"]);
    // The text gives the world that runs.
    let mut again = Lab::new("inserted_again", &text);
    assert!(again.simulation.models().eq(lab.simulation.models()));
    assert_eq!(listed(&again.changes()), Vec::<String>::new());
    lab.remove("mug");
    lab.check(WORLD, &[]);
}

#[test]
fn another_name_of_the_same_model_is_a_renamed_one() {
    let mut lab = Lab::new("renamed", WORLD);
    let table = WORLD[WORLD.find("<model name='table'>").unwrap()..].split_inclusive("</model>");
    let table = table.take(1).collect::<String>();
    lab.remove("table");
    lab.insert("desk", &format!("<sdf version='1.9'>{table}</sdf>"), [1.0, 2.0, 0.0]);
    lab.check(&replaced("'table'", "'desk'"), &["renamed desk"]);
}

#[test]
fn a_world_without_a_file_of_its_own_is_written_as_a_whole() {
    let mut lab = Lab::new("robot", CUP);
    let text = lab.call::<Trigger>("/world/default/changes", TriggerRequest::default());
    let changes: serde_json::Value = serde_json::from_str(&text.message).unwrap();
    assert!(changes["file"].is_null() && changes["diff"] == "");
    assert!(changes["text"].as_str().unwrap().contains("<model name=\"cup\""));
    assert!(changes["note"].as_str().unwrap().contains("SDF"));
    // A file that another program has changed is not overwritten.
    let mut lab = Lab::new("changed", WORLD);
    std::fs::write(&lab.path, "<sdf/>").unwrap();
    let changes = lab.changes();
    assert!(changes["file"].is_null());
    assert!(changes["note"].as_str().unwrap().contains("changed since"), "{changes}");
}

#[test]
fn the_world_is_written_only_where_the_user_has_said() {
    let mut lab = Lab::new("written", WORLD);
    let services = lab.simulation.graph().services();
    assert!(!services.iter().any(|service| service.name == "/world/lab/write"));
    let path = lab.path.clone();
    lab.services.write_world_to(&lab.simulation, path.clone()).unwrap();
    let write = |lab: &mut Lab| {
        let answer = lab.call::<Trigger>("/world/lab/write", TriggerRequest::default());
        (answer.success, answer.message.clone())
    };
    // Twice: the file then has the text that was written, not that of the start.
    for y_m in [2.5, 2.75] {
        lab.move_to("table", [1.0, y_m, 0.0]);
        assert_eq!(write(&mut lab), (true, path.display().to_string()));
        let expected = replaced("1  2 0   0 0 0", &format!("1  {y_m} 0   0 0 0"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), expected);
    }
    std::fs::write(&path, "<sdf/>").unwrap();
    let (success, why) = write(&mut lab);
    assert!(!success && why.contains("changed since"), "{why}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "<sdf/>");
}
