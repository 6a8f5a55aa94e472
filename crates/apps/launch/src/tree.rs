//! What a launch file of ROS 2 says, before anything is decided. XML, YAML and Python all become this.

use std::collections::BTreeMap;

use periplus_diagnostics::Span;
use serde::Deserialize;
use serde_json::Value;

/// A text in parts that are resolved one by one and joined.
pub(crate) type Text = Vec<Part>;

/// Where something is written.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Place {
    /// In a file that was read here.
    pub(crate) span: Option<Span>,
    /// In one that Python read: `file:line`.
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

/// A part of a text.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Part {
    /// As it stands.
    Plain(String),
    /// What is put in its place.
    Substitution(Box<Substitution>),
}

/// What is put in the place of something, when it is needed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "sub", rename_all = "snake_case")]
pub(crate) enum Substitution {
    /// The value of an argument or configuration.
    Configuration {
        name: Text,
        default: Option<Text>,
    },
    /// A variable of the environment.
    Environment {
        name: Text,
        default: Option<Text>,
    },
    /// Texts after another.
    Join {
        parts: Vec<Text>,
        separator: Option<Text>,
    },
    /// A path from parts.
    Path {
        parts: Vec<Text>,
    },
    /// `share/NAME` of a package, or its prefix.
    Package {
        name: Text,
        #[serde(default)]
        is_prefix: bool,
    },
    /// What a program prints.
    Command {
        command: Text,
        on_stderr: Option<Text>,
    },
    /// A program on the path.
    Executable {
        name: Text,
    },
    /// A program of a package.
    ExecutableInPackage {
        package: Text,
        executable: Text,
    },
    /// The value of an expression of Python.
    Expression {
        expression: Text,
    },
    /// The content of a file.
    Content {
        file: Text,
    },
    /// A name that nobody else has.
    Anonymous {
        name: Text,
    },
    /// Whether two texts are the same.
    Equals {
        a: Text,
        b: Text,
    },
    /// Whether they are not.
    NotEquals {
        a: Text,
        b: Text,
    },
    /// Whether all are true.
    All {
        of: Vec<Text>,
    },
    /// Whether any is.
    Any {
        of: Vec<Text>,
    },
    /// Whether it is not true.
    Not {
        of: Text,
    },
    /// One of two texts.
    IfElse {
        condition: Text,
        yes: Text,
        no: Text,
    },
    /// A parameter that was set for all nodes.
    Parameter {
        name: Text,
    },
    /// The file that is being launched, or its folder.
    ThisFile,
    ThisFolder,
    /// Where logs go.
    LogFolder,
    /// A file of parameters with some of them replaced.
    RewrittenYaml {
        file: Text,
        rewrites: Vec<(Text, Text)>,
        key_rewrites: Vec<(Text, Text)>,
        value_rewrites: Vec<(Text, Text)>,
        root: Option<Text>,
        convert: bool,
    },
    /// A file with texts in it replaced.
    ReplacedText {
        file: Text,
        replacements: Vec<(Text, Text)>,
        condition: Option<Condition>,
    },
    /// Whether a file of parameters has some for a node.
    HasNodeParameters {
        file: Text,
        node: Text,
    },
    /// A configuration as `True` or `False`.
    Truth {
        name: Text,
    },
    /// An object of the launch file's own, by the number that its interpreter knows it by.
    Python {
        id: u64,
    },
}

/// Whether something holds.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "condition", rename_all = "snake_case")]
pub(crate) enum Condition {
    /// If a text is true.
    If { text: Text },
    /// If it is not.
    Unless { text: Text },
    /// If a configuration has a value; if it is set at all, without one.
    Configuration { name: String, equals: Option<Text>, is_negated: bool },
    /// An object of the launch file's own.
    Python { id: u64 },
}

/// Something that a launch file does.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct Action {
    /// The number by which others of the same file refer to it.
    #[serde(default)]
    pub(crate) id: Option<u64>,
    /// Where it is written.
    #[serde(default)]
    pub(crate) place: Place,
    /// Only if.
    #[serde(default)]
    pub(crate) condition: Option<Condition>,
    /// What it does.
    #[serde(flatten)]
    pub(crate) deed: Deed,
}

/// What an action does.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub(crate) enum Deed {
    /// Names an argument.
    Declare {
        name: String,
        default: Option<Text>,
        description: Option<Text>,
        #[serde(default)]
        choices: Vec<String>,
    },
    /// Sets a configuration.
    Configure { name: Text, value: Text },
    /// Takes one away.
    Forget { name: Text },
    /// Takes all away, but for some that are given.
    ForgetAll { keep: Vec<(Text, Text)> },
    /// Sets a variable of the environment.
    Environment { name: Text, value: Text },
    /// Adds to a list in one.
    Append { name: Text, value: Text, separator: Option<Text>, prepend: bool },
    /// Takes one away.
    Unset { name: Text },
    /// Makes the environment what it was at the start.
    ResetEnvironment,
    /// Does others, in order.
    Group {
        actions: Vec<Action>,
        is_scoped: bool,
        #[serde(default = "yes")]
        is_forwarding: bool,
        #[serde(default)]
        configurations: Vec<(Text, Text)>,
    },
    /// Does others for each of some values.
    ForEach { function: u64 },
    /// Reads another file.
    Include { file: Text, arguments: Vec<(Text, Text)> },
    /// Calls a function of the launch file.
    Call { function: u64 },
    /// Namespaces of the nodes behind it.
    PushNamespace { namespace: Text },
    /// A parameter for all nodes behind it.
    SetParameter { name: Text, value: Given },
    /// A file of them.
    SetParametersFromFile { file: Text, node: Option<Text> },
    /// A name that is replaced in all nodes behind it.
    SetRemap { from: Text, to: Text },
    /// Starts a node.
    Node(Box<NodeOf>),
    /// Loads components into a container.
    Load { container: Target, components: Vec<ComponentOf> },
    /// Starts a program.
    Process(Box<ProcessOf>),
    /// Says something.
    Log { text: Text, level: Option<Text> },
    /// Ends everything.
    Shutdown { reason: Option<Text> },
    /// Asks a managed node for a transition.
    Transition { target: Option<u64>, transition: String },
    /// Does others after a while.
    Timer { seconds: Text, actions: Vec<Action> },
    /// Does others when something happens.
    When { event: Event, actions: Vec<Action> },
    /// Nothing that a plan can hold; why.
    Left { what: String },
}

fn yes() -> bool {
    true
}

/// What actions wait for.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub(crate) enum Event {
    Started { of: Option<u64> },
    Ended { of: Option<u64> },
    Printed { of: Option<u64> },
    Reached { of: Option<u64>, from: Option<String>, to: Option<String> },
    Shutdown,
}

/// A container, by name or by the action that starts it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Target {
    Action { action: u64 },
    Name { name: Text },
}

/// A parameter's value as it is given.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "given", rename_all = "snake_case")]
pub(crate) enum Given {
    /// A value of its own type.
    Value { value: Value },
    /// A text whose type is that of what it says, unless one is named.
    Text { text: Text, of_type: Option<String> },
    /// A list of texts.
    Texts { texts: Vec<Text> },
}

/// Parameters as they are given.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "parameters", rename_all = "snake_case")]
pub(crate) enum ParametersOf {
    /// By name; members of groups have the group's name and a dot before theirs.
    Values { values: Vec<(Text, Given)> },
    /// A file, in which `$(...)` is resolved or not.
    File { file: Text, with_substitutions: Given },
}

/// A node.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct NodeOf {
    pub(crate) package: Option<Text>,
    pub(crate) executable: Text,
    #[serde(flatten)]
    pub(crate) identity: IdentityOf,
    pub(crate) arguments: Vec<Text>,
    /// Whether `arguments` are one line, to be split as a shell does.
    pub(crate) is_line: bool,
    pub(crate) ros_arguments: Vec<Text>,
    pub(crate) is_lifecycle: bool,
    /// Whether it configures and activates itself.
    pub(crate) autostart: Option<Text>,
    pub(crate) components: Vec<ComponentOf>,
    pub(crate) running: RunningOf,
}

/// What a node is called, and what it is given.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct IdentityOf {
    pub(crate) name: Option<Text>,
    pub(crate) namespace: Option<Text>,
    pub(crate) parameters: Vec<ParametersOf>,
    pub(crate) remaps: Vec<(Text, Text)>,
}

/// A component.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct ComponentOf {
    pub(crate) package: Text,
    pub(crate) plugin: Text,
    #[serde(flatten)]
    pub(crate) identity: IdentityOf,
    pub(crate) condition: Option<Condition>,
}

/// A program.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct ProcessOf {
    pub(crate) command: Vec<Text>,
    /// Whether `command` is one line, to be split as a shell does.
    pub(crate) is_line: bool,
    pub(crate) shell: Option<Text>,
    pub(crate) name: Option<Text>,
    pub(crate) running: RunningOf,
}

/// How a program runs.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub(crate) struct RunningOf {
    pub(crate) prefix: Option<Text>,
    pub(crate) folder: Option<Text>,
    /// In the place of the launch's own environment.
    pub(crate) only_environment: Option<Vec<(Text, Text)>>,
    pub(crate) environment: Vec<(Text, Text)>,
    pub(crate) output: Option<Text>,
    pub(crate) respawn: Option<Text>,
    pub(crate) respawn_delay: Option<Text>,
    /// What happens at its end.
    pub(crate) on_exit: Vec<Action>,
}

/// A text of one plain part.
#[must_use]
pub(crate) fn plain(text: impl Into<String>) -> Text {
    vec![Part::Plain(text.into())]
}

/// Names that a file was given, or that stand in one.
pub(crate) type Names = BTreeMap<String, String>;
