//! Parameters of nodes as `/node.name`, accessed through the ROS 2 parameter services.

mod convert;
mod job;

use std::collections::{BTreeMap, BTreeSet};

use periplus_graph::{Mailbox, Qos};
use periplus_msgs::Message;
use periplus_msgs::rcl_interfaces::ParameterEvent;
use periplus_transport::lock;

use super::{Shared, State};
use crate::foxglove::protocol::{self, ParameterText};

use convert::{Named, to_json};
pub(super) use job::{Jobs, News};

/// Parameters that a client subscribes to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Followed {
    /// True for all parameters.
    all: bool,
    names: BTreeSet<String>,
}

impl Followed {
    fn is_empty(&self) -> bool {
        !self.all && self.names.is_empty()
    }

    fn has(&self, name: &str) -> bool {
        self.all || self.names.contains(name)
    }
}

/// Splits a name into node and parameter.
fn split(name: &str) -> Option<(String, String)> {
    let (node, parameter) = name.split_once('.')?;
    Some((node.to_owned(), parameter.to_owned()))
}

/// Groups names by node; invalid names are left out.
fn by_node<'a>(names: impl Iterator<Item = &'a String>) -> BTreeMap<String, Vec<String>> {
    let mut nodes: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (node, parameter) in names.filter_map(|name| split(name)) {
        nodes.entry(node).or_default().push(parameter);
    }
    nodes
}

impl State {
    /// A client requests values.
    pub(crate) fn get_parameters(
        &mut self,
        shared: &Shared,
        client: u64,
        names: &[String],
        id: Option<String>,
    ) {
        let Some(client) = self.clients.get(&client) else { return };
        let job = self.jobs.begin(client.outbox.clone(), id, true);
        if names.is_empty() {
            for service in self.services_of("rcl_interfaces/srv/ListParameters") {
                if let Some(node) = service.strip_suffix("/list_parameters") {
                    self.ask_for_names(shared, job, node);
                }
            }
        } else {
            for (node, names) in by_node(names.iter()) {
                self.ask_for_values(shared, job, &node, names);
            }
        }
        self.jobs.end_idle(job);
    }

    /// A client sets values.
    pub(crate) fn set_parameters(
        &mut self,
        shared: &Shared,
        client: u64,
        wanted: Vec<ParameterText>,
        id: Option<String>,
    ) {
        let Some(client) = self.clients.get(&client) else { return };
        let outbox = client.outbox.clone();
        let job = self.jobs.begin(outbox.clone(), id.clone(), id.is_some());
        let mut nodes: BTreeMap<String, Vec<ParameterText>> = BTreeMap::new();
        for one in wanted {
            match split(&one.name) {
                Some((node, name)) => {
                    nodes.entry(node).or_default().push(ParameterText { name, ..one });
                }
                None => outbox.push(protocol::status(
                    protocol::StatusLevel::Error,
                    &format!("`{}` is not a parameter name; the form is `/node.name`", one.name),
                    None,
                )),
            }
        }
        for (node, wanted) in nodes {
            self.ask_for_types(shared, job, &node, wanted);
        }
        self.jobs.end_idle(job);
    }

    /// A client subscribes to parameter updates.
    pub(crate) fn follow_parameters(&mut self, shared: &Shared, client: u64, names: Vec<String>) {
        let most = shared.settings.limits.entries;
        let Some(client) = self.clients.get_mut(&client) else { return };
        if names.is_empty() {
            client.followed.all = true;
        }
        client.followed.names.extend(names);
        while client.followed.names.len() > most {
            client.followed.names.pop_last();
        }
        if self.events.is_none() {
            self.events = shared.node.mailbox("/parameter_events", Qos::parameters()).ok();
        }
    }

    /// A client ends its subscription.
    pub(crate) fn unfollow_parameters(&mut self, client: u64, names: &[String]) {
        if let Some(client) = self.clients.get_mut(&client) {
            if names.is_empty() {
                client.followed = Followed::default();
            }
            client.followed.names.retain(|name| !names.contains(name));
        }
        self.forget_events();
    }

    /// Drops the subscription to parameter events when no client needs it.
    pub(super) fn forget_events(&mut self) {
        if self.clients.values().all(|client| client.followed.is_empty()) {
            self.events = None;
        }
    }

    /// Sends parameter events to clients and advances pending requests.
    pub(super) fn go_on_with_parameters(&mut self, shared: &Shared) {
        let events = self.events.as_ref().map(Mailbox::drain).unwrap_or_default();
        for event in events {
            self.tell_event(&event);
        }
        let news = std::mem::take(&mut *lock(&shared.news));
        for one in news {
            self.hear_news(shared, one);
        }
        self.jobs.end_old();
    }

    fn tell_event(&self, event: &ParameterEvent) {
        let changed = event.new_parameters.iter().chain(&event.changed_parameters);
        let named = |name: &str| format!("{}.{name}", event.node);
        let mut values: Vec<Named> = changed
            .filter_map(|one| {
                let (value, kind) = to_json(&one.value)?;
                Some((named(&one.name), value, kind))
            })
            .collect();
        // A deleted parameter has no value.
        let gone = event.deleted_parameters.iter();
        values.extend(gone.map(|one| (named(&one.name), serde_json::Value::Null, None)));
        for client in self.clients.values() {
            let followed = values.iter().filter(|(name, ..)| client.followed.has(name));
            let followed: Vec<Named> = followed.cloned().collect();
            if !followed.is_empty() {
                client.outbox.push(protocol::parameters(&followed, None));
            }
        }
    }

    /// Calls a node's service for a job; `read` decodes the response.
    fn ask<Q: Message>(
        &mut self,
        shared: &Shared,
        job: u64,
        service: &str,
        question: &Q,
        read: impl FnOnce(&[u8]) -> Option<News> + Send + 'static,
    ) {
        let Ok(cdr) = question.to_cdr() else { return };
        self.jobs.count(job);
        let news = shared.news.clone();
        let answered = move |answer: Result<&[u8], String>| {
            let told = answer.ok().and_then(read).unwrap_or(News::Nothing);
            lock(&news).push((job, told));
        };
        self.call(shared, service, cdr, Box::new(answered));
    }
}
