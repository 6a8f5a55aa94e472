//! Launch plan: plain data, with all conditions and substitutions evaluated.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

/// Evaluated launch file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct LaunchPlan {
    /// Arguments of the file and of included files, in order of appearance.
    pub arguments: Vec<Argument>,
    /// Parameters of the ROS 1 parameter server by full name, without those of nodes.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, Value>,
    /// Steps, in the order of the files.
    pub steps: Vec<PlanStep>,
}

/// Argument of a launch file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Argument {
    /// Name, as in `name:=value`.
    pub name: String,
    /// Description.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Default value; the argument is required if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub default: Option<String>,
    /// Allowed values; any if empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<String>,
    /// Value used for this plan, if evaluated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
}

/// One step of a plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlanStep {
    /// Index in the plan, by which others refer to it.
    pub id: usize,
    /// Triggers that must have occurred before, one after another; empty for immediate steps.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub after: Vec<Trigger>,
    /// Action of the step.
    #[serde(flatten)]
    pub what: What,
    /// Position in the launch file: `file:line`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<String>,
    /// Environment variables that the launch file changed before this step, with the position of
    /// each change. Scoped groups restore theirs at their end.
    #[serde(rename = "launch_environment", skip_serializing_if = "BTreeMap::is_empty")]
    pub environment: BTreeMap<String, PlanVariable>,
}

/// Environment variable changed by a launch file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PlanVariable {
    /// Value; `None` if unset.
    pub value: Option<String>,
    /// Position of the change: `file:line`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<String>,
}

/// Trigger of a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Trigger {
    /// Time elapsed.
    Seconds(f64),
    /// A step was started; any if `None`.
    Started(Option<usize>),
    /// A step has ended; any if `None`.
    Ended(Option<usize>),
    /// A step has printed output.
    Printed(Option<usize>),
    /// A lifecycle node made a transition.
    Reached {
        /// Step of the node; any if `None`.
        step: Option<usize>,
        /// Start state, if specified.
        from: Option<String>,
        /// Goal state.
        to: Option<String>,
    },
    /// Shutdown begins.
    Shutdown,
}

/// Action of a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum What {
    /// Start a node.
    Node(Box<PlanNode>),
    /// Load components into a container.
    Load {
        /// Full name of the container.
        container: String,
        /// Components.
        components: Vec<Component>,
    },
    /// Start a process that is not a node.
    Process(Process),
    /// Request a transition of a lifecycle node.
    Transition {
        /// Node; all if `None`.
        step: Option<usize>,
        /// `configure`, `activate`, ...
        transition: String,
    },
    /// Log a message.
    Log {
        /// `info`, `warning`, ...
        level: String,
        /// Text.
        text: String,
    },
    /// Launch file of a package that cannot be found. The runner may have a replacement.
    Include {
        /// File; of a missing package `package://NAME/...`.
        file: String,
        /// Arguments.
        arguments: BTreeMap<String, String>,
    },
    /// Shut down.
    Shutdown {
        /// Reason.
        reason: String,
    },
}

/// Node to start.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PlanNode {
    /// Package of the program; `None` for a program given by its path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub package: Option<String>,
    /// Program.
    pub executable: String,
    /// Name, namespace, parameters and remappings.
    #[serde(flatten)]
    pub identity: Identity,
    /// Arguments of the program.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub arguments: Vec<String>,
    /// Arguments after `--ros-args` other than names and parameters.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ros_arguments: Vec<String>,
    /// True for a lifecycle node.
    #[serde(skip_serializing_if = "is_false")]
    pub is_lifecycle: bool,
    /// Components of a container, loaded at start.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub components: Vec<Component>,
    /// Process settings.
    #[serde(flatten)]
    pub running: Running,
}

/// Name, namespace, parameters and remappings of a node.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Identity {
    /// Node name; the default of the program if `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Absolute namespace; the default of the program if `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub namespace: Option<String>,
    /// Parameters; later ones override earlier ones.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<PlanParameters>,
    /// Remappings: from, to.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remaps: Vec<(String, String)>,
}

/// Component of a container.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Component {
    /// Package.
    pub package: String,
    /// Class, such as `nav2_amcl::AmclNode`.
    pub plugin: String,
    /// Name, namespace, parameters and remappings.
    #[serde(flatten)]
    pub identity: Identity,
}

/// Process that is not a node.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Process {
    /// Words of the command; a single text if run through a shell.
    pub command: Vec<String>,
    /// True to run the command through a shell.
    #[serde(skip_serializing_if = "is_false")]
    pub is_shell: bool,
    /// Name for messages.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Process settings.
    #[serde(flatten)]
    pub running: Running,
}

/// Settings of a process.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Running {
    /// Prefix of the command: `gdb -ex run --args`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prefix: Option<String>,
    /// Working folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub folder: Option<String>,
    /// Environment variables that differ from those of the launch; null for an unset one.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub environment: BTreeMap<String, Option<String>>,
    /// True if the process gets the variables of `environment` only, without those of the launch:
    /// `env=` of `ExecuteProcess`.
    #[serde(skip_serializing_if = "is_false")]
    pub replaces_environment: bool,
    /// Output destination: `screen`, `log`, `both`, ...
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
    /// Delay before a respawn [s]; `None` for no respawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub respawn_after_s: Option<f64>,
    /// True if its end shuts the launch down.
    #[serde(skip_serializing_if = "is_false")]
    pub is_required: bool,
}

/// Parameters of a node.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PlanParameters {
    /// Values by name; members of groups are joined with dots.
    Values(BTreeMap<String, Value>),
    /// File in the format of `ros2 param dump`.
    File(String),
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "required by serde")]
fn is_false(value: &bool) -> bool {
    !value
}
