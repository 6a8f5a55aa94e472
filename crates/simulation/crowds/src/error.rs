//! Errors.

use std::error::Error;
use std::fmt;

/// Reason why a floor or a crowd cannot be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CrowdError {
    /// The wall with this number has an end that is not finite.
    Wall(usize),
    /// The floor is too large: its size \[m\].
    Size([f64; 2]),
    /// The period of a floor is not a positive number \[m\].
    Period(f64),
    /// A number of an agent is out of its range: the name of the field and the value.
    Person(&'static str, f64),
    /// A plan names a goal with this number, which does not exist.
    Goal(usize),
    /// No path leads to the goal from anywhere: its position \[m\].
    GoalInWall([f64; 2]),
    /// No goals exist, and a plan visits goals at random.
    NoGoals,
}

impl fmt::Display for CrowdError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wall(number) => {
                write!(f, "the ends of wall {number} must be finite numbers in metres")
            }
            Self::Size([x, y]) => write!(
                f,
                "the walls span {x:.0} m by {y:.0} m: a floor of people has at most 160,000 m²; leave out walls \
                 that are far away"
            ),
            Self::Period(period_m) => {
                write!(
                    f,
                    "the period of a floor must be a positive length in metres, not {period_m}"
                )
            }
            Self::Person(field, value) => write!(f, "`{field}` of an agent must not be {value}"),
            Self::Goal(number) => {
                write!(f, "goal {number} does not exist: add it before its agents")
            }
            Self::GoalInWall([x, y]) => write!(
                f,
                "the goal at ({x}, {y}) m is in a wall or outside of the floor: move it to free floor"
            ),
            Self::NoGoals => f.write_str("people who wander need goals: add goals before them"),
        }
    }
}

impl Error for CrowdError {}
