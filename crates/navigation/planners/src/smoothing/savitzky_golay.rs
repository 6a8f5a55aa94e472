//! Savitzky-Golay smoother: a local polynomial of least squares.
//!
//! Source: A. Savitzky, M. J. E. Golay, "Smoothing and differentiation of data by simplified least squares
//! procedures", 1964.

use periplus_geometry::Pose2;
use periplus_params::{ParamValue, ParamValues};

use super::segments::{directional_segments, is_reversing, set_yaws_along};
use super::{SmoothError, SmoothErrorKind, SmoothRequest, Smoother, poses};
use crate::ParameterRejected;
use crate::parameters::{ChangeRules, ParameterStore};
use crate::tables::{SAVITZKY_GOLAY_SMOOTHER, SavitzkyGolayParams};

const RULES: ChangeRules = ChangeRules {
    fixed: &[
        "do_refinement",
        "refinement_num",
        "enforce_path_inversion",
        "window_size",
        "poly_order",
    ],
    allows_zero: true,
    unlimited: &[],
};

/// The smoother `nav2_smoother::SavitzkyGolaySmoother`.
#[derive(Debug)]
pub struct SavitzkyGolaySmoother {
    store: ParameterStore,
    params: SavitzkyGolayParams,
    /// Weights of the poses of the window, or why there are none.
    weights: Result<Vec<f64>, String>,
}

impl Default for SavitzkyGolaySmoother {
    fn default() -> Self {
        Self::new(ParamValues::defaults(&SAVITZKY_GOLAY_SMOOTHER))
    }
}

impl SavitzkyGolaySmoother {
    /// Creates a smoother with values of [`crate::tables::SAVITZKY_GOLAY_SMOOTHER`]. An even window makes
    /// every smoothing fail with `INVALID_SMOOTHER`.
    #[must_use]
    pub fn new(values: ParamValues) -> Self {
        let params = SavitzkyGolayParams::from_values(&values);
        let weights = weights(params.window_size, params.poly_order);
        Self { store: ParameterStore::new(values, &RULES), params, weights }
    }
}

/// Returns the weights by which the polynomial of least squares has its value at the middle of a window.
fn weights(window: usize, order: usize) -> Result<Vec<f64>, String> {
    if window.is_multiple_of(2) || window < 3 {
        return Err(format!(
            "Savitzky-Golay Smoother requires an odd window size of 3 or greater; `window_size` is {window}"
        ));
    }
    if order >= window {
        return Err(format!(
            "`poly_order` {order} needs a window of at least {}; `window_size` is {window}",
            order + 1
        ));
    }
    let half = (window / 2) as f64;
    // Powers of positions scaled to [-1, 1], made orthonormal one by one (modified Gram-Schmidt): the value
    // of the fit at 0 is a sum over the columns, and its weights follow.
    let positions: Vec<f64> = (0..window).map(|index| (index as f64 - half) / half).collect();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for power in 0..=order {
        let raise = |position: &f64| (0..power).fold(1.0, |value, _| value * position);
        let mut column: Vec<f64> = positions.iter().map(raise).collect();
        for other in &columns {
            let overlap = dot(&column, other);
            column.iter_mut().zip(other).for_each(|(value, other)| *value -= overlap * other);
        }
        let norm = dot(&column, &column).sqrt();
        column.iter_mut().for_each(|value| *value /= norm);
        columns.push(column);
    }
    let middle = window / 2;
    let weight = |index: usize| columns.iter().map(|column| column[middle] * column[index]).sum();
    Ok((0..window).map(weight).collect())
}

fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(left, right)| left * right).sum()
}

/// Filters the inner poses once; positions before and after the path are those of its ends.
fn filter(path: &mut [Pose2], weights: &[f64]) {
    let before = path.to_vec();
    let last = before.len() - 1;
    let half = weights.len() / 2;
    for (index, pose) in path.iter_mut().enumerate().take(last).skip(1) {
        let (mut x_m, mut y_m) = (0.0, 0.0);
        for (offset, weight) in weights.iter().enumerate() {
            let from = before[(index + offset).saturating_sub(half).min(last)];
            x_m += weight * from.x_m;
            y_m += weight * from.y_m;
        }
        (pose.x_m, pose.y_m) = (x_m, y_m);
    }
}

impl Smoother for SavitzkyGolaySmoother {
    fn smooth(&mut self, request: SmoothRequest<'_>) -> Result<Vec<Pose2>, SmoothError> {
        let mut path = poses(request.path)?.to_vec();
        let invalid = |why: &String| SmoothError::new(SmoothErrorKind::InvalidSmoother, why);
        let weights = self.weights.as_ref().map_err(invalid)?;
        let segments = if self.params.enforce_path_inversion {
            directional_segments(&path)
        } else {
            std::iter::once(0..path.len()).collect()
        };
        // The window, both ends, and one more.
        let min_pose_count = weights.len() + 4;
        for segment in segments.into_iter().filter(|segment| segment.len() >= min_pose_count) {
            if (request.is_out_of_time)() {
                return Err(SmoothError::timeout());
            }
            let part = &mut path[segment];
            let is_reversing = is_reversing(part, false);
            let refinements =
                if self.params.do_refinement { self.params.refinement_num } else { 0 };
            for _ in 0..=refinements {
                filter(part, weights);
            }
            set_yaws_along(part, is_reversing);
        }
        Ok(path)
    }

    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected> {
        self.store.change(name, value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_those_of_the_literature() {
        let check = |window, order, expected: &[f64], divisor: f64| {
            let weights = weights(window, order).unwrap();
            let expected = expected.iter().map(|weight| weight / divisor);
            assert!(weights.iter().zip(expected).all(|(got, wanted)| (got - wanted).abs() < 1e-12));
        };
        check(7, 3, &[-2.0, 3.0, 6.0, 7.0, 6.0, 3.0, -2.0], 21.0);
        check(5, 2, &[-3.0, 12.0, 17.0, 12.0, -3.0], 35.0);
        check(3, 1, &[1.0, 1.0, 1.0], 3.0);
        assert!(weights(6, 3).is_err() && weights(1, 0).is_err() && weights(3, 3).is_err());
    }
}
