//! Syntax tree of ROS 2 launch files. XML, YAML and Python are converted to it.

use std::collections::BTreeMap;

use periplus_diagnostics::Span;
use serde::Deserialize;
use serde_json::Value;

/// Text in parts that are resolved one by one and joined.
pub(crate) type Text = Vec<Part>;

/// Position in a source.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Place {
    /// Span in a file that was parsed here.
    pub(crate) span: Option<Span>,
    /// `file:line` of a file that Python evaluated.
    pub(crate) line: Option<String>,
}

impl<'de> Deserialize<'de> for Place {
    fn deserialize<D: serde::Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        Ok(Self { span: None, line: Option::<String>::deserialize(reader)? })
    }
}

impl From<Span> for Place {
    fn from(span: Span) -> Self {
        Self { span: Some(span), line: None }
    }
}

/// Part of a text.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Part {
    /// Literal text.
    Plain(String),
    /// Substitution.
    Substitution(Box<Substitution>),
}

/// Substitution, resolved when needed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "sub", rename_all = "snake_case")]
pub(crate) enum Substitution {
    /// Value of an argument or configuration.
    Configuration {
        name: Text,
        default: Option<Text>,
    },
    /// Environment variable.
    Environment {
        name: Text,
        default: Option<Text>,
    },
    /// Concatenated texts.
    Join {
        parts: Vec<Text>,
        separator: Option<Text>,
    },
    /// Path joined from parts.
    Path {
        parts: Vec<Text>,
    },
    /// `share/NAME` of a package, or its prefix.
    Package {
        name: Text,
        #[serde(default)]
        is_prefix: bool,
    },
    /// Output of a program.
    Command {
        command: Text,
        on_stderr: Option<Text>,
    },
    /// Program on the PATH.
    Executable {
        name: Text,
    },
    /// Program of a package.
    ExecutableInPackage {
        package: Text,
        executable: Text,
    },
    /// Value of a Python expression.
    Expression {
        expression: Text,
    },
    /// Content of a file.
    Content {
        file: Text,
    },
    /// Unique name.
    Anonymous {
        name: Text,
    },
    /// Equality of two texts.
    Equals {
        a: Text,
        b: Text,
    },
    /// Inequality of two texts.
    NotEquals {
        a: Text,
        b: Text,
    },
    /// True if all are true.
    All {
        of: Vec<Text>,
    },
    /// True if any is true.
    Any {
        of: Vec<Text>,
    },
    /// Negation.
    Not {
        of: Text,
    },
    /// One of two texts.
    IfElse {
        condition: Text,
        yes: Text,
        no: Text,
    },
    /// Global parameter.
    Parameter {
        name: Text,
    },
    /// Current launch file, or its folder.
    ThisFile,
    ThisFolder,
    /// Log folder.
    LogFolder,
    /// Parameter file with replaced values.
    RewrittenYaml {
        file: Text,
        rewrites: Vec<(Text, Text)>,
        key_rewrites: Vec<(Text, Text)>,
        value_rewrites: Vec<(Text, Text)>,
        root: Option<Text>,
        convert: bool,
    },
    /// File with replaced texts.
    ReplacedText {
        file: Text,
        replacements: Vec<(Text, Text)>,
        condition: Option<Condition>,
    },
    /// True if a parameter file has an entry for a node.
    HasNodeParameters {
        file: Text,
        node: Text,
    },
    /// Configuration as `True` or `False`.
    Truth {
        name: Text,
    },
    /// Object defined in the launch file, by its number in the interpreter.
    Python {
        id: u64,
    },
}

/// Condition.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "condition", rename_all = "snake_case")]
pub(crate) enum Condition {
    /// True if a text is true.
    If { text: Text },
    /// True if a text is false.
    Unless { text: Text },
    /// True if a configuration has a value; without one, if it is set.
    Configuration { name: String, equals: Option<Text>, is_negated: bool },
    /// Object defined in the launch file.
    Python { id: u64 },
}

/// Action of a launch file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct Action {
    /// Number by which others of the same file refer to it.
    #[serde(default)]
    pub(crate) id: Option<u64>,
    /// Position in the file.
    #[serde(default)]
    pub(crate) place: Place,
    /// Condition.
    #[serde(default)]
    pub(crate) condition: Option<Condition>,
    /// Kind of the action, with its data.
    #[serde(flatten)]
    pub(crate) action_kind: ActionKind,
}

/// Kind of an action, with its data.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub(crate) enum ActionKind {
    /// Declares an argument.
    Declare {
        name: String,
        default: Option<Text>,
        description: Option<Text>,
        #[serde(default)]
        choices: Vec<String>,
    },
    /// Sets a configuration.
    Configure { name: Text, value: Text },
    /// Unsets a configuration.
    Forget { name: Text },
    /// Unsets all configurations but some.
    ForgetAll { keep: Vec<(Text, Text)> },
    /// Sets an environment variable.
    Environment { name: Text, value: Text },
    /// Appends to an environment variable.
    Append { name: Text, value: Text, separator: Option<Text>, prepend: bool },
    /// Unsets an environment variable.
    Unset { name: Text },
    /// Restores the initial environment.
    ResetEnvironment,
    /// Runs actions in order.
    Group {
        actions: Vec<Action>,
        is_scoped: bool,
        #[serde(default = "yes")]
        is_forwarding: bool,
        #[serde(default)]
        configurations: Vec<(Text, Text)>,
    },
    /// Runs actions for each of some values.
    ForEach { function: u64 },
    /// Includes a file.
    Include { file: Text, arguments: Vec<(Text, Text)> },
    /// Calls a function of the launch file.
    Call { function: u64 },
    /// Pushes a namespace for later nodes.
    PushNamespace { namespace: Text },
    /// Sets a parameter of all later nodes.
    SetParameter { name: Text, value: Given },
    /// Loads a parameter file for all later nodes.
    SetParametersFromFile { file: Text, node: Option<Text> },
    /// Sets a remapping for all later nodes.
    SetRemap { from: Text, to: Text },
    /// Starts a node.
    Node(Box<NodeOf>),
    /// Loads components into a container.
    Load { container: Target, components: Vec<ComponentOf> },
    /// Starts a process.
    Process(Box<ProcessOf>),
    /// Logs a message.
    Log { text: Text, level: Option<Text> },
    /// Shuts down.
    Shutdown { reason: Option<Text> },
    /// Requests a transition of a lifecycle node.
    Transition { target: Option<u64>, transition: String },
    /// Runs actions after a delay.
    Timer { seconds: Text, actions: Vec<Action> },
    /// Registers an event handler.
    When { event: Event, actions: Vec<Action> },
    /// Unsupported action, with the reason.
    Left { what: String },
}

fn yes() -> bool {
    true
}

/// Event that actions wait for.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub(crate) enum Event {
    Started { of: Option<u64> },
    Ended { of: Option<u64> },
    Printed { of: Option<u64> },
    Reached { of: Option<u64>, from: Option<String>, to: Option<String> },
    Shutdown,
}

/// Container, by name or by the action that starts it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Target {
    Action { action: u64 },
    Name { name: Text },
}

/// Value of a parameter as given.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "given", rename_all = "snake_case")]
pub(crate) enum Given {
    /// Typed value.
    Value { value: Value },
    /// Text, converted to the given type or the detected one.
    Text { text: Text, of_type: Option<String> },
    /// List of texts.
    Texts { texts: Vec<Text> },
}

/// Parameters as given.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "parameters", rename_all = "snake_case")]
pub(crate) enum ParametersOf {
    /// By name; members of groups are prefixed with the name of the group and a dot.
    Values { values: Vec<(Text, Given)> },
    /// Parameter file, with or without substitutions.
    File { file: Text, with_substitutions: Given },
}

/// Node.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct NodeOf {
    pub(crate) package: Option<Text>,
    pub(crate) executable: Text,
    #[serde(flatten)]
    pub(crate) identity: IdentityOf,
    pub(crate) arguments: Vec<Text>,
    /// True if `arguments` are one line, to be split as a shell does.
    pub(crate) is_line: bool,
    pub(crate) ros_arguments: Vec<Text>,
    pub(crate) is_lifecycle: bool,
    /// True if it configures and activates itself.
    pub(crate) autostart: Option<Text>,
    pub(crate) components: Vec<ComponentOf>,
    pub(crate) running: RunningOf,
}

/// Name, namespace, parameters and remappings of a node.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct IdentityOf {
    pub(crate) name: Option<Text>,
    pub(crate) namespace: Option<Text>,
    pub(crate) parameters: Vec<ParametersOf>,
    pub(crate) remaps: Vec<(Text, Text)>,
}

/// Component.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct ComponentOf {
    pub(crate) package: Text,
    pub(crate) plugin: Text,
    #[serde(flatten)]
    pub(crate) identity: IdentityOf,
    pub(crate) condition: Option<Condition>,
}

/// Process.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct ProcessOf {
    pub(crate) command: Vec<Text>,
    /// True if `command` is one line, to be split as a shell does.
    pub(crate) is_line: bool,
    pub(crate) shell: Option<Text>,
    pub(crate) name: Option<Text>,
    pub(crate) running: RunningOf,
}

/// Settings of a process.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct RunningOf {
    pub(crate) prefix: Option<Text>,
    pub(crate) folder: Option<Text>,
    /// Replaces the environment of the launch.
    pub(crate) only_environment: Option<Vec<(Text, Text)>>,
    pub(crate) environment: Vec<(Text, Text)>,
    pub(crate) output: Option<Text>,
    pub(crate) respawn: Option<Text>,
    pub(crate) respawn_delay: Option<Text>,
    /// Exit handlers.
    pub(crate) on_exit: Vec<Action>,
}

/// Text of a single literal part.
#[must_use]
pub(crate) fn plain(text: impl Into<String>) -> Text {
    vec![Part::Plain(text.into())]
}

/// Values by name.
pub(crate) type Names = BTreeMap<String, String>;
