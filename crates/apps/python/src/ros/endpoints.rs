//! Publishers, subscriptions, clients and servers.

mod client;
mod publisher;
mod server;
mod subscription;

use std::sync::Arc;

use periplus::graph::{Policy, QosEvent};
use periplus_lockstep::LockstepClient;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

pub(crate) use client::RosClient;
pub(crate) use publisher::RosPublisher;
pub(crate) use server::{RosCall, RosServer};
pub(crate) use subscription::RosSubscription;

use super::backend::{Backend, Shared, link_error};
use super::discovery::{End, endpoints};
use crate::work::released;

type Kind<'a> = (&'a str, Option<String>);

fn closed() -> PyErr {
    PyRuntimeError::new_err("the node or endpoint was destroyed")
}

/// The part of the backend of an endpoint in step.
fn link(shared: &Shared) -> PyResult<&LockstepClient> {
    match &shared.backend {
        Backend::Lockstep(client) => Ok(client),
        Backend::Live { .. } => Err(closed()),
    }
}

fn matched(
    py: Python<'_>,
    shared: &Arc<Shared>,
    topic: &str,
    publishers: bool,
    fits: impl Fn(&End) -> bool + Send,
) -> PyResult<usize> {
    let ends = released(py, "endpoints", || endpoints(&shared.backend, topic, publishers))?;
    Ok(ends.map_err(link_error)?.iter().filter(|end| fits(end)).count())
}

fn incompatible(events: Vec<QosEvent>) -> Vec<String> {
    let events = events.into_iter().filter_map(|event| match event {
        QosEvent::Incompatible { policies, .. } => {
            // As Fast DDS, which names the reliability first.
            let reliability = policies.iter().find(|one| one.policy == Policy::Reliability);
            Some(reliability.or(policies.last())?.policy.to_string())
        }
        _ => None,
    });
    events.collect()
}
