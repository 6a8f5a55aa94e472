//! A run with its truth, read from files.

use std::path::Path;

use periplus_evaluation::{EstimateWithCovariance, PosePair, Trajectory, associate};
use periplus_grid::OccupancyGrid;
use periplus_maps::{Distro, load};
use periplus_os::Machine;

use super::options::ScoreSettings;
use super::recording;
use crate::error::CliError;
use crate::paths;

/// A run with its truth.
#[derive(Debug, Default)]
pub(crate) struct Run {
    /// Path as given.
    pub(crate) name: String,
    /// Source of the truth.
    pub(crate) truth_source: String,
    pub(crate) truth: Trajectory,
    pub(crate) estimates: Vec<Estimate>,
    /// Poses with covariances; their true poses are in the frame of the truth.
    pub(crate) with_covariance: Vec<EstimateWithCovariance>,
    /// Topic of these.
    pub(crate) covariance_topic: Option<String>,
    /// Last map that was recorded.
    pub(crate) map: Option<OccupancyGrid>,
    /// True map.
    pub(crate) true_map: Option<OccupancyGrid>,
    pub(crate) goals: Vec<Goal>,
}

/// An estimated trajectory, paired with the truth.
#[derive(Debug)]
pub(crate) struct Estimate {
    /// `localization`, `odometry`, or `estimate` for a file.
    pub(crate) name: &'static str,
    pub(crate) pairs: Vec<PosePair>,
}

/// A goal of an action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Goal {
    /// Time at which it was accepted \[s\].
    pub(crate) start_s: f64,
    /// Time at which it was reached \[s\].
    pub(crate) reached_s: Option<f64>,
}

impl Run {
    /// Reads a recording or a trajectory with its truth.
    pub(crate) fn read(path: &Path, settings: &ScoreSettings) -> Result<Self, CliError> {
        let mut run = match trajectory(path)? {
            Some(estimate) => Self::of_trajectory(path, &estimate, settings)?,
            None => recording::read(path, settings)?,
        };
        run.name = path.display().to_string();
        run.true_map = settings.map.as_deref().map(true_map).transpose()?;
        Ok(run)
    }

    fn of_trajectory(
        path: &Path,
        estimate: &Trajectory,
        settings: &ScoreSettings,
    ) -> Result<Self, CliError> {
        let Some(truth_path) = &settings.truth else {
            return Err(CliError::usage(format!(
                "{} is a trajectory: name the true one with `--truth FILE`",
                path.display()
            )));
        };
        let truth = truth_file(truth_path)?;
        let pairs = associate(&truth, estimate, settings.max_difference);
        if pairs.is_empty() {
            return Err(CliError::failed(format!(
                "no pose of {} has a true pose in {truth_path} within {} s; compare the stamps, or set \
                 `--max-difference`",
                path.display(),
                settings.max_difference
            )));
        }
        let estimates = vec![Estimate { name: "estimate", pairs }];
        Ok(Self { truth_source: truth_path.clone(), truth, estimates, ..Self::default() })
    }
}

/// Reads a file of a true trajectory.
pub(super) fn truth_file(path: &str) -> Result<Trajectory, CliError> {
    let file = Path::new(path);
    trajectory(file)?.ok_or_else(|| {
        CliError::failed(format!(
            "{path} is not a trajectory in TUM format: `stamp x y z qx qy qz qw`"
        ))
    })
}

/// Reads a trajectory; none for a recording.
fn trajectory(path: &Path) -> Result<Option<Trajectory>, CliError> {
    let is_text = path
        .extension()
        .is_some_and(|it| ["tum", "txt", "csv"].iter().any(|other| it.eq_ignore_ascii_case(other)));
    if path.is_dir() || !is_text {
        return Ok(None);
    }
    let text = paths::text(path)?;
    let read = Trajectory::from_text(&text);
    read.map(Some).map_err(|error| CliError::failed(format!("{}:{error}", path.display())))
}

fn true_map(path: &Path) -> Result<OccupancyGrid, CliError> {
    let name = path.display().to_string();
    let loaded = load(&name, Distro::Jazzy, &Machine);
    crate::terminal::diagnostics(
        &mut anstream::stderr().lock(),
        &loaded.diagnostics,
        &loaded.sources,
    )?;
    loaded.map.map(|map| map.grid).ok_or(CliError::Reported(1))
}
