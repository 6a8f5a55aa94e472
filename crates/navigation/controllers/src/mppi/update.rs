//! Update of the control sequence: a mean of the samples, weighted by their costs.
//!
//! Source: Williams, Drews, Goldfain, Rehg, Theodorou, "Information-theoretic model predictive control"
//! (2018), algorithm 2; `nav2_mppi_controller` `optimizer.cpp` (`updateControlSequence`).

use super::lane_math::exp;
use super::lanes::{LANES, Row, ZEROS, min, sum};
use super::rollout::NoiseScale;
use super::samples::{AxisSamples, Samples};
use super::sequence::ControlSequence;

/// Settings of the update.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct UpdateSettings {
    /// Temperature of the softmax function.
    pub(crate) temperature: f32,
    /// Weight of the control cost.
    pub(crate) gamma: f32,
    /// Standard deviations of the noise.
    pub(crate) scale: NoiseScale,
}

/// Adds the control cost to the costs and replaces the sequence by the weighted mean of the sampled controls.
/// The weights are written to `weights`.
pub(crate) fn update(
    sequence: &mut ControlSequence,
    samples: &Samples,
    costs: &mut [Row],
    weights: &mut Vec<Row>,
    settings: &UpdateSettings,
) {
    let UpdateSettings { temperature, gamma, scale } = *settings;
    add_control_cost(costs, &samples.vx, &sequence.vx, gamma, scale.vx);
    add_control_cost(costs, &samples.wz, &sequence.wz, gamma, scale.wz);
    add_control_cost(costs, &samples.vy, &sequence.vy, gamma, scale.vy);
    soften(costs, samples, temperature, weights);
    average(&mut sequence.vx, &samples.vx, weights);
    average(&mut sequence.wz, &samples.wz, weights);
    average(&mut sequence.vy, &samples.vy, weights);
}

/// Adds `gamma / std² * sum(noise * control)`. An axis without noise has no control cost.
fn add_control_cost(costs: &mut [Row], axis: &AxisSamples, sequence: &[f32], gamma: f32, std: f32) {
    if std <= 0.0 {
        return;
    }
    let factor = gamma / (std * std);
    for (costs, controls) in costs.iter_mut().zip(axis.controls.blocks()) {
        let mut total = ZEROS;
        for (row, value) in controls.iter().zip(sequence) {
            for lane in 0..LANES {
                total[lane] += (row[lane] - value) * value;
            }
        }
        for lane in 0..LANES {
            costs[lane] += factor * total[lane];
        }
    }
}

/// Softmax function of the negative costs.
fn soften(costs: &[Row], samples: &Samples, temperature: f32, weights: &mut Vec<Row>) {
    let lowest = lowest(costs, samples.count);
    let rate = -1.0 / temperature;
    weights.clear();
    let mut total = ZEROS;
    for (block, costs) in costs.iter().enumerate() {
        let mut row = ZEROS;
        for lane in 0..LANES {
            row[lane] = exp(rate * (costs[lane] - lowest));
        }
        row[samples.in_block(block)..].fill(0.0);
        for lane in 0..LANES {
            total[lane] += row[lane];
        }
        weights.push(row);
    }
    let scale = 1.0 / sum(&total);
    for row in weights {
        for lane in row {
            *lane *= scale;
        }
    }
}

/// Lowest cost of the samples.
pub(crate) fn lowest(costs: &[Row], count: usize) -> f32 {
    costs.as_flattened().iter().take(count).copied().fold(f32::INFINITY, min)
}

/// Mean of the controls by weight. Blocks without weight are skipped.
fn average(sequence: &mut [f32], axis: &AxisSamples, weights: &[Row]) {
    if axis.controls.block(0).is_empty() {
        return;
    }
    let mut totals = vec![ZEROS; sequence.len()];
    for (weights, controls) in weights.iter().zip(axis.controls.blocks()) {
        if weights.iter().all(|weight| *weight == 0.0) {
            continue;
        }
        for (total, control) in totals.iter_mut().zip(controls) {
            for lane in 0..LANES {
                total[lane] += weights[lane] * control[lane];
            }
        }
    }
    for (value, total) in sequence.iter_mut().zip(&totals) {
        *value = sum(total);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn samples(controls: &[f32]) -> Samples {
        let mut samples = Samples::new(controls.len(), 1, false);
        for (sample, value) in controls.iter().enumerate() {
            samples.vx.controls.set(sample, 0, *value);
        }
        samples
    }

    fn settings(temperature: f32, gamma: f32) -> UpdateSettings {
        UpdateSettings { temperature, gamma, scale: NoiseScale { vx: 0.5, vy: 0.0, wz: 0.0 } }
    }

    fn check(costs: &[f32], controls: &[f32], gamma: f32, expected: f32) {
        let mut rows = vec![ZEROS; 1];
        rows[0][..costs.len()].copy_from_slice(costs);
        let mut sequence = ControlSequence::new(1);
        sequence.vx[0] = 1.0;
        let mut weights = Vec::new();
        update(&mut sequence, &samples(controls), &mut rows, &mut weights, &settings(1.0, gamma));
        assert!((sequence.vx[0] - expected).abs() < 1e-6, "{}", sequence.vx[0]);
        assert!((weights[0].iter().sum::<f32>() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn samples_count_by_their_costs() {
        check(&[5.0, 5.0], &[0.0, 1.0], 0.0, 0.5);
        // The weights are 1 and 1/3.
        check(&[1.0, 1.0 + libm::logf(3.0_f32)], &[0.0, 1.0], 0.0, 0.25);
        check(&[0.0, 1e6], &[0.3, 9.0], 0.0, 0.3);
        // Control cost: 0.25 / 0.5² * (c - 1) * 1 is -1 and 0.
        check(&[0.0, 0.0], &[0.0, 1.0], 0.25, 1.0 / (1.0 + libm::expf(1.0_f32)));
    }

    proptest! {
        #[test]
        fn the_mean_stays_within_the_samples(
            controls in proptest::collection::vec(-1.0_f32..1.0, 1..80),
            costs in proptest::collection::vec(0.0_f32..1e6, 96),
        ) {
            let samples = samples(&controls);
            let mut rows = vec![ZEROS; samples.blocks()];
            rows.as_flattened_mut().copy_from_slice(&costs[..samples.blocks() * LANES][..]);
            let mut sequence = ControlSequence::new(1);
            update(&mut sequence, &samples, &mut rows, &mut Vec::new(), &settings(0.3, 0.015));
            let (low, high) = controls.iter().fold((1.0_f32, -1.0_f32), |(l, h), c| (l.min(*c), h.max(*c)));
            prop_assert!((low - 1e-5..=high + 1e-5).contains(&sequence.vx[0]));
        }
    }
}
