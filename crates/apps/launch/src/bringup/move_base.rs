//! The node `move_base` of ROS 1.

use periplus_graph::{Actor, Graph, Node};
use periplus_nav_nodes::move_base::{MoveBase, MoveBaseConfig};
use serde_json::{Map, Value};

use crate::PlanParameters;
use crate::bringup::make::ParameterFile;
use crate::bringup::parts::BuiltInRequest;

/// Creates the node from its private parameters; its costmaps get separate nodes below its name.
///
/// # Errors
/// A message when it cannot be created.
pub(crate) fn move_base(
    ask: &BuiltInRequest,
    node: &Node,
    graph: &Graph,
    notes: &mut Vec<String>,
) -> Result<Actor<MoveBase>, String> {
    let tree = private_parameters(ask, node.full_name());
    let text = serde_json::to_string_pretty(&tree).map_err(|error| error.to_string())?;
    let written = ParameterFile::of_text(text, node.full_name())?;
    let config = written.read(notes, |tree, found| MoveBaseConfig::read(tree, node.names(), found));
    let config = config.map_err(|error| error.to_string())?;
    let created = MoveBase::create(node, config, |settings| graph.node(settings));
    created.map_err(|error| error.to_string())
}

/// Private parameters of a node as a tree: of the parameter server, then those of the launch file.
fn private_parameters(ask: &BuiltInRequest, full_name: &str) -> Value {
    let mut tree = Map::new();
    let prefix = format!("{full_name}/");
    for (name, value) in &ask.server {
        if let Some(name) = name.strip_prefix(&prefix) {
            insert(&mut tree, name, value);
        }
    }
    for parameters in &ask.identity.parameters {
        if let PlanParameters::Values(values) = parameters {
            values.iter().for_each(|(name, value)| insert(&mut tree, name, value));
        }
    }
    Value::Object(tree)
}

/// Inserts a value by its name, with slashes or dots between the groups. It replaces an older one.
fn insert(tree: &mut Map<String, Value>, name: &str, value: &Value) {
    let Some((group, rest)) = name.split_once(['/', '.']) else {
        tree.insert(name.to_owned(), value.clone());
        return;
    };
    let inner = tree.entry(group).or_insert_with(|| Value::Object(Map::new()));
    if !inner.is_object() {
        *inner = Value::Object(Map::new());
    }
    if let Value::Object(inner) = inner {
        insert(inner, rest, value);
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn names_become_groups() {
        let mut tree = Map::new();
        for (name, value) in
            [("a/b", json!(1)), ("a.c.d", json!([2])), ("e", json!(3)), ("a/b", json!(4))]
        {
            insert(&mut tree, name, &value);
        }
        assert_eq!(Value::Object(tree), json!({"a": {"b": 4, "c": {"d": [2]}}, "e": 3}));
    }
}
