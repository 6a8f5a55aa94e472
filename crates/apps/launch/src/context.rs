//! What holds at a place in a launch file: configurations, environment, and what all nodes get.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_resources::Host;
use serde::{Deserialize, Serialize};

use crate::dialect::Dialect;
use crate::plan::{Parameters, Variable};
use crate::tree::Names;

/// Everything that a scoped group restores at its end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Context {
    pub(crate) configurations: Names,
    /// Variables that differ from the machine's; none for one that is taken away.
    pub(crate) environment: BTreeMap<String, Option<String>>,
    /// Places of the changes of the environment, as `file:line`, by variable.
    pub(crate) changed_at: BTreeMap<String, String>,
    /// Variables that a machine with ROS has, for machines without them.
    pub(crate) usual: Names,
    /// `name:=value` of the command line.
    pub(crate) command_line: Vec<String>,
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
            None => host.variable(name).or_else(|| self.usual.get(name).cloned()),
        }
    }

    /// The changes of the environment, for a step.
    pub(crate) fn changes(&self) -> BTreeMap<String, Variable> {
        let change = |(name, value): (&String, &Option<String>)| {
            let written = self.changed_at.get(name).cloned();
            (name.clone(), Variable { value: value.clone(), written })
        };
        self.environment.iter().map(change).collect()
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
            defaults: self.usual.clone(),
            argv: self.command_line.clone(),
            file: self.file.display().to_string(),
            namespace: self.namespace.clone(),
        }
    }
}

/// Variables that a machine with ROS has. `AMENT_PREFIX_PATH` names the folder where the workspace of the
/// file would be installed.
pub(crate) fn usual(dialect: Dialect, file: &Path) -> Names {
    let (version, distribution) = match dialect {
        Dialect::Ros1 => ("1", "noetic"),
        Dialect::Ros2 => ("2", "jazzy"),
    };
    let mut usual = Names::from([
        ("ROS_VERSION".into(), version.into()),
        ("ROS_DISTRO".into(), distribution.into()),
        ("ROS_PYTHON_VERSION".into(), "3".into()),
    ]);
    if dialect == Dialect::Ros2 {
        let sources = file.ancestors().skip(1).find(|up| up.ends_with("src"));
        let above = sources.or_else(|| file.ancestors().nth(3)).and_then(Path::parent);
        let install = above.unwrap_or_else(|| Path::new("/")).join("install");
        usual.insert("AMENT_PREFIX_PATH".into(), install.display().to_string());
    }
    // Gazebo's setup files set these, and launch files add to them.
    for name in [
        "GZ_SIM_RESOURCE_PATH",
        "IGN_GAZEBO_RESOURCE_PATH",
        "GAZEBO_MODEL_PATH",
        "GAZEBO_RESOURCE_PATH",
        "GAZEBO_PLUGIN_PATH",
    ] {
        usual.insert(name.into(), String::new());
    }
    usual
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
    defaults: Names,
    #[serde(default)]
    argv: Vec<String>,
    #[serde(default)]
    pub(crate) file: String,
    #[serde(default)]
    pub(crate) namespace: String,
}
