//! Creation of DDS endpoints, and findings.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::sync::Arc;

use periplus_cyclonedds_sys::{DataReader, DataWriter, DdsQos, Participant, WaitToken, Waitset};
use periplus_diagnostics::Diagnostic;
use periplus_transport::lock;

use crate::outgoing::Outgoing;
use crate::user_data;
use crate::wire::Shared;

pub(super) struct Net {
    pub(super) participant: Participant,
    pub(super) waitset: Waitset,
    pub(super) shared: Arc<Shared>,
    said: RefCell<BTreeSet<String>>,
}

/// Names of an endpoint in DDS.
pub(super) struct Subject<'a> {
    pub(super) topic: &'a str,
    pub(super) type_name: &'a str,
    pub(super) type_hash: Option<&'a str>,
}

impl Net {
    pub(super) fn new(participant: Participant, waitset: Waitset, shared: Arc<Shared>) -> Self {
        Self { participant, waitset, shared, said: RefCell::default() }
    }

    /// Reports a finding once.
    pub(super) fn say(&self, finding: Diagnostic) {
        if self.said.borrow_mut().insert(finding.message.clone()) {
            self.shared.report(finding);
        }
    }

    /// Reports a failure once.
    pub(super) fn complain(&self, code: &'static str, message: String) {
        self.say(Diagnostic::warning(code, message));
    }

    /// Creates a writer with its queue, and the token that reports changes of its readers.
    pub(super) fn watched_writer(
        &self,
        subject: &Subject<'_>,
        qos: &DdsQos,
        keeps: bool,
    ) -> Option<(Arc<Outgoing>, WaitToken)> {
        let writer = self.raw_writer(subject, qos)?;
        let watched = self.waitset.watch_writer(&writer);
        let token = watched.map_err(|error| self.complain("wire", error.to_string())).ok()?;
        Some((self.queued(writer, qos, keeps), token))
    }

    /// Creates a writer with its queue.
    pub(super) fn writer(&self, subject: &Subject<'_>, qos: &DdsQos) -> Option<Arc<Outgoing>> {
        Some(self.queued(self.raw_writer(subject, qos)?, qos, true))
    }

    fn queued(&self, writer: DataWriter, qos: &DdsQos, keeps: bool) -> Arc<Outgoing> {
        let depth = qos.depth.unwrap_or(crate::qos::MOST_KEPT);
        let outgoing = Outgoing::new(writer, depth, keeps, &self.shared.lanes);
        let mut writers = lock(&self.shared.writers);
        // Drop writers that only this list refers to once they are flushed.
        writers.retain(|one| Arc::strong_count(one) > 1);
        writers.push(outgoing.clone());
        outgoing
    }

    /// Creates a writer without a queue.
    pub(super) fn raw_writer(&self, subject: &Subject<'_>, qos: &DdsQos) -> Option<DataWriter> {
        let said = subject.type_hash.map_or_else(Vec::new, user_data::type_hash);
        let made = self.participant.writer(subject.topic, subject.type_name, qos, &said);
        made.map_err(|error| self.complain("wire", error.to_string())).ok()
    }

    /// Creates a reader, and the token that reports new samples.
    pub(super) fn reader(
        &self,
        subject: &Subject<'_>,
        qos: &DdsQos,
    ) -> Option<(DataReader, WaitToken)> {
        let said = subject.type_hash.map_or_else(Vec::new, user_data::type_hash);
        let made = self.participant.reader(subject.topic, subject.type_name, qos, &said);
        let watched = made.and_then(|reader| {
            let token = self.waitset.watch_reader(&reader)?;
            Ok((reader, token))
        });
        watched.map_err(|error| self.complain("wire", error.to_string())).ok()
    }
}
