//! Outcomes as lines for a person and for a program.

use std::fmt::Write as _;

use periplus_slam::{Errors, Method};

use crate::score::{Outcome, Verdict};

fn name(it: &Outcome) -> String {
    let seed = it.seed.map_or(String::new(), |seed| format!(" {seed}"));
    format!("{} {}{seed}", it.log, it.run)
}

/// A line on a run that has ended.
pub(crate) fn progress(it: &Outcome) -> String {
    format!(
        "{}: loops {:.3} m, end {:.2} m from the begin, {} [{}], {:.1} ms a scan",
        name(it),
        it.score.loops.mean_m,
        it.end_m,
        it.verdict.words(),
        it.kinds.join(" "),
        it.scan_ms[0]
    )
}

/// All runs, and the medians of what is perturbed of each log.
pub(crate) fn table(outcomes: &[Outcome]) -> String {
    let mut text = format!(
        "{:<22} {:>6} {:>7} {:>7} {:>7} {:>7} {:>6} {:>6} | {:>6} {:>6} {:>6} {:>6} | {:>5} {:>5} {:>4} {:>6} {:>6}\n",
        "log",
        "scans",
        "all m",
        "local",
        "loop",
        "max",
        "rot",
        "end m",
        "ms",
        "p99",
        "worst",
        "finish",
        "kept",
        "ties",
        "lost",
        "loops",
        "kB"
    );
    for (index, it) in outcomes.iter().enumerate() {
        let score = &it.score;
        let loops = match it.method {
            Method::Graph => format!("{}/{}", it.closures.0, it.closures.1),
            Method::Gmapping => it.resamplings.to_string(),
        };
        let _ = writeln!(
            text,
            "{:<22} {:>6} {:>7.4} {:>7.4} {:>7.4} {:>7.3} {:>6.3} {:>6.2} | {:>6.2} {:>6.2} {:>6.1} {:>6.0} | {:>5} {:>5} {:>4} {:>6} {:>6}",
            name(it),
            it.counts.scans,
            score.all.mean_m,
            score.local.mean_m,
            score.loops.mean_m,
            score.all.most_m,
            score.all.mean_deg,
            it.end_m,
            it.scan_ms[0],
            it.scan_ms[1],
            it.scan_ms[2],
            it.finish_ms,
            it.counts.kept,
            it.counts.proximity,
            it.counts.lost,
            loops,
            it.size / 1000
        );
        if let Some(remedy) = &it.remedy {
            let _ = writeln!(text, "    made again: {remedy}");
        }
        text += &it.notes;
        if !matches!(it.verdict, Verdict::Right | Verdict::Unknown) {
            let _ = writeln!(text, "    {} [{}]", it.verdict.words(), it.kinds.join(" "));
        }
        let is_last = outcomes.get(index + 1).is_none_or(|next| next.log != it.log);
        if is_last {
            let of_log = outcomes.iter().filter(|other| other.log == it.log);
            text += &medians(&of_log.filter(|it| it.run != "plain").collect::<Vec<_>>());
        }
    }
    text
}

fn medians(outcomes: &[&Outcome]) -> String {
    let [first, _, ..] = outcomes else { return String::new() };
    let median = |value: fn(&Outcome) -> f64| {
        let mut values: Vec<f64> = outcomes.iter().map(|it| value(it)).collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    format!(
        "{:<22} {:>6} {:>7.4} {:>7.4} {:>7.4} {:>7.3} {:>6.3}\n",
        format!("{} median", first.log),
        "",
        median(|it| it.score.all.mean_m),
        median(|it| it.score.local.mean_m),
        median(|it| it.score.loops.mean_m),
        median(|it| it.score.all.most_m),
        median(|it| it.score.all.mean_deg)
    )
}

/// The begin of the line of JSON on a run.
pub(crate) fn head(log: &str, run: &str, method: Method, seed: Option<u64>) -> String {
    let seed = seed.map_or("null".to_owned(), |it| it.to_string());
    format!("{{\"log\":\"{log}\",\"run\":\"{run}\",\"method\":\"{method}\",\"seed\":{seed},")
}

/// One line of JSON on a run.
pub(crate) fn json(it: &Outcome) -> String {
    let text = |words: &str| format!("\"{}\"", words.replace('\\', "\\\\").replace('"', "\\\""));
    let texts = |words: &[String]| {
        format!("[{}]", words.iter().map(|it| text(it)).collect::<Vec<_>>().join(","))
    };
    let errors = |it: &Errors| {
        format!(
            "{{\"relations\":{},\"mean_m\":{},\"deviation_m\":{},\"max_m\":{},\"mean_deg\":{}}}",
            it.count, it.mean_m, it.deviation_m, it.most_m, it.mean_deg
        )
    };
    let fields = [
        ("all", errors(&it.score.all)),
        ("local", errors(&it.score.local)),
        ("loops", errors(&it.score.loops)),
        ("path_m", it.path_m.to_string()),
        ("end_m", it.end_m.to_string()),
        ("end_error_m", it.end_error_m.map_or("null".into(), |it| it.to_string())),
        ("verdict", text(it.verdict.words())),
        ("remedy", it.remedy.as_deref().map_or("null".into(), text)),
        ("remarks", texts(&it.remarks)),
        ("kinds", texts(&it.kinds)),
        ("scans", it.counts.scans.to_string()),
        ("kept", it.counts.kept.to_string()),
        ("ties", it.counts.proximity.to_string()),
        ("lost", it.counts.lost.to_string()),
        ("closures", it.closures.0.to_string()),
        ("resamplings", it.resamplings.to_string()),
        ("bytes", it.size.to_string()),
        ("scan_ms", it.scan_ms[0].to_string()),
        ("p99_ms", it.scan_ms[1].to_string()),
        ("worst_ms", it.scan_ms[2].to_string()),
        ("finish_ms", it.finish_ms.to_string()),
    ];
    let fields: Vec<String> = fields.map(|(name, value)| format!("\"{name}\":{value}")).into();
    let head = head(&it.log, it.run, it.method, it.seed);
    format!("{head}{}}}\n", fields.join(","))
}
