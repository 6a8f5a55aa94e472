//! Running launch files: the output of their nodes, also after a reset of the world.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::SourceMap;
use periplus_graph::{Graph, Mailbox, NodeSettings, Publisher, Qos};
use periplus_launch::bringup::{LaunchRunner, PythonInterpreter, Settings, xacro};
use periplus_launch::{Dialect, Interpreter, Outside, OutsideError, Printed, Request, plan};
use periplus_loader::LoadContext;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::nav_msgs::{OccupancyGrid, Odometry};
use periplus_msgs::std_srvs::{Empty, EmptyRequest};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_os::Machine;
use periplus_resources::Resolver;
use periplus_sim::{AssetFiles, Options, Search, Services, Simulation, compose, compose_plain};

/// Simulated duration of a part of the test \[ns\].
const PART_NS: i64 = 6_000_000_000;

/// Programs of the machine: only the built-in `xacro`.
struct Programs(Search);

impl Outside for Programs {
    fn run(&mut self, words: &[String]) -> Result<Printed, OutsideError> {
        Ok(self.0.with_context(false, |context| xacro(&words[1..], context))?.printed)
    }

    fn scratch(&mut self, name: &str, _text: &str) -> Result<PathBuf, OutsideError> {
        Err(OutsideError::Unavailable(format!("no file {name} is needed")))
    }

    fn python(&mut self) -> Result<Box<dyn Interpreter>, OutsideError> {
        Err(OutsideError::Unavailable("no Python is needed".into()))
    }
}

pub(crate) fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..")
}

/// A launch file of these tests.
fn bringup(file: &str, folder: &Path) -> LaunchRunner {
    bringup_as(file, folder, Dialect::Ros2)
}

fn bringup_as(file: &str, folder: &Path, dialect: Dialect) -> LaunchRunner {
    bringup_with(file, folder, dialect, Vec::new())
}

/// A launch file of these tests with more arguments than `top`.
pub(crate) fn bringup_with(
    file: &str,
    folder: &Path,
    dialect: Dialect,
    mut arguments: Vec<(String, String)>,
) -> LaunchRunner {
    arguments.push(("top".into(), folder.display().to_string()));
    let search = Search { working_folder: folder.to_owned(), ..Search::default() };
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bringup/running").join(file);
    let resolver = Resolver::new(&Machine, &[]);
    let request = Request {
        file: own,
        arguments,
        host: &Machine,
        resolver: &resolver,
        outside: &mut Programs(search.clone()),
    };
    let (plan, found) = plan(request, &mut SourceMap::new());
    assert!(!found.has_errors(), "{found:?}");
    let settings = Settings {
        search,
        dialect,
        is_wired: false,
        has_ros1_master: false,
        is_paced: false,
        guarding_command: Vec::new(),
        tools: None,
        python: PythonInterpreter::default(),
        uses_real_ros: false,
        node_environment: Vec::new(),
    };
    LaunchRunner::new(&plan, settings)
}

struct Stack {
    simulation: Simulation,
    services: Services,
    bringup: LaunchRunner,
    filtered: Mailbox<Odometry>,
    tf: Mailbox<TFMessage>,
    costs: Mailbox<OccupancyGrid>,
    command: Publisher<Twist>,
}

impl Stack {
    /// `sam_bot` with EKF, SLAM and a costmap, as started by launch files.
    fn launched() -> Self {
        let folder = top().canonicalize().unwrap();
        let resolver = Resolver::new(&Machine, &[folder.join("robots"), folder.join("worlds")]);
        let bringup = bringup("stack.launch.xml", &folder);
        let setting = LoadContext {
            host: &Machine,
            resolver: &resolver,
            working_folder: folder,
            arguments: Vec::new(),
            open_meshes: false,
        };
        let world = bringup.world().and_then(|wish| wish.file.clone()).unwrap();
        let mut composition = compose(Path::new(&world), &[], &setting);
        let options = Options::default();
        let simulation =
            Simulation::new(&mut composition, Arc::new(AssetFiles::default()), options);
        let services = Services::new(&simulation, bringup.search().clone()).unwrap();
        let node = simulation.graph().node(NodeSettings::new("watch").bare()).unwrap();
        Self {
            filtered: node.mailbox("/odometry/filtered", Qos::reliable(1000)).unwrap(),
            tf: node.mailbox("/tf", Qos::reliable(10_000)).unwrap(),
            costs: node.mailbox("/costmap/costmap", Qos::reliable(100)).unwrap(),
            command: node.publisher("/cmd_vel", Qos::reliable(10)).unwrap(),
            simulation,
            services,
            bringup,
        }
    }

    fn run(&mut self, speed_m_s: f64) {
        let end_ns = self.simulation.time_ns() + PART_NS;
        while self.simulation.time_ns() < end_ns {
            self.services.serve(&mut self.simulation);
            let graph = self.simulation.graph().clone();
            let now_ns = self.simulation.time_ns();
            self.bringup.work(&graph, now_ns, Some(&mut self.simulation));
            if now_ns % 100_000_000 == 0 {
                let mut twist = Twist::default();
                twist.linear.x = speed_m_s;
                self.command.publish(twist);
            }
            self.simulation.step().unwrap();
        }
        let said: Vec<String> = self.bringup.take_log().into_iter().map(|said| said.text).collect();
        assert!(said.iter().all(|text| !text.contains("not spawned")), "{said:?}");
    }

    /// Checks the messages since the last call, in simulated time from zero.
    fn has_run_from_zero(&self, what: &str) {
        let near_start_ns = PART_NS / 2;
        let filtered = self.filtered.drain();
        let times: Vec<i64> = filtered.iter().map(|one| one.header.stamp.ns()).collect();
        assert!(times.len() > 100, "{what}: {} estimates", times.len());
        assert!(times[0] < near_start_ns && times.is_sorted(), "{what}: estimates at {times:?}");
        let x_m = filtered.last().unwrap().pose.pose.position.x;
        assert!((0.8..1.6).contains(&x_m), "{what}: the filter has the robot at {x_m} m");
        let mut edges: Vec<(String, i64)> = Vec::new();
        let mut map_from_odom = None;
        for message in self.tf.drain() {
            for one in &message.transforms {
                edges.push((one.child_frame_id.clone(), one.header.stamp.ns()));
                if one.child_frame_id == "odom" {
                    map_from_odom = Some(one.transform.translation.x);
                }
            }
        }
        for child in ["base_link", "odom", "drivewhl_l_link"] {
            let times: Vec<i64> =
                edges.iter().filter(|(it, _)| it == child).map(|(_, time_ns)| *time_ns).collect();
            let first = times.first().copied().unwrap_or(i64::MAX);
            assert!(first < near_start_ns, "{what}: `{child}` on /tf first at {first} ns");
            assert!(*times.last().unwrap() > near_start_ns, "{what}: `{child}` has stopped");
        }
        let map_from_odom = map_from_odom.unwrap();
        assert!(map_from_odom.abs() < 0.2, "{what}: odom is at {map_from_odom} m in the map");
        let costs: Vec<i64> =
            self.costs.drain().iter().map(|grid| grid.header.stamp.ns()).collect();
        assert!(costs.len() >= 4, "{what}: costmaps at {costs:?}");
        assert!(costs.iter().any(|time_ns| *time_ns < near_start_ns), "{what}: {costs:?}");
    }
}

/// `ros_gz_bridge` strips stamp and frame from a velocity for Gazebo.
#[test]
fn a_stamped_velocity_drives_a_robot_of_gazebo() {
    let folder = top().canonicalize().unwrap();
    let mut bringup = bringup("bridge.launch.xml", &folder);
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("robot").bare()).unwrap();
    let robot = node.mailbox::<Twist>("/model/robot/cmd_vel", Qos::reliable(10)).unwrap();
    let driver = node.publisher::<TwistStamped>("/drive", Qos::reliable(10)).unwrap();
    assert!(!bringup.bridges_transforms(), "only the velocity is bridged");
    bringup.work(&graph, 0, None);
    let mut velocity = TwistStamped::default();
    velocity.twist.linear.x = 0.5;
    driver.publish(velocity);
    graph.settle();
    bringup.work(&graph, 0, None);
    graph.settle();
    let speeds: Vec<f64> = robot.drain().iter().map(|twist| twist.linear.x).collect();
    assert_eq!(speeds, [0.5], "{:?}", bringup.lines());
}

/// A launch file starts RViz with a file and a fixed frame: the page opens both.
#[test]
fn rviz_names_its_file_and_fixed_frame() {
    let folder = top().canonicalize().unwrap();
    let bringup = bringup("rviz.launch.xml", &folder);
    assert_eq!(bringup.views(), [folder.join("robots/sam_bot/rviz/sam_bot.rviz")]);
    assert_eq!(bringup.fixed_frame().as_deref(), Some("base_link"));
    assert!(bringup.wants_page());
}

/// The ROS 1 server exits when its map cannot be read.
#[test]
fn a_map_that_is_not_there_is_an_error() {
    let folder = top().canonicalize().unwrap();
    let mut bringup = bringup("map.launch.xml", &folder);
    let graph = Graph::new();
    bringup.work(&graph, 0, None);
    graph.settle();
    let said = bringup.take_log();
    let is_told = |text: &str| text.contains("nowhere.yaml") && text.contains("cannot be read");
    assert!(said.iter().any(|one| is_told(&one.text)), "{:?}", bringup.lines());
}

#[test]
fn a_filter_mapping_and_costmaps_go_on_after_a_reset() {
    let mut stack = Stack::launched();
    stack.run(0.25);
    stack.has_run_from_zero("before");
    let node = stack.simulation.graph().node(NodeSettings::new("caller").bare()).unwrap();
    let reset = node.client::<Empty>("/reset_simulation").unwrap();
    let _answer = reset.call(EmptyRequest::default());
    stack.simulation.graph().settle();
    stack.services.serve(&mut stack.simulation);
    assert_eq!(stack.simulation.time_ns(), 0);
    let _ = (stack.filtered.drain(), stack.tf.drain(), stack.costs.drain());
    stack.run(0.25);
    stack.has_run_from_zero("after");
}

/// Runs a launch file on a plane for six seconds, with a velocity on `/cmd_vel` from the third one on.
/// Returns the distance of the robot and the log.
fn driven_m(file: &str, dialect: Dialect) -> (f64, Vec<String>) {
    let folder = top().canonicalize().unwrap();
    let resolver = Resolver::new(&Machine, &[]);
    let setting = LoadContext {
        host: &Machine,
        resolver: &resolver,
        working_folder: folder.clone(),
        arguments: Vec::new(),
        open_meshes: false,
    };
    let mut bringup = bringup_as(file, &folder, dialect);
    assert!(bringup.spawns_controllers());
    let mut composition = compose_plain(&[], &setting);
    let options = Options { starts_controllers: false, ..Options::default() };
    let mut simulation = Simulation::new(&mut composition, Arc::default(), options);
    let node = simulation.graph().node(NodeSettings::new("watch").bare()).unwrap();
    let command: Publisher<Twist> = node.publisher("/cmd_vel", Qos::reliable(10)).unwrap();
    while simulation.time_ns() < 6_000_000_000 {
        let graph = simulation.graph().clone();
        let now_ns = simulation.time_ns();
        bringup.work(&graph, now_ns, Some(&mut simulation));
        if now_ns >= 3_000_000_000 && now_ns % 100_000_000 == 0 {
            let mut twist = Twist::default();
            twist.linear.x = 0.4;
            command.publish(twist);
        }
        simulation.step().unwrap();
    }
    let said: Vec<String> = bringup.take_log().into_iter().map(|said| said.text).collect();
    let robot = simulation.motion().models().find(|(_, name)| *name == "two_wheels");
    let pose = robot.and_then(|(id, _)| simulation.motion().model_pose(id));
    (pose.map_or(f64::NAN, |pose| pose.translation.x), said)
}

#[test]
fn spawners_of_both_generations_start_controllers() {
    let ros2 = ("controllers.launch.xml", Dialect::Ros2);
    for (file, dialect) in [ros2, ("controllers.launch", Dialect::Ros1)] {
        let (way_m, said) = driven_m(file, dialect);
        assert!((way_m - 1.2).abs() < 0.03, "{file}: {way_m} m, {said:#?}");
        let started = said.iter().filter(|text| text.contains("configured and activated"));
        assert_eq!(started.count(), 2, "{file}: {said:#?}");
    }
}
