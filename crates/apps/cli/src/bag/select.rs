//! Selection of messages of a recording, and settings of the output.

use std::collections::BTreeSet;
use std::path::Path;

use periplus_bags::Selection;
use periplus_bags::files::{Bag, Storage, WriteSettings};

use super::options::{NameOptions, SelectOptions, WriteOptions};

impl NameOptions {
    /// Returns true if all topics are selected.
    fn is_all(&self) -> bool {
        self.topics.is_empty()
            && self.regex.is_none()
            && self.exclude_topics.is_empty()
            && self.exclude_regex.is_none()
    }

    /// Returns true if a topic is selected.
    fn wants(&self, name: &str) -> bool {
        let has_no_choice = self.topics.is_empty() && self.regex.is_none();
        let chosen = has_no_choice
            || self.topics.iter().any(|one| same(one, name))
            || self.regex.as_ref().is_some_and(|regex| regex.is_match(name));
        let excluded = self.exclude_topics.iter().any(|one| same(one, name))
            || self.exclude_regex.as_ref().is_some_and(|regex| regex.is_match(name));
        chosen && !excluded
    }
}

impl SelectOptions {
    /// Returns true if everything is selected.
    pub(super) fn is_all(&self) -> bool {
        self.names.is_all()
            && [self.start_offset, self.duration, self.start, self.end].iter().all(Option::is_none)
    }

    /// Selection as topics and times of these recordings.
    pub(super) fn of(&self, bags: &[Bag]) -> Selection {
        let names = bags.iter().flat_map(|bag| bag.topics()).map(|topic| &topic.name);
        let topics: BTreeSet<String> =
            names.filter(|name| self.names.wants(name)).cloned().collect();
        let begin = bags.iter().filter_map(Bag::span_ns).map(|(start, _)| start).min();
        let begin_ns = begin.unwrap_or(0);
        let from_ns = match (self.start, self.start_offset) {
            (Some(start_ns), _) => start_ns,
            (None, Some(offset_ns)) => begin_ns.saturating_add(offset_ns),
            (None, None) => i64::MIN,
        };
        let to_ns = match (self.end, self.duration) {
            (Some(end_ns), _) => end_ns,
            (None, Some(span_ns)) => from_ns.max(begin_ns).saturating_add(span_ns),
            (None, None) => i64::MAX,
        };
        Selection { topics: Some(topics), span_ns: from_ns..=to_ns }
    }

    /// Selected names that no recording has.
    pub(super) fn unknown<'a>(&'a self, bags: &'a [Bag]) -> impl Iterator<Item = &'a String> {
        let names = || bags.iter().flat_map(|bag| bag.topics()).map(|topic| &topic.name);
        self.names.topics.iter().filter(move |one| !names().any(|name| same(one, name)))
    }
}

/// Compares names; the leading slash may be omitted.
fn same(typed: &str, name: &str) -> bool {
    typed.trim_start_matches('/') == name.trim_start_matches('/')
}

impl WriteOptions {
    /// Settings for an output path; `usual` applies where neither the path nor the options select a
    /// storage.
    pub(super) fn settings(&self, output: &Path, usual: Storage) -> WriteSettings {
        let told = self.storage.map(Storage::from);
        let storage = told.or_else(|| Storage::of_path(output)).unwrap_or(usual);
        let plain = WriteSettings::new(storage);
        WriteSettings {
            chunks: self.chunks.map_or(plain.chunks, Into::into),
            mode: self.compression_mode.into(),
            packing: self.compression_format.into(),
            max_bytes: self.max_bag_size.filter(|&bytes| bytes > 0),
            max_span_ns: self.max_bag_duration.filter(|&span_ns| span_ns > 0),
            style: self.style.into(),
            ..plain
        }
    }
}
