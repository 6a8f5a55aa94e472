//! Work of the node: one goal at a time, cycle by cycle, in the states of `move_base`.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{Io, Level, Transition};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::move_base_msgs::{MoveBaseFeedback, MoveBaseGoal, RecoveryStatus};
use periplus_msgs::std_msgs::Header;
use periplus_tf_ros::{pose, pose2};

use super::control::ControlOutcome;
use super::job::{Job, JobState, RecoveryTrigger};
use super::node::MoveBase;
use super::recovery::RecoveryKind;
use crate::loop_rate::LoopRate;

/// Continuation after a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CycleOutcome {
    /// The next cycle follows in its time.
    Continue,
    /// The goal is over.
    Over,
}

fn seconds(from_ns: i64, to_ns: i64) -> f64 {
    (to_ns - from_ns) as f64 / 1e9
}

impl MoveBase {
    /// Begins the work on the goal that waits, unless another one runs: that is preempted in the next cycle.
    pub(super) fn start(&mut self, io: &mut Io<'_, Self>) {
        while self.job.is_none() && self.server.has_new_goal() {
            let Some(goal) = self.server.accept_new_goal(io.now_ns()) else { return };
            if self.params.shutdown_costmaps {
                for costmap in [&self.global_costmap, &self.local_costmap] {
                    costmap.lifecycle().change_now(Transition::Activate);
                }
            }
            self.job = self.job_of(&goal, io);
            if self.job.is_some() {
                let hertz = self.params.controller_frequency_hz;
                self.cycle(LoopRate::of_hertz(hertz, io.now_ns()), io);
            }
        }
    }

    /// Creates the work on a goal; a goal that is no pose is aborted.
    fn job_of(&mut self, goal: &MoveBaseGoal, io: &mut Io<'_, Self>) -> Option<Job> {
        let now_ns = io.now_ns();
        if let Err(why) = pose2(&goal.target_pose.pose) {
            let text =
                format!("Aborting on goal because it was sent with an invalid quaternion: {why}");
            self.abort(&text, io);
            return None;
        }
        let mut job = Job::new(goal.target_pose.clone(), now_ns);
        self.publish_zero(io);
        // Without a transform, the plans fail with that reason.
        let shown = match self.global_goal(&mut job) {
            Ok(global_goal) => {
                let header = self.global_header(now_ns);
                PoseStamped { header, pose: pose(global_goal) }
            }
            Err(_) => job.goal.clone(),
        };
        self.outputs.current_goal.publish(shown);
        Some(job)
    }

    fn global_header(&self, now_ns: i64) -> Header {
        self.global_costmap.with(|costmap| Header::at(now_ns, &costmap.params().global_frame))
    }

    /// Goal in the frame of the global costmap, by the newest transform at the first success.
    fn global_goal(&self, job: &mut Job) -> Result<Pose2, String> {
        if let Some(goal) = job.global_goal {
            return Ok(goal);
        }
        let own = pose2(&job.goal.pose).map_err(|error| error.to_string())?;
        let frame = job.goal.header.frame_id.trim_start_matches('/');
        let goal = self.global_costmap.with(|costmap| costmap.global_pose_of(frame, own, 0))?;
        job.global_goal = Some(goal);
        Ok(goal)
    }

    /// Runs a cycle and schedules the next one, or ends the work.
    fn cycle(&mut self, mut rate: LoopRate, io: &mut Io<'_, Self>) {
        let Some(mut job) = self.job.take() else { return };
        match self.step(&mut job, io) {
            CycleOutcome::Continue => {
                self.job = Some(job);
                let next_ns = rate.next(io.now_ns());
                let alarm = io.alarm(next_ns, move |state, io| {
                    state.cycle(rate, io);
                    state.start(io);
                });
                self.running = Some(alarm);
            }
            CycleOutcome::Over => self.rest(io),
        }
    }

    /// Stops the robot at the end of a goal.
    pub(super) fn rest(&mut self, io: &mut Io<'_, Self>) {
        self.running = None;
        self.job = None;
        self.publish_zero(io);
        self.local_planner.controller.reset();
        self.end_slow_motion(io.node());
        if self.params.shutdown_costmaps {
            for costmap in [&self.global_costmap, &self.local_costmap] {
                costmap.lifecycle().change_now(Transition::Deactivate);
            }
        }
    }

    pub(super) fn publish_zero(&self, io: &mut Io<'_, Self>) {
        self.outputs.publish_velocity(io.node(), Twist2::ZERO);
    }

    fn abort(&mut self, text: &str, io: &mut Io<'_, Self>) {
        io.node().log(Level::Error, text);
        self.server.abort(text, io.now_ns());
    }

    /// One cycle.
    fn step(&mut self, job: &mut Job, io: &mut Io<'_, Self>) -> CycleOutcome {
        let now_ns = io.now_ns();
        if self.server.is_preempt_requested() {
            let Some(goal) = self.server.accept_new_goal(now_ns) else {
                self.server.preempt("", now_ns);
                return CycleOutcome::Over;
            };
            match self.job_of(&goal, io) {
                Some(new) => *job = new,
                None => return CycleOutcome::Over,
            }
            if self.server.is_preempt_requested() {
                // It was cancelled while it waited.
                self.server.preempt("", now_ns);
                return CycleOutcome::Over;
            }
        }
        self.observe(job, io);
        let is_due = self.params.planner_frequency_hz > 0.0 && now_ns >= job.next_plan_ns;
        let replans = job.state == JobState::Controlling && is_due;
        if job.state == JobState::Planning || replans {
            self.make_plan(job, io);
        }
        match job.state {
            JobState::Planning => CycleOutcome::Continue,
            JobState::Controlling => self.drive(job, io),
            JobState::Clearing => self.recover(job, io),
        }
    }

    /// Publishes the pose of the robot, and notes if it gets ahead.
    fn observe(&mut self, job: &mut Job, io: &mut Io<'_, Self>) {
        let now_ns = io.now_ns();
        let Ok(robot) = self.global_costmap.with(|it| Self::robot_in(it, now_ns)) else { return };
        let header = self.global_header(now_ns);
        let base_position = PoseStamped { header, pose: pose(robot) };
        self.server.publish_feedback(MoveBaseFeedback { base_position }, now_ns);
        self.check_slow_motion(robot, io.node());
        let distance_m = self.params.oscillation_distance_m;
        let has_moved = job.moved_from.is_none_or(|from| {
            libm::hypot(robot.x_m - from.x_m, robot.y_m - from.y_m) >= distance_m
        });
        if has_moved {
            job.last_move_ns = now_ns;
            job.moved_from = Some(robot);
            job.forget_recoveries(RecoveryTrigger::Oscillation);
        }
    }

    fn make_plan(&mut self, job: &mut Job, io: &mut Io<'_, Self>) {
        let now_ns = io.now_ns();
        let hertz = self.params.planner_frequency_hz;
        if hertz > 0.0 {
            job.next_plan_ns = now_ns + (1e9 / hertz) as i64;
        }
        let planned = self.global_goal(job).and_then(|goal| self.plan(None, goal, io.node()));
        match planned {
            Ok((header, plan)) => {
                job.last_plan_ns = now_ns;
                job.failed_plan_count = 0;
                job.plan_frame = header.frame_id;
                job.forget_recoveries(RecoveryTrigger::Planning);
                self.local_planner.set_plan(&plan);
                job.state = JobState::Controlling;
            }
            Err(why) => {
                self.log.report(&Diagnostic::warning("no-plan", &why), io.node());
                if job.state != JobState::Planning {
                    // The robot goes on with the old plan.
                    return;
                }
                job.last_failure = why;
                job.failed_plan_count += 1;
                let max_count = self.params.max_planning_retries;
                let is_too_often = max_count >= 0 && job.failed_plan_count > max_count;
                let is_too_long =
                    seconds(job.last_plan_ns, now_ns) > self.params.planner_patience_s;
                if is_too_often || is_too_long {
                    self.publish_zero(io);
                    job.start_clearing(RecoveryTrigger::Planning);
                }
            }
        }
    }

    fn drive(&mut self, job: &mut Job, io: &mut Io<'_, Self>) -> CycleOutcome {
        let now_ns = io.now_ns();
        if let Some(why) = self.local_costmap.with(|costmap| costmap.delay(now_ns)) {
            let text = format!("the robot waits for the local costmap: {why}");
            self.log.report(&Diagnostic::warning("late-costmap", text), io.node());
            self.publish_zero(io);
            return CycleOutcome::Continue;
        }
        let timeout_s = self.params.oscillation_timeout_s;
        let is_oscillating = timeout_s > 0.0 && seconds(job.last_move_ns, now_ns) > timeout_s;
        match self.control(&job.plan_frame, io.node()) {
            Ok(ControlOutcome::Reached) => {
                io.node().log(Level::Info, "Goal reached.");
                self.server.succeed("Goal reached.", now_ns);
                return CycleOutcome::Over;
            }
            _ if is_oscillating => {
                let distance_m = self.params.oscillation_distance_m;
                job.last_failure =
                    format!("the robot has not moved {distance_m} m within {timeout_s} s");
                self.publish_zero(io);
                job.start_clearing(RecoveryTrigger::Oscillation);
            }
            Ok(ControlOutcome::Velocity(velocity)) => {
                job.last_control_ns = now_ns;
                self.outputs.publish_velocity(io.node(), velocity);
                job.forget_recoveries(RecoveryTrigger::Controlling);
            }
            Err(why) => {
                self.log.report(&Diagnostic::warning("no-velocity", &why), io.node());
                job.last_failure = why;
                self.publish_zero(io);
                if seconds(job.last_control_ns, now_ns) > self.params.controller_patience_s {
                    job.start_clearing(RecoveryTrigger::Controlling);
                } else {
                    job.start_planning(now_ns);
                }
            }
        }
        CycleOutcome::Continue
    }

    /// Runs the next recovery, or aborts the goal after the last one.
    fn recover(&mut self, job: &mut Job, io: &mut Io<'_, Self>) -> CycleOutcome {
        let now_ns = io.now_ns();
        let count = self.recoveries.len();
        let next = self.recoveries.get(job.recovery_index).cloned();
        let Some(recovery) = next.filter(|_| self.params.recovery_behavior_enabled) else {
            let text = format!("{} Last reason: {}", job.trigger.text(), job.last_failure);
            self.abort(&text, io);
            return CycleOutcome::Over;
        };
        if job.rotation.is_none() {
            let text = format!("recovery `{}`: {}", recovery.name, job.last_failure);
            io.node().log(Level::Warn, text);
            self.publish_recovery(job, &recovery.name, count, now_ns);
        }
        match &recovery.kind {
            RecoveryKind::Clear(params) | RecoveryKind::ClearBeyondRobot(params) => {
                self.clear_costmaps(params, io.node());
            }
            RecoveryKind::MoveSlow(params) => self.move_slowly(params, io.node()),
            RecoveryKind::Rotate(params, limits) => {
                let mut rotation = job.rotation.take().unwrap_or_default();
                let rate = self.local_costmap.with(|costmap| {
                    let robot = Self::robot_in(costmap, now_ns)?;
                    let view = costmap.view().ok_or("the local costmap is not configured")?;
                    rotation.rate_rad_s(robot, &view, params, *limits)
                });
                match rate {
                    Ok(Some(rate_rad_s)) => {
                        job.rotation = Some(rotation);
                        let velocity = Twist2::new(0.0, 0.0, rate_rad_s);
                        self.outputs.publish_velocity(io.node(), velocity);
                        return CycleOutcome::Continue;
                    }
                    Ok(None) => {}
                    Err(why) => {
                        let text = format!("recovery `{}` ends: {why}", recovery.name);
                        io.node().log(Level::Error, text);
                    }
                }
                self.publish_zero(io);
            }
        }
        job.recovery_index += 1;
        job.last_move_ns = now_ns;
        job.start_planning(now_ns);
        CycleOutcome::Continue
    }

    fn publish_recovery(&self, job: &Job, name: &str, count: usize, now_ns: i64) {
        let robot = self.global_costmap.with(|it| Self::robot_in(it, now_ns)).unwrap_or_default();
        let header = self.global_header(now_ns);
        self.outputs.recovery_status.publish(RecoveryStatus {
            pose_stamped: PoseStamped { header, pose: pose(robot) },
            current_recovery_number: u16::try_from(job.recovery_index).unwrap_or(u16::MAX),
            total_number_of_recoveries: u16::try_from(count).unwrap_or(u16::MAX),
            recovery_behavior_name: name.to_owned(),
        });
    }
}
