//! `gz-sim-triggered-publisher-system`.

use std::collections::VecDeque;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, GraphError, Mailbox, Node, NodeSettings, Qos};
use periplus_gz_msgs::{AsRos, Pairs, bare_name, each_pair};
use periplus_msgs::{Message, to_json};
use periplus_physics::World;
use periplus_scene::Plugin;
use periplus_xml::Element;
use serde_json::Value;

use crate::{Device, Span, gz_topic};

/// Numbers that differ by no more are the same, unless `tol` says otherwise; as in Gazebo.
const TOLERANCE: f64 = 1e-8;

/// Publishes messages when one comes that matches: all `<match>` of its `<input>` must hold, each
/// `<output>` is published, after `<delay_ms>` of simulated time.
///
/// Source: gz-sim 8, `TriggeredPublisher.cc`. Types are those of ROS that mean the same, fields are
/// called as there, and a service is not called.
pub(crate) struct TriggeredPublisher {
    name: String,
    input: Box<dyn Input>,
    outputs: Vec<Box<dyn Fn() + Send>>,
    delay_ns: i64,
    due_ns: VecDeque<i64>,
}

/// Messages that come.
trait Input: Send {
    /// How many came since the last look that match.
    fn hits(&mut self) -> usize;
}

/// Messages of a type.
struct Heard<R> {
    mailbox: Mailbox<R>,
    matches: Vec<Match>,
}

impl<R: Message> Input for Heard<R> {
    fn hits(&mut self) -> usize {
        let messages = self.mailbox.drain();
        let fits = |message: &Value| self.matches.iter().all(|one| one.holds(message));
        messages.iter().filter(|message| fits(&to_json(&***message))).count()
    }
}

/// What a message must be like.
struct Match {
    expected: Expected,
    tolerance: f64,
    is_negative: bool,
}

enum Expected {
    /// A field, by its path, and the text that it is to be.
    Field(String, String),
    /// All fields of a message that are not as usual, and the usual message.
    Message(Value, Value),
}

impl Match {
    fn holds(&self, message: &Value) -> bool {
        let fits = match &self.expected {
            Expected::Field(path, text) => {
                message.pointer(path).is_some_and(|value| is_text(value, text, self.tolerance))
            }
            Expected::Message(expected, usual) => is_part(expected, usual, message, self.tolerance),
        };
        fits != self.is_negative
    }
}

/// Whether a value is what a text says; of a list, whether one of its items is.
fn is_text(value: &Value, text: &str, tolerance: f64) -> bool {
    match value {
        Value::Bool(value) => match text {
            "true" | "1" => *value,
            "false" | "0" => !*value,
            _ => false,
        },
        Value::Number(number) => {
            let wanted = text.parse::<f64>().ok();
            wanted.zip(number.as_f64()).is_some_and(|(a, b)| (a - b).abs() <= tolerance)
        }
        Value::String(value) => *value == text.trim_matches(['"', '\'']),
        Value::Array(items) => items.iter().any(|item| is_text(item, text, tolerance)),
        Value::Null | Value::Object(_) => false,
    }
}

/// Whether a message has what is expected and not as usual. Of lists, whatever the order.
fn is_part(expected: &Value, usual: &Value, message: &Value, tolerance: f64) -> bool {
    match (expected, message) {
        _ if expected == usual => true,
        (Value::Object(expected), Value::Object(message)) => {
            expected.iter().all(|(name, value)| {
                let usual = usual.get(name).unwrap_or(&Value::Null);
                message.get(name).is_some_and(|inner| is_part(value, usual, inner, tolerance))
            })
        }
        (Value::Array(expected), Value::Array(items)) => expected
            .iter()
            .all(|value| items.iter().any(|item| is_part(value, &Value::Null, item, tolerance))),
        (Value::Number(a), Value::Number(b)) => {
            a.as_f64().zip(b.as_f64()).is_some_and(|(a, b)| (a - b).abs() <= tolerance)
        }
        (expected, message) => expected == message,
    }
}

/// From the plugin's element; none, with an error, where it cannot be.
pub(crate) fn build(
    graph: &Graph,
    plugin: &Plugin,
    diagnostics: &mut Diagnostics,
) -> Option<TriggeredPublisher> {
    let mut refuse = |message: String| {
        let message = format!("plugin `{}` does nothing: {message}", plugin.name);
        diagnostics.push(Diagnostic::error("plugin-refused", message).at(plugin.origin));
    };
    match made(graph, plugin) {
        Ok(made) => {
            if plugin.content.iter().any(|element| element.name == "service") {
                let message = format!("plugin `{}` calls no service here", plugin.name);
                let warning = Diagnostic::warning("plugin-service", message).at(plugin.origin);
                diagnostics.push(warning.note("what it publishes is published"));
            }
            Some(made)
        }
        Err(why) => {
            refuse(why);
            None
        }
    }
}

fn made(graph: &Graph, plugin: &Plugin) -> Result<TriggeredPublisher, String> {
    let node = node(graph).map_err(|error| error.to_string())?;
    let all = |name: &'static str| plugin.content.iter().filter(move |one| one.name == name);
    let input = all("input").next().ok_or("it has no `<input>`")?;
    let (type_name, topic) = ends(input)?;
    let mut listening = Listening { type_name, node: &node, topic: &topic, input, made: None };
    each_pair(&mut listening);
    let input = listening.made.ok_or_else(|| unknown(type_name))??;
    let mut outputs = Vec::new();
    for output in all("output") {
        let (type_name, topic) = ends(output)?;
        let text = output.text();
        let mut telling =
            Telling { type_name, node: &node, topic: &topic, text: &text, made: None };
        each_pair(&mut telling);
        outputs.push(telling.made.ok_or_else(|| unknown(type_name))??);
    }
    let delay_ms = all("delay_ms").next().map(|one| one.text().trim().parse::<i64>());
    let delay_ms = delay_ms.transpose().map_err(|_| "`<delay_ms>` is no whole number")?;
    let delay_ns = delay_ms.unwrap_or_default().max(0).saturating_mul(1_000_000);
    let name = node.full_name().trim_start_matches('/').to_owned();
    Ok(TriggeredPublisher { name, input, outputs, delay_ns, due_ns: VecDeque::new() })
}

/// A node of its own, numbered: a world has many of these.
fn node(graph: &Graph) -> Result<Node, GraphError> {
    let mut number = 1;
    loop {
        match graph.node(NodeSettings::new(format!("triggered_publisher_{number}"))) {
            Err(GraphError::NodeExists { .. }) => number += 1,
            made => return made,
        }
    }
}

/// The type and topic of an end.
fn ends(element: &Element) -> Result<(&str, String), String> {
    let value = |name: &str| {
        let value = element.attribute(name).map(|attribute| attribute.value.as_str());
        value
            .filter(|value| !value.is_empty())
            .ok_or_else(|| format!("its `<{}>` has no `{name}`", element.name))
    };
    let type_name = value("type")?;
    let bare = bare_name(type_name).ok_or_else(|| unknown(type_name))?;
    Ok((bare, gz_topic(value("topic")?)))
}

fn unknown(type_name: &str) -> String {
    format!("ROS has no type that means `{type_name}`")
}

/// Looks for the type of the input.
struct Listening<'a> {
    type_name: &'a str,
    node: &'a Node,
    topic: &'a str,
    input: &'a Element,
    made: Option<Result<Box<dyn Input>, String>>,
}

impl Pairs for Listening<'_> {
    fn pair<R: Message, G: AsRos<R>>(&mut self) {
        if self.made.is_some() || G::NAME != self.type_name {
            return;
        }
        let heard = || {
            let mailbox = self.node.mailbox::<R>(self.topic, Qos::reliable(10));
            let mailbox = mailbox.map_err(|error| error.to_string())?;
            let of_name = self.input.children.iter().filter_map(periplus_xml::Node::as_element);
            let matches = of_name.filter(|element| element.name == "match").map(read_match::<R, G>);
            let matches = matches.collect::<Result<Vec<_>, _>>()?;
            Ok(Box::new(Heard { mailbox, matches }) as Box<dyn Input>)
        };
        self.made = Some(heard());
    }
}

fn read_match<R: Message, G: AsRos<R>>(element: &Element) -> Result<Match, String> {
    let value = |name: &str| element.attribute(name).map(|attribute| attribute.value.as_str());
    let text = element.text();
    let text = text.trim();
    let usual = to_json(&R::default());
    let expected = match value("field") {
        Some(field) => {
            let path = format!("/{}", field.trim().replace('.', "/"));
            if usual.pointer(&path).is_none() {
                return Err(format!("`{field}` is no field of {}", R::TYPE_NAME));
            }
            Expected::Field(path, text.to_owned())
        }
        None => Expected::Message(to_json(&read::<R, G>(text)?), usual),
    };
    let tolerance = value("tol").map(|text| text.trim().parse::<f64>());
    let tolerance = tolerance.transpose().map_err(|_| "`tol` is no number")?;
    let is_negative = match value("logic_type") {
        None | Some("positive") => false,
        Some("negative") => true,
        Some(other) => {
            return Err(format!("`logic_type` is positive or negative, and not `{other}`"));
        }
    };
    Ok(Match { expected, tolerance: tolerance.unwrap_or(TOLERANCE), is_negative })
}

/// A message of ROS from the text of protobuf.
fn read<R: Message, G: AsRos<R>>(text: &str) -> Result<R, String> {
    let message = G::from_text(text.trim()).map_err(|error| error.to_string())?;
    message.to_ros().ok_or_else(|| format!("ROS has no word for `{}`", text.trim()))
}

/// Looks for the type of an output.
struct Telling<'a> {
    type_name: &'a str,
    node: &'a Node,
    topic: &'a str,
    text: &'a str,
    made: Option<Result<Box<dyn Fn() + Send>, String>>,
}

impl Pairs for Telling<'_> {
    fn pair<R: Message, G: AsRos<R>>(&mut self) {
        if self.made.is_some() || G::NAME != self.type_name {
            return;
        }
        let telling = || {
            let message = read::<R, G>(self.text)?;
            let publisher = self.node.publisher::<R>(self.topic, Qos::reliable(10));
            let publisher = publisher.map_err(|error| error.to_string())?;
            Ok(Box::new(move || publisher.publish(message.clone())) as Box<dyn Fn() + Send>)
        };
        self.made = Some(telling());
    }
}

impl Device for TriggeredPublisher {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, _world: &mut World, span: Span) {
        let due_ns = span.start_ns + self.delay_ns;
        self.due_ns.extend(std::iter::repeat_n(due_ns, self.input.hits()));
        while self.due_ns.front().is_some_and(|due_ns| *due_ns <= span.start_ns) {
            self.due_ns.pop_front();
            self.outputs.iter().for_each(|publish| publish());
        }
    }

    fn next_ns(&self) -> Option<i64> {
        self.due_ns.front().copied()
    }

    fn reset(&mut self, _time_ns: i64) {
        self.due_ns.clear();
    }
}
