//! Numbers of messages over time.

use std::ops::{ControlFlow, Range};

use periplus_bags::files::{BagError, ChunkUse, MessageLocation};
use periplus_msgs::{DynamicMessage, Format};

use super::density::bin_of;
use super::entry::Recording;
use super::fetch::FetchAnswer;
use super::number_path::NumberPath;
use crate::foxglove::protocol::{self, TimeNs};

/// Maximum number of messages that are located at once.
const PAGE: usize = 4096;

/// Maximum number of values per path.
const MAX_POINTS: usize = 100_000;

/// Maximum number of values of an answer, over all paths.
const MAX_VALUES: usize = 1_000_000;

/// Numbers to be read.
pub(super) struct SeriesRequest {
    pub(super) topic: u32,
    pub(super) paths: Vec<String>,
    pub(super) span_ns: Range<i64>,
    pub(super) points: u32,
}

/// Values over time, a list per path.
#[derive(Debug, PartialEq)]
struct Series {
    times_ns: Vec<TimeNs>,
    values: Vec<Vec<f64>>,
}

/// Answers with the numbers of a topic.
pub(super) fn fetch(
    recording: &Recording,
    request: &SeriesRequest,
    answer: &FetchAnswer<'_>,
) -> Result<(), BagError> {
    let Some(topic) = recording.topic(request.topic) else {
        answer.fail(&format!("the recording has no topic {}", request.topic));
        return Ok(());
    };
    let described = &recording.bag.topics()[topic];
    let layout = described.layout().filter(|_| described.encoding == "cdr");
    let Some(layout) = layout else {
        let (name, type_name) = (&described.name, &described.type_name);
        answer
            .fail(&format!("the messages of `{name}` cannot be decoded: `{type_name}` is unknown"));
        return Ok(());
    };
    let paths: Vec<NumberPath> = request.paths.iter().map(|path| NumberPath::new(path)).collect();
    let points = usize::try_from(request.points).unwrap_or(MAX_POINTS).clamp(2, MAX_POINTS);
    let points = points.min(MAX_VALUES / paths.len().max(1)).max(2);
    let span_ns = limited(&request.span_ns, recording);
    let count = count(recording, topic, &span_ns, points, answer)?;
    let is_reduced = count > points;
    let mut series = Series { times_ns: Vec::new(), values: vec![Vec::new(); paths.len()] };
    let mut bins = Bins::new(&span_ns, points / 2, paths.len());
    let mut from_ns = Some(span_ns.start);
    while let Some(start_ns) = from_ns
        && !answer.is_cancelled()
    {
        let page = recording.bag.between(&[topic], start_ns, span_ns.end, PAGE)?;
        let visit = &mut |location: &MessageLocation, data: &[u8]| {
            if let Ok(message) = DynamicMessage::decode(&layout, Format::CDR, data) {
                let numbers = paths.iter().map(|path| path.number(&message));
                if is_reduced {
                    bins.add(location.time_ns, numbers);
                } else {
                    series.times_ns.push(TimeNs(location.time_ns));
                    series.values.iter_mut().zip(numbers).for_each(|(all, one)| all.push(one));
                }
            }
            if answer.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        recording.bag.read(&page.locations, ChunkUse::Once, visit)?;
        from_ns = page.next_ns;
    }
    if answer.is_cancelled() {
        answer.fail_cancelled();
        return Ok(());
    }
    if is_reduced {
        series = bins.finish();
    }
    let Series { times_ns, values } = series;
    answer.finish(protocol::series(answer.request_id, &times_ns, &values, is_reduced));
    Ok(())
}

/// The part of a span that has messages.
fn limited(span_ns: &Range<i64>, recording: &Recording) -> Range<i64> {
    let (start_ns, last_ns) = recording.bag.span_ns().unwrap_or((0, 0));
    span_ns.start.max(start_ns)..span_ns.end.min(last_ns.saturating_add(1))
}

/// Number of messages of a topic in a span; counting ends above `most`.
fn count(
    recording: &Recording,
    topic: usize,
    span_ns: &Range<i64>,
    most: usize,
    answer: &FetchAnswer<'_>,
) -> Result<usize, BagError> {
    let (mut count, mut from_ns) = (0, Some(span_ns.start));
    while let Some(start_ns) = from_ns
        && count <= most
        && !answer.is_cancelled()
    {
        let page = recording.bag.between(&[topic], start_ns, span_ns.end, PAGE)?;
        count += page.locations.len();
        from_ns = page.next_ns;
    }
    Ok(count)
}

/// Smallest and largest values in equal spans.
struct Bins {
    span_ns: Range<i64>,
    paths: usize,
    bins: Vec<Option<Bin>>,
}

/// Values in a span.
#[derive(Clone)]
struct Bin {
    first_ns: i64,
    last_ns: i64,
    /// For each path the extremes in the order of their times; NaN without numbers.
    extremes: Vec<Extremes>,
}

#[derive(Clone, Copy)]
struct Extremes {
    min: f64,
    max: f64,
    /// True if the minimum came first.
    is_min_first: bool,
}

impl Extremes {
    fn of(number: f64) -> Self {
        Self { min: number, max: number, is_min_first: true }
    }

    fn add(&mut self, number: f64) {
        if self.min.is_nan() {
            *self = Self::of(number);
        } else if number < self.min {
            (self.min, self.is_min_first) = (number, false);
        } else if number > self.max {
            (self.max, self.is_min_first) = (number, true);
        }
    }

    fn in_order(self) -> [f64; 2] {
        if self.is_min_first { [self.min, self.max] } else { [self.max, self.min] }
    }
}

impl Bins {
    fn new(span_ns: &Range<i64>, count: usize, paths: usize) -> Self {
        Self { span_ns: span_ns.clone(), paths, bins: vec![None; count.max(1)] }
    }

    fn add(&mut self, time_ns: i64, numbers: impl Iterator<Item = f64>) {
        let count = self.bins.len();
        let index = bin_of(time_ns, self.span_ns.start, self.span_ns.end, count);
        let Some(bin) = self.bins.get_mut(index) else { return };
        let extremes = vec![Extremes::of(f64::NAN); self.paths];
        let bin = bin.get_or_insert(Bin { first_ns: time_ns, last_ns: time_ns, extremes });
        bin.last_ns = time_ns;
        bin.extremes.iter_mut().zip(numbers).for_each(|(extremes, one)| extremes.add(one));
    }

    /// Two values per span at the times of its first and last message.
    fn finish(self) -> Series {
        let mut series = Series { times_ns: Vec::new(), values: vec![Vec::new(); self.paths] };
        for bin in self.bins.into_iter().flatten() {
            series.times_ns.extend([TimeNs(bin.first_ns), TimeNs(bin.last_ns)]);
            for (values, extremes) in series.values.iter_mut().zip(bin.extremes) {
                values.extend(extremes.in_order());
            }
        }
        series
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spikes_survive_in_the_order_of_their_times() {
        let mut bins = Bins::new(&(0..10), 2, 1);
        for (time_ns, number) in [(0, 1.0), (1, 9.0), (2, -3.0), (4, 2.0), (5, f64::NAN), (7, 4.0)]
        {
            bins.add(time_ns, [number].into_iter());
        }
        let times_ns = [0, 4, 5, 7].map(TimeNs).to_vec();
        let values = vec![vec![9.0, -3.0, 4.0, 4.0]];
        assert_eq!(bins.finish(), Series { times_ns, values });
    }

    #[test]
    fn spans_without_messages_have_no_values() {
        let mut bins = Bins::new(&(0..100), 10, 2);
        bins.add(95, [1.0, 2.0].into_iter());
        let series = bins.finish();
        assert_eq!(series.times_ns, [TimeNs(95), TimeNs(95)]);
        assert_eq!(series.values, [[1.0, 1.0], [2.0, 2.0]]);
    }
}
