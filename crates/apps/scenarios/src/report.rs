//! Reports of scenarios.

use std::fmt;
use std::io::{self, Write};
use std::path::PathBuf;

use periplus_geometry::Pose2;
use serde_json::{Value, json};

/// Result of an assertion.
#[derive(Clone, Debug, PartialEq)]
pub struct AssertionReport {
    /// Assertion as text, such as `min_clearance 0.2`.
    pub text: String,
    /// File, line and column of the assertion.
    pub location: String,
    /// True if it holds.
    pub has_passed: bool,
    /// Measured value; `None` if there is none.
    pub measured: Option<f64>,
    /// Unit of the measured value; may be empty.
    pub unit: &'static str,
    /// Result in a sentence.
    pub message: String,
}

/// End of a goal.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalEnd {
    /// Goal in the world.
    pub goal: Pose2,
    /// True pose of the robot at the end.
    pub pose: Option<Pose2>,
    /// Outcome that the navigator reports.
    pub outcome: String,
    /// True if the navigator reports success.
    pub is_success: bool,
    /// Simulated time of the end \[s\].
    pub end_s: f64,
    /// Simulated time from sending the goal to its end \[s\].
    pub time_s: f64,
    /// Number of recoveries.
    pub recoveries: i64,
}

/// End of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RunOutcome {
    /// All goals have ended, or the time limit of a run without goals.
    Complete,
    /// The time limit, before all goals had ended.
    Timeout,
    /// A signal.
    Interrupted,
    /// The simulation ended, for this reason.
    Failed(String),
}

impl fmt::Display for RunOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Complete => f.write_str("complete"),
            Self::Timeout => f.write_str("time limit"),
            Self::Interrupted => f.write_str("interrupted"),
            Self::Failed(reason) => write!(f, "failed: {reason}"),
        }
    }
}

/// Result of a scenario. It depends on the scenario and its seed only.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioReport {
    /// Name of the scenario.
    pub name: String,
    /// File of the scenario.
    pub path: PathBuf,
    /// Seed.
    pub seed: u64,
    /// Variables with their values.
    pub variables: Vec<(String, String)>,
    /// End of the run.
    pub outcome: RunOutcome,
    /// Simulated time of the run \[s\].
    pub duration_s: f64,
    /// Goals that have ended.
    pub goals: Vec<GoalEnd>,
    /// Assertions, in the order of the file.
    pub assertions: Vec<AssertionReport>,
    /// Problems with events and faults.
    pub problems: Vec<String>,
    /// Scores by name, with their units in the names; undefined ones are left out.
    pub scores: Vec<(&'static str, f64)>,
    /// Faults, as the topic `/faults` has them.
    pub faults: Vec<Value>,
    /// Digest of all messages, with their topics and times; `None` if it was not requested.
    pub digest: Option<String>,
    /// Command that runs the scenario again.
    pub replay: String,
    /// Folder of the artifacts, if they are kept.
    pub artifacts: Option<PathBuf>,
}

impl ScenarioReport {
    /// Returns true if the run did not fail, all assertions hold, and no event or fault failed.
    #[must_use]
    pub fn has_passed(&self) -> bool {
        let is_whole = matches!(self.outcome, RunOutcome::Complete | RunOutcome::Timeout);
        is_whole && self.problems.is_empty() && self.assertions.iter().all(|it| it.has_passed)
    }

    /// Sentences about all that failed.
    #[must_use]
    pub fn failures(&self) -> Vec<String> {
        let mut failures = Vec::new();
        if let RunOutcome::Failed(reason) = &self.outcome {
            failures.push(format!("the run failed: {reason}"));
        }
        if self.outcome == RunOutcome::Interrupted {
            failures.push("the run was interrupted".to_owned());
        }
        failures.extend(self.problems.iter().cloned());
        let failed = self.assertions.iter().filter(|it| !it.has_passed);
        failures.extend(failed.map(|it| format!("{}: {}", it.location, it.message)));
        failures
    }

    /// JSON of the report.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let pose = |pose: Pose2| json!([pose.x_m, pose.y_m, pose.yaw_rad]);
        let goal = |end: &GoalEnd| {
            json!({
                "goal": pose(end.goal),
                "pose": end.pose.map(pose),
                "outcome": end.outcome,
                "is_success": end.is_success,
                "end_s": end.end_s,
                "time_s": end.time_s,
                "recoveries": end.recoveries,
            })
        };
        let assertion = |it: &AssertionReport| {
            json!({
                "assertion": it.text,
                "location": it.location,
                "passed": it.has_passed,
                "measured": it.measured.filter(|value| value.is_finite()),
                "unit": it.unit,
                "message": it.message,
            })
        };
        let scores = self.scores.iter().filter(|(_, value)| value.is_finite());
        let scores = scores.map(|(name, value)| ((*name).to_owned(), json!(value)));
        let variables = self.variables.iter().map(|(name, value)| (name.clone(), json!(value)));
        json!({
            "name": self.name,
            "scenario": self.path,
            "seed": self.seed,
            "variables": variables.collect::<serde_json::Map<_, _>>(),
            "passed": self.has_passed(),
            "outcome": self.outcome.to_string(),
            "duration_s": self.duration_s,
            "goals": self.goals.iter().map(goal).collect::<Vec<_>>(),
            "assertions": self.assertions.iter().map(assertion).collect::<Vec<_>>(),
            "problems": self.problems,
            "scores": scores.collect::<serde_json::Map<_, _>>(),
            "faults": self.faults,
            "digest": self.digest,
            "replay": self.replay,
            "artifacts": self.artifacts,
        })
    }

    /// Writes the report as text.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        let word = if self.has_passed() { "passed" } else { "FAILED" };
        let (name, seed) = (&self.name, self.seed);
        let outcome = self.outcome.to_string();
        writeln!(
            out,
            "{name}: {word}, seed {seed}, {:.3} s simulated, {outcome}",
            self.duration_s
        )?;
        for end in &self.goals {
            let Pose2 { x_m, y_m, yaw_rad } = end.goal;
            let goal = format!("{x_m:.2}, {y_m:.2}, {yaw_rad:.2}");
            writeln!(out, "  goal ({goal}): {} after {:.1} s", end.outcome, end.time_s)?;
        }
        for assertion in &self.assertions {
            let word = if assertion.has_passed { "pass" } else { "FAIL" };
            writeln!(out, "  {word} {}: {}", assertion.text, assertion.message)?;
            if !assertion.has_passed {
                writeln!(out, "       {}", assertion.location)?;
            }
        }
        for problem in &self.problems {
            writeln!(out, "  FAIL {problem}")?;
        }
        if let Some(digest) = &self.digest {
            writeln!(out, "  digest {digest}")?;
        }
        if let Some(folder) = &self.artifacts {
            writeln!(out, "  artifacts: {}", folder.display())?;
        }
        if !self.has_passed() {
            writeln!(out, "  run it again: {}", self.replay)?;
        }
        Ok(())
    }
}
