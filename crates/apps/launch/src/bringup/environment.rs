//! Environment of a world: its search paths, and the launch file lines that set them.

use std::collections::BTreeMap;

use crate::{PlanStep, Running};
use periplus_resources::SEARCH_VARIABLES;

use crate::bringup::world::WorldRequest;

/// Maximum length of a variable's value in messages.
const MAX_SHOWN_CHARS: usize = 200;

/// Environment variables that differ from those of the launch; `None` for an unset one.
pub type Environment = BTreeMap<String, Option<String>>;

/// Position at which a launch file changes an environment variable.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VariableSetting {
    name: String,
    value: Option<String>,
    written: Option<String>,
}

/// Positions in the steps of a plan, without duplicates.
pub(crate) fn settings(steps: &[PlanStep]) -> Vec<VariableSetting> {
    let mut settings = Vec::new();
    for (name, variable) in steps.iter().flat_map(|step| &step.environment) {
        let (name, value) = (name.clone(), variable.value.clone());
        let setting = VariableSetting { name, value, written: variable.written.clone() };
        if !settings.contains(&setting) {
            settings.push(setting);
        }
    }
    settings
}

/// Environment changes of a program.
pub(crate) fn of_running(running: &Running) -> Environment {
    running.environment.clone()
}

/// Environment changes of a step.
pub(crate) fn of_step(step: &PlanStep) -> Environment {
    let changes = step.environment.iter();
    changes.map(|(name, variable)| (name.clone(), variable.value.clone())).collect()
}

/// Advice about a model, mesh or world that was not found: the launch file lines that set search
/// paths, or the line before which one should.
pub(crate) fn advice(settings: &[VariableSetting], wish: &WorldRequest) -> String {
    let started = wish.written.as_deref();
    let mut lines = Vec::new();
    for name in SEARCH_VARIABLES {
        let holds = wish.environment.get(name).cloned().flatten();
        let of_name = || settings.iter().rev().filter(|setting| setting.name == name);
        if let Some(value) = holds {
            let setting = of_name().find(|setting| setting.value.as_deref() == Some(&value));
            let written = setting.and_then(|setting| setting.written.as_deref()).or(started);
            let at = written.map(|at| format!(", set at {at}")).unwrap_or_default();
            lines.push(format!("`{name}` is `{}` here{at}", shown(&value)));
        } else if let Some(setting) = of_name().next() {
            let at = setting.written.as_deref().unwrap_or("a line of the launch file");
            let there = started.map(|at| format!(" ({at})")).unwrap_or_default();
            lines.push(format!(
                "`{name}` is set at {at}, which has no effect where the world is started{there}: \
                 set it before, in the same scope"
            ));
        }
    }
    if lines.is_empty() {
        let before = started.map_or_else(|| "the world is started".to_owned(), str::to_owned);
        return format!(
            "no line of the launch files sets a search path for models in this scope: before \
             {before}, add `SetEnvironmentVariable('GZ_SIM_RESOURCE_PATH', FOLDER)`, in XML \
             `<set_env name=\"GZ_SIM_RESOURCE_PATH\" value=\"FOLDER\"/>`, for Gazebo Classic \
             `GAZEBO_MODEL_PATH`, in ROS 1 `<env name=\"GAZEBO_MODEL_PATH\" value=\"FOLDER\"/>`"
        );
    }
    lines.join("\n")
}

fn shown(value: &str) -> String {
    if value.chars().count() <= MAX_SHOWN_CHARS {
        return value.to_owned();
    }
    value.chars().take(MAX_SHOWN_CHARS).chain("...".chars()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(set: &[(&str, &str, &str)], holds: &[(&str, &str)], expected: &str) {
        let settings: Vec<VariableSetting> = set
            .iter()
            .map(|(name, value, at)| VariableSetting {
                name: (*name).to_owned(),
                value: Some((*value).to_owned()),
                written: Some((*at).to_owned()),
            })
            .collect();
        let environment =
            holds.iter().map(|(name, value)| ((*name).to_owned(), Some((*value).to_owned())));
        let wish = WorldRequest {
            environment: environment.collect(),
            written: Some("a.launch.py:20".into()),
            ..WorldRequest::default()
        };
        let advice = advice(&settings, &wish);
        assert!(advice.starts_with(expected), "{advice}");
    }

    #[test]
    fn the_line_that_sets_a_path_or_could_set_it_is_named() {
        let variable = "GZ_SIM_RESOURCE_PATH";
        check(
            &[(variable, "/a", "a.launch.py:3"), (variable, "/a:/b", "a.launch.py:12")],
            &[(variable, "/a:/b")],
            "`GZ_SIM_RESOURCE_PATH` is `/a:/b` here, set at a.launch.py:12",
        );
        check(
            &[("GAZEBO_MODEL_PATH", "/a", "a.launch.py:31")],
            &[],
            "`GAZEBO_MODEL_PATH` is set at a.launch.py:31, which has no effect where the world is \
             started (a.launch.py:20)",
        );
        check(&[("PATH", "/a", "a.launch.py:1")], &[], "no line of the launch files sets");
    }
}
