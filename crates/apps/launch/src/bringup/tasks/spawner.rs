//! Spawner of robots and models, as `spawn_entity.py`, `spawn_model` and `create`.

use periplus_geometry::{Pose, Rpy};
use periplus_graph::{Mailbox, Node, Qos};
use periplus_msgs::std_msgs;
use periplus_sim::{InsertionSource, ModelInsertion};

use super::{Done, Task, TaskContext};
use crate::bringup::parameters::{NamedParameters, number_of, text_of};
use crate::bringup::report::LaunchLog;
use crate::bringup::words;

/// Time after which a missing input is logged \[ns\].
const WARNING_DELAY_NS: i64 = 5_000_000_000;

/// Model to spawn, and its pose.
pub(crate) struct Spawner {
    from: From,
    name: String,
    may_rename: bool,
    namespace: String,
    world_from_here: Pose,
    since_ns: i64,
    has_complained: bool,
    /// ` (FILE:LINE)` of the launch file; empty if unknown.
    place: String,
}

/// Source of the model.
enum From {
    /// Text, and the parameter that contains it.
    Text(String, String),
    File(String),
    Topic(Mailbox<std_msgs::String>),
}

/// Value of an option, or of the parameter of that name: `create` accepts both.
struct Given<'a> {
    words: &'a [String],
    named: &'a NamedParameters,
}

impl Given<'_> {
    fn text(&self, name: &str) -> Option<String> {
        let word = words::option(self.words, name).map(str::to_owned);
        word.or_else(|| text_of(self.named, name).filter(|text| !text.is_empty()))
    }

    fn number(&self, name: &str) -> Result<f64, String> {
        match words::option(self.words, name) {
            None => Ok(number_of(self.named, name).unwrap_or_default()),
            Some(word) => word
                .trim()
                .parse()
                .ok()
                .filter(|number: &f64| number.is_finite())
                .ok_or_else(|| format!("`-{name} {word}` is not a number")),
        }
    }
}

impl Spawner {
    /// Parses the arguments and parameters of the program. `parameter` returns values of the ROS 1
    /// parameter server, `path` resolves a path for the program.
    ///
    /// # Errors
    /// A message with the error.
    pub(crate) fn new(
        node: &Node,
        (words, named): (&[String], &NamedParameters),
        parameter: &dyn Fn(&str) -> Option<String>,
        path: &dyn Fn(&str) -> String,
        now_ns: i64,
    ) -> Result<Self, String> {
        let given = Given { words, named };
        let from = if let Some(text) = given.text("string") {
            From::Text(text, String::new())
        } else if let Some(file) = given.text("file") {
            From::File(path(&file))
        } else if let Some(model) = given.text("database") {
            From::File(format!("model://{model}"))
        } else if let Some(name) = given.text("param") {
            let text = parameter(&name).or_else(|| text_of(named, &name));
            let text = text.ok_or_else(|| {
                format!("the parameter `{name}` with the robot description is not set")
            })?;
            From::Text(text, name)
        } else if let Some(topic) = given.text("topic") {
            let mailbox = node.mailbox(&topic, Qos::latched(1));
            From::Topic(mailbox.map_err(|error| error.to_string())?)
        } else {
            return Err("no model given; use `-file FILE`, `-topic TOPIC` or \
                        `-param NAME`"
                .into());
        };
        let name = ["entity", "model", "name"].iter().find_map(|name| given.text(name));
        let namespace = given.text("robot_namespace").or_else(|| given.text("namespace"));
        let number = |name: &str| given.number(name);
        let rpy = Rpy { roll: number("R")?, pitch: number("P")?, yaw: number("Y")? };
        Ok(Self {
            from,
            name: name.unwrap_or_default(),
            may_rename: given.text("allow_renaming").is_some_and(|text| text != "false"),
            namespace: namespace.unwrap_or_default(),
            world_from_here: Pose::from_xyz_rpy([number("x")?, number("y")?, number("z")?], rpy),
            since_ns: now_ns,
            has_complained: false,
            place: String::new(),
        })
    }

    /// Sets the launch file line for messages: a description that is a text has no file.
    pub(crate) fn written_at(mut self, line: Option<&str>) -> Self {
        self.place = line.map(|line| format!(" ({line})")).unwrap_or_default();
        self
    }

    /// Description.
    pub(crate) fn told(&self) -> String {
        let place = self.world_from_here.translation;
        let name = if self.name.is_empty() { "its model" } else { &self.name };
        let from = match &self.from {
            From::Text(..) => "its parameter".to_owned(),
            From::File(file) => file.clone(),
            From::Topic(mailbox) => mailbox.topic().to_owned(),
        };
        format!("`{name}` from {from} at ({}, {}, {})", place.x, place.y, place.z)
    }

    fn wait(&mut self, stage: &mut TaskContext<'_>, why: &str) -> Done {
        if stage.now_ns - self.since_ns > WARNING_DELAY_NS && !self.has_complained {
            self.has_complained = true;
            stage.said.push(LaunchLog::warning(format!("`{}` not spawned yet: {why}", self.name)));
        }
        Done::No
    }
}

impl Task for Spawner {
    fn time_went_back(&mut self, by_ns: i64) {
        self.since_ns -= by_ns;
    }

    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        if stage.simulation.is_none() {
            return self
                .wait(stage, "this launch has no world; start the world in the same launch");
        }
        let heard = match &self.from {
            From::Topic(mailbox) => match mailbox.latest() {
                Some(message) => Some(message),
                None => {
                    let why = format!("no message received on {}", mailbox.topic());
                    return self.wait(stage, &why);
                }
            },
            _ => None,
        };
        let from = match &self.from {
            From::Text(text, parameter) => InsertionSource::Text(text, parameter),
            From::File(file) => InsertionSource::File(file),
            From::Topic(mailbox) => {
                InsertionSource::Text(heard.as_ref().map_or("", |text| &text.data), mailbox.topic())
            }
        };
        let arrival = ModelInsertion {
            from,
            name: &self.name,
            may_rename: self.may_rename,
            namespace: &self.namespace,
            world_from_here: self.world_from_here,
            // Only nodes that the plan starts publish transforms.
            with_frames: false,
        };
        let Some(simulation) = stage.simulation.as_deref_mut() else { return Done::No };
        match arrival.bring(simulation, stage.search) {
            Ok(arrived) if arrived.notes.trim().is_empty() => {}
            Ok(arrived) => {
                let intro = match self.place.as_str() {
                    "" => String::new(),
                    place => format!("`{}`{place}:\n", arrived.name),
                };
                stage.said.push(LaunchLog::info(intro + &arrived.notes));
            }
            Err(why) => {
                let Self { name, place, .. } = self;
                stage
                    .said
                    .push(LaunchLog::error(format!("`{name}`{place} was not spawned: {why}")));
            }
        }
        Done::Yes
    }
}
