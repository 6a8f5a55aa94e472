//! Parameters of a ROS 1 launch on the parameter server, where programs of ROS 1 read them.

use periplus_launch::{LaunchPlan, PlanParameters, What};
use periplus_ros1::XmlRpcValue;
use serde_json::Value as Json;

/// Parameters of the plan by their full names: those of the server, and those of each node in its namespace.
pub(super) fn parameters(plan: &LaunchPlan) -> Vec<(String, XmlRpcValue)> {
    let global = plan.parameters.iter().map(|(name, value)| (name.clone(), value_of(value)));
    let mut all: Vec<(String, XmlRpcValue)> = global.collect();
    for step in &plan.steps {
        let What::Node(node) = &step.what else { continue };
        let identity = &node.identity;
        let Some(name) = &identity.name else { continue };
        let namespace = identity.namespace.as_deref().unwrap_or("/").trim_end_matches('/');
        for parameters in &identity.parameters {
            let PlanParameters::Values(values) = parameters else { continue };
            for (key, value) in values {
                let key = key.replace('.', "/");
                all.push((format!("{namespace}/{name}/{key}"), value_of(value)));
            }
        }
    }
    all
}

fn value_of(json: &Json) -> XmlRpcValue {
    match json {
        Json::Null => XmlRpcValue::Text(String::new()),
        Json::Bool(value) => XmlRpcValue::Bool(*value),
        Json::Number(number) => match number.as_i64().and_then(|one| i32::try_from(one).ok()) {
            Some(number) => XmlRpcValue::Int(number),
            None => XmlRpcValue::Double(number.as_f64().unwrap_or_default()),
        },
        Json::String(text) => XmlRpcValue::Text(text.clone()),
        Json::Array(list) => XmlRpcValue::List(list.iter().map(value_of).collect()),
        Json::Object(members) => XmlRpcValue::Struct(
            members.iter().map(|(name, one)| (name.clone(), value_of(one))).collect(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn numbers_keep_their_kind() {
        assert_eq!(value_of(&json!(3)), XmlRpcValue::Int(3));
        assert_eq!(value_of(&json!(3.0)), XmlRpcValue::Double(3.0));
        assert_eq!(value_of(&json!(3_000_000_000_i64)), XmlRpcValue::Double(3e9));
        assert_eq!(
            value_of(&json!({"a": [true]})),
            XmlRpcValue::Struct(
                [("a".to_owned(), XmlRpcValue::List(vec![XmlRpcValue::Bool(true)]))].into()
            )
        );
    }
}
