//! Controllers of one joint of ROS 1.

use periplus_graph::{Mailbox, Qos, Sample};
use periplus_msgs::std_msgs::Float64;
use periplus_ros2_control::{
    ControlCycle, ControllerError, ControllerInterface, ControllerKind, InterfaceSelection,
    JointInterfaceKind, JointTarget, LoanedInterfaces, PidGains, SingleJointController,
    SingleJointParams,
};

use crate::DeviceState;
use crate::control::ros_controller::{ControllerNode, RosController};

/// `position_controllers/JointPositionController` and the like, with the topic `command`.
pub(super) struct SingleJointNode {
    part: ControllerNode,
    running: Option<(SingleJointController, Mailbox<Float64>)>,
}

impl SingleJointNode {
    pub(super) fn new(part: ControllerNode) -> Self {
        Self { part, running: None }
    }
}

impl ControllerInterface for SingleJointNode {
    fn command_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|(joint, _)| joint.command_interfaces()).unwrap_or_default()
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|(joint, _)| joint.state_interfaces()).unwrap_or_default()
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        self.running = None;
        let SingleJointParams { joint, p, i, d, i_clamp } =
            SingleJointParams::from_values(&self.part.values());
        let gains = PidGains { p, i, d, i_clamp };
        let target = match self.part.kind {
            ControllerKind::JointPositionByEffort => JointTarget::PositionByEffort(gains),
            ControllerKind::JointVelocityByEffort => JointTarget::VelocityByEffort(gains),
            ControllerKind::JointVelocity => JointTarget::Forward(JointInterfaceKind::Velocity),
            ControllerKind::JointEffort => JointTarget::Forward(JointInterfaceKind::Effort),
            _ => JointTarget::Forward(JointInterfaceKind::Position),
        };
        let mut controller = SingleJointController::new(joint, target);
        controller.configure()?;
        let inbox = self.part.node.mailbox("~/command", Qos::reliable(1));
        self.running = Some((controller, inbox.map_err(|error| error.to_string())?));
        Ok(())
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some((joint, inbox)) = &mut self.running else {
            return Err("it is not configured".into());
        };
        drop(inbox.drain());
        joint.activate(interfaces, cycle)
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some((joint, inbox)) = &mut self.running else { return Ok(()) };
        if let Some(message) = inbox.latest() {
            joint.receive(message.data);
        }
        joint.update(interfaces, cycle)
    }
}

impl RosController for SingleJointNode {
    fn part(&self) -> &ControllerNode {
        &self.part
    }

    fn save(&self) -> DeviceState {
        let running = self.running.as_ref();
        DeviceState::new(running.map(|(joint, inbox)| (joint.clone(), inbox.pending())))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(saved) = saved.get::<Option<(SingleJointController, Vec<Sample>)>>() else {
            return false;
        };
        if let (Some((joint, inbox)), Some((state, pending))) = (&mut self.running, saved) {
            joint.clone_from(state);
            inbox.set_pending(pending);
        }
        true
    }
}
