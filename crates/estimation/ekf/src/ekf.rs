//! Extended Kalman filter.

use crate::correct::{Outcome, correct};
use crate::motion::predict;
use crate::settings::Settings;
use crate::state::{Covariance, Estimate, Measurement, STATE_DIMENSIONS, State, Variable};

/// Maximum number of queued measurements; beyond it the oldest are used at once.
const MAX_QUEUED_COUNT: usize = 10_000;
/// Variance of the planar constraints in two-dimensional mode.
const PLANAR_VARIANCE_FACTOR: f64 = 1e-6;
/// Maximum time step of a prediction \[s\].
const LONGEST_STEP_S: f64 = 0.1;
/// Gap after which the state is not predicted \[s\].
const LONGEST_GAP_S: f64 = 100.0;

/// Reason for which a measurement was rejected.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The Mahalanobis distance is above the threshold.
    TooFar {
        /// Name of the input.
        source: String,
        /// Mahalanobis distance.
        deviations: f64,
    },
    /// The measurement has NaN, or an invalid covariance.
    Broken {
        /// Name of the input.
        source: String,
    },
}

/// Extended Kalman filter with a measurement queue: measurements are used in the order of their
/// stamps.
#[derive(Clone, Debug)]
pub struct Ekf {
    settings: Settings,
    estimate: Option<Estimate>,
    /// Stamp of the last measurement \[ns\].
    measured_ns: i64,
    waiting: Vec<Measurement>,
    refusals: Vec<Refusal>,
}

impl Ekf {
    /// Creates a filter without an estimate.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            estimate: None,
            measured_ns: i64::MIN,
            waiting: Vec::new(),
            refusals: Vec::new(),
        }
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Replaces the settings and keeps the estimate.
    pub fn set_settings(&mut self, settings: Settings) {
        self.settings = settings;
    }

    /// Returns the estimate; none before the first measurement.
    #[must_use]
    pub fn estimate(&self) -> Option<&Estimate> {
        self.estimate.as_ref()
    }

    /// Returns the stamp of the last measurement \[ns\].
    #[must_use]
    pub fn measured_ns(&self) -> Option<i64> {
        self.estimate.as_ref().map(|_| self.measured_ns)
    }

    /// Resets everything except the settings.
    pub fn reset(&mut self) {
        *self = Self::new(self.settings.clone());
    }

    /// Sets the estimate and drops queued measurements.
    pub fn set_estimate(&mut self, estimate: Estimate) {
        self.waiting.clear();
        self.measured_ns = estimate.time_ns;
        self.estimate = Some(estimate);
    }

    /// Queues a measurement for [`Ekf::run_until`].
    pub fn push(&mut self, measurement: Measurement) {
        if !measurement.is_finite() {
            self.refusals.push(Refusal::Broken { source: measurement.source });
        } else if !measurement.is_empty() && self.waiting.len() < MAX_QUEUED_COUNT {
            self.waiting.push(measurement);
        }
    }

    /// Processes measurements up to a time \[ns\], and predicts the state after `sensor_timeout`
    /// without one. Returns true if the estimate has changed.
    pub fn run_until(&mut self, now_ns: i64) -> bool {
        // Stable: measurements with equal stamps stay in the order of arrival.
        self.waiting.sort_by_key(|it| it.time_ns);
        let due = self.waiting.partition_point(|it| it.time_ns <= now_ns);
        let due: Vec<Measurement> = self.waiting.drain(..due).collect();
        let mut is_new = !due.is_empty();
        for measurement in due {
            self.take(&measurement);
        }
        let timeout_ns = (self.settings.sensor_timeout_s * 1e9) as i64;
        let is_silent = now_ns.saturating_sub(self.measured_ns) >= timeout_ns;
        let settings = &self.settings;
        if is_silent && let Some(estimate) = &mut self.estimate {
            is_new |= estimate.time_ns < now_ns;
            carry(estimate, settings, now_ns);
        }
        is_new
    }

    /// Returns the estimate predicted to a time without further measurements.
    #[must_use]
    pub fn predicted(&self, time_ns: i64) -> Option<Estimate> {
        let mut estimate = self.estimate.clone()?;
        carry(&mut estimate, &self.settings, time_ns);
        Some(estimate)
    }

    /// Takes the measurements rejected since the last call.
    pub fn take_refusals(&mut self) -> Vec<Refusal> {
        std::mem::take(&mut self.refusals)
    }

    fn take(&mut self, measurement: &Measurement) {
        self.measured_ns = self.measured_ns.max(measurement.time_ns);
        let mut measurement = measurement.clone();
        if self.settings.is_flat {
            hold_down(&mut measurement);
        }
        let Some(estimate) = &mut self.estimate else {
            self.estimate = Some(first(&self.settings, &measurement));
            return;
        };
        carry(estimate, &self.settings, measurement.time_ns);
        let outcome = correct(&mut estimate.state, &mut estimate.covariance, &measurement);
        let source = measurement.source;
        match outcome {
            Outcome::Corrected => {}
            Outcome::TooFar(deviations) => {
                self.refusals.push(Refusal::TooFar { source, deviations });
            }
            Outcome::Singular => self.refusals.push(Refusal::Broken { source }),
        }
    }
}

/// Initializes the state from the first measurement; other variables are those of the settings, or
/// 0.
fn first(settings: &Settings, measurement: &Measurement) -> Estimate {
    let mut estimate = Estimate {
        time_ns: measurement.time_ns,
        state: settings.start.unwrap_or_else(State::zeros),
        covariance: settings.start_covariance,
    };
    let measured = || (0..STATE_DIMENSIONS).filter(|at| measurement.mask[*at]);
    for row in measured() {
        estimate.state[row] = measurement.state[row];
        for column in measured() {
            estimate.covariance[(row, column)] = measurement.covariance[(row, column)];
        }
    }
    estimate
}

/// Predicts the state to a time; a time in the past has no effect.
fn carry(estimate: &mut Estimate, settings: &Settings, time_ns: i64) {
    let mut rest_s = (time_ns - estimate.time_ns) as f64 * 1e-9;
    if rest_s <= 0.0 {
        return;
    }
    estimate.time_ns = time_ns;
    if rest_s > LONGEST_GAP_S {
        // The motion during a long gap is unknown.
        return;
    }
    while rest_s > 0.0 {
        let step_s = rest_s.min(LONGEST_STEP_S);
        let noise = noise(estimate, settings);
        (estimate.state, estimate.covariance) =
            predict(&estimate.state, &estimate.covariance, &noise, step_s);
        rest_s -= step_s;
    }
}

/// Process noise; that of pose and orientation is scaled by the speed if configured.
fn noise(estimate: &Estimate, settings: &Settings) -> Covariance {
    let mut noise = settings.noise_per_s;
    if settings.scales_noise {
        let speeds = estimate.state.fixed_rows::<6>(Variable::Vx.at());
        let speed = libm::sqrt(speeds.dot(&speeds));
        let mut part = noise.fixed_view_mut::<6, 6>(0, 0);
        part *= speed;
    }
    noise
}

/// Adds zero measurements of height, roll, pitch and their rates in two-dimensional mode.
fn hold_down(measurement: &mut Measurement) {
    for variable in Variable::OFF_THE_GROUND {
        let at = variable.at();
        measurement.state[at] = 0.0;
        measurement.covariance.row_mut(at).fill(0.0);
        measurement.covariance.column_mut(at).fill(0.0);
        measurement.covariance[(at, at)] = PLANAR_VARIANCE_FACTOR;
        measurement.mask[at] = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TICK_NS: i64 = 10_000_000;

    #[test]
    fn the_order_of_coming_does_not_count() {
        let measured =
            |tick: i64| Measurement::of(tick * TICK_NS, &[(Variable::Vx, tick as f64)], 0.1);
        let run = |order: [i64; 3]| {
            let mut ekf = Ekf::new(Settings::default());
            order.into_iter().for_each(|tick| ekf.push(measured(tick)));
            ekf.run_until(2 * TICK_NS);
            ekf.estimate().cloned()
        };
        assert_eq!(run([0, 1, 2]), run([2, 0, 1]));
    }

    #[test]
    fn silence_is_bridged_by_motion() {
        let mut ekf = Ekf::new(Settings::default());
        ekf.push(Measurement::of(0, &[(Variable::Vx, 1.0)], 1e-4));
        assert!(ekf.run_until(0));
        // Shorter than the timeout: no change.
        assert!(!ekf.run_until(TICK_NS));
        assert!(ekf.run_until(500_000_000));
        let x_m = ekf.estimate().map(|it| it.get(Variable::X));
        assert!((x_m.unwrap_or_default() - 0.5).abs() < 1e-9, "{x_m:?}");
    }

    #[test]
    fn on_flat_ground_it_stays_down() {
        let mut ekf = Ekf::new(Settings { is_flat: true, ..Settings::default() });
        for tick in 0..100 {
            let lifted = [(Variable::Vx, 1.0), (Variable::Vz, 1.0), (Variable::Vpitch, 0.3)];
            ekf.push(Measurement::of(tick * TICK_NS, &lifted, 1e-3));
        }
        ekf.run_until(100 * TICK_NS);
        let state = ekf.estimate().map(|it| it.state).unwrap_or_default();
        for variable in Variable::OFF_THE_GROUND {
            assert!(state[variable.at()].abs() < 1e-6, "{variable:?}: {state}");
        }
        assert!(state[0] > 0.9, "{state}");
    }

    #[test]
    fn what_is_not_a_number_is_refused() {
        let mut ekf = Ekf::new(Settings::default());
        ekf.push(Measurement::of(0, &[(Variable::Vx, f64::NAN)], 1e-4));
        assert!(!ekf.run_until(TICK_NS) && ekf.estimate().is_none());
        assert_eq!(ekf.take_refusals(), [Refusal::Broken { source: String::new() }]);
    }
}
