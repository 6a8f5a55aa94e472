//! Publishers, subscribers and servers.

use std::collections::BTreeMap;

/// Nodes of one kind by topic or service, in the order of their registration.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Registrations(BTreeMap<String, Vec<Registration>>);

/// A node at a topic or service.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Registration {
    /// Name of the node.
    pub(super) node: String,
    /// Address of the node, or of the service.
    pub(super) address: String,
}

impl Registrations {
    /// Adds a node, or changes its address.
    pub(super) fn add(&mut self, key: &str, node: &str, address: &str) {
        let all = self.0.entry(key.to_owned()).or_default();
        match all.iter_mut().find(|one| one.node == node) {
            Some(one) => address.clone_into(&mut one.address),
            None => all.push(Registration { node: node.to_owned(), address: address.to_owned() }),
        }
    }

    /// In place of all others, as a service has one server.
    pub(super) fn replace(&mut self, key: &str, node: &str, address: &str) {
        self.0.remove(key);
        self.add(key, node, address);
    }

    /// Removes a node whose address is this; true if there was one.
    pub(super) fn remove(&mut self, key: &str, node: &str, address: &str) -> bool {
        let Some(all) = self.0.get_mut(key) else { return false };
        let before = all.len();
        all.retain(|one| one.node != node || one.address != address);
        let is_removed = all.len() < before;
        if all.is_empty() {
            self.0.remove(key);
        }
        is_removed
    }

    /// Removes a node everywhere; returns where it was.
    pub(super) fn forget(&mut self, node: &str) -> Vec<String> {
        let mut gone = Vec::new();
        self.0.retain(|key, all| {
            let before = all.len();
            all.retain(|one| one.node != node);
            if all.len() < before {
                gone.push(key.clone());
            }
            !all.is_empty()
        });
        gone
    }

    pub(super) fn at(&self, key: &str) -> &[Registration] {
        self.0.get(key).map_or(&[], Vec::as_slice)
    }

    /// Addresses at a topic or service.
    pub(super) fn addresses(&self, key: &str) -> Vec<String> {
        self.at(key).iter().map(|one| one.address.clone()).collect()
    }

    pub(super) fn has_node(&self, node: &str) -> bool {
        self.0.values().flatten().any(|one| one.node == node)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (&str, &[Registration])> {
        self.0.iter().map(|(key, all)| (key.as_str(), all.as_slice()))
    }
}
