//! Snapshots: the same future again, to the byte.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "helpers of tests")]
#![allow(clippy::print_stdout, reason = "a test at the edge")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use periplus_geometry::Pose;
use periplus_graph::{Graph, NodeSettings, Publisher, Qos, Sample, Sink, TopicInfo};
use periplus_loader::LoadContext;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped, Vector3};
use periplus_msgs::{Message, std_msgs};
use periplus_os::Machine;
use periplus_resources::{Host, MemoryHost, Resolver};
use periplus_sim::{
    AssetFiles, Composition, ModelInstance, Options, PhysicsMode, RobotPlacement, Simulation,
    SnapshotError, compose,
};

/// Not a multiple of [`COMMAND_NS`], so that commands wait in the snapshot.
const BEFORE_NS: i64 = 710_000_000;
const AFTER_NS: i64 = 800_000_000;
/// Length of another future, between a snapshot and the return to it.
const BRANCH_NS: i64 = 150_000_000;
/// Commands come as from a joystick \[ns\].
const COMMAND_NS: i64 = 50_000_000;

/// Topic, time and bytes of a message.
type Record = (String, i64, Vec<u8>);

/// All messages since it was cleared.
#[derive(Clone, Default)]
struct Recording(Arc<Mutex<Vec<Record>>>);

impl Sink for Recording {
    fn wants(&self, topic: &TopicInfo) -> bool {
        !["/rosout", "/parameter_events"].contains(&topic.name.as_str())
    }

    fn take(&self, topic: &TopicInfo, sample: &Sample) {
        let bytes = sample.cdr().unwrap().to_vec();
        self.0.lock().unwrap().push((topic.name.clone(), sample.time_ns, bytes));
    }
}

/// Publishers on all topics of a type that devices subscribe to.
struct Commands {
    twists: Vec<Publisher<Twist>>,
    stamped: Vec<Publisher<TwistStamped>>,
    numbers: Vec<Publisher<std_msgs::Float64>>,
    flags: Vec<Publisher<std_msgs::Bool>>,
    events: Vec<Publisher<std_msgs::Empty>>,
}

impl Commands {
    fn new(graph: &Graph) -> Self {
        fn of<T: Message>(graph: &Graph) -> Vec<Publisher<T>> {
            let name = T::TYPE_NAME.replace(['/', '_'], "").to_lowercase();
            let node = graph.node(NodeSettings::new(format!("user_{name}"))).unwrap();
            let topics = graph.topics().into_iter();
            let used = topics
                .filter(|topic| topic.type_name == T::TYPE_NAME && !topic.subscriptions.is_empty());
            used.map(|topic| node.publisher(&topic.name, Qos::reliable(10)).unwrap()).collect()
        }
        Self {
            twists: of(graph),
            stamped: of(graph),
            numbers: of(graph),
            flags: of(graph),
            events: of(graph),
        }
    }

    /// Commands that depend on time only.
    fn publish(&self, time_ns: i64) {
        let number = time_ns / COMMAND_NS;
        let part = |every: i64| (number % every) as f64 / every as f64;
        let linear = Vector3 { x: 0.4 - 0.2 * part(3), y: 0.1 * part(4), z: 0.0 };
        let angular = Vector3 { x: 0.0, y: 0.0, z: 0.6 * part(5) - 0.2 };
        let twist = Twist { linear, angular };
        self.twists.iter().for_each(|out| out.publish(twist.clone()));
        let stamped = TwistStamped { twist, ..TwistStamped::default() };
        self.stamped.iter().for_each(|out| out.publish(stamped.clone()));
        let data = 0.5 * part(7);
        self.numbers.iter().for_each(|out| out.publish(std_msgs::Float64 { data }));
        let data = number % 7 != 3;
        self.flags.iter().for_each(|out| out.publish(std_msgs::Bool { data }));
        self.events.iter().for_each(|out| out.publish(std_msgs::Empty::default()));
    }
}

/// Poses of all links, as bits.
fn poses(simulation: &Simulation) -> Vec<u64> {
    let links = simulation.motion().snapshot().into_iter();
    let numbers = links.flat_map(|(_, state)| {
        let Pose { translation: t, rotation: q } = state.world_from_link;
        let (v, w) = (state.linear_m_s, state.angular_rad_s);
        [t.x, t.y, t.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z, w.x, w.y, w.z]
    });
    numbers.map(f64::to_bits).collect()
}

struct Run {
    simulation: Simulation,
    commands: Commands,
    recording: Recording,
}

#[derive(PartialEq)]
struct Future {
    messages: Vec<Record>,
    poses: Vec<u64>,
    time_ns: i64,
}

impl Run {
    /// The state of a simulation after some time, with commands that wait.
    fn new(mut simulation: Simulation) -> Self {
        let commands = Commands::new(simulation.graph());
        let recording = Recording::default();
        simulation.graph().tap(Box::new(recording.clone()));
        advance(&mut simulation, &commands, BEFORE_NS);
        commands.publish(0);
        Self { simulation, commands, recording }
    }

    fn future(&mut self) -> Future {
        self.recording.0.lock().unwrap().clear();
        advance(&mut self.simulation, &self.commands, AFTER_NS);
        let messages = std::mem::take(&mut *self.recording.0.lock().unwrap());
        let time_ns = self.simulation.time_ns();
        Future { messages, poses: poses(&self.simulation), time_ns }
    }
}

fn advance(simulation: &mut Simulation, commands: &Commands, length_ns: i64) {
    let end_ns = simulation.time_ns() + length_ns;
    while simulation.time_ns() < end_ns {
        if simulation.time_ns() / COMMAND_NS * COMMAND_NS == simulation.time_ns() {
            commands.publish(simulation.time_ns());
        }
        simulation.step_until(end_ns).unwrap();
    }
}

#[track_caller]
fn assert_same(name: &str, expected: &Future, found: &Future) {
    assert_eq!(expected.time_ns, found.time_ns, "{name}");
    let pairs = expected.messages.iter().zip(&found.messages);
    for (number, (one, other)) in pairs.enumerate() {
        assert!(
            one == other,
            "{name}: message {number} differs: {} at {} ns, {} at {} ns",
            one.0,
            one.1,
            other.0,
            other.1
        );
    }
    assert_eq!(expected.messages.len(), found.messages.len(), "{name}");
    assert!(expected.poses == found.poses, "{name}: poses differ");
}

/// Checks that all futures are equal: without a snapshot, after it, and after each return to it.
#[track_caller]
fn check(name: &str, make: impl Fn() -> (Simulation, Vec<ModelInstance>)) {
    let expected = Run::new(make().0).future();
    assert!(!expected.messages.is_empty(), "{name}");
    let (simulation, members) = make();
    let mut run = Run::new(simulation);
    let snapshot = run.simulation.snapshot();
    assert_eq!(snapshot.time_ns(), BEFORE_NS);
    assert_same(&format!("{name}: after the snapshot"), &expected, &run.future());
    for turn in ["once", "twice"] {
        run.simulation.restore(&snapshot).unwrap();
        assert_same(&format!("{name}: restored {turn}"), &expected, &run.future());
    }
    // Another world: a copy of the last model is inserted, and the last two are removed.
    let copied = members.last().unwrap().clone();
    let world_from_model = Pose::from_xyz(40.0, 40.0, 1.0) * copied.world_from_model;
    let copy = ModelInstance {
        name: "copy".into(),
        namespace: "/copy".into(),
        world_from_model,
        ..copied
    };
    let _ = run.simulation.spawn(copy);
    advance(&mut run.simulation, &run.commands, BRANCH_NS);
    for member in members.iter().rev().take(2) {
        assert!(run.simulation.delete(&member.name), "{}", member.name);
    }
    run.simulation.set_step(0.002);
    advance(&mut run.simulation, &run.commands, BRANCH_NS);
    run.simulation.restore(&snapshot).unwrap();
    assert!(run.simulation.models().all(|model| model != "copy"));
    assert_same(&format!("{name}: other models before"), &expected, &run.future());
    run.simulation.reset();
    run.simulation.restore(&snapshot).unwrap();
    assert_same(&format!("{name}: reset before"), &expected, &run.future());
}

fn composed(host: &dyn Host, world: &Path, robots: &[RobotPlacement], root: &Path) -> Composition {
    let search = [root.join("robots"), root.join("worlds"), root.join("gazebo_models")];
    let resolver = Resolver::new(host, &search);
    let (working_folder, open_meshes) = (root.to_owned(), true);
    let arguments = Vec::new();
    compose(
        world,
        robots,
        &LoadContext { host, resolver: &resolver, working_folder, arguments, open_meshes },
    )
}

fn simulated(composition: &mut Composition, mode: PhysicsMode) -> (Simulation, Vec<ModelInstance>) {
    let files = Arc::new(AssetFiles::default());
    let options = Options { mode, seed: 5, rolling_scans: true, ..Options::default() };
    let simulation = Simulation::new(composition, files, options);
    (simulation, composition.members.clone())
}

#[track_caller]
fn check_files(world: &Path, robots: &[PathBuf], root: &Path) {
    for mode in [PhysicsMode::Rigid, PhysicsMode::Kinematic] {
        let name = format!("{} {robots:?} ({mode:?})", world.display());
        check(&name, || {
            let robots: Vec<RobotPlacement> = robots
                .iter()
                .map(|file| RobotPlacement { file: file.clone(), ..RobotPlacement::default() })
                .collect();
            simulated(&mut composed(&Machine, world, &robots, root), mode)
        });
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().unwrap()
}

#[test]
fn our_robots_in_our_worlds() {
    let root = root();
    let kbot = root.join("robots/kbot/urdf/kbot.urdf.xacro");
    let sam_bot = root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro");
    check_files(&root.join("worlds/demo_room.sdf"), std::slice::from_ref(&kbot), &root);
    check_files(&root.join("worlds/cube_and_sphere.sdf"), &[sam_bot], &root);
    check_files(&root.join("worlds/pong.sdf"), &[kbot], &root);
}

#[test]
fn robots_of_other_projects() {
    let corpus = root().join("../shared/corpus");
    if !corpus.is_dir() {
        println!("SKIPPED: there is no ../shared/corpus to simulate");
        return;
    }
    for file in [
        "gz-sim8_examples/examples/worlds/mecanum_drive.sdf",
        "gz-sim8_examples/examples/worlds/ackermann_steering.sdf",
        "gz-sim8_examples/examples/worlds/skid_steer_mecanum.sdf",
        "gz-sim8_examples/examples/worlds/triggered_publisher.sdf",
        "MOGI-ROS_Week-3-4/bme_gazebo_basics/urdf/mogi_bot_skid_steer.urdf",
        "linorobot2/linorobot2_description/urdf/robots/4wd.urdf.xacro",
    ] {
        check_files(&corpus.join(file), &[], &corpus);
    }
}

/// Every file of `../shared/corpus` with a model. It takes about an hour.
#[test]
#[ignore = "slow"]
fn every_robot_of_the_corpus() {
    let corpus = root().join("../shared/corpus").canonicalize().unwrap();
    let (mut folders, mut files) = (vec![corpus.clone()], BTreeSet::new());
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().flatten().map(|entry| entry.path()) {
            let extension = path.extension().and_then(|it| it.to_str()).unwrap_or_default();
            if path.is_dir() {
                folders.push(path);
            } else if ["xacro", "urdf", "sdf", "world"].contains(&extension) {
                files.insert(path);
            }
        }
    }
    for file in files {
        let composition = composed(&Machine, &file, &[], &corpus);
        if composition.members.iter().any(|member| !member.model.is_static) {
            println!("{}", file.display());
            check_files(&file, &[], &corpus);
        }
    }
}

/// A frame on four wheels, of which the front ones steer on forks.
fn car(name: &str, y_m: f64, inside: &str) -> String {
    let inertia = |mass: f64| {
        let i = mass * 0.02;
        format!(
            "<inertial><mass>{mass}</mass><inertia><ixx>{i}</ixx><iyy>{i}</iyy><izz>{i}</izz>\
             </inertia></inertial>"
        )
    };
    let mut text = format!(
        "<model name='{name}'><pose>0 {y_m} 0 0 0 0</pose><link name='base'>\
         <pose>0 0 0.2 0 0 0</pose>{}<collision name='body'><geometry><box><size>0.6 0.3 0.1</size>\
         </box></geometry></collision><visual name='body'><geometry><box><size>0.6 0.3 0.1</size></box>\
         </geometry></visual>SENSORS</link>",
        inertia(5.0)
    );
    for (wheel, x, y) in
        [("fl", 0.25, 0.2), ("fr", 0.25, -0.2), ("bl", -0.25, 0.2), ("br", -0.25, -0.2)]
    {
        let parent = if wheel.starts_with('f') {
            text += &format!(
                "<link name='{wheel}_fork'><pose>{x} {y} 0.1 0 0 0</pose>{}</link>\
                 <joint name='{wheel}_steer' type='revolute'><parent>base</parent><child>{wheel}_fork\
                 </child><axis><xyz>0 0 1</xyz><limit><lower>-0.6</lower><upper>0.6</upper></limit>\
                 </axis></joint>",
                inertia(0.5)
            );
            format!("{wheel}_fork")
        } else {
            "base".to_owned()
        };
        text += &format!(
            "<link name='{wheel}'><pose>{x} {y} 0.1 0 0 0</pose>{}<collision name='tyre'>\
             <pose>0 0 0 1.5707963 0 0</pose><geometry><cylinder><radius>0.1</radius><length>0.04\
             </length></cylinder></geometry></collision></link><joint name='{wheel}_joint' \
             type='revolute'><parent>{parent}</parent><child>{wheel}</child><axis><xyz>0 1 0</xyz></axis>\
             </joint>",
            inertia(0.5)
        );
    }
    let (sensors, plugins) = inside.split_once("PLUGINS").unwrap_or(("", inside));
    text.replace("SENSORS", sensors) + plugins + "</model>"
}

/// Drives and publishers, each on a car.
const PLUGINS: [(&str, &str); 17] = [
    ("classic", "<plugin name='p' filename='libgazebo_ros_diff_drive.so'><ros><namespace>classic</namespace></ros>
       <update_rate>30</update_rate><left_joint>bl_joint</left_joint><right_joint>br_joint</right_joint>
       <wheel_separation>0.4</wheel_separation><wheel_diameter>0.2</wheel_diameter>
       <max_wheel_torque>20</max_wheel_torque><max_wheel_acceleration>1</max_wheel_acceleration>
       <publish_odom>true</publish_odom><publish_odom_tf>true</publish_odom_tf><publish_wheel_tf>true</publish_wheel_tf>
       <odometry_source>0</odometry_source></plugin>"),
    ("tricycle", "<plugin name='p' filename='libgazebo_ros_tricycle_drive.so'><ros><namespace>tricycle</namespace></ros>
       <steering_joint>fl_steer</steering_joint><actuated_wheel_joint>fl_joint</actuated_wheel_joint>
       <encoder_wheel_left_joint>bl_joint</encoder_wheel_left_joint>
       <encoder_wheel_right_joint>br_joint</encoder_wheel_right_joint><actuated_wheel_diameter>0.2</actuated_wheel_diameter>
       <encoder_wheel_diameter>0.2</encoder_wheel_diameter><max_wheel_acceleration>1</max_wheel_acceleration>
       <update_rate>40</update_rate><publish_odom>true</publish_odom><odometry_source>0</odometry_source></plugin>"),
    ("car", "<plugin name='p' filename='libgazebo_ros_ackermann_drive.so'><ros><namespace>car</namespace></ros>
       <front_left_joint>fl_joint</front_left_joint><front_right_joint>fr_joint</front_right_joint>
       <rear_left_joint>bl_joint</rear_left_joint><rear_right_joint>br_joint</rear_right_joint>
       <left_steering_joint>fl_steer</left_steering_joint><right_steering_joint>fr_steer</right_steering_joint>
       <publish_odom>true</publish_odom><publish_distance>true</publish_distance>
       <linear_velocity_pid_gain>1 0.5 0.01</linear_velocity_pid_gain><linear_velocity_i_range>0 1</linear_velocity_i_range>
       <left_steering_pid_gain>3 0.5 0.1</left_steering_pid_gain>
       <right_steering_pid_gain>3 0.5 0.1</right_steering_pid_gain></plugin>"),
    ("planar", "<plugin name='p' filename='libgazebo_ros_planar_move.so'><ros><namespace>planar</namespace></ros>
       <update_rate>30</update_rate><publish_rate>20</publish_rate></plugin>"),
    ("planar1", "<plugin name='p' filename='libgazebo_ros_planar_move.so'><commandTopic>planar1/cmd_vel</commandTopic>
       <odometryTopic>planar1/odom</odometryTopic><odometryFrame>o</odometryFrame><odometryRate>20</odometryRate>
       <robotBaseFrame>base</robotBaseFrame><cmdTimeout>0.03</cmdTimeout></plugin>"),
    ("flying", "<plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'>
       <initial_linear>0.5 0 0.1</initial_linear></plugin>
       <plugin name='p' filename='libgazebo_ros_p3d.so'><ros><namespace>flying</namespace></ros><body_name>base</body_name>
       <frame_name>world</frame_name><update_rate>30</update_rate><gaussian_noise>0.01</gaussian_noise></plugin>"),
    ("gz_diff", "<plugin filename='gz-sim-diff-drive-system' name='gz::sim::systems::DiffDrive'>
       <left_joint>bl_joint</left_joint><right_joint>br_joint</right_joint><wheel_separation>0.4</wheel_separation>
       <wheel_radius>0.1</wheel_radius><max_acceleration>0.7</max_acceleration><min_acceleration>-0.7</min_acceleration>
       <max_jerk>5</max_jerk><min_jerk>-5</min_jerk><odom_publish_frequency>30</odom_publish_frequency></plugin>"),
    ("gz_car", "<plugin filename='gz-sim-ackermann-steering-system' name='gz::sim::systems::AckermannSteering'>
       <left_joint>bl_joint</left_joint><right_joint>br_joint</right_joint><left_steering_joint>fl_steer</left_steering_joint>
       <right_steering_joint>fr_steer</right_steering_joint><max_acceleration>0.7</max_acceleration>
       <min_acceleration>-0.7</min_acceleration><steer_p_gain>4</steer_p_gain><wheel_base>0.5</wheel_base></plugin>"),
    ("gz_angle", "<plugin filename='gz-sim-ackermann-steering-system' name='gz::sim::systems::AckermannSteering'>
       <left_steering_joint>fl_steer</left_steering_joint><right_steering_joint>fr_steer</right_steering_joint>
       <steering_only>true</steering_only></plugin>"),
    ("gz_mecanum", "<plugin filename='gz-sim-mecanum-drive-system' name='gz::sim::systems::MecanumDrive'>
       <front_left_joint>fl_joint</front_left_joint><front_right_joint>fr_joint</front_right_joint>
       <back_left_joint>bl_joint</back_left_joint><back_right_joint>br_joint</back_right_joint>
       <max_acceleration>0.7</max_acceleration><min_acceleration>-0.7</min_acceleration></plugin>"),
    ("speed", "<plugin filename='gz-sim-joint-controller-system' name='gz::sim::systems::JointController'>
       <joint_name>bl_joint</joint_name><use_force_commands>true</use_force_commands><p_gain>0.2</p_gain><i_gain>0.3</i_gain>
       <i_max>9</i_max><i_min>-9</i_min></plugin>"),
    ("position", "<plugin filename='gz-sim-joint-position-controller-system' name='gz::sim::systems::JointPositionController'>
       <joint_name>fl_steer</joint_name><p_gain>5</p_gain><i_gain>1</i_gain><i_max>9</i_max><i_min>-9</i_min><d_gain>0.1</d_gain></plugin>
       <plugin filename='gz-sim-joint-position-controller-system' name='gz::sim::systems::JointPositionController'>
       <joint_name>fr_steer</joint_name><use_velocity_commands>true</use_velocity_commands><cmd_max>0.5</cmd_max></plugin>"),
    ("states", "<plugin filename='gz-sim-joint-state-publisher-system' name='gz::sim::systems::JointStatePublisher'/>
       <plugin filename='gz-sim-joint-controller-system' name='gz::sim::systems::JointController'>
       <joint_name>br_joint</joint_name></plugin>"),
    ("poses", "<plugin filename='gz-sim-pose-publisher-system' name='gz::sim::systems::PosePublisher'>
       <static_publisher>true</static_publisher><update_frequency>30</update_frequency>
       <static_update_frequency>7</static_update_frequency></plugin>"),
    ("odometry", "<plugin filename='gz-sim-odometry-publisher-system' name='gz::sim::systems::OdometryPublisher'>
       <gaussian_noise>0.01</gaussian_noise><dimensions>3</dimensions><odom_publish_frequency>30</odom_publish_frequency></plugin>
       <plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'/>"),
    ("skid", "<plugin name='p' filename='libgazebo_ros_skid_steer_drive.so'><commandTopic>skid/cmd_vel</commandTopic>
       <odometryTopic>skid/odom</odometryTopic><robotBaseFrame>base</robotBaseFrame><leftFrontJoint>fl_joint</leftFrontJoint>
       <rightFrontJoint>fr_joint</rightFrontJoint><leftRearJoint>bl_joint</leftRearJoint><rightRearJoint>br_joint</rightRearJoint>
       <wheelSeparation>0.4</wheelSeparation><wheelDiameter>0.2</wheelDiameter><torque>5</torque></plugin>"),
    ("sensors", ""),
];

/// All sensors, with noise and rates that no step divides.
fn sensors() -> String {
    const NOISE: &str =
        "<noise type='gaussian'><mean>0</mean><stddev>0.01</stddev><bias_mean>0.1</bias_mean>
        <bias_stddev>0.1</bias_stddev><dynamic_bias_stddev>0.3</dynamic_bias_stddev>
        <dynamic_bias_correlation_time>2</dynamic_bias_correlation_time></noise>";
    let xyz = |name: &str| format!("<{name}><x>{NOISE}</x><y>{NOISE}</y><z>{NOISE}</z></{name}>");
    let camera = "<horizontal_fov>1.2</horizontal_fov><image><width>16</width><height>12</height></image>
        <clip><near>0.1</near><far>9</far></clip><noise><type>gaussian</type><stddev>0.01</stddev></noise>";
    let scan = |samples: i32, rows: i32| {
        format!(
            "<scan><horizontal><samples>{samples}</samples><min_angle>-2</min_angle><max_angle>2</max_angle>
             </horizontal><vertical><samples>{rows}</samples><min_angle>-0.1</min_angle><max_angle>0.1</max_angle>
             </vertical></scan><range><min>0.05</min><max>20</max></range>{NOISE}"
        )
    };
    [
        ("imu", "imu", format!("<imu>{}{}</imu>", xyz("angular_velocity"), xyz("linear_acceleration"))),
        ("scan", "gpu_lidar", format!("<lidar>{}</lidar>", scan(30, 1))),
        ("rows", "ray", format!("<ray>{}</ray>", scan(20, 4))),
        ("image", "camera", format!("<camera>{camera}</camera>")),
        ("triggered", "camera", format!("<camera>{camera}<triggered>true</triggered></camera>")),
        ("depth", "rgbd_camera", format!("<camera>{camera}</camera>")),
        ("labels", "segmentation", format!("<camera>{camera}</camera>")),
        ("magnetic", "magnetometer", format!("<magnetometer>{}{}{}</magnetometer>", axis("x", NOISE), axis("y", NOISE), axis("z", NOISE))),
        ("height", "altimeter", format!("<altimeter><vertical_position>{NOISE}</vertical_position><vertical_velocity>{NOISE}</vertical_velocity></altimeter>")),
        ("air", "air_pressure", format!("<air_pressure><pressure>{NOISE}</pressure></air_pressure>")),
        ("fix", "navsat", format!("<navsat><position_sensing><horizontal>{NOISE}</horizontal><vertical>{NOISE}</vertical>
           </position_sensing><velocity_sensing><horizontal>{NOISE}</horizontal><vertical>{NOISE}</vertical>
           </velocity_sensing></navsat>")),
        ("touch", "contact", "<contact><collision>body</collision></contact>".into()),
        ("sonar", "sonar", "<sonar><min>0.02</min><max>5</max><radius>0.5</radius></sonar>".into()),
        ("logical", "logical_camera", "<logical_camera><near>0.1</near><far>9</far><aspect_ratio>1</aspect_ratio>
           <horizontal_fov>1.5</horizontal_fov></logical_camera>".into()),
    ]
    .iter()
    .map(|(name, kind, inside)| {
        format!("<sensor name='{name}' type='{kind}'><always_on>1</always_on><update_rate>17</update_rate>{inside}</sensor>")
    })
    .collect()
}

fn axis(name: &str, inside: &str) -> String {
    format!("<{name}>{inside}</{name}>")
}

fn all_devices() -> String {
    let mut text = String::from(
        "<sdf version='1.9'><world name='hall'>
         <spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>47.5</latitude_deg>
         <longitude_deg>8.5</longitude_deg><elevation>400</elevation><heading_deg>0</heading_deg></spherical_coordinates>
         <plugin filename='gz-sim-triggered-publisher-system' name='gz::sim::systems::TriggeredPublisher'>
         <input type='gz.msgs.Double' topic='/model/speed/joint/bl_joint/cmd_vel'/>
         <output type='gz.msgs.Boolean' topic='/triggered'>data: true</output><delay_ms>130</delay_ms></plugin>
         <light name='sun' type='directional'><direction>0.3 0.2 -1</direction></light>
         <model name='floor'><static>true</static><link name='l'>
         <collision name='c'><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
         <visual name='c'><geometry><plane><normal>0 0 1</normal><size>99 99</size></plane></geometry></visual></link></model>
         <model name='load'><pose>0 16 0.31 0 0 0</pose><link name='l'><inertial><mass>0.2</mass></inertial>
         <collision name='c'><geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision>
         <visual name='c'><geometry><box><size>0.1 0.1 0.1</size></box></geometry></visual></link></model>",
    );
    for (number, (name, plugins)) in PLUGINS.iter().enumerate() {
        let inside = match *name {
            "sensors" => format!(
                "{}PLUGINS<plugin filename='gz-sim-diff-drive-system' name='gz::sim::systems::DiffDrive'>
                 <left_joint>bl_joint</left_joint><right_joint>br_joint</right_joint></plugin>",
                sensors()
            ),
            _ => (*plugins).to_owned(),
        };
        text += &car(name, number as f64, &inside);
    }
    text + "</world></sdf>"
}

/// All drives, sensors and publishers in one world.
#[test]
fn every_device() {
    for mode in [PhysicsMode::Rigid, PhysicsMode::Kinematic] {
        let host = MemoryHost::new().with_file("/hall.sdf", all_devices());
        let make = || {
            let mut composition = composed(&host, "/hall.sdf".as_ref(), &[], "/".as_ref());
            let made = simulated(&mut composition, mode);
            let findings = &composition.files[0].diagnostics;
            assert!(!findings.has_errors(), "{findings:?}");
            made
        };
        assert!(make().0.devices().count() >= 35);
        check(&format!("every device ({mode:?})"), make);
    }
}

#[test]
fn a_snapshot_of_another_simulation() {
    let root = root();
    let world = root.join("worlds/pong.sdf");
    let make = || simulated(&mut composed(&Machine, &world, &[], &root), PhysicsMode::Rigid).0;
    let (mut one, other) = (make(), make());
    assert_eq!(one.restore(&other.snapshot()), Err(SnapshotError::OtherSimulation));
    assert_eq!(one.restore(&one.snapshot()), Ok(()));
}

#[test]
fn the_cost_in_the_tutorial_world() {
    const COUNT: u32 = 500;
    let root = root();
    let robots = [RobotPlacement {
        file: root.join("robots/kbot/urdf/kbot.urdf.xacro"),
        ..RobotPlacement::default()
    }];
    let world = root.join("worlds/demo_room.sdf");
    let mut composition = composed(&Machine, &world, &robots, &root);
    let mut run = Run::new(simulated(&mut composition, PhysicsMode::Rigid).0);
    let memory = || {
        let text = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
        text.split(' ').nth(1).and_then(|pages| pages.parse::<usize>().ok()).unwrap_or(0) * 4096
    };
    let (before, started) = (memory(), std::time::Instant::now());
    let snapshots: Vec<_> = (0..COUNT).map(|_| run.simulation.snapshot()).collect();
    let taken = started.elapsed() / COUNT;
    // Tests beside this one give memory back in the meantime.
    let bytes = memory().saturating_sub(before) / snapshots.len();
    let started = std::time::Instant::now();
    for snapshot in &snapshots {
        run.simulation.restore(snapshot).unwrap();
    }
    let restored = started.elapsed() / COUNT;
    println!("a snapshot takes {taken:?} and {bytes} bytes, a restore {restored:?}");
    run.future();
}
