//! Reasons why there is no plan.

use std::fmt;

use periplus_costmap::cost;
use periplus_geometry::Pose2;
use periplus_grid::Cell;

/// Kind of failure: one for each error code of `ComputePathToPose` and `ComputePathThroughPoses`.
///
/// Source: `nav2_msgs/action/ComputePathToPose.action`, `ComputePathThroughPoses.action`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanErrorKind {
    /// `UNKNOWN`: any other failure.
    Unknown,
    /// `INVALID_PLANNER`: there is no planner of the requested id, or its parameters are unusable.
    InvalidPlanner,
    /// `TF_ERROR`: a pose cannot be transformed to the frame of the costmap.
    Transform,
    /// `START_OUTSIDE_MAP`.
    StartOutsideMap,
    /// `GOAL_OUTSIDE_MAP`.
    GoalOutsideMap,
    /// `START_OCCUPIED`.
    StartOccupied,
    /// `GOAL_OCCUPIED`.
    GoalOccupied,
    /// `TIMEOUT`: the time or the iterations are used up.
    Timeout,
    /// `NO_VALID_PATH`.
    NoValidPath,
    /// `NO_VIAPOINTS_GIVEN`: a plan through poses without poses.
    NoViapoints,
    /// The client cancelled the goal; this is not an error code.
    Cancelled,
}

impl PlanErrorKind {
    /// Returns the offset of the code in both actions; none for a cancelled goal.
    fn offset(self) -> Option<u16> {
        Some(match self {
            Self::Unknown => 0,
            Self::InvalidPlanner => 1,
            Self::Transform => 2,
            Self::StartOutsideMap => 3,
            Self::GoalOutsideMap => 4,
            Self::StartOccupied => 5,
            Self::GoalOccupied => 6,
            Self::Timeout => 7,
            Self::NoValidPath => 8,
            Self::NoViapoints => 9,
            Self::Cancelled => return None,
        })
    }

    /// Returns the error code in the result of `ComputePathToPose`; none for a cancelled goal.
    #[must_use]
    pub fn code_to_pose(self) -> Option<u16> {
        self.offset().map(|offset| if self == Self::NoViapoints { 200 } else { 200 + offset })
    }

    /// Returns the error code in the result of `ComputePathThroughPoses`; none for a cancelled goal.
    #[must_use]
    pub fn code_through_poses(self) -> Option<u16> {
        self.offset().map(|offset| 300 + offset)
    }

    /// Returns the name of the code.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unknown => "UNKNOWN",
            Self::InvalidPlanner => "INVALID_PLANNER",
            Self::Transform => "TF_ERROR",
            Self::StartOutsideMap => "START_OUTSIDE_MAP",
            Self::GoalOutsideMap => "GOAL_OUTSIDE_MAP",
            Self::StartOccupied => "START_OCCUPIED",
            Self::GoalOccupied => "GOAL_OCCUPIED",
            Self::Timeout => "TIMEOUT",
            Self::NoValidPath => "NO_VALID_PATH",
            Self::NoViapoints => "NO_VIAPOINTS_GIVEN",
            Self::Cancelled => "CANCELLED",
        }
    }
}

/// Part of the route in which a cell blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockedPart {
    /// At the pose of the robot.
    Start,
    /// At the goal.
    Goal,
    /// On the straight line from the nearest reachable position to the goal.
    Between,
}

/// Cell that blocks a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockingCell {
    /// Part of the route.
    pub part: BlockedPart,
    /// Column and row.
    pub cell: Cell,
    /// Centre of the cell, in the frame of the costmap.
    pub centre: Pose2,
    /// Cost of the cell.
    pub cost: u8,
}

/// Position near the goal that the robot can reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachablePose {
    /// Centre of the cell, with the yaw of the goal.
    pub pose: Pose2,
    /// Distance to the goal \[m\].
    pub distance_m: f64,
}

/// Facts about the costmap that explain a failure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanObstruction {
    /// First cell that blocks, seen from the robot; none if the cause is not one cell.
    pub blocking: Option<BlockingCell>,
    /// Nearest position to the goal that is connected with the start.
    pub nearest: Option<ReachablePose>,
}

/// Reason why there is no plan: the error code and text of Nav2, and the facts that explain it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanError {
    /// Kind of failure, which has the error code.
    pub kind: PlanErrorKind,
    /// Text of Nav2 for this failure.
    pub message: String,
    /// Cause in the costmap.
    pub obstruction: PlanObstruction,
}

impl PlanError {
    /// Creates an error without an explanation.
    #[must_use]
    pub fn new(kind: PlanErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into(), obstruction: PlanObstruction::default() }
    }

    /// Adds the cause in the costmap.
    #[must_use]
    pub fn with(self, obstruction: PlanObstruction) -> Self {
        Self { obstruction, ..self }
    }

    pub(crate) fn cancelled() -> Self {
        Self::new(PlanErrorKind::Cancelled, "Planner was cancelled")
    }
}

/// Returns the meaning of a blocking cost.
fn meaning(cost: u8) -> &'static str {
    match cost {
        cost::UNKNOWN => "unknown space",
        cost::LETHAL => "an obstacle",
        cost::INSCRIBED => "closer to an obstacle than the inscribed radius of the robot",
        _ => "a cost above the limit",
    }
}

impl fmt::Display for BlockingCell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = match self.part {
            BlockedPart::Start => "the start is blocked by",
            BlockedPart::Goal => "the goal is blocked by",
            BlockedPart::Between => "the direct line to the goal is blocked by",
        };
        let Self { cell: (column, row), centre, cost, .. } = *self;
        write!(
            f,
            "{part} cell ({column}, {row}) at ({:.2}, {:.2}) with cost {cost} ({})",
            centre.x_m,
            centre.y_m,
            meaning(cost)
        )
    }
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message.trim_end())?;
        if let Some(blocking) = self.obstruction.blocking {
            write!(f, "; {blocking}")?;
        }
        if let Some(ReachablePose { pose, distance_m }) = self.obstruction.nearest {
            let (x_m, y_m) = (pose.x_m, pose.y_m);
            write!(
                f,
                "; the nearest reachable position is ({x_m:.2}, {y_m:.2}), {distance_m:.2} m from the goal"
            )?;
        }
        Ok(())
    }
}

impl std::error::Error for PlanError {}

/// Reason why a parameter cannot be changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterRejected {
    /// The plugin has no such parameter; with the most similar name.
    Unknown(String, Option<&'static str>),
    /// The parameter is read once, when the plugin is configured.
    Fixed(&'static str),
    /// The value is invalid, with the reason.
    Value(&'static str, String),
}

impl fmt::Display for ParameterRejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name, None) => write!(f, "there is no parameter `{name}`"),
            Self::Unknown(name, Some(near)) => {
                write!(f, "there is no parameter `{name}`; did you mean `{near}`?")
            }
            Self::Fixed(name) => write!(
                f,
                "`{name}` is read when the plugin is configured; change it in the parameter file and restart"
            ),
            Self::Value(name, reason) => write!(f, "`{name}`: {reason}"),
        }
    }
}

impl std::error::Error for ParameterRejected {}
