//! Drives: velocity commands in, odometry out.

use periplus_graph::{Mailbox, Publisher, Qos, Sample};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::std_srvs::{Empty, EmptyResponse};
use periplus_ros2_control::{
    BaseMotion, ControlCycle, ControllerError, ControllerInterface, DiffDriveController,
    InterfaceSelection, LoanedInterfaces, MecanumController, PlanarPose, PlanarTwist,
    ReferenceOutcome, SteeringController, TricycleController,
};

use super::odometry_output::{OdometryOutput, OdometryTopics, twist_message};
use crate::DeviceState;
use crate::control::factory::KnownJoints;
use crate::control::ros_controller::{ControllerNode, RosController};
use crate::drives::RateTimer;

/// A drive of `periplus-ros2-control`.
pub(super) trait VelocityDrive: ControllerInterface + Clone + Send + Sync + 'static {
    fn receive(&mut self, twist: PlanarTwist, stamp: Option<i64>, now_ns: i64) -> ReferenceOutcome;
    fn odometry(&self) -> (PlanarPose, PlanarTwist);
    fn base_motion(&self) -> BaseMotion;
    /// Limited command, of drives that publish it.
    fn limited(&self) -> PlanarTwist;
    /// Resets the odometry, of drives with a service for it.
    fn reset_odometry(&mut self) {}
}

impl VelocityDrive for DiffDriveController {
    fn receive(&mut self, twist: PlanarTwist, stamp: Option<i64>, now_ns: i64) -> ReferenceOutcome {
        self.receive(twist, stamp, now_ns)
    }

    fn odometry(&self) -> (PlanarPose, PlanarTwist) {
        (self.odometry.pose, self.odometry.twist)
    }

    fn base_motion(&self) -> BaseMotion {
        self.base_motion()
    }

    fn limited(&self) -> PlanarTwist {
        self.limited_command()
    }
}

impl VelocityDrive for SteeringController {
    fn receive(&mut self, twist: PlanarTwist, stamp: Option<i64>, now_ns: i64) -> ReferenceOutcome {
        self.receive(twist, stamp, now_ns)
    }

    fn odometry(&self) -> (PlanarPose, PlanarTwist) {
        (self.odometry.pose, self.odometry.twist)
    }

    fn base_motion(&self) -> BaseMotion {
        self.base_motion()
    }

    fn limited(&self) -> PlanarTwist {
        PlanarTwist::default()
    }
}

impl VelocityDrive for TricycleController {
    fn receive(&mut self, twist: PlanarTwist, stamp: Option<i64>, now_ns: i64) -> ReferenceOutcome {
        self.receive(twist, stamp, now_ns)
    }

    fn odometry(&self) -> (PlanarPose, PlanarTwist) {
        (self.odometry.pose, self.odometry.twist)
    }

    fn base_motion(&self) -> BaseMotion {
        self.base_motion()
    }

    fn limited(&self) -> PlanarTwist {
        PlanarTwist::default()
    }

    fn reset_odometry(&mut self) {
        self.reset_odometry();
    }
}

impl VelocityDrive for MecanumController {
    fn receive(&mut self, twist: PlanarTwist, stamp: Option<i64>, now_ns: i64) -> ReferenceOutcome {
        self.receive(twist, stamp, now_ns)
    }

    fn odometry(&self) -> (PlanarPose, PlanarTwist) {
        (self.pose, self.twist)
    }

    fn base_motion(&self) -> BaseMotion {
        self.base_motion()
    }

    fn limited(&self) -> PlanarTwist {
        self.limited_command()
    }
}

/// Topics of a drive.
#[derive(Clone, Debug)]
pub(super) struct DriveTopics {
    /// Topic of `TwistStamped`.
    pub(super) stamped: Option<&'static str>,
    /// Topic of `Twist`.
    pub(super) plain: Option<&'static str>,
    /// Topic of the limited command.
    pub(super) limited: Option<&'static str>,
    /// Service that resets the odometry.
    pub(super) reset: Option<&'static str>,
    pub(super) odometry: OdometryTopics,
    /// Remarks about the parameters.
    pub(super) notes: Vec<String>,
}

/// Reads the parameters of a drive.
pub(super) type Configure<D> =
    fn(&ControllerNode, &KnownJoints) -> Result<(D, DriveTopics), String>;

/// Drive with its node.
pub(super) struct DriveNode<D> {
    part: ControllerNode,
    joints: KnownJoints,
    configure: Configure<D>,
    running: Option<RunningDrive<D>>,
}

struct RunningDrive<D> {
    state: DriveState<D>,
    stamped: Option<Mailbox<TwistStamped>>,
    plain: Option<Mailbox<Twist>>,
    limited: Option<Publisher<TwistStamped>>,
    reset: Option<periplus_graph::Calls<Empty>>,
    odometry: OdometryOutput,
}

#[derive(Clone)]
struct DriveState<D> {
    drive: D,
    timer: RateTimer,
    /// True after a warning about a stamp of zero.
    has_warned: bool,
}

struct SavedDrive<D> {
    state: DriveState<D>,
    pending: [Vec<Sample>; 2],
}

impl<D: VelocityDrive> DriveNode<D> {
    pub(super) fn new(part: ControllerNode, joints: KnownJoints, configure: Configure<D>) -> Self {
        Self { part, joints, configure, running: None }
    }

    fn open(&self) -> Result<RunningDrive<D>, String> {
        let (mut drive, topics) = (self.configure)(&self.part, &self.joints)?;
        drive.configure().map_err(|error| error.to_string())?;
        topics.notes.iter().for_each(|note| self.part.warn(note));
        let node = &self.part.node;
        let qos = Qos::reliable(10);
        let made = || -> Result<RunningDrive<D>, periplus_graph::GraphError> {
            let odometry = OdometryOutput::new(node, topics.odometry.clone())?;
            Ok(RunningDrive {
                stamped: topics.stamped.map(|topic| node.mailbox(topic, qos)).transpose()?,
                plain: topics.plain.map(|topic| node.mailbox(topic, qos)).transpose()?,
                limited: topics.limited.map(|topic| node.publisher(topic, qos)).transpose()?,
                reset: topics.reset.map(|name| node.server(name)).transpose()?,
                state: DriveState {
                    drive: drive.clone(),
                    timer: odometry.timer(node.now_ns()),
                    has_warned: false,
                },
                odometry,
            })
        };
        made().map_err(|error| error.to_string())
    }
}

impl<D: VelocityDrive> RunningDrive<D> {
    fn receive(&mut self, now_ns: i64, part: &ControllerNode) {
        let state = &mut self.state;
        for message in self.stamped.iter().flat_map(Mailbox::drain) {
            let stamp_ns = message.header.stamp.ns();
            match state.drive.receive(planar(&message.twist), Some(stamp_ns), now_ns) {
                ReferenceOutcome::Accepted => {}
                ReferenceOutcome::StampedNow if state.has_warned => {}
                ReferenceOutcome::StampedNow => {
                    state.has_warned = true;
                    part.warn(
                        "a velocity command has the time stamp zero; the current time is used",
                    );
                }
                ReferenceOutcome::TooOld => {
                    part.warn("a velocity command is older than the timeout and ignored");
                }
                ReferenceOutcome::NotFinite => {
                    part.warn("a velocity command is not a number and ignored");
                }
            }
        }
        for message in self.plain.iter().flat_map(Mailbox::drain) {
            if state.drive.receive(planar(&message), None, now_ns) == ReferenceOutcome::NotFinite {
                part.warn("a velocity command is not a number and ignored");
            }
        }
        while let Some(call) = self.reset.as_ref().and_then(periplus_graph::Calls::take) {
            state.drive.reset_odometry();
            call.answer(EmptyResponse::default());
        }
    }

    fn publish(&mut self, time_ns: i64) {
        if let Some(limited) = self.limited.as_ref().filter(|limited| limited.is_heard()) {
            let twist = twist_message(self.state.drive.limited());
            limited.publish(TwistStamped { header: Header::at(time_ns, ""), twist });
        }
        if self.state.timer.due(time_ns) {
            let (pose, twist) = self.state.drive.odometry();
            self.odometry.publish(time_ns, pose, twist);
        }
    }
}

fn planar(twist: &Twist) -> PlanarTwist {
    PlanarTwist { x_m_s: twist.linear.x, y_m_s: twist.linear.y, yaw_rad_s: twist.angular.z }
}

impl<D: VelocityDrive> ControllerInterface for DriveNode<D> {
    fn command_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|running| running.state.drive.command_interfaces()).unwrap_or_default()
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|running| running.state.drive.state_interfaces()).unwrap_or_default()
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        // The old topics end first, so that the new ones can have other types.
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
        // Commands to an inactive controller are ignored.
        running.stamped.iter().for_each(|inbox| drop(inbox.drain()));
        running.plain.iter().for_each(|inbox| drop(inbox.drain()));
        running.state.timer = running.odometry.timer(cycle.time_ns);
        running.state.drive.activate(interfaces, cycle)
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some(running) = &mut self.running else { return Ok(()) };
        running.receive(cycle.time_ns, &self.part);
        running.state.drive.update(interfaces, cycle)?;
        running.publish(cycle.time_ns);
        Ok(())
    }

    fn deactivate(&mut self, interfaces: &mut LoanedInterfaces<'_>) {
        if let Some(running) = &mut self.running {
            running.state.drive.deactivate(interfaces);
        }
    }
}

impl<D: VelocityDrive> RosController for DriveNode<D> {
    fn base_motion(&self) -> Option<BaseMotion> {
        self.running.as_ref().map(|running| running.state.drive.base_motion())
    }

    fn part(&self) -> &ControllerNode {
        &self.part
    }

    fn save(&self) -> DeviceState {
        let saved = self.running.as_ref().map(|running| SavedDrive {
            state: running.state.clone(),
            pending: [
                running.stamped.as_ref().map(Mailbox::pending).unwrap_or_default(),
                running.plain.as_ref().map(Mailbox::pending).unwrap_or_default(),
            ],
        });
        DeviceState::new(saved)
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(saved) = saved.get::<Option<SavedDrive<D>>>() else { return false };
        let (Some(running), Some(saved)) = (&mut self.running, saved) else {
            return saved.is_none();
        };
        running.state.clone_from(&saved.state);
        running.stamped.iter().for_each(|inbox| inbox.set_pending(&saved.pending[0]));
        running.plain.iter().for_each(|inbox| inbox.set_pending(&saved.pending[1]));
        true
    }
}
