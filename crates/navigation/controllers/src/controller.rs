//! Interface of all controllers.

use std::fmt;

use periplus_costmap::CostmapView;
use periplus_geometry::{Pose2, Twist2};
use periplus_params::ParamValue;

use crate::dwb::LocalPlanEvaluation;
use crate::graceful::GracefulReport;
use crate::mppi::Mppi;
use crate::parameters::{ParameterChange, ParameterGroup, ParameterRefusal};
use crate::rpp::PurePursuitReport;
use crate::{BlockedCell, PathRules};

/// Tolerances of the goal checker in use; none where the checker has no such tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GoalTolerance {
    /// Maximum distance to the goal \[m\].
    pub xy_m: Option<f64>,
    /// Maximum difference to the goal's heading \[rad\].
    pub yaw_rad: Option<f64>,
}

/// Inputs of one control cycle. All poses are in the frame of the local costmap.
#[derive(Clone, Copy, Debug)]
pub struct ControlInput<'a> {
    /// Stamp of the robot's pose \[ns\].
    pub time_ns: i64,
    /// Pose of the robot.
    pub pose: Pose2,
    /// Measured velocity of the robot, in the base frame.
    pub velocity: Twist2,
    /// Local costmap.
    pub costmap: CostmapView<'a>,
    /// Part of the plan ahead of the robot that lies in the costmap; at least one pose.
    pub plan: &'a [Pose2],
    /// Last pose of the whole plan.
    pub goal: Pose2,
    /// Tolerances of the goal checker.
    pub tolerance: GoalTolerance,
    /// True if the goal checker is content with the position, so that only the heading counts.
    pub is_position_reached: bool,
}

/// Reason why a controller has no velocity. The server's error code follows from it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ControlError {
    /// The plan cannot be followed at all (`INVALID_PATH`).
    InvalidPath(String),
    /// A transform is missing (`TF_ERROR`).
    Transform(String),
    /// No velocity is safe or valid in this cycle (`NO_VALID_CONTROL`).
    NoValidControl(String),
    /// A parameter makes control impossible (`INVALID_CONTROLLER`).
    InvalidController(String),
    /// Another reason (`UNKNOWN`).
    Unknown(String),
}

impl fmt::Display for ControlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::InvalidPath(text)
        | Self::Transform(text)
        | Self::NoValidControl(text)
        | Self::InvalidController(text)
        | Self::Unknown(text)) = self;
        f.write_str(text)
    }
}

impl std::error::Error for ControlError {}

/// Intermediate results of the last cycle of a controller, which a server publishes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControlReport<'a> {
    /// None.
    None,
    /// Results of RegulatedPurePursuit.
    PurePursuit(&'a PurePursuitReport),
    /// Results of Graceful.
    Graceful(&'a GracefulReport),
    /// Trajectories of DWB, DWAPlannerROS or TrajectoryPlannerROS.
    Trajectories(&'a LocalPlanEvaluation),
    /// Samples of MPPI.
    Samples(SamplingReport<'a>),
}

/// Results of a cycle of MPPI, which are computed when they are read.
#[derive(Clone, Copy, Debug)]
pub struct SamplingReport<'a>(pub &'a Mppi);

/// Reports are equal if they are of the same controller.
impl PartialEq for SamplingReport<'_> {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.0, other.0)
    }
}

impl ControlReport<'_> {
    /// Returns the cell of the local costmap because of which there was no velocity, if the controller knows one.
    #[must_use]
    pub fn blocked(&self) -> Option<BlockedCell> {
        match self {
            Self::None | Self::Samples(_) => None,
            Self::PurePursuit(report) => report.blocked,
            Self::Graceful(report) => report.blocked,
            Self::Trajectories(evaluation) => evaluation.blocked(),
        }
    }
}

/// A controller: follows a plan within the local costmap.
pub trait Controller: Send {
    /// Returns the velocity command of a cycle, in the base frame.
    ///
    /// # Errors
    /// The reason why there is none. The server decides whether it waits or gives up.
    fn compute_velocity(&mut self, input: &ControlInput<'_>) -> Result<Twist2, ControlError>;

    /// Reports a new plan, in the frame of the plan. State that belongs to the old one ends.
    fn set_plan(&mut self, plan: &[Pose2]);

    /// Limits the speed: a percentage of the maximum, or metres a second; 0 removes the limit.
    fn set_speed_limit(&mut self, limit: f64, is_percentage: bool);

    /// Forgets the state of the motion, as between two goals.
    fn reset(&mut self) {}

    /// Reports that the goal is cancelled, in each cycle until it returns true: the robot may stop at once. Until then
    /// the controller decelerates.
    fn cancel(&mut self) -> bool {
        true
    }

    /// Returns the parameters with their values.
    fn parameters(&self) -> Vec<ParameterGroup<'_>> {
        Vec::new()
    }

    /// Changes a parameter, named without the group of the controller.
    ///
    /// # Errors
    /// When the name is unknown, or the controller refuses the value.
    fn change_parameter(
        &mut self,
        name: &str,
        _value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        Err(ParameterRefusal::Unknown(name.to_owned()))
    }

    /// Returns the rules by which this controller selects its local plan; none if it uses the server's path handler, as
    /// all do in main.
    fn path_rules(&self) -> Option<PathRules> {
        None
    }

    /// Returns intermediate results of the last cycle.
    fn report(&self) -> ControlReport<'_> {
        ControlReport::None
    }
}
