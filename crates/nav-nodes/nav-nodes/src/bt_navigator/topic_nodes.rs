//! Tree nodes that subscribe to topics or serve services.
//!
//! Source: `*_selector_node.cpp`, `goal_updater_node.cpp`, `is_battery_*_condition.cpp`,
//! `pause_resume_controller.cpp`.

use std::sync::Arc;

use periplus_behavior_tree::{BehaviorNode, NodeRun, NodeStatus, TreeError, TreeValue};
use periplus_graph::{Calls, Level, Mailbox, Qos};
use periplus_msgs::Message;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Goals;
use periplus_msgs::sensor_msgs::BatteryState;
use periplus_msgs::std_msgs;
use periplus_msgs::std_srvs::{Trigger, TriggerResponse};

use super::shared::Shared;

/// Depth of subscriptions.
const DEPTH: usize = 10;

/// Subscription whose topic is known at the first tick.
struct LazyMailbox<T: Message> {
    topic: String,
    mailbox: Option<Mailbox<T>>,
}

impl<T: Message> Default for LazyMailbox<T> {
    fn default() -> Self {
        Self { topic: String::new(), mailbox: None }
    }
}

impl<T: Message> LazyMailbox<T> {
    /// Newest message since the last call.
    fn latest(
        &mut self,
        shared: &Shared,
        topic: &str,
        qos: Qos,
        run: &NodeRun<'_>,
    ) -> Result<Option<Arc<T>>, TreeError> {
        if self.mailbox.is_none() || self.topic != topic {
            let mailbox = shared.node.mailbox(topic, qos);
            self.mailbox = Some(mailbox.map_err(|error| run.error(error.to_string()))?);
            self.topic = topic.to_owned();
        }
        Ok(self.mailbox.as_ref().and_then(Mailbox::latest))
    }
}

/// Selector of a plugin: the name that a topic published last, or a default.
pub(super) struct Selector {
    shared: Arc<Shared>,
    /// Ports of the default and the output.
    ports: [String; 2],
    topic: LazyMailbox<std_msgs::String>,
    selected: String,
}

impl Selector {
    pub(super) fn new(shared: Arc<Shared>, plugin: &str) -> Self {
        let ports = [format!("default_{plugin}"), format!("selected_{plugin}")];
        Self { shared, ports, topic: LazyMailbox::default(), selected: String::new() }
    }
}

impl BehaviorNode for Selector {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let topic = run.input_text("topic_name").ok_or_else(|| run.missing("topic_name"))?;
        let latest = self.topic.latest(&self.shared, &topic, Qos::latched(1), run)?;
        if let Some(message) = latest {
            self.selected.clone_from(&message.data);
        }
        let [default, output] = &self.ports;
        if self.selected.is_empty() {
            self.selected = run.input_text(default).unwrap_or_default();
            if self.selected.is_empty() {
                return Ok(NodeStatus::Failure);
            }
        }
        run.set_output(output, self.selected.as_str())?;
        Ok(NodeStatus::Success)
    }
}

/// `GoalUpdater`: replaces goals by those of a topic that are not older, and ticks its child.
pub(super) struct GoalUpdater {
    shared: Arc<Shared>,
    goal_topic: LazyMailbox<PoseStamped>,
    goals_topic: LazyMailbox<Goals>,
    goal: Option<Arc<PoseStamped>>,
    goals: Option<Arc<Goals>>,
}

impl GoalUpdater {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        Self {
            shared,
            goal_topic: LazyMailbox::default(),
            goals_topic: LazyMailbox::default(),
            goal: None,
            goals: None,
        }
    }

    /// True if a message is used in place of a goal by their stamps.
    fn replaces(&self, new_ns: i64, old_ns: i64) -> bool {
        if new_ns == 0 {
            self.shared.node.log(Level::Warn, "The received goal has no timestamp. Ignoring.");
        }
        new_ns != 0 && new_ns >= old_ns
    }
}

impl BehaviorNode for GoalUpdater {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let params = &self.shared.params;
        let qos = Qos::reliable(DEPTH);
        let goal = self.goal_topic.latest(&self.shared, &params.goal_updater_topic, qos, run)?;
        self.goal = goal.or(self.goal.take());
        let goals = self.goals_topic.latest(&self.shared, &params.goals_updater_topic, qos, run)?;
        self.goals = goals.or(self.goals.take());
        let mut goal: PoseStamped = run.input_object("input_goal").unwrap_or_default();
        if let Some(new) = &self.goal
            && self.replaces(new.header.stamp.ns(), goal.header.stamp.ns())
        {
            goal = (**new).clone();
        }
        run.set_output("output_goal", TreeValue::object(goal))?;
        let mut goals: Goals = run.input_object("input_goals").unwrap_or_default();
        if let Some(new) = self.goals.as_ref().filter(|new| !new.goals.is_empty())
            && self.replaces(new.header.stamp.ns(), goals.header.stamp.ns())
        {
            goals = (**new).clone();
        }
        run.set_output("output_goals", TreeValue::object(goals))?;
        run.tick_child(0)
    }
}

/// Check of the last battery message.
#[derive(Clone, Copy)]
pub(super) enum BatteryCheck {
    /// Percentage or voltage is at most `min_battery`.
    Low,
    /// The battery is being charged.
    Charging,
}

/// `IsBatteryLow` and `IsBatteryCharging`.
pub(super) struct Battery {
    shared: Arc<Shared>,
    check: BatteryCheck,
    topic: LazyMailbox<BatteryState>,
    last: Option<Arc<BatteryState>>,
}

impl Battery {
    pub(super) fn new(shared: Arc<Shared>, check: BatteryCheck) -> Self {
        Self { shared, check, topic: LazyMailbox::default(), last: None }
    }
}

impl BehaviorNode for Battery {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let topic = run.input_text("battery_topic").ok_or_else(|| run.missing("battery_topic"))?;
        let new = self.topic.latest(&self.shared, &topic, Qos::reliable(DEPTH), run)?;
        self.last = new.or(self.last.take());
        let Some(last) = &self.last else { return Ok(NodeStatus::Failure) };
        let is_true = match self.check {
            BatteryCheck::Charging => {
                last.power_supply_status == BatteryState::POWER_SUPPLY_STATUS_CHARGING
            }
            BatteryCheck::Low => {
                let min = run.input_f64("min_battery").ok_or_else(|| run.missing("min_battery"))?;
                let is_voltage = run.input_bool("is_voltage").unwrap_or_default();
                f64::from(if is_voltage { last.voltage } else { last.percentage }) <= min
            }
        };
        Ok(if is_true { NodeStatus::Success } else { NodeStatus::Failure })
    }
}

/// State of `PauseResumeController`; each has a child.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PauseState {
    Resumed,
    Paused,
    OnPause,
    OnResume,
}

impl PauseState {
    /// Index of the child.
    fn child(self) -> usize {
        match self {
            Self::Resumed => 0,
            Self::Paused => 1,
            Self::OnPause => 2,
            Self::OnResume => 3,
        }
    }
}

/// `PauseResumeController`: two services switch between its children.
pub(super) struct PauseResume {
    shared: Arc<Shared>,
    state: PauseState,
    services: Option<[Calls<Trigger>; 2]>,
}

impl PauseResume {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        Self { shared, state: PauseState::Resumed, services: None }
    }

    /// Answers requests; true if the state changed.
    fn serve(&mut self, run: &NodeRun<'_>) -> Result<bool, TreeError> {
        if self.services.is_none() {
            let serve = |port: &str| {
                let name = run.input_text(port).ok_or_else(|| run.missing(port))?;
                let server = self.shared.node.server::<Trigger>(&name);
                server.map_err(|error| run.error(error.to_string()))
            };
            self.services = Some([serve("pause_service_name")?, serve("resume_service_name")?]);
        }
        let Some([pause, resume]) = &self.services else { return Ok(false) };
        let before = self.state;
        while let Some(call) = pause.take() {
            let success = self.state != PauseState::Paused;
            if success {
                self.state = PauseState::OnPause;
            }
            call.answer(response(success, "PauseResumeController BT node already in state PAUSED"));
        }
        while let Some(call) = resume.take() {
            let success = self.state == PauseState::Paused;
            if success {
                self.state = PauseState::OnResume;
            }
            call.answer(response(success, "PauseResumeController BT node not in state PAUSED"));
        }
        Ok(self.state != before)
    }

    fn next(&mut self) {
        self.state = match self.state {
            PauseState::OnPause => PauseState::Paused,
            PauseState::OnResume => PauseState::Resumed,
            state => state,
        };
    }
}

fn response(success: bool, message: &str) -> TriggerResponse {
    let message = if success { String::new() } else { message.to_owned() };
    TriggerResponse { success, message }
}

impl BehaviorNode for PauseResume {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let count = run.child_count();
        if count > 4 {
            return Err(run.error(format!("the node has {count} children, and must have 1 to 4")));
        }
        if run.status() == NodeStatus::Idle {
            self.state = PauseState::Resumed;
        }
        run.set_running();
        if self.serve(run)? {
            run.halt_children()?;
        }
        if count <= self.state.child() {
            self.next();
            return Ok(NodeStatus::Running);
        }
        match run.tick_child(self.state.child())? {
            NodeStatus::Success | NodeStatus::Skipped if self.state == PauseState::Resumed => {
                Ok(NodeStatus::Success)
            }
            NodeStatus::Failure => Ok(NodeStatus::Failure),
            NodeStatus::Running => Ok(NodeStatus::Running),
            _ => {
                self.next();
                Ok(NodeStatus::Running)
            }
        }
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.state = PauseState::Resumed;
        Ok(())
    }
}
