//! Evaluation of trajectories as data, and the search for the best one.
//!
//! Source: `coreScoringAlgorithm` of `dwb_local_planner.cpp`, `illegal_trajectory_tracker.cpp`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Arc;

use super::SampledTrajectory;
use super::critics::{CriticInput, IllegalTrajectory, NamedCritic};
use crate::BlockedCell;

/// Score of one critic (`dwb_msgs/CriticScore`).
#[derive(Clone, Debug, PartialEq)]
pub struct CriticScore {
    /// Name of the critic.
    pub name: Arc<str>,
    /// Score before the scale; -1 if the critic found the trajectory illegal.
    pub raw_score: f64,
    /// Scale.
    pub scale: f64,
}

/// Scores of one trajectory (`dwb_msgs/TrajectoryScore`).
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryScore {
    /// Trajectory.
    pub trajectory: SampledTrajectory,
    /// Scores, in the order of the critics, up to the one that ended the evaluation.
    pub scores: Vec<CriticScore>,
    /// Sum of the scaled scores; -1 for illegal trajectories.
    pub total: f64,
    /// Reason why the trajectory is illegal.
    pub illegal: Option<IllegalTrajectory>,
}

/// Scores of the cells of the costmap by one critic.
#[derive(Clone, Debug, PartialEq)]
pub struct CellScores {
    /// Name of the critic, or `total_cost`.
    pub name: String,
    /// Scores, row by row.
    pub scores: Vec<f32>,
}

/// Evaluation of all trajectories of a cycle (`dwb_msgs/LocalPlanEvaluation`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LocalPlanEvaluation {
    /// Trajectories, in the order of their evaluation.
    pub twists: Vec<TrajectoryScore>,
    /// Index of the best legal trajectory.
    pub best_index: Option<usize>,
    /// Index of the worst legal trajectory.
    pub worst_index: Option<usize>,
    /// Scores of cells, if `publish_cost_grid_pc` is set.
    pub cell_scores: Vec<CellScores>,
    /// Names of critics that had no basis for scores.
    pub unprepared: Vec<String>,
}

impl LocalPlanEvaluation {
    /// Returns the best legal trajectory.
    #[must_use]
    pub fn best(&self) -> Option<&TrajectoryScore> {
        self.twists.get(self.best_index?)
    }

    /// Returns the cell that most illegal trajectories hit first, if there was no legal one.
    #[must_use]
    pub fn blocked(&self) -> Option<BlockedCell> {
        if self.best_index.is_some() {
            return None;
        }
        let reasons = self.illegal_counts();
        let most = reasons.iter().max_by_key(|reason| reason.count)?;
        most.blocked.or_else(|| reasons.iter().find_map(|reason| reason.blocked))
    }

    /// Returns the reasons for which trajectories were illegal, the most frequent first.
    #[must_use]
    pub fn illegal_counts(&self) -> Vec<IllegalCount> {
        let mut counts: BTreeMap<(&str, &str), IllegalCount> = BTreeMap::new();
        for score in &self.twists {
            let (Some(illegal), Some(critic)) = (&score.illegal, score.scores.last()) else {
                continue;
            };
            let entry = counts.entry((&critic.name, illegal.reason));
            let count = entry.or_insert_with(|| IllegalCount {
                critic: critic.name.to_string(),
                reason: illegal.reason,
                count: 0,
                blocked: illegal.blocked,
            });
            count.count += 1;
        }
        let mut counts: Vec<IllegalCount> = counts.into_values().collect();
        counts.sort_by_key(|count| std::cmp::Reverse(count.count));
        counts
    }

    /// Returns Nav2's sentence for a cycle without a legal trajectory, with the reasons.
    #[must_use]
    pub fn failure(&self) -> String {
        let mut text = format!("No valid trajectories out of {}! ", self.twists.len());
        if self.twists.is_empty() {
            text += "All velocity limits exclude each other, or are 0 (`max_vel_x`, `max_speed_xy`, `acc_lim_x`, ...)";
            return text;
        }
        for (index, count) in self.illegal_counts().iter().enumerate() {
            let separator = if index == 0 { "" } else { "; " };
            let IllegalCount { critic, reason, count, blocked } = count;
            let _ = write!(text, "{separator}{count} by {critic}: {reason}");
            if let Some(blocked) = blocked {
                let _ = write!(text, " (first: {blocked})");
            }
        }
        text
    }
}

/// Number of trajectories that a critic found illegal for a reason.
#[derive(Clone, Debug, PartialEq)]
pub struct IllegalCount {
    /// Name of the critic.
    pub critic: String,
    /// Reason.
    pub reason: &'static str,
    /// Number of trajectories.
    pub count: usize,
    /// Cell that the first of them hits.
    pub blocked: Option<BlockedCell>,
}

/// Scores trajectories by critics, and finds the best one. The critics are prepared.
pub(crate) fn evaluate(
    critics: &[NamedCritic],
    input: &CriticInput<'_>,
    trajectories: impl Iterator<Item = SampledTrajectory>,
    short_circuits: bool,
) -> LocalPlanEvaluation {
    let mut evaluation = LocalPlanEvaluation::default();
    let (mut best, mut worst) = (-1.0, -1.0);
    for trajectory in trajectories {
        let limit = if short_circuits && best > 0.0 { best } else { f64::INFINITY };
        let score = score(critics, input, trajectory, limit);
        let index = evaluation.twists.len();
        if score.illegal.is_none() {
            if best < 0.0 || score.total < best {
                best = score.total;
                evaluation.best_index = Some(index);
            }
            if worst < 0.0 || score.total > worst {
                worst = score.total;
                evaluation.worst_index = Some(index);
            }
        }
        evaluation.twists.push(score);
    }
    evaluation
}

/// Scores one trajectory, until its total exceeds a limit.
fn score(
    critics: &[NamedCritic],
    input: &CriticInput<'_>,
    trajectory: SampledTrajectory,
    limit: f64,
) -> TrajectoryScore {
    let mut scores = Vec::with_capacity(critics.len());
    let mut total = 0.0;
    for NamedCritic { name, critic, .. } in critics {
        let scale = critic.scale(input);
        let name = Arc::clone(name);
        if scale == 0.0 {
            scores.push(CriticScore { name, raw_score: 0.0, scale });
            continue;
        }
        match critic.score(input, &trajectory) {
            Ok(raw_score) => {
                scores.push(CriticScore { name, raw_score, scale });
                total += raw_score * scale;
            }
            Err(illegal) => {
                // As in Nav2, an illegal trajectory has only the score of the critic that found it so.
                let scores = vec![CriticScore { name, raw_score: -1.0, scale: 0.0 }];
                return TrajectoryScore { trajectory, scores, total: -1.0, illegal: Some(illegal) };
            }
        }
        if total > limit {
            break;
        }
    }
    TrajectoryScore { trajectory, scores, total, illegal: None }
}
