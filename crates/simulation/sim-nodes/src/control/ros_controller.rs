//! Controllers as nodes.

use periplus_graph::{Level, Node, Parameters};
use periplus_params::ParamValues;
use periplus_ros2_control::{
    BaseMotion, ControlCycle, ControlRelease, ControllerError, ControllerInterface, ControllerKind,
    InterfaceSelection, LoanedInterfaces,
};

use super::plugin::GivenParameters;
use crate::DeviceState;

/// A controller with its node.
pub(super) trait RosController: ControllerInterface + Send {
    /// Motion of the robot's base by the wheels, if it drives them.
    fn base_motion(&self) -> Option<BaseMotion> {
        None
    }

    /// Parts that its node shares with all controllers.
    fn part(&self) -> &ControllerNode;

    /// Saves the state with messages that wait.
    fn save(&self) -> DeviceState;

    /// Restores a state; false for that of another kind.
    fn restore(&mut self, saved: &DeviceState) -> bool;
}

/// Node of a controller with its parameters.
pub(super) struct ControllerNode {
    pub(super) node: Node,
    pub(super) parameters: Parameters,
    pub(super) kind: ControllerKind,
    pub(super) release: ControlRelease,
    /// Namespace in the plugin, for prefixes of frames.
    pub(super) namespace: String,
    /// Parameters that were given when it was loaded.
    pub(super) given: GivenParameters,
}

impl ControllerNode {
    pub(super) fn values(&self) -> ParamValues {
        self.parameters.values()
    }

    pub(super) fn warn(&self, text: impl std::fmt::Display) {
        self.node.log(Level::Warn, text);
    }

    /// Returns the name of a frame with the prefix of the parameters `tf_frame_prefix` and
    /// `tf_frame_prefix_enable`: by default the namespace.
    pub(super) fn frame(&self, frame: &str, prefix: &str, is_enabled: bool) -> String {
        if !is_enabled {
            return frame.to_owned();
        }
        let prefix = if prefix.is_empty() { &self.namespace } else { prefix };
        match prefix.trim_matches('/') {
            "" => frame.to_owned(),
            prefix => format!("{prefix}/{frame}"),
        }
    }
}

impl ControllerInterface for Box<dyn RosController> {
    fn command_interfaces(&self) -> InterfaceSelection {
        (**self).command_interfaces()
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        (**self).state_interfaces()
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        (**self).configure()
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        (**self).activate(interfaces, cycle)
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        (**self).update(interfaces, cycle)
    }

    fn deactivate(&mut self, interfaces: &mut LoanedInterfaces<'_>) {
        (**self).deactivate(interfaces);
    }
}
