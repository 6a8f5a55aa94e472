//! Sampling of controls, and the motions that follow from them.
//!
//! Source: `nav2_mppi_controller` `optimizer.cpp` (`generateNoisedTrajectories`), `motion_models.hpp`.

use super::lane_math::sin_cos;
use super::lanes::{LANES, Row, ZEROS, clamp};
use super::limits::{Change, Changes, MppiModel};
use super::noise::BlockNoise;
use super::samples::{AxisSamples, Samples};
use super::sequence::{ControlSequence, MppiControl};

/// Lowest speed of a sequence whose curvature samples keep \[m/s\].
const MIN_CURVE_SPEED_M_PER_S: f32 = 0.01;

/// State at the start of all samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Start {
    /// Position \[m\].
    pub(crate) x: f32,
    /// Position \[m\].
    pub(crate) y: f32,
    /// Heading \[rad\].
    pub(crate) yaw: f32,
    /// Velocity.
    pub(crate) speed: MppiControl,
}

/// Delays of the robot's response to commands, in time steps, with the commands that are in flight, oldest
/// first (main).
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Delays {
    pub(crate) vx: Vec<f32>,
    pub(crate) vy: Vec<f32>,
    pub(crate) wz: Vec<f32>,
}

impl Delays {
    /// Creates delays with commands of zero; times are rounded to steps.
    pub(crate) fn new(delays_s: [f64; 3], step_s: f64) -> Self {
        let buffer = |delay_s: f64| {
            let steps = libm::floor(delay_s / step_s + 0.5);
            vec![0.0; if steps > 0.0 { steps as usize } else { 0 }]
        };
        Self { vx: buffer(delays_s[0]), vy: buffer(delays_s[1]), wz: buffer(delays_s[2]) }
    }

    /// Appends a command.
    pub(crate) fn push(&mut self, command: MppiControl) {
        let values = [command.vx, command.vy, command.wz];
        for (buffer, value) in [&mut self.vx, &mut self.vy, &mut self.wz].into_iter().zip(values) {
            if let Some(first) = buffer.first_mut() {
                *first = value;
                buffer.rotate_left(1);
            }
        }
    }

    /// Sets all commands in flight to zero.
    pub(crate) fn clear(&mut self) {
        for buffer in [&mut self.vx, &mut self.vy, &mut self.wz] {
            buffer.fill(0.0);
        }
    }
}

/// Rules of the prediction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<'a> {
    pub(crate) model: MppiModel,
    /// Possible changes of the velocities in one step.
    pub(crate) changes: Changes,
    /// Duration of a step \[s\].
    pub(crate) step_s: f32,
    /// Replaces the sampled controls by the velocities that are reached.
    pub(crate) limits_controls: bool,
    pub(crate) delays: &'a Delays,
    /// Sequence to which noise was added.
    pub(crate) sequence: &'a ControlSequence,
}

/// Standard deviations of the noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NoiseScale {
    pub(crate) vx: f32,
    pub(crate) vy: f32,
    pub(crate) wz: f32,
}

/// Fills the controls of all samples with noise.
pub(crate) fn draw_noise(samples: &mut Samples, seed: u64, draw: u64, scale: NoiseScale) {
    for block in 0..samples.blocks() {
        let mut noise = BlockNoise::new(seed, draw, block);
        noise.fill(samples.vx.controls.block_mut(block), scale.vx);
        noise.fill(samples.wz.controls.block_mut(block), scale.wz);
        noise.fill(samples.vy.controls.block_mut(block), scale.vy);
    }
}

/// Adds the sequence to the controls, which are noise.
pub(crate) fn add_sequence(samples: &mut Samples, sequence: &ControlSequence) {
    let blocks = samples.blocks();
    let axes = [
        (&mut samples.vx, &sequence.vx),
        (&mut samples.wz, &sequence.wz),
        (&mut samples.vy, &sequence.vy),
    ];
    for (axis, values) in axes {
        for block in 0..blocks {
            for (row, value) in axis.controls.block_mut(block).iter_mut().zip(values) {
                for lane in row {
                    *lane += value;
                }
            }
        }
    }
}

/// Predicts velocities and trajectories of all samples.
pub(crate) fn predict(samples: &mut Samples, start: &Start, motion: &Motion<'_>) {
    for block in 0..samples.blocks() {
        let speed = start.speed;
        predict_axis(
            &mut samples.vx,
            block,
            speed.vx,
            motion,
            motion.changes.vx,
            &motion.delays.vx,
        );
        let wz = motion.changes.wz;
        match motion.model.max_sample_curvature() {
            Some(curvature) => {
                let vx = samples.vx.velocities.block(block);
                predict_curves(&mut samples.wz, block, speed.wz, motion, vx, curvature);
            }
            None => predict_turns(&mut samples.wz, block, speed.wz, motion, [wz.loss, wz.gain]),
        }
        if motion.model.is_holonomic() {
            predict_axis(
                &mut samples.vy,
                block,
                speed.vy,
                motion,
                motion.changes.vy,
                &motion.delays.vy,
            );
        }
        integrate(samples, block, start, motion.step_s);
    }
}

/// Velocities along an axis: the first is that of the robot, each other follows the control before it.
fn predict_axis(
    axis: &mut AxisSamples,
    block: usize,
    first: f32,
    motion: &Motion<'_>,
    change: Change,
    delayed: &[f32],
) {
    let controls = axis.controls.block_mut(block);
    let velocities = axis.velocities.block_mut(block);
    let mut last: Row = [first; LANES];
    let Some((row, rows)) = velocities.split_first_mut() else { return };
    *row = last;
    for (control, velocity) in controls.iter_mut().zip(rows) {
        for lane in 0..LANES {
            last[lane] = change.reach(control[lane], last[lane]);
        }
        *velocity = last;
        if motion.limits_controls {
            *control = last;
        }
    }
    delay(velocities, delayed);
}

/// Turn rates, whose limits are the same in both directions.
fn predict_turns(
    axis: &mut AxisSamples,
    block: usize,
    first: f32,
    motion: &Motion<'_>,
    [loss, gain]: [f32; 2],
) {
    let controls = axis.controls.block_mut(block);
    let velocities = axis.velocities.block_mut(block);
    let mut last: Row = [first; LANES];
    let Some((row, rows)) = velocities.split_first_mut() else { return };
    *row = last;
    for (control, velocity) in controls.iter_mut().zip(rows) {
        for lane in 0..LANES {
            last[lane] = clamp(control[lane], last[lane] + loss, last[lane] + gain);
        }
        *velocity = last;
        if motion.limits_controls {
            *control = last;
        }
    }
    delay(velocities, &motion.delays.wz);
}

/// Turn rates of steered wheels. The curvature is that of the sequence plus noise: a sample that is faster or slower than
/// the sequence drives along its curve. No curve is narrower than the robot can drive, also where that exceeds the
/// angular acceleration. The controls become the turn rates that are reached.
fn predict_curves(
    axis: &mut AxisSamples,
    block: usize,
    first: f32,
    motion: &Motion<'_>,
    vx: &[Row],
    max_curvature: f32,
) {
    let Change { gain, loss } = motion.changes.wz;
    let controls = axis.controls.block_mut(block);
    let velocities = axis.velocities.block_mut(block);
    let mut last: Row = [first; LANES];
    let Some((row, rows)) = velocities.split_first_mut() else { return };
    *row = last;
    for (step, ((control, velocity), vx)) in controls.iter_mut().zip(rows).zip(&vx[1..]).enumerate()
    {
        let mean = motion.sequence.at(step);
        let curvature = if mean.vx.abs() < MIN_CURVE_SPEED_M_PER_S {
            0.0
        } else {
            clamp(mean.wz / mean.vx, -max_curvature, max_curvature)
        };
        for lane in 0..LANES {
            let limit = vx[lane].abs() * max_curvature;
            let wanted = control[lane] + curvature * (vx[lane] - mean.vx);
            let reached = clamp(wanted, last[lane] + loss, last[lane] + gain);
            last[lane] = clamp(reached, -limit, limit);
        }
        *velocity = last;
        *control = last;
    }
    delay(velocities, &motion.delays.wz);
}

/// Moves velocities back by a delay; the commands in flight fill the gap.
fn delay(velocities: &mut [Row], in_flight: &[f32]) {
    let offset = in_flight.len();
    if offset == 0 {
        return;
    }
    let steps = velocities.len();
    for step in (1..=steps.saturating_sub(offset)).rev() {
        velocities[offset + step - 1] = velocities[step];
    }
    for (row, command) in velocities.iter_mut().zip(in_flight).skip(1) {
        *row = [*command; LANES];
    }
}

/// Poses after each step: a step moves along the heading before it.
fn integrate(samples: &mut Samples, block: usize, start: &Start, step_s: f32) {
    let steps = samples.steps;
    let (vx, wz) = (samples.vx.velocities.block(block), samples.wz.velocities.block(block));
    let vy = samples.vy.velocities.block(block);
    let x_rows = samples.x.block_mut(block);
    let y_rows = samples.y.block_mut(block);
    let yaw_rows = samples.yaw.block_mut(block);
    let (mut x, mut y, mut yaw) = ([start.x; LANES], [start.y; LANES], [start.yaw; LANES]);
    let (sine, cosine) = sin_cos(start.yaw);
    let (mut sines, mut cosines) = ([sine; LANES], [cosine; LANES]);
    for step in 0..steps {
        let (vx, wz) = (&vx[step], &wz[step]);
        let vy = vy.get(step).unwrap_or(&ZEROS);
        for lane in 0..LANES {
            x[lane] += (vx[lane] * cosines[lane] - vy[lane] * sines[lane]) * step_s;
            y[lane] += (vx[lane] * sines[lane] + vy[lane] * cosines[lane]) * step_s;
            yaw[lane] += wz[lane] * step_s;
        }
        for lane in 0..LANES {
            (sines[lane], cosines[lane]) = sin_cos(yaw[lane]);
        }
        (x_rows[step], y_rows[step], yaw_rows[step]) = (x, y, yaw);
    }
}

/// Poses after each step of one sequence of velocities: x \[m\], y \[m\], yaw \[rad\].
pub(crate) fn trajectory(sequence: &ControlSequence, start: &Start, step_s: f32) -> Vec<[f32; 3]> {
    let (mut x, mut y, mut yaw) = (start.x, start.y, start.yaw);
    let step = |step: usize| {
        let MppiControl { vx, vy, wz } = sequence.at(step);
        let (sine, cosine) = sin_cos(yaw);
        x += (vx * cosine - vy * sine) * step_s;
        y += (vx * sine + vy * cosine) * step_s;
        yaw += wz * step_s;
        [x, y, yaw]
    };
    (0..sequence.len()).map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mppi::limits::MppiAccelerationLimits;

    fn near(values: impl IntoIterator<Item = f32>, expected: &[f32]) {
        let values: Vec<f32> = values.into_iter().collect();
        assert_eq!(values.len(), expected.len());
        for (value, expected) in values.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-5, "{values:?}");
        }
    }

    fn rollout(model: MppiModel, controls: &[[f32; 3]], start: Start, delays: &Delays) -> Samples {
        let mut samples = Samples::new(1, controls.len(), model.is_holonomic());
        for (step, [vx, vy, wz]) in controls.iter().enumerate() {
            samples.vx.controls.set(0, step, *vx);
            samples.vy.controls.set(0, step, *vy);
            samples.wz.controls.set(0, step, *wz);
        }
        let limits = MppiAccelerationLimits {
            ax_max: 3.0,
            ax_min: -3.0,
            ay_max: 3.0,
            ay_min: -3.0,
            az_max: 4.0,
        };
        let motion = Motion {
            model,
            changes: limits.within(0.1),
            step_s: 0.1,
            limits_controls: false,
            delays,
            sequence: &ControlSequence::new(controls.len()),
        };
        predict(&mut samples, &start, &motion);
        samples
    }

    fn steps(field: &super::super::samples::Field, count: usize) -> Vec<f32> {
        (0..count).map(|step| field.at(0, step)).collect()
    }

    #[test]
    fn velocities_follow_the_controls_a_step_later() {
        let samples = rollout(
            MppiModel::DiffDrive,
            &[[0.5, 0.0, 1.0]; 4],
            Start::default(),
            &Delays::default(),
        );
        near(steps(&samples.vx.velocities, 4), &[0.0, 0.3, 0.5, 0.5]);
        near(steps(&samples.wz.velocities, 4), &[0.0, 0.4, 0.8, 1.0]);
        near(steps(&samples.yaw, 4), &[0.0, 0.04, 0.12, 0.22]);
        // The second move is straight, the third along 0.04 rad, the fourth along 0.12 rad.
        let x = 0.03 + 0.05 * libm::cosf(0.04_f32);
        near(steps(&samples.x, 4), &[0.0, 0.03, x, x + 0.05 * libm::cosf(0.12_f32)]);
        near(steps(&samples.y, 3), &[0.0, 0.0, 0.05 * libm::sinf(0.04_f32)]);
    }

    #[test]
    fn an_omnidirectional_robot_moves_sideways() {
        let speed = MppiControl { vx: 0.0, vy: 0.2, wz: 0.0 };
        let start = Start { x: 1.0, y: 2.0, yaw: std::f32::consts::FRAC_PI_2, speed };
        let samples = rollout(MppiModel::Omni, &[[0.0, 0.2, 0.0]; 2], start, &Delays::default());
        // The left of a robot that looks along y is -x.
        near(steps(&samples.x, 2), &[0.98, 0.96]);
        near(steps(&samples.y, 2), &[2.0, 2.0]);
    }

    #[test]
    fn samples_of_a_car_keep_the_curvature_of_the_sequence() {
        let model = MppiModel::Ackermann { min_turning_radius_m: 0.5, samples_curvatures: true };
        let check = |mean: [f32; 2], control: [f32; 2], expected: f32| {
            let mut samples = Samples::new(1, 2, false);
            samples.vx.controls.set(0, 0, control[0]);
            samples.wz.controls.set(0, 0, control[1]);
            let mut sequence = ControlSequence::new(2);
            sequence.set(0, MppiControl { vx: mean[0], vy: 0.0, wz: mean[1] });
            let motion = Motion {
                model,
                changes: Changes::FREE,
                step_s: 0.1,
                limits_controls: false,
                delays: &Delays::default(),
                sequence: &sequence,
            };
            predict(&mut samples, &Start::default(), &motion);
            near([samples.wz.velocities.at(0, 1), samples.wz.controls.at(0, 0)], &[expected; 2]);
        };
        // A curvature of 1.5 per metre, driven twice as fast, with noise of 0.1 rad/s.
        check([0.2, 0.3], [0.4, 0.4], 0.7);
        // The narrowest curve has 2 per metre, also backwards.
        check([0.2, 0.3], [0.1, 0.8], 0.2);
        check([0.2, 0.3], [-0.2, -0.5], -0.4);
        // A sequence without speed has no curvature.
        check([0.0, 0.0], [0.3, 0.2], 0.2);
    }

    #[test]
    fn a_delayed_robot_first_follows_the_commands_in_flight() {
        let mut delays = Delays::new([0.2, 0.0, 0.0], 0.1);
        delays.push(MppiControl { vx: 0.1, ..MppiControl::default() });
        delays.push(MppiControl { vx: 0.2, ..MppiControl::default() });
        assert_eq!(delays.vx, [0.1, 0.2]);
        let samples =
            rollout(MppiModel::DiffDrive, &[[0.5, 0.0, 0.0]; 5], Start::default(), &delays);
        near(steps(&samples.vx.velocities, 5), &[0.0, 0.2, 0.3, 0.5, 0.5]);
    }

    #[test]
    fn one_sequence_moves_like_a_sample() {
        let mut sequence = ControlSequence::new(2);
        sequence.vx = vec![0.2, 0.4];
        sequence.wz = vec![1.0, 0.0];
        let poses = trajectory(&sequence, &Start::default(), 0.1);
        near(poses[1], &[0.02 + 0.04 * libm::cosf(0.1_f32), 0.04 * libm::sinf(0.1_f32), 0.1]);
    }
}
