//! The control sequence that the controller improves in each cycle.

use periplus_costmap::Nav2Release;

use super::lanes::clamp;
use super::limits::{Changes, MppiAccelerationLimits, MppiModel, MppiVelocityLimits};

/// One control of all axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MppiControl {
    /// Velocity forwards \[m/s\].
    pub vx: f32,
    /// Velocity to the left \[m/s\].
    pub vy: f32,
    /// Turn rate \[rad/s\].
    pub wz: f32,
}

/// Controls for all time steps; `vy` is 0 unless the robot is omnidirectional.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ControlSequence {
    /// Velocities forwards \[m/s\].
    pub vx: Vec<f32>,
    /// Velocities to the left \[m/s\].
    pub vy: Vec<f32>,
    /// Turn rates \[rad/s\].
    pub wz: Vec<f32>,
}

/// Settings of the limits on a sequence.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SequenceLimits {
    pub(crate) release: Nav2Release,
    pub(crate) model: MppiModel,
    pub(crate) velocity: MppiVelocityLimits,
    pub(crate) acceleration: MppiAccelerationLimits,
    /// Duration of a time step \[s\].
    pub(crate) step_s: f32,
    /// Period of the controller \[s\].
    pub(crate) period_s: f32,
    /// True if the sequence advances by a step in each cycle.
    pub(crate) shifts: bool,
}

impl ControlSequence {
    /// Creates a sequence of zeros.
    #[must_use]
    pub fn new(steps: usize) -> Self {
        Self { vx: vec![0.0; steps], vy: vec![0.0; steps], wz: vec![0.0; steps] }
    }

    /// Returns the number of time steps.
    #[must_use]
    pub fn len(&self) -> usize {
        self.vx.len()
    }

    /// Returns true if there are no time steps.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vx.is_empty()
    }

    /// Returns the control of a time step; zero beyond the end.
    #[must_use]
    pub fn at(&self, step: usize) -> MppiControl {
        let value = |axis: &Vec<f32>| axis.get(step).copied().unwrap_or(0.0);
        MppiControl { vx: value(&self.vx), vy: value(&self.vy), wz: value(&self.wz) }
    }

    /// Sets the control of a time step; no effect beyond the end.
    pub(crate) fn set(&mut self, step: usize, control: MppiControl) {
        let values = [control.vx, control.vy, control.wz];
        for (axis, value) in [&mut self.vx, &mut self.vy, &mut self.wz].into_iter().zip(values) {
            if let Some(slot) = axis.get_mut(step) {
                *slot = value;
            }
        }
    }

    /// Removes the first step and repeats the last.
    pub fn advance(&mut self) {
        for axis in [&mut self.vx, &mut self.vy, &mut self.wz] {
            if axis.len() > 1 {
                axis.rotate_left(1);
                let last = axis.len() - 1;
                axis[last] = axis[last - 1];
            }
        }
    }

    /// Makes the first control reachable from a speed, before noise is added (main).
    pub(crate) fn start_from(&mut self, speed: MppiControl, limits: &SequenceLimits) {
        if limits.release != Nav2Release::Main {
            return;
        }
        let first = if limits.shifts {
            // The first control is that of now; the second is sent.
            MppiControl { vy: if limits.model.is_holonomic() { speed.vy } else { 0.0 }, ..speed }
        } else {
            let changes = limits.acceleration.within(limits.period_s);
            reached(self.at(0), speed, &changes, limits.model)
        };
        self.set(0, first);
    }

    /// Limits velocities and accelerations, by the rules of the release.
    pub(crate) fn limit(&mut self, speed: MppiControl, limits: &SequenceLimits) {
        match limits.release {
            Nav2Release::Humble => self.limit_velocities(limits),
            Nav2Release::Main => self.limit_from_speed(speed, limits),
            _ => self.limit_from_first(limits),
        }
        limits.model.limit_turns(self);
    }

    fn limit_velocities(&mut self, limits: &SequenceLimits) {
        for step in 0..self.len() {
            self.set(step, within(self.at(step), &limits.velocity));
        }
    }

    /// Jazzy and Kilted: the first control is free within the velocities.
    fn limit_from_first(&mut self, limits: &SequenceLimits) {
        let changes = limits.acceleration.within(limits.step_s);
        let mut last = within(self.at(0), &limits.velocity);
        self.set(0, last);
        for step in 1..self.len() {
            let wanted = within(self.at(step), &limits.velocity);
            last = MppiControl {
                vx: changes.vx.reach(wanted.vx, last.vx),
                vy: changes.vy.reach(wanted.vy, last.vy),
                wz: clamp(wanted.wz, last.wz + changes.wz.loss, last.wz + changes.wz.gain),
            };
            self.set(step, last);
        }
    }

    /// Main: the first control is reached from the speed within a period of the controller.
    fn limit_from_speed(&mut self, speed: MppiControl, limits: &SequenceLimits) {
        limits.model.limit_turns(self);
        let mut last = speed;
        if limits.shifts {
            self.set(0, speed);
        }
        for step in 0..self.len() {
            let duration_s = if step == 0 { limits.period_s } else { limits.step_s };
            let changes = limits.acceleration.within(duration_s);
            last = reached(within(self.at(step), &limits.velocity), last, &changes, limits.model);
            self.set(step, last);
        }
    }
}

/// Control within the limits of the velocity.
fn within(control: MppiControl, limits: &MppiVelocityLimits) -> MppiControl {
    MppiControl {
        vx: clamp(control.vx, limits.vx_min, limits.vx_max),
        vy: clamp(control.vy, -limits.vy_max, limits.vy_max),
        wz: clamp(control.wz, -limits.wz_max, limits.wz_max),
    }
}

/// Control nearest to a wanted one that is reached from the last.
fn reached(
    wanted: MppiControl,
    last: MppiControl,
    changes: &Changes,
    model: MppiModel,
) -> MppiControl {
    MppiControl {
        vx: changes.vx.reach_from_rest(wanted.vx, last.vx),
        vy: if model.is_holonomic() { changes.vy.reach_from_rest(wanted.vy, last.vy) } else { 0.0 },
        wz: clamp(wanted.wz, last.wz + changes.wz.loss, last.wz + changes.wz.gain),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(release: Nav2Release) -> SequenceLimits {
        SequenceLimits {
            release,
            model: MppiModel::DiffDrive,
            velocity: MppiVelocityLimits { vx_max: 0.5, vx_min: -0.35, vy_max: 0.5, wz_max: 1.9 },
            acceleration: MppiAccelerationLimits {
                ax_max: 2.0,
                ax_min: -4.0,
                ay_max: 2.0,
                ay_min: -2.0,
                az_max: 4.0,
            },
            step_s: 0.1,
            period_s: 0.1,
            shifts: true,
        }
    }

    fn check(release: Nav2Release, speed: f32, vx: &[f32], expected: &[f32]) {
        let mut sequence = ControlSequence::new(vx.len());
        sequence.vx = vx.to_vec();
        sequence.limit(MppiControl { vx: speed, ..MppiControl::default() }, &limits(release));
        for (value, expected) in sequence.vx.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-6, "{release}: {:?}", sequence.vx);
        }
    }

    #[test]
    fn sequences_are_limited_by_the_rules_of_the_release() {
        let wild = [0.9, 0.9, -0.9, -0.9];
        check(Nav2Release::Humble, 0.0, &wild, &[0.5, 0.5, -0.35, -0.35]);
        check(Nav2Release::Jazzy, 0.0, &wild, &[0.5, 0.5, 0.1, -0.3]);
        check(Nav2Release::Main, 0.0, &wild, &[0.0, 0.2, -0.2, -0.35]);
    }

    #[test]
    fn a_sequence_advances_and_repeats_its_end() {
        let mut sequence = ControlSequence::new(3);
        sequence.vx = vec![1.0, 2.0, 3.0];
        sequence.advance();
        assert_eq!(sequence.vx, [2.0, 3.0, 3.0]);
    }

    #[test]
    fn a_sequence_starts_from_the_speed_of_the_robot() {
        let speed = MppiControl { vx: 0.3, vy: 0.2, wz: 0.1 };
        let first = |release, shifts| {
            let mut sequence = ControlSequence::new(2);
            sequence.vx = vec![0.9, 0.9];
            sequence.start_from(speed, &SequenceLimits { shifts, ..limits(release) });
            sequence.vx[0]
        };
        assert_eq!(first(Nav2Release::Main, true), 0.3);
        assert_eq!(first(Nav2Release::Main, false), 0.5);
        assert_eq!(first(Nav2Release::Jazzy, true), 0.9);
    }
}
