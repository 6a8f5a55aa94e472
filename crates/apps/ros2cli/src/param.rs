//! `param`.

mod say;

use std::collections::BTreeMap;
use std::path::Path;

use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_graph::{Arguments, Node, parameter_from_yaml, parameters_to_yaml};
use periplus_msgs::rcl_interfaces::{
    DescribeParameters, DescribeParametersRequest, GetParameterTypes, GetParameterTypesRequest,
    GetParameters, GetParametersRequest, ListParameters, ListParametersRequest, Parameter,
    ParameterType, ParameterValue, SetParameters, SetParametersRequest, SetParametersResult,
};
use periplus_yaml::{YamlNode as Yaml, YamlValue};
use serde_json::json;

use crate::ask::ask;
use crate::session::{advice, full_name};
use crate::{Failure, NodeRefusal, Outcome, Ros2Line, Seen, Session, is_hidden};

/// Options of `param list`.
#[derive(Clone, Debug, Default)]
pub struct ParamListOptions {
    /// Node to list; all if `None`.
    pub node: Option<String>,
    /// Include hidden nodes.
    pub include_hidden: bool,
    /// Prefixes of names; all names if empty.
    pub prefixes: Vec<String>,
    /// `--param-type`.
    pub show_types: bool,
}

/// Names of nodes that have parameter services.
fn parametric(seen: &Seen) -> Vec<String> {
    let services = seen.services.iter().filter(|service| {
        !service.servers.is_empty()
            && service.types.iter().any(|name| name == "rcl_interfaces/srv/ListParameters")
    });
    let names = services.filter_map(|service| service.name.strip_suffix("/list_parameters"));
    names.map(str::to_owned).collect()
}

/// `use_sim_time` of each node; nodes that do not respond are left out.
pub(crate) fn simulated_time(
    session: &Session<'_>,
    node: &Node,
    seen: &Seen,
) -> BTreeMap<String, bool> {
    let asked = parametric(seen).into_iter().filter(|name| !is_hidden(name));
    asked
        .filter_map(|name| {
            let names = ["use_sim_time".to_owned()];
            let values = values_of(session, node, &name, &names).ok()?;
            let value =
                values.first().filter(|value| value.r#type == ParameterType::PARAMETER_BOOL)?;
            Some((name, value.bool_value))
        })
        .collect()
}

/// Looks up a node by name.
fn look_up(session: &Session<'_>, name: &str) -> Outcome<String> {
    let name = full_name(name);
    let (seen, is_there) = session.look_for(|seen| parametric(seen).contains(&name));
    session.check_interrupted()?;
    if is_there {
        return Ok(name);
    }
    let near = advice(&name, seen.nodes.iter().map(|node| node.name.as_str()));
    Err(Failure::failed(match seen.count_nodes(&name) {
        0 => format!("Node not found: '{name}'{near}"),
        _ => format!("the node '{name}' has no parameter services"),
    }))
}

fn names_of(
    session: &Session<'_>,
    node: &Node,
    name: &str,
    prefixes: &[String],
) -> Outcome<Vec<String>> {
    let request = ListParametersRequest { prefixes: prefixes.to_vec(), depth: 0 };
    let service = format!("{name}/list_parameters");
    let mut names = ask::<ListParameters>(session, node, &service, &request)?.result.names;
    names.sort_unstable();
    names.dedup();
    Ok(names)
}

fn values_of(
    session: &Session<'_>,
    node: &Node,
    name: &str,
    names: &[String],
) -> Outcome<Vec<ParameterValue>> {
    let request = GetParametersRequest { names: names.to_vec() };
    let service = format!("{name}/get_parameters");
    Ok(ask::<GetParameters>(session, node, &service, &request)?.values)
}

/// Lists the parameters of a node, or of all nodes.
///
/// # Errors
/// When there is no such node, or the output cannot be written.
pub fn list(session: &mut Session<'_>, options: &ParamListOptions) -> Outcome {
    let nodes = match &options.node {
        Some(name) => vec![look_up(session, name)?],
        None => {
            let nodes = parametric(&session.look()).into_iter();
            nodes.filter(|name| options.include_hidden || !is_hidden(name)).collect()
        }
    };
    let own = session.node(None)?;
    for node in nodes {
        let names = match names_of(session, &own, &node, &options.prefixes) {
            Ok(names) => names,
            Err(Failure::Failed(words)) if options.node.is_none() => {
                session.say(&format!("WARNING: {words}"));
                continue;
            }
            Err(failure) => return Err(failure),
        };
        let types = if options.show_types {
            let request = GetParameterTypesRequest { names: names.clone() };
            let service = format!("{node}/get_parameter_types");
            Some(ask::<GetParameterTypes>(session, &own, &service, &request)?.types)
        } else {
            None
        };
        let type_of = |place: usize| {
            types.as_ref().and_then(|types| types.get(place)).map(|number| say::type_name(*number))
        };
        if session.json {
            let all = names.iter().enumerate().map(|(place, name)| match type_of(place) {
                Some(type_name) => json!({ "name": name, "type": type_name }),
                None => json!(name),
            });
            let all = all.collect::<Vec<_>>();
            session.put(&json!({ "node": node, "parameters": all }))?;
            continue;
        }
        if options.node.is_none() {
            writeln!(session.out, "{node}:")?;
        }
        for (place, name) in names.iter().enumerate() {
            match type_of(place) {
                Some(type_name) => writeln!(session.out, "  {name} (type: {type_name})")?,
                None => writeln!(session.out, "  {name}")?,
            }
        }
    }
    session.out.flush()?;
    Ok(())
}

/// Prints the value of a parameter.
///
/// # Errors
/// When there is no such node, or the output cannot be written.
pub fn get(session: &mut Session<'_>, node: &str, name: &str, hide_type: bool) -> Outcome {
    let node = look_up(session, node)?;
    let own = session.node(None)?;
    let values = values_of(session, &own, &node, &[name.to_owned()])?;
    let value = values.first().filter(|value| value.r#type != ParameterType::PARAMETER_NOT_SET);
    let Some(value) = value else {
        let names = names_of(session, &own, &node, &[]).unwrap_or_default();
        if names.iter().any(|known| known == name) {
            return Err(Failure::failed("Parameter not set."));
        }
        let near = advice(name, names.iter().map(String::as_str));
        return Err(Failure::failed(format!("Parameter not set: {node} has no `{name}`{near}")));
    };
    if session.json {
        let type_name = say::type_name(value.r#type);
        let json = say::to_json(value);
        return session
            .put(&json!({ "node": node, "name": name, "type": type_name, "value": json }));
    }
    let text = say::python(value);
    match hide_type {
        true => writeln!(session.out, "{text}")?,
        false => writeln!(session.out, "{} {text}", say::label(value.r#type))?,
    }
    session.out.flush()?;
    Ok(())
}

fn set_one(
    session: &Session<'_>,
    own: &Node,
    node: &str,
    name: &str,
    value: ParameterValue,
) -> Outcome<SetParametersResult> {
    let request =
        SetParametersRequest { parameters: vec![Parameter { name: name.to_owned(), value }] };
    let service = format!("{node}/set_parameters");
    let answer = ask::<SetParameters>(session, own, &service, &request)?;
    let none = || Failure::failed(format!("the response of {service} has no result for `{name}`"));
    answer.results.into_iter().next().ok_or_else(none)
}

/// `ros2 param` prints the same on standard error.
fn refused(message: String) -> Failure {
    Failure::Refused(NodeRefusal { ros2: Ros2Line::Stderr(message.clone()), message })
}

/// Prints the result of setting a parameter; returns true on success.
fn tell(
    session: &mut Session<'_>,
    node: &str,
    name: &str,
    result: &SetParametersResult,
    words: &str,
) -> Outcome<bool> {
    let SetParametersResult { successful, reason } = result;
    if session.json {
        session.put(&json!({
            "node": node, "name": name, "successful": successful, "reason": reason,
        }))?;
    } else if *successful {
        let behind = if reason.is_empty() { String::new() } else { format!(": {reason}") };
        writeln!(session.out, "{words} successful{behind}")?;
        session.out.flush()?;
    }
    Ok(*successful)
}

/// Sets a parameter; the value is YAML. A list of lists, such as a footprint, is set as a string.
///
/// # Errors
/// When there is no such node, it refuses the value, or the output cannot be written.
pub fn set(session: &mut Session<'_>, node: &str, name: &str, value: &str) -> Outcome {
    let value = typed_value(value)?;
    let node = look_up(session, node)?;
    let own = session.node(None)?;
    let result = set_one(session, &own, &node, name, value)?;
    match tell(session, &node, name, &result, "Set parameter")? {
        true => Ok(()),
        false => Err(refused(format!("Setting parameter failed: {}", result.reason))),
    }
}

/// Parses a value as `ros2 param set` does.
fn typed_value(text: &str) -> Outcome<ParameterValue> {
    let wrong = match parameter_from_yaml(text) {
        Ok(value) => return Ok(value),
        Err(wrong) => wrong,
    };
    let mut sources = SourceMap::new();
    let file = sources.add("value", text);
    let is_list = |node: &Yaml| matches!(node.value, YamlValue::List(_));
    let is_nested = periplus_yaml::parse(file, &sources).ok().flatten().is_some_and(|node| {
        matches!(&node.value, YamlValue::List(items) if !items.is_empty() && items.iter().all(is_list))
    });
    match is_nested {
        true => Ok(ParameterValue {
            r#type: ParameterType::PARAMETER_STRING,
            string_value: text.to_owned(),
            ..ParameterValue::default()
        }),
        false => Err(Failure::Usage(format!("the value `{text}` {wrong}"))),
    }
}

/// Deletes a parameter of a node.
///
/// # Errors
/// When there is no such node, it refuses, or the output cannot be written.
pub fn delete(session: &mut Session<'_>, node: &str, name: &str) -> Outcome {
    let node = look_up(session, node)?;
    let own = session.node(None)?;
    let result = set_one(session, &own, &node, name, ParameterValue::default())?;
    match tell(session, &node, name, &result, "Deleted parameter")? {
        true => Ok(()),
        false => Err(refused(format!("Deleting parameter failed: {}", result.reason))),
    }
}

/// Describes parameters: purpose, type and range.
///
/// # Errors
/// When there is no such node, or the output cannot be written.
pub fn describe(session: &mut Session<'_>, node: &str, names: &[String]) -> Outcome {
    let node = look_up(session, node)?;
    let own = session.node(None)?;
    let request = DescribeParametersRequest { names: names.to_vec() };
    let service = format!("{node}/describe_parameters");
    let answer = ask::<DescribeParameters>(session, &own, &service, &request)?;
    if answer.descriptors.len() != names.len() {
        // Nodes return an empty list if one of the parameters does not exist.
        let known = names_of(session, &own, &node, &[])?;
        if let Some(name) = names.iter().find(|name| !known.contains(name)) {
            let near = advice(name, known.iter().map(String::as_str));
            return Err(Failure::failed(format!("{node} has no parameter `{name}`{near}")));
        }
        return Err(Failure::failed(format!("the response of {service} does not cover all names")));
    }
    for one in &answer.descriptors {
        if session.json {
            session.put(&periplus_msgs::to_json(one))?;
        } else {
            write!(session.out, "{}", say::description(one))?;
        }
    }
    session.out.flush()?;
    Ok(())
}

/// Prints all parameters of a node, as a file for `--params-file`.
///
/// # Errors
/// When there is no such node, or the output cannot be written.
pub fn dump(session: &mut Session<'_>, node: &str) -> Outcome {
    let node = look_up(session, node)?;
    let own = session.node(None)?;
    let names = names_of(session, &own, &node, &[])?;
    let values = values_of(session, &own, &node, &names)?;
    let all = names.into_iter().zip(values);
    let set = all.filter(|(_, value)| value.r#type != ParameterType::PARAMETER_NOT_SET);
    let set: Vec<(String, ParameterValue)> = set.collect();
    if session.json {
        let all = set.iter().map(|(name, value)| (name.clone(), say::to_json(value)));
        let all: serde_json::Map<_, _> = all.collect();
        return session.put(&json!({ "node": node, "parameters": all }));
    }
    write!(session.out, "{}", parameters_to_yaml(&node, &set))?;
    session.out.flush()?;
    Ok(())
}

/// Sets the parameters that a file has for a node, given the text of the file.
///
/// # Errors
/// When there is no such node, the file is invalid or has nothing for it, the node refuses a value,
/// or the output cannot be written.
pub fn load(
    session: &mut Session<'_>,
    node: &str,
    file: &Path,
    text: &str,
    use_wildcard: bool,
) -> Outcome {
    let mut sources = SourceMap::new();
    let mut findings = Diagnostics::new();
    let words = ["--params-file".to_owned(), file.display().to_string()];
    let mut read = |_: &Path| Ok(text.to_owned());
    let arguments = Arguments::read(&words, &mut sources, &mut findings, &mut read);
    for finding in findings.iter() {
        session.say(&render(finding, &sources, RenderStyle::Plain));
    }
    if findings.has_errors() {
        return Err(Failure::failed(format!("{} is not a parameter file", file.display())));
    }
    let node = look_up(session, node)?;
    let mut values: BTreeMap<String, ParameterValue> = arguments.parameters_of(&node);
    if !use_wildcard {
        // Parameters under `/**` apply to any node.
        for name in arguments.parameters_of("/_no/_such/_node").into_keys() {
            values.remove(&name);
        }
    }
    if values.is_empty() {
        return Err(Failure::failed(format!(
            "Param file does not contain parameters for {node}: it has to have them under \
             `{node}:`, then `ros__parameters:`"
        )));
    }
    let own = session.node(None)?;
    let mut refusals = Vec::new();
    for (name, value) in values {
        let result = set_one(session, &own, &node, &name, value)?;
        if !tell(session, &node, &name, &result, &format!("Set parameter {name}"))? {
            refusals.push(format!("Set parameter {name} failed: {}", result.reason));
        }
    }
    if refusals.is_empty() { Ok(()) } else { Err(refused(refusals.join("\n"))) }
}
