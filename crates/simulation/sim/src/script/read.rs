//! Parser of scripts in YAML.

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, SourceMap, Span, closest};
use periplus_msgs::Message;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped, Vector3};
use periplus_yaml::YamlNode;

use crate::script::command::{self, CommandMessage, VelocityCommand};
use crate::script::goal_controller::Goal;

/// A parsed script.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriveScript {
    /// Velocities by time.
    pub commands: Vec<VelocityCommand>,
    /// Goals in their order.
    pub goals: Vec<Goal>,
    /// Topic of velocities towards the goals, that of the first goal; `None` is the topic that the
    /// robot subscribes to.
    pub goal_topic: Option<String>,
    /// True if these are `TwistStamped`.
    pub goals_are_stamped: bool,
    /// Frame of these.
    pub goal_frame: String,
}

/// Maximum number of commands: three hours at 100 Hz.
const MAX_COMMAND_COUNT: usize = 1_000_000;

/// Default rate of a repeated velocity [Hz].
const DEFAULT_RATE_HZ: f64 = 10.0;

/// Latest time [s]: thirty years.
const MAX_TIME_S: f64 = 1e9;

/// Keys of an entry with a velocity, and of one with a goal.
const OF_VELOCITY: [&str; 8] =
    ["at", "until", "rate", "topic", "type", "frame", "linear", "angular"];
const OF_GOAL: [&str; 10] = [
    "goto",
    "at",
    "topic",
    "type",
    "frame",
    "speed",
    "turn",
    "acceleration",
    "tolerance",
    "radius",
];

/// Reads a script. Invalid entries are omitted and reported.
pub fn read(file: FileId, sources: &SourceMap, diagnostics: &mut Diagnostics) -> DriveScript {
    let node = match periplus_yaml::parse(file, sources) {
        Ok(Some(node)) => node,
        Ok(None) => return DriveScript::default(),
        Err(wrong) => {
            diagnostics.push(*wrong);
            return DriveScript::default();
        }
    };
    read_node(&node, diagnostics)
}

/// Reads a script that is a part of another file. Invalid entries are omitted and reported.
pub fn read_node(node: &YamlNode, diagnostics: &mut Diagnostics) -> DriveScript {
    let mut script = DriveScript::default();
    let Some(entries) = node.list() else {
        if !node.is_null() {
            let wrong = format!("a script is a list of commands, not {}", node.kind());
            let help = "write `- {at: 0.0, linear: [0.5, 0, 0], angular: [0, 0, 0.2]}`";
            diagnostics.push(Diagnostic::error("bad-script", wrong).at(node.span).help(help));
        }
        return script;
    };
    for entry in entries {
        let result = if entry.get("goto").is_some() {
            goal(entry, &mut script)
        } else {
            velocity(entry, &mut script)
        };
        if let Err(wrong) = result {
            diagnostics.push(*wrong);
        }
    }
    command::sort(&mut script.commands);
    script
}

type Outcome<T> = Result<T, Box<Diagnostic>>;

fn wrong(span: Span, message: impl Into<String>, help: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::error("bad-command", message).at(span).help(help))
}

fn velocity(entry: &YamlNode, script: &mut DriveScript) -> Outcome<()> {
    names(entry, &OF_VELOCITY)?;
    let Some(at) = entry.get("at") else {
        let help = "add `at: 0.0`, in seconds of simulated time";
        return Err(wrong(entry.span, "a command has no time", help));
    };
    let first_ns = time(at)?;
    let mut twist = Twist::default();
    vector(entry.get("linear"), "linear", 0, &mut twist.linear)?;
    vector(entry.get("angular"), "angular", 2, &mut twist.angular)?;
    let (topic, is_stamped, frame) = addressee(entry)?;

    let mut count = 1;
    let mut period_ns = 0.0;
    if let Some(until) = entry.get("until") {
        let rate_hz =
            entry.get("rate").map_or(Ok(DEFAULT_RATE_HZ), |node| positive(node, "rate"))?;
        let end_ns = time(until)?;
        if end_ns <= first_ns {
            let help = "`until` is later than `at`, both in seconds";
            return Err(wrong(until.span, "a command ends before it begins", help));
        }
        period_ns = 1e9 / rate_hz;
        #[expect(clippy::cast_precision_loss, reason = "times of scripts are below 2^53")]
        let periods = libm::ceil((end_ns - first_ns) as f64 / period_ns);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let periods = periods.max(1.0) as usize;
        count = periods;
    } else if let Some(rate) = entry.get("rate") {
        return Err(wrong(rate.span, "a command repeats without end", "add `until: 5.0`"));
    }
    if count > MAX_COMMAND_COUNT - script.commands.len() {
        let help = "make `until` earlier or `rate` lower";
        let message = format!("the script has more than {MAX_COMMAND_COUNT} commands");
        return Err(wrong(entry.span, message, help));
    }
    for index in 0..count {
        #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "small")]
        let time_ns = first_ns + libm::round(index as f64 * period_ns) as i64;
        let body = message(&twist, is_stamped, &frame, time_ns);
        script.commands.push(VelocityCommand { time_ns, topic: topic.clone(), body });
    }
    Ok(())
}

fn goal(entry: &YamlNode, script: &mut DriveScript) -> Outcome<()> {
    names(entry, &OF_GOAL)?;
    let Some(to) = entry.get("goto") else { return Ok(()) };
    let help = "write `goto: [2.0, 1.0]`, x and y in metres";
    let coordinates: Option<Vec<f64>> =
        to.list().and_then(|list| list.iter().map(YamlNode::number).collect());
    let Some([x_m, y_m]) = coordinates.as_deref() else {
        return Err(wrong(to.span, "a goal is two numbers", help));
    };
    let mut goal = Goal::at([*x_m, *y_m]);
    if let Some(at) = entry.get("at") {
        goal.not_before_ns = time(at)?;
    }
    let fields = [
        ("speed", &mut goal.speed_m_s),
        ("turn", &mut goal.turn_rad_s),
        ("acceleration", &mut goal.acceleration_m_s2),
        ("tolerance", &mut goal.tolerance_m),
        ("radius", &mut goal.radius_m),
    ];
    for (name, field) in fields {
        if let Some(node) = entry.get(name) {
            *field = positive(node, name)?;
        }
    }
    let (topic, is_stamped, frame) = addressee(entry)?;
    if script.goals.is_empty() {
        script.goal_topic = topic;
        script.goals_are_stamped = is_stamped;
        script.goal_frame = frame;
    } else if let Some(node) = entry.get("topic").filter(|_| script.goal_topic != topic) {
        let help = "one script drives one robot to goals; name the topic at the first goal";
        return Err(wrong(node.span, "goals have two topics", help));
    }
    script.goals.push(goal);
    Ok(())
}

impl DriveScript {
    /// Returns the message of a velocity towards a goal at a time \[ns\].
    #[must_use]
    pub fn goal_body(&self, twist: &Twist, time_ns: i64) -> CommandMessage {
        message(twist, self.goals_are_stamped, &self.goal_frame, time_ns)
    }
}

fn message(twist: &Twist, is_stamped: bool, frame: &str, time_ns: i64) -> CommandMessage {
    if !is_stamped {
        return CommandMessage::Twist(twist.clone());
    }
    let mut stamped = TwistStamped { twist: twist.clone(), ..TwistStamped::default() };
    stamped.header.frame_id = frame.into();
    let sec = i32::try_from(time_ns / 1_000_000_000).unwrap_or(i32::MAX);
    let nanosec = u32::try_from(time_ns % 1_000_000_000).unwrap_or(0);
    stamped.header.stamp = Time { sec, nanosec };
    CommandMessage::TwistStamped(stamped)
}

/// Returns topic, whether messages are stamped, and their frame.
fn addressee(entry: &YamlNode) -> Outcome<(Option<String>, bool, String)> {
    let text = |name: &str| match entry.get(name) {
        None => Ok(None),
        Some(node) => match node.text().filter(|text| !text.is_empty()) {
            Some(text) => Ok(Some((text.to_owned(), node.span))),
            None => {
                let message = format!("`{name}` is {}, not a text", node.kind());
                Err(wrong(node.span, message, "write a name"))
            }
        },
    };
    let topic = text("topic")?.map(|(topic, _)| topic);
    let frame = text("frame")?;
    let is_stamped = match text("type")? {
        // Only one of the types has a frame.
        None => frame.is_some(),
        Some((name, span)) => {
            let short = name.strip_prefix("geometry_msgs/").unwrap_or(&name);
            match short.strip_prefix("msg/").unwrap_or(short) {
                "Twist" => false,
                "TwistStamped" => true,
                _ => {
                    let help = format!("{} or {}", Twist::TYPE_NAME, TwistStamped::TYPE_NAME);
                    let message = format!("a script cannot send `{name}`");
                    return Err(wrong(span, message, &help));
                }
            }
        }
    };
    Ok((topic, is_stamped, frame.map(|(frame, _)| frame).unwrap_or_default()))
}

fn names(entry: &YamlNode, known: &[&str]) -> Outcome<()> {
    let Some(entries) = entry.entries() else {
        let message = format!("a command is a mapping, not {}", entry.kind());
        return Err(wrong(entry.span, message, "write `- {at: 0.0, linear: [0.5, 0, 0]}`"));
    };
    for (index, (key, _)) in entries.iter().enumerate() {
        let name = key.text().unwrap_or_default();
        if !known.contains(&name) {
            let help = closest(name, known.iter().copied())
                .map_or_else(|| known.join(", "), |near| format!("did you mean `{near}`?"));
            return Err(wrong(key.span, format!("a command has no key `{name}`"), &help));
        }
        if entries[..index].iter().any(|(earlier, _)| earlier.text() == Some(name)) {
            let message = format!("the key `{name}` occurs twice");
            return Err(wrong(key.span, message, "remove one of them"));
        }
    }
    Ok(())
}

fn time(node: &YamlNode) -> Outcome<i64> {
    let time_s = node.number().filter(|time_s| (0.0..=MAX_TIME_S).contains(time_s));
    let Some(time_s) = time_s else {
        let help = "write seconds of simulated time, such as 2.5";
        return Err(wrong(node.span, "this is not a time", help));
    };
    #[expect(clippy::cast_possible_truncation, reason = "held in range above")]
    let time_ns = libm::round(time_s * 1e9) as i64;
    Ok(time_ns)
}

fn positive(node: &YamlNode, name: &str) -> Outcome<f64> {
    node.number().filter(|&number| number > 0.0).ok_or_else(|| {
        let message = format!("`{name}` is not a number above zero");
        wrong(node.span, message, "write a number such as 0.5")
    })
}

/// Reads a list x, y, z; a mapping of these names; or a number, which is the component `main`.
fn vector(node: Option<&YamlNode>, name: &str, main: usize, into: &mut Vector3) -> Outcome<()> {
    let Some(node) = node else { return Ok(()) };
    let mut values = [0.0; 3];
    let axes = ["x", "y", "z"];
    let is_read = if let Some(number) = node.number() {
        values[main] = number;
        true
    } else if let Some(list) = node.list() {
        let numbers: Option<Vec<f64>> = list.iter().map(YamlNode::number).collect();
        let numbers = numbers.filter(|numbers| numbers.len() == 3);
        numbers.is_some_and(|numbers| {
            values.copy_from_slice(&numbers);
            true
        })
    } else if node.entries().is_some() {
        names(node, &axes)?;
        axes.iter().zip(&mut values).all(|(axis, value)| match node.get(axis) {
            None => true,
            Some(node) => node.number().map(|number| *value = number).is_some(),
        })
    } else {
        false
    };
    if !is_read {
        let help = format!("write `{name}: [0.5, 0, 0]`, x, y and z");
        return Err(wrong(node.span, format!("`{name}` is not three numbers"), &help));
    }
    [into.x, into.y, into.z] = values;
    Ok(())
}
