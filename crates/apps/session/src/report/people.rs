//! Comfort of people in the report of a run.

use std::io::{self, Write};

use periplus_sim::PeopleReport;
use serde_json::{Value, json};

/// Writes the comfort of people as text: a line for all, and one for each robot.
///
/// # Errors
/// A failed write.
pub(super) fn write_text(report: &PeopleReport, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "  {} people ({}), longest freeze {:.1} s, {} of more than 10 s",
        report.count, report.model, report.people.longest_freeze_s, report.people.freezes
    )?;
    let or_none = |value: Option<f64>, unit: &str| {
        value.map_or_else(|| "none".to_owned(), |value| format!("{value:.2} {unit}"))
    };
    for (name, robot) in &report.robots {
        writeln!(
            out,
            "  people near {name}: nearest {}, {:.1} s within 0.45 m, {:.1} s within 1.2 m, time to \
             collision {}, {} forced stops, {} forced detours",
            or_none(robot.min_distance_m, "m"),
            robot.intimate_s,
            robot.personal_s,
            or_none(robot.min_time_to_collision_s, "s"),
            robot.forced_stops,
            robot.forced_detours
        )?;
    }
    Ok(())
}

/// Comfort of people as JSON.
pub(super) fn to_json(report: &PeopleReport) -> Value {
    let robots = report.robots.iter().map(|(name, robot)| {
        json!({
            "name": name,
            "min_distance_m": robot.min_distance_m,
            "intimate_s": robot.intimate_s,
            "personal_s": robot.personal_s,
            "min_time_to_collision_s": robot.min_time_to_collision_s,
            "forced_stops": robot.forced_stops,
            "forced_detours": robot.forced_detours,
        })
    });
    json!({
        "count": report.count,
        "model": report.model,
        "longest_freeze_s": report.people.longest_freeze_s,
        "freezes": report.people.freezes,
        "robots": robots.collect::<Vec<_>>(),
    })
}
