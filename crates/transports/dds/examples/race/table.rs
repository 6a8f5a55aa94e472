//! Results as Markdown.

use std::fmt::Write as _;

use serde_json::Value;

/// Formats a table for each load.
pub(super) fn tables(figures: &Value) -> String {
    let none = Vec::new();
    let lines = figures.as_array().unwrap_or(&none);
    let mut out = String::new();
    let mut load = "";
    for line in lines {
        let name = line["load"].as_str().unwrap_or_default();
        if name != load {
            load = name;
            let _ = write!(
                out,
                "{}**{name}**\n\n| from | to | rate \\[Hz\\] | lost | p50, p95, p99 \\[ms\\] | core \
                 of the publisher | of the subscriber |\n|---|---|---|---|---|---|---|\n",
                if out.is_empty() { "" } else { "\n" }
            );
        }
        if line["to"].is_null() {
            let core = number(&line["publisher_core"]) * 100.0;
            let from = line["from"].as_str().unwrap_or_default();
            let _ = writeln!(out, "| {from} | | | | | {core:.1} % | |");
            continue;
        }
        let (sent, received) = (number(&line["sent"]), number(&line["received"]));
        let _ = writeln!(
            out,
            "| {} | {} | {:.1} | {:.2} % | {:.2}, {:.2}, {:.2} | {:.1} % | {:.1} % |",
            line["from"].as_str().unwrap_or_default(),
            line["to"].as_str().unwrap_or_default(),
            number(&line["rate_hz"]),
            (sent - received) / sent * 100.0,
            number(&line["p50_us"]) * 1e-3,
            number(&line["p95_us"]) * 1e-3,
            number(&line["p99_us"]) * 1e-3,
            number(&line["publisher_core"]) * 100.0,
            number(&line["subscriber_core"]) * 100.0,
        );
    }
    out
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}
