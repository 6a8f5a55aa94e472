//! Velocity smoother: velocity, acceleration and deceleration limits of commands.
//!
//! Source: `nav2_velocity_smoother/src/velocity_smoother.cpp` (humble to main).

use std::fmt;

use periplus_params::param_choice;

use crate::tables::VelocitySmootherParams;

/// Number of components of a velocity: x, y, z \[m/s\], then roll, pitch, yaw \[rad/s\].
pub const VELOCITY_COMPONENT_COUNT: usize = 6;

/// Velocity of a body: x, y, z \[m/s\], then roll, pitch, yaw \[rad/s\], in the base frame.
pub type Velocity6 = [f64; VELOCITY_COMPONENT_COUNT];

/// Components with limits, when three of them are given: x, y and yaw.
const PLANAR_COMPONENTS: [usize; 3] = [0, 1, 5];

param_choice! {
    /// Velocity from which the next command is computed.
    pub enum VelocityFeedback {
        /// The last command.
        #[default]
        OpenLoop = "OPEN_LOOP",
        /// Odometry.
        ClosedLoop = "CLOSED_LOOP",
    }
}

/// Limits of one component of the velocity, in its unit (m/s or rad/s, and per second).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ComponentLimits {
    /// Minimum velocity; 0 or less.
    pub min: f64,
    /// Maximum velocity; 0 or more.
    pub max: f64,
    /// Maximum acceleration; 0 or more.
    pub accel: f64,
    /// Maximum deceleration; 0 or less.
    pub decel: f64,
    /// Speed below which 0 is published.
    pub deadband: f64,
}

impl ComponentLimits {
    /// Interval of the change of velocity within one period of `period_s`.
    fn step(&self, from: f64, to: f64, frequency_hz: f64) -> (f64, f64) {
        let is_accelerating = to.abs() >= from.abs() && from * to >= 0.0;
        let limit = if is_accelerating { self.accel } else { -self.decel } / frequency_hz;
        (-limit, limit)
    }

    /// Factor by which the change of velocity has to be scaled; none if it is within the limits.
    fn factor(&self, from: f64, to: f64, frequency_hz: f64) -> Option<f64> {
        let (lowest, highest) = self.step(from, to, frequency_hz);
        let change = to - from;
        if change > highest {
            Some(highest / change)
        } else if change < lowest {
            Some(lowest / change)
        } else {
            None
        }
    }

    /// Velocity after one period.
    fn approach(&self, from: f64, to: f64, factor: f64, frequency_hz: f64) -> f64 {
        let (lowest, highest) = self.step(from, to, frequency_hz);
        from + (factor * (to - from)).max(lowest).min(highest)
    }
}

/// Mistake in the limits of a velocity smoother, worded as a message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LimitError(String);

impl fmt::Display for LimitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for LimitError {}

/// Settings of a [`VelocitySmoother`].
#[derive(Clone, Debug, PartialEq)]
pub struct VelocitySmootherSettings {
    /// Rate of the output \[Hz\].
    pub frequency_hz: f64,
    /// Velocity from which the next command is computed.
    pub feedback: VelocityFeedback,
    /// Scales all components by one factor, so that the direction of the change is kept.
    pub scales_velocities: bool,
    /// Limits by component; none where the command is passed on.
    pub limits: [Option<ComponentLimits>; VELOCITY_COMPONENT_COUNT],
    /// Age of a command after which the robot is stopped \[ns\].
    pub timeout_ns: i64,
}

impl VelocitySmootherSettings {
    /// Converts and checks parameters.
    ///
    /// # Errors
    /// The first list with a wrong number of values or a wrong sign. Nav2 then fails to configure.
    pub fn new(params: &VelocitySmootherParams) -> Result<Self, LimitError> {
        let lists: [(&str, &[f64]); 5] = [
            ("min_velocity", &params.min_velocity),
            ("max_velocity", &params.max_velocity),
            ("max_accel", &params.max_accel),
            ("max_decel", &params.max_decel),
            ("deadband_velocity", &params.deadband_velocity),
        ];
        let size = params.max_velocity.len();
        let components: &[usize] = match size {
            3 => &PLANAR_COMPONENTS,
            VELOCITY_COMPONENT_COUNT => &[0, 1, 2, 3, 4, 5],
            _ => {
                let text = format!(
                    "`max_velocity` has {size} values; write 3 (x, y, theta) or 6 (x, y, z, roll, \
                     pitch, yaw) in all limits"
                );
                return Err(LimitError(text));
            }
        };
        for (name, list) in lists {
            let count = list.len();
            if count != size {
                let text = format!(
                    "`{name}` has {count} values and `max_velocity` {size}; all limits need the \
                     same number"
                );
                return Err(LimitError(text));
            }
        }
        let mut limits = [None; VELOCITY_COMPONENT_COUNT];
        for (index, &component) in components.iter().enumerate() {
            let [min, max, accel, decel, deadband] =
                lists.map(|(_, list)| list.get(index).copied().unwrap_or_default());
            let wrong = [
                ("max_decel", decel > 0.0, "0 or less: it slows down"),
                ("max_accel", accel < 0.0, "0 or more: it speeds up"),
                ("min_velocity", min > 0.0, "0 or less"),
                ("max_velocity", max < 0.0, "0 or more"),
            ];
            if let Some((name, _, wanted)) = wrong.iter().find(|(_, is_wrong, _)| *is_wrong) {
                return Err(LimitError(format!("`{name}[{index}]` must be {wanted}")));
            }
            limits[component] = Some(ComponentLimits { min, max, accel, decel, deadband });
        }
        Ok(Self {
            frequency_hz: params.smoothing_frequency_hz,
            feedback: params.feedback,
            scales_velocities: params.scale_velocities,
            limits,
            timeout_ns: (params.velocity_timeout_s * 1e9) as i64,
        })
    }

    /// Period of the output \[ns\], in whole milliseconds as in Nav2.
    #[must_use]
    pub fn period_ns(&self) -> i64 {
        ((1000.0 / self.frequency_hz) as i64).max(1) * 1_000_000
    }
}

/// Velocity smoother.
///
/// ```
/// use periplus_motion::{VelocitySmoother, VelocitySmootherParams, VelocitySmootherSettings};
///
/// let settings = VelocitySmootherSettings::new(&VelocitySmootherParams::default())?;
/// let mut smoother = VelocitySmoother::new(settings);
/// assert_eq!(smoother.update(0, None), None);
/// smoother.set_command([1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 0);
/// // 2.5 m/s^2 in 20 steps a second.
/// assert_eq!(smoother.update(50_000_000, None).map(|out| out[0]), Some(0.125));
/// # Ok::<(), periplus_motion::LimitError>(())
/// ```
#[derive(Clone, Debug)]
pub struct VelocitySmoother {
    settings: VelocitySmootherSettings,
    command: Option<Velocity6>,
    /// Time of the last command \[ns\].
    command_ns: i64,
    /// Last output, before the deadband.
    last: Velocity6,
    is_stopped: bool,
}

impl VelocitySmoother {
    /// Creates a smoother of a robot that does not move.
    #[must_use]
    pub fn new(settings: VelocitySmootherSettings) -> Self {
        let last = [0.0; VELOCITY_COMPONENT_COUNT];
        Self { settings, command: None, command_ns: 0, last, is_stopped: true }
    }

    /// Creates a smoother with a last output, before the deadband.
    #[must_use]
    pub fn starting_from(settings: VelocitySmootherSettings, last: Velocity6) -> Self {
        Self { last, is_stopped: false, ..Self::new(settings) }
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &VelocitySmootherSettings {
        &self.settings
    }

    /// Replaces the settings. The command and the last output stay.
    pub fn set_settings(&mut self, settings: VelocitySmootherSettings) {
        self.settings = settings;
    }

    /// Sets the velocity to reach. Returns false, and ignores it, if a component is not finite.
    pub fn set_command(&mut self, command: Velocity6, time_ns: i64) -> bool {
        if !command.iter().all(|component| component.is_finite()) {
            return false;
        }
        self.command = Some(command);
        self.command_ns = time_ns;
        true
    }

    /// Returns the velocity to publish at a time \[ns\]; none before the first command, and once the
    /// robot stands because the command timed out. `measured` is the velocity by odometry, used in
    /// closed loop; without one the robot is assumed at rest.
    pub fn update(&mut self, now_ns: i64, measured: Option<Velocity6>) -> Option<Velocity6> {
        let mut command = self.command?;
        if now_ns - self.command_ns > self.settings.timeout_ns {
            if self.is_stopped || self.last.iter().all(|component| *component == 0.0) {
                self.is_stopped = true;
                return None;
            }
            command = [0.0; VELOCITY_COMPONENT_COUNT];
        }
        self.is_stopped = false;
        let from = match self.settings.feedback {
            VelocityFeedback::OpenLoop => self.last,
            VelocityFeedback::ClosedLoop => measured.unwrap_or_default(),
        };
        let limits = &self.settings.limits;
        for (component, limits) in command.iter_mut().zip(limits) {
            if let Some(limits) = limits {
                *component = component.max(limits.min).min(limits.max);
            }
        }
        self.command = Some(command);
        let factor = if self.settings.scales_velocities { self.factor(from, command) } else { 1.0 };
        let mut output = command;
        let mut last = [0.0; VELOCITY_COMPONENT_COUNT];
        for index in 0..VELOCITY_COMPONENT_COUNT {
            let Some(limits) = limits[index] else { continue };
            let hertz = self.settings.frequency_hz;
            last[index] = limits.approach(from[index], command[index], factor, hertz);
            let is_dead = last[index].abs() < limits.deadband;
            output[index] = if is_dead { 0.0 } else { last[index] };
        }
        self.last = last;
        Some(output)
    }

    /// Common factor of the change of all components: the one furthest from 1.
    fn factor(&self, from: Velocity6, to: Velocity6) -> f64 {
        let hertz = self.settings.frequency_hz;
        let mut factor: f64 = 1.0;
        for (index, limits) in self.settings.limits.iter().enumerate() {
            let own = limits.and_then(|limits| limits.factor(from[index], to[index], hertz));
            if let Some(own) = own.filter(|own| *own > 0.0)
                && (1.0 - own).abs() > (1.0 - factor).abs()
            {
                factor = own;
            }
        }
        factor
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const PERIOD_NS: i64 = 50_000_000;

    fn smoother(change: impl FnOnce(&mut VelocitySmootherParams)) -> VelocitySmoother {
        let mut params = VelocitySmootherParams::default();
        change(&mut params);
        VelocitySmoother::new(VelocitySmootherSettings::new(&params).unwrap())
    }

    fn planar(vx: f64, vy: f64, wz: f64) -> Velocity6 {
        [vx, vy, 0.0, 0.0, 0.0, wz]
    }

    #[test]
    fn a_silent_controller_stops_the_robot_and_then_the_output() {
        let mut smoother = smoother(|params| params.velocity_timeout_s = 0.1);
        assert!(smoother.set_command(planar(0.25, 0.0, 0.0), 0));
        let speeds: Vec<Option<f64>> = (1..=7)
            .map(|step| smoother.update(step * PERIOD_NS, None).map(|output| output[0]))
            .collect();
        let expected = [Some(0.125), Some(0.25), Some(0.125), Some(0.0), None, None, None];
        assert_eq!(speeds, expected);
        assert!(smoother.set_command(planar(0.25, 0.0, 0.0), 400_000_000));
        assert_eq!(smoother.update(400_000_000, None).unwrap()[0], 0.125);
    }

    #[test]
    fn a_deadband_hides_small_commands_but_does_not_hold_them_back() {
        let mut smoother = smoother(|params| params.deadband_velocity = vec![0.2, 0.0, 0.0]);
        smoother.set_command(planar(0.5, 0.0, 0.0), 0);
        let speeds = [1, 2, 3].map(|step| smoother.update(step, None).unwrap()[0]);
        assert_eq!(speeds, [0.0, 0.25, 0.375]);
    }

    #[test]
    fn closed_loop_starts_from_odometry() {
        let mut smoother = smoother(|params| params.feedback = VelocityFeedback::ClosedLoop);
        smoother.set_command(planar(0.5, 0.0, 0.0), 0);
        let measured = Some(planar(0.25, 0.0, 0.0));
        assert_eq!(smoother.update(1, measured).unwrap()[0], 0.375);
        assert_eq!(smoother.update(2, measured).unwrap()[0], 0.375);
        assert_eq!(smoother.update(3, None).unwrap()[0], 0.125);
    }

    #[test]
    fn components_without_limits_are_passed_on() {
        let mut smoother = smoother(|_| ());
        smoother.set_command([0.0, 0.0, 0.7, 0.1, 0.2, 0.0], 0);
        assert_eq!(smoother.update(1, None).unwrap(), [0.0, 0.0, 0.7, 0.1, 0.2, 0.0]);
    }

    #[test]
    fn commands_that_are_not_finite_are_ignored() {
        let mut smoother = smoother(|_| ());
        assert!(!smoother.set_command(planar(f64::NAN, 0.0, 0.0), 0));
        assert!(!smoother.set_command(planar(0.0, f64::INFINITY, 0.0), 0));
        assert_eq!(smoother.update(1, None), None);
    }

    #[test]
    fn wrong_limits_are_named() {
        let check = |change: fn(&mut VelocitySmootherParams), expected: &str| {
            let mut params = VelocitySmootherParams::default();
            change(&mut params);
            let error = VelocitySmootherSettings::new(&params).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        };
        check(|params| params.max_velocity = vec![1.0, 0.0], "`max_velocity` has 2 values");
        check(|params| params.max_accel = vec![1.0; 6], "`max_accel` has 6 values");
        check(|params| params.max_decel[2] = 1.0, "`max_decel[2]` must be 0 or less");
        check(|params| params.max_accel[0] = -1.0, "`max_accel[0]` must be 0 or more");
        check(|params| params.min_velocity[1] = 0.5, "`min_velocity[1]` must be 0 or less");
        check(|params| params.max_velocity[0] = -0.5, "`max_velocity[0]` must be 0 or more");
    }

    proptest! {
        #[test]
        fn the_change_of_each_step_is_within_the_limits(
            commands in prop::collection::vec((-2.0..2.0f64, -5.0..5.0f64), 1..60),
            scales: bool,
        ) {
            let mut smoother = smoother(|params| params.scale_velocities = scales);
            let mut last = [0.0; VELOCITY_COMPONENT_COUNT];
            for (step, (vx, wz)) in commands.into_iter().enumerate() {
                let now_ns = step as i64 * PERIOD_NS;
                smoother.set_command(planar(vx, 0.0, wz), now_ns);
                let output = smoother.update(now_ns, None).unwrap();
                prop_assert!((output[0] - last[0]).abs() <= 2.5 / 20.0 + 1e-12);
                prop_assert!((output[5] - last[5]).abs() <= 3.2 / 20.0 + 1e-12);
                prop_assert!(output[0].abs() <= 0.5 && output[5].abs() <= 2.5);
                last = output;
            }
        }
    }
}
