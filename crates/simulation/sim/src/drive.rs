//! Driver for scripts and recordings of velocity commands.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use crate::script::{CommandMessage, DriveScript, GoalController};
use periplus_bags::Reader;
use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};
use periplus_graph::{Graph, GraphError, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::Message as _;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_os::Machine;
use periplus_os::fs::File;
use periplus_resources::Host as _;

use crate::Simulation;

/// Period of velocity commands towards a goal \[ns\].
const STEER_NS: i64 = 50_000_000;

/// Plays a script. Without a script it does nothing.
#[derive(Default)]
pub struct Driver {
    script: DriveScript,
    /// Index of the next command.
    next: usize,
    pilot: Option<GoalController>,
    steer_ns: i64,
    /// Publishers by topic of the script; `None` is the topic of the robot.
    outlets: BTreeMap<Option<String>, Outlet>,
}

/// Reasons that a script cannot be driven.
#[derive(Debug)]
pub enum DriveError {
    /// The script names no topic, and no robot or several robots subscribe to velocities.
    NoTopic(String),
    /// A name is invalid, or a topic has another type.
    Graph(GraphError),
}

impl fmt::Display for DriveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTopic(words) => f.write_str(words),
            Self::Graph(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for DriveError {}

impl From<GraphError> for DriveError {
    fn from(error: GraphError) -> Self {
        Self::Graph(error)
    }
}

/// Findings of a script's file.
#[derive(Debug, Default)]
pub struct ScriptFindings {
    /// Source text.
    pub sources: SourceMap,
    /// Problems of the script.
    pub diagnostics: Diagnostics,
}

enum Outlet {
    Twist(Publisher<Twist>),
    Stamped(Publisher<TwistStamped>),
}

impl Driver {
    /// Reads a script (YAML), or the commands of a recording (`.mcap`).
    #[must_use]
    pub fn read(path: &Path) -> (Self, ScriptFindings) {
        let mut findings = ScriptFindings::default();
        let is_bag = path.extension().is_some_and(|extension| extension == "mcap");
        let script =
            if is_bag { replayed(path, &mut findings) } else { written(path, &mut findings) };
        (Self::new(script), findings)
    }

    /// Creates a driver at the start of a script.
    #[must_use]
    pub fn new(script: DriveScript) -> Self {
        let pilot = (!script.goals.is_empty()).then(|| GoalController::new(script.goals.clone()));
        Self { script, pilot, ..Self::default() }
    }

    /// Creates the publishers of the script's topics. Commands without a topic use the topic that
    /// the robot subscribes to. Warns about topics without subscribers.
    ///
    /// # Errors
    /// When no topic can be chosen, a name is invalid, or a topic has another type.
    pub fn join(&mut self, simulation: &Simulation) -> Result<Diagnostics, DriveError> {
        let mut warnings = Diagnostics::new();
        let mut wanted: Vec<(Option<String>, bool)> = Vec::new();
        for command in &self.script.commands {
            if wanted.iter().all(|(topic, _)| *topic != command.topic) {
                wanted.push((
                    command.topic.clone(),
                    matches!(command.body, CommandMessage::TwistStamped(_)),
                ));
            }
        }
        let goal_topic = &self.script.goal_topic;
        if self.pilot.is_some() && wanted.iter().all(|(topic, _)| topic != goal_topic) {
            wanted.push((goal_topic.clone(), self.script.goals_are_stamped));
        }
        if wanted.is_empty() {
            return Ok(warnings);
        }
        let listeners = velocity_topics(simulation.graph());
        let mut settings = NodeSettings::new("script");
        for rule in simulation.remaps() {
            settings = settings.rule(rule);
        }
        let node = simulation.graph().node(settings)?;
        for (topic, is_stamped) in wanted {
            let (name, is_stamped) = match &topic {
                None => chosen(&listeners)?,
                Some(name) => {
                    let full_name = node.names().topic(name)?;
                    if listeners.iter().all(|listener| listener.name != full_name) {
                        warnings.push(unheard(&full_name, &listeners));
                    }
                    (name.clone(), is_stamped)
                }
            };
            self.outlets.insert(topic, outlet(&node, &name, is_stamped)?);
        }
        Ok(warnings)
    }

    /// Restarts after a jump back in time.
    pub fn restart(&mut self) {
        self.next = 0;
        self.steer_ns = 0;
        self.pilot = self.pilot.is_some().then(|| GoalController::new(self.script.goals.clone()));
    }

    /// Publishes due commands.
    pub fn play(&mut self, simulation: &Simulation) {
        let now_ns = simulation.time_ns();
        while let Some(command) = self.script.commands.get(self.next) {
            if command.time_ns > now_ns {
                break;
            }
            self.send(command.topic.as_deref(), command.time_ns, command.body.clone());
            self.next += 1;
        }
        if now_ns >= self.steer_ns
            && let Some(pilot) = &mut self.pilot
        {
            self.steer_ns = now_ns + STEER_NS;
            let pose = simulation.robot_pose().unwrap_or_default();
            let velocity = pilot.steer(now_ns, pose);
            let twist = velocity.unwrap_or_default().into();
            let body = self.script.goal_body(&twist, now_ns);
            self.send(self.script.goal_topic.as_deref(), now_ns, body);
            // The last command is zero.
            if velocity.is_none() {
                self.pilot = None;
            }
        }
    }

    /// Returns the time of the next command \[ns\].
    #[must_use]
    pub fn next_ns(&self) -> Option<i64> {
        let command = self.script.commands.get(self.next).map(|command| command.time_ns);
        let steer = self.pilot.is_some().then_some(self.steer_ns);
        [command, steer].into_iter().flatten().min()
    }

    fn send(&self, topic: Option<&str>, time_ns: i64, body: CommandMessage) {
        let outlet = self.outlets.iter().find(|(name, _)| name.as_deref() == topic);
        match (outlet.map(|(_, outlet)| outlet), body) {
            (Some(Outlet::Twist(publisher)), CommandMessage::Twist(twist)) => {
                publisher.publish(twist);
            }
            (Some(Outlet::Stamped(publisher)), CommandMessage::TwistStamped(twist)) => {
                publisher.publish(twist);
            }
            // The robot's topic has the type of the robot's subscription.
            (Some(Outlet::Twist(publisher)), CommandMessage::TwistStamped(stamped))
                if topic.is_none() =>
            {
                publisher.publish(stamped.twist);
            }
            (Some(Outlet::Stamped(publisher)), CommandMessage::Twist(twist)) if topic.is_none() => {
                let mut stamped = TwistStamped { twist, ..TwistStamped::default() };
                stamped.header.stamp = Time::of_ns(time_ns);
                publisher.publish(stamped);
            }
            // A script with both types on one topic: the type of the first is used, the rest cannot
            // be sent.
            _ => {}
        }
    }
}

/// A topic on which a robot receives velocities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VelocityTopic {
    /// Its full name.
    pub name: String,
    /// True if its messages are `TwistStamped`, not `Twist`.
    pub is_stamped: bool,
}

/// Returns the velocity topics with subscribers, by name.
#[must_use]
pub fn velocity_topics(graph: &Graph) -> Vec<VelocityTopic> {
    let topics = graph.topics().into_iter().filter(|topic| !topic.subscriptions.is_empty());
    let topics = topics.filter_map(|topic| {
        let is_stamped = topic.type_name == TwistStamped::TYPE_NAME;
        (is_stamped || topic.type_name == Twist::TYPE_NAME)
            .then_some(VelocityTopic { name: topic.name, is_stamped })
    });
    topics.collect()
}

/// Default name of a velocity topic.
const DEFAULT_TOPIC: &str = "/cmd_vel";

/// Returns the topic of commands without one.
fn chosen(listeners: &[VelocityTopic]) -> Result<(String, bool), DriveError> {
    let usual = listeners.iter().find(|listener| listener.name == DEFAULT_TOPIC);
    match (usual, listeners) {
        (Some(one), _) | (None, [one]) => Ok((one.name.clone(), one.is_stamped)),
        (None, []) => Err(DriveError::NoTopic(
            "no robot of this world subscribes to velocities; add one with `--robot FILE`, or set `topic: \
             NAME` to the topic of a robot that is added later"
                .into(),
        )),
        (None, several) => Err(DriveError::NoTopic(format!(
            "the commands name no topic, and robots subscribe to {}; add `topic: NAME` to them",
            names(several)
        ))),
    }
}

fn unheard(topic: &str, listeners: &[VelocityTopic]) -> Diagnostic {
    let warning = Diagnostic::warning(
        "unheard-commands",
        format!(
            "nothing subscribes to `{topic}`, where the \
             script sends velocities"
        ),
    );
    match listeners {
        [] => warning.help("no robot of this world subscribes to velocities"),
        listeners => warning.help(format!(
            "robots subscribe to {}; commands without `topic:` are published there",
            names(listeners)
        )),
    }
}

fn names(topics: &[VelocityTopic]) -> String {
    let names: Vec<String> = topics.iter().map(|topic| format!("`{}`", topic.name)).collect();
    names.join(", ")
}

fn outlet(node: &Node, topic: &str, is_stamped: bool) -> Result<Outlet, GraphError> {
    let qos = Qos::reliable(10);
    Ok(if is_stamped {
        Outlet::Stamped(node.publisher(topic, qos)?)
    } else {
        Outlet::Twist(node.publisher(topic, qos)?)
    })
}

fn written(path: &Path, findings: &mut ScriptFindings) -> DriveScript {
    match Machine.read(path) {
        Ok(bytes) => {
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let file = findings.sources.add(path.display().to_string(), text);
            crate::script::read(file, &findings.sources, &mut findings.diagnostics)
        }
        Err(error) => {
            findings.diagnostics.push(unreadable(path, &error.to_string()));
            DriveScript::default()
        }
    }
}

#[allow(clippy::disallowed_methods, reason = "recordings are read in pieces, not as a whole")]
fn replayed(path: &Path, findings: &mut ScriptFindings) -> DriveScript {
    let commands = File::open(path)
        .map_err(|error| error.to_string())
        .and_then(|file| Reader::open(file).map_err(|error| error.to_string()))
        .and_then(|mut bag| {
            crate::script::replay(&mut bag, &mut findings.diagnostics)
                .map_err(|error| error.to_string())
        });
    match commands {
        Ok(commands) => DriveScript { commands, ..DriveScript::default() },
        Err(error) => {
            findings.diagnostics.push(unreadable(path, &error));
            DriveScript::default()
        }
    }
}

fn unreadable(path: &Path, why: &str) -> Diagnostic {
    Diagnostic::error("unreadable-file", format!("`{}` cannot be read: {why}", path.display()))
        .help("use a script (YAML) or a recording (.mcap)")
}
