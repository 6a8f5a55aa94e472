//! Services.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_graph::RawClient;

use super::{Shared, State};
use crate::protocol::{self, ServiceText};

/// A service that somebody answers.
pub(super) struct Offered {
    id: u32,
    type_name: String,
    type_hash: Option<String>,
    /// Made with the first call.
    client: Option<Arc<RawClient>>,
}

impl State {
    /// All services, as they are announced.
    pub(super) fn service_texts(&self) -> Vec<ServiceText<'_>> {
        self.services
            .iter()
            .map(|(name, one)| ServiceText { id: one.id, name, type_name: &one.type_name })
            .collect()
    }

    /// Services as the graph has them.
    pub(super) fn look_at_services(&mut self, shared: &Shared) {
        let served = shared.graph.services();
        let served: BTreeMap<String, (String, Option<String>)> = served
            .into_iter()
            .filter(|service| service.server.is_some())
            .map(|service| (service.name, (service.type_name, service.type_hash)))
            .collect();
        let mut gone = Vec::new();
        self.services.retain(|name, one| {
            let stays = served.get(name).is_some_and(|(type_name, _)| *type_name == one.type_name);
            if !stays {
                gone.push(one.id);
            }
            stays
        });
        if !gone.is_empty() {
            self.tell_all(&protocol::unadvertise_services(&gone));
        }
        let mut new = Vec::new();
        for (name, (type_name, type_hash)) in served {
            if !self.services.contains_key(&name) {
                let id = self.number();
                new.push(name.clone());
                self.services.insert(name, Offered { id, type_name, type_hash, client: None });
            }
        }
        if !new.is_empty() {
            let texts: Vec<ServiceText<'_>> = self
                .service_texts()
                .into_iter()
                .filter(|one| new.iter().any(|n| n == one.name))
                .collect();
            self.tell_all(&protocol::advertise_services(&texts));
        }
    }

    /// What calls a service.
    ///
    /// # Errors
    /// Why nobody can.
    pub(crate) fn caller(&mut self, shared: &Shared, id: u32) -> Result<Arc<RawClient>, String> {
        let mut services = self.services.iter_mut();
        let Some((name, one)) = services.find(|(_, one)| one.id == id) else {
            return Err(format!("there is no service {id}"));
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
