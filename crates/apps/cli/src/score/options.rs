//! Options of `periplus score` and `periplus compare`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use periplus_evaluation::{AlignmentMethod, PairSelection, RelativeDelta};

/// Score a run against the truth: trajectory errors, map, clearance, smoothness, goals
///
/// RUN is a recording (`--record run.mcap --record-truth` of `periplus sim` and `navigate`; any .mcap, .db3, .bag or
/// folder of `ros2 bag` with `--truth`), or a trajectory in TUM format or of `periplus slam` with `--truth`. Errors are
/// computed as by the Python package evo; docs/scores.md has the formulas.
#[derive(Debug, Args)]
pub(crate) struct ScoreOptions {
    /// Recording or trajectory
    #[arg(value_name = "RUN")]
    pub(crate) run: PathBuf,
    #[command(flatten)]
    pub(crate) settings: ScoreSettings,
    #[command(flatten)]
    pub(crate) outputs: ScoreOutputs,
}

/// Settings of a score.
#[derive(Debug, Args)]
pub(crate) struct ScoreSettings {
    /// True trajectory: a file in TUM format, or a topic of the recording [default: the poses of
    /// `/gazebo/model_states`, or odometry with `ground_truth` in its name]
    #[arg(long, value_name = "FILE|TOPIC")]
    pub(crate) truth: Option<String>,
    /// Model of the robot in the truth [default: the model with the longest path]
    #[arg(long, value_name = "NAME")]
    pub(crate) model: Option<String>,
    /// True map in the frame of the truth, for scores of the map and the clearance
    #[arg(long, value_name = "MAP.yaml")]
    pub(crate) map: Option<PathBuf>,
    /// Alignment of each estimate with the truth
    #[arg(long, value_enum, default_value_t = Align::Se2, value_name = "METHOD")]
    pub(crate) align: Align,
    /// Distance of the poses of a relative error: 1m, 10 (poses), 0.5rad
    #[arg(long, value_name = "DELTA", default_value = "1m", value_parser = delta)]
    pub(crate) delta: RelativeDelta,
    /// Compute relative errors from every pose, not from consecutive pairs
    #[arg(long)]
    pub(crate) all_pairs: bool,
    /// Maximum time between a pose of a file and its true pose [s]
    #[arg(long, value_name = "SECONDS", default_value_t = 0.01, value_parser = length)]
    pub(crate) max_difference: f64,
    /// Distance within which an occupied cell matches a true one [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.1, value_parser = length)]
    pub(crate) tolerance: f64,
    /// Radius of the robot, for the clearance [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.0, value_parser = length)]
    pub(crate) radius: f64,
    /// Frame of the map
    #[arg(long, default_value = "map", value_name = "FRAME")]
    pub(crate) map_frame: String,
    /// Frame of odometry
    #[arg(long, default_value = "odom", value_name = "FRAME")]
    pub(crate) odom_frame: String,
    /// Frame of the robot [default: `base_footprint` or `base_link`, whichever the recording has]
    #[arg(long, value_name = "FRAME")]
    pub(crate) base_frame: Option<String>,
}

/// Results of `periplus score` and `periplus compare` besides the table.
#[derive(Clone, Debug, Args)]
pub(crate) struct ScoreOutputs {
    /// Write a picture of the paths over the map, seen from above
    #[arg(long, value_name = "FILE.png")]
    pub(crate) picture: Option<PathBuf>,
    /// Print all statistics as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

impl Default for ScoreSettings {
    /// The defaults of the command line.
    fn default() -> Self {
        Self {
            truth: None,
            model: None,
            map: None,
            align: Align::Se2,
            delta: RelativeDelta::Metres(1.0),
            all_pairs: false,
            max_difference: 0.01,
            tolerance: 0.1,
            radius: 0.0,
            map_frame: "map".to_owned(),
            odom_frame: "odom".to_owned(),
            base_frame: None,
        }
    }
}

impl ScoreSettings {
    /// Pairs of relative errors.
    pub(crate) fn pairs(&self) -> PairSelection {
        PairSelection { delta: self.delta, all_pairs: self.all_pairs, ..PairSelection::default() }
    }
}

/// Alignment of an estimate with the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Align {
    /// No alignment: the frames are equal
    None,
    /// First poses on each other
    Origin,
    /// Translation and yaw, least squares
    Se2,
    /// Rigid transform in space, least squares (`evo_ape --align`)
    Se3,
    /// Rigid transform in space and scale (`evo_ape --align --correct_scale`)
    Sim3,
    /// Scale alone (`evo_ape --correct_scale`)
    Scale,
}

impl From<Align> for AlignmentMethod {
    fn from(align: Align) -> Self {
        match align {
            Align::None => Self::None,
            Align::Origin => Self::Origin,
            Align::Se2 => Self::Se2,
            Align::Se3 => Self::Se3,
            Align::Sim3 => Self::Sim3,
            Align::Scale => Self::Scale,
        }
    }
}

fn delta(text: &str) -> Result<RelativeDelta, String> {
    let positive =
        |number: &str| number.trim().parse::<f64>().ok().filter(|it| it.is_finite() && *it > 0.0);
    let found = if let Some(number) = text.strip_suffix("rad") {
        positive(number).map(RelativeDelta::Radians)
    } else if let Some(number) = text.strip_suffix("deg") {
        positive(number).map(|it| RelativeDelta::Radians(it.to_radians()))
    } else if let Some(number) = text.strip_suffix('m') {
        positive(number).map(RelativeDelta::Metres)
    } else {
        text.parse().ok().filter(|count| *count > 0).map(RelativeDelta::Frames)
    };
    found
        .ok_or_else(|| "expected a distance such as 1m, 0.5rad, 30deg, or a number of poses".into())
}

fn length(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|it: &f64| it.is_finite() && *it >= 0.0)
        .ok_or_else(|| "expected a number of at least 0".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deltas_have_units() {
        let check = |text: &str, expected: Option<RelativeDelta>| {
            assert_eq!(delta(text).ok(), expected, "{text}");
        };
        check("1m", Some(RelativeDelta::Metres(1.0)));
        check("0.5rad", Some(RelativeDelta::Radians(0.5)));
        check("180deg", Some(RelativeDelta::Radians(std::f64::consts::PI)));
        check("10", Some(RelativeDelta::Frames(10)));
        check("0", None);
        check("-1m", None);
        check("1.5", None);
        check("nanm", None);
    }
}
