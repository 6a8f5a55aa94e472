//! Robots of `robot_state_publisher`, from a launch file or a command.

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Arguments, Graph, Level, Mailbox, NodeSettings, ParameterFileError, Qos};
use periplus_launch::bringup::{LaunchRunner, PythonInterpreter, Settings};
use periplus_launch::{Dialect, LaunchPlan, PlanNode, PlanStep, What};
use periplus_msgs::sensor_msgs::JointState;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_sim::Search;

const ARM: &str = "<robot name='arm'><link name='base'/><link name='upper'/>\
    <joint name='turn' type='continuous'><parent link='base'/><child link='upper'/></joint></robot>";

#[test]
fn a_description_behind_ros_args_moves_joints_of_links_without_inertia() {
    let node = PlanNode {
        package: Some("robot_state_publisher".into()),
        executable: "robot_state_publisher".into(),
        ..PlanNode::default()
    };
    let what = What::Node(Box::new(node));
    let environment = Default::default();
    let step = PlanStep { id: 0, after: Vec::new(), what, environment, written: None };
    let plan = LaunchPlan { steps: vec![step], ..LaunchPlan::default() };
    let settings = Settings {
        search: Search { working_folder: "/".into(), ..Search::default() },
        dialect: Dialect::Ros2,
        is_wired: false,
        has_ros1_master: false,
        is_paced: false,
        guarding_command: Vec::new(),
        tools: None,
        python: PythonInterpreter::default(),
        uses_real_ros: false,
        node_environment: Vec::new(),
    };
    let words = ["-p".to_owned(), format!("robot_description:={ARM}")];
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let arguments = Arguments::read(&words, &mut sources, &mut findings, &mut |_| {
        Err(ParameterFileError::Missing)
    });
    assert!(!findings.has_errors());
    let graph = Graph::new();
    graph.set_arguments(arguments);
    let user = graph.node(NodeSettings::new("user").bare()).unwrap();
    let states = user.publisher::<JointState>("/joint_states", Qos::reliable(10)).unwrap();
    let tf: Mailbox<TFMessage> = user.mailbox("/tf", Qos::reliable(10)).unwrap();
    let mut bringup = LaunchRunner::new(&plan, settings);
    bringup.work(&graph, 0, None);
    let said = bringup.take_log();
    assert!(said.iter().all(|one| one.level < Level::Error), "{said:?}");
    graph.advance_to(1_000_000_000);
    let mut state = JointState { name: vec!["turn".into()], ..JointState::default() };
    state.header.stamp = periplus_msgs::builtin_interfaces::Time::of_ns(1_000_000_000);
    state.position = vec![1.0];
    states.publish(state);
    graph.settle();
    let last = tf.latest().unwrap();
    assert_eq!(last.transforms[0].child_frame_id, "upper");
    assert!((last.transforms[0].transform.rotation.x - 0.5_f64.sin()).abs() < 1e-12);
}
