//! Forwarded commands.

use periplus_graph::{Mailbox, Qos, Sample};
use periplus_msgs::std_msgs::Float64MultiArray;
use periplus_ros2_control::{
    ControlCycle, ControllerError, ControllerInterface, ControllerKind, ForwardCommandParams,
    ForwardController, InterfaceSelection, LoanedInterfaces,
};

use crate::DeviceState;
use crate::control::ros_controller::{ControllerNode, RosController};

/// `forward_command_controller` and the groups of positions, velocities and efforts.
pub(super) struct ForwardNode {
    part: ControllerNode,
    running: Option<(ForwardController, Mailbox<Float64MultiArray>)>,
}

impl ForwardNode {
    pub(super) fn new(part: ControllerNode) -> Self {
        Self { part, running: None }
    }
}

impl ControllerInterface for ForwardNode {
    fn command_interfaces(&self) -> InterfaceSelection {
        let running = self.running.as_ref();
        running.map(|(forward, _)| forward.command_interfaces()).unwrap_or_default()
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Nothing
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        self.running = None;
        let params = ForwardCommandParams::from_values(&self.part.values());
        let interface = match self.part.kind {
            ControllerKind::GroupPosition => "position",
            ControllerKind::GroupVelocity => "velocity",
            ControllerKind::GroupEffort => "effort",
            _ if params.interface_name.is_empty() => {
                return Err("`interface_name` is empty".into());
            }
            _ => &params.interface_name,
        };
        let mut forward = ForwardController::new(&params.joints, interface);
        forward.configure()?;
        let topic = if self.part.release.is_ros1() { "~/command" } else { "~/commands" };
        let inbox = self.part.node.mailbox(topic, Qos::reliable(10));
        self.running = Some((forward, inbox.map_err(|error| error.to_string())?));
        Ok(())
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some((forward, inbox)) = &mut self.running else {
            return Err("it is not configured".into());
        };
        drop(inbox.drain());
        forward.activate(interfaces, cycle)
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some((forward, inbox)) = &mut self.running else { return Ok(()) };
        if let Some(message) = inbox.latest()
            && let Err(reason) = forward.receive(&message.data)
        {
            self.part.warn(reason);
        }
        forward.update(interfaces, cycle)
    }
}

impl RosController for ForwardNode {
    fn part(&self) -> &ControllerNode {
        &self.part
    }

    fn save(&self) -> DeviceState {
        let running = self.running.as_ref();
        DeviceState::new(running.map(|(forward, inbox)| (forward.clone(), inbox.pending())))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(saved) = saved.get::<Option<(ForwardController, Vec<Sample>)>>() else {
            return false;
        };
        if let (Some((forward, inbox)), Some((state, pending))) = (&mut self.running, saved) {
            forward.clone_from(state);
            inbox.set_pending(pending);
        }
        true
    }
}
