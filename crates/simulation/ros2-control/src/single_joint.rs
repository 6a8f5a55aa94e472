//! Controllers of one joint of ROS 1: `position_controllers/JointPositionController` and the like.

use crate::{
    ControlCycle, ControllerError, ControllerInterface, InterfaceSelection, JointInterfaceKind,
    LoanedInterfaces, PidController, PidGains,
};

/// Quantity that a [`SingleJointController`] controls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointTarget {
    /// The command is forwarded to the interface.
    Forward(JointInterfaceKind),
    /// A PID controller holds a position by efforts.
    PositionByEffort(PidGains),
    /// A PID controller holds a speed by efforts.
    VelocityByEffort(PidGains),
}

/// Controls one joint.
///
/// Source: `ros_controllers`: `forward_command_controller`, `effort_controllers`.
#[derive(Clone, Debug, PartialEq)]
pub struct SingleJointController {
    joint: String,
    target: JointTarget,
    command: Option<f64>,
    pid: PidController,
}

impl SingleJointController {
    /// Creates an inactive controller.
    #[must_use]
    pub fn new(joint: impl Into<String>, target: JointTarget) -> Self {
        Self { joint: joint.into(), target, command: None, pid: PidController::default() }
    }

    /// Receives a command; one that is not finite is ignored.
    pub fn receive(&mut self, command: f64) {
        if command.is_finite() {
            self.command = Some(command);
        }
    }
}

impl ControllerInterface for SingleJointController {
    fn command_interfaces(&self) -> InterfaceSelection {
        let kind = match self.target {
            JointTarget::Forward(kind) => kind,
            _ => JointInterfaceKind::Effort,
        };
        InterfaceSelection::Named(vec![kind.of(&self.joint)])
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Named(vec![
            JointInterfaceKind::Position.of(&self.joint),
            JointInterfaceKind::Velocity.of(&self.joint),
        ])
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        if self.joint.is_empty() {
            return Err("`joint` is empty".into());
        }
        Ok(())
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.pid.reset();
        // A position is held from the start, as in ROS 1.
        self.command = match self.target {
            JointTarget::Forward(JointInterfaceKind::Position)
            | JointTarget::PositionByEffort(_) => {
                Some(interfaces.state(0)).filter(|position| position.is_finite())
            }
            _ => Some(0.0),
        };
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let Some(command) = self.command else { return Ok(()) };
        let (position, velocity) = (interfaces.state(0), interfaces.state(1));
        let value = match &self.target {
            JointTarget::Forward(_) => command,
            JointTarget::PositionByEffort(gains) => {
                self.pid.update(gains, command - position, -velocity, cycle.period_s)
            }
            JointTarget::VelocityByEffort(gains) => {
                self.pid.update(gains, command - velocity, 0.0, cycle.period_s)
            }
        };
        interfaces.set_command(0, value);
        Ok(())
    }
}
