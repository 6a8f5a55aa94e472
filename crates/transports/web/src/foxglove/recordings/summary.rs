//! Reports and differences of recordings, which the jobs of the program compute.

use super::entry::Recording;
use super::fetch::FetchAnswer;
use super::jobs::{JobError, Jobs};
use crate::foxglove::protocol;

/// Answers with the report of a recording, or of two.
pub(super) fn report(
    jobs: &dyn Jobs,
    first: &Recording,
    second: Option<&Recording>,
    answer: &FetchAnswer<'_>,
) {
    let recordings = std::iter::once(first).chain(second);
    let paths: Vec<_> = recordings.map(|recording| recording.bag.path()).collect();
    match jobs.report(&paths) {
        Ok(html) => answer.finish(protocol::report(answer.request_id, &html)),
        Err(error) => answer.fail(&error.to_string()),
    }
}

/// Answers with the difference of two recordings.
pub(super) fn difference(
    jobs: &dyn Jobs,
    first: &Recording,
    second: &Recording,
    answer: &FetchAnswer<'_>,
) {
    match jobs.difference(first.bag.path(), second.bag.path(), answer.is_cancelled) {
        Ok(found) => answer.finish(protocol::difference(answer.request_id, &found)),
        Err(JobError::Cancelled) => answer.fail_cancelled(),
        Err(error) => answer.fail(&error.to_string()),
    }
}
