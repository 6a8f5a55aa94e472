//! What holds at a place in a launch file: configurations, environment, and what all nodes get.

use std::collections::BTreeMap;
use std::path::PathBuf;

use periplus_resources::Host;
use serde::{Deserialize, Serialize};

use crate::plan::Parameters;
use crate::tree::Names;

/// Everything that a scoped group restores at its end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Context {
    pub(crate) configurations: Names,
    /// Variables that differ from the machine's; none for one that is taken away.
    pub(crate) environment: BTreeMap<String, Option<String>>,
    /// The namespace of nodes, absolute; empty when none was pushed.
    pub(crate) namespace: String,
    pub(crate) parameters: Vec<Parameters>,
    pub(crate) remaps: Vec<(String, String)>,
    /// The file that is being launched.
    pub(crate) file: PathBuf,
}

impl Context {
    /// A variable of the environment as programs will see it.
    pub(crate) fn variable(&self, name: &str, host: &dyn Host) -> Option<String> {
        match self.environment.get(name) {
            Some(changed) => changed.clone(),
            None => host.variable(name),
        }
    }

    /// A namespace or name within the pushed namespace, absolute.
    pub(crate) fn within(&self, name: &str) -> String {
        within(&self.namespace, name)
    }

    /// As an interpreter is told.
    pub(crate) fn snapshot(&self) -> Snapshot {
        Snapshot {
            configurations: self.configurations.clone(),
            environment: self.environment.clone(),
            file: self.file.display().to_string(),
            namespace: self.namespace.clone(),
        }
    }
}

/// A name in a namespace, absolute. One that is absolute already stays as it is.
pub(crate) fn within(namespace: &str, name: &str) -> String {
    if name.starts_with('/') {
        return name.into();
    }
    let namespace = namespace.trim_end_matches('/');
    match name {
        "" if namespace.is_empty() => "/".into(),
        "" => namespace.into(),
        _ => format!("{namespace}/{name}"),
    }
}

/// The part of a context that the functions of a launch file see.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Snapshot {
    pub(crate) configurations: Names,
    #[serde(default)]
    pub(crate) environment: BTreeMap<String, Option<String>>,
    #[serde(default)]
    pub(crate) file: String,
    #[serde(default)]
    pub(crate) namespace: String,
}
