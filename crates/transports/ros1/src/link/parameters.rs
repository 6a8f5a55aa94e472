//! Parameters of the graph's nodes on the parameter server.

use std::collections::BTreeMap;
use std::time::Duration;

use periplus_graph::Graph;
use periplus_msgs::rcl_interfaces::{ParameterType, ParameterValue};
use periplus_transport::{Since, is_stand_in};

use super::Net;
use crate::names::node_name;
use crate::xmlrpc::XmlRpcValue;

/// A parameter that programs of ROS 1, such as RViz, look for in the namespace of the robot.
const ROBOT_DESCRIPTION: &str = "robot_description";

/// Period at which changes are looked for.
const LOOK: Duration = Duration::from_secs(1);

/// Parameters of the graph's nodes as the server has them.
#[derive(Default)]
pub(super) struct Parameters {
    known: BTreeMap<String, XmlRpcValue>,
    looked: Option<Since>,
}

impl Parameters {
    /// Sets new and changed parameters.
    pub(super) fn follow(&mut self, net: &Net, graph: &Graph) {
        if self.looked.is_some_and(|looked| looked.elapsed() < LOOK) {
            return;
        }
        self.looked = Some(Since::now());
        let mut changed = Vec::new();
        for (node, parameters) in graph.parameters() {
            if is_stand_in(&node) {
                continue;
            }
            for parameter in parameters {
                let Some(value) = value_of(&parameter.value) else { continue };
                let parts = parameter.name.replace('.', "/");
                let node = node_name(&node);
                let mut keys = vec![format!("{node}/{parts}")];
                if parameter.name == ROBOT_DESCRIPTION {
                    let namespace = node.rsplit_once('/').map_or("", |(namespace, _)| namespace);
                    keys.push(format!("{namespace}/{parts}"));
                }
                for key in keys {
                    if self.known.get(&key) != Some(&value) {
                        self.known.insert(key.clone(), value.clone());
                        changed.push((key, value.clone()));
                    }
                }
            }
        }
        if !changed.is_empty() && net.client.set_parameters(changed).is_err() {
            // Set again when the master answers.
            self.known.clear();
        }
    }
}

/// Value on the parameter server; none for one that is not set.
fn value_of(value: &ParameterValue) -> Option<XmlRpcValue> {
    let integer = |number: &i64| match i32::try_from(*number) {
        Ok(number) => XmlRpcValue::Int(number),
        // The parameter server has 32 bits.
        Err(_) => XmlRpcValue::Double(*number as f64),
    };
    let one = value;
    Some(match one.r#type {
        ParameterType::PARAMETER_BOOL => XmlRpcValue::Bool(one.bool_value),
        ParameterType::PARAMETER_INTEGER => integer(&one.integer_value),
        ParameterType::PARAMETER_DOUBLE => XmlRpcValue::Double(one.double_value),
        ParameterType::PARAMETER_STRING => XmlRpcValue::Text(one.string_value.clone()),
        ParameterType::PARAMETER_BYTE_ARRAY => XmlRpcValue::Binary(one.byte_array_value.clone()),
        ParameterType::PARAMETER_BOOL_ARRAY => one.bool_array_value.clone().into(),
        ParameterType::PARAMETER_INTEGER_ARRAY => {
            XmlRpcValue::List(one.integer_array_value.iter().map(integer).collect())
        }
        ParameterType::PARAMETER_DOUBLE_ARRAY => one.double_array_value.clone().into(),
        ParameterType::PARAMETER_STRING_ARRAY => one.string_array_value.clone().into(),
        _ => return None,
    })
}
