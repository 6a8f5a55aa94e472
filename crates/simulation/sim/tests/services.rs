//! The services of a world, called as by a node of a user.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::path::Path;
use std::sync::Arc;

use periplus_graph::{Mailbox, Node, NodeSettings, Qos};
use periplus_loader::LoadContext;
use periplus_msgs::builtin_interfaces::{Duration, Time};
use periplus_msgs::gazebo_msgs::*;
use periplus_msgs::geometry_msgs::{Point, Pose, Quaternion, Twist, Vector3, Wrench};
use periplus_msgs::ros_gz_interfaces::{
    self, ControlWorld, ControlWorldRequest, EntityFactory, SetEntityPose, SetEntityPoseRequest,
    WorldControl, WorldReset, WorldStatistics,
};
use periplus_msgs::sensor_msgs::{Image, LaserScan};
use periplus_msgs::std_srvs::{Empty, EmptyRequest, Trigger, TriggerRequest};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::visualization_msgs::{Marker, MarkerArray};
use periplus_msgs::{Encapsulation, Format, Message, Service, encode};
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{AssetFiles, Options, Search, Services, Simulation, compose};

/// A ground plane, a ball that falls, and a lidar at a height of 1 m that looks along x.
const LAB: &str = r#"<sdf version="1.9"><world name="lab">
  <physics name="p" type="ode"><max_step_size>0.01</max_step_size></physics>
  <plugin name="states" filename="libgazebo_ros_state.so">
    <ros><namespace>/demo</namespace><remapping>model_states:=poses</remapping></ros>
    <update_rate>10</update_rate>
  </plugin>
  <light name="sun" type="directional"><diffuse>0.5 0.5 0.5 1</diffuse></light>
  <model name="ground"><static>true</static><link name="link">
    <collision name="c"><geometry><plane><size>20 20</size></plane></geometry></collision>
  </link></model>
  <model name="ball"><pose>0 5 4 0 0 0</pose><link name="body">
    <inertial><mass>2</mass></inertial>
    <collision name="c"><geometry><sphere><radius>0.5</radius></sphere></geometry></collision>
    <visual name="v"><geometry><sphere><radius>0.5</radius></sphere></geometry></visual>
  </link></model>
  <model name="eye"><static>true</static><pose>0 0 1 0 0 0</pose><link name="head">
    <sensor name="lidar" type="gpu_lidar"><topic>scan</topic><update_rate>10</update_rate>
      <lidar>
        <scan><horizontal>
          <samples>3</samples><min_angle>-0.1</min_angle><max_angle>0.1</max_angle>
        </horizontal></scan>
        <range><min>0.1</min><max>10</max></range>
        NOISE
      </lidar>
    </sensor>
  </link></model>
</world></sdf>"#;

const BOX: &str = r#"<sdf version="1.9"><model name="box"><static>true</static><link name="link">
  <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
  <visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual>
</link></model></sdf>"#;

const NOISE: &str = "<noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise>";

struct Lab {
    simulation: Simulation,
    services: Services,
    node: Node,
    scans: Mailbox<LaserScan>,
}

impl Lab {
    fn new() -> Self {
        Self::with("")
    }

    fn with(noise: &str) -> Self {
        let host = MemoryHost::new().with_file("/lab.sdf", LAB.replace("NOISE", noise));
        let resolver = Resolver::new(&host, &[]);
        let setting = LoadContext {
            host: &host,
            resolver: &resolver,
            working_folder: "/".into(),
            arguments: Vec::new(),
            open_meshes: true,
        };
        let mut composition = compose(Path::new("/lab.sdf"), &[], &setting);
        let files = Arc::new(AssetFiles::default());
        let simulation = Simulation::new(&mut composition, files, Options::default());
        assert!(!composition.has_errors(), "{:?}", composition.files[0].diagnostics);
        let services = Services::new(&simulation, Search::default()).unwrap();
        let node = simulation.graph().node(NodeSettings::new("user")).unwrap();
        let scans = node.mailbox("/scan", Qos::sensor_data()).unwrap();
        Self { simulation, services, node, scans }
    }

    fn call<S: Service>(&mut self, name: &str, request: S::Request) -> Arc<S::Response> {
        let answer = self.node.client::<S>(name).unwrap().call(request);
        self.services.serve(&mut self.simulation);
        answer.take().expect("an answer").unwrap_or_else(|error| panic!("{error}"))
    }

    /// Runs this number of steps, or as many as possible.
    fn run(&mut self, steps: u32) {
        for _ in 0..steps {
            self.services.serve(&mut self.simulation);
            if self.services.may_step() {
                self.simulation.step_until(self.services.until_ns()).unwrap();
            }
        }
    }

    fn ms(&self) -> i64 {
        self.simulation.time_ns() / 1_000_000
    }

    /// Returns the range of the middle beam in the next scan [m].
    fn ahead(&mut self) -> f32 {
        let _ = self.scans.drain();
        self.run(12);
        self.scans.latest().expect("a scan").ranges[1]
    }

    fn spawn(&mut self, name: &str, xml: &str, frame: &str, at: [f64; 3]) -> (bool, String) {
        let request = SpawnEntityRequest {
            name: name.into(),
            xml: xml.into(),
            initial_pose: pose(at),
            reference_frame: frame.into(),
            ..Default::default()
        };
        let answer = self.call::<SpawnEntity>("/spawn_entity", request);
        (answer.success, answer.status_message.clone())
    }

    fn control(&mut self, world_control: WorldControl) {
        let answer =
            self.call::<ControlWorld>("/world/lab/control", ControlWorldRequest { world_control });
        assert!(answer.success);
    }

    fn where_is(&mut self, name: &str, frame: &str) -> Option<[f64; 3]> {
        let request = GetEntityStateRequest { name: name.into(), reference_frame: frame.into() };
        let answer = self.call::<GetEntityState>("/get_entity_state", request);
        let Point { x, y, z } = answer.state.pose.position;
        answer.success.then_some([x, y, z])
    }
}

fn pose([x, y, z]: [f64; 3]) -> Pose {
    let orientation = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };
    Pose { position: Point { x, y, z }, orientation }
}

#[test]
fn a_box_in_the_way_of_a_lidar_comes_and_goes() {
    let mut lab = Lab::new();
    assert_eq!(lab.ahead(), f32::INFINITY);
    let (success, message) = lab.spawn("wall", BOX, "", [3.0, 0.0, 1.0]);
    assert!(success, "{message}");
    assert_eq!(message, "SpawnEntity: Successfully spawned entity [wall]");
    assert_eq!(lab.ahead(), 2.5);
    let listed = lab.call::<GetModelList>("/get_model_list", Default::default());
    assert_eq!(listed.model_names, ["ground", "ball", "eye", "wall"]);
    let gone =
        lab.call::<DeleteEntity>("/delete_entity", DeleteEntityRequest { name: "wall".into() });
    assert!(gone.success, "{}", gone.status_message);
    assert_eq!(lab.ahead(), f32::INFINITY);
}

#[test]
fn a_robot_comes_as_urdf_into_a_frame_and_a_namespace() {
    let mut lab = Lab::new();
    let urdf = r#"<robot name="dot"><link name="base">
        <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
        <visual><geometry><box size="1 1 1"/></geometry></visual>
    </link></robot>"#;
    let request = SpawnModelRequest {
        model_xml: urdf.into(),
        model_namespace: "/left".into(),
        initial_pose: pose([4.0, 0.0, 0.0]),
        reference_frame: "eye::head".into(),
        ..Default::default()
    };
    let came = lab.call::<SpawnModel>("/gazebo/spawn_urdf_model", request);
    assert!(came.success, "{}", came.status_message);
    assert_eq!(lab.where_is("dot", "eye"), Some([4.0, 0.0, 0.0]));
    let nodes = lab.simulation.graph().nodes();
    let ours = nodes.iter().filter(|node| node.name.starts_with("/left/")).count();
    assert!(ours > 0, "{nodes:?}");
}

#[test]
fn time_stands_still_in_a_pause_and_goes_by_steps() {
    let mut lab = Lab::new();
    lab.run(5);
    assert_eq!(lab.ms(), 50);
    lab.call::<Empty>("/pause_physics", EmptyRequest::default());
    lab.run(5);
    assert_eq!(lab.ms(), 50);
    lab.control(WorldControl { pause: true, multi_step: 10, ..Default::default() });
    lab.run(30);
    assert_eq!(lab.ms(), 150);
    lab.control(WorldControl { pause: true, step: true, ..Default::default() });
    lab.run(30);
    assert_eq!(lab.ms(), 160);
    let run_to_sim_time = Time { sec: 0, nanosec: 200_000_000 };
    lab.control(WorldControl { run_to_sim_time, ..Default::default() });
    lab.run(30);
    assert_eq!(lab.ms(), 200);
    lab.call::<Empty>("/gazebo/unpause_physics", EmptyRequest::default());
    lab.run(5);
    assert_eq!(lab.ms(), 250);
}

/// All scans and poses of half a second, as bytes.
fn recorded(lab: &mut Lab) -> Vec<Vec<u8>> {
    fn bytes<T: Message>(messages: Vec<Arc<T>>) -> Vec<Vec<u8>> {
        let encoded = messages.iter().map(|message| {
            let mut bytes = Vec::new();
            encode(&**message, Format::Cdr(Encapsulation::LittleEndian), &mut bytes).unwrap();
            bytes
        });
        encoded.collect()
    }
    let scans = lab.node.mailbox::<LaserScan>("/scan", Qos::best_effort(100)).unwrap();
    let poses = lab.node.mailbox::<ModelStates>("/demo/poses", Qos::reliable(100)).unwrap();
    lab.run(50);
    let (mut scans, poses) = (bytes(scans.drain()), bytes(poses.drain()));
    assert!(scans.len() >= 4 && poses.len() >= 4, "{} {}", scans.len(), poses.len());
    scans.extend(poses);
    scans
}

#[test]
fn a_run_after_a_reset_is_the_same_run() {
    let mut lab = Lab::with(NOISE);
    assert!(lab.spawn("wall", BOX, "", [3.0, 0.0, 1.0]).0);
    let first = recorded(&mut lab);
    let [_, _, z] = lab.where_is("ball", "").unwrap();
    // 4 m - g t²/2 after half a second.
    assert!((z - (4.0 - 9.8 / 8.0)).abs() < 0.05, "{z}");
    lab.call::<Empty>("/reset_simulation", EmptyRequest::default());
    assert_eq!(lab.ms(), 0);
    assert_eq!(lab.where_is("ball", ""), Some([0.0, 5.0, 4.0]));
    assert!(recorded(&mut lab) == first);
    let reset = WorldReset { all: true, ..Default::default() };
    lab.control(WorldControl { reset: reset.clone(), seed: 7, ..Default::default() });
    let other = recorded(&mut lab);
    assert!(other != first, "another seed is other noise");
    lab.control(WorldControl { reset, ..Default::default() });
    assert!(recorded(&mut lab) == other);
}

/// A reset with another seed builds the sensors again; a restore does too, with the first seed.
#[test]
fn a_restore_brings_the_seed_back() {
    let mut lab = Lab::with(NOISE);
    assert!(lab.spawn("wall", BOX, "", [3.0, 0.0, 1.0]).0);
    lab.run(7);
    let (world, services) = (lab.simulation.snapshot(), lab.services.snapshot());
    let first = recorded(&mut lab);
    let reset = WorldReset { all: true, ..Default::default() };
    lab.control(WorldControl { reset, seed: 7, ..Default::default() });
    lab.run(7);
    for _ in 0..2 {
        assert!(recorded(&mut lab) != first);
        lab.simulation.restore(&world).unwrap();
        lab.services.restore(&services);
        assert!(recorded(&mut lab) == first);
    }
}

#[test]
fn models_go_back_without_time() {
    let mut lab = Lab::new();
    lab.run(20);
    lab.call::<Empty>("/reset_world", EmptyRequest::default());
    assert_eq!((lab.ms(), lab.where_is("ball", "")), (200, Some([0.0, 5.0, 4.0])));
    let reset = WorldReset { time_only: true, ..Default::default() };
    lab.run(20);
    let [_, _, z] = lab.where_is("ball", "").unwrap();
    lab.control(WorldControl { pause: true, reset, ..Default::default() });
    assert_eq!((lab.ms(), lab.where_is("ball", "")), (0, Some([0.0, 5.0, z])));
}

#[test]
fn things_are_put_where_they_are_wanted() {
    let mut lab = Lab::new();
    let state = EntityState {
        name: "ball".into(),
        pose: pose([2.0, 0.0, 0.0]),
        twist: Twist { linear: Vector3 { x: 0.0, y: 0.0, z: 3.0 }, ..Default::default() },
        reference_frame: "eye".into(),
    };
    let request = SetEntityStateRequest { state };
    assert!(lab.call::<SetEntityState>("/demo/set_entity_state", request).success);
    assert_eq!(lab.where_is("ball", ""), Some([2.0, 0.0, 1.0]));
    assert_eq!(lab.where_is("ball::body", "eye::head"), Some([2.0, 0.0, 0.0]));
    lab.run(1);
    let [_, _, z] = lab.where_is("ball", "").unwrap();
    assert!((z - 1.03).abs() < 2e-3, "{z}");
    let entity = ros_gz_interfaces::Entity { name: "ball".into(), ..Default::default() };
    let request = SetEntityPoseRequest { entity, pose: pose([4.0, 0.0, 1.0]) };
    assert!(lab.call::<SetEntityPose>("/world/lab/set_pose", request).success);
    assert_eq!(lab.where_is("ball", ""), Some([4.0, 0.0, 1.0]));
    lab.call::<SetPhysicsProperties>("/set_physics_properties", physics([0.0; 3], 0.01));
    assert_eq!(lab.ahead(), 3.5);
}

fn physics([x, y, z]: [f64; 3], time_step: f64) -> SetPhysicsPropertiesRequest {
    SetPhysicsPropertiesRequest {
        time_step,
        max_update_rate: 0.0,
        gravity: Vector3 { x, y, z },
        ode_config: ODEPhysics::default(),
    }
}

#[test]
fn gravity_and_step_are_what_was_asked_for() {
    let mut lab = Lab::new();
    let name = "/world/lab/set_physics";
    let done = lab.call::<SetPhysicsProperties>(name, physics([0.0; 3], 0.002));
    assert!(done.success, "{}", done.status_message);
    lab.run(10);
    assert_eq!((lab.ms(), lab.where_is("ball", "")), (20, Some([0.0, 5.0, 4.0])));
    let known = lab.call::<GetPhysicsProperties>("/get_physics_properties", Default::default());
    assert_eq!((known.time_step, known.gravity.z, known.max_update_rate), (0.002, 0.0, 0.0));
    assert_eq!(lab.services.take_factor(), Some(None));
}

#[test]
fn a_push_moves_a_ball() {
    let mut lab = Lab::new();
    lab.call::<SetPhysicsProperties>("/set_physics_properties", physics([0.0; 3], 0.01));
    let request = ApplyLinkWrenchRequest {
        link_name: "ball::body".into(),
        wrench: Wrench { force: Vector3 { x: 4.0, y: 0.0, z: 0.0 }, torque: Vector3::default() },
        duration: Duration { sec: 0, nanosec: 500_000_000 },
        ..Default::default()
    };
    let done = lab.call::<ApplyLinkWrench>("/apply_link_wrench", request);
    assert!(done.success, "{}", done.status_message);
    lab.run(100);
    // 4 N on 2 kg for half a second is 1 m/s.
    let request = GetModelStateRequest { model_name: "ball".into(), ..Default::default() };
    let state = lab.call::<GetModelState>("/gazebo/get_model_state", request);
    assert!((state.twist.linear.x - 1.0).abs() < 0.02, "{:?}", state.twist);
}

/// 4 N on 2 kg for half a second; the snapshot is after the first tenth.
#[test]
fn a_force_goes_on_after_a_restore() {
    let mut lab = Lab::new();
    let request = ApplyLinkWrenchRequest {
        link_name: "ball::body".into(),
        wrench: Wrench { force: Vector3 { x: 4.0, y: 0.0, z: 0.0 }, torque: Vector3::default() },
        duration: Duration { sec: 0, nanosec: 500_000_000 },
        ..Default::default()
    };
    assert!(lab.call::<ApplyLinkWrench>("/apply_link_wrench", request).success);
    lab.run(10);
    let (world, services) = (lab.simulation.snapshot(), lab.services.snapshot());
    lab.run(100);
    let expected = lab.where_is("ball", "");
    lab.simulation.restore(&world).unwrap();
    lab.services.restore(&services);
    lab.run(100);
    assert_eq!(lab.where_is("ball", ""), expected);
}

#[test]
fn lights_are_known_and_set() {
    let mut lab = Lab::new();
    let request = SetLightPropertiesRequest {
        light_name: "sun".into(),
        diffuse: periplus_msgs::std_msgs::ColorRGBA { r: 1.0, g: 0.0, b: 0.0, a: 1.0 },
        attenuation_constant: 1.0,
        ..Default::default()
    };
    assert!(lab.call::<SetLightProperties>("/set_light_properties", request).success);
    assert_eq!(lab.simulation.lights()[0].1.diffuse.0, [1.0, 0.0, 0.0, 1.0]);
    let lamp = r#"<sdf version="1.9"><light name="lamp" type="point"><pose>0 0 3 0 0 0</pose>
        </light></sdf>"#;
    assert!(lab.spawn("", lamp, "", [1.0, 0.0, 0.0]).0);
    let lights = lab.simulation.lights();
    assert_eq!(lights[1].0.translation.to_array(), [1.0, 0.0, 3.0]);
    let request = DeleteLightRequest { light_name: "lamp".into() };
    assert!(lab.call::<DeleteLight>("/gazebo/delete_light", request).success);
    assert_eq!(lab.simulation.lights().len(), 1);
}

/// The brightness of the middle of the next picture.
fn picture(lab: &mut Lab, pictures: &Mailbox<Image>) -> u8 {
    let _ = pictures.drain();
    lab.run(12);
    let image = pictures.latest().expect("a picture");
    image.data[image.data.len() / 2 + 13]
}

#[test]
fn the_next_picture_shows_the_light() {
    let camera = r#"<sdf version="1.9"><model name="camera"><static>true</static><link name="head">
        <light name="torch" type="point"><diffuse>0.8 0.8 0.8 1</diffuse>
          <attenuation><range>20</range><constant>1</constant></attenuation></light>
        <sensor name="s" type="camera"><topic>picture</topic><update_rate>10</update_rate>
          <camera><horizontal_fov>0.3</horizontal_fov>
            <image><width>8</width><height>8</height></image>
            <clip><near>0.1</near><far>20</far></clip></camera></sensor>
      </link></model></sdf>"#;
    let mut lab = Lab::new();
    assert!(lab.spawn("", camera, "", [0.0, 0.0, 1.0]).0);
    assert!(lab.spawn("wall", BOX, "", [3.0, 0.0, 1.0]).0);
    let pictures = lab.node.mailbox::<Image>("/picture", Qos::reliable(5)).unwrap();
    let lit = picture(&mut lab, &pictures);
    let request = SetLightPropertiesRequest {
        light_name: "camera::head::torch".into(),
        attenuation_constant: 1.0,
        ..Default::default()
    };
    let done = lab.call::<SetLightProperties>("/set_light_properties", request);
    assert!(done.success, "{}", done.status_message);
    let dark = picture(&mut lab, &pictures);
    assert!(dark < lit, "{dark} < {lit}");
    let lamp = r#"<sdf version="1.9"><light name="lamp" type="point">
        <diffuse>0.8 0.8 0.8 1</diffuse>
        <attenuation><range>20</range><constant>1</constant></attenuation></light></sdf>"#;
    assert!(lab.spawn("", lamp, "", [0.0, 0.0, 1.0]).0);
    assert_eq!(picture(&mut lab, &pictures), lit);
    let request = DeleteEntityRequest { name: "lamp".into() };
    assert!(lab.call::<DeleteEntity>("/delete_entity", request).success);
    assert_eq!(picture(&mut lab, &pictures), dark);
}

#[test]
fn harmonic_makes_copies_and_finds_names() {
    let mut lab = Lab::new();
    let create = |lab: &mut Lab, entity_factory: EntityFactory| {
        let request = ros_gz_interfaces::SpawnEntityRequest { entity_factory };
        lab.call::<ros_gz_interfaces::SpawnEntity>("/world/lab/create", request).success
    };
    let pose = pose([3.0, 0.0, 1.0]);
    let boxes = |allow_renaming| EntityFactory {
        sdf: BOX.into(),
        pose: pose.clone(),
        name: "box".into(),
        allow_renaming,
        ..Default::default()
    };
    assert!(create(&mut lab, boxes(false)));
    assert!(!create(&mut lab, boxes(false)));
    assert!(create(&mut lab, boxes(true)));
    let copy = EntityFactory { clone_name: "ball".into(), name: "twin".into(), ..boxes(false) };
    assert!(!create(&mut lab, copy.clone()), "both a text and a copy");
    assert!(create(&mut lab, EntityFactory { sdf: String::new(), ..copy }));
    let models: Vec<&str> = lab.simulation.models().collect();
    assert_eq!(models, ["ground", "ball", "eye", "box", "box_0", "twin"]);
    let findings = lab.services.take_findings();
    let told: Vec<&str> = findings.iter().map(|finding| finding.message.as_str()).collect();
    assert_eq!(
        told,
        [
            "`create` was refused: `box` exists already; delete it, or use another name",
            "`create` was refused: set exactly one of `sdf`, `sdf_filename` and `clone_name`",
        ]
    );
}

#[test]
fn calls_that_fail_teach() {
    let mut lab = Lab::new();
    let mut refused = |xml: &str, name: &str, frame: &str| {
        let (success, message) = lab.spawn(name, xml, frame, [0.0; 3]);
        assert!(!success);
        message
    };
    let broken = refused("<sdf version='1.9'>\n  <model name='a'>\n  </modle>\n</sdf>", "a", "");
    assert!(broken.contains("spawned.xml:3"), "{broken}");
    assert!(refused("", "a", "").contains("the text is empty"));
    let plain = refused("<sdf version='1.9'/>", "a", "");
    assert!(plain.contains("holds no world, model, light"), "{plain}");
    let taken = refused(BOX, "ball", "");
    assert!(taken.contains("`ball` exists already"), "{taken}");
    let frame = refused(BOX, "a", "bal");
    assert!(frame.contains("did you mean `ball`?") && frame.contains("eye"), "{frame}");
    let gone =
        lab.call::<DeleteEntity>("/delete_entity", DeleteEntityRequest { name: "bal".into() });
    assert!(gone.status_message.contains("did you mean `ball`?"), "{}", gone.status_message);
    let step = lab.call::<SetPhysicsProperties>("/set_physics_properties", physics([0.0; 3], 0.0));
    assert!(!step.success && step.status_message.contains("time_step"));
    let mass = SetLinkPropertiesRequest { link_name: "ball::body".into(), ..Default::default() };
    let mass = lab.call::<SetLinkProperties>("/set_link_properties", mass);
    assert!(!mass.success && mass.status_message.contains("spawn"), "{}", mass.status_message);
    assert_eq!(lab.where_is("nobody", ""), None);
}

#[test]
fn properties_are_those_of_the_file() {
    let mut lab = Lab::new();
    let request = GetModelPropertiesRequest { model_name: "ball".into() };
    let ball = lab.call::<GetModelProperties>("/get_model_properties", request);
    assert_eq!(
        (ball.body_names.as_slice(), ball.is_static),
        (&["ball::body".to_owned()][..], false)
    );
    let request = GetLinkPropertiesRequest { link_name: "ball::body".into() };
    let body = lab.call::<GetLinkProperties>("/gazebo/get_link_properties", request);
    assert_eq!((body.success, body.mass, body.gravity_mode), (true, 2.0, true));
}

#[test]
fn states_without_a_plugin_are_there_for_who_subscribes() {
    let mut lab = Lab::new();
    lab.run(20);
    let names = |lab: &Lab| -> Vec<String> {
        lab.simulation.graph().topics().into_iter().map(|topic| topic.name).collect()
    };
    assert!(!names(&lab).contains(&"/gazebo/link_states".to_owned()));
    let states = lab.node.mailbox::<LinkStates>("/gazebo/link_states", Qos::reliable(100)).unwrap();
    lab.run(30);
    let heard = states.drain();
    assert!(heard.len() >= 15, "{}", heard.len());
    assert_eq!(heard[0].name, ["ground::link", "ball::body", "eye::head"]);
}

#[test]
fn how_fast_it_goes_is_told_to_who_subscribes() {
    let mut lab = Lab::new();
    let classic =
        lab.node.mailbox::<PerformanceMetrics>("/performance_metrics", Qos::reliable(10)).unwrap();
    let harmonic =
        lab.node.mailbox::<WorldStatistics>("/world/lab/stats", Qos::reliable(10)).unwrap();
    std::thread::sleep(std::time::Duration::from_millis(110));
    lab.run(1);
    std::thread::sleep(std::time::Duration::from_millis(110));
    lab.run(2);
    let stats = harmonic.latest().expect("statistics");
    assert_eq!((stats.model_count, stats.paused), (3, false));
    let factor = classic.latest().expect("metrics").real_time_factor;
    assert!(factor > 0.0 && factor < 1.0, "one step of 10 ms in 110 ms is {factor}");
}

#[test]
fn who_draws_the_world_is_told_what_is_in_it_and_where() {
    let mut lab = Lab::new();
    let nothing = lab.simulation.graph().topics();
    assert!(nothing.iter().all(|topic| !topic.name.ends_with("/scene")), "nobody asked for it");
    lab.services.show(&lab.simulation, Vec::new()).unwrap();
    let scenes = lab.node.mailbox::<MarkerArray>("/world/lab/scene", Qos::latched(1)).unwrap();
    let poses = lab.node.mailbox::<TFMessage>("/world/lab/poses", Qos::best_effort(1)).unwrap();
    lab.run(2);
    let drawn = scenes.latest().expect("a scene");
    let [all, ball] = drawn.markers.as_slice() else { panic!("{:?}", drawn.markers) };
    assert_eq!(all.action, Marker::DELETEALL);
    assert_eq!((ball.ns.as_str(), ball.r#type), ("ball", Marker::SPHERE));
    assert_eq!((ball.header.frame_id.as_str(), ball.scale.x), ("ball/body", 1.0));
    let told = poses.latest().expect("where things are");
    let place = |name: &str| {
        let one = told.transforms.iter().find(|one| one.child_frame_id == name).expect("a frame");
        assert_eq!(one.header.frame_id, "world");
        one.transform.translation.clone()
    };
    assert!((place("eye").z - 1.0).abs() < 1e-9 && (place("eye/head").z - 1.0).abs() < 1e-9);
    assert!((place("ball/body").y - 5.0).abs() < 1e-9);

    assert!(lab.spawn("box", BOX, "", [1.0, 2.0, 0.5]).0);
    lab.run(1);
    let drawn = scenes.latest().expect("a new scene");
    assert!(drawn.markers.iter().any(|one| one.ns == "box" && one.r#type == Marker::CUBE));
    assert!(scenes.latest().is_none(), "nothing has come or gone since");
}

#[test]
fn poses_of_sensors_are_told_by_topic_and_by_frame() {
    let mut lab = Lab::new();
    lab.services.show(&lab.simulation, Vec::new()).unwrap();
    let sensors = lab.node.mailbox::<TFMessage>("/world/lab/sensors", Qos::latched(1)).unwrap();
    lab.run(1);
    let told = sensors.latest().expect("sensors");
    let names: Vec<(&str, &str)> = told
        .transforms
        .iter()
        .map(|one| (one.header.frame_id.as_str(), one.child_frame_id.as_str()))
        .collect();
    let of = "eye/head";
    assert_eq!(names, [(of, "/scan"), (of, "head"), (of, "/scan/points")]);
    // Another one comes, half a metre ahead of its link.
    let posed = "<sensor name=\"nose\" type=\"lidar\"><pose>0.5 0 0 0 0 0</pose><topic>nose</topic>\
        <gz_frame_id>nose_frame</gz_frame_id><lidar><scan><horizontal><samples>2</samples>\
        <min_angle>0</min_angle><max_angle>1</max_angle></horizontal></scan>\
        <range><min>0.1</min><max>9</max></range></lidar></sensor></link>";
    assert!(lab.spawn("box", &BOX.replace("</link>", posed), "", [1.0, 2.0, 0.5]).0);
    lab.run(1);
    let told = sensors.latest().expect("more sensors");
    for name in ["/nose", "nose_frame"] {
        let one = told.transforms.iter().find(|one| one.child_frame_id == name).expect(name);
        assert_eq!(one.header.frame_id, "box/link");
        assert_eq!(one.transform.translation.x, 0.5);
    }
}

#[test]
fn statistics_are_among_the_topics_of_a_world_that_is_shown() {
    let mut lab = Lab::new();
    let has_stats = |lab: &Lab| {
        let mut topics = lab.simulation.graph().topics().into_iter();
        topics.any(|topic| topic.name == "/world/lab/stats" && !topic.publishers.is_empty())
    };
    assert!(!has_stats(&lab));
    lab.services.show(&lab.simulation, Vec::new()).unwrap();
    assert!(has_stats(&lab));
    let stats = lab.node.mailbox::<WorldStatistics>("/world/lab/stats", Qos::reliable(10)).unwrap();
    lab.services.set_paused(true);
    std::thread::sleep(std::time::Duration::from_millis(110));
    lab.run(1);
    assert!(stats.latest().expect("statistics").paused);
    drop(stats);
    std::thread::sleep(std::time::Duration::from_millis(110));
    lab.run(1);
    assert!(has_stats(&lab), "it stays when nobody subscribes");
}

#[test]
fn who_subscribes_while_time_stands_still_gets_one_measurement() {
    let mut lab = Lab::new();
    lab.services.show(&lab.simulation, Vec::new()).unwrap();
    lab.scans = lab.node.mailbox("/unused", Qos::sensor_data()).unwrap();
    lab.run(25);
    lab.services.set_paused(true);
    lab.run(3);
    let late = lab.node.mailbox::<LaserScan>("/scan", Qos::sensor_data()).unwrap();
    lab.run(3);
    let scans = late.drain();
    assert_eq!(scans.len(), 1, "one, not one for each look");
    assert_eq!(scans[0].header.stamp.ns(), lab.simulation.time_ns());
    // A second subscriber gets the same measurement: the first one gets no second message.
    let _other = lab.node.mailbox::<LaserScan>("/scan", Qos::sensor_data()).unwrap();
    lab.run(3);
    assert!(late.drain().is_empty());
    lab.services.set_paused(false);
    lab.run(20);
    assert_eq!(late.drain().len(), 2, "it goes on at its rate");
}

#[test]
fn a_world_that_is_saved_can_be_loaded_again() {
    let mut lab = Lab::new();
    lab.services.show(&lab.simulation, Vec::new()).unwrap();
    assert!(lab.spawn("box", BOX, "", [1.0, 2.0, 0.5]).0);
    let saved = lab.call::<Trigger>("/world/lab/save", TriggerRequest::default());
    assert!(saved.success, "{}", saved.message);
    let host = MemoryHost::new().with_file("/saved.sdf", saved.message.clone());
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: "/".into(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    let again = compose(Path::new("/saved.sdf"), &[], &setting);
    assert!(!again.has_errors(), "{:?}", again.files[0].diagnostics);
    let names: Vec<&str> = again.members.iter().map(|member| member.name.as_str()).collect();
    assert_eq!(names, ["ground", "ball", "eye", "box"]);
    let at = again.members[3].world_from_model.translation;
    assert!((at.x - 1.0).abs() < 1e-9 && (at.y - 2.0).abs() < 1e-9 && (at.z - 0.5).abs() < 1e-9);
    let listed = lab.call::<Trigger>("/world/lab/library", TriggerRequest::default());
    assert!(listed.message.starts_with("{\"models\":["), "{}", listed.message);
}

/// A ball of a mass [kg].
fn ball_of(mass_kg: f64) -> String {
    format!(
        "<sdf version='1.9'><model name='rock'><link name='link'><inertial><mass>{mass_kg:e}</mass>\
         </inertial><collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry>\
         </collision></link></model></sdf>"
    )
}

#[test]
fn absurd_numbers_are_refused_with_the_limit() {
    let mut lab = Lab::new();
    let (success, message) = lab.spawn("rock", &ball_of(1e308), "", [0.0; 3]);
    assert!(!success && message.contains("beyond 1e12 kg"), "{message}");
    let (success, message) = lab.spawn("box", BOX, "", [1e308, 0.0, 0.0]);
    assert!(!success && message.contains("beyond 1e7 m"), "{message}");
    let set = |lab: &mut Lab, gravity, time_step| {
        let name = "/set_physics_properties";
        let done = lab.call::<SetPhysicsProperties>(name, physics(gravity, time_step));
        assert!(!done.success);
        done.status_message.clone()
    };
    assert!(set(&mut lab, [0.0, 0.0, 1e308], 0.01).contains("beyond 10000 m/s²"));
    assert!(set(&mut lab, [0.0; 3], 1e-300).contains("0.000001 s to 1 s"));
    for (at, speed) in [([1e308, 0.0, 0.0], 0.0), ([0.0; 3], 1e308)] {
        let model_state = ModelState {
            model_name: "ball".into(),
            pose: pose(at),
            twist: Twist { linear: Vector3 { x: speed, y: 0.0, z: 0.0 }, ..Default::default() },
            reference_frame: String::new(),
        };
        let request = SetModelStateRequest { model_state };
        let done = lab.call::<SetModelState>("/gazebo/set_model_state", request);
        assert!(!done.success && done.status_message.contains("beyond"), "{}", done.status_message);
    }
    let request = ApplyLinkWrenchRequest {
        link_name: "ball::body".into(),
        wrench: Wrench { force: Vector3 { x: 1e308, y: 0.0, z: 0.0 }, torque: Vector3::default() },
        duration: Duration { sec: 1, nanosec: 0 },
        ..Default::default()
    };
    let done = lab.call::<ApplyLinkWrench>("/apply_link_wrench", request);
    assert!(!done.success && done.status_message.contains("beyond 1e15 N"));
    lab.run(100);
    assert!(lab.simulation.diverged().is_empty());
    assert_eq!(lab.where_is("ball", "").map(|[x, y, _]| [x, y]), Some([0.0, 5.0]));
}

#[test]
fn a_diverging_model_is_removed_and_the_world_goes_on() {
    let mut lab = Lab::new();
    assert!(lab.spawn("rock", &ball_of(1e-3), "", [5.0, 5.0, 1.0]).0);
    let request = ApplyLinkWrenchRequest {
        link_name: "rock::link".into(),
        wrench: Wrench { force: Vector3 { x: 1e9, y: 0.0, z: 0.0 }, torque: Vector3::default() },
        duration: Duration { sec: 1, nanosec: 0 },
        ..Default::default()
    };
    assert!(lab.call::<ApplyLinkWrench>("/apply_link_wrench", request).success);
    lab.run(50);
    assert_eq!(lab.ms(), 500);
    assert_eq!(lab.where_is("rock", ""), None);
    assert_eq!(lab.simulation.diverged().len(), 1);
    assert_eq!(lab.simulation.diverged()[0].link, "rock::link");
    let told = lab.simulation.take_findings();
    assert!(told.iter().any(|it| it.code == "model-diverged" && it.message.contains("`rock`")));
    let [_, _, z] = lab.where_is("ball", "").unwrap();
    assert!((z - (4.0 - 9.8 / 8.0)).abs() < 0.05, "{z}");
}
