//! Data that the navigator shares with the nodes of its trees.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

use periplus_behavior_tree::{PathGeometry, TreeContext, TreeValue};
use periplus_costmap::Nav2Release;
use periplus_geometry::{DQuat, Pose};
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::{Odometry, Path};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::{geometry_msgs, tf2_msgs};
use periplus_tf::TransformKind;
use periplus_tf_ros::{Frames, pose};

use super::parameters::BtNavigatorParams;
use super::paths;
use super::status::ServerError;

/// Maximum number of transforms queued between two ticks.
const TF_DEPTH: usize = 1000;
/// Maximum number of odometry messages queued between two ticks.
const ODOM_DEPTH: usize = 100;
/// Maximum number of goals whose cancellation goes on after the end of the navigator's goal; a server that never
/// answers leaves one for each call.
const MAX_FORGOTTEN_COUNT: usize = 64;
/// One second in nanoseconds.
const SECOND_NS: f64 = 1e9;

/// Goal of an action that was canceled and is not over yet.
pub(super) trait CancelingGoal: Send {
    /// Continues the cancellation; true once the goal is over.
    fn is_over(&mut self) -> bool;
}

/// Access of tree nodes to the graph, the robot and the settings.
pub(super) struct Shared {
    pub(super) node: Node,
    pub(super) release: Nav2Release,
    pub(super) params: BtNavigatorParams,
    inputs: Mutex<Inputs>,
    canceling: Mutex<Vec<Box<dyn CancelingGoal>>>,
    /// Goals of which the navigator no longer awaits the end. One that its server accepts late is still canceled.
    forgotten: Mutex<VecDeque<Box<dyn CancelingGoal>>>,
    last_error: Mutex<Option<ServerError>>,
    last_outcome: Mutex<String>,
}

struct Inputs {
    frames: Frames,
    moving: Mailbox<tf2_msgs::TFMessage>,
    fixed: Mailbox<tf2_msgs::TFMessage>,
    odometry: Mailbox<Odometry>,
    /// Messages within the filter duration.
    recent: VecDeque<Odometry>,
}

/// Locks data that no panic can leave inconsistent.
pub(super) fn lock<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Shared {
    pub(super) fn new(
        node: &Node,
        release: Nav2Release,
        params: BtNavigatorParams,
    ) -> Result<Self, GraphError> {
        let inputs = Inputs {
            frames: Frames::default(),
            moving: node.mailbox("/tf", Qos::reliable(TF_DEPTH))?,
            fixed: node.mailbox("/tf_static", Qos::latched(TF_DEPTH))?,
            odometry: node.mailbox(&params.odom_topic, Qos::best_effort(ODOM_DEPTH))?,
            recent: VecDeque::new(),
        };
        Ok(Self {
            node: node.clone(),
            release,
            params,
            inputs: Mutex::new(inputs),
            canceling: Mutex::default(),
            forgotten: Mutex::default(),
            last_error: Mutex::default(),
            last_outcome: Mutex::default(),
        })
    }

    /// Processes received transforms and odometry, and continues the cancellation of forgotten goals.
    pub(super) fn receive(&self) {
        lock(&self.forgotten).retain_mut(|goal| !goal.is_over());
        let inputs = &mut *lock(&self.inputs);
        for (mailbox, kind) in
            [(&inputs.fixed, TransformKind::Fixed), (&inputs.moving, TransformKind::Moving)]
        {
            for message in mailbox.drain() {
                inputs.frames.take(&message, kind);
            }
        }
        for message in inputs.odometry.drain() {
            inputs.recent.push_back((*message).clone());
        }
        let Some(newest) = inputs.recent.back() else { return };
        let oldest_ns = newest.header.stamp.ns() - self.params.filter_duration_ns();
        while inputs.recent.len() > 1
            && inputs.recent.front().is_some_and(|first| first.header.stamp.ns() < oldest_ns)
        {
            inputs.recent.pop_front();
        }
    }

    /// Drops what was received before a jump of time.
    pub(super) fn forget(&self) {
        let inputs = &mut *lock(&self.inputs);
        let _ = inputs.moving.drain();
        let _ = inputs.odometry.drain();
        inputs.frames.forget();
        inputs.recent.clear();
    }

    /// Mean velocity over the filter duration: x, y \[m/s\] and yaw \[rad/s\].
    pub(super) fn mean_velocity(&self) -> [f64; 3] {
        let inputs = lock(&self.inputs);
        let mut sum = [0.0; 3];
        for message in &inputs.recent {
            let twist = &message.twist.twist;
            for (sum, value) in
                sum.iter_mut().zip([twist.linear.x, twist.linear.y, twist.angular.z])
            {
                *sum += value;
            }
        }
        let count = inputs.recent.len().max(1) as f64;
        sum.map(|sum| sum / count)
    }

    /// Newest odometry.
    pub(super) fn odometry(&self) -> Option<Odometry> {
        lock(&self.inputs).recent.back().cloned()
    }

    /// Pose of the robot in a frame; empty names are the frames of the parameters.
    ///
    /// # Errors
    /// The missing transform.
    pub(super) fn robot_pose(&self, frame: &str, base: &str) -> Result<PoseStamped, String> {
        let or = |name: &str, usual: &str| {
            if name.is_empty() { usual.to_owned() } else { name.to_owned() }
        };
        let frame = or(frame, &self.params.global_frame);
        let base = or(base, &self.params.robot_base_frame);
        let inputs = lock(&self.inputs);
        let missing = |_| {
            let reason = inputs.frames.missing(&frame, &base);
            format!("the pose of `{base}` in `{frame}` is not available: {reason}")
        };
        let (frame_from_base, time_ns) = inputs.frames.at(&frame, &base, 0).map_err(missing)?;
        Ok(PoseStamped { header: Header::at(time_ns, &frame), pose: pose(frame_from_base) })
    }

    /// True if a transform between two frames is available.
    pub(super) fn has_transform(&self, target: &str, source: &str) -> bool {
        lock(&self.inputs).frames.at(target, source, 0).is_ok()
    }

    /// Transforms a pose to a frame. Its stamp may be newer than the newest transform by the tolerance.
    ///
    /// # Errors
    /// The missing transform.
    pub(super) fn transformed(
        &self,
        from: &PoseStamped,
        frame: &str,
    ) -> Result<PoseStamped, String> {
        if periplus_tf_ros::plain(&from.header.frame_id) == periplus_tf_ros::plain(frame) {
            return Ok(from.clone());
        }
        let source = &from.header.frame_id;
        let stamp_ns = from.header.stamp.ns();
        let inputs = lock(&self.inputs);
        let found = inputs.frames.at(frame, source, stamp_ns).or_else(|error| {
            let tolerance_ns = (self.params.transform_tolerance_s * SECOND_NS) as i64;
            let newest = inputs.frames.at(frame, source, 0)?;
            let is_near = (0..=tolerance_ns).contains(&(stamp_ns - newest.1));
            if is_near { Ok(newest) } else { Err(error) }
        });
        let (frame_from_source, _) = found.map_err(|error| {
            let reason = inputs.frames.missing(frame, source);
            format!("no transform from `{source}` to `{frame}`: {error}; {reason}")
        })?;
        let geometry_msgs::Pose { position: p, orientation: q } = &from.pose;
        let rotation = DQuat::from_xyzw(q.x, q.y, q.z, q.w);
        let source_from_goal = Pose::from_xyz_quaternion([p.x, p.y, p.z], rotation);
        let header = Header { stamp: Time::of_ns(stamp_ns), frame_id: frame.to_owned() };
        Ok(PoseStamped { header, pose: pose(frame_from_source * source_from_goal) })
    }

    /// Cancels a goal, and keeps it until it is over.
    pub(super) fn add_canceling(&self, mut goal: impl CancelingGoal + 'static) {
        if !goal.is_over() {
            lock(&self.canceling).push(Box::new(goal));
        }
    }

    /// True while a canceled goal is not over.
    pub(super) fn is_canceling(&self) -> bool {
        let mut canceling = lock(&self.canceling);
        canceling.retain_mut(|goal| !goal.is_over());
        !canceling.is_empty()
    }

    /// Stops waiting for canceled goals. Their cancellation goes on.
    pub(super) fn forget_canceling(&self) {
        let mut forgotten = lock(&self.forgotten);
        forgotten.extend(lock(&self.canceling).drain(..));
        let surplus = forgotten.len().saturating_sub(MAX_FORGOTTEN_COUNT);
        forgotten.drain(..surplus);
    }

    /// Error that a server answered last; none after a success of that server.
    pub(super) fn last_error(&self) -> Option<ServerError> {
        lock(&self.last_error).clone()
    }

    pub(super) fn report_error(&self, error: ServerError) {
        *lock(&self.last_error) = Some(error);
    }

    pub(super) fn report_success(&self, server: &str) {
        let mut last = lock(&self.last_error);
        if last.as_ref().is_some_and(|error| error.server == server) {
            *last = None;
        }
    }

    /// Outcome of the last goal, in words; empty before the first one.
    pub(super) fn last_outcome(&self) -> String {
        lock(&self.last_outcome).clone()
    }

    pub(super) fn report_outcome(&self, outcome: &str) {
        outcome.clone_into(&mut lock(&self.last_outcome));
    }

    pub(super) fn clear_error(&self) {
        *lock(&self.last_error) = None;
    }
}

/// Context of a tick.
pub(super) struct Context<'a>(pub(super) &'a Shared);

impl TreeContext for Context<'_> {
    fn robot_position_m(&mut self, global: Option<&str>, base: Option<&str>) -> Option<[f64; 2]> {
        let pose = self.0.robot_pose(global.unwrap_or_default(), base.unwrap_or_default()).ok()?;
        Some([pose.pose.position.x, pose.pose.position.y])
    }

    fn speed_m_s(&mut self) -> f64 {
        let [x, y, _] = self.0.mean_velocity();
        libm::hypot(x, y)
    }

    fn path_geometry(&mut self, path: &TreeValue) -> Option<PathGeometry> {
        path.get::<Path>().map(paths::geometry)
    }
}
