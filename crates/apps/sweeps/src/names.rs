//! Names of parameters on the command line, and what they set.

use std::collections::BTreeSet;

use periplus_diagnostics::closest;
use periplus_scenarios::Variables;
use serde::{Deserialize, Serialize};

/// Variable or parameters of nodes that a name sets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ParameterTarget {
    /// Variable of the scenario.
    Variable(String),
    /// Parameters of nodes: full name of the node and name of the parameter.
    Parameters(Vec<(String, String)>),
}

/// Maximum number of names in a message.
const MAX_LISTED: usize = 8;

/// Finds what a name sets: a variable of the scenario, or else the parameters of nodes whose full name
/// (`NODE.PARAMETER`) ends with it. One parameter of several nodes is set in all of them; several parameters are
/// ambiguous.
///
/// # Errors
/// A message with the nearest names.
pub(crate) fn find(
    name: &str,
    variables: &Variables,
    nodes: &[(String, Vec<String>)],
) -> Result<ParameterTarget, String> {
    if variables.contains_key(name) {
        return Ok(ParameterTarget::Variable(name.to_owned()));
    }
    let name = name.trim_start_matches('/');
    let mut found = Vec::new();
    for (node, parameters) in nodes {
        for parameter in parameters {
            if ends_with(&full(node, parameter), name) {
                found.push((node.clone(), parameter.clone()));
            }
        }
    }
    let different: BTreeSet<&str> = found.iter().map(|(_, parameter)| &**parameter).collect();
    match different.len() {
        0 => Err(unknown(name, variables, nodes)),
        1 => Ok(ParameterTarget::Parameters(found)),
        _ => {
            let names = found.iter().map(|(node, parameter)| full(node, parameter));
            Err(format!(
                "`{name}` is the name of several parameters; write one of {}",
                listed(names)
            ))
        }
    }
}

/// Name with the node, without the leading slash: `local_costmap/local_costmap.inflation_layer.inflation_radius`.
fn full(node: &str, parameter: &str) -> String {
    format!("{}.{parameter}", node.trim_start_matches('/'))
}

/// Returns true if a name ends with whole words of another one.
fn ends_with(full: &str, name: &str) -> bool {
    full.strip_suffix(name)
        .is_some_and(|before| before.is_empty() || before.ends_with('.') || before.ends_with('/'))
}

fn unknown(name: &str, variables: &Variables, nodes: &[(String, Vec<String>)]) -> String {
    let mut short = BTreeSet::new();
    let mut whole = Vec::new();
    for (node, parameters) in nodes {
        for parameter in parameters {
            short.insert(parameter.as_str());
            short.extend(parameter.rsplit_once('.').map(|(_, last)| last));
            whole.push(full(node, parameter));
        }
    }
    let known = variables.keys().map(String::as_str).chain(short.iter().copied());
    let near = closest(name, known.chain(whole.iter().map(String::as_str)));
    let last = name.rsplit(['.', '/']).next().unwrap_or(name);
    let alike = whole.iter().filter(|it| it.to_lowercase().contains(&last.to_lowercase()));
    let advice = match near {
        Some(near) => format!("did you mean `{near}`?"),
        None if alike.clone().next().is_some() => format!("similar: {}", listed(alike.cloned())),
        None => {
            let mut names: Vec<&str> = nodes.iter().map(|(node, _)| node.as_str()).collect();
            names.dedup();
            format!("its nodes are {}", names.join(", "))
        }
    };
    let variables: Vec<&str> = variables.keys().map(String::as_str).collect();
    let variables = match variables.as_slice() {
        [] => "no variables".to_owned(),
        names => format!("the variables {}", names.join(", ")),
    };
    format!("the scenario has {variables}, and no node has a parameter `{name}`; {advice}")
}

fn listed(names: impl Iterator<Item = String>) -> String {
    let mut names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    let more = names.len().saturating_sub(MAX_LISTED);
    names.truncate(MAX_LISTED);
    let tail = if more > 0 { format!(" and {more} more") } else { String::new() };
    names.join(", ") + &tail
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(name: &str, expected: &str) {
        let variables = [("loss".to_owned(), "0.5".to_owned())].into();
        let costmap = [
            "inflation_layer.inflation_radius",
            "inflation_layer.enabled",
            "obstacle_layer.enabled",
        ];
        let of = |node: &str, names: &[&str]| {
            (node.to_owned(), names.iter().map(|it| (*it).to_owned()).collect())
        };
        let nodes = [
            of("/global/costmap", &costmap),
            of("/local/costmap", &costmap),
            of("/controller_server", &["FollowPath.max_speed"]),
        ];
        let text = match find(name, &variables, &nodes) {
            Ok(ParameterTarget::Variable(name)) => format!("variable {name}"),
            Ok(ParameterTarget::Parameters(all)) => {
                all.iter().map(|(node, _)| &**node).collect::<Vec<_>>().join(" ")
            }
            Err(message) => message,
        };
        assert!(text.contains(expected), "{name}: {text}");
    }

    #[test]
    fn a_name_sets_a_variable_or_the_parameters_that_end_with_it() {
        check("loss", "variable loss");
        check("inflation_radius", "/global/costmap /local/costmap");
        check("local/costmap.inflation_layer.inflation_radius", "/local/costmap");
        check("/local/costmap.inflation_layer.inflation_radius", "/local/costmap");
        check("controller_server.FollowPath.max_speed", "/controller_server");
        check("max_speed", "/controller_server");
    }

    #[test]
    fn an_unknown_or_ambiguous_name_is_explained() {
        check("radius", "similar: `global/costmap.inflation_layer.inflation_radius`");
        check("inflation_radus", "did you mean `inflation_radius`?");
        check(
            "enabled",
            "several parameters; write one of `global/costmap.inflation_layer.enabled`",
        );
        check("xyz", "the variables loss");
    }
}
