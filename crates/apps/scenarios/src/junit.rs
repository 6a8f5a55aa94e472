//! JUnit XML of scenarios.

use std::fmt::Write as _;

use crate::report::ScenarioReport;

/// JUnit XML with a test case for each report; the times are simulated seconds, so that equal runs give equal files.
#[must_use]
pub fn junit_xml(reports: &[ScenarioReport]) -> String {
    let failed = reports.iter().filter(|report| !report.has_passed()).count();
    let total_s: f64 = reports.iter().map(|report| report.duration_s).sum();
    let counts = format!("tests=\"{}\" failures=\"{failed}\" errors=\"0\"", reports.len());
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {counts} time=\"{total_s:.3}\">\n\
         \x20 <testsuite name=\"periplus scenarios\" {counts} time=\"{total_s:.3}\">\n"
    );
    for report in reports {
        let file = report.path.display().to_string();
        let _ = writeln!(
            out,
            "    <testcase classname=\"{}\" name=\"{} (seed {})\" file=\"{}\" time=\"{:.3}\">",
            escaped(&file),
            escaped(&report.name),
            report.seed,
            escaped(&file),
            report.duration_s
        );
        out.push_str("      <properties>\n");
        for (name, value) in report.scores.iter().filter(|(_, value)| value.is_finite()) {
            let _ = writeln!(out, "        <property name=\"{name}\" value=\"{value}\"/>");
        }
        out.push_str("      </properties>\n");
        let failures = report.failures();
        if let Some(first) = failures.first() {
            let _ = writeln!(
                out,
                "      <failure type=\"assertion\" message=\"{}\">{}\nrun it again: {}</failure>",
                escaped(first),
                escaped(&failures.join("\n")),
                escaped(&report.replay)
            );
        }
        out.push_str("    </testcase>\n");
    }
    out.push_str("  </testsuite>\n</testsuites>\n");
    out
}

/// Text for XML 1.0: markup is escaped, characters that it does not allow are replaced.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' => out.push(letter),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ => out.push(letter),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_and_control_characters_are_escaped() {
        assert_eq!(
            escaped("a<b> & \"c\"\u{1b}[1m\n"),
            "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd}[1m\n"
        );
    }
}
