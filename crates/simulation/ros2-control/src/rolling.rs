//! Motion of a base on wheels whose speeds are commanded directly.

use crate::PlanarTwist;

/// Weight of the rule that wheels do not slide sideways, relative to their rolling. Skid-steered robots
/// break it in every turn, so it only decides what the rolling leaves open.
const LATERAL_WEIGHT_RATIO: f64 = 1e-8;

/// Weight of the smallest motion, for what both leave open.
const SMALLEST_WEIGHT_RATIO: f64 = 1e-14;

/// A wheel on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingWheel {
    /// Position seen from above, relative to the centre of motion [m].
    pub at_m: [f64; 2],
    /// Direction of its axis seen from above; a unit vector.
    pub axis: [f64; 2],
    /// Speed of its tread: angular speed times radius [m/s].
    pub speed_m_s: f64,
}

/// Returns the velocity of the centre of motion for which wheels roll without slip, in the sense of
/// least squares; sideways slip counts only where the rolling leaves the motion open.
#[must_use]
pub fn rolling_twist(wheels: &[RollingWheel]) -> PlanarTwist {
    let mut rows = [[0.0; 4]; 3];
    let mut add = |coefficients: [f64; 3], value: f64, weight: f64| {
        for row in 0..3 {
            for column in 0..3 {
                rows[row][column] += weight * coefficients[row] * coefficients[column];
            }
            rows[row][3] += weight * coefficients[row] * value;
        }
    };
    for wheel in wheels {
        let ([x_m, y_m], [axis_x, axis_y]) = (wheel.at_m, wheel.axis);
        // The wheel rolls along `axis x z`; its centre has the velocity (vx - w y, vy + w x).
        add([axis_y, -axis_x, -axis_y * y_m - axis_x * x_m], wheel.speed_m_s, 1.0);
        add([axis_x, axis_y, axis_y * x_m - axis_x * y_m], 0.0, LATERAL_WEIGHT_RATIO);
    }
    for (unit, row) in rows.iter_mut().enumerate() {
        row[unit] += SMALLEST_WEIGHT_RATIO;
    }
    let [x_m_s, y_m_s, yaw_rad_s] = solved(rows);
    PlanarTwist { x_m_s, y_m_s, yaw_rad_s }
}

/// Solves three equations by elimination with pivots.
fn solved(mut rows: [[f64; 4]; 3]) -> [f64; 3] {
    for column in 0..3 {
        let size = |row: &usize| rows[*row][column].abs();
        let pivot = (column..3).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(column);
        rows.swap(column, pivot);
        let head = rows[column];
        for row in rows.iter_mut().skip(column + 1) {
            let factor = row[column] / head[column];
            for (value, head) in row.iter_mut().zip(head) {
                *value -= factor * head;
            }
        }
    }
    let mut solution = [0.0; 3];
    for row in (0..3).rev() {
        let known: f64 = (row + 1..3).map(|column| rows[row][column] * solution[column]).sum();
        solution[row] = (rows[row][3] - known) / rows[row][row];
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(wheels: &[([f64; 2], f64)], expected: [f64; 3]) {
        let wheels: Vec<RollingWheel> = wheels
            .iter()
            .map(|&(at_m, speed_m_s)| RollingWheel { at_m, axis: [0.0, 1.0], speed_m_s })
            .collect();
        let PlanarTwist { x_m_s, y_m_s, yaw_rad_s } = rolling_twist(&wheels);
        let found = [x_m_s, y_m_s, yaw_rad_s];
        let error: f64 = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).sum();
        assert!(error < 1e-6, "{found:?} instead of {expected:?}");
    }

    #[test]
    fn two_and_four_wheels() {
        // 0.5 m apart: straight, and 1 rad/s about the middle.
        check(&[([0.0, 0.25], 0.5), ([0.0, -0.25], 0.5)], [0.5, 0.0, 0.0]);
        check(&[([0.0, 0.25], -0.25), ([0.0, -0.25], 0.25)], [0.0, 0.0, 1.0]);
        let skid = [
            ([0.3, 0.25], 0.25),
            ([0.3, -0.25], 0.75),
            ([-0.3, 0.25], 0.25),
            ([-0.3, -0.25], 0.75),
        ];
        check(&skid, [0.5, 0.0, 1.0]);
        // One wheel drives straight.
        check(&[([0.0, 0.0], 0.5)], [0.5, 0.0, 0.0]);
    }
}
