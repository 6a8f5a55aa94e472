//! Parameter files with replaced values, as `RewrittenYaml` of `nav2_common`.

use serde_json::{Map, Value};

use crate::truth::truth;

/// Replacements.
pub(crate) struct Rewriting {
    /// Values by a key, or by a path of keys with dots.
    pub(crate) values_by_key: Vec<(String, String)>,
    /// Keys by keys.
    pub(crate) keys: Vec<(String, String)>,
    /// Values by values.
    pub(crate) values: Vec<(String, String)>,
    /// Root key to wrap the file in.
    pub(crate) root: Option<String>,
    /// True to convert texts to numbers and Booleans.
    pub(crate) convert: bool,
}

impl Rewriting {
    /// Applies the replacements to a tree.
    pub(crate) fn apply(&self, tree: &Value) -> Value {
        let mut tree = self.replaced(tree, "");
        for (path, value) in &self.values_by_key {
            // A path to a parameter of a node is set even if the file does not have it.
            if path.contains(".ros__parameters.") {
                set(&mut tree, path.split('.'), self.value(value));
            }
        }
        match self.root.as_deref().filter(|root| !root.is_empty()) {
            Some(root) => Value::Object(Map::from_iter([(root.to_owned(), tree)])),
            None => tree,
        }
    }

    fn replaced(&self, tree: &Value, path: &str) -> Value {
        match tree {
            Value::Object(entries) => Value::Object(
                entries
                    .iter()
                    .map(|(key, value)| {
                        let path =
                            if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                        let by = self.values_by_key.iter().find(|(wanted, _)| {
                            *wanted == path || (wanted == key && !value.is_object())
                        });
                        let value = match by {
                            Some((_, by)) => self.value(by),
                            None => self.replaced(value, &path),
                        };
                        let renamed = self.keys.iter().find(|(from, _)| from == key);
                        (renamed.map_or_else(|| key.clone(), |(_, to)| to.clone()), value)
                    })
                    .collect(),
            ),
            Value::Array(list) => {
                Value::Array(list.iter().map(|value| self.replaced(value, path)).collect())
            }
            Value::String(text) => match self.values.iter().find(|(from, _)| from == text) {
                Some((_, to)) => self.value(to),
                None => tree.clone(),
            },
            _ => tree.clone(),
        }
    }

    fn value(&self, text: &str) -> Value {
        if self.convert {
            if let Ok(integer) = text.parse::<i64>() {
                return integer.into();
            }
            if let Some(number) = text.parse().ok().filter(|number: &f64| number.is_finite()) {
                return number.into();
            }
        }
        match text.to_lowercase().as_str() {
            "true" | "false" => truth(text).into(),
            _ => Value::String(text.to_owned()),
        }
    }
}

fn set<'a>(tree: &mut Value, mut path: impl Iterator<Item = &'a str>, value: Value) {
    match path.next() {
        None => *tree = value,
        Some(key) => {
            if !tree.is_object() {
                *tree = Value::Object(Map::new());
            }
            if let Value::Object(entries) = tree {
                set(entries.entry(key).or_insert(Value::Null), path, value);
            }
        }
    }
}

/// Returns true if a parameter file has an entry for a node of this name.
pub(crate) fn has_node(tree: &Value, node: &str) -> bool {
    tree.as_object().is_some_and(|entries| entries.contains_key(node))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::Rewriting;

    #[test]
    fn keys_paths_and_values_are_replaced() {
        let rewriting = Rewriting {
            values_by_key: vec![
                ("use_sim_time".into(), "True".into()),
                ("map_server.ros__parameters.yaml_filename".into(), "/m.yaml".into()),
                ("amcl.ros__parameters.alpha1".into(), "0.5".into()),
            ],
            keys: vec![],
            values: vec![("KEEP".into(), "odom".into())],
            root: Some("robot1".into()),
            convert: true,
        };
        let file = json!({"amcl": {"ros__parameters": {
            "use_sim_time": false, "alpha1": 0.2, "odom_frame_id": "KEEP"}}});
        assert_eq!(
            rewriting.apply(&file),
            json!({"robot1": {
                "amcl": {"ros__parameters": {
                    "use_sim_time": true, "alpha1": 0.5, "odom_frame_id": "odom"}},
                "map_server": {"ros__parameters": {"yaml_filename": "/m.yaml"}},
            }})
        );
    }
}
