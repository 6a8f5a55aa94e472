//! A service with its server and clients.

use std::sync::Arc;

use super::TypeOf;
use crate::GraphError;
use crate::info::ServiceInfo;
use crate::sample::EndpointId;
use crate::service::Server;

/// A service and its endpoints.
pub(crate) struct ServiceEntry {
    pub(super) type_of: TypeOf,
    pub(super) type_from: Arc<str>,
    pub(crate) server: Option<Arc<Server>>,
    pub(super) clients: Vec<(EndpointId, Arc<str>)>,
}

impl ServiceEntry {
    pub(super) fn is_used(&self) -> bool {
        self.server.is_some() || !self.clients.is_empty()
    }

    /// True if the node is its server or a client.
    pub(super) fn is_of(&self, node: &str) -> bool {
        let mut clients = self.clients.iter();
        self.server.as_ref().is_some_and(|server| *server.node == *node)
            || clients.any(|(_, client)| **client == *node)
    }

    pub(crate) fn set_server(&mut self, server: Arc<Server>) -> Result<(), GraphError> {
        if let Some(other) = &self.server {
            return Err(GraphError::ServerExists {
                service: server.name.to_string(),
                node: other.node.to_string(),
                asked: server.node.to_string(),
            });
        }
        self.server = Some(server);
        Ok(())
    }

    pub(crate) fn add_client(&mut self, id: EndpointId, node: Arc<str>) {
        self.clients.push((id, node));
    }

    pub(crate) fn remove_client(&mut self, id: EndpointId) {
        self.clients.retain(|(other, _)| *other != id);
    }

    pub(super) fn info(&self, name: &str) -> ServiceInfo {
        let mut clients: Vec<String> =
            self.clients.iter().map(|(_, node)| node.to_string()).collect();
        clients.sort();
        clients.dedup();
        ServiceInfo {
            name: name.to_owned(),
            type_name: self.type_of.name.clone(),
            type_hash: self.type_of.hash.clone(),
            server: self.server.as_ref().map(|server| server.node.to_string()),
            clients,
        }
    }
}
