//! Stage of the tests: a graph in lockstep with a map and a robot that moves as it is commanded.

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{Actor, Mailbox, NodeSettings, Publisher, Qos};
use periplus_msgs::actionlib_msgs::{GoalID, GoalStatus};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::Twist;
use periplus_msgs::move_base_msgs::{
    MoveBaseActionGoal, MoveBaseActionResult, MoveBaseGoal, RecoveryStatus,
};
use periplus_msgs::nav_msgs::{OccupancyGrid, Odometry};
use periplus_msgs::rcl_interfaces::Log;
use periplus_nav_nodes::move_base::{MoveBase, MoveBaseConfig};

use crate::common::{Stage, map, pose_in};

/// Parameters in the style of files of ROS 1 without `plugins`.
pub(crate) const PARAMETERS: &str = "
base_local_planner: dwa_local_planner/DWAPlannerROS
controller_frequency: 20
planner_patience: 1.0
controller_patience: 1
robot_radius: 0.1
global_costmap:
  static_map: true
  update_frequency: 10.0
  inflation_radius: 0.3
local_costmap:
  global_frame: odom
  static_map: true
  rolling_window: true
  width: 3.0
  height: 3.0
  update_frequency: 10.0
  inflation_radius: 0.3
TrajectoryPlannerROS: {max_vel_x: 0.5, holonomic_robot: false}
DWAPlannerROS:
  max_vel_y: 0.0
  min_vel_y: 0.0
  max_vel_x: 0.5
  max_vel_trans: 0.5
";

pub(crate) struct Driving {
    pub(crate) stage: Stage,
    pub(crate) node: Actor<MoveBase>,
    commands: Mailbox<Twist>,
    odometry: Publisher<Odometry>,
    goals: Publisher<MoveBaseActionGoal>,
    cancels: Publisher<GoalID>,
    results: Mailbox<MoveBaseActionResult>,
    recoveries: Mailbox<RecoveryStatus>,
    log: Mailbox<Log>,
    /// Results so far.
    pub(crate) ended: Vec<GoalStatus>,
    /// Last command.
    pub(crate) command: Twist2,
    /// A robot that is stuck does not move.
    pub(crate) is_stuck: bool,
    /// Rotation of the robot so far \[rad\].
    pub(crate) turned_rad: f64,
}

impl Driving {
    /// On a map with walls, with parameters of the test and more that override them.
    pub(crate) fn new(more: &str, is_wall: impl Fn(f64, f64) -> bool) -> Self {
        let driving = Self::without_map(more);
        driving.stage.map.publish(map(is_wall));
        let mut driving = driving;
        driving.advance(400);
        driving
    }

    pub(crate) fn without_map(more: &str) -> Self {
        let stage = Stage::new();
        let node = stage.graph.node(NodeSettings::new("move_base")).unwrap();
        let mut sources = SourceMap::new();
        let planner = "base_local_planner: dwa_local_planner/DWAPlannerROS";
        let parameters = match more.contains("base_local_planner") {
            true => PARAMETERS.replace(planner, ""),
            false => PARAMETERS.to_owned(),
        };
        let file = sources.add("move_base.yaml", format!("{parameters}\n{more}"));
        let tree = periplus_yaml::parse(file, &sources).unwrap();
        let mut found = Diagnostics::new();
        let config = MoveBaseConfig::read(tree.as_ref(), node.names(), &mut found).unwrap();
        let found: Vec<&String> = found.iter().map(|one| &one.message).collect();
        let is_expected =
            |text: &str| text.contains("has no sources") || text.contains("TebLocalPlannerROS");
        assert!(found.iter().all(|text| is_expected(text)), "{found:?}");
        let graph = stage.graph.clone();
        let node = MoveBase::create(&node, config, |settings| graph.node(settings)).unwrap();
        let qos = Qos::reliable(100);
        let driving = Self {
            commands: stage.user.mailbox("/cmd_vel", qos).unwrap(),
            odometry: stage.user.publisher("/odom", qos).unwrap(),
            goals: stage.user.publisher("/move_base/goal", qos).unwrap(),
            cancels: stage.user.publisher("/move_base/cancel", qos).unwrap(),
            results: stage.user.mailbox("/move_base/result", qos).unwrap(),
            recoveries: stage.user.mailbox("/move_base/recovery_status", qos).unwrap(),
            log: stage.user.mailbox("/rosout", Qos::latched(100)).unwrap(),
            stage,
            node,
            ended: Vec::new(),
            command: Twist2::ZERO,
            is_stuck: false,
            turned_rad: 0.0,
        };
        driving.stage.graph.settle();
        driving
    }

    /// Moves the robot as commanded, in steps of 10 ms.
    pub(crate) fn advance(&mut self, milliseconds: i64) {
        const STEP_S: f64 = 0.01;
        for _ in 0..milliseconds / 10 {
            if let Some(Twist { linear, angular }) = self.commands.latest().as_deref() {
                self.command = Twist2::new(linear.x, linear.y, angular.z);
            }
            let velocity = if self.is_stuck { Twist2::ZERO } else { self.command };
            let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = velocity;
            if let Some(robot) = &mut self.stage.robot {
                let step = Pose2::new(vx_m_s * STEP_S, vy_m_s * STEP_S, wz_rad_s * STEP_S);
                *robot = *robot * step;
                self.turned_rad += wz_rad_s * STEP_S;
            }
            let mut odometry = Odometry::default();
            odometry.twist.twist.linear.x = vx_m_s;
            odometry.twist.twist.angular.z = wz_rad_s;
            self.odometry.publish(odometry);
            self.stage.advance(10);
            self.ended.extend(self.results.drain().iter().map(|result| result.status.clone()));
        }
    }

    /// Sends a goal with an id.
    pub(crate) fn send(&mut self, id: &str, (x, y, yaw_rad): (f64, f64, f64)) {
        let goal = MoveBaseGoal { target_pose: pose_in("map", x, y, yaw_rad) };
        let goal_id = GoalID { stamp: Time::default(), id: id.to_owned() };
        self.goals.publish(MoveBaseActionGoal { goal, goal_id, ..Default::default() });
        self.advance(20);
    }

    /// Cancels a goal, or all for an empty id.
    pub(crate) fn cancel(&mut self, id: &str) {
        self.cancels.publish(GoalID { stamp: Time::default(), id: id.to_owned() });
        self.advance(100);
    }

    /// Runs until the next goal is over, for at most some seconds. Returns its last state.
    pub(crate) fn finish(&mut self, max_s: i64) -> GoalStatus {
        let count = self.ended.len();
        for _ in 0..max_s * 10 {
            self.advance(100);
            if self.ended.len() > count {
                return self.ended[count].clone();
            }
        }
        panic!("no goal is over after {max_s} s, at {:?}: {:#?}", self.robot(), self.logged())
    }

    /// Names of the recoveries that have run since the last call.
    pub(crate) fn recoveries(&self) -> Vec<String> {
        self.recoveries.drain().iter().map(|it| it.recovery_behavior_name.clone()).collect()
    }

    /// Log messages since the last call, at most a hundred.
    pub(crate) fn logged(&self) -> Vec<String> {
        self.log.drain().iter().map(|log| log.msg.clone()).collect()
    }

    pub(crate) fn robot(&self) -> Pose2 {
        self.stage.robot.unwrap()
    }

    pub(crate) fn grid(&self, topic: &str) -> Mailbox<OccupancyGrid> {
        self.stage.user.mailbox(topic, Qos::latched(1)).unwrap()
    }
}
