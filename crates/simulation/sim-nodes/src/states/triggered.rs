//! `gz-sim-triggered-publisher-system`.

use std::collections::VecDeque;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, GraphError, Mailbox, Node, NodeSettings, Qos, Sample};
use periplus_gz_msgs::{AsRos, Pairs, bare_name, each_pair};
use periplus_msgs::{Message, to_json};
use periplus_physics::PhysicsWorld;
use periplus_scene::Plugin;
use periplus_xml::Element;
use serde_json::Value;

use crate::{Device, DeviceState, StepInterval, gz_topic};

/// Default tolerance of number comparisons, as in Gazebo; `tol` overrides it.
const NUMBER_TOLERANCE_FACTOR: f64 = 1e-8;

/// Publishes messages when a matching one arrives: all `<match>` of `<input>` must hold; each
/// `<output>` is published after `<delay_ms>` of simulated time.
///
/// Source: gz-sim 8, `TriggeredPublisher.cc`. Types are the ROS equivalents, with the field names of
/// ROS; services are not called.
pub(crate) struct TriggeredPublisher {
    name: String,
    input: Box<dyn Input>,
    outputs: Vec<Box<dyn Fn() + Send>>,
    delay_ns: i64,
    due_ns: VecDeque<i64>,
}

/// Subscription with matching.
trait Input: Send {
    /// Returns the number of matching messages since the last call.
    fn take_matches(&mut self) -> usize;

    /// Returns the messages that wait.
    fn pending(&self) -> Vec<Sample>;

    /// Replaces the messages that wait.
    fn set_pending(&self, samples: &[Sample]);
}

/// Subscription of one type.
struct MatchedSubscription<R> {
    mailbox: Mailbox<R>,
    matches: Vec<Match>,
}

impl<R: Message> Input for MatchedSubscription<R> {
    fn take_matches(&mut self) -> usize {
        let messages = self.mailbox.drain();
        let fits = |message: &Value| self.matches.iter().all(|one| one.holds(message));
        messages.iter().filter(|message| fits(&to_json(&***message))).count()
    }

    fn pending(&self) -> Vec<Sample> {
        self.mailbox.pending()
    }

    fn set_pending(&self, samples: &[Sample]) {
        self.mailbox.set_pending(samples);
    }
}

/// Condition on a message.
struct Match {
    expected: Expected,
    tolerance: f64,
    is_negative: bool,
}

enum Expected {
    /// A field, by its path, and its expected text.
    Field(String, String),
    /// All non-default fields of a message, and the default message.
    Message(Value, Value),
}

impl Match {
    fn holds(&self, message: &Value) -> bool {
        let fits = match &self.expected {
            Expected::Field(path, text) => {
                message.pointer(path).is_some_and(|value| is_text(value, text, self.tolerance))
            }
            Expected::Message(expected, fallback) => {
                is_part(expected, fallback, message, self.tolerance)
            }
        };
        fits != self.is_negative
    }
}

/// Returns true if a value equals a text; for a list, if one of its items does.
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

/// Returns true if a message contains the expected non-default fields. Lists match in any order.
fn is_part(expected: &Value, fallback: &Value, message: &Value, tolerance: f64) -> bool {
    match (expected, message) {
        _ if expected == fallback => true,
        (Value::Object(expected), Value::Object(message)) => {
            expected.iter().all(|(name, value)| {
                let fallback = fallback.get(name).unwrap_or(&Value::Null);
                message.get(name).is_some_and(|inner| is_part(value, fallback, inner, tolerance))
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

/// Builds the device from the plugin's element; reports an error and returns `None` if it is
/// invalid.
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
                let message = format!("plugin `{}` cannot call services", plugin.name);
                let warning = Diagnostic::warning("plugin-service", message).at(plugin.origin);
                diagnostics.push(warning.note("its messages are published"));
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
    let mut listening = InputVisitor { type_name, node: &node, topic: &topic, input, made: None };
    each_pair(&mut listening);
    let input = listening.made.ok_or_else(|| unknown(type_name))??;
    let mut outputs = Vec::new();
    for output in all("output") {
        let (type_name, topic) = ends(output)?;
        let text = output.text();
        let mut for_publisher =
            OutputVisitor { type_name, node: &node, topic: &topic, text: &text, made: None };
        each_pair(&mut for_publisher);
        outputs.push(for_publisher.made.ok_or_else(|| unknown(type_name))??);
    }
    let delay_ms = all("delay_ms").next().map(|one| one.text().trim().parse::<i64>());
    let delay_ms = delay_ms.transpose().map_err(|_| "`<delay_ms>` must be an integer")?;
    let delay_ns = delay_ms.unwrap_or_default().max(0).saturating_mul(1_000_000);
    let name = node.full_name().trim_start_matches('/').to_owned();
    Ok(TriggeredPublisher { name, input, outputs, delay_ns, due_ns: VecDeque::new() })
}

/// Creates a numbered node: a world can have many of these.
fn node(graph: &Graph) -> Result<Node, GraphError> {
    let mut number = 1;
    loop {
        match graph.node(NodeSettings::new(format!("triggered_publisher_{number}"))) {
            Err(GraphError::NodeExists { .. }) => number += 1,
            made => return made,
        }
    }
}

/// Returns type and topic of an input or output.
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
    format!("ROS has no equivalent of type `{type_name}`")
}

/// Visitor that subscribes with the type of the input.
struct InputVisitor<'a> {
    type_name: &'a str,
    node: &'a Node,
    topic: &'a str,
    input: &'a Element,
    made: Option<Result<Box<dyn Input>, String>>,
}

impl Pairs for InputVisitor<'_> {
    fn pair<R: Message, G: AsRos<R>>(&mut self) {
        if self.made.is_some() || G::NAME != self.type_name {
            return;
        }
        let heard = || {
            let mailbox = self.node.mailbox::<R>(self.topic, Qos::reliable(10));
            let mailbox = mailbox.map_err(|error| error.to_string())?;
            let of_name = self.input.children.iter().filter_map(periplus_xml::XmlNode::as_element);
            let matches = of_name.filter(|element| element.name == "match").map(read_match::<R, G>);
            let matches = matches.collect::<Result<Vec<_>, _>>()?;
            Ok(Box::new(MatchedSubscription { mailbox, matches }) as Box<dyn Input>)
        };
        self.made = Some(heard());
    }
}

fn read_match<R: Message, G: AsRos<R>>(element: &Element) -> Result<Match, String> {
    let value = |name: &str| element.attribute(name).map(|attribute| attribute.value.as_str());
    let text = element.text();
    let text = text.trim();
    let fallback = to_json(&R::default());
    let expected = match value("field") {
        Some(field) => {
            let path = format!("/{}", field.trim().replace('.', "/"));
            if fallback.pointer(&path).is_none() {
                return Err(format!("`{field}` is not a field of {}", R::TYPE_NAME));
            }
            Expected::Field(path, text.to_owned())
        }
        None => Expected::Message(to_json(&read::<R, G>(text)?), fallback),
    };
    let tolerance = value("tol").map(|text| text.trim().parse::<f64>());
    let tolerance = tolerance.transpose().map_err(|_| "`tol` must be a number")?;
    let is_negative = match value("logic_type") {
        None | Some("positive") => false,
        Some("negative") => true,
        Some(other) => {
            return Err(format!("`logic_type` must be positive or negative, not `{other}`"));
        }
    };
    Ok(Match { expected, tolerance: tolerance.unwrap_or(NUMBER_TOLERANCE_FACTOR), is_negative })
}

/// Converts the text format of protobuf to a ROS message.
fn read<R: Message, G: AsRos<R>>(text: &str) -> Result<R, String> {
    let message = G::from_text(text.trim()).map_err(|error| error.to_string())?;
    message.to_ros().ok_or_else(|| format!("`{}` has no ROS equivalent", text.trim()))
}

/// Visitor that publishes with the type of an output.
struct OutputVisitor<'a> {
    type_name: &'a str,
    node: &'a Node,
    topic: &'a str,
    text: &'a str,
    made: Option<Result<Box<dyn Fn() + Send>, String>>,
}

impl Pairs for OutputVisitor<'_> {
    fn pair<R: Message, G: AsRos<R>>(&mut self) {
        if self.made.is_some() || G::NAME != self.type_name {
            return;
        }
        let for_publisher = || {
            let message = read::<R, G>(self.text)?;
            let publisher = self.node.publisher::<R>(self.topic, Qos::reliable(10));
            let publisher = publisher.map_err(|error| error.to_string())?;
            Ok(Box::new(move || publisher.publish(message.clone())) as Box<dyn Fn() + Send>)
        };
        self.made = Some(for_publisher());
    }
}

impl Device for TriggeredPublisher {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, _world: &mut PhysicsWorld, span: StepInterval) {
        let due_ns = span.start_ns + self.delay_ns;
        self.due_ns.extend(std::iter::repeat_n(due_ns, self.input.take_matches()));
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

    fn save(&self) -> DeviceState {
        DeviceState::new((self.due_ns.clone(), self.input.pending()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((due_ns, inputs)) = saved.get::<(VecDeque<i64>, Vec<Sample>)>() else {
            return false;
        };
        self.due_ns.clone_from(due_ns);
        self.input.set_pending(inputs);
        true
    }
}
