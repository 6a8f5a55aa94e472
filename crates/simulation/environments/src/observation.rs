//! Layout of observations.

use std::fmt;

use periplus_diagnostics::closest;

use crate::parameters::{DriveKind, NavigationTaskParams};
use crate::robot::EnvironmentRobot;

/// Distance to the goal that is scaled to 1 \[m\].
pub(crate) const GOAL_SCALE_M: f64 = 10.0;

/// Part of an observation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObservationPart {
    /// Ranges of the lidar \[m\].
    Ranges,
    /// Minimum range of the beams in each sector of the lidar \[m\].
    Sectors,
    /// Goal in polar coordinates of the robot: distance \[m\], cosine and sine of the bearing.
    Goal,
    /// Velocity of the robot: forwards, to the left (omnidirectional only), turn rate \[m/s, m/s, rad/s\].
    Velocity,
    /// Pose in the world: x, y \[m\], cosine and sine of the yaw. The truth, for critics and tests.
    Pose,
    /// Action of the last step, -1 to 1.
    PreviousAction,
}

/// All parts, by name.
const PARTS: [(&str, ObservationPart); 6] = [
    ("ranges", ObservationPart::Ranges),
    ("sectors", ObservationPart::Sectors),
    ("goal", ObservationPart::Goal),
    ("velocity", ObservationPart::Velocity),
    ("pose", ObservationPart::Pose),
    ("previous_action", ObservationPart::PreviousAction),
];

/// Part of an observation in the array of all parts.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservationSlice {
    /// The part.
    pub part: ObservationPart,
    /// Name of the part.
    pub name: &'static str,
    /// Index of its first number.
    pub start: usize,
    /// Minimum of each of its numbers.
    pub low: Vec<f32>,
    /// Maximum of each of its numbers.
    pub high: Vec<f32>,
}

/// Name that is no part of an observation, or one that is repeated, or no name at all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObservationError(String);

impl fmt::Display for ObservationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for ObservationError {}

/// Returns the parts of the observations of a task, in order.
///
/// # Errors
/// When a name is unknown or repeated, or there is none.
pub fn observation_layout(
    robot: &EnvironmentRobot,
    task: &NavigationTaskParams,
) -> Result<Vec<ObservationSlice>, ObservationError> {
    let mut layout: Vec<ObservationSlice> = Vec::new();
    let mut start = 0;
    for written in &task.observation {
        let Some((name, part)) = PARTS.iter().find(|(name, _)| name == written) else {
            let names = PARTS.map(|(name, _)| name);
            let similar = closest(written, names)
                .map_or_else(|| names.join(", "), |name| format!("did you mean {name}?"));
            let text = format!("`{written}` is no part of an observation ({similar})");
            return Err(ObservationError(text));
        };
        if layout.iter().any(|slice| slice.part == *part) {
            return Err(ObservationError(format!("`{name}` is twice in the observation")));
        }
        let (low, high) = bounds(*part, robot, task);
        let count = low.len();
        layout.push(ObservationSlice { part: *part, name, start, low, high });
        start += count;
    }
    let (sectors, beams) = (task.lidar_sectors, robot.params().lidar_beams);
    if sectors > beams && layout.iter().any(|slice| slice.part == ObservationPart::Sectors) {
        let text = format!(
            "`lidar_sectors` is {sectors}, but the lidar has only {beams} beams; a sector needs one"
        );
        return Err(ObservationError(text));
    }
    if layout.is_empty() {
        let names = PARTS.map(|(name, _)| name).join(", ");
        return Err(ObservationError(format!("the observation is empty; its parts are {names}")));
    }
    Ok(layout)
}

/// Writes the minimum of the beams in each sector. Sector k of m has the beams from ⌊k n / m⌋ to before ⌊(k + 1) n / m⌋
/// of n.
pub(crate) fn write_sector_minimums(ranges: &[f32], sectors: &mut [f32]) {
    let (beams, count) = (ranges.len(), sectors.len());
    for (at, sector) in sectors.iter_mut().enumerate() {
        let beams_inside = &ranges[at * beams / count..(at + 1) * beams / count];
        *sector = beams_inside.iter().copied().fold(f32::INFINITY, f32::min);
    }
}

/// Limit of positions and distances \[m\]: finite, since learning libraries warn about infinite bounds.
const MAX_POSITION_M: f32 = 1e6;

#[expect(clippy::cast_possible_truncation, reason = "observations are in single precision")]
fn bounds(
    part: ObservationPart,
    robot: &EnvironmentRobot,
    task: &NavigationTaskParams,
) -> (Vec<f32>, Vec<f32>) {
    let (params, normalized) = (robot.params(), task.is_normalized);
    let is_omni = params.drive == DriveKind::Omni;
    match part {
        ObservationPart::Ranges | ObservationPart::Sectors => {
            let count = match part {
                ObservationPart::Sectors => task.lidar_sectors,
                _ => params.lidar_beams,
            };
            let scale = if normalized { params.lidar_max_range_m } else { 1.0 };
            let low = (params.lidar_min_range_m / scale) as f32;
            let high = (params.lidar_max_range_m / scale) as f32;
            (vec![low; count], vec![high; count])
        }
        ObservationPart::Goal => {
            let max = if normalized { 1.0 } else { MAX_POSITION_M };
            (vec![0.0, -1.0, -1.0], vec![max, 1.0, 1.0])
        }
        ObservationPart::Velocity => {
            let ahead = params.max_speed_m_s.max(params.min_speed_m_s.abs());
            let mut high = vec![ahead as f32, params.max_turn_rate_rad_s as f32];
            if is_omni {
                high.insert(1, params.max_lateral_speed_m_s as f32);
            }
            if normalized {
                high.fill(1.0);
            }
            (high.iter().map(|it| -it).collect(), high)
        }
        ObservationPart::Pose => {
            let high = vec![MAX_POSITION_M, MAX_POSITION_M, 1.0, 1.0];
            (high.iter().map(|it| -it).collect(), high)
        }
        ObservationPart::PreviousAction => {
            let count = robot.action_size();
            (vec![-1.0; count], vec![1.0; count])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::EnvironmentRobotParams;

    fn layout(words: &str) -> Result<Vec<(&'static str, usize)>, String> {
        let robot = EnvironmentRobot::new(EnvironmentRobotParams::default()).expect("a robot");
        let observation = words.split_whitespace().map(str::to_owned).collect();
        let task = NavigationTaskParams { observation, ..NavigationTaskParams::default() };
        let layout = observation_layout(&robot, &task).map_err(|error| error.to_string())?;
        Ok(layout.into_iter().map(|slice| (slice.name, slice.start)).collect())
    }

    #[test]
    fn parts_follow_each_other() {
        let expected = vec![("goal", 0), ("ranges", 3), ("velocity", 363)];
        assert_eq!(layout("goal ranges velocity"), Ok(expected));
    }

    #[test]
    fn a_sector_has_the_minimum_of_its_beams() {
        let mut sectors = [0.0; 2];
        // Beams 0 and 1, then 2 to 4.
        write_sector_minimums(&[3.0, 1.0, 2.0, 5.0, 4.0], &mut sectors);
        assert_eq!(sectors, [1.0, 2.0]);
        assert_eq!(layout("sectors goal"), Ok(vec![("sectors", 0), ("goal", 72)]));
    }

    #[test]
    fn errors_name_the_part() {
        let check = |words, expected: &str| {
            let error = layout(words).expect_err("an error");
            assert!(error.contains(expected), "{error}");
        };
        check("range", "did you mean ranges?");
        check("goal goal", "`goal` is twice");
        check("", "its parts are ranges");
    }
}
