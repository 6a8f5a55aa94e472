//! Progress checkers: time limits for the motion of the robot.
//!
//! Source: `nav2_controller/plugins/simple_progress_checker.cpp`, `pose_progress_checker.cpp`.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_params::{ParamValue, ParamValues, params};

use crate::parameters::{ChangeRules, ParameterChange, ParameterRefusal, change};
use crate::path::distance_m;

params! {
    /// A progress checker that demands translation.
    #[table(SIMPLE_PROGRESS_CHECKER, "a simple progress checker")]
    pub struct SimpleProgressParams {
        /// Distance that the robot must exceed within the allowance.
        #[param("required_movement_radius", unit("m"))]
        required_movement_radius_m: f64 = 0.5,
        /// Time in which the robot must move.
        #[param("movement_time_allowance", unit("s"))]
        movement_time_allowance_s: f64 = 10,
    }
}

params! {
    /// A progress checker that demands translation or rotation.
    #[table(POSE_PROGRESS_CHECKER, "a pose progress checker")]
    pub struct PoseProgressParams {
        /// Distance that the robot must exceed within the allowance.
        #[param("required_movement_radius", unit("m"))]
        required_movement_radius_m: f64 = 0.5,
        /// Time in which the robot must move.
        #[param("movement_time_allowance", unit("s"))]
        movement_time_allowance_s: f64 = 10,
        /// Rotation that the robot must exceed within the allowance, as an alternative to the distance.
        #[param("required_movement_angle", unit("rad"))]
        required_movement_angle_rad: f64 = 0.5,
    }
}

/// Result of a progress check that failed, with its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProgressFailure {
    /// Distance from the pose at which the time began \[m\].
    pub moved_m: f64,
    /// Distance that is required \[m\].
    pub required_m: f64,
    /// Time since that pose \[s\].
    pub elapsed_s: f64,
}

impl std::fmt::Display for ProgressFailure {
    /// Nav2's sentence, then the numbers.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { moved_m, required_m, elapsed_s } = self;
        write!(
            f,
            "Failed to make progress: {moved_m:.2} m in {elapsed_s:.1} s, required are more than \
             {required_m:.2} m (`required_movement_radius`, `movement_time_allowance`)"
        )
    }
}

impl std::error::Error for ProgressFailure {}

/// Pose and time from which motion counts.
#[derive(Clone, Copy, Debug)]
struct Baseline {
    pose: Pose2,
    time_ns: i64,
}

/// A checker of progress.
///
/// ```
/// use periplus_controllers::{PluginSetup, ProgressChecker};
/// use periplus_diagnostics::Diagnostics;
/// use periplus_geometry::Pose2;
///
/// let setup = PluginSetup::new("progress_checker");
/// let class = "nav2_controller::SimpleProgressChecker";
/// let mut checker = ProgressChecker::create(class, &setup, &mut Diagnostics::new()).expect("a class");
/// assert!(checker.check(0, Pose2::IDENTITY).is_ok());
/// assert!(checker.check(10_000_000_000, Pose2::IDENTITY).is_ok(), "10 s are allowed");
/// assert!(checker.check(10_000_000_001, Pose2::IDENTITY).is_err());
/// ```
#[derive(Clone, Debug)]
pub struct ProgressChecker {
    values: ParamValues,
    radius_m: f64,
    /// None if rotation is no progress.
    angle_rad: Option<f64>,
    allowance_s: f64,
    baseline: Option<Baseline>,
}

impl ProgressChecker {
    /// Creates a checker from values of [`SIMPLE_PROGRESS_CHECKER`] or [`POSE_PROGRESS_CHECKER`].
    #[must_use]
    pub fn new(values: ParamValues) -> Self {
        let mut checker =
            Self { values, radius_m: 0.0, angle_rad: None, allowance_s: 0.0, baseline: None };
        checker.read_values();
        checker
    }

    fn read_values(&mut self) {
        let simple = SimpleProgressParams::from_values(&self.values);
        self.radius_m = simple.required_movement_radius_m;
        self.allowance_s = simple.movement_time_allowance_s;
        let with_angle = *self.values.table() == POSE_PROGRESS_CHECKER;
        self.angle_rad = with_angle
            .then(|| PoseProgressParams::from_values(&self.values).required_movement_angle_rad);
    }

    /// Checks the progress at a time \[ns\]. The first check, and each check after enough motion, begin the time
    /// again.
    ///
    /// # Errors
    /// When the robot has not moved enough for longer than the allowance.
    pub fn check(&mut self, time_ns: i64, pose: Pose2) -> Result<(), ProgressFailure> {
        let Some(baseline) = self.baseline.filter(|baseline| !self.has_moved(baseline, pose))
        else {
            self.baseline = Some(Baseline { pose, time_ns });
            return Ok(());
        };
        let elapsed_ns = time_ns - baseline.time_ns;
        if elapsed_ns as f64 <= self.allowance_s * 1e9 {
            return Ok(());
        }
        Err(ProgressFailure {
            moved_m: distance_m(pose, baseline.pose),
            required_m: self.radius_m,
            elapsed_s: elapsed_ns as f64 / 1e9,
        })
    }

    fn has_moved(&self, baseline: &Baseline, pose: Pose2) -> bool {
        let turned_rad = normalize_angle(pose.yaw_rad - baseline.pose.yaw_rad).abs();
        distance_m(pose, baseline.pose) > self.radius_m
            || self.angle_rad.is_some_and(|angle_rad| turned_rad > angle_rad)
    }

    /// Begins the time again with the next check.
    pub fn reset(&mut self) {
        self.baseline = None;
    }

    /// Returns the parameters with their values.
    #[must_use]
    pub fn parameters(&self) -> &ParamValues {
        &self.values
    }

    /// Changes a parameter.
    ///
    /// # Errors
    /// When the name is unknown, or the value has another type or is negative.
    pub fn change_parameter(
        &mut self,
        name: &str,
        value: ParamValue,
    ) -> Result<ParameterChange, ParameterRefusal> {
        let change = change(&mut self.values, ChangeRules::NON_NEGATIVE, name, value)?;
        self.read_values();
        Ok(change)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks are seconds, x and yaw.
    fn check(values: ParamValues, checks: &[(f64, f64, f64)], expected: &[bool]) {
        let mut checker = ProgressChecker::new(values);
        let results: Vec<bool> = checks
            .iter()
            .map(|&(t, x, yaw)| checker.check((t * 1e9) as i64, Pose2::new(x, 0.0, yaw)).is_ok())
            .collect();
        assert_eq!(results, expected);
    }

    #[test]
    fn motion_must_exceed_the_radius() {
        let checks = [(0.0, 0.0, 0.0), (9.0, 0.5, 0.0), (10.0, 0.5, 0.0), (10.5, 0.5, 0.0)];
        check(ParamValues::defaults(&SIMPLE_PROGRESS_CHECKER), &checks, &[true, true, true, false]);
    }

    #[test]
    fn a_rotation_counts_for_a_pose_checker_only() {
        let checks = [(0.0, 0.0, 3.0), (9.0, 0.0, -2.7), (18.0, 0.0, -2.7)];
        check(ParamValues::defaults(&SIMPLE_PROGRESS_CHECKER), &checks, &[true, true, false]);
        check(ParamValues::defaults(&POSE_PROGRESS_CHECKER), &checks, &[true, true, true]);
    }

    #[test]
    fn parameters_change_by_their_rules() {
        let mut checker = ProgressChecker::new(ParamValues::defaults(&SIMPLE_PROGRESS_CHECKER));
        let radius = "required_movement_radius";
        assert!(checker.change_parameter(radius, ParamValue::Number(-1.0)).is_err());
        assert!(checker.change_parameter("radius", ParamValue::Number(1.0)).is_err());
        let changed = checker.change_parameter(radius, ParamValue::Number(0.1));
        assert_eq!(changed, Ok(ParameterChange::Applied));
        assert_eq!(checker.radius_m, 0.1);
    }
}
