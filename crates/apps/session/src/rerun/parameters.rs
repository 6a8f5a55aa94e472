//! Parameters of reruns: the declared ones of the nodes, and their values.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::str::FromStr;

use periplus_costmap::CostmapConfig;
use periplus_diagnostics::{Diagnostics, closest};
use periplus_nav_nodes::amcl::read_parameters;
use periplus_nav_nodes::costmap_2d::node_values;
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_params::{ParamRange, ParamType, ParamValue, ParamValues, Parameter, text};
use serde_json::{Value, json};

use super::error::RerunError;
use super::robot::RecordedRobot;
use crate::nodes::profile::DEFAULT_RADIUS_M;
use crate::nodes::{RobotProfile, read_costmap_text};

/// Estimators of a rerun.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RerunKind {
    /// Mapping by the node of `slam_toolbox`.
    Slam,
    /// Localization by `amcl`, on the recorded map or that of a file.
    Amcl,
    /// Both costmaps of Nav2.
    Costmap,
}

impl RerunKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Slam, Self::Amcl, Self::Costmap];

    /// Name in the protocol of the page.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Slam => "slam",
            Self::Amcl => "amcl",
            Self::Costmap => "costmap",
        }
    }

    pub(super) const fn odom_frame_parameter(self) -> &'static str {
        match self {
            Self::Slam => "odom_frame",
            Self::Amcl => "odom_frame_id",
            Self::Costmap => "local_costmap.global_frame",
        }
    }

    pub(super) const fn base_frame_parameter(self) -> &'static str {
        match self {
            Self::Slam => "base_frame",
            Self::Amcl => "base_frame_id",
            Self::Costmap => "local_costmap.robot_base_frame",
        }
    }
}

impl FromStr for RerunKind {
    type Err = RerunError;

    fn from_str(name: &str) -> Result<Self, RerunError> {
        let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| RerunError::Kind(name.to_owned()))
    }
}

/// Map of `amcl`, which is no parameter of the node.
pub const MAP_FILE: Parameter =
    text("map_file", "YAML file of the map; empty for the last map of the recording.").or("");

/// Parameters that a rerun sets itself, or that have no effect in it.
const OMITTED_PARAMETERS: [&str; 5] =
    ["use_sim_time", "bond_heartbeat_period", "plugins", "filters", "compat"];

/// Values of the parameters of a rerun.
#[derive(Clone, Debug)]
pub(super) enum RerunParameters {
    Slam(ParamValues),
    Amcl { values: ParamValues, map_file: Option<PathBuf> },
    Costmap { given: BTreeMap<String, ParamValue>, profile: Box<RobotProfile> },
}

/// Returns the parameters of a kind as a list of `name`, `type`, `default`, `min`, `max`, `unit` and `doc`.
///
/// # Errors
/// When the default costmaps cannot be read, which is a fault of this program.
pub fn job_parameters(kind: RerunKind) -> Result<Value, RerunError> {
    let listed = match kind {
        RerunKind::Slam => of_values("", &slam_values()),
        RerunKind::Amcl => {
            let mut all = vec![described(MAP_FILE.name, &MAP_FILE, None)];
            all.extend(of_values("", &amcl_values()));
            all
        }
        RerunKind::Costmap => costmap_configs(&default_profile())?
            .iter()
            .flat_map(|(name, config)| of_values(&format!("{name}."), &node_values(config)))
            .collect(),
    };
    Ok(Value::Array(listed))
}

fn slam_values() -> ParamValues {
    Program::Async.table().check([], None, &mut Diagnostics::new())
}

fn amcl_values() -> ParamValues {
    read_parameters(None, "amcl", &[], &mut Diagnostics::new())
}

fn default_profile() -> RobotProfile {
    RobotProfile { radius_m: DEFAULT_RADIUS_M, ..RobotProfile::default() }
}

/// Returns the default costmaps of a robot.
pub(super) fn costmap_configs(
    profile: &RobotProfile,
) -> Result<Vec<(&'static str, CostmapConfig)>, RerunError> {
    let text = profile.costmap_parameters();
    Ok(read_costmap_text("the default costmaps", text, None)?.configs)
}

/// Describes all parameters of a node.
fn of_values(prefix: &str, values: &ParamValues) -> Vec<Value> {
    let names = values.names().filter(|name| !OMITTED_PARAMETERS.contains(&name.as_str()));
    names
        .filter_map(|name| {
            let parameter = values.find(&name)?;
            Some(described(&format!("{prefix}{name}"), parameter, values.get(&name)))
        })
        .collect()
}

fn described(name: &str, parameter: &Parameter, value: Option<ParamValue>) -> Value {
    let (kind, choices) = match parameter.kind {
        ParamType::Bool => ("bool", None),
        ParamType::Integer => ("integer", None),
        ParamType::Number => ("number", None),
        ParamType::Text | ParamType::Group => ("text", None),
        ParamType::NumberList => ("numbers", None),
        ParamType::TextList => ("texts", None),
        ParamType::Choice(words) => ("choice", Some(words)),
    };
    let bound = |of: fn(&ParamRange) -> f64| {
        parameter.range.as_ref().map(of).filter(|bound| bound.is_finite())
    };
    let default = match value {
        None => json!(""),
        Some(value) => json_of(value),
    };
    let mut all = json!({
        "name": name,
        "type": kind,
        "default": default,
        "min": bound(|range| range.min),
        "max": bound(|range| range.max),
        "unit": parameter.unit,
        "doc": parameter.doc,
    });
    if let Some(choices) = choices {
        all["choices"] = json!(choices);
    }
    all
}

/// Numbers without a counterpart in JSON are text, as in the page's protocol.
fn json_of(value: ParamValue) -> Value {
    let number = |number: f64| match serde_json::Number::from_f64(number) {
        Some(number) => Value::Number(number),
        None if number.is_nan() => json!("NaN"),
        None => json!(if number > 0.0 { "Infinity" } else { "-Infinity" }),
    };
    match value {
        ParamValue::Bool(value) => json!(value),
        ParamValue::Integer(value) => json!(value),
        ParamValue::Number(value) => number(value),
        ParamValue::Text(value) => json!(value),
        ParamValue::Numbers(values) => values.into_iter().map(number).collect(),
        ParamValue::Texts(values) => json!(values),
    }
}

/// Text of a value as a user would write it.
fn written(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(items) => items.iter().map(written).collect::<Vec<_>>().join(" "),
        other => other.to_string(),
    }
}

impl RerunParameters {
    /// Reads the values that differ from the defaults.
    pub(super) fn read(
        kind: RerunKind,
        given: &BTreeMap<String, Value>,
    ) -> Result<Self, RerunError> {
        let given = given.iter().filter(|(_, value)| !value.is_null());
        match kind {
            RerunKind::Slam => {
                let mut values = slam_values();
                for (name, value) in given {
                    set(&mut values, name, value)?;
                }
                Ok(Self::Slam(values))
            }
            RerunKind::Amcl => {
                let (mut values, mut map_file) = (amcl_values(), None);
                for (name, value) in given {
                    if name == MAP_FILE.name {
                        map_file = Some(written(value)).filter(|it| !it.is_empty()).map(Into::into);
                    } else {
                        set(&mut values, name, value)?;
                    }
                }
                Ok(Self::Amcl { values, map_file })
            }
            RerunKind::Costmap => {
                let profile = default_profile();
                let configs = costmap_configs(&profile)?;
                let declared: Vec<(&str, ParamValues)> =
                    configs.iter().map(|(name, config)| (*name, node_values(config))).collect();
                let mut values = BTreeMap::new();
                for (name, value) in given {
                    let (parameter, _) = find_in(&declared, name)?;
                    values.insert(name.clone(), parsed(name, parameter, value)?);
                }
                Ok(Self::Costmap { given: values, profile: Box::new(profile) })
            }
        }
    }

    pub(super) fn kind(&self) -> RerunKind {
        match self {
            Self::Slam(_) => RerunKind::Slam,
            Self::Amcl { .. } => RerunKind::Amcl,
            Self::Costmap { .. } => RerunKind::Costmap,
        }
    }

    /// Returns a text that was given.
    pub(super) fn given_text(&self, name: &str) -> Option<String> {
        match self {
            Self::Slam(values) | Self::Amcl { values, .. } => {
                values.is_given(name).then(|| values.text(name)).flatten()
            }
            Self::Costmap { given, .. } => match given.get(name) {
                Some(ParamValue::Text(text)) => Some(text.clone()),
                _ => None,
            },
        }
    }

    /// Sets topics and frames of the recorded robot, where none are given.
    pub(super) fn fill(&mut self, robot: &RecordedRobot) {
        let mut known = vec![
            (self.kind().odom_frame_parameter(), robot.odom_frame.clone()),
            (self.kind().base_frame_parameter(), robot.base_frame.clone()),
            ("scan_topic", robot.scan_topic.clone()),
        ];
        match self {
            Self::Slam(values) => fill(values, known),
            Self::Amcl { values, map_file } => {
                // A map file is published on the topic of the parameter.
                if let Some(topic) = robot.map_topic.clone().filter(|_| map_file.is_none()) {
                    known.push(("map_topic", topic));
                }
                fill(values, known);
            }
            Self::Costmap { profile, .. } => {
                profile.scan = Some(robot.scan_topic.clone());
                profile.odom_frame = Some(robot.odom_frame.clone());
                profile.base_frame = Some(robot.base_frame.clone());
            }
        }
    }
}

fn fill(values: &mut ParamValues, known: Vec<(&'static str, String)>) {
    for (name, text) in known {
        if !values.is_given(name) {
            values.set(name, ParamValue::Text(text));
        }
    }
}

/// Sets a value by the name of a declared parameter.
fn set(values: &mut ParamValues, name: &str, value: &Value) -> Result<(), RerunError> {
    let parameter = values.find(name).ok_or_else(|| {
        unknown(name, values.names().collect::<Vec<_>>().iter().map(String::as_str))
    })?;
    let value = parsed(name, parameter, value)?;
    values.set(parameter.name, value);
    Ok(())
}

fn parsed(name: &str, parameter: &Parameter, value: &Value) -> Result<ParamValue, RerunError> {
    let text = written(value);
    ParamValue::read(parameter, &text)
        .map_err(|why| RerunError::Parameter(format!("`{name}`: the value `{text}` {why}")))
}

/// Returns the declaration of `<node>.<parameter>`, and the name of the parameter.
fn find_in<'a>(
    nodes: &[(&str, ParamValues)],
    name: &'a str,
) -> Result<(&'static Parameter, &'a str), RerunError> {
    let found = name.split_once('.').and_then(|(node, rest)| {
        let (_, values) = nodes.iter().find(|it| it.0 == node)?;
        Some((values.find(rest)?, rest))
    });
    found.ok_or_else(|| {
        let all: Vec<String> = nodes
            .iter()
            .flat_map(|(node, values)| values.names().map(move |it| format!("{node}.{it}")))
            .collect();
        unknown(name, all.iter().map(String::as_str))
    })
}

fn unknown<'a>(name: &str, all: impl Iterator<Item = &'a str>) -> RerunError {
    let near = closest(name, all).map(|near| format!("; did you mean `{near}`?"));
    RerunError::Parameter(format!("there is no parameter `{name}`{}", near.unwrap_or_default()))
}

/// Returns the values given to one costmap, by the names of the node.
pub(super) fn given_to<'a>(
    given: &'a BTreeMap<String, ParamValue>,
    node: &'a str,
) -> impl Iterator<Item = (&'a str, &'a ParamValue)> {
    given
        .iter()
        .filter_map(move |(name, value)| Some((name.strip_prefix(node)?.strip_prefix('.')?, value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(kind: RerunKind) -> Vec<String> {
        let all = job_parameters(kind).unwrap();
        let all = all.as_array().unwrap().iter();
        all.map(|one| one["name"].as_str().unwrap().to_owned()).collect()
    }

    #[test]
    fn every_kind_lists_its_parameters() {
        assert!(names(RerunKind::Slam).contains(&"resolution".to_owned()));
        assert!(names(RerunKind::Amcl).contains(&"map_file".to_owned()));
        let costmap = names(RerunKind::Costmap);
        for node in ["local_costmap", "global_costmap"] {
            assert!(costmap.contains(&format!("{node}.inflation_layer.inflation_radius")));
        }
        let slam = job_parameters(RerunKind::Slam).unwrap();
        let resolution = slam.as_array().unwrap().iter().find(|one| one["name"] == "resolution");
        let resolution = resolution.unwrap();
        assert_eq!(resolution["type"], "number");
        assert_eq!(resolution["default"], 0.05);
        assert_eq!(resolution["unit"], "m");
    }

    #[test]
    fn wrong_parameters_are_refused_with_advice() {
        let read = |kind, name: &str, value: Value| {
            let given = [(name.to_owned(), value)].into();
            RerunParameters::read(kind, &given).map(|_| ()).map_err(|why| why.to_string())
        };
        assert_eq!(read(RerunKind::Slam, "resolution", json!(0.1)), Ok(()));
        assert_eq!(read(RerunKind::Slam, "resolution", json!("0.1")), Ok(()));
        assert_eq!(
            read(RerunKind::Slam, "resolutoin", json!(0.1)),
            Err("there is no parameter `resolutoin`; did you mean `resolution`?".into())
        );
        assert!(read(RerunKind::Slam, "resolution", json!(-1)).unwrap_err().contains("range"));
        assert_eq!(read(RerunKind::Costmap, "local_costmap.width", json!(4)), Ok(()));
        let near = "global_costmap.inflation_layer.inflation_radus";
        assert!(read(RerunKind::Costmap, near, json!(1)).unwrap_err().contains("did you mean"));
        assert!("slma".parse::<RerunKind>().is_err());
    }
}
