//! Creation of Zenoh endpoints, and findings.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use zenoh::liveliness::LivelinessToken;
use zenoh::{Session, Wait};

use crate::attachment::Gid;
use crate::outgoing::Lane;
use crate::token::{self, End, EntityKind, EntityToken};
use crate::wire::Shared;
use crate::{Settings, ZenohError};

pub(super) struct Net {
    pub(super) session: Session,
    pub(super) shared: Arc<Shared>,
    pub(super) lane: Lane,
    pub(super) domain_id: u32,
    enclave: String,
    /// Persistent ids of nodes.
    nodes: RefCell<BTreeMap<String, u64>>,
    next_id: Cell<u64>,
    said: RefCell<BTreeSet<String>>,
}

impl Net {
    pub(super) fn new(
        session: Session,
        shared: Arc<Shared>,
        lane: Lane,
        settings: &Settings,
    ) -> Self {
        let (domain_id, enclave) = (settings.domain_id, settings.enclave.clone());
        let (nodes, next_id, said) = Default::default();
        Self { session, shared, lane, domain_id, enclave, nodes, next_id, said }
    }

    /// Reports a finding once.
    pub(super) fn say(&self, finding: Diagnostic) {
        if self.said.borrow_mut().insert(finding.message.clone()) {
            self.shared.report(finding);
        }
    }

    /// Reports a Zenoh error once.
    pub(super) fn complain(&self, error: &zenoh::Error) {
        self.say(Diagnostic::warning("wire", format!("Zenoh: {error}")));
    }

    /// Reports a graph error once.
    pub(super) fn complain_of_graph(&self, error: periplus_graph::GraphError) {
        self.say(Diagnostic::warning("wire", ZenohError::from(error).to_string()));
    }

    fn next_id(&self) -> u64 {
        self.next_id.replace(self.next_id.get() + 1)
    }

    /// Declares the liveliness token of a node or endpoint; returns it with the id of the endpoint.
    pub(super) fn token(
        &self,
        kind: EntityKind,
        node: &str,
        end: Option<End>,
    ) -> Option<(Gid, LivelinessToken)> {
        let known = self.nodes.borrow().get(node).copied();
        let node_id = known.unwrap_or_else(|| {
            let id = self.next_id();
            self.nodes.borrow_mut().insert(node.to_owned(), id);
            id
        });
        let token = EntityToken {
            domain_id: self.domain_id,
            session: self.session.zid().to_string(),
            node_id,
            id: if kind == EntityKind::Node { node_id } else { self.next_id() },
            kind,
            enclave: self.enclave.clone(),
            node: node.to_owned(),
            end,
        };
        let key = token.write();
        let gid = token::gid(&key);
        let made = self.session.liveliness().declare_token(key).wait();
        Some((gid, made.map_err(|error| self.complain(&error)).ok()?))
    }

    /// Ids of the remote endpoints of a kind that match this endpoint.
    pub(super) fn heard_by(&self, end: &End, kind: EntityKind) -> Vec<Gid> {
        self.shared.others(|others, _| {
            let wanted = others.iter().filter(|(_, token)| {
                token.kind == kind && token.end.as_ref().is_some_and(|other| end.hears(other))
            });
            wanted.map(|(key, _)| token::gid(key)).collect()
        })
    }
}
