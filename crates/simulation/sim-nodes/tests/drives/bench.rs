//! A small world in memory with one robot, its devices, and subscribers on the graph.

use std::path::Path;
use std::sync::{Arc, LazyLock};

use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_graph::{Graph, Mailbox, Node, NodeSettings, ParameterFileError, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Twist, Vector3};
use periplus_msgs::{Message, nav_msgs};
use periplus_physics::{ModelId, NoMeshes, PhysicsMode, PhysicsWorld};
use periplus_plugin_specs::{interpret, model_sites};
use periplus_rendering::NoAssets;
use periplus_scene as scene;
use periplus_sdf::{NoIncludes, SdfContext, read_document};
use periplus_sensors::Quirks;
use periplus_sim_nodes::{
    Device, DeviceContext, ParameterFiles, SenseContext, StepInterval, Views, drives,
};

pub(crate) const STEP_NS: i64 = 1_000_000;

/// A base with two wheels of 0.1 m, 0.4 m apart, and a caster ahead; the middle between the wheels
/// is the model's origin.
pub(crate) const ROBOT: &str = r#"
  <link name="base">
    <pose>0.05 0 0.15 0 0 0</pose>
    <inertial><mass>10</mass><inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia></inertial>
  </link>
  <link name="left">
    <pose>0 0.2 0.1 0 0 0</pose>
    <inertial><mass>0.5</mass>
      <inertia><ixx>0.0013</ixx><iyy>0.0025</iyy><izz>0.0013</izz></inertia></inertial>
    <collision name="tyre"><pose>0 0 0 1.5707963267948966 0 0</pose>
      <geometry><cylinder><radius>0.1</radius><length>0.04</length></cylinder></geometry></collision>
  </link>
  <link name="right">
    <pose>0 -0.2 0.1 0 0 0</pose>
    <inertial><mass>0.5</mass>
      <inertia><ixx>0.0013</ixx><iyy>0.0025</iyy><izz>0.0013</izz></inertia></inertial>
    <collision name="tyre"><pose>0 0 0 1.5707963267948966 0 0</pose>
      <geometry><cylinder><radius>0.1</radius><length>0.04</length></cylinder></geometry></collision>
  </link>
  <link name="caster">
    <pose>0.25 0 0.05 0 0 0</pose>
    <inertial><mass>0.5</mass>
      <inertia><ixx>0.0005</ixx><iyy>0.0005</iyy><izz>0.0005</izz></inertia></inertial>
    <collision name="ball"><geometry><sphere><radius>0.05</radius></sphere></geometry>
      <surface><friction><ode><mu>0.001</mu><mu2>0.001</mu2></ode></friction></surface></collision>
  </link>
  <joint name="left_joint" type="revolute"><parent>base</parent><child>left</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="right_joint" type="revolute"><parent>base</parent><child>right</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="caster_joint" type="fixed"><parent>base</parent><child>caster</child></joint>
"#;

/// Parameter files whose path is their text, on one line: `FILE:name: {...}`.
struct InlineFiles;

impl ParameterFiles for InlineFiles {
    fn parameter_text(&self, path: &Path) -> Result<String, ParameterFileError> {
        let path = path.to_str().ok_or(ParameterFileError::NotText)?;
        path.strip_prefix("FILE:").map(str::to_owned).ok_or(ParameterFileError::Missing)
    }
}

static FILES: LazyLock<Arc<dyn ParameterFiles>> = LazyLock::new(|| Arc::new(InlineFiles));

/// The robot at a pose, with plugins.
pub(crate) struct Bench {
    pub(crate) graph: Graph,
    pub(crate) world: PhysicsWorld,
    pub(crate) model: ModelId,
    pub(crate) scene: scene::World,
    /// Findings of building the devices.
    pub(crate) said: String,
    pub(crate) devices: Vec<Box<dyn Device>>,
    views: Views,
    ear: Node,
    now_ns: i64,
}

impl Bench {
    /// The robot with plugins at the origin of a plane, without physics.
    pub(crate) fn exact(plugins: &str) -> Self {
        Self::of(&format!("{ROBOT}{plugins}"), PhysicsMode::Kinematic)
    }

    /// The same with physics.
    pub(crate) fn rigid(plugins: &str) -> Self {
        Self::of(&format!("{ROBOT}{plugins}"), PhysicsMode::Rigid)
    }

    /// A custom model.
    pub(crate) fn of(model: &str, mode: PhysicsMode) -> Self {
        Self::in_world(
            &format!(
                r#"<sdf version="1.9"><world name="hall">
                <model name="ground"><static>true</static><link name="link">
                  <collision name="plane"><geometry><plane><normal>0 0 1</normal></plane></geometry>
                  </collision></link></model>
                <model name="robot">{model}</model></world></sdf>"#
            ),
            mode,
        )
    }

    /// A whole file, whose last model is the robot.
    pub(crate) fn in_world(text: &str, mode: PhysicsMode) -> Self {
        let (mut sources, mut found) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add("robot.sdf", text);
        let document = periplus_xml::parse(file, &sources, &mut found).unwrap();
        let mut context = SdfContext {
            sources: &mut sources,
            diagnostics: &mut found,
            includes: &mut NoIncludes,
        };
        let scene = read_document(&document, &mut context).worlds.remove(0);
        assert!(!found.has_errors(), "{}", said(&sources, &found));
        let (world, found) = PhysicsWorld::new(&scene, mode, &NoMeshes);
        assert!(!found.has_errors(), "{}", said(&sources, &found));
        let model = world.models().last().unwrap().0;
        let graph = Graph::new();
        let mut diagnostics = Diagnostics::new();
        let devices = devices(&graph, &world, &scene, model, &mut diagnostics);
        let said = said(&sources, &diagnostics);
        let ear = graph.node(NodeSettings::new("ear")).unwrap();
        let views = Views::new(Arc::new(NoAssets), 1);
        Self { graph, world, model, scene, said, devices, views, ear, now_ns: 0 }
    }

    pub(crate) fn setting(&self) -> DeviceContext<'_> {
        setting(&self.graph, &self.world, &self.scene, self.model)
    }

    pub(crate) fn hear<T: Message>(&self, topic: &str) -> Mailbox<T> {
        self.ear.mailbox(topic, Qos::best_effort(1000)).unwrap()
    }

    pub(crate) fn say<T: Message>(&self, topic: &str) -> Publisher<T> {
        self.ear.publisher(topic, Qos::reliable(10)).unwrap()
    }

    /// Advances time in steps of 1 ms.
    pub(crate) fn run(&mut self, time_s: f64) {
        self.run_in_steps(time_s, STEP_NS);
    }

    pub(crate) fn run_in_steps(&mut self, time_s: f64, step_ns: i64) {
        let end_ns = self.now_ns + (time_s * 1e9).round() as i64;
        while self.now_ns < end_ns {
            self.graph.settle();
            let span = StepInterval {
                start_ns: self.now_ns,
                length_ns: step_ns.min(end_ns - self.now_ns),
            };
            for device in &mut self.devices {
                device.act(&mut self.world, span);
            }
            self.world.step(span.length_ns).unwrap();
            self.now_ns = span.end_ns();
            self.graph.advance_to(self.now_ns);
            let (world, views) = (&self.world, &self.views);
            let mut moment = SenseContext { span, world, views, threads: 1 };
            for device in &mut self.devices {
                device.sense(&mut moment);
            }
            self.graph.settle();
        }
    }

    pub(crate) fn now_ns(&self) -> i64 {
        self.now_ns
    }

    /// Sets the time back, as before a state of that time is restored.
    pub(crate) fn go_back_to(&mut self, now_ns: i64) {
        self.graph.jump_to(now_ns);
        self.now_ns = now_ns;
    }

    /// Resets the world to its initial state.
    pub(crate) fn reset(&mut self) {
        self.world.reset();
        self.graph.jump_to(0);
        self.now_ns = 0;
        for device in &mut self.devices {
            device.reset(0);
        }
    }

    /// Publishers with their types, QoS and frames.
    pub(crate) fn topics(&self) -> String {
        let mut out = String::new();
        let every_node_has = ["/rosout", "/parameter_events"];
        for topic in self.graph.topics() {
            if every_node_has.contains(&topic.name.as_str()) {
                continue;
            }
            for (arrow, ends) in [("->", &topic.publishers), ("<-", &topic.subscriptions)] {
                for end in ends.iter().filter(|end| end.node != "/ear") {
                    let qos = end.qos;
                    out.push_str(&format!(
                        "{} {arrow} {} {} {} {} {}\n",
                        end.node,
                        topic.name,
                        topic.type_name,
                        qos.reliability,
                        qos.durability,
                        qos.depth
                    ));
                }
            }
        }
        out
    }
}

fn setting<'a>(
    graph: &'a Graph,
    world: &'a PhysicsWorld,
    scene: &'a scene::World,
    model: ModelId,
) -> DeviceContext<'a> {
    let root = scene.models.last().unwrap();
    DeviceContext {
        graph,
        world,
        scene,
        root,
        model,
        model_name: &root.name,
        namespace: "/",
        is_confined: false,
        remaps: &[],
        seed: 7,
        quirks: Quirks::NONE,
        rolling_scans: false,
        start_ns: 0,
        publishes_joint_states: true,
        starts_controllers: true,
        bridges_transforms: true,
        floors: &[],
        parameter_files: &FILES,
    }
}

fn devices(
    graph: &Graph,
    world: &PhysicsWorld,
    scene: &scene::World,
    model: ModelId,
    diagnostics: &mut Diagnostics,
) -> Vec<Box<dyn Device>> {
    let setting = setting(graph, world, scene, model);
    let sites = model_sites(scene, setting.root);
    let built = sites.iter().filter_map(|site| {
        let plugin = interpret(site.plugin, &site.context, diagnostics)?;
        drives::build(&setting, site, &plugin, diagnostics)
    });
    built.collect()
}

/// Findings as printed.
fn said(sources: &SourceMap, found: &Diagnostics) -> String {
    found.iter().map(|finding| render(finding, sources, RenderStyle::Plain) + "\n").collect()
}

pub(crate) fn twist(x: f64, y: f64, yaw: f64) -> Twist {
    let vector = |x, y, z| Vector3 { x, y, z };
    Twist { linear: vector(x, y, 0.0), angular: vector(0.0, 0.0, yaw) }
}

/// Position and yaw of odometry, then its speeds.
pub(crate) fn numbers(odometry: &nav_msgs::Odometry) -> [f64; 6] {
    let (pose, twist) = (&odometry.pose.pose, &odometry.twist.twist);
    let yaw = 2.0 * libm::atan2(pose.orientation.z, pose.orientation.w);
    let position = &pose.position;
    [position.x, position.y, yaw, twist.linear.x, twist.linear.y, twist.angular.z]
}

/// Compares numbers within a tolerance.
#[track_caller]
pub(crate) fn near(found: &[f64], expected: &[f64], error: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} instead of {expected:?}");
    let all = found.iter().zip(expected).all(|(one, other)| (one - other).abs() <= error);
    assert!(all, "{found:?} instead of {expected:?}");
}
