//! Spawner and unspawner of controllers, as the programs of `controller_manager`.
//!
//! Source: `controller_manager/spawner.py` and `unspawner.py` of `ros2_control`, and
//! `controller_manager/scripts/spawner` of `ros_control`.

mod clients;
mod options;

use std::collections::VecDeque;

use periplus_graph::{Level, Node};
use periplus_msgs::rcl_interfaces::{Parameter, ParameterType, ParameterValue};

use self::clients::{Clients, Reply};
use super::{Done, Task, TaskContext};
use crate::bringup::report::LaunchLog;

pub(crate) use options::{SpawnerKind, SpawnerOptions};

/// Time after which a missing controller manager is logged \[ns\].
const WARNING_DELAY_NS: i64 = 5_000_000_000;

/// Request to a controller manager.
#[derive(Clone, Debug, PartialEq)]
enum Step {
    /// Skips the loading of a controller that is loaded already.
    List(String),
    SetParameters(String),
    Load(String),
    Configure(String),
    Activate(Vec<String>),
    Deactivate(Vec<String>),
    Unload(String),
}

/// Loads, configures and activates controllers, or unloads them.
pub(crate) struct ControllerSpawner {
    node: Node,
    options: SpawnerOptions,
    /// Full name of the controller manager.
    manager: String,
    clients: Option<Clients>,
    steps: VecDeque<Step>,
    pending: Option<Reply>,
    since_ns: i64,
    has_complained: bool,
    /// Parameters of a controller as a text, for ROS 1.
    texts: Vec<(String, String)>,
}

impl ControllerSpawner {
    /// Creates the task. `texts` has the parameters of controllers of ROS 1, as files of ROS 2.
    pub(crate) fn new(
        node: Node,
        options: SpawnerOptions,
        texts: Vec<(String, String)>,
        now_ns: i64,
    ) -> Self {
        let manager = options.manager_of(node.names().namespace());
        let steps = steps(&options);
        Self {
            node,
            options,
            manager,
            clients: None,
            steps,
            pending: None,
            since_ns: now_ns,
            has_complained: false,
            texts,
        }
    }

    /// Description.
    pub(crate) fn told(&self) -> String {
        let verb = match self.options.kind {
            SpawnerKind::Spawner => "starts",
            SpawnerKind::Unspawner => "unloads",
        };
        format!("{verb} {} in {}", self.options.names.join(", "), self.manager)
    }

    fn log(&self, stage: &mut TaskContext<'_>, level: Level, text: &str) {
        self.node.log(level, text);
        stage.said.push(LaunchLog::of_launch(level, format!("{}: {text}", self.node.full_name())));
    }

    /// Connects to the controller manager once it exists.
    fn connect(&mut self, stage: &mut TaskContext<'_>) -> Done {
        match Clients::connect(&self.node, stage.graph, &self.manager) {
            Ok(Some(clients)) => self.clients = Some(clients),
            Ok(None) => {
                let waited_ns = stage.now_ns - self.since_ns;
                if waited_ns > WARNING_DELAY_NS && !self.has_complained {
                    self.has_complained = true;
                    let text = format!(
                        "waiting for the controller manager {}: a robot needs a plugin of \
                         gz_ros2_control, gazebo_ros2_control or gazebo_ros_control",
                        self.manager
                    );
                    self.log(stage, Level::Warn, &text);
                }
                let timeout_ns = self.options.manager_timeout_s * 1e9;
                if timeout_ns > 0.0 && waited_ns as f64 > timeout_ns {
                    let text = format!("the controller manager {} is not available", self.manager);
                    self.log(stage, Level::Error, &text);
                    return Done::Yes;
                }
            }
            Err(error) => {
                self.log(stage, Level::Error, &error);
                return Done::Yes;
            }
        }
        Done::No
    }

    /// Parameters that the manager gets before it loads a controller.
    fn parameters(&self, name: &str) -> Vec<Parameter> {
        let texts = |values: &[String]| ParameterValue {
            r#type: ParameterType::PARAMETER_STRING_ARRAY,
            string_array_value: values.to_vec(),
            ..ParameterValue::default()
        };
        let text = |value: &str| ParameterValue {
            r#type: ParameterType::PARAMETER_STRING,
            string_value: value.to_owned(),
            ..ParameterValue::default()
        };
        let options = &self.options;
        let mut all = Vec::new();
        let mut add = |part: &str, value: ParameterValue| {
            all.push(Parameter { name: format!("{name}.{part}"), value });
        };
        if let Some(class) = &options.class {
            add("type", text(class));
        }
        if !options.parameter_files.is_empty() {
            add("params_file", texts(&options.parameter_files));
        }
        if !options.ros_arguments.is_empty() {
            add("node_options_args", texts(&options.ros_arguments));
        }
        if let Some((_, yaml)) = self.texts.iter().find(|(known, _)| known == name) {
            add("params_text", text(yaml));
        }
        all
    }

    /// Sends the next request; returns false when all are done.
    fn send(&mut self) -> bool {
        while let Some(step) = self.steps.front() {
            let Some(clients) = &self.clients else { return true };
            let reply = match step {
                Step::List(_) => clients.list(),
                Step::SetParameters(name) => {
                    let parameters = self.parameters(name);
                    if parameters.is_empty() {
                        self.steps.pop_front();
                        continue;
                    }
                    clients.set(parameters)
                }
                Step::Load(name) => clients.load(name),
                Step::Configure(name) => clients.configure(name),
                Step::Activate(names) => clients.switch(names, &[]),
                Step::Deactivate(names) => clients.switch(&[], names),
                Step::Unload(name) => clients.unload(name),
            };
            self.pending = Some(reply);
            return true;
        }
        false
    }

    /// Processes the answer to a request.
    fn receive(
        &mut self,
        stage: &mut TaskContext<'_>,
        answer: Result<Vec<String>, String>,
    ) -> Done {
        let Some(step) = self.steps.pop_front() else { return Done::No };
        match (step, answer) {
            (Step::List(name), Ok(loaded)) => {
                if loaded.contains(&name) {
                    let text = format!("`{name}` is already loaded");
                    self.log(stage, Level::Info, &text);
                    let skips = |step: &Step| {
                        *step != Step::Load(name.clone())
                            && *step != Step::SetParameters(name.clone())
                    };
                    self.steps.retain(skips);
                }
            }
            (Step::Activate(names), Ok(_)) => {
                let text = format!("configured and activated {}", names.join(", "));
                self.log(stage, Level::Info, &text);
            }
            (Step::Unload(name), Ok(_)) => {
                self.log(stage, Level::Info, &format!("unloaded {name}"));
            }
            (_, Ok(_)) => {}
            // A controller that is not active need not be deactivated.
            (Step::Deactivate(_), Err(_)) => {}
            (step, Err(reason)) => {
                let what = match &step {
                    Step::List(name) => format!("list the controllers for `{name}`"),
                    Step::SetParameters(name) => format!("set the parameters of `{name}`"),
                    Step::Load(name) => format!("load `{name}`"),
                    Step::Configure(name) => format!("configure `{name}`"),
                    Step::Activate(names) => format!("activate {}", names.join(", ")),
                    Step::Deactivate(names) => format!("deactivate {}", names.join(", ")),
                    Step::Unload(name) => format!("unload `{name}`"),
                };
                let text = format!("failed to {what}{reason}");
                self.log(stage, Level::Error, &text);
                return Done::Yes;
            }
        }
        Done::No
    }
}

/// Requests of a spawner or unspawner, in their order.
fn steps(options: &SpawnerOptions) -> VecDeque<Step> {
    let mut steps = VecDeque::new();
    let names = &options.names;
    if options.kind == SpawnerKind::Unspawner {
        steps.push_back(Step::Deactivate(names.clone()));
        steps.extend(names.iter().cloned().map(Step::Unload));
        return steps;
    }
    for name in names {
        steps.push_back(Step::List(name.clone()));
        steps.push_back(Step::SetParameters(name.clone()));
        steps.push_back(Step::Load(name.clone()));
        if !options.loads_only {
            steps.push_back(Step::Configure(name.clone()));
            if !options.stays_inactive && !options.activates_as_group {
                steps.push_back(Step::Activate(vec![name.clone()]));
            }
        }
    }
    if options.activates_as_group && !options.stays_inactive && !options.loads_only {
        steps.push_back(Step::Activate(names.clone()));
    }
    steps
}

impl Task for ControllerSpawner {
    fn time_went_back(&mut self, by_ns: i64) {
        self.since_ns -= by_ns;
    }

    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        if self.clients.is_none() && self.connect(stage) == Done::Yes {
            return Done::Yes;
        }
        if self.clients.is_none() {
            return Done::No;
        }
        loop {
            if let Some(pending) = &self.pending {
                let Some(answer) = pending.take() else { return Done::No };
                self.pending = None;
                if self.receive(stage, answer) == Done::Yes {
                    return Done::Yes;
                }
            }
            if !self.send() {
                // With `-u` it waits for the end of the launch.
                return if self.options.unloads_at_end { Done::No } else { Done::Yes };
            }
            stage.graph.settle();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(line: &str) -> Vec<Step> {
        let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
        let options = SpawnerOptions::read(SpawnerKind::Spawner, &words, &|path| path.to_owned());
        steps(&options.unwrap()).into()
    }

    #[test]
    fn one_after_the_other_or_as_a_group() {
        let [a, b] = ["a", "b"].map(str::to_owned);
        let each = |name: &String| {
            [
                Step::List(name.clone()),
                Step::SetParameters(name.clone()),
                Step::Load(name.clone()),
                Step::Configure(name.clone()),
            ]
        };
        let single = |name: &String| Step::Activate(vec![name.clone()]);
        let mut expected = each(&a).to_vec();
        expected.push(single(&a));
        expected.extend(each(&b));
        expected.push(single(&b));
        assert_eq!(of("a b"), expected);
        let group =
            [each(&a).to_vec(), each(&b).to_vec(), vec![Step::Activate(vec![a.clone(), b])]];
        assert_eq!(of("a b --activate-as-group"), group.concat());
        assert_eq!(of("a --inactive"), each(&a));
        assert_eq!(of("a --load-only"), each(&a)[..3]);
    }
}
