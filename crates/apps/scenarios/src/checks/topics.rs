//! Assertions about messages of a topic.

use super::Verdict;
use crate::run::{RunRecord, TopicRecord};
use crate::tables::{InOrderParams, LatencyCheckParams, RateParams};

/// Rounding error of times \[s\].
const ROUNDING_S: f64 = 1e-9;

fn messages<'a>(topic: &str, record: &'a RunRecord) -> Result<&'a TopicRecord, Verdict> {
    let name = format!("/{}", topic.trim_start_matches('/'));
    let found = record.topics.get(&name);
    found.ok_or_else(|| Verdict::unknown(format!("no message on `{name}`")))
}

/// Stamps of a topic with their times of publication.
fn stamped<'a>(topic: &str, record: &'a RunRecord) -> Result<&'a TopicRecord, Verdict> {
    let found = messages(topic, record)?;
    if found.stamps_ns.len() == found.times_ns.len() {
        return Ok(found);
    }
    Err(Verdict::unknown(format!("the messages of `{topic}` have no stamps")))
}

pub(super) fn rate(params: &RateParams, record: &RunRecord) -> Verdict {
    let found = match messages(&params.topic, record) {
        Ok(found) => found,
        Err(verdict) => return verdict,
    };
    let (from_s, end_s) = (params.from_s, record.end_s);
    let span_s = params.until_s.unwrap_or(end_s).min(end_s) - from_s;
    if span_s <= 0.0 {
        return Verdict::unknown(format!("the run ended at {end_s:.2} s, before the measurement"));
    }
    let is_in = |time_ns: &&i64| {
        let time_s = **time_ns as f64 * 1e-9;
        from_s <= time_s && time_s < from_s + span_s
    };
    let count = found.times_ns.iter().filter(is_in).count();
    let rate_hz = count as f64 / span_s;
    // At the ends of the span a message more or less is no deviation.
    let slack_hz = params.tolerance_ratio * params.rate_hz + 1.0 / span_s;
    let has_passed = (rate_hz - params.rate_hz).abs() <= slack_hz + ROUNDING_S;
    let (topic, wanted_hz) = (&params.topic, params.rate_hz);
    let message = format!("{rate_hz:.2} Hz on `{topic}` (wanted {wanted_hz} Hz)");
    Verdict::new(has_passed, rate_hz, "Hz", message)
}

pub(super) fn latency(params: &LatencyCheckParams, record: &RunRecord) -> Verdict {
    let found = match stamped(&params.topic, record) {
        Ok(found) => found,
        Err(verdict) => return verdict,
    };
    let pairs = found.times_ns.iter().zip(&found.stamps_ns);
    let latencies_s = pairs.map(|(time_ns, stamp_ns)| (time_ns - stamp_ns) as f64 * 1e-9);
    let larger = |worst: f64, it: f64| if it.abs() > worst.abs() { it } else { worst };
    let worst_s = latencies_s.fold(0.0, larger);
    let (topic, limit_s) = (&params.topic, params.max_s);
    let message = if worst_s < 0.0 {
        format!("a stamp on `{topic}` is {:.3} s in the future", -worst_s)
    } else {
        format!("largest latency on `{topic}` {worst_s:.3} s (limit {limit_s})")
    };
    Verdict::new((0.0..=limit_s + ROUNDING_S).contains(&worst_s), worst_s, "s", message)
}

pub(super) fn in_order(params: &InOrderParams, record: &RunRecord) -> Verdict {
    let found = match stamped(&params.topic, record) {
        Ok(found) => found,
        Err(verdict) => return verdict,
    };
    let wrong = found.stamps_ns.windows(2).filter(|pair| pair[1] <= pair[0]).count();
    let (topic, count) = (&params.topic, found.stamps_ns.len());
    let message = match wrong {
        0 => format!("{count} messages on `{topic}` in order"),
        _ => format!("{wrong} of {count} messages on `{topic}` are late or repeated"),
    };
    Verdict::new(wrong == 0, wrong as f64, "", message)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Messages of a topic at times and with stamps \[ms\], in a run of 10 s.
    fn record(times_ms: &[i64], stamps_ms: &[i64]) -> RunRecord {
        let ns = |times: &[i64]| times.iter().map(|ms| ms * 1_000_000).collect();
        let topic = TopicRecord { times_ns: ns(times_ms), stamps_ns: ns(stamps_ms) };
        let topics = [("/scan".to_owned(), topic)].into();
        RunRecord { topics, end_s: 10.0, ..RunRecord::default() }
    }

    fn rate_of(period_ms: usize) -> bool {
        let times: Vec<i64> = (0..10_000).step_by(period_ms).collect();
        let params = RateParams { topic: "scan".into(), rate_hz: 10.0, ..RateParams::default() };
        rate(&params, &record(&times, &times)).has_passed
    }

    #[test]
    fn a_rate_may_deviate_by_its_tolerance() {
        assert!(rate_of(100) && rate_of(92));
        assert!(!rate_of(50) && !rate_of(140));
        let params = RateParams { topic: "/other".into(), ..RateParams::default() };
        assert!(!rate(&params, &record(&[1], &[1])).has_passed);
    }

    #[test]
    fn latency_is_the_largest_difference() {
        let check = |times: &[i64], stamps: &[i64]| {
            let params = LatencyCheckParams { topic: "/scan".into(), max_s: 0.1 };
            latency(&params, &record(times, stamps)).has_passed
        };
        assert!(check(&[0, 150], &[0, 50]));
        assert!(!check(&[0, 151], &[0, 50]));
        assert!(!check(&[0, 150], &[0, 160]));
    }

    #[test]
    fn stamps_must_increase() {
        let check = |stamps: &[i64]| {
            let params = InOrderParams { topic: "/scan".into() };
            in_order(&params, &record(stamps, stamps)).has_passed
        };
        assert!(check(&[1, 2, 3]));
        assert!(!check(&[1, 2, 2]) && !check(&[2, 1]));
    }
}
