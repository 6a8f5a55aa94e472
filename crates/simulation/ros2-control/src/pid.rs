//! PID controller of a joint.

/// Gains of a [`PidController`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PidGains {
    /// Proportional gain.
    pub p: f64,
    /// Integral gain [1/s].
    pub i: f64,
    /// Derivative gain [s].
    pub d: f64,
    /// Maximum size of the integral term; zero for none.
    pub i_clamp: f64,
}

/// PID controller with a limited integral term.
///
/// Source: `Pid::computeCommand` of `control_toolbox`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PidController {
    integral: f64,
}

impl PidController {
    /// Returns the output for an error and its derivative after a time [s].
    pub fn update(&mut self, gains: &PidGains, error: f64, error_rate: f64, dt_s: f64) -> f64 {
        if dt_s <= 0.0 || !error.is_finite() || !error_rate.is_finite() {
            return 0.0;
        }
        self.integral += error * dt_s;
        let mut integral_term = gains.i * self.integral;
        if gains.i_clamp > 0.0 && integral_term.abs() > gains.i_clamp {
            integral_term = gains.i_clamp.copysign(integral_term);
            self.integral = integral_term / gains.i;
        }
        gains.p * error + integral_term + gains.d * error_rate
    }

    /// Forgets the integral.
    pub fn reset(&mut self) {
        self.integral = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_terms_and_a_clamp() {
        let gains = PidGains { p: 2.0, i: 1.0, d: 0.5, i_clamp: 0.15 };
        let mut pid = PidController::default();
        // 2 * 1 + 1 * 0.1 + 0.5 * 4.
        assert!((pid.update(&gains, 1.0, 4.0, 0.1) - 4.1).abs() < 1e-12);
        assert!((pid.update(&gains, 1.0, 0.0, 0.1) - 2.15).abs() < 1e-12);
        pid.reset();
        assert!((pid.update(&gains, 1.0, 0.0, 0.1) - 2.1).abs() < 1e-12);
        assert_eq!(pid.update(&gains, f64::NAN, 0.0, 0.1), 0.0);
    }
}
