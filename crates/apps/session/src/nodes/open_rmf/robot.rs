//! A robot with navigation as a robot of a fleet.

use periplus_geometry::Pose2;
use periplus_graph::{
    ActionClient, Actor, GoalProgress, GoalState, Graph, GraphError, Level, Mailbox, Node,
    Publisher, Qos, SentGoal,
};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav2_msgs::{NavigateThroughPoses, NavigateThroughPosesGoal};
use periplus_msgs::rmf_fleet_msgs::{
    DestinationRequest, Location, ModeRequest, PathRequest, PauseRequest, RobotMode, RobotState,
};

use super::OpenRmfMember;
use super::path::RequestedPath;
use crate::nodes::RobotPose;

/// Time between two looks at requests and at the pose \[ns\].
const LOOK_PERIOD_NS: i64 = 100_000_000;

/// Looks between two messages: 2 Hz, as of Open-RMF's slotcar.
const LOOKS_PER_STATE: u64 = 5;

/// Requests that wait.
const DEPTH: usize = 10;

/// Floor of all robots with navigation: their map has one.
const FLOOR: &str = "L1";

/// Charge of a robot whose battery is not simulated \[%\].
const BATTERY_PERCENT: f32 = 100.0;

/// Client of a robot's navigator that follows the requests of a fleet adapter.
pub(super) struct RobotClient {
    fleet: String,
    name: String,
    frame: String,
    pose: RobotPose,
    client: ActionClient<NavigateThroughPoses>,
    states: Publisher<RobotState>,
    requests: Requests,
    /// Request that waits until the navigator is ready and the pose is known.
    waiting: Option<PathRequest>,
    path: RequestedPath,
    goal: Option<SentGoal<NavigateThroughPoses>>,
    pause: Pause,
    task: String,
    request_number: u64,
    has_error: bool,
    looks: u64,
    number: u64,
}

struct Requests {
    paths: Mailbox<PathRequest>,
    destinations: Mailbox<DestinationRequest>,
    modes: Mailbox<ModeRequest>,
    pauses: Mailbox<PauseRequest>,
}

/// Pause that was requested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pause {
    None,
    Now,
    /// At the first point with at least this index.
    At(u64),
}

impl RobotClient {
    /// Creates the node of a robot, in its namespace.
    ///
    /// # Errors
    /// When the graph refuses the node.
    pub(super) fn start(
        graph: &Graph,
        fleet: &str,
        member: &OpenRmfMember<'_>,
    ) -> Result<Actor<Self>, GraphError> {
        let node = member.profile.namespace.node(graph, "periplus_fleet_robot")?;
        let robot = Self {
            fleet: fleet.to_owned(),
            name: member.name.clone(),
            frame: member.estimators.navigation.global_frame(),
            pose: RobotPose::new(&node, member.profile.base())?,
            client: node.action_client("navigate_through_poses")?,
            states: node.publisher("/robot_state", Qos::reliable(DEPTH))?,
            requests: Requests {
                paths: node.mailbox("/robot_path_requests", Qos::reliable(DEPTH))?,
                destinations: node.mailbox("/robot_destination_requests", Qos::reliable(DEPTH))?,
                modes: node.mailbox("/robot_mode_requests", Qos::reliable(DEPTH))?,
                pauses: node.mailbox("/robot_pause_requests", Qos::reliable(DEPTH))?,
            },
            waiting: None,
            path: RequestedPath::default(),
            goal: None,
            pause: Pause::None,
            task: String::new(),
            request_number: 0,
            has_error: false,
            looks: 0,
            number: 0,
        };
        let mut actor = node.actor(robot);
        actor.timer(LOOK_PERIOD_NS, |it, io| it.look(io.node()))?;
        Ok(actor)
    }

    fn look(&mut self, node: &Node) {
        let pose = self.pose.newest_in(&self.frame);
        self.read_requests(pose, node);
        if let Some(pose) = pose {
            self.begin(pose, node);
            self.watch(pose, node);
            self.looks += 1;
            if self.looks.is_multiple_of(LOOKS_PER_STATE) {
                self.publish(pose, node.now_ns());
            }
        }
    }

    fn is_for_this(&self, fleet: &str, robot: &str) -> bool {
        (fleet.is_empty() || fleet == self.fleet) && robot == self.name
    }

    fn read_requests(&mut self, pose: Option<Pose2>, node: &Node) {
        for request in self.requests.paths.drain() {
            if self.is_for_this(&request.fleet_name, &request.robot_name)
                && request.task_id != self.task
            {
                self.waiting = Some((*request).clone());
            }
        }
        for request in self.requests.destinations.drain() {
            if self.is_for_this(&request.fleet_name, &request.robot_name)
                && request.task_id != self.task
            {
                let start = pose.map(|pose| location(pose, 0));
                self.waiting = Some(PathRequest {
                    fleet_name: request.fleet_name.clone(),
                    robot_name: request.robot_name.clone(),
                    path: start.into_iter().chain([request.destination.clone()]).collect(),
                    task_id: request.task_id.clone(),
                });
            }
        }
        for request in self.requests.modes.drain() {
            if self.is_for_this(&request.fleet_name, &request.robot_name) {
                let pause = match request.mode.mode {
                    RobotMode::MODE_PAUSED => Pause::Now,
                    RobotMode::MODE_MOVING => Pause::None,
                    other => {
                        node.log(Level::Warn, format!("`{}` has no mode {other}", self.name));
                        continue;
                    }
                };
                self.set_pause(pause, request.mode.mode_request_id);
            }
        }
        for request in self.requests.pauses.drain() {
            if self.is_for_this(&request.fleet_name, &request.robot_name) {
                let pause = match request.r#type {
                    PauseRequest::TYPE_PAUSE_IMMEDIATELY => Pause::Now,
                    PauseRequest::TYPE_PAUSE_AT_CHECKPOINT => {
                        Pause::At(u64::from(request.at_checkpoint))
                    }
                    _ => Pause::None,
                };
                self.set_pause(pause, request.mode_request_id);
            }
        }
    }

    fn set_pause(&mut self, pause: Pause, request_number: u64) {
        self.request_number = request_number;
        if pause == self.pause {
            return;
        }
        self.pause = pause;
        // What is left of the path is sent again when the robot may go on, up to another point.
        if self.goal.take().is_some() && pause == Pause::Now {
            drop(self.client.cancel_all());
        }
    }

    /// Takes a request that waits, and sends what is left of the path unless the robot pauses.
    fn begin(&mut self, pose: Pose2, node: &Node) {
        if !self.client.is_ready() {
            return;
        }
        if let Some(request) = self.waiting.take() {
            self.task.clone_from(&request.task_id);
            let path = RequestedPath::new(&request.path, pose);
            self.has_error = path.is_err();
            if let Err(why) = &path {
                node.log(
                    Level::Error,
                    format!("path `{}` of `{}` refused: {why}", self.task, self.name),
                );
            }
            if self.goal.take().is_some() && path.is_err() {
                drop(self.client.cancel_all());
            }
            self.path = path.unwrap_or_default();
        }
        let is_held = match self.pause {
            Pause::None => false,
            Pause::Now => true,
            Pause::At(index) => self.path.is_held_at(index, pose),
        };
        if self.goal.is_some() || self.has_error || is_held || self.path.rest().is_empty() {
            return;
        }
        let checkpoint = if let Pause::At(index) = self.pause { Some(index) } else { None };
        let poses = self.path.send(checkpoint).iter().map(|point| {
            let mut pose = PoseStamped::default();
            pose.header.frame_id.clone_from(&self.frame);
            let at = Pose2::new(f64::from(point.x), f64::from(point.y), f64::from(point.yaw));
            pose.pose = periplus_tf_ros::pose(at);
            pose
        });
        let goal = NavigateThroughPosesGoal {
            poses: poses.collect(),
            ..NavigateThroughPosesGoal::default()
        };
        self.goal = Some(self.client.send(goal));
    }

    /// Looks at the goal that is driven to.
    fn watch(&mut self, pose: Pose2, node: &Node) {
        let Some(goal) = &self.goal else { return };
        self.path.pass(pose);
        let failure = match goal.look() {
            GoalProgress::Over(GoalState::Succeeded, _) => {
                self.path.arrive();
                self.goal = None;
                return;
            }
            GoalProgress::Over(GoalState::Canceled, _) => "it was canceled".to_owned(),
            GoalProgress::Over(_, result) => {
                format!("error code {} {}", result.error_code, result.error_msg)
            }
            GoalProgress::Rejected => "the navigator rejects it".to_owned(),
            GoalProgress::Failed(error) => error.to_string(),
            _ => return,
        };
        self.goal = None;
        self.has_error = true;
        node.log(Level::Error, format!("path `{}` of `{}` ends: {failure}", self.task, self.name));
    }

    fn publish(&mut self, pose: Pose2, now_ns: i64) {
        self.number += 1;
        let mode = match self.pause {
            _ if self.has_error => RobotMode::MODE_ADAPTER_ERROR,
            _ if self.goal.is_some() => RobotMode::MODE_MOVING,
            Pause::Now => RobotMode::MODE_PAUSED,
            Pause::At(_) if !self.path.rest().is_empty() => RobotMode::MODE_PAUSED,
            _ => RobotMode::MODE_IDLE,
        };
        self.states.publish(RobotState {
            name: self.name.clone(),
            model: String::new(),
            task_id: self.task.clone(),
            seq: self.number,
            mode: RobotMode { mode, mode_request_id: self.request_number, ..RobotMode::default() },
            battery_percent: BATTERY_PERCENT,
            location: location(pose, now_ns),
            path: self.path.rest().to_vec(),
        });
    }
}

fn location(pose: Pose2, now_ns: i64) -> Location {
    #[expect(clippy::cast_possible_truncation, reason = "the message has single precision")]
    Location {
        t: Time::of_ns(now_ns),
        x: pose.x_m as f32,
        y: pose.y_m as f32,
        yaw: pose.yaw_rad as f32,
        level_name: FLOOR.to_owned(),
        ..Location::default()
    }
}
