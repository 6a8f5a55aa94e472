//! Services.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_graph::RawClient;

use super::{Shared, State};
use crate::foxglove::protocol::{self, ServiceText};

/// An advertised service.
pub(super) struct Offered {
    id: u32,
    type_name: String,
    type_hash: Option<String>,
    /// True if the server is remote.
    is_remote: bool,
    /// Created by the first call.
    client: Option<Arc<RawClient>>,
}

/// A service found under a name.
struct Found {
    type_name: String,
    type_hash: Option<String>,
    is_remote: bool,
}

impl State {
    /// All services in the form in which they are announced.
    pub(super) fn service_texts(&self) -> Vec<ServiceText<'_>> {
        let services = self.services.iter();
        services
            .map(|(name, one)| ServiceText { id: one.id, name, type_name: &one.type_name })
            .collect()
    }

    /// Names of all services of a type.
    pub(super) fn services_of(&self, type_name: &str) -> Vec<String> {
        let services = self.services.iter().filter(|(_, one)| one.type_name == type_name);
        services.map(|(name, _)| name.clone()).collect()
    }

    /// Updates services from the graph and the remote endpoints.
    pub(super) fn look_at_services(&mut self, shared: &Shared) {
        let served = self.found_services(shared);
        let mut gone = Vec::new();
        self.services.retain(|name, one| {
            let found = served.get(name);
            let stays = found.is_some_and(|found| found.type_name == one.type_name);
            if !stays {
                gone.push(one.id);
            }
            stays
        });
        if !gone.is_empty() {
            self.tell_all(&protocol::unadvertise_services(&gone));
        }
        let mut new = Vec::new();
        for (name, Found { type_name, type_hash, is_remote }) in served {
            if let Some(known) = self.services.get_mut(&name) {
                known.is_remote = is_remote;
                continue;
            }
            let id = self.number();
            new.push(id);
            self.services
                .insert(name, Offered { id, type_name, type_hash, is_remote, client: None });
        }
        if !new.is_empty() {
            let mut texts = self.service_texts();
            texts.retain(|one| new.contains(&one.id));
            let frame = protocol::advertise_services(&texts);
            self.tell_all(&frame);
        }
    }

    fn found_services(&self, shared: &Shared) -> BTreeMap<String, Found> {
        let network = self.network.services.iter().map(|one| {
            let type_name = one.type_name.clone();
            (one.name.clone(), Found { type_name, type_hash: None, is_remote: true })
        });
        let mut found: BTreeMap<String, Found> = network.collect();
        for one in shared.graph.services() {
            let Some(server) = one.server else { continue };
            // A service that a transport represents belongs to its remote server.
            let is_remote = server.starts_with("/_wire") && found.contains_key(&one.name);
            let own = Found { type_name: one.type_name, type_hash: one.type_hash, is_remote };
            found.insert(one.name, own);
        }
        found
    }

    /// True if the server is remote.
    pub(super) fn is_remote(&self, name: &str) -> bool {
        self.services.get(name).is_some_and(|one| one.is_remote)
    }

    /// Name of a service.
    pub(crate) fn service(&self, id: u32) -> Option<String> {
        self.services.iter().find(|(_, one)| one.id == id).map(|(name, _)| name.clone())
    }

    /// Returns the client of a service.
    pub(super) fn client_of(
        &mut self,
        shared: &Shared,
        name: &str,
    ) -> Result<Arc<RawClient>, String> {
        let Some(one) = self.services.get_mut(name) else {
            return Err(format!("no server for the service `{name}`"));
        };
        if let Some(client) = &one.client {
            return Ok(client.clone());
        }
        let client = shared.node.raw_client(name, &one.type_name, one.type_hash.as_deref());
        let client = Arc::new(client.map_err(|error| error.to_string())?);
        one.client = Some(client.clone());
        Ok(client)
    }
}
