//! Pending parameter requests of clients.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use periplus_msgs::Message as _;
use periplus_msgs::rcl_interfaces::{
    GetParameterTypesRequest, GetParameterTypesResponse, GetParametersRequest,
    GetParametersResponse, ListParametersRequest, ListParametersResponse, Parameter,
    SetParametersRequest, SetParametersResponse,
};
use periplus_transport::Since;

use super::convert::{Named, from_json, to_json};
use super::{Shared, State};
use crate::foxglove::outbox::Outbox;
use crate::foxglove::protocol::{self, ParameterText, StatusLevel};

/// Timeout of a request; then the client gets the values received so far.
const PATIENCE: Duration = Duration::from_secs(4);

/// Pending requests by id.
#[derive(Default)]
pub(in crate::foxglove::hub) struct Jobs {
    last: u64,
    open: BTreeMap<u64, Job>,
}

/// A pending request.
pub(in crate::foxglove::hub) struct Job {
    outbox: Arc<Outbox>,
    id: Option<String>,
    /// True if the client gets the values at the end.
    tells: bool,
    pending: usize,
    values: Vec<Named>,
    since: Since,
}

/// Response of a node.
pub(in crate::foxglove::hub) enum News {
    /// Names of its parameters.
    Names(String, Vec<String>),
    /// Values of its parameters.
    Values(Vec<Named>),
    /// Types of parameters to set.
    Types(String, Vec<ParameterText>, Vec<u8>),
    /// Results of setting, by name.
    Set(String, Vec<(String, Result<(), String>)>),
    /// A malformed response.
    Nothing,
}

impl Jobs {
    pub(super) fn begin(&mut self, outbox: Arc<Outbox>, id: Option<String>, tells: bool) -> u64 {
        self.last += 1;
        let (pending, values, since) = (0, Vec::new(), Since::now());
        self.open.insert(self.last, Job { outbox, id, tells, pending, values, since });
        self.last
    }

    /// Adds a pending response.
    pub(super) fn count(&mut self, job: u64) {
        if let Some(job) = self.open.get_mut(&job) {
            job.pending += 1;
        }
    }

    /// Finishes a request without pending responses.
    pub(super) fn end_idle(&mut self, job: u64) {
        if self.open.get(&job).is_some_and(|job| job.pending == 0)
            && let Some(job) = self.open.remove(&job)
        {
            job.end();
        }
    }

    /// Finishes the requests that have timed out.
    pub(super) fn end_old(&mut self) {
        let old = self.open.iter().filter(|(_, job)| job.since.elapsed() > PATIENCE);
        let old: Vec<u64> = old.map(|(id, _)| *id).collect();
        for id in old {
            if let Some(job) = self.open.remove(&id) {
                job.end();
            }
        }
    }
}

impl Job {
    fn end(mut self) {
        if self.tells {
            self.values.sort_by(|one, other| one.0.cmp(&other.0));
            self.outbox.push(protocol::parameters(&self.values, self.id.as_deref()));
        }
    }
}

impl State {
    pub(super) fn ask_for_names(&mut self, shared: &Shared, job: u64, node: &str) {
        let of = node.to_owned();
        let service = format!("{node}/list_parameters");
        self.ask(shared, job, &service, &ListParametersRequest::default(), move |cdr| {
            let listed = ListParametersResponse::decode_cdr(cdr).ok()?;
            Some(News::Names(of, listed.result.names))
        });
    }

    pub(super) fn ask_for_values(
        &mut self,
        shared: &Shared,
        job: u64,
        node: &str,
        names: Vec<String>,
    ) {
        let of = node.to_owned();
        let question = GetParametersRequest { names: names.clone() };
        self.ask(shared, job, &format!("{node}/get_parameters"), &question, move |cdr| {
            let got = GetParametersResponse::decode_cdr(cdr).ok()?;
            let values = names.iter().zip(&got.values).filter_map(|(name, value)| {
                let (value, kind) = to_json(value)?;
                Some((format!("{of}.{name}"), value, kind))
            });
            Some(News::Values(values.collect()))
        });
    }

    pub(super) fn ask_for_types(
        &mut self,
        shared: &Shared,
        job: u64,
        node: &str,
        wanted: Vec<ParameterText>,
    ) {
        let of = node.to_owned();
        let names = wanted.iter().map(|one| one.name.clone()).collect();
        let question = GetParameterTypesRequest { names };
        self.ask(shared, job, &format!("{node}/get_parameter_types"), &question, move |cdr| {
            let types = GetParameterTypesResponse::decode_cdr(cdr).ok()?;
            Some(News::Types(of, wanted, types.types.to_vec()))
        });
    }

    fn ask_to_set(
        &mut self,
        shared: &Shared,
        job: u64,
        node: &str,
        wanted: &[ParameterText],
        types: &[u8],
    ) {
        let mut parameters = Vec::new();
        for (place, one) in wanted.iter().enumerate() {
            let declared = types.get(place).copied().unwrap_or_default();
            match from_json(one.value.as_ref(), one.kind.as_deref(), declared) {
                Some(value) => parameters.push(Parameter { name: one.name.clone(), value }),
                None => {
                    let why = "the value has another type than the parameter";
                    self.tell_refused(job, node, &one.name, why);
                }
            }
        }
        let names: Vec<String> = parameters.iter().map(|one| one.name.clone()).collect();
        let (of, service) = (node.to_owned(), format!("{node}/set_parameters"));
        self.ask(shared, job, &service, &SetParametersRequest { parameters }, move |cdr| {
            let done = SetParametersResponse::decode_cdr(cdr).ok()?;
            let outcome = names.into_iter().zip(done.results).map(|(name, result)| {
                (name, if result.successful { Ok(()) } else { Err(result.reason) })
            });
            Some(News::Set(of, outcome.collect()))
        });
    }

    fn tell_refused(&self, job: u64, node: &str, name: &str, why: &str) {
        if let Some(job) = self.jobs.open.get(&job) {
            let words = format!("`{node}.{name}` was not set: {why}");
            job.outbox.push(protocol::status(StatusLevel::Error, &words, None));
        }
    }

    /// Processes the response of a node.
    pub(super) fn hear_news(&mut self, shared: &Shared, (job, news): (u64, News)) {
        match news {
            News::Names(node, names) if !names.is_empty() => {
                self.ask_for_values(shared, job, &node, names);
            }
            News::Values(values) => {
                if let Some(job) = self.jobs.open.get_mut(&job) {
                    job.values.extend(values);
                }
            }
            News::Types(node, wanted, types) => {
                self.ask_to_set(shared, job, &node, &wanted, &types);
            }
            News::Set(node, outcome) => {
                for (name, done) in &outcome {
                    if let Err(why) = done {
                        self.tell_refused(job, &node, name, why);
                    }
                }
                let names = outcome.into_iter().map(|(name, _)| name).collect();
                self.ask_for_values(shared, job, &node, names);
            }
            News::Names(..) | News::Nothing => {}
        }
        if let Some(open) = self.jobs.open.get_mut(&job) {
            open.pending -= 1;
        }
        self.jobs.end_idle(job);
    }
}
