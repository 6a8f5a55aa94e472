//! Measurement update of the filter.

use periplus_geometry::normalize_angle;

use crate::state::{Covariance, Measurement, STATE_DIMENSIONS, State, Variable, wrap};

/// Minimum variance, in the unit of the variable squared.
const MIN_VARIANCE_FACTOR: f64 = 1e-9;

/// Result of a measurement update.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outcome {
    Corrected,
    /// Mahalanobis distance above the rejection threshold.
    TooFar(f64),
    /// The innovation covariance is singular.
    Singular,
}

/// Updates the state with a measurement, in Joseph form, which keeps the covariance positive
/// semidefinite.
/// Variables that were not measured have zero weight, so that all matrices have the same size.
pub(crate) fn correct(
    state: &mut State,
    covariance: &mut Covariance,
    measured: &Measurement,
) -> Outcome {
    let mask = measured.mask;
    let mut noise = Covariance::identity();
    let mut surprise = State::zeros();
    for row in (0..STATE_DIMENSIONS).filter(|row| mask[*row]) {
        surprise[row] = measured.state[row] - state[row];
        if Variable::ANGLES.iter().any(|angle| angle.at() == row) {
            surprise[row] = normalize_angle(surprise[row]);
        }
        for column in (0..STATE_DIMENSIONS).filter(|column| mask[*column]) {
            noise[(row, column)] = measured.covariance[(row, column)];
        }
        noise[(row, row)] = noise[(row, row)].abs().max(MIN_VARIANCE_FACTOR);
    }
    let seen = Covariance::from_diagonal(&State::from_fn(|at, _| f64::from(u8::from(mask[at]))));
    let seen_covariance = seen * *covariance * seen;
    let Some(inverse) = (seen_covariance + noise).cholesky().map(|it| it.inverse()) else {
        return Outcome::Singular;
    };
    let off = libm::sqrt(surprise.dot(&(inverse * surprise)).max(0.0));
    if off >= measured.most_deviations {
        return Outcome::TooFar(off);
    }
    let gain = *covariance * seen * inverse;
    *state += gain * surprise;
    wrap(state);
    let rest = Covariance::identity() - gain * seen;
    let next =
        rest * *covariance * rest.transpose() + gain * (seen * noise * seen) * gain.transpose();
    *covariance = (next + next.transpose()) * 0.5;
    Outcome::Corrected
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_equally_sure_meet_in_the_middle() {
        let (mut state, mut covariance) = (State::zeros(), Covariance::identity() * 0.5);
        let measured = Measurement::of(0, &[(Variable::X, 2.0)], 0.5);
        assert_eq!(correct(&mut state, &mut covariance, &measured), Outcome::Corrected);
        assert!((state[0] - 1.0).abs() < 1e-12 && (covariance[(0, 0)] - 0.25).abs() < 1e-12);
        // The other variables are unchanged.
        assert_eq!((state[1], covariance[(1, 1)]), (0.0, 0.5));
    }

    #[test]
    fn angles_meet_the_short_way_round() {
        let (mut state, mut covariance) = (State::zeros(), Covariance::identity());
        state[Variable::Yaw.at()] = 3.1;
        let measured = Measurement::of(0, &[(Variable::Yaw, -3.1)], 1.0);
        correct(&mut state, &mut covariance, &measured);
        assert!((state[Variable::Yaw.at()].abs() - std::f64::consts::PI).abs() < 1e-9, "{state}");
    }

    #[test]
    fn what_is_far_off_is_not_believed() {
        let (mut state, mut covariance) = (State::zeros(), Covariance::identity() * 0.5);
        let mut measured = Measurement::of(0, &[(Variable::X, 5.0)], 0.5);
        measured.most_deviations = 4.9;
        assert_eq!(correct(&mut state, &mut covariance, &measured), Outcome::TooFar(5.0));
        assert_eq!(state, State::zeros());
    }
}
