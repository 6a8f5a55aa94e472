//! Motion model: prediction of the state.

use nalgebra::{Matrix3, Vector3};

use crate::state::{Covariance, State, Variable, wrap};

/// Predicts the state and its covariance over a time \[s\].
/// Linear and angular velocity are in the base frame and are rotated into the world frame by the
/// orientation; the acceleration is constant. Near a pitch of a quarter turn yaw and roll are not
/// distinguishable; the cosine of the pitch is limited to keep the values finite.
pub(crate) fn predict(
    state: &State,
    covariance: &Covariance,
    noise_per_s: &Covariance,
    time_s: f64,
) -> (State, Covariance) {
    let step = step(state, time_s);
    let grown = step.jacobian * covariance * step.jacobian.transpose() + noise_per_s * time_s;
    (step.state, (grown + grown.transpose()) * 0.5)
}

struct Step {
    state: State,
    jacobian: Covariance,
}

fn step(state: &State, time_s: f64) -> Step {
    let three = |from: Variable| Vector3::from(state.fixed_rows::<3>(from.at()));
    let (velocity, rate, push) = (three(Variable::Vx), three(Variable::Vroll), three(Variable::Ax));
    let attitude = Attitude::of(three(Variable::Roll));
    let half_s2 = 0.5 * time_s * time_s;
    let way = velocity * time_s + push * half_s2;

    let mut next = *state;
    let turned = attitude.rotation() * way;
    let swung = attitude.rates() * rate * time_s;
    for axis in 0..3 {
        next[Variable::X.at() + axis] += turned[axis];
        next[Variable::Roll.at() + axis] += swung[axis];
        next[Variable::Vx.at() + axis] += push[axis] * time_s;
    }
    wrap(&mut next);

    let mut jacobian = Covariance::identity();
    let mut block = |row: Variable, column: Variable, by: Matrix3<f64>| {
        let mut view = jacobian.fixed_view_mut::<3, 3>(row.at(), column.at());
        view += by;
    };
    block(Variable::X, Variable::Vx, attitude.rotation() * time_s);
    block(Variable::X, Variable::Ax, attitude.rotation() * half_s2);
    let by_angles = attitude.rotation_by_angles().map(|derivative| derivative * way);
    block(Variable::X, Variable::Roll, Matrix3::from_columns(&by_angles));
    block(Variable::Roll, Variable::Vroll, attitude.rates() * time_s);
    let by_angles = attitude.rates_by_angles().map(|derivative| derivative * rate * time_s);
    block(Variable::Roll, Variable::Roll, Matrix3::from_columns(&by_angles));
    block(Variable::Vx, Variable::Ax, Matrix3::identity() * time_s);
    Step { state: next, jacobian }
}

/// Sines and cosines of roll, pitch and yaw.
struct Attitude {
    sin: [f64; 3],
    cos: [f64; 3],
}

/// Minimum magnitude of the cosine of the pitch.
const MIN_COSINE_RATIO: f64 = 1e-6;

impl Attitude {
    fn of(angles: Vector3<f64>) -> Self {
        let mut cos = [libm::cos(angles.x), libm::cos(angles.y), libm::cos(angles.z)];
        if cos[1].abs() < MIN_COSINE_RATIO {
            cos[1] = MIN_COSINE_RATIO.copysign(cos[1]);
        }
        Self { sin: [libm::sin(angles.x), libm::sin(angles.y), libm::sin(angles.z)], cos }
    }

    fn about_x(&self) -> Matrix3<f64> {
        let (s, c) = (self.sin[0], self.cos[0]);
        Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
    }

    fn about_y(&self) -> Matrix3<f64> {
        let (s, c) = (self.sin[1], self.cos[1]);
        Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
    }

    fn about_z(&self) -> Matrix3<f64> {
        let (s, c) = (self.sin[2], self.cos[2]);
        Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
    }

    /// Returns the rotation from the base frame to the world frame.
    fn rotation(&self) -> Matrix3<f64> {
        self.about_z() * self.about_y() * self.about_x()
    }

    /// Returns its derivatives by roll, pitch and yaw.
    fn rotation_by_angles(&self) -> [Matrix3<f64>; 3] {
        let [(sr, cr), (sp, cp), (sy, cy)] = [0, 1, 2].map(|axis| (self.sin[axis], self.cos[axis]));
        let by_roll = Matrix3::new(0.0, 0.0, 0.0, 0.0, -sr, -cr, 0.0, cr, -sr);
        let by_pitch = Matrix3::new(-sp, 0.0, cp, 0.0, 0.0, 0.0, -cp, 0.0, -sp);
        let by_yaw = Matrix3::new(-sy, -cy, 0.0, cy, -sy, 0.0, 0.0, 0.0, 0.0);
        [
            self.about_z() * self.about_y() * by_roll,
            self.about_z() * by_pitch * self.about_x(),
            by_yaw * self.about_y() * self.about_x(),
        ]
    }

    /// Returns the matrix from body rates to rates of roll, pitch and yaw.
    fn rates(&self) -> Matrix3<f64> {
        let ([sr, sp, _], [cr, cp, _]) = (self.sin, self.cos);
        let tp = sp / cp;
        Matrix3::new(1.0, sr * tp, cr * tp, 0.0, cr, -sr, 0.0, sr / cp, cr / cp)
    }

    /// Returns its derivatives by roll, pitch and yaw.
    fn rates_by_angles(&self) -> [Matrix3<f64>; 3] {
        let ([sr, sp, _], [cr, cp, _]) = (self.sin, self.cos);
        let (tp, cp2) = (sp / cp, cp * cp);
        [
            Matrix3::new(0.0, cr * tp, -sr * tp, 0.0, -sr, -cr, 0.0, cr / cp, -sr / cp),
            Matrix3::new(0.0, sr / cp2, cr / cp2, 0.0, 0.0, 0.0, 0.0, sr * sp / cp2, cr * sp / cp2),
            Matrix3::zeros(),
        ]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::state::STATE_DIMENSIONS;

    #[test]
    fn a_quarter_circle() {
        // 0.5 m/s on a circle of 1 m; a quarter of it in small steps.
        let mut state = State::zeros();
        (state[Variable::Vx.at()], state[Variable::Vyaw.at()]) = (0.5, 0.5);
        let steps = 10_000;
        let time_s = std::f64::consts::FRAC_PI_2 / 0.5 / f64::from(steps);
        for _ in 0..steps {
            state = step(&state, time_s).state;
        }
        let expected = [1.0, 1.0, std::f64::consts::FRAC_PI_2];
        for (variable, expected) in [Variable::X, Variable::Y, Variable::Yaw].iter().zip(expected) {
            assert!((state[variable.at()] - expected).abs() < 1e-3, "{variable:?}: {state}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        /// The Jacobian equals the numerical derivative.
        #[test]
        fn the_jacobian_is_the_derivative(
            numbers in prop::array::uniform15(-1.0_f64..1.0), time_s in 0.001_f64..0.5,
        ) {
            let state = State::from(numbers);
            let jacobian = step(&state, time_s).jacobian;
            let small = 1e-6;
            for column in 0..STATE_DIMENSIONS {
                let (mut more, mut less) = (state, state);
                more[column] += small;
                less[column] -= small;
                let change = step(&more, time_s).state - step(&less, time_s).state;
                for row in 0..STATE_DIMENSIONS {
                    let slope = change[row] / (2.0 * small);
                    prop_assert!((slope - jacobian[(row, column)]).abs() < 1e-6, "{row} {column}");
                }
            }
        }
    }
}
