//! A controller with proportional, integral and derivative parts.

use super::order::Order;

/// Gains and bounds as gz-math's `PID` and Gazebo Classic's `common::PID` have them: the answer is
/// `offset - p e - i ∫e - d de/dt`, with `e` what is there minus what is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gains {
    pub(crate) p: f64,
    pub(crate) i: f64,
    pub(crate) d: f64,
    /// Bounds of the integral part; none where the upper one is below the lower.
    pub(crate) integral: [f64; 2],
    /// Bounds of the answer; none where the upper one is below the lower.
    pub(crate) command: [f64; 2],
    pub(crate) offset: f64,
}

impl Gains {
    /// Those of gz-sim's joint controllers.
    pub(crate) fn read(order: &Order<'_>) -> Self {
        Self {
            p: order.number("p_gain"),
            i: order.number("i_gain"),
            d: order.number("d_gain"),
            integral: [order.number("i_min"), order.number("i_max")],
            command: [order.number("cmd_min"), order.number("cmd_max")],
            offset: order.number("cmd_offset"),
        }
    }
}

/// A controller at work.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pid {
    integral: f64,
    last_error: f64,
}

impl Pid {
    /// One update with an error, what is there minus what is wanted, after a time [s].
    pub(crate) fn update(&mut self, gains: &Gains, error: f64, dt_s: f64) -> f64 {
        if !(dt_s > 0.0 && error.is_finite()) {
            return 0.0;
        }
        self.integral = within(self.integral + gains.i * dt_s * error, gains.integral);
        let derivative = (error - self.last_error) / dt_s;
        self.last_error = error;
        let answer = gains.offset - gains.p * error - self.integral - gains.d * derivative;
        within(answer, gains.command)
    }
}

fn within(value: f64, [low, high]: [f64; 2]) -> f64 {
    if high < low { value } else { value.max(low).min(high) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: [f64; 2] = [0.0, -1.0];

    #[test]
    fn each_part_counts() {
        let gains = Gains { p: 2.0, i: 0.5, d: 0.1, integral: FREE, command: FREE, offset: 1.0 };
        let mut pid = Pid::default();
        // 1 - 2 * 3 - 0.5 * 3 * 0.1 - 0.1 * 3 / 0.1.
        assert!((pid.update(&gains, 3.0, 0.1) + 8.15).abs() < 1e-12);
        // The error stands still: no derivative, twice the integral.
        assert!((pid.update(&gains, 3.0, 0.1) + 5.3).abs() < 1e-12);
    }

    #[test]
    fn bounds_hold() {
        let gains = Gains {
            p: 1.0,
            i: 1.0,
            d: 0.0,
            integral: [-0.5, 0.5],
            command: [-2.0, 2.0],
            offset: 0.0,
        };
        let mut pid = Pid::default();
        assert_eq!(pid.update(&gains, 1.0, 10.0), -1.5);
        assert_eq!(pid.update(&gains, 9.0, 1.0), -2.0);
        assert_eq!(pid.update(&gains, f64::NAN, 1.0), 0.0);
    }
}
