//! Number of messages over time.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use periplus_bags::files::BagError;

use super::entry::{Recording, topic_id};
use super::fetch::FetchAnswer;
use crate::foxglove::protocol;

/// Maximum number of bins: more than a screen has columns.
const MAX_BINS: u32 = 10_000;

/// Maximum number of values of an answer, over all topics.
const MAX_VALUES: usize = 2_000_000;

/// Answers with the number of messages of each topic in equal bins over the recording.
pub(super) fn fetch(
    recording: &Recording,
    bins: u32,
    answer: &FetchAnswer<'_>,
) -> Result<(), BagError> {
    let topics = recording.bag.topics().len();
    let bins = bins.clamp(1, MAX_BINS) as usize;
    let bins = bins.min(MAX_VALUES / topics.max(1)).max(1);
    let mut counts: Vec<Vec<u64>> = vec![vec![0; bins]; topics];
    let (start_ns, end_ns) = recording.bag.span_ns().unwrap_or((0, 0));
    let all: Vec<usize> = (0..topics).collect();
    recording.bag.visit_times(&all, &mut |topic, time_ns| {
        let bin = bin_of(time_ns, start_ns, end_ns, bins);
        if let Some(count) = counts.get_mut(topic).and_then(|counts| counts.get_mut(bin)) {
            *count += 1;
        }
        if answer.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    if answer.is_cancelled() {
        answer.fail_cancelled();
        return Ok(());
    }
    let by_id: BTreeMap<u32, Vec<u64>> =
        counts.into_iter().enumerate().map(|(topic, counts)| (topic_id(topic), counts)).collect();
    answer.finish(protocol::density(answer.request_id, &by_id));
    Ok(())
}

/// Bin of a time; the last bin includes the end.
pub(super) fn bin_of(time_ns: i64, start_ns: i64, end_ns: i64, bins: usize) -> usize {
    let length_ns = i128::from(end_ns) - i128::from(start_ns);
    let since_ns = (i128::from(time_ns) - i128::from(start_ns)).max(0);
    let bin = since_ns * bins as i128 / length_ns.max(1);
    usize::try_from(bin).unwrap_or(bins).min(bins.saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_are_equal_and_the_last_includes_the_end() {
        let bins: Vec<usize> = (0..=10).map(|time_ns| bin_of(time_ns, 0, 10, 5)).collect();
        assert_eq!(bins, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]);
        assert_eq!(bin_of(7, 7, 7, 3), 0);
        assert_eq!(bin_of(i64::MAX, i64::MIN, i64::MAX, 4), 3);
    }
}
