//! Driving without a person: a script or a recording, played on the graph.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;

use periplus_bags::Reader;
use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};
use periplus_graph::{GraphError, Node, NodeSettings, Publisher, Qos};
use periplus_host::Machine;
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_resources::Host as _;
use periplus_script::{Body, Pilot, Script};

use crate::Simulation;

/// Time between velocities towards a goal \[ns\].
const STEER_NS: i64 = 50_000_000;

/// Plays a script. Without one it does nothing.
#[derive(Default)]
pub struct Driver {
    script: Script,
    /// The next of the script's commands.
    next: usize,
    pilot: Option<Pilot>,
    steer_ns: i64,
    topics: BTreeMap<String, Outlet>,
}

/// What a script's file gave beside the driver.
#[derive(Debug, Default)]
pub struct ScriptFindings {
    /// The text.
    pub sources: SourceMap,
    /// What is wrong with it.
    pub diagnostics: Diagnostics,
}

enum Outlet {
    Twist(Publisher<Twist>),
    Stamped(Publisher<TwistStamped>),
}

impl Driver {
    /// Reads a script (YAML), or takes the commands of a recording (`.mcap`).
    #[must_use]
    pub fn read(path: &Path) -> (Self, ScriptFindings) {
        let mut findings = ScriptFindings::default();
        let is_bag = path.extension().is_some_and(|extension| extension == "mcap");
        let script =
            if is_bag { replayed(path, &mut findings) } else { written(path, &mut findings) };
        (Self::new(script), findings)
    }

    /// Plays a script from its start.
    #[must_use]
    pub fn new(script: Script) -> Self {
        let pilot = (!script.goals.is_empty()).then(|| Pilot::new(script.goals.clone()));
        Self { script, pilot, ..Self::default() }
    }

    /// Makes the publishers of the script's topics.
    ///
    /// # Errors
    /// When a name is not valid, or a topic has another type.
    pub fn join(&mut self, simulation: &Simulation) -> Result<(), GraphError> {
        if self.script.commands.is_empty() && self.pilot.is_none() {
            return Ok(());
        }
        let mut settings = NodeSettings::new("script");
        for rule in simulation.remaps() {
            settings = settings.rule(rule);
        }
        let node = simulation.graph().node(settings)?;
        for command in &self.script.commands {
            if !self.topics.contains_key(&command.topic) {
                let is_stamped = matches!(command.body, Body::TwistStamped(_));
                let outlet = outlet(&node, &command.topic, is_stamped)?;
                self.topics.insert(command.topic.clone(), outlet);
            }
        }
        let topic = &self.script.goal_topic;
        if self.pilot.is_some() && !self.topics.contains_key(topic) {
            let outlet = outlet(&node, topic, self.script.goals_are_stamped)?;
            self.topics.insert(topic.clone(), outlet);
        }
        Ok(())
    }

    /// Begins again, after time went back.
    pub fn restart(&mut self) {
        self.next = 0;
        self.steer_ns = 0;
        self.pilot = self.pilot.is_some().then(|| Pilot::new(self.script.goals.clone()));
    }

    /// Publishes what is due.
    pub fn play(&mut self, simulation: &Simulation) {
        let now_ns = simulation.time_ns();
        while let Some(command) = self.script.commands.get(self.next) {
            if command.time_ns > now_ns {
                break;
            }
            self.send(&command.topic, command.body.clone());
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
            self.send(&self.script.goal_topic, body);
            // The last word was to stand.
            if velocity.is_none() {
                self.pilot = None;
            }
        }
    }

    /// When it next has something to say \[ns\].
    #[must_use]
    pub fn next_ns(&self) -> Option<i64> {
        let command = self.script.commands.get(self.next).map(|command| command.time_ns);
        let steer = self.pilot.is_some().then_some(self.steer_ns);
        [command, steer].into_iter().flatten().min()
    }

    fn send(&self, topic: &str, body: Body) {
        match (self.topics.get(topic), body) {
            (Some(Outlet::Twist(publisher)), Body::Twist(twist)) => publisher.publish(twist),
            (Some(Outlet::Stamped(publisher)), Body::TwistStamped(twist)) => {
                publisher.publish(twist);
            }
            // A script that says both on one topic: the first decided, the rest cannot be said.
            _ => {}
        }
    }
}

fn outlet(node: &Node, topic: &str, is_stamped: bool) -> Result<Outlet, GraphError> {
    let qos = Qos::reliable(10);
    Ok(if is_stamped {
        Outlet::Stamped(node.publisher(topic, qos)?)
    } else {
        Outlet::Twist(node.publisher(topic, qos)?)
    })
}

fn written(path: &Path, findings: &mut ScriptFindings) -> Script {
    match Machine.read(path) {
        Ok(bytes) => {
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let file = findings.sources.add(path.display().to_string(), text);
            periplus_script::read(file, &findings.sources, &mut findings.diagnostics)
        }
        Err(error) => {
            findings.diagnostics.push(unreadable(path, &error.to_string()));
            Script::default()
        }
    }
}

#[allow(clippy::disallowed_methods, reason = "recordings are read in pieces, not as a whole")]
fn replayed(path: &Path, findings: &mut ScriptFindings) -> Script {
    let commands = File::open(path)
        .map_err(|error| error.to_string())
        .and_then(|file| Reader::open(file).map_err(|error| error.to_string()))
        .and_then(|mut bag| {
            periplus_script::replay(&mut bag, &mut findings.diagnostics)
                .map_err(|error| error.to_string())
        });
    match commands {
        Ok(commands) => Script { commands, ..Script::default() },
        Err(error) => {
            findings.diagnostics.push(unreadable(path, &error));
            Script::default()
        }
    }
}

fn unreadable(path: &Path, why: &str) -> Diagnostic {
    Diagnostic::error("unreadable-file", format!("`{}` cannot be read: {why}", path.display()))
        .help("give a script (YAML) or a recording (.mcap)")
}
