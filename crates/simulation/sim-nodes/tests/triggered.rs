//! Keys become velocities, as in the third tutorial.
#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use periplus_diagnostics::{Diagnostics, Origin, SourceMap};
use periplus_geometry::DVec3;
use periplus_graph::{Graph, Mailbox, NodeSettings, Publisher, Qos};
use periplus_msgs::geometry_msgs::Twist;
use periplus_msgs::std_msgs::Int32;
use periplus_physics::{PhysicsMode, PhysicsWorld};
use periplus_scene as scene;
use periplus_sim_nodes::{Device, StepInterval, world_devices};

/// Devices and findings of a world that has a plugin with these elements.
fn devices(graph: &Graph, inside: &str) -> (Vec<Box<dyn Device>>, Vec<String>) {
    let text = format!("<plugin>{inside}</plugin>");
    let mut sources = SourceMap::new();
    let file = sources.add("plugin.sdf", text);
    let root = periplus_xml::parse(file, &sources, &mut Diagnostics::new()).unwrap().root;
    let elements = root.children.iter().filter_map(periplus_xml::XmlNode::as_element);
    let mut world = scene::World::empty("pong");
    world.plugins.push(scene::Plugin {
        name: "gz::sim::systems::TriggeredPublisher".into(),
        filename: "gz-sim-triggered-publisher-system".into(),
        content: elements.cloned().collect(),
        origin: Origin::default(),
    });
    let mut found = Diagnostics::new();
    let devices = world_devices(graph, &world, &[], &mut found);
    (devices, found.iter().map(|finding| finding.message.clone()).collect())
}

struct Bench {
    graph: Graph,
    devices: Vec<Box<dyn Device>>,
    keys: Publisher<Int32>,
    commands: Mailbox<Twist>,
    motion: PhysicsWorld,
    now_ns: i64,
}

impl Bench {
    fn new(inside: &str) -> Self {
        let graph = Graph::new();
        let (devices, found) = devices(&graph, inside);
        assert_eq!(found, Vec::<String>::new());
        let node = graph.node(NodeSettings::new("person")).unwrap();
        let keys = node.publisher("/keyboard/keypress", Qos::reliable(10)).unwrap();
        let commands = node.mailbox("/cmd_vel", Qos::reliable(10)).unwrap();
        let motion = PhysicsWorld::empty(DVec3::ZERO, PhysicsMode::Kinematic);
        Self { graph, devices, keys, commands, motion, now_ns: 0 }
    }

    /// Forward velocities commanded by a key, one millisecond later.
    fn press(&mut self, data: i32) -> Vec<f64> {
        self.keys.publish(Int32 { data });
        self.wait(1)
    }

    fn wait(&mut self, steps: i64) -> Vec<f64> {
        for _ in 0..steps {
            self.now_ns += 1_000_000;
            self.graph.advance_to(self.now_ns);
            let span = StepInterval { start_ns: self.now_ns, length_ns: 1_000_000 };
            for device in &mut self.devices {
                device.act(&mut self.motion, span);
            }
        }
        self.graph.settle();
        self.commands.drain().iter().map(|twist| twist.linear.x).collect()
    }
}

const FORWARD: &str =
    r#"<output type="gz.msgs.Twist" topic="/cmd_vel">linear: {x: 0.5}, angular: {z: 0}</output>"#;

#[test]
fn a_key_becomes_a_velocity() {
    let inside = format!(
        r#"<input type="gz.msgs.Int32" topic="/keyboard/keypress"><match field="data">16777235</match></input>{FORWARD}"#
    );
    let mut bench = Bench::new(&inside);
    assert_eq!(bench.press(16_777_235), [0.5]);
    assert!(bench.press(16_777_237).is_empty());
    assert_eq!(bench.press(16_777_235), [0.5]);
}

#[test]
fn matches_of_all_kinds() {
    let with = |matches: &str| {
        let input = r#"<input type="ignition.msgs.Int32" topic="keyboard/keypress">"#;
        Bench::new(&format!("{input}{matches}</input>{FORWARD}"))
    };
    // Zero is a value like others.
    let mut zero = with(r#"<match field="data">0</match>"#);
    assert_eq!((zero.press(0).len(), zero.press(1).len()), (1, 0));
    let mut others = with(r#"<match field="data" logic_type="negative">7</match>"#);
    assert_eq!((others.press(7).len(), others.press(8).len()), (0, 1));
    let mut near = with(r#"<match field="data" tol="2">10</match>"#);
    assert_eq!((near.press(12).len(), near.press(13).len()), (1, 0));
    let mut whole = with("<match>data: 5</match>");
    assert_eq!((whole.press(5).len(), whole.press(6).len()), (1, 0));
    let mut any = with("");
    assert_eq!(any.press(123).len(), 1);
}

#[test]
fn a_delay_is_simulated_time() {
    let input = r#"<input type="gz.msgs.Int32" topic="/keyboard/keypress"/><delay_ms>3</delay_ms>"#;
    let mut bench = Bench::new(&format!("{input}{FORWARD}"));
    assert!(bench.press(1).is_empty());
    assert!(bench.wait(2).is_empty());
    assert_eq!(bench.wait(1), [0.5]);
}

#[test]
fn slips_are_told() {
    let told = |inside: &str| devices(&Graph::new(), inside).1.join("\n");
    let input = r#"<input type="gz.msgs.Int32" topic="/a">"#;
    assert!(told(FORWARD).contains("no `<input>`"));
    let field = format!(r#"{input}<match field="date">1</match></input>{FORWARD}"#);
    assert!(told(&field).contains("`date` is not a field of std_msgs/msg/Int32"));
    let output =
        format!(r#"{input}</input><output type="gz.msgs.Twist" topic="/c">lin: 3</output>"#);
    assert!(told(&output).contains("does nothing"));
    let unknown = r#"<input type="my.msgs.Int32" topic="/a"/>"#;
    assert!(told(unknown).contains("my.msgs.Int32"));
}
