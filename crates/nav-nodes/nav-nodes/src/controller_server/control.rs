//! Control loop: one goal at a time, cycle by cycle.

use periplus_controllers::path::{distance_m, nearest_index, plan_length_m};
use periplus_controllers::{ControlError, ControlInput, ControlReport, GoalQuery, GoalStatus};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{Io, Level};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav2_msgs::TrackingFeedback;
use periplus_msgs::nav2_msgs_main::{FollowPathFeedback, FollowPathResult};
use periplus_msgs::std_msgs::Header;
use periplus_tf_ros::pose;

use super::job::{ControlFailure, Job};
use super::node::ControllerServer;
use super::reports::ReportFrames;
use super::tracking::deviation;
use crate::costmap_2d::{CostmapNode, blame};
use crate::loop_rate::LoopRate;

/// Interval at which a cycle looks if the costmap is current \[ns\] (`rclcpp::Rate r(100)`).
const COSTMAP_POLL_NS: i64 = 10_000_000;

/// Time for which the robot obeys its last velocity while a cycle waits for the costmap \[ns\], the usual
/// `costmap_update_timeout`. Humble waits without a limit.
const MAX_BLIND_NS: i64 = 300_000_000;

/// Code of the message about a low speed.
const SLOW: &str = "slow-control";

/// Continuation after a cycle.
enum CycleOutcome {
    /// The next cycle follows in its time.
    Continue,
    /// The cycle waits for the costmap.
    Wait,
    /// The goal is over.
    Over,
}

/// Poses of a cycle, in the frame of the costmap.
struct CyclePoses {
    robot: Pose2,
    goal: Pose2,
    costmap_from_plan: Pose2,
}

impl ControllerServer {
    /// Begins the work on the current goal, and on those that follow it until one has to wait.
    pub(super) fn start(&mut self, io: &mut Io<'_, Self>) {
        while let Some(goal) = self.server.current_goal() {
            io.node().log(Level::Info, "Received a goal, begin computing control effort.");
            match Job::new(&mut self.plugins, &goal, self.release, io.now_ns()) {
                Ok(job) => {
                    if let Some(outputs) = &self.outputs {
                        outputs.publish_received(&job.path);
                    }
                    self.job = Some(job);
                    let hertz = self.params.controller_frequency_hz;
                    if self.cycle(LoopRate::of_hertz(hertz, io.now_ns()), io) {
                        return;
                    }
                }
                Err(failure) => self.fail(failure, io),
            }
            if !self.server.finish() {
                return;
            }
        }
    }

    /// Runs a cycle and schedules the next one. Returns false if the goal is over.
    fn cycle(&mut self, mut rate: LoopRate, io: &mut Io<'_, Self>) -> bool {
        let outcome = match self.job.take() {
            Some(mut job) => {
                let outcome = self.control(&mut job, io).unwrap_or_else(|failure| {
                    self.fail(failure, io);
                    CycleOutcome::Over
                });
                self.job = Some(job);
                outcome
            }
            None => CycleOutcome::Over,
        };
        let next_ns = match outcome {
            CycleOutcome::Continue => rate.next(io.now_ns()),
            CycleOutcome::Wait => io.now_ns() + COSTMAP_POLL_NS,
            CycleOutcome::Over => {
                self.running = None;
                self.job = None;
                return false;
            }
        };
        let alarm = io.alarm(next_ns, move |state, io| {
            if !state.cycle(rate, io) && state.server.finish() {
                state.start(io);
            }
        });
        self.running = Some((rate, alarm));
        true
    }

    /// One cycle.
    fn control(
        &mut self,
        job: &mut Job,
        io: &mut Io<'_, Self>,
    ) -> Result<CycleOutcome, ControlFailure> {
        if self.server.is_cancel_requested() {
            if self.plugins.controllers[job.plugins.controller].controller.cancel() {
                let text = "Cancellation was successful. Stopping the robot.";
                io.node().log(Level::Info, text);
                self.server.terminate_all(FollowPathResult::default());
                self.exit(true, io);
                return Ok(CycleOutcome::Over);
            }
            let text = "Waiting for the controller to finish cancellation";
            self.log.report(&Diagnostic::hint("waits-for-cancel", text), io.node());
        }
        if self.waits_for_costmap(job, io.now_ns())? {
            let is_blind = job.waits_since_ns.is_some_and(|it| io.now_ns() - it >= MAX_BLIND_NS);
            if is_blind && !std::mem::replace(&mut job.is_stopped, true) {
                self.publish_zero(io.node());
            }
            return Ok(CycleOutcome::Wait);
        }
        self.take_pending(job, io)?;
        let poses = self.poses(job, io.now_ns())?;
        // Main selects the local plan before the goal is checked.
        let is_main = self.release == Nav2Release::Main;
        let mut plan = Vec::new();
        if is_main {
            plan = self.local_plan(job, &poses)?;
            self.show_plan(&plan, io.now_ns());
        }
        let velocity = self.params.thresholded(self.odometry);
        let checker = &mut self.plugins.goal_checkers[job.plugins.goal_checker].1;
        let query = GoalQuery { pose: poses.robot, goal: poses.goal, velocity, plan: &plan };
        let status = checker.check(&query);
        if status == GoalStatus::Reached {
            io.node().log(Level::Info, "Reached the goal!");
            self.exit(false, io);
            self.server.succeeded_current(FollowPathResult::default());
            return Ok(CycleOutcome::Over);
        }
        if let Some(index) = job.plugins.progress_checker {
            let checker = &mut self.plugins.progress_checkers[index].1;
            checker.check(io.now_ns(), poses.robot).map_err(|failure| {
                let code = FollowPathResult::FAILED_TO_MAKE_PROGRESS;
                ControlFailure::new(code, failure.to_string())
            })?;
        }
        if !is_main {
            plan = self.local_plan(job, &poses)?;
            self.show_plan(&plan, io.now_ns());
        }
        let command = self.command(job, &poses, &plan, status, io)?;
        self.publish(job, &poses, command, io);
        Ok(CycleOutcome::Continue)
    }

    /// Returns true if the cycle has to wait for the costmap.
    fn waits_for_costmap(&self, job: &mut Job, now_ns: i64) -> Result<bool, ControlFailure> {
        let timeout_s = self.params.costmap_update_timeout_s;
        let delay = self.costmap.with(|costmap| {
            let delay = costmap.delay(now_ns)?;
            // Without the pose of the robot, the goal fails with that reason.
            costmap.robot_pose(now_ns).is_ok().then_some(delay)
        });
        let is_ignored = timeout_s <= 0.0 && self.release == Nav2Release::Main;
        let Some(why) = delay.filter(|_| !is_ignored) else {
            (job.waits_since_ns, job.is_stopped) = (None, false);
            return Ok(false);
        };
        let since_ns = *job.waits_since_ns.get_or_insert(now_ns);
        let waited_s = (now_ns - since_ns) as f64 / 1e9;
        if self.release > Nav2Release::Humble && waited_s > timeout_s {
            let text = format!("Costmap timed out waiting for update: {why}");
            return Err(ControlFailure::new(FollowPathResult::CONTROLLER_TIMED_OUT, text));
        }
        Ok(true)
    }

    /// Takes the path of a goal that preempts.
    fn take_pending(&mut self, job: &mut Job, io: &mut Io<'_, Self>) -> Result<(), ControlFailure> {
        if !self.server.is_preempt_requested() {
            return Ok(());
        }
        let Some(goal) = self.server.accept_pending_goal() else { return Ok(()) };
        io.node().log(Level::Info, "Passing new path to controller.");
        job.preempt(&mut self.plugins, &goal, self.release)?;
        if let Some(outputs) = &self.outputs {
            outputs.publish_received(&job.path);
        }
        Ok(())
    }

    fn poses(&self, job: &Job, now_ns: i64) -> Result<CyclePoses, ControlFailure> {
        let failed = |text| ControlFailure::new(FollowPathResult::TF_ERROR, text);
        self.costmap.with(|costmap| {
            let robot = costmap.robot_pose(now_ns).map_err(|finding| {
                let help: String = finding.help.iter().map(|help| format!("; {help}")).collect();
                failed(format!("Failed to obtain robot pose: {}{help}", finding.message))
            })?;
            let frame = &job.path.header.frame_id;
            let costmap_from_plan =
                costmap.global_pose_of(frame, Pose2::IDENTITY, 0).map_err(|why| {
                    failed(format!("Failed to transform end pose to global frame: {why}"))
                })?;
            let end = job.plan.last().copied().unwrap_or_default();
            Ok(CyclePoses { robot, goal: costmap_from_plan * end, costmap_from_plan })
        })
    }

    fn local_plan(&mut self, job: &Job, poses: &CyclePoses) -> Result<Vec<Pose2>, ControlFailure> {
        let info = self.costmap.with(|costmap| costmap.view().map(|view| *view.costs.info()));
        let (Some(handler), Some(info)) = (self.plugins.handler(job.plugins), info) else {
            let text = "there is no path handler or no costmap";
            return Err(ControlFailure::new(FollowPathResult::UNKNOWN, text));
        };
        handler
            .local_plan(poses.robot, poses.costmap_from_plan, &info)
            .map_err(|error| failure_of(&error))
    }

    fn show_plan(&self, plan: &[Pose2], now_ns: i64) {
        let Some(outputs) = &self.outputs else { return };
        let header =
            self.costmap.with(|costmap| Header::at(now_ns, &costmap.params().global_frame));
        outputs.publish_local_plan(&header, plan);
    }

    /// Velocity of a cycle: zero while a controller that finds none is tolerated.
    fn command(
        &mut self,
        job: &mut Job,
        poses: &CyclePoses,
        plan: &[Pose2],
        status: GoalStatus,
        io: &mut Io<'_, Self>,
    ) -> Result<Twist2, ControlFailure> {
        let now_ns = io.now_ns();
        let slot = &mut self.plugins.controllers[job.plugins.controller];
        let tolerance = self.plugins.goal_checkers[job.plugins.goal_checker].1.tolerance();
        let velocity = self.params.thresholded(self.odometry);
        let (outputs, log, node) = (&mut self.outputs, &mut self.log, io.node());
        let computed = self.costmap.with(|costmap: &mut CostmapNode| {
            let Some(view) = costmap.view() else {
                return Err(ControlError::Unknown("the costmap is not configured".to_owned()));
            };
            let computed = slot.controller.compute_velocity(&ControlInput {
                time_ns: now_ns,
                pose: poses.robot,
                velocity,
                costmap: view,
                plan,
                goal: poses.goal,
                tolerance,
                is_position_reached: status >= GoalStatus::AtPosition,
            });
            let report = slot.controller.report();
            if let Some(outputs) = outputs {
                let params = costmap.params();
                let frames = ReportFrames {
                    base: Header::at(now_ns, &params.robot_base_frame),
                    global: Header::at(now_ns, &params.global_frame),
                };
                outputs.reports.publish(&report, &frames);
            }
            if let ControlReport::Samples(report) = report
                && computed.is_ok()
                && !log.was_reported(SLOW, now_ns)
                && let Some(reason) = report.0.explain_speed()
            {
                log.report(&Diagnostic::hint(SLOW, reason), node);
            }
            let blocked = report.blocked().and_then(|blocked| blocked.cell);
            let layer = blocked.and_then(|cell| blame(costmap.costmap()?, cell));
            computed.map_err(|error| match (error, layer) {
                (ControlError::NoValidControl(text), Some(layer)) => {
                    ControlError::NoValidControl(format!("{text}; the cell comes from {layer}"))
                }
                (error, _) => error,
            })
        });
        match computed {
            Ok(command) => {
                job.last_valid_ns = now_ns;
                Ok(command)
            }
            // Another attempt cannot help with other errors.
            Err(ControlError::NoValidControl(text)) if self.params.failure_tolerance_s != 0.0 => {
                let tolerance_s = self.params.failure_tolerance_s;
                let since_s = (now_ns - job.last_valid_ns) as f64 / 1e9;
                if tolerance_s != -1.0 && since_s > tolerance_s {
                    let text = format!("Controller patience exceeded after {since_s:.2} s: {text}");
                    return Err(ControlFailure::new(FollowPathResult::PATIENCE_EXCEEDED, text));
                }
                self.log.report(&Diagnostic::warning("no-valid-control", text), io.node());
                Ok(Twist2::ZERO)
            }
            Err(error) => Err(failure_of(&error)),
        }
    }

    /// Publishes the velocity and the feedback of a cycle.
    fn publish(&self, job: &mut Job, poses: &CyclePoses, command: Twist2, io: &mut Io<'_, Self>) {
        let Some(outputs) = &self.outputs else { return };
        let (global, base) = self.costmap.with(|costmap| {
            let params = costmap.params();
            (params.global_frame.clone(), params.robot_base_frame.clone())
        });
        outputs.publish_velocity(io.node(), &base, command);
        let robot_in_plan = poses.costmap_from_plan.inverse() * poses.robot;
        let mut tracking = TrackingFeedback::default();
        if self.release < Nav2Release::Main {
            let nearest = nearest_index(&job.plan, robot_in_plan);
            tracking.distance_to_goal = plan_length_m(&job.plan[nearest..]) as f32;
            tracking.speed = command.speed_m_s() as f32;
        } else if let Some(deviation) =
            deviation(&job.plan, robot_in_plan, job.segment, self.params.search_window_m)
        {
            job.segment = deviation.segment;
            let header = Header::at(io.now_ns(), &global);
            tracking = TrackingFeedback {
                position_tracking_error: deviation.distance_m as f32,
                heading_tracking_error: deviation.heading_rad as f32,
                current_path_index: u32::try_from(deviation.segment).unwrap_or(u32::MAX),
                robot_pose: PoseStamped { header: header.clone(), pose: pose(poses.robot) },
                distance_to_goal: distance_m(poses.robot, poses.goal) as f32,
                speed: self.params.thresholded(self.odometry).speed_m_s() as f32,
                remaining_path_length: deviation.remaining_m as f32,
                header,
            };
            outputs.publish_tracking(&tracking);
        }
        self.server.publish_feedback(FollowPathFeedback { tracking_feedback: tracking });
    }

    /// Ends the current goal with an error.
    fn fail(&mut self, failure: ControlFailure, io: &mut Io<'_, Self>) {
        io.node().log(Level::Error, &failure.text);
        self.exit(true, io);
        let ControlFailure { code, text } = failure;
        let result = FollowPathResult { error_code: code, error_msg: text, ..Default::default() };
        self.server.terminate_current(result);
    }

    /// Stops the robot at the end of a goal. Main does so after a failure in any case.
    fn exit(&mut self, is_forced: bool, io: &mut Io<'_, Self>) {
        let is_forced = is_forced && self.release == Nav2Release::Main;
        if self.params.publish_zero_velocity || is_forced {
            self.publish_zero(io.node());
        }
        self.plugins.reset_controllers();
    }
}

/// Error code of an error of a controller.
fn failure_of(error: &ControlError) -> ControlFailure {
    let code = match error {
        ControlError::InvalidPath(_) => FollowPathResult::INVALID_PATH,
        ControlError::Transform(_) => FollowPathResult::TF_ERROR,
        ControlError::NoValidControl(_) => FollowPathResult::NO_VALID_CONTROL,
        ControlError::InvalidController(_) => FollowPathResult::INVALID_CONTROLLER,
        ControlError::Unknown(_) => FollowPathResult::UNKNOWN,
    };
    ControlFailure::new(code, error.to_string())
}
