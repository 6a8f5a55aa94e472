//! What is estimated, and what is measured.

use nalgebra::{SMatrix, SVector};
use periplus_geometry::{DVec3, Pose, Rpy, normalize_angle};

/// How many numbers the state has.
pub const SIZE: usize = 15;
/// The state: metres, radians, seconds.
pub type State = SVector<f64, SIZE>;
/// How sure each is, and what hangs together.
pub type Covariance = SMatrix<f64, SIZE, SIZE>;

/// The numbers of the state, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(
    missing_docs,
    reason = "the names say it: place, attitude, then their changes in the robot's frame"
)]
pub enum Variable {
    X,
    Y,
    Z,
    Roll,
    Pitch,
    Yaw,
    Vx,
    Vy,
    Vz,
    Vroll,
    Vpitch,
    Vyaw,
    Ax,
    Ay,
    Az,
}

impl Variable {
    /// Those that a robot on flat ground has not.
    pub const OFF_THE_GROUND: [Self; 7] =
        [Self::Z, Self::Roll, Self::Pitch, Self::Vz, Self::Vroll, Self::Vpitch, Self::Az];
    /// Those that are angles.
    pub const ANGLES: [Self; 3] = [Self::Roll, Self::Pitch, Self::Yaw];

    /// Where it stands in the state.
    #[must_use]
    pub const fn at(self) -> usize {
        self as usize
    }
}

/// Three numbers of the state that stand side by side, from one of them on.
#[must_use]
pub(crate) fn three(state: &State, from: Variable) -> DVec3 {
    let at = from.at();
    DVec3::new(state[at], state[at + 1], state[at + 2])
}

/// Angles within half a turn.
pub(crate) fn wrap(state: &mut State) {
    for angle in Variable::ANGLES {
        state[angle.at()] = normalize_angle(state[angle.at()]);
    }
}

/// Where the robot is, how it moves, and how sure that is.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Of which time \[ns\].
    pub time_ns: i64,
    /// What is most likely.
    pub state: State,
    /// How sure.
    pub covariance: Covariance,
}

impl Estimate {
    /// One of its numbers.
    #[must_use]
    pub fn get(&self, variable: Variable) -> f64 {
        self.state[variable.at()]
    }

    /// Where the robot is: `world_from_base`.
    #[must_use]
    pub fn world_from_base(&self) -> Pose {
        let (place, angles) = (three(&self.state, Variable::X), three(&self.state, Variable::Roll));
        let rpy = Rpy { roll: angles.x, pitch: angles.y, yaw: angles.z };
        Pose::from_xyz_rpy(place.into(), rpy)
    }

    /// Velocity \[m/s\] and turn rate \[rad/s\] in the robot's frame.
    #[must_use]
    pub fn twist(&self) -> (DVec3, DVec3) {
        (three(&self.state, Variable::Vx), three(&self.state, Variable::Vroll))
    }

    /// Acceleration in the robot's frame \[m/s²\].
    #[must_use]
    pub fn acceleration(&self) -> DVec3 {
        three(&self.state, Variable::Ax)
    }

    /// How sure six numbers are that stand side by side, in rows, as messages carry it.
    #[must_use]
    pub fn covariance_of(&self, from: Variable) -> [f64; 36] {
        let at = from.at();
        std::array::from_fn(|index| self.covariance[(at + index / 6, at + index % 6)])
    }
}

/// What was measured of the state at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// When \[ns\].
    pub time_ns: i64,
    /// The numbers; those that were not measured do not count.
    pub state: State,
    /// How sure; rows and columns of what was not measured do not count.
    pub covariance: Covariance,
    /// Which were measured.
    pub mask: [bool; SIZE],
    /// What is further off than so many standard deviations (Mahalanobis) is not believed.
    pub most_deviations: f64,
    /// Who measured, for what is said of it.
    pub source: String,
}

impl Measurement {
    /// Of some variables, each with the same variance.
    #[must_use]
    pub fn of(time_ns: i64, values: &[(Variable, f64)], variance: f64) -> Self {
        let mut it = Self::empty(time_ns, String::new());
        for (variable, value) in values {
            it.state[variable.at()] = *value;
            it.mask[variable.at()] = true;
        }
        it.covariance = Covariance::identity() * variance;
        it
    }

    pub(crate) fn empty(time_ns: i64, source: String) -> Self {
        Self {
            time_ns,
            state: State::zeros(),
            covariance: Covariance::zeros(),
            mask: [false; SIZE],
            most_deviations: f64::INFINITY,
            source,
        }
    }

    /// Whether it says anything.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        !self.mask.contains(&true)
    }

    /// Whether all that was measured is a number.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let measured = || (0..SIZE).filter(|at| self.mask[*at]);
        measured().all(|row| {
            self.state[row].is_finite()
                && measured().all(|column| self.covariance[(row, column)].is_finite())
        })
    }
}
