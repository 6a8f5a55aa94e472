//! Evaluation of assertions.

mod estimates;
mod goals;
mod topics;
mod walls;

use periplus_params::ParamValues;
use periplus_session::SimulationSession;

use crate::file::{Scenario, ScenarioAssertion};
use crate::report::AssertionReport;
use crate::run::RunRecord;
use crate::tables::{
    InOrderParams, LatencyCheckParams, LocalizationErrorParams, MapIouParams, MinClearanceParams,
    OdometryErrorParams, PathRatioParams, RateParams, ReachedParams, SplParams,
    TrackingErrorParams,
};

/// Result of a check.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Verdict {
    pub(crate) has_passed: bool,
    pub(crate) measured: Option<f64>,
    pub(crate) unit: &'static str,
    pub(crate) message: String,
}

impl Verdict {
    /// Failure without a measured value, such as a missing topic.
    pub(crate) fn unknown(message: impl Into<String>) -> Self {
        Self { has_passed: false, measured: None, unit: "", message: message.into() }
    }

    pub(crate) fn new(
        has_passed: bool,
        measured: f64,
        unit: &'static str,
        message: impl Into<String>,
    ) -> Self {
        Self { has_passed, measured: Some(measured), unit, message: message.into() }
    }
}

/// Evaluates all assertions of a run.
pub(crate) fn evaluate(
    scenario: &Scenario,
    session: &mut SimulationSession,
    record: &RunRecord,
) -> Vec<AssertionReport> {
    let report = |assertion: &ScenarioAssertion| {
        let verdict = verdict(assertion, scenario, session, record);
        let (file, at) = scenario.sources.locate(assertion.span);
        AssertionReport {
            text: text(assertion),
            location: format!("{file}:{}:{}", at.line, at.column),
            has_passed: verdict.has_passed,
            measured: verdict.measured,
            unit: verdict.unit,
            message: verdict.message,
        }
    };
    scenario.assertions.iter().map(report).collect()
}

fn verdict(
    assertion: &ScenarioAssertion,
    scenario: &Scenario,
    session: &mut SimulationSession,
    record: &RunRecord,
) -> Verdict {
    let values: &ParamValues = &assertion.values;
    match assertion.word {
        "reached" => goals::reached(&ReachedParams::from_values(values), record),
        "path_ratio" => goals::path_ratio(&PathRatioParams::from_values(values), scenario, record),
        "spl" => goals::spl(&SplParams::from_values(values), scenario, session, record),
        "no_collision" => walls::no_collision(record),
        "min_clearance" => walls::min_clearance(&MinClearanceParams::from_values(values), record),
        "map_iou" => walls::map_iou(&MapIouParams::from_values(values), session, record),
        "tracking_error" => {
            estimates::tracking_error(&TrackingErrorParams::from_values(values), record)
        }
        "localization_error" => {
            let params = LocalizationErrorParams::from_values(values);
            estimates::localization_error(&params, record)
        }
        "odometry_error" => {
            estimates::odometry_error(&OdometryErrorParams::from_values(values), record)
        }
        "rate" => topics::rate(&RateParams::from_values(values), record),
        "latency" => topics::latency(&LatencyCheckParams::from_values(values), record),
        "in_order" => topics::in_order(&InOrderParams::from_values(values), record),
        word => Verdict::unknown(format!("`{word}` cannot be evaluated")),
    }
}

/// Assertion as text: its word and the parameters that the file sets.
fn text(assertion: &ScenarioAssertion) -> String {
    let values = &assertion.values;
    let given = values.table().names().filter(|name| values.is_given(name));
    let parts: Vec<String> =
        given.filter_map(|name| Some(format!("{name}={}", values.get(name)?))).collect();
    if parts.is_empty() {
        assertion.word.to_owned()
    } else {
        format!("{}({})", assertion.word, parts.join(", "))
    }
}

/// Scores of a run, besides those of the assertions.
pub(crate) fn scores(record: &RunRecord) -> Vec<(&'static str, f64)> {
    let mut scores = Vec::new();
    if record.truth.has_robot {
        scores.push(("length_m", record.truth.length_m));
        scores.push(("min_clearance_m", record.truth.min_clearance_m));
        scores.push(("collision_count", record.truth.collision_count as f64));
    }
    if let Some(errors) = estimates::localization_statistics(record, 0.0) {
        scores.push(("localization_rms_m", errors.rmse));
        scores.push(("localization_max_m", errors.max));
    }
    if let Some(errors) = estimates::odometry_statistics(record, 0.0) {
        scores.push(("odometry_max_m", errors.max));
    }
    if record.goal_event_count > 0 {
        let reached = record.goals.iter().filter(|end| end.is_success).count();
        scores.push(("goals_reached", reached as f64));
        scores.push(("goal_time_s", record.goals.iter().map(|end| end.time_s).sum()));
    }
    scores
}
