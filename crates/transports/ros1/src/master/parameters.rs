//! Parameters as a tree of dictionaries.

use std::collections::{BTreeMap, BTreeSet};

use crate::xmlrpc::XmlRpcValue;

/// The parameters, and the nodes that subscribe to changes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Parameters {
    /// Always a dictionary.
    root: XmlRpcValue,
    /// Addresses of nodes by the parameter that they follow.
    subscribers: BTreeMap<String, BTreeSet<String>>,
}

impl Default for Parameters {
    fn default() -> Self {
        Self { root: XmlRpcValue::Struct(BTreeMap::new()), subscribers: BTreeMap::new() }
    }
}

/// A notification of a change.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Change {
    pub(super) address: String,
    pub(super) key: String,
    pub(super) value: XmlRpcValue,
}

fn parts(key: &str) -> impl Iterator<Item = &str> {
    key.split('/').filter(|part| !part.is_empty())
}

impl Parameters {
    /// Value of a parameter, or of all below a namespace; `key` is a full name, `/` for all.
    pub(super) fn get(&self, key: &str) -> Option<&XmlRpcValue> {
        parts(key).try_fold(&self.root, |value, part| match value {
            XmlRpcValue::Struct(members) => members.get(part),
            _ => None,
        })
    }

    /// Sets a parameter, or a namespace to a dictionary. Values above it that are no dictionaries are replaced
    /// by one. Returns the notifications.
    pub(super) fn set(&mut self, key: &str, value: XmlRpcValue) -> Vec<Change> {
        let changes = self.changes(key, &value);
        let mut place = &mut self.root;
        for part in parts(key) {
            if !matches!(place, XmlRpcValue::Struct(_)) {
                *place = XmlRpcValue::Struct(BTreeMap::new());
            }
            let XmlRpcValue::Struct(members) = place else { return changes };
            place = members
                .entry(part.to_owned())
                .or_insert_with(|| XmlRpcValue::Struct(BTreeMap::new()));
        }
        *place = value;
        changes
    }

    /// Deletes a parameter or a namespace; none if there is none. The root cannot be deleted.
    pub(super) fn delete(&mut self, key: &str) -> Option<Vec<Change>> {
        let mut names: Vec<&str> = parts(key).collect();
        let last = names.pop()?;
        let above = names.into_iter().try_fold(&mut self.root, |value, part| match value {
            XmlRpcValue::Struct(members) => members.get_mut(part),
            _ => None,
        })?;
        let XmlRpcValue::Struct(members) = above else { return None };
        members.remove(last)?;
        Some(self.changes(key, &XmlRpcValue::Struct(BTreeMap::new())))
    }

    /// Full name of the nearest parameter that begins with the first part of `key`, from the namespace upwards.
    pub(super) fn search(&self, key: &str, namespace: &str) -> Option<String> {
        if key.starts_with('/') {
            return self.get(key).map(|_| key.to_owned());
        }
        let first = parts(key).next()?;
        let levels: Vec<&str> = parts(namespace).collect();
        (0..=levels.len()).rev().find_map(|count| {
            let above: String = levels[..count].iter().map(|level| format!("/{level}")).collect();
            self.get(&format!("{above}/{first}"))?;
            Some(format!("{above}/{key}"))
        })
    }

    /// Full names of all parameters.
    pub(super) fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        collect(&self.root, String::new(), &mut names);
        names
    }

    /// Subscribes a node to changes; returns the value, an empty dictionary if it is not set.
    pub(super) fn subscribe(&mut self, key: &str, address: &str) -> XmlRpcValue {
        let subscribers = self.subscribers.entry(key.to_owned()).or_default();
        subscribers.insert(address.to_owned());
        self.get(key).cloned().unwrap_or_else(|| XmlRpcValue::Struct(BTreeMap::new()))
    }

    /// Removes a subscription to changes; true if there was one.
    pub(super) fn unsubscribe(&mut self, key: &str, address: &str) -> bool {
        let Some(subscribers) = self.subscribers.get_mut(key) else { return false };
        let was_there = subscribers.remove(address);
        if subscribers.is_empty() {
            self.subscribers.remove(key);
        }
        was_there
    }

    /// Removes a node from all parameters.
    pub(super) fn forget(&mut self, address: &str) {
        self.subscribers.retain(|_, subscribers| {
            subscribers.remove(address);
            !subscribers.is_empty()
        });
    }

    /// Notifications for nodes that subscribe to the parameter, one above it, or one below it.
    fn changes(&self, key: &str, value: &XmlRpcValue) -> Vec<Change> {
        let mut changes = Vec::new();
        for (followed, addresses) in &self.subscribers {
            let (key, value) = if is_within(key, followed) {
                (key, Some(value))
            } else if let Some(rest) = below(followed, key) {
                let inner = parts(rest).try_fold(value, |value, part| match value {
                    XmlRpcValue::Struct(members) => members.get(part),
                    _ => None,
                });
                (followed.as_str(), inner)
            } else {
                continue;
            };
            let empty = || XmlRpcValue::Struct(BTreeMap::new());
            let value = value.cloned().unwrap_or_else(empty);
            changes.extend(addresses.iter().map(|address| Change {
                address: address.clone(),
                key: key.to_owned(),
                value: value.clone(),
            }));
        }
        changes
    }
}

/// True if `key` is `namespace` or lies below it.
fn is_within(key: &str, namespace: &str) -> bool {
    key == namespace || below(key, namespace).is_some()
}

/// Rest of the name `key` below a namespace.
fn below<'a>(key: &'a str, namespace: &str) -> Option<&'a str> {
    key.strip_prefix(namespace.trim_end_matches('/'))?.strip_prefix('/')
}

fn collect(value: &XmlRpcValue, name: String, names: &mut Vec<String>) {
    match value {
        XmlRpcValue::Struct(members) => {
            for (part, inner) in members {
                collect(inner, format!("{name}/{part}"), names);
            }
        }
        _ => names.push(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(pairs: &[(&str, i32)]) -> Parameters {
        let mut parameters = Parameters::default();
        for (key, value) in pairs {
            parameters.set(key, XmlRpcValue::Int(*value));
        }
        parameters
    }

    #[test]
    fn namespaces_are_dictionaries() {
        let mut parameters = with(&[("/a/b", 1), ("/a/c", 2), ("/d", 3)]);
        assert_eq!(parameters.names(), ["/a/b", "/a/c", "/d"]);
        assert_eq!(parameters.get("/a/c"), Some(&XmlRpcValue::Int(2)));
        let both = [("b".to_owned(), XmlRpcValue::Int(1)), ("c".to_owned(), XmlRpcValue::Int(2))];
        assert_eq!(parameters.get("/a"), Some(&XmlRpcValue::Struct(both.into())));
        assert_eq!(parameters.get("/a/b/x"), None);
        assert!(parameters.delete("/a/b").is_some());
        assert!(parameters.delete("/a/b").is_none());
        assert!(parameters.delete("/").is_none());
        assert_eq!(parameters.names(), ["/a/c", "/d"]);
    }

    #[test]
    fn a_search_goes_upwards() {
        let parameters = with(&[("/robot/lidar/rate", 1), ("/rate", 2)]);
        let search = |key, namespace| parameters.search(key, namespace);
        assert_eq!(search("rate", "/robot/lidar").as_deref(), Some("/robot/lidar/rate"));
        assert_eq!(search("rate", "/robot/camera").as_deref(), Some("/rate"));
        assert_eq!(search("lidar/offset", "/robot").as_deref(), Some("/robot/lidar/offset"));
        assert_eq!(search("depth", "/robot"), None);
        assert_eq!(search("/rate", "/robot").as_deref(), Some("/rate"));
    }

    #[test]
    fn who_follows_a_parameter_hears_of_it_from_above_and_below() {
        let mut parameters = Parameters::default();
        assert_eq!(parameters.subscribe("/a", "http://x:1/"), XmlRpcValue::Struct(BTreeMap::new()));
        parameters.subscribe("/a/b", "http://y:2/");
        let heard = |changes: Vec<Change>| -> Vec<(String, String, XmlRpcValue)> {
            changes.into_iter().map(|one| (one.address, one.key, one.value)).collect()
        };
        let (x, y) = ("http://x:1/".to_owned(), "http://y:2/".to_owned());
        let (a, b) = ("/a".to_owned(), "/a/b".to_owned());
        let one = XmlRpcValue::Int(1);
        assert_eq!(
            heard(parameters.set("/a/b", one.clone())),
            [(x.clone(), b.clone(), one.clone()), (y.clone(), b.clone(), one.clone())]
        );
        let all = XmlRpcValue::Struct([("b".to_owned(), one.clone())].into());
        assert_eq!(
            heard(parameters.set("/a", all.clone())),
            [(x.clone(), a, all), (y.clone(), b, one)]
        );
        assert!(heard(parameters.set("/ab", XmlRpcValue::Int(2))).is_empty());
        assert!(parameters.unsubscribe("/a", &x));
        assert!(!parameters.unsubscribe("/a", &x));
        parameters.forget(&y);
        assert!(heard(parameters.set("/a/b", XmlRpcValue::Int(3))).is_empty());
    }
}
