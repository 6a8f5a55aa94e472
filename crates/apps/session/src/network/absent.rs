//! Networks of a session in WebAssembly: there are none.

use std::fmt;
use std::io;
use std::time::Duration;

use periplus_graph::Graph;
use periplus_sim::{Services, Simulation};

use crate::error::RunError;

macro_rules! absent {
    ($(#[$doc:meta])* $visible:vis $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        $visible enum $name {}

        impl fmt::Display for $name {
            fn fmt(&self, _: &mut fmt::Formatter<'_>) -> fmt::Result {
                match *self {}
            }
        }
    };
}

absent! {
    /// Error of DDS.
    pub DdsError
}
absent! {
    /// Error of Gazebo Transport.
    pub GzTransportError
}
absent! {
    /// Visibility of a session on Gazebo Transport.
    pub GazeboSettings
}
absent! {
    /// Visibility of a session on ROS 2.
    pub Ros2Reach
}
absent! {
    /// Error of ROS 1.
    pub Ros1Error
}
absent! {
    /// Visibility of a session on ROS 1.
    pub Ros1Reach
}
absent! {
    /// Parameter of ROS 1.
    pub Ros1Value
}
absent! {
    /// Connection of a run to ROS 1 programs.
    pub(crate) Ros1Connection
}
absent! {
    /// Connection of a run to Gazebo programs.
    pub(crate) GazeboConnection
}

impl GazeboConnection {
    pub(crate) fn join(
        _: &Simulation,
        _: &mut Services,
        settings: GazeboSettings,
        _: bool,
    ) -> Result<Self, RunError> {
        match settings {}
    }

    pub(crate) fn print_findings(self) -> io::Result<()> {
        match self {}
    }
}

impl Ros1Connection {
    pub(crate) fn join(
        _: &Graph,
        reach: Ros1Reach,
        _: Vec<(String, Ros1Value)>,
        _: bool,
    ) -> Result<Self, RunError> {
        match reach {}
    }

    pub(crate) fn is_due(self, _: Duration) -> bool {
        match self {}
    }

    pub(crate) fn print_findings(self) -> io::Result<()> {
        match self {}
    }
}

/// Connection of a session to ROS 2: there is none.
#[derive(Default)]
pub(crate) struct Ros2Connection;

impl Ros2Connection {
    pub(crate) fn join(
        _: &Simulation,
        _: Option<Ros2Reach>,
        _: bool,
        _: bool,
    ) -> Result<Self, RunError> {
        Ok(Self)
    }

    pub(crate) fn is_joined(&self) -> bool {
        false
    }

    pub(crate) fn is_due(&mut self, _: Duration) -> bool {
        false
    }

    pub(crate) fn print_findings(&self) -> io::Result<()> {
        Ok(())
    }
}
