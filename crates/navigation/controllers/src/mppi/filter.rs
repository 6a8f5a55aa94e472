//! Smoothing of the control sequence by a Savitzky-Golay filter of nine points.
//!
//! Sources: Savitzky and Golay, "Smoothing and differentiation of data by simplified least squares
//! procedures" (1964), table I; `nav2_mppi_controller` `tools/utils.hpp` (`savitskyGolayFilter`).

use periplus_costmap::Nav2Release;

use super::sequence::{ControlSequence, MppiControl};

/// Coefficients of a quadratic polynomial, times 231.
const QUADRATIC_RATIO: [f32; 9] = [-21.0, 14.0, 39.0, 54.0, 59.0, 54.0, 39.0, 14.0, -21.0];

/// Number of steps up to which sequences are not smoothed.
const MAX_UNFILTERED_STEPS: usize = 20;

/// Last four commands, oldest first.
pub type ControlHistory = [MppiControl; 4];

/// Smooths a sequence and appends its command to the history. `order` is 1 (a mean) or 2.
pub(crate) fn smooth(
    sequence: &mut ControlSequence,
    history: &mut ControlHistory,
    order: i64,
    release: Nav2Release,
    sent: usize,
) {
    if sequence.len() <= MAX_UNFILTERED_STEPS {
        return;
    }
    let coefficients =
        if order == 1 { [1.0 / 9.0; 9] } else { QUADRATIC_RATIO.map(|it| it / 231.0) };
    let smooth = if release == Nav2Release::Humble { smooth_in_place } else { smooth_axis };
    smooth(&mut sequence.vx, history.map(|it| it.vx), &coefficients);
    smooth(&mut sequence.vy, history.map(|it| it.vy), &coefficients);
    smooth(&mut sequence.wz, history.map(|it| it.wz), &coefficients);
    history.rotate_left(1);
    history[3] = sequence.at(sent);
}

/// Smooths all values but the last, which is also the value of all steps beyond it.
fn smooth_axis(values: &mut [f32], history: [f32; 4], coefficients: &[f32; 9]) {
    let Some((last, _)) = values.split_last() else { return };
    let last = *last;
    let padded: Vec<f32> =
        history.into_iter().chain(values.iter().copied()).chain([last; 4]).collect();
    let count = values.len() - 1;
    for (value, window) in values[..count].iter_mut().zip(padded.windows(9)) {
        *value = dot(window, coefficients);
    }
}

/// Humble writes the results where it reads, skips the value four from the end, and smooths the last.
fn smooth_in_place(values: &mut [f32], history: [f32; 4], coefficients: &[f32; 9]) {
    let last = values.len() - 1;
    for index in (0..values.len()).filter(|index| *index != last - 4) {
        let window: [f32; 9] = std::array::from_fn(|offset| {
            let at = index + offset;
            if at < 4 { history[at] } else { values[(at - 4).min(last)] }
        });
        values[index] = dot(&window, coefficients);
    }
}

fn dot(window: &[f32], coefficients: &[f32; 9]) -> f32 {
    window.iter().zip(coefficients).map(|(value, coefficient)| value * coefficient).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn smoothed(values: Vec<f32>, history: [f32; 4], order: i64, release: Nav2Release) -> Vec<f32> {
        let mut sequence = ControlSequence::new(values.len());
        sequence.vx = values;
        let mut history = history.map(|vx| MppiControl { vx, ..MppiControl::default() });
        smooth(&mut sequence, &mut history, order, release, 1);
        sequence.vx
    }

    fn near(values: &[f32], expected: &[f32]) {
        for (value, expected) in values.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-5, "{values:?}");
        }
    }

    #[test]
    fn a_parabola_is_kept() {
        let parabola = |x: f32| 0.01 * x * x - 0.2 * x + 1.0;
        let values: Vec<f32> = (4..34).map(|i| parabola(i as f32)).collect();
        let history = [0.0, 1.0, 2.0, 3.0].map(parabola);
        let result = smoothed(values.clone(), history, 2, Nav2Release::Main);
        near(&result[..25], &values[..25]);
        assert_eq!(result[29], values[29], "the last value stays");
    }

    #[test]
    fn a_peak_is_spread() {
        let mut values = vec![0.0; 30];
        values[10] = 231.0;
        let result = smoothed(values.clone(), [0.0; 4], 2, Nav2Release::Jazzy);
        near(&result[6..15], &QUADRATIC_RATIO);
        let mean = smoothed(values, [0.0; 4], 1, Nav2Release::Main);
        near(&mean[6..15], &[231.0 / 9.0; 9]);
    }

    #[test]
    fn humble_reads_what_it_has_written() {
        let mut values = vec![0.0; 30];
        values[4] = 231.0;
        let result = smoothed(values, [0.0; 4], 2, Nav2Release::Humble);
        // -21, then 14 with a part of the -21 that was written before.
        near(&result[..2], &[-21.0, 14.0 + -21.0 * 54.0 / 231.0]);
    }

    #[test]
    fn short_sequences_are_kept() {
        let values: Vec<f32> = (0..20).map(|i| (i % 3) as f32).collect();
        assert_eq!(smoothed(values.clone(), [0.0; 4], 2, Nav2Release::Main), values);
    }
}
