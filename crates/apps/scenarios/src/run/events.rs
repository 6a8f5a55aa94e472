//! Events of a running scenario.

use std::collections::BTreeMap;

use periplus_faults::FaultInjector;
use periplus_geometry::{Pose, Pose2};
use periplus_graph::{Client, GraphError, Node, Pending, Qos, RawPublisher, parameter_from_yaml};
use periplus_msgs::Format;
use periplus_msgs::rcl_interfaces::{Parameter, SetParameters, SetParametersRequest};
use periplus_ros2cli::{Types, Values};
use periplus_session::nodes::GoalDriver;
use periplus_sim::{InsertionSource, ModelInsertion, Search, Simulation};

use super::observer::Observer;
use crate::file::{EventAction, EventTrigger, Scenario, ScenarioEvent, planar_pose};
use crate::tables::{PublishEventParams, SetParameterEventParams, SpawnEventParams};

/// Events with their states.
pub(super) struct EventRunner {
    events: Vec<(ScenarioEvent, EventState)>,
    publishers: BTreeMap<String, RawPublisher>,
    requests: Vec<ParameterRequest>,
    /// `nav_from_world`: goals are sent in the frame of the navigator.
    nav_from_world: Pose2,
    goal_count: usize,
    search: Search,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum EventState {
    /// The condition does not hold yet.
    Waiting,
    /// The condition holds; the action is due at this time \[ns\].
    Due(i64),
    /// Goal of this number, sent or waiting for those before it.
    Goal(usize),
    /// The action is complete.
    Done,
}

/// A request to set a parameter, and its description.
struct ParameterRequest {
    _client: Client<SetParameters>,
    pending: Pending<SetParameters>,
    what: String,
}

/// Parts of a run that events change.
pub(super) struct EventTargets<'a> {
    pub(super) simulation: &'a mut Simulation,
    pub(super) injector: &'a mut FaultInjector,
    pub(super) goals: Option<&'a mut GoalDriver>,
    pub(super) observer: &'a Observer,
    pub(super) node: &'a Node,
    pub(super) problems: &'a mut Vec<String>,
}

impl EventRunner {
    /// Prepares the events: publishers exist from the start, so that subscribers receive every message.
    pub(super) fn new(
        scenario: &Scenario,
        node: &Node,
        nav_from_world: Pose2,
        search: Search,
    ) -> Result<Self, GraphError> {
        let mut publishers = BTreeMap::new();
        for event in &scenario.events {
            if let EventAction::Publish(PublishEventParams { topic, type_name }, _) = &event.action
                && !publishers.contains_key(topic)
            {
                let type_name = full_type(type_name);
                let publisher = node.raw_publisher(topic, &type_name, None, Qos::reliable(10))?;
                publishers.insert(topic.clone(), publisher);
            }
        }
        let events = scenario.events.iter().map(|event| {
            let mut event = event.clone();
            if let EventAction::Spawn(spawn) = &mut event.action {
                spawn.file = scenario.resolve(&spawn.file).to_string_lossy().into_owned();
            }
            (event, EventState::Waiting)
        });
        Ok(Self {
            events: events.collect(),
            publishers,
            requests: Vec::new(),
            nav_from_world,
            goal_count: 0,
            search,
        })
    }

    /// Number of events that send goals.
    pub(super) fn goal_event_count(&self) -> usize {
        let is_goal = |(event, _): &&(ScenarioEvent, EventState)| {
            matches!(event.action, EventAction::Goal(_))
        };
        self.events.iter().filter(is_goal).count()
    }

    /// Returns true once all goals have ended; false without goals.
    pub(super) fn have_goals_ended(&self, goals: Option<&GoalDriver>) -> bool {
        let count = self.goal_event_count();
        count > 0 && goals.is_some_and(|goals| goals.reports().len() == count)
    }

    /// Goals of the scenario in the order in which they were sent, in the world.
    pub(super) fn goals_in_world(&self) -> Vec<Pose2> {
        let mut sent: Vec<(usize, Pose2)> = self
            .events
            .iter()
            .filter_map(|(event, state)| match (&event.action, state) {
                (EventAction::Goal(goal), EventState::Goal(number)) => {
                    Some((*number, planar_pose(&goal.pose)))
                }
                _ => None,
            })
            .collect();
        sent.sort_by_key(|(number, _)| *number);
        sent.into_iter().map(|(_, pose)| pose).collect()
    }

    /// Runs the events whose time has come; returns true if a model was moved, inserted or removed.
    pub(super) fn update(&mut self, targets: &mut EventTargets<'_>) -> bool {
        self.check_requests(targets.problems);
        let now_ns = targets.simulation.time_ns();
        let mut has_changed = false;
        for index in 0..self.events.len() {
            if self.events[index].1 == EventState::Waiting && self.holds(index, targets) {
                let delay_ns = (self.events[index].0.delay_s * 1e9).round() as i64;
                self.events[index].1 = EventState::Due(now_ns.saturating_add(delay_ns));
            }
            let EventState::Due(due_ns) = self.events[index].1 else { continue };
            if now_ns < due_ns {
                continue;
            }
            let event = self.events[index].0.clone();
            self.events[index].1 = EventState::Done;
            match self.execute(&event, index, targets) {
                Ok(changes) => has_changed |= changes,
                Err(reason) => {
                    let time_s = now_ns as f64 * 1e-9;
                    let word = event.action.word();
                    targets.problems.push(format!("event `{word}` at {time_s:.3} s: {reason}"));
                }
            }
        }
        has_changed
    }

    /// Returns true if the condition of an event holds now.
    fn holds(&self, index: usize, targets: &EventTargets<'_>) -> bool {
        match &self.events[index].0.trigger {
            EventTrigger::Start => true,
            EventTrigger::At(at_s) => targets.simulation.time_ns() as f64 * 1e-9 >= *at_s,
            EventTrigger::Near { point_m: [x, y], radius_m } => {
                targets.simulation.robot_pose().is_some_and(|pose| {
                    let at = pose.translation;
                    libm::hypot(at.x - x, at.y - y) <= *radius_m
                })
            }
            EventTrigger::On { topic, count } => targets.observer.count(topic) >= *count,
            EventTrigger::After(name) => {
                let is_it =
                    |(event, _): &&(ScenarioEvent, EventState)| event.name.as_deref() == Some(name);
                let reports = targets.goals.as_ref().map_or(0, |goals| goals.reports().len());
                self.events.iter().filter(is_it).any(|(_, state)| match state {
                    EventState::Done => true,
                    EventState::Goal(number) => *number < reports,
                    EventState::Waiting | EventState::Due(_) => false,
                })
            }
        }
    }

    fn execute(
        &mut self,
        event: &ScenarioEvent,
        index: usize,
        targets: &mut EventTargets<'_>,
    ) -> Result<bool, String> {
        let now_ns = targets.simulation.time_ns();
        match &event.action {
            EventAction::Goal(goal) => {
                let goals = targets.goals.as_mut().ok_or("there is no navigator")?;
                goals.push(self.nav_from_world * planar_pose(&goal.pose));
                self.events[index].1 = EventState::Goal(self.goal_count);
                self.goal_count += 1;
                Ok(false)
            }
            EventAction::Teleport(teleport) => {
                let robot = targets.simulation.robot_name().map(str::to_owned);
                let model = teleport.model.clone().or(robot).ok_or("there is no robot")?;
                move_to(targets.simulation, &model, &teleport.pose)?;
                Ok(true)
            }
            EventAction::Fault(fault) => {
                let fault = (**fault).clone().starting_at(now_ns as f64 * 1e-9);
                targets
                    .injector
                    .add(targets.simulation, fault)
                    .map_err(|error| error.to_string())?;
                Ok(false)
            }
            EventAction::Spawn(spawn) => {
                self.spawn(spawn, targets.simulation)?;
                Ok(true)
            }
            EventAction::Remove(remove) => {
                if targets.simulation.delete(&remove.model) {
                    return Ok(true);
                }
                Err(unknown_model(targets.simulation, &remove.model))
            }
            EventAction::SetParameter(set) => {
                self.set_parameter(set, targets.node)?;
                Ok(false)
            }
            EventAction::Publish(publish, fields) => {
                self.publish(publish, fields, now_ns)?;
                Ok(false)
            }
        }
    }

    /// Inserts the models of all events that spawn, to read their files.
    ///
    /// # Errors
    /// Files that cannot be read.
    pub(super) fn spawn_all(&self, simulation: &mut Simulation) -> Result<(), String> {
        for (event, _) in &self.events {
            if let EventAction::Spawn(spawn) = &event.action {
                self.spawn(spawn, simulation)?;
            }
        }
        Ok(())
    }

    fn spawn(&self, spawn: &SpawnEventParams, simulation: &mut Simulation) -> Result<(), String> {
        let insertion = ModelInsertion {
            from: InsertionSource::File(&spawn.file),
            name: spawn.name.as_deref().unwrap_or_default(),
            may_rename: false,
            namespace: "",
            world_from_here: Pose::from(planar_pose(&spawn.pose)),
            with_frames: false,
        };
        let inserted = insertion.bring(simulation, &self.search);
        inserted.map(drop).map_err(|error| error.to_string())
    }

    fn set_parameter(&mut self, set: &SetParameterEventParams, node: &Node) -> Result<(), String> {
        let target = format!("/{}", set.node.trim_matches('/'));
        let value = parameter_from_yaml(&set.value).map_err(|error| error.to_string())?;
        let client = node
            .client::<SetParameters>(&format!("{target}/set_parameters"))
            .map_err(|error| error.to_string())?;
        if !client.is_ready() {
            return Err(format!("there is no node `{target}`"));
        }
        let parameter = Parameter { name: set.parameter.as_str().into(), value };
        let pending = client.call(SetParametersRequest { parameters: vec![parameter] });
        let what = format!("parameter `{}` of `{target}`", set.parameter);
        self.requests.push(ParameterRequest { _client: client, pending, what });
        Ok(())
    }

    /// Reads the responses to requests to set parameters.
    fn check_requests(&mut self, problems: &mut Vec<String>) {
        self.requests.retain(|request| match request.pending.take() {
            None => true,
            Some(Ok(response)) => {
                for result in response.results.iter().filter(|result| !result.successful) {
                    problems.push(format!("{} was not set: {}", request.what, result.reason));
                }
                false
            }
            Some(Err(error)) => {
                problems.push(format!("{} was not set: {error}", request.what));
                false
            }
        });
    }

    fn publish(
        &self,
        publish: &PublishEventParams,
        fields: &str,
        now_ns: i64,
    ) -> Result<(), String> {
        let values = Values::read(fields).map_err(|error| error.to_string())?;
        let types = Types::Builtin;
        let layout = types.message(&publish.type_name).map_err(|error| error.to_string())?;
        let message = values.message(layout, now_ns).map_err(|error| error.to_string())?;
        let mut cdr = Vec::new();
        message.encode(Format::CDR, &mut cdr).map_err(|error| error.to_string())?;
        if let Some(publisher) = self.publishers.get(&publish.topic) {
            publisher.publish(cdr);
        }
        Ok(())
    }
}

/// Moves a model in the plane, with its height.
fn move_to(simulation: &mut Simulation, model: &str, to: &[f64]) -> Result<(), String> {
    let Some(before) = simulation.model_pose(model) else {
        return Err(unknown_model(simulation, model));
    };
    let mut planar = planar_pose(to);
    if to.len() < 3 {
        planar.yaw_rad = Pose2::from(before).yaw_rad;
    }
    let mut target = Pose::from(planar);
    target.translation.z = before.translation.z;
    if simulation.set_pose(model, target) {
        Ok(())
    } else {
        Err(format!("`{model}` cannot be moved to {to:?}"))
    }
}

fn unknown_model(simulation: &Simulation, model: &str) -> String {
    let models: Vec<&str> = simulation.models().collect();
    format!("there is no model `{model}`; the world has {}", models.join(", "))
}

/// Type name with its middle part: `std_msgs/String` is `std_msgs/msg/String`.
fn full_type(name: &str) -> String {
    match name.split('/').collect::<Vec<_>>().as_slice() {
        [package, name] => format!("{package}/msg/{name}"),
        _ => name.to_owned(),
    }
}
