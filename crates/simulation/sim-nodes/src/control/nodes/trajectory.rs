//! Follower of joint trajectories, by topic and by action.

use periplus_graph::{
    ActionServer, ActionSettings, GoalHandle, GraphError, Level, Mailbox, Publisher, Qos, Sample,
};
use periplus_msgs::control_msgs::{
    FollowJointTrajectory, FollowJointTrajectoryFeedback, FollowJointTrajectoryResult,
    JointTrajectoryControllerState,
};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::trajectory_msgs;
use periplus_ros2_control::{
    ControlCycle, ControlRelease, ControllerError, ControllerInterface, GoalTolerances,
    InterfaceSelection, JointConstraintParams, JointGainParams, JointInterfaceKind,
    JointTolerances, JointTrajectoryController, JointTrajectoryParams, JointTrajectorySettings,
    LoanedInterfaces, PidGains, TrajectoryOutcome,
};

use super::trajectory_messages::{point, tolerances, trajectory};
use crate::DeviceState;
use crate::control::factory::KnownJoints;
use crate::control::ros_controller::{ControllerNode, RosController};
use crate::drives::RateTimer;

/// `joint_trajectory_controller`. A goal that is executed ends as canceled when a snapshot is
/// restored.
pub(super) struct TrajectoryNode {
    part: ControllerNode,
    joints: KnownJoints,
    running: Option<RunningTrajectory>,
}

struct RunningTrajectory {
    state: TrajectoryState,
    inbox: Mailbox<trajectory_msgs::JointTrajectory>,
    actions: ActionServer<FollowJointTrajectory>,
    goal: Option<GoalHandle<FollowJointTrajectory>>,
    publisher: Publisher<JointTrajectoryControllerState>,
}

#[derive(Clone)]
struct TrajectoryState {
    follower: JointTrajectoryController,
    feedback_timer: RateTimer,
    state_timer: RateTimer,
}

impl TrajectoryNode {
    pub(super) fn new(part: ControllerNode, joints: KnownJoints) -> Self {
        Self { part, joints, running: None }
    }

    fn settings(&self) -> Result<(JointTrajectorySettings, JointTrajectoryParams), String> {
        let values = self.part.values();
        let params = JointTrajectoryParams::from_values(&values);
        let kinds =
            |names: &[String], parameter: &str| -> Result<Vec<JointInterfaceKind>, String> {
                let one = |name: &String| {
                    JointInterfaceKind::of_name(name).ok_or_else(|| {
                        format!("`{parameter}` contains `{name}`, which is not supported")
                    })
                };
                names.iter().map(one).collect()
            };
        let (command_interfaces, state_interfaces) = if self.part.release.is_ros1() {
            let states = vec![JointInterfaceKind::Position, JointInterfaceKind::Velocity];
            (vec![self.ros1_kind()], states)
        } else {
            (
                kinds(&params.command_interfaces, "command_interfaces")?,
                kinds(&params.state_interfaces, "state_interfaces")?,
            )
        };
        let mut settings = JointTrajectorySettings {
            joints: params.joints.clone(),
            command_joints: if params.command_joints.is_empty() {
                params.joints.clone()
            } else {
                params.command_joints.clone()
            },
            command_interfaces,
            state_interfaces,
            allows_partial_goals: params.allow_partial_joints_goal,
            allows_velocity_at_end: params
                .allow_nonzero_velocity_at_trajectory_end
                .unwrap_or(self.part.release <= ControlRelease::Humble),
            integrates: params.allow_integration_in_goal_trajectories,
            interpolates: params.interpolation_method != "none",
            begins_at_command: params.open_loop_control || params.interpolate_from_desired_state,
            tolerances: GoalTolerances { goal_time_s: params.goal_time_s, ..Default::default() },
            ..JointTrajectorySettings::default()
        };
        for joint in &params.joints {
            let constraints = values.group(&format!("constraints.{joint}"));
            let constraints = constraints.map(JointConstraintParams::from_values);
            let constraints = constraints.unwrap_or_default();
            settings
                .tolerances
                .path
                .push(JointTolerances { position: constraints.trajectory, velocity: 0.0 });
            settings.tolerances.goal.push(JointTolerances {
                position: constraints.goal,
                velocity: params.stopped_velocity_tolerance,
            });
            let gains = values.group(&format!("gains.{joint}")).map(JointGainParams::from_values);
            let gains = gains.unwrap_or_default();
            settings.gains.push(PidGains {
                p: gains.p,
                i: gains.i,
                d: gains.d,
                i_clamp: gains.i_clamp.unwrap_or_default(),
            });
            settings.feed_forward.push(gains.ff_velocity_scale);
            let is_free = self.joints.get(joint).is_some_and(|joint| joint.is_continuous);
            settings.is_continuous.push(gains.angle_wraparound.unwrap_or(is_free));
        }
        Ok((settings, params))
    }

    /// Commanded interface of ROS 1, by the class.
    fn ros1_kind(&self) -> JointInterfaceKind {
        let class = super::super::plugin::text_of(&self.part.given, "type").unwrap_or_default();
        match class.split('/').next() {
            Some("velocity_controllers") => JointInterfaceKind::Velocity,
            Some("effort_controllers") => JointInterfaceKind::Effort,
            _ => JointInterfaceKind::Position,
        }
    }

    fn open(&self) -> Result<RunningTrajectory, String> {
        let (settings, params) = self.settings()?;
        let mut follower = JointTrajectoryController::new(settings);
        follower.configure().map_err(|error| error.to_string())?;
        let node = &self.part.node;
        let is_ros1 = self.part.release.is_ros1();
        let (input, output) = if is_ros1 {
            ("~/command", "~/state")
        } else {
            ("~/joint_trajectory", "~/controller_state")
        };
        let rate_hz = if self.part.release <= ControlRelease::Humble {
            params.state_publish_rate_hz
        } else {
            0.0
        };
        let now_ns = node.now_ns();
        let made = || -> Result<RunningTrajectory, GraphError> {
            Ok(RunningTrajectory {
                inbox: node.mailbox(input, Qos::reliable(10))?,
                actions: node
                    .action_server("~/follow_joint_trajectory", ActionSettings::default())?,
                goal: None,
                publisher: node.publisher(output, Qos::reliable(10))?,
                state: TrajectoryState {
                    follower: follower.clone(),
                    feedback_timer: RateTimer::for_publisher(params.action_monitor_rate_hz, now_ns),
                    state_timer: RateTimer::for_publisher(rate_hz, now_ns),
                },
            })
        };
        made().map_err(|error| error.to_string())
    }
}

fn ended(code: i32, text: impl Into<String>) -> FollowJointTrajectoryResult {
    FollowJointTrajectoryResult { error_code: code, error_string: text.into() }
}

impl RunningTrajectory {
    fn receive(&mut self, part: &ControllerNode, now_ns: i64) {
        let follower = &mut self.state.follower;
        for message in self.inbox.drain() {
            match follower.start(&trajectory(&message), None, now_ns) {
                Ok(()) => preempt(&mut self.goal, "replaced by a trajectory on the topic"),
                Err(rejection) => part.warn(format!("trajectory refused: {}", rejection.reason)),
            }
        }
        while let Some(goal) = self.actions.take() {
            let settings = follower.settings();
            let limits = tolerances(&settings.tolerances, &settings.joints, goal.goal());
            let wanted = trajectory(&goal.goal().trajectory);
            match follower.start(&wanted, Some(limits), now_ns) {
                Ok(()) => {
                    preempt(&mut self.goal, "replaced by a new goal");
                    self.goal = goal.accept();
                    if let Some(goal) = &self.goal {
                        goal.execute();
                    }
                }
                Err(rejection) => {
                    part.warn(format!("trajectory refused: {}", rejection.reason));
                    goal.reject();
                }
            }
        }
        if self.goal.as_ref().is_some_and(GoalHandle::is_canceling) {
            follower.hold(now_ns);
            if let Some(goal) = self.goal.take() {
                goal.canceled(ended(0, "canceled; the joints hold their positions"));
            }
        }
    }

    fn publish(&mut self, part: &ControllerNode, now_ns: i64) {
        let TrajectoryState { follower, feedback_timer, state_timer } = &mut self.state;
        let names = follower.settings().joints.clone();
        let progress = &follower.progress;
        let is_due = feedback_timer.due(now_ns);
        if let Some(goal) = self.goal.as_ref().filter(|_| is_due) {
            goal.feedback(FollowJointTrajectoryFeedback {
                header: Header::at(now_ns, ""),
                joint_names: names.clone(),
                desired: point(&progress.desired),
                actual: point(&progress.actual),
                error: point(&progress.error),
                ..FollowJointTrajectoryFeedback::default()
            });
        }
        if state_timer.due(now_ns) && self.publisher.is_heard() {
            self.publisher.publish(JointTrajectoryControllerState {
                header: Header::at(now_ns, ""),
                joint_names: names,
                reference: point(&progress.desired),
                feedback: point(&progress.actual),
                error: point(&progress.error),
                output: point(&progress.output),
                speed_scaling_factor: 1.0,
                ..JointTrajectoryControllerState::default()
            });
        }
        match follower.take_outcome() {
            Some(TrajectoryOutcome::Reached) => {
                if let Some(goal) = self.goal.take() {
                    goal.succeed(ended(0, "goal reached"));
                }
            }
            Some(TrajectoryOutcome::Failed(code, reason)) => {
                part.warn(format!("trajectory aborted: {reason}"));
                if let Some(goal) = self.goal.take() {
                    goal.abort(ended(code.number(), reason));
                }
            }
            None => {}
        }
    }
}

fn preempt(goal: &mut Option<GoalHandle<FollowJointTrajectory>>, why: &str) {
    if let Some(goal) = goal.take() {
        goal.abort(ended(-1, format!("the goal was {why}")));
    }
}

impl ControllerInterface for TrajectoryNode {
    fn command_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|running| running.state.follower.command_interfaces()).unwrap_or_default()
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|running| running.state.follower.state_interfaces()).unwrap_or_default()
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        self.running = None;
        self.running = Some(self.open()?);
        Ok(())
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some(running) = &mut self.running else { return Err("it is not configured".into()) };
        drop(running.inbox.drain());
        running.state.feedback_timer.restart(cycle.time_ns);
        running.state.state_timer.restart(cycle.time_ns);
        running.state.follower.activate(interfaces, cycle)
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some(running) = &mut self.running else { return Ok(()) };
        running.receive(&self.part, cycle.time_ns);
        running.state.follower.update(interfaces, cycle)?;
        running.publish(&self.part, cycle.time_ns);
        Ok(())
    }

    fn deactivate(&mut self, interfaces: &mut LoanedInterfaces<'_>) {
        let Some(running) = &mut self.running else { return };
        if running.goal.is_some() {
            self.part.node.log(Level::Info, "the goal is aborted: the controller is deactivated");
        }
        preempt(&mut running.goal, "aborted: the controller was deactivated");
        running.state.follower.deactivate(interfaces);
    }
}

impl RosController for TrajectoryNode {
    fn part(&self) -> &ControllerNode {
        &self.part
    }

    fn save(&self) -> DeviceState {
        let running = self.running.as_ref();
        DeviceState::new(running.map(|running| (running.state.clone(), running.inbox.pending())))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(saved) = saved.get::<Option<(TrajectoryState, Vec<Sample>)>>() else {
            return false;
        };
        if let (Some(running), Some((state, pending))) = (&mut self.running, saved) {
            running.goal = None;
            running.state.clone_from(state);
            running.inbox.set_pending(pending);
        }
        true
    }
}
