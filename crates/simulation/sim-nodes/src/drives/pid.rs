//! PID controller.

use super::build_context::BuildContext;

/// Gains and bounds of gz-math's `PID` and Gazebo Classic's `common::PID`: the output is `offset - p
/// e - i ∫e - d de/dt` with the error `e` = actual - desired.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gains {
    pub(crate) p: f64,
    pub(crate) i: f64,
    pub(crate) d: f64,
    /// Bounds of the integral part; unbounded if the upper one is below the lower.
    pub(crate) integral: [f64; 2],
    /// Bounds of the output; unbounded if the upper one is below the lower.
    pub(crate) command: [f64; 2],
    pub(crate) offset: f64,
}

impl Gains {
    /// Reads the gains of gz-sim's joint controllers.
    pub(crate) fn read(context: &BuildContext<'_>) -> Self {
        Self {
            p: context.number("p_gain"),
            i: context.number("i_gain"),
            d: context.number("d_gain"),
            integral: [context.number("i_min"), context.number("i_max")],
            command: [context.number("cmd_min"), context.number("cmd_max")],
            offset: context.number("cmd_offset"),
        }
    }
}

/// State of a PID controller.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pid {
    integral: f64,
    last_error: f64,
}

impl Pid {
    /// Returns the output for an error (actual - desired) after a time [s].
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
        // Constant error: no derivative, twice the integral.
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
