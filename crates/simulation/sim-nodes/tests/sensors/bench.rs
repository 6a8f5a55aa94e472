//! A small world in memory, its devices, and subscribers on the graph.

use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_graph::{Graph, Mailbox, Node, NodeSettings, Qos};
use periplus_msgs::Message;
use periplus_physics::{NoMeshes, PhysicsMode, PhysicsWorld};
use periplus_rendering::NoAssets;
use periplus_sdf::{NoIncludes, SdfContext, read_document};
use periplus_sensors::Quirks;
use periplus_sim_nodes::{
    Device, DeviceContext, NoParameterFiles, ParameterFiles, SenseContext, StepInterval, Views,
    devices,
};

const STEP_NS: i64 = 1_000_000;

/// A world whose last model is the robot.
pub(crate) struct Bench {
    pub(crate) graph: Graph,
    pub(crate) world: PhysicsWorld,
    /// Findings of building the devices.
    pub(crate) said: String,
    devices: Vec<Box<dyn Device>>,
    views: Views,
    ear: Node,
    now_ns: i64,
}

impl Bench {
    /// A hall with a floor, a wall whose face is 3 m ahead, and a box of 2 kg, 0.4 m wide, whose bottom
    /// is on the floor, with this text on its link `base`.
    pub(crate) fn with(on_base: &str) -> Self {
        Self::in_world("", on_base)
    }

    /// The same with more in the world.
    pub(crate) fn in_world(in_world: &str, on_base: &str) -> Self {
        Self::of(in_world, on_base, PhysicsMode::Rigid)
    }

    /// The same without physics: everything stays exactly where it is.
    pub(crate) fn still(in_world: &str, on_base: &str) -> Self {
        Self::of(in_world, on_base, PhysicsMode::Kinematic)
    }

    fn of(in_world: &str, on_base: &str, mode: PhysicsMode) -> Self {
        let text = format!(
            r#"<sdf version="1.9"><world name="hall">{in_world}
            <model name="floor"><static>true</static><link name="link">
              <collision name="plane"><geometry><plane><normal>0 0 1</normal></plane></geometry>
              </collision></link></model>
            <model name="wall"><static>true</static><pose>3.5 0 0 0 0 0</pose><link name="link">
              <collision name="box"><laser_retro>50</laser_retro>
                <geometry><box><size>1 20 20</size></box></geometry></collision>
              <visual name="box"><laser_retro>70</laser_retro>
                <geometry><box><size>1 20 20</size></box></geometry></visual></link></model>
            <model name="robot"><link name="base"><pose>0 0 0.2 0 0 0</pose>
              <inertial><mass>2</mass>
                <inertia><ixx>0.05</ixx><iyy>0.05</iyy><izz>0.05</izz></inertia></inertial>
              <collision name="body"><geometry><box><size>0.4 0.4 0.4</size></box></geometry>
              </collision>{on_base}</link></model></world></sdf>"#
        );
        let (mut sources, mut found) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add("hall.sdf", text.as_str());
        let document = periplus_xml::parse(file, &sources, &mut found).unwrap();
        let mut context = SdfContext {
            sources: &mut sources,
            diagnostics: &mut found,
            includes: &mut NoIncludes,
        };
        let scene = read_document(&document, &mut context).worlds.remove(0);
        let (world, _) = PhysicsWorld::new(&scene, mode, &NoMeshes);
        let graph = Graph::new();
        let mut views = Views::new(Arc::new(NoAssets), 1);
        for (model, (id, _)) in scene.models.iter().zip(world.models()) {
            views.add(Arc::new(model.clone()), id, &world);
        }
        let (model, name) = world.models().last().unwrap();
        let files: Arc<dyn ParameterFiles> = Arc::new(NoParameterFiles);
        let setting = DeviceContext {
            graph: &graph,
            world: &world,
            scene: &scene,
            root: scene.models.last().unwrap(),
            model,
            model_name: name,
            namespace: "/",
            is_confined: false,
            remaps: &[],
            seed: 1,
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
        let devices = devices(&setting, None, &mut diagnostics);
        let said = diagnostics.iter().map(|it| render(it, &sources, RenderStyle::Plain)).collect();
        let ear = graph.node(NodeSettings::new("ear")).unwrap();
        Self { graph, world, said, devices, views, ear, now_ns: 0 }
    }

    pub(crate) fn hear<T: Message>(&self, topic: &str) -> Mailbox<T> {
        self.ear.mailbox(topic, Qos::best_effort(1000)).unwrap()
    }

    /// Topics, each with its type, its publisher, and its quality of service.
    pub(crate) fn topics(&self) -> Vec<String> {
        self.graph
            .topics()
            .iter()
            .filter(|topic| !["/rosout", "/parameter_events"].contains(&topic.name.as_str()))
            .map(|topic| format!("{} {}", topic.name, topic.type_name))
            .collect()
    }

    /// Advances time in steps of 1 ms.
    pub(crate) fn run(&mut self, time_s: f64) {
        let end_ns = self.now_ns + (time_s * 1e9).round() as i64;
        while self.now_ns < end_ns {
            let span = StepInterval { start_ns: self.now_ns, length_ns: STEP_NS };
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
        }
    }

    pub(crate) fn reset(&mut self) {
        self.world.reset();
        self.now_ns = 0;
        for device in &mut self.devices {
            device.reset(0);
        }
    }
}
