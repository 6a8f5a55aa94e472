//! The section `events`.

use periplus_diagnostics::{Diagnostic, Diagnostics, Span};
use periplus_faults::{InjectedFault, read_fault, read_section};
use periplus_yaml::{YamlNode, YamlValue};

use super::{check_pose, find_table, split};
use crate::tables::{
    EVENTS, FAULT_EVENT, GoalEventParams, PublishEventParams, RemoveEventParams,
    SetParameterEventParams, SpawnEventParams, TRIGGER, TeleportEventParams, TriggerParams,
};

/// An event of a scenario.
#[derive(Clone, Debug)]
pub struct ScenarioEvent {
    /// Name, for `after`.
    pub name: Option<String>,
    /// Condition.
    pub trigger: EventTrigger,
    /// Delay after the condition \[s\].
    pub delay_s: f64,
    /// Action.
    pub action: EventAction,
    /// Source location.
    pub span: Span,
}

/// Condition of an event.
#[derive(Clone, Debug, PartialEq)]
pub enum EventTrigger {
    /// The start of the run.
    Start,
    /// A simulated time \[s\].
    At(f64),
    /// The robot enters a circle about a point \[m\].
    Near {
        /// Point in the world \[m\].
        point_m: [f64; 2],
        /// Radius \[m\].
        radius_m: f64,
    },
    /// The Nth message on a topic.
    On {
        /// Full name of the topic.
        topic: String,
        /// Number of the message, from 1.
        count: usize,
    },
    /// Another event has happened; a goal has ended.
    After(String),
}

/// Action of an event.
#[derive(Clone, Debug, PartialEq)]
pub enum EventAction {
    /// Sends a goal.
    Goal(GoalEventParams),
    /// Moves a model.
    Teleport(TeleportEventParams),
    /// Starts a fault; its time window counts from the event.
    Fault(Box<InjectedFault>),
    /// Inserts a model.
    Spawn(SpawnEventParams),
    /// Removes a model.
    Remove(RemoveEventParams),
    /// Sets a parameter of a node.
    SetParameter(SetParameterEventParams),
    /// Publishes a message; its fields are YAML.
    Publish(PublishEventParams, String),
}

impl EventAction {
    /// Word of the action in a file.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Goal(_) => "goal",
            Self::Teleport(_) => "teleport",
            Self::Fault(_) => FAULT_EVENT,
            Self::Spawn(_) => "spawn",
            Self::Remove(_) => "remove",
            Self::SetParameter(_) => "set_parameter",
            Self::Publish(..) => "publish",
        }
    }
}

pub(super) fn read_list(node: &YamlNode, diagnostics: &mut Diagnostics) -> Vec<ScenarioEvent> {
    let Some(items) = node.list() else {
        let message = format!("`events` is {}; it must be a list", node.kind());
        let help = "write `- goal: [2, 1, 0]` or `- {at: 5, teleport: [0, 0]}`";
        diagnostics.push(Diagnostic::error("bad-events", message).at(node.span).help(help));
        return Vec::new();
    };
    let events: Vec<ScenarioEvent> =
        items.iter().filter_map(|item| read(item, diagnostics)).collect();
    for event in &events {
        if let EventTrigger::After(name) = &event.trigger {
            let names = || events.iter().filter_map(|event| event.name.as_deref());
            if names().all(|other| other != name) {
                let message = format!("there is no event with the name `{name}`");
                diagnostics.push(
                    Diagnostic::error("unknown-event", message)
                        .at(event.span)
                        .did_you_mean(event.span, name, names())
                        .help(format!("add `name: {name}` to the event that it follows")),
                );
            }
        }
    }
    events
}

fn read(item: &YamlNode, diagnostics: &mut Diagnostics) -> Option<ScenarioEvent> {
    let Some(entries) = item.entries() else {
        let message = format!("an event is {}; it must be a mapping", item.kind());
        let help = "write `goal: [2, 1, 0]` or `{at: 5, teleport: [0, 0]}`";
        diagnostics.push(Diagnostic::error("bad-event", message).at(item.span).help(help));
        return None;
    };
    let is_trigger = |key: &YamlNode| TRIGGER.find(key.text().unwrap_or_default()).is_some();
    let (triggers, actions): (Vec<_>, Vec<_>) =
        entries.iter().cloned().partition(|(key, _)| is_trigger(key));
    let [(key, value)] = actions.as_slice() else {
        let words: Vec<&str> = EVENTS.iter().map(|it| it.name).chain([FAULT_EVENT]).collect();
        let message = match actions.len() {
            0 => "the event does nothing".to_owned(),
            count => format!("the event has {count} actions; write one event for each"),
        };
        let note = format!("actions: {}", words.join(", "));
        let at = actions.get(1).map_or(item.span, |(key, _)| key.span);
        diagnostics.push(Diagnostic::error("bad-event", message).at(at).note(note));
        return None;
    };
    let section = YamlNode { value: YamlValue::Map(triggers), ..item.clone() };
    let params = TriggerParams::from_values(&read_section(&TRIGGER, &section, diagnostics));
    let trigger = trigger(&params, item, diagnostics)?;
    let action = action(key, value, diagnostics)?;
    let TriggerParams { name, delay_s, .. } = params;
    Some(ScenarioEvent { name, trigger, delay_s, action, span: key.span })
}

fn trigger(
    params: &TriggerParams,
    item: &YamlNode,
    diagnostics: &mut Diagnostics,
) -> Option<EventTrigger> {
    let mut found = Vec::new();
    if let Some(at_s) = params.at_s {
        found.push(EventTrigger::At(at_s));
    }
    if let Some(topic) = &params.on {
        let topic = format!("/{}", topic.trim_start_matches('/'));
        found.push(EventTrigger::On { topic, count: params.count });
    }
    if let Some(name) = &params.after {
        found.push(EventTrigger::After(name.clone()));
    }
    match params.near_m.as_slice() {
        [] => {}
        [x, y] => found.push(EventTrigger::Near { point_m: [*x, *y], radius_m: 0.5 }),
        [x, y, radius] => {
            found.push(EventTrigger::Near { point_m: [*x, *y], radius_m: *radius });
        }
        _ => {
            let at = item.get("near").map_or(item.span, |near| near.span);
            let message = "`near` needs [x, y] or [x, y, radius]";
            diagnostics.push(Diagnostic::error("bad-value", message).at(at));
            return None;
        }
    }
    if found.len() > 1 {
        let message = "an event has one of `at`, `near`, `on` and `after`";
        diagnostics.push(Diagnostic::error("bad-event", message).at(item.span));
        return None;
    }
    Some(found.pop().unwrap_or(EventTrigger::Start))
}

fn action(key: &YamlNode, value: &YamlNode, diagnostics: &mut Diagnostics) -> Option<EventAction> {
    let word = key.text().unwrap_or_default();
    if word == FAULT_EVENT {
        return read_fault(value, diagnostics).map(|fault| EventAction::Fault(Box::new(fault)));
    }
    let known = EVENTS.iter().any(|table| table.name == word);
    if !known {
        let names = || EVENTS.iter().map(|it| it.name).chain(TRIGGER.names()).chain([FAULT_EVENT]);
        diagnostics.push(
            Diagnostic::error("unknown-word", format!("an event has no `{word}`"))
                .at(key.span)
                .did_you_mean(key.span, word, names())
                .note(format!("known: {}", names().collect::<Vec<_>>().join(", "))),
        );
        return None;
    }
    let table = find_table(&EVENTS, word, key.span, "event", diagnostics)?;
    let (own, message) =
        if word == "publish" { split(value, "message") } else { (value.clone(), None) };
    let values = read_section(table, &own, diagnostics);
    let mut pose = |numbers: &[f64]| {
        let span = value.get("pose").map_or(value.span, |pose| pose.span);
        check_pose(numbers, "pose", span, diagnostics);
    };
    Some(match table.name {
        "goal" => {
            let params = GoalEventParams::from_values(&values);
            pose(&params.pose);
            EventAction::Goal(params)
        }
        "teleport" => {
            let params = TeleportEventParams::from_values(&values);
            pose(&params.pose);
            EventAction::Teleport(params)
        }
        "spawn" => {
            let params = SpawnEventParams::from_values(&values);
            pose(&params.pose);
            EventAction::Spawn(params)
        }
        "remove" => EventAction::Remove(RemoveEventParams::from_values(&values)),
        "set_parameter" => EventAction::SetParameter(SetParameterEventParams::from_values(&values)),
        _ => {
            let fields = message.as_ref().map(flow_text).unwrap_or_default();
            EventAction::Publish(PublishEventParams::from_values(&values), fields)
        }
    })
}

/// YAML of a tree in flow style.
fn flow_text(node: &YamlNode) -> String {
    let quoted = |text: &str| format!("'{}'", text.replace('\'', "''"));
    match &node.value {
        YamlValue::Scalar { text, is_plain: true } => text.clone(),
        YamlValue::Scalar { text, .. } => quoted(text),
        YamlValue::List(items) => {
            format!("[{}]", items.iter().map(flow_text).collect::<Vec<_>>().join(", "))
        }
        YamlValue::Map(entries) => {
            let entry = |(key, value): &(YamlNode, YamlNode)| {
                format!("{}: {}", quoted(key.text().unwrap_or_default()), flow_text(value))
            };
            format!("{{{}}}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
        }
    }
}
