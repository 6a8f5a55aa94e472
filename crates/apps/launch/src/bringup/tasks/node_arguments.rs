//! Arguments of a node that runs in a process: names, remappings and parameters.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use serde_json::{Map, Value, json};

use crate::bringup::parameters::parameter;
use crate::bringup::parts::Program;
use crate::bringup::python::ros1_names;
use crate::{Dialect, PlanParameters};
use periplus_os::Machine;
use periplus_resources::Store as _;

/// Environment variable of ROS 1 with the namespace of a node.
const NAMESPACE_VARIABLE: &str = "ROS_NAMESPACE";

/// Environment variable with a JSON file of the ROS 1 parameter server: values by full name.
const SERVER_VARIABLE: &str = "PERIPLUS_ROS1_PARAMETERS";

/// Number of files of this process.
static FILES: AtomicU32 = AtomicU32::new(0);

/// Arguments of a node. Its files are removed on drop.
#[derive(Debug, Default)]
pub(super) struct NodeArguments {
    pub(super) words: Vec<String>,
    pub(super) variables: Vec<(String, String)>,
    files: Vec<PathBuf>,
}

impl Drop for NodeArguments {
    fn drop(&mut self) {
        for file in &self.files {
            let _ = std::fs::remove_file(file);
        }
    }
}

impl NodeArguments {
    fn write(&mut self, content: &Value) -> Result<&Path, String> {
        let number = FILES.fetch_add(1, Ordering::Relaxed);
        let name = format!("periplus_parameters_{}_{number}.yaml", std::process::id());
        let path = std::env::temp_dir().join(name);
        // JSON is valid YAML.
        let text = content.to_string();
        Machine.replace(&path, text.as_bytes()).map_err(|error| {
            format!("its parameters cannot be written to {}: {error}", path.display())
        })?;
        self.files.push(path);
        Ok(self.files.last().map_or(Path::new(""), PathBuf::as_path))
    }
}

/// Arguments of a node, after its own.
///
/// # Errors
/// When its parameters cannot be written to a file.
pub(super) fn node_arguments(program: &Program, dialect: Dialect) -> Result<NodeArguments, String> {
    match dialect {
        Dialect::Ros1 => of_ros1(program),
        Dialect::Ros2 => of_ros2(program),
    }
}

fn of_ros2(program: &Program) -> Result<NodeArguments, String> {
    let identity = &program.identity;
    let mut arguments = NodeArguments::default();
    let mut words = vec!["--ros-args".to_owned()];
    // `--autostart` is a request to the launch, not to the node.
    let own = program.ros_arguments.iter();
    words
        .extend(own.filter(|word| !matches!(word.as_str(), "--ros-args" | "--autostart")).cloned());
    let mut add = |flag: &str, word: String| words.extend([flag.to_owned(), word]);
    if let Some(name) = &identity.name {
        add("-r", format!("__node:={name}"));
    }
    if let Some(namespace) = &identity.namespace {
        add("-r", format!("__ns:={namespace}"));
    }
    for (from, to) in &identity.remaps {
        add("-r", format!("{from}:={to}"));
    }
    for parameters in &identity.parameters {
        match parameters {
            PlanParameters::File(file) => add("--params-file", file.clone()),
            PlanParameters::Values(values) => {
                let file = arguments.write(&parameter_file(program, values))?;
                add("--params-file", file.display().to_string());
            }
        }
    }
    arguments.words = words;
    Ok(arguments)
}

/// Content of a parameter file. As with `launch_ros`, it is for the node only if both its name and its
/// namespace are given, and otherwise for all nodes of the process.
fn parameter_file(program: &Program, values: &BTreeMap<String, Value>) -> Value {
    let values: Map<String, Value> = values
        .iter()
        .filter(|(_, value)| parameter(value).is_some())
        .map(|(name, value)| (name.clone(), value.clone()))
        .collect();
    let node = match (&program.identity.namespace, &program.identity.name) {
        (Some(namespace), Some(name)) => format!("{}/{name}", namespace.trim_end_matches('/')),
        _ => "/**".to_owned(),
    };
    json!({ node: { "ros__parameters": values } })
}

fn of_ros1(program: &Program) -> Result<NodeArguments, String> {
    let identity = &program.identity;
    let namespace = identity.namespace.as_deref().unwrap_or("/");
    let name = identity.name.as_deref().unwrap_or_default();
    let own = format!("{}/{name}", namespace.trim_end_matches('/'));
    let mut server: Map<String, Value> =
        program.server.iter().map(|(name, value)| (name.clone(), value.clone())).collect();
    for parameters in &identity.parameters {
        let PlanParameters::Values(values) = parameters else { continue };
        for (name, value) in values {
            server.insert(format!("{own}/{}", name.replace('.', "/")), value.clone());
        }
    }
    let mut arguments = NodeArguments::default();
    let file = arguments.write(&Value::Object(server))?.display().to_string();
    arguments.words = ros1_names(identity.name.as_deref(), &identity.remaps);
    arguments.variables = vec![
        (NAMESPACE_VARIABLE.to_owned(), namespace.to_owned()),
        (SERVER_VARIABLE.to_owned(), file),
    ];
    Ok(arguments)
}
