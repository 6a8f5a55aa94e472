//! Scores of a run.

use periplus_evaluation::{
    Clearance, Degenerate, ErrorStatistics, EstimateWithCovariance, LocalizationLimits,
    LocalizationScore, PoseRelation, Similarity, Smoothness, SmoothnessSampling, align, ape, rpe,
    score_map,
};
use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;
use serde_json::{Map, Value, json};

use super::options::{Align, ScoreSettings};
use super::run::{Estimate, Run};
use crate::error::CliError;

/// Statistics of an error that the table shows; `--json` has all.
const SHOWN_STATISTICS: [&str; 4] = ["rmse", "mean", "median", "max"];

/// Scores of a run, with the paths for its picture.
#[derive(Debug, Default)]
pub(crate) struct RunScores {
    /// Path of the run.
    pub(crate) name: String,
    /// Source of its truth.
    pub(crate) truth_source: String,
    /// Scores by name, in the order of the table; NaN where undefined.
    pub(crate) scores: Vec<Score>,
    /// True path \[m\].
    pub(crate) truth_m: Vec<[f64; 2]>,
    /// Aligned path of the first estimate \[m\].
    pub(crate) estimate_m: Vec<[f64; 2]>,
    /// Map in the frame of the truth.
    pub(crate) map: Option<OccupancyGrid>,
}

/// A score.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Score {
    /// Name with its unit.
    pub(crate) name: String,
    pub(crate) value: f64,
    /// False if only `--json` shows it.
    pub(crate) is_shown: bool,
}

impl RunScores {
    /// Computes the scores.
    pub(crate) fn of(run: &Run, settings: &ScoreSettings) -> Result<Self, CliError> {
        let mut scores = Self {
            name: run.name.clone(),
            truth_source: run.truth_source.clone(),
            truth_m: run.truth.poses().iter().map(|it| position(it.pose.into())).collect(),
            ..Self::default()
        };
        let mut truth_from_map = None;
        for estimate in &run.estimates {
            let alignment = scores.add_errors(estimate, settings)?;
            if estimate.name != "odometry" {
                truth_from_map = Some(Pose2::from(alignment.reference_from_estimate));
            }
        }
        scores.add_localization(run, truth_from_map);
        scores.add_run(run);
        scores.add_map(run, truth_from_map, settings)?;
        scores.add_goals(run);
        Ok(scores)
    }

    fn add(&mut self, name: &str, value: impl Into<Option<f64>>) {
        let value = value.into().unwrap_or(f64::NAN);
        self.scores.push(Score { name: name.to_owned(), value, is_shown: true });
    }

    fn add_statistics(&mut self, name: &str, unit: &str, errors: &[f64]) {
        let Some(statistics) = ErrorStatistics::of(errors) else {
            self.add(&format!("{name}_rmse_{unit}"), None);
            return;
        };
        for (statistic, value) in statistics.numbers() {
            let is_shown = SHOWN_STATISTICS.contains(&statistic);
            let square = if statistic == "sse" { "2" } else { "" };
            let name = format!("{name}_{statistic}_{unit}{square}");
            self.scores.push(Score { name, value, is_shown });
        }
    }

    /// Adds the errors of an estimate, and returns its alignment.
    fn add_errors(
        &mut self,
        estimate: &Estimate,
        settings: &ScoreSettings,
    ) -> Result<Similarity, CliError> {
        let alignment = match align(&estimate.pairs, settings.align.into()) {
            // A robot that did not move has no direction; its first pose is its alignment.
            Err(Degenerate { .. }) if settings.align == Align::Se2 => {
                align(&estimate.pairs, Align::Origin.into()).map_err(CliError::failed)?
            }
            found => found.map_err(|error| {
                CliError::failed(format!("{} of {}: {error}", estimate.name, self.name))
            })?,
        };
        let pairs = alignment.apply_to(&estimate.pairs);
        let name = estimate.name;
        self.add(&format!("{name}.pose_count"), pairs.len() as f64);
        for (relation, unit) in
            [(PoseRelation::TranslationM, "m"), (PoseRelation::RotationDeg, "deg")]
        {
            self.add_statistics(&format!("{name}.ape"), unit, &ape(&pairs, relation));
        }
        for (relation, unit) in
            [(PoseRelation::TranslationM, "m"), (PoseRelation::RotationDeg, "deg")]
        {
            let errors = rpe(&pairs, relation, settings.pairs());
            self.add_statistics(&format!("{name}.rpe"), unit, &errors);
        }
        if self.estimate_m.is_empty() {
            self.estimate_m = pairs.iter().map(|it| position(it.estimate.into())).collect();
        }
        Ok(alignment)
    }

    fn add_localization(&mut self, run: &Run, truth_from_map: Option<Pose2>) {
        let (Some(_), Some(truth_from_map)) = (&run.covariance_topic, truth_from_map) else {
            return;
        };
        let map_from_truth = truth_from_map.inverse();
        let estimates: Vec<EstimateWithCovariance> = run
            .with_covariance
            .iter()
            .map(|it| EstimateWithCovariance { truth: map_from_truth * it.truth, ..*it })
            .collect();
        let score = LocalizationScore::of(&estimates, LocalizationLimits::default());
        self.add("localization.mean_nees", score.and_then(|it| it.mean_nees));
        self.add("localization.consistent_ratio", score.and_then(|it| it.consistent_ratio));
        self.add("localization.convergence_s", score.and_then(|it| it.convergence_s));
        self.add(
            "localization.confidently_wrong_ratio",
            score.map(|it| it.confidently_wrong_ratio),
        );
    }

    fn add_run(&mut self, run: &Run) {
        let smoothness = Smoothness::of(&run.truth, SmoothnessSampling::default());
        self.add("run.duration_s", run.truth.duration_s());
        self.add("run.length_m", run.truth.length_m());
        let Smoothness {
            curvature_change_mean_per_m2,
            curvature_change_rms_per_m2,
            jerk_mean_m_s3,
            jerk_rms_m_s3,
        } = smoothness;
        self.add("run.curvature_change_mean_per_m2", curvature_change_mean_per_m2);
        self.add("run.curvature_change_rms_per_m2", curvature_change_rms_per_m2);
        self.add("run.jerk_mean_m_s3", jerk_mean_m_s3);
        self.add("run.jerk_rms_m_s3", jerk_rms_m_s3);
    }

    fn add_map(
        &mut self,
        run: &Run,
        truth_from_map: Option<Pose2>,
        settings: &ScoreSettings,
    ) -> Result<(), CliError> {
        let mut recorded = run.map.clone();
        if let (Some(map), Some(truth_from_map)) = (&mut recorded, truth_from_map) {
            map.info.origin = truth_from_map * map.info.origin;
        }
        if let Some(truth) = &run.true_map {
            let clearance = Clearance::on_map(truth, &self.truth_m, settings.radius);
            self.add("run.clearance_min_m", clearance.map(|it| it.min_m));
            self.add("run.clearance_p05_m", clearance.map(|it| it.p05_m));
            if let Some(map) = &recorded {
                let score =
                    score_map(truth, map, settings.tolerance, 0.0, 0.0).map_err(|error| {
                        CliError::failed(format!("the map of {}: {error}", self.name))
                    })?;
                self.add("map.wall_iou", score.wall_iou);
                self.add("map.free_iou", score.free_iou);
                self.add("map.wall_mean_m", score.wall_mean_m);
                self.add("map.wall_p95_m", score.wall_p95_m);
                self.add("map.unknown_ratio", score.unknown_ratio);
            }
        }
        self.map = run.true_map.clone().or(recorded);
        Ok(())
    }

    fn add_goals(&mut self, run: &Run) {
        if run.goals.is_empty() {
            return;
        }
        let count = run.goals.len() as f64;
        let times: Vec<f64> =
            run.goals.iter().filter_map(|it| Some(it.reached_s? - it.start_s)).collect();
        self.add("goals.count", count);
        self.add("goals.reached_ratio", times.len() as f64 / count);
        self.add("goals.time_mean_s", ErrorStatistics::of(&times).map(|it| it.mean));
    }

    /// Scores as JSON; undefined ones are null.
    pub(crate) fn to_json(&self) -> Value {
        let scores: Map<String, Value> =
            self.scores.iter().map(|it| (it.name.clone(), json!(it.value))).collect();
        json!({ "run": self.name, "truth": self.truth_source, "scores": scores })
    }

    /// Reads scores that [`RunScores::to_json`] wrote.
    pub(crate) fn from_json(name: &str, text: &str) -> Result<Self, CliError> {
        let wrong = |what: &str| {
            CliError::failed(format!(
                "{name}{what}; write it with `periplus score RUN --json > FILE.json`"
            ))
        };
        let value: Value =
            serde_json::from_str(text).map_err(|error| wrong(&format!(" is not JSON: {error}")))?;
        let scores = value["scores"].as_object().ok_or_else(|| wrong(" has no `scores`"))?;
        let score = |(name, value): (&String, &Value)| {
            let hidden = ["std", "min", "sse"].iter().any(|it| name.contains(&format!("pe_{it}_")));
            let value = value.as_f64().unwrap_or(f64::NAN);
            Score { name: name.clone(), value, is_shown: !hidden }
        };
        let scores = scores.iter().map(score).collect();
        Ok(Self { name: name.to_owned(), scores, ..Self::default() })
    }
}

fn position(pose: Pose2) -> [f64; 2] {
    [pose.x_m, pose.y_m]
}
