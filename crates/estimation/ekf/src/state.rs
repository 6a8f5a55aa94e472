//! State, estimates and measurements.

use nalgebra::{SMatrix, SVector};
use periplus_geometry::{DVec3, Pose, Rpy, normalize_angle};

/// Number of variables.
pub const STATE_DIMENSIONS: usize = 15;
/// State vector in metres, radians and seconds.
pub type State = SVector<f64, STATE_DIMENSIONS>;
/// Covariance of the state.
pub type Covariance = SMatrix<f64, STATE_DIMENSIONS, STATE_DIMENSIONS>;

/// Variables in the order of the state vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(
    missing_docs,
    reason = "the names are those of robot_localization: pose, then velocities in the base frame"
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
    /// Variables that are zero in two-dimensional mode.
    pub const OFF_THE_GROUND: [Self; 7] =
        [Self::Z, Self::Roll, Self::Pitch, Self::Vz, Self::Vroll, Self::Vpitch, Self::Az];
    /// Variables that are angles.
    pub const ANGLES: [Self; 3] = [Self::Roll, Self::Pitch, Self::Yaw];

    /// Index in the state vector.
    #[must_use]
    pub const fn at(self) -> usize {
        self as usize
    }
}

/// Returns three consecutive variables.
#[must_use]
pub(crate) fn three(state: &State, from: Variable) -> DVec3 {
    let at = from.at();
    DVec3::new(state[at], state[at + 1], state[at + 2])
}

/// Wraps angles to half a turn.
pub(crate) fn wrap(state: &mut State) {
    for angle in Variable::ANGLES {
        state[angle.at()] = normalize_angle(state[angle.at()]);
    }
}

/// Estimated state with its covariance.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Stamp \[ns\].
    pub time_ns: i64,
    /// Mean.
    pub state: State,
    /// Covariance.
    pub covariance: Covariance,
}

impl Estimate {
    /// Returns a variable.
    #[must_use]
    pub fn get(&self, variable: Variable) -> f64 {
        self.state[variable.at()]
    }

    /// Returns the pose `world_from_base`.
    #[must_use]
    pub fn world_from_base(&self) -> Pose {
        let (place, angles) = (three(&self.state, Variable::X), three(&self.state, Variable::Roll));
        let rpy = Rpy { roll: angles.x, pitch: angles.y, yaw: angles.z };
        Pose::from_xyz_rpy(place.into(), rpy)
    }

    /// Returns linear \[m/s\] and angular velocity \[rad/s\] in the base frame.
    #[must_use]
    pub fn twist(&self) -> (DVec3, DVec3) {
        (three(&self.state, Variable::Vx), three(&self.state, Variable::Vroll))
    }

    /// Returns the acceleration in the base frame \[m/s²\].
    #[must_use]
    pub fn acceleration(&self) -> DVec3 {
        three(&self.state, Variable::Ax)
    }

    /// Returns the covariance of six consecutive variables, row-major as in messages.
    #[must_use]
    pub fn covariance_of(&self, from: Variable) -> [f64; 36] {
        let at = from.at();
        std::array::from_fn(|index| self.covariance[(at + index / 6, at + index % 6)])
    }
}

/// Measurement of some variables at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Stamp \[ns\].
    pub time_ns: i64,
    /// Values; unmeasured variables are ignored.
    pub state: State,
    /// Covariance; rows and columns of unmeasured variables are ignored.
    pub covariance: Covariance,
    /// True for measured variables.
    pub mask: [bool; STATE_DIMENSIONS],
    /// Maximum Mahalanobis distance; measurements beyond it are rejected.
    pub most_deviations: f64,
    /// Name of the input, for messages.
    pub source: String,
}

impl Measurement {
    /// Creates a measurement of some variables with equal variances.
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
            mask: [false; STATE_DIMENSIONS],
            most_deviations: f64::INFINITY,
            source,
        }
    }

    /// Returns true if no variable is measured.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        !self.mask.contains(&true)
    }

    /// Returns true if all measured values are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let measured = || (0..STATE_DIMENSIONS).filter(|at| self.mask[*at]);
        measured().all(|row| {
            self.state[row].is_finite()
                && measured().all(|column| self.covariance[(row, column)].is_finite())
        })
    }
}
