//! What is to run: plain data, with every condition decided and every text resolved.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

/// Everything that a launch file asks for.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Plan {
    /// The arguments that the file and those included by it take, in order of appearance.
    pub arguments: Vec<Argument>,
    /// Parameters of no node's own, by full name: those of ROS 1's parameter server.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, Value>,
    /// What happens, in the order in which the files say it.
    pub steps: Vec<Step>,
}

/// An argument of a launch file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Argument {
    /// Its name, as in `name:=value`.
    pub name: String,
    /// What it is for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Its value when none is given; without one it must be given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub default: Option<String>,
    /// The values it may have; any when empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<String>,
    /// The value that this plan was made with, if the file was evaluated so far.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
}

/// One thing that happens.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Its number in the plan, by which others refer to it.
    pub id: usize,
    /// What must have happened before, one after the other; nothing for what happens at once.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub after: Vec<Trigger>,
    /// What happens.
    #[serde(flatten)]
    pub what: What,
    /// Where it is written: `file:line`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<String>,
    /// Variables of the environment that the launch file has changed before this step, with the place of
    /// each change. Scoped groups undo theirs at their end.
    #[serde(rename = "launch_environment", skip_serializing_if = "BTreeMap::is_empty")]
    pub environment: BTreeMap<String, Variable>,
}

/// A variable of the environment as a launch file has changed it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Variable {
    /// Its value; none for one that was unset.
    pub value: Option<String>,
    /// Place of the change: `file:line`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<String>,
}

/// What a step waits for.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Trigger {
    /// Time goes by.
    Seconds(f64),
    /// A step has been started; any when it names none.
    Started(Option<usize>),
    /// A step has ended; any when it names none.
    Ended(Option<usize>),
    /// A step has printed something.
    Printed(Option<usize>),
    /// A managed node has gone from a state to another.
    Reached {
        /// Which; any when it names none.
        step: Option<usize>,
        /// From where, if that matters.
        from: Option<String>,
        /// To where.
        to: Option<String>,
    },
    /// Everything is about to end.
    Shutdown,
}

/// What happens in a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum What {
    /// A node is started.
    Node(Box<Node>),
    /// Components are loaded into a container.
    Load {
        /// The full name of the container.
        container: String,
        /// The components.
        components: Vec<Component>,
    },
    /// A program that is no node is started.
    Process(Process),
    /// A managed node is asked for a transition.
    Transition {
        /// Which one; all when it names none.
        step: Option<usize>,
        /// `configure`, `activate`, ...
        transition: String,
    },
    /// Something is said.
    Log {
        /// `info`, `warning`, ...
        level: String,
        /// What.
        text: String,
    },
    /// A launch file that is in no package that can be found. What runs instead of it is for those to
    /// say who know the package.
    Include {
        /// The file; one of a package that is not here is `package://NAME/...`.
        file: String,
        /// What it is given.
        arguments: BTreeMap<String, String>,
    },
    /// Everything ends.
    Shutdown {
        /// Why.
        reason: String,
    },
}

/// A node to start.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Node {
    /// The package of the program; none for a program that is named by its path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub package: Option<String>,
    /// The program.
    pub executable: String,
    /// What it is called, and what it is given.
    #[serde(flatten)]
    pub identity: Identity,
    /// The program's arguments.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub arguments: Vec<String>,
    /// What stands behind `--ros-args` beside names and parameters.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ros_arguments: Vec<String>,
    /// Whether its life is managed (`lifecycle_msgs`).
    #[serde(skip_serializing_if = "is_false")]
    pub is_lifecycle: bool,
    /// For a container, what is loaded into it at once.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub components: Vec<Component>,
    /// How the program runs.
    #[serde(flatten)]
    pub running: Running,
}

/// What a node is called, and what it is given.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Identity {
    /// The name it is given; its own when none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The namespace, absolute; none when its own holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub namespace: Option<String>,
    /// Parameters, later ones over earlier ones.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<Parameters>,
    /// Names that are replaced: from, to.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remaps: Vec<(String, String)>,
}

/// A component that is loaded into a container.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Component {
    /// The package.
    pub package: String,
    /// The class: `nav2_amcl::AmclNode`.
    pub plugin: String,
    /// What it is called, and what it is given.
    #[serde(flatten)]
    pub identity: Identity,
}

/// A program that is no node.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Process {
    /// Its words; through a shell it is one text.
    pub command: Vec<String>,
    /// Whether a shell reads the command.
    #[serde(skip_serializing_if = "is_false")]
    pub is_shell: bool,
    /// A name for messages.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// How it runs.
    #[serde(flatten)]
    pub running: Running,
}

/// How a program runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Running {
    /// Words before the program: `gdb -ex run --args`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prefix: Option<String>,
    /// The folder it runs in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub folder: Option<String>,
    /// Variables of the environment that differ from the launch's own; null for one that is taken away.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub environment: BTreeMap<String, Option<String>>,
    /// True if the program gets the variables of `environment` alone, and none of the launch's own: `env=`
    /// of `ExecuteProcess`.
    #[serde(skip_serializing_if = "is_false")]
    pub replaces_environment: bool,
    /// Where its output goes: `screen`, `log`, `both`, ...
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
    /// Whether it is started again when it ends, and after how many seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub respawn_after_s: Option<f64>,
    /// Whether everything ends with it.
    #[serde(skip_serializing_if = "is_false")]
    pub is_required: bool,
}

/// Parameters as they are given to a node.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameters {
    /// Values by name; members of groups are joined with dots.
    Values(BTreeMap<String, Value>),
    /// A file of `ros2 param dump`'s form.
    File(String),
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde asks it")]
fn is_false(value: &bool) -> bool {
    !value
}
