//! Exactly commanded axes.

use crate::joints::{AxisRecord, AxisState, JointCommand, POSITION_GAIN_PER_S};

/// Advances all axes by a time [s]: those with commands first, then mimic axes, leaders first.
pub(super) fn advance(axes: &mut [AxisRecord], followers: &[usize], dt_s: f64) {
    for axis in axes.iter_mut() {
        if axis.mimics.is_none() {
            axis.set_state(commanded(axis, dt_s));
        }
    }
    for &number in followers {
        let Some(follow) = axes[number].mimics else { continue };
        let AxisState { position, velocity, .. } = axes[follow.leader].state;
        let axis = &mut axes[number];
        let wanted = follow.multiplier * position + follow.offset;
        let held = wanted.clamp(axis.lower, axis.upper);
        let velocity = if held == wanted { follow.multiplier * velocity } else { 0.0 };
        axis.set_state(AxisState { position: held, velocity, effort: 0.0 });
    }
}

/// Returns position and velocity of an axis after a time [s].
fn commanded(axis: &AxisRecord, dt_s: f64) -> AxisState {
    let before = axis.state.position;
    let (wanted, velocity) = match axis.command {
        JointCommand::Velocity { target, max_effort } if max_effort > 0.0 => {
            let velocity = target.clamp(-axis.velocity, axis.velocity);
            (before + velocity * dt_s, velocity)
        }
        JointCommand::Position { target, max_speed, max_effort } if max_effort > 0.0 => {
            let target = target.clamp(axis.lower, axis.upper);
            approach(before, target, max_speed.min(axis.velocity), dt_s)
        }
        // Without physics an effort has no effect.
        _ => (before, 0.0),
    };
    let position = wanted.clamp(axis.lower, axis.upper);
    let velocity = if position == wanted { velocity } else { 0.0 };
    AxisState { position, velocity, effort: 0.0 }
}

/// Returns the exact solution of `speed = gain * error` with a maximum speed: constant speed until
/// the error is small enough, then exponential decay.
fn approach(before: f64, target: f64, most: f64, dt_s: f64) -> (f64, f64) {
    let way = target - before;
    let slow_way = most / POSITION_GAIN_PER_S;
    let fast_s = if way.abs() > slow_way { (way.abs() - slow_way) / most } else { 0.0 };
    if dt_s < fast_s {
        let speed = most.copysign(way);
        return (before + speed * dt_s, speed);
    }
    if way == 0.0 {
        return (target, 0.0);
    }
    let left =
        way.abs().min(slow_way).copysign(way) * libm::exp(-POSITION_GAIN_PER_S * (dt_s - fast_s));
    (target - left, left * POSITION_GAIN_PER_S)
}

impl AxisRecord {
    fn set_state(&mut self, state: AxisState) {
        self.changed = self.state != state;
        self.state = state;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_radians_at_one_radian_per_second() {
        // 1/50 rad before the target it begins to slow down.
        let (at, speed) = approach(0.0, 2.0, 1.0, 1.0);
        assert!((at - 1.0).abs() < 1e-12 && speed == 1.0);
        let (at, speed) = approach(0.0, 2.0, 1.0, 1.98 + 0.02);
        let left = 0.02 * libm::exp(-1.0);
        assert!((at - (2.0 - left)).abs() < 1e-12 && (speed - 50.0 * left).abs() < 1e-12);
        assert!((approach(0.0, 2.0, 1.0, 3.0).0 - 2.0).abs() < 1e-12);
        assert_eq!(approach(1.0, 1.0, f64::INFINITY, 1.0), (1.0, 0.0));
    }

    #[test]
    fn one_long_way_is_many_short_ones() {
        let mut at = 3.0;
        for _ in 0..500 {
            at = approach(at, -1.0, 2.5, 0.004).0;
        }
        assert!((at - approach(3.0, -1.0, 2.5, 2.0).0).abs() < 1e-9, "{at}");
    }
}
