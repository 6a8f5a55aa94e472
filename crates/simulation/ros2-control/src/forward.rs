//! Commands that are forwarded to interfaces: `forward_command_controller` and the groups of
//! `position_controllers`, `velocity_controllers` and `effort_controllers`.

use crate::{
    ControlCycle, ControllerError, ControllerInterface, InterfaceSelection, LoanedInterfaces,
};

/// Forwards one number to each interface.
///
/// Source: `forward_controllers_base.cpp` of `ros2_controllers`.
#[derive(Clone, Debug, PartialEq)]
pub struct ForwardController {
    interfaces: Vec<String>,
    commands: Option<Vec<f64>>,
}

impl ForwardController {
    /// Creates a controller of the same interface of several joints.
    #[must_use]
    pub fn new(joints: &[String], interface: &str) -> Self {
        let interfaces = joints.iter().map(|joint| format!("{joint}/{interface}")).collect();
        Self { interfaces, commands: None }
    }

    /// Receives commands in the order of the joints.
    ///
    /// # Errors
    /// The reason, when their number or a value is wrong; the last commands then stay.
    pub fn receive(&mut self, commands: &[f64]) -> Result<(), ControllerError> {
        if commands.len() != self.interfaces.len() {
            let (given, wanted) = (commands.len(), self.interfaces.len());
            return Err(format!("{given} commands for {wanted} interfaces are ignored").into());
        }
        if !commands.iter().all(|command| command.is_finite()) {
            return Err("a command is not a number; all are ignored".into());
        }
        self.commands = Some(commands.to_vec());
        Ok(())
    }
}

impl ControllerInterface for ForwardController {
    fn command_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Named(self.interfaces.clone())
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Nothing
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        if self.interfaces.is_empty() {
            return Err("`joints` is empty".into());
        }
        Ok(())
    }

    fn activate(
        &mut self,
        _: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.commands = None;
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        for (index, &command) in self.commands.iter().flatten().enumerate() {
            interfaces.set_command(index, command);
        }
        Ok(())
    }
}
