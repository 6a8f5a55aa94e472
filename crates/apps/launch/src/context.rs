//! Scope of a position in a launch file: configurations, environment, and settings of all nodes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_resources::Host;
use serde::{Deserialize, Serialize};

use crate::dialect::Dialect;
use crate::plan::{PlanParameters, PlanVariable};
use crate::tree::Names;

/// State that a scoped group restores at its end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Context {
    pub(crate) configurations: Names,
    /// Variables changed by the launch; `None` for an unset one.
    pub(crate) environment: BTreeMap<String, Option<String>>,
    /// Position of the change of each variable, as `file:line`.
    pub(crate) changed_at: BTreeMap<String, String>,
    /// Variables that a ROS installation sets, for machines without one.
    pub(crate) usual: Names,
    /// `name:=value` of the command line.
    pub(crate) command_line: Vec<String>,
    /// Absolute namespace of nodes; empty if none was pushed.
    pub(crate) namespace: String,
    pub(crate) parameters: Vec<PlanParameters>,
    pub(crate) remaps: Vec<(String, String)>,
    /// Current launch file.
    pub(crate) file: PathBuf,
}

impl Context {
    /// Environment variable as programs will see it.
    pub(crate) fn variable(&self, name: &str, host: &dyn Host) -> Option<String> {
        match self.environment.get(name) {
            Some(changed) => changed.clone(),
            None => host.variable(name).or_else(|| self.usual.get(name).cloned()),
        }
    }

    /// Changes of the environment, for a step.
    pub(crate) fn changes(&self) -> BTreeMap<String, PlanVariable> {
        let change = |(name, value): (&String, &Option<String>)| {
            let written = self.changed_at.get(name).cloned();
            (name.clone(), PlanVariable { value: value.clone(), written })
        };
        self.environment.iter().map(change).collect()
    }

    /// Absolute name or namespace, resolved in the pushed namespace.
    pub(crate) fn within(&self, name: &str) -> String {
        within(&self.namespace, name)
    }

    /// State that is passed to an interpreter.
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

/// Variables that a ROS installation sets. `AMENT_PREFIX_PATH` contains the install folder of the
/// file's workspace.
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
    // Gazebo's setup files set these, and launch files append to them.
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

/// Resolves a name in a namespace; absolute names stay as they are.
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

/// Part of a context that functions of a launch file can read.
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
