//! State of the master, and its calls.

use std::collections::BTreeMap;

use super::parameters::{Change, Parameters};
use super::registrations::Registrations;
use crate::names::resolve;
use crate::xmlrpc::{RpcCall, RpcFault, XmlRpcValue};

/// A call that the master makes to a node.
#[derive(Clone, Debug, PartialEq)]
pub struct Notification {
    /// Address of the node.
    pub address: String,
    /// The call.
    pub call: RpcCall,
}

/// Registrations and parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MasterState {
    /// Address of the master.
    uri: String,
    /// Address of each node.
    nodes: BTreeMap<String, String>,
    publishers: Registrations,
    subscribers: Registrations,
    services: Registrations,
    topic_types: BTreeMap<String, String>,
    parameters: Parameters,
}

/// Result of a call: `[code, text, value]`.
enum Outcome {
    Done(String, XmlRpcValue),
    /// The call is right, and there is no such thing.
    Failed(String),
    /// The parameters of the call are wrong.
    Wrong(String),
}

use Outcome::{Done, Failed, Wrong};

/// Name of the master as caller.
const MASTER: &str = "/master";

/// Type of a topic that a subscriber leaves open.
const ANY_TYPE: &str = "*";

impl MasterState {
    /// Master with an address, such as `http://localhost:11311/`.
    #[must_use]
    pub fn new(uri: &str) -> Self {
        Self { uri: uri.to_owned(), ..Self::default() }
    }

    /// Answers a call, and returns the calls to make because of it.
    ///
    /// # Errors
    /// When there is no such method.
    pub fn call(&mut self, call: RpcCall) -> (Result<XmlRpcValue, RpcFault>, Vec<Notification>) {
        let mut out = Vec::new();
        let RpcCall { method, params } = call;
        let Some(outcome) = self.answer(&method, &params, &mut out) else {
            let text = format!("method `{method}` is not supported");
            return (Err(RpcFault { code: -1, text }), out);
        };
        let (code, text, value) = match outcome {
            Done(text, value) => (1, text, value),
            Failed(text) => (-1, text, XmlRpcValue::Int(0)),
            Wrong(text) => (-1, format!("ERROR: {method}: {text}"), XmlRpcValue::Int(0)),
        };
        (Ok(XmlRpcValue::List(vec![XmlRpcValue::Int(code), XmlRpcValue::Text(text), value])), out)
    }

    fn answer(
        &mut self,
        method: &str,
        params: &[XmlRpcValue],
        out: &mut Vec<Notification>,
    ) -> Option<Outcome> {
        let texts: Vec<&str> = params.iter().map_while(XmlRpcValue::text).collect();
        Some(match (method, texts.as_slice()) {
            ("getPid", _) => Done(String::new(), XmlRpcValue::Int(process_id())),
            ("getUri", _) => Done(String::new(), self.uri.clone().into()),
            ("registerService", &[node, service, address, api]) => {
                self.register_service(node, service, address, api, out)
            }
            ("unregisterService", &[node, service, address]) => {
                let was = self.services.remove(&resolve(service, node), node, address);
                removed(was, node, service)
            }
            ("registerSubscriber", &[node, topic, of, api]) => {
                self.register_subscriber(node, topic, of, api, out)
            }
            ("unregisterSubscriber", &[node, topic, api]) => {
                let was = self.subscribers.remove(&resolve(topic, node), node, api);
                removed(was, node, topic)
            }
            ("registerPublisher", &[node, topic, of, api]) => {
                self.register_publisher(node, topic, of, api, out)
            }
            ("unregisterPublisher", &[node, topic, api]) => {
                let topic = resolve(topic, node);
                let was = self.publishers.remove(&topic, node, api);
                if was {
                    self.tell_subscribers(&topic, out);
                }
                removed(was, node, &topic)
            }
            ("lookupNode", &[_, node]) => match self.nodes.get(&resolve(node, "/")) {
                Some(address) => Done("node api".into(), address.clone().into()),
                None => Failed(format!("unknown node [{node}]")),
            },
            ("lookupService", &[caller, service]) => {
                let service = resolve(service, caller);
                match self.services.at(&service).first() {
                    Some(one) => Done("rosrpc URI".into(), one.address.clone().into()),
                    None => Failed(format!("no provider of service [{service}]")),
                }
            }
            ("getPublishedTopics", &[caller, subgraph]) => self.published(caller, subgraph),
            ("getTopicTypes", _) => {
                let types = self.topic_types.iter();
                let pairs: Vec<XmlRpcValue> =
                    types.map(|(name, of)| vec![name.clone(), of.clone()].into()).collect();
                Done("current topics".into(), XmlRpcValue::List(pairs))
            }
            ("getSystemState", _) => {
                let all = [&self.publishers, &self.subscribers, &self.services];
                Done("current system state".into(), XmlRpcValue::List(all.map(state_of).into()))
            }
            ("deleteParam", &[caller, key]) => {
                let key = resolve(key, caller);
                match self.parameters.delete(&key) {
                    Some(changes) => {
                        tell(changes, out);
                        Done(format!("parameter {key} deleted"), XmlRpcValue::Int(0))
                    }
                    None => Failed(format!("parameter [{key}] is not set")),
                }
            }
            ("setParam", &[caller, key, ..]) if params.len() == 3 => {
                self.set_parameter(&resolve(key, caller), params[2].clone(), out)
            }
            ("getParam", &[caller, key]) => {
                let key = resolve(key, caller);
                match self.parameters.get(&key) {
                    Some(value) => Done(format!("Parameter [{key}]"), value.clone()),
                    None => Failed(format!("Parameter [{key}] is not set")),
                }
            }
            ("searchParam", &[caller, key]) => match self.parameters.search(key, caller) {
                Some(found) => Done("Found".into(), found.into()),
                None => Failed(format!("Cannot find parameter [{key}] in an upwards search")),
            },
            ("subscribeParam", &[caller, api, key]) => {
                let key = resolve(key, caller);
                self.register_node(caller, api, out);
                let value = self.parameters.subscribe(&key, api);
                Done(format!("Subscribed to parameter [{key}]"), value)
            }
            ("unsubscribeParam", &[caller, api, key]) => {
                let was = self.parameters.unsubscribe(&resolve(key, caller), api);
                removed(was, caller, key)
            }
            ("hasParam", &[caller, key]) => {
                let has = self.parameters.get(&resolve(key, caller)).is_some();
                Done(key.to_owned(), has.into())
            }
            ("getParamNames", _) => Done("Parameter names".into(), self.parameters.names().into()),
            (known, _) if METHODS.contains(&known) => {
                let kinds: Vec<&str> = params.iter().map(XmlRpcValue::kind).collect();
                Wrong(format!("got {} parameters: {}", params.len(), kinds.join(", ")))
            }
            _ => return None,
        })
    }

    /// Sets a parameter by its full name. The whole tree can only be a dictionary.
    fn set_parameter(
        &mut self,
        key: &str,
        value: XmlRpcValue,
        out: &mut Vec<Notification>,
    ) -> Outcome {
        if key.is_empty() && !matches!(value, XmlRpcValue::Struct(_)) {
            return Wrong("all parameters together are a dictionary".into());
        }
        tell(self.parameters.set(key, value), out);
        Done(format!("parameter {key} set"), XmlRpcValue::Int(0))
    }

    fn register_service(
        &mut self,
        node: &str,
        service: &str,
        address: &str,
        api: &str,
        out: &mut Vec<Notification>,
    ) -> Outcome {
        let service = resolve(service, node);
        self.register_node(node, api, out);
        self.services.replace(&service, node, address);
        Done(format!("Registered [{node}] as provider of [{service}]"), XmlRpcValue::Int(1))
    }

    fn register_subscriber(
        &mut self,
        node: &str,
        topic: &str,
        of: &str,
        api: &str,
        out: &mut Vec<Notification>,
    ) -> Outcome {
        let topic = resolve(topic, node);
        self.register_node(node, api, out);
        self.subscribers.add(&topic, node, api);
        if of != ANY_TYPE {
            self.topic_types.entry(topic.clone()).or_insert_with(|| of.to_owned());
        }
        Done(format!("Subscribed to [{topic}]"), self.publishers.addresses(&topic).into())
    }

    fn register_publisher(
        &mut self,
        node: &str,
        topic: &str,
        of: &str,
        api: &str,
        out: &mut Vec<Notification>,
    ) -> Outcome {
        let topic = resolve(topic, node);
        self.register_node(node, api, out);
        self.publishers.add(&topic, node, api);
        if of != ANY_TYPE || !self.topic_types.contains_key(&topic) {
            self.topic_types.insert(topic.clone(), of.to_owned());
        }
        self.tell_subscribers(&topic, out);
        let subscribers = self.subscribers.addresses(&topic);
        Done(format!("Registered [{node}] as publisher of [{topic}]"), subscribers.into())
    }

    /// Notes the address of a node. A node of the same name at another address is asked to end.
    fn register_node(&mut self, node: &str, api: &str, out: &mut Vec<Notification>) {
        let old = self.nodes.insert(node.to_owned(), api.to_owned());
        let Some(old) = old.filter(|old| old != api) else { return };
        let topics = self.publishers.forget(node);
        self.subscribers.forget(node);
        self.services.forget(node);
        self.parameters.forget(&old);
        for topic in topics {
            self.tell_subscribers(&topic, out);
        }
        let why = "new node registered with same name";
        let params = vec![MASTER.into(), format!("[{node}] Reason: {why}").into()];
        let call = RpcCall { method: "shutdown".to_owned(), params };
        out.push(Notification { address: old, call });
    }

    fn tell_subscribers(&self, topic: &str, out: &mut Vec<Notification>) {
        let publishers = self.publishers.addresses(topic);
        for one in self.subscribers.at(topic) {
            let params = vec![MASTER.into(), topic.into(), publishers.clone().into()];
            let call = RpcCall { method: "publisherUpdate".to_owned(), params };
            out.push(Notification { address: one.address.clone(), call });
        }
    }

    fn published(&self, caller: &str, subgraph: &str) -> Outcome {
        let under = match subgraph {
            "" => String::new(),
            subgraph => resolve(subgraph, caller) + "/",
        };
        let topics = self.publishers.iter().map(|(topic, _)| topic);
        let pairs = topics.filter(|topic| topic.starts_with(&under)).filter_map(|topic| {
            let of = self.topic_types.get(topic)?;
            Some(vec![topic.to_owned(), of.clone()].into())
        });
        Done("current topics".into(), XmlRpcValue::List(pairs.collect()))
    }

    /// Forgets nodes without topics, services and parameters; the answers of `lookupNode` would be wrong.
    pub(super) fn drop_idle_nodes(&mut self) {
        let Self { nodes, publishers, subscribers, services, .. } = self;
        nodes.retain(|node, _| {
            publishers.has_node(node) || subscribers.has_node(node) || services.has_node(node)
        });
    }
}

/// Methods with parameters.
const METHODS: [&str; 16] = [
    "registerService",
    "unregisterService",
    "registerSubscriber",
    "unregisterSubscriber",
    "registerPublisher",
    "unregisterPublisher",
    "lookupNode",
    "lookupService",
    "getPublishedTopics",
    "deleteParam",
    "setParam",
    "getParam",
    "searchParam",
    "subscribeParam",
    "unsubscribeParam",
    "hasParam",
];

fn tell(changes: Vec<Change>, out: &mut Vec<Notification>) {
    for Change { address, key, value } in changes {
        let params = vec![MASTER.into(), key.into(), value];
        out.push(Notification {
            address,
            call: RpcCall { method: "paramUpdate".to_owned(), params },
        });
    }
}

fn removed(was: bool, node: &str, name: &str) -> Outcome {
    let text = if was {
        format!("Unregistered [{node}] from [{name}]")
    } else {
        format!("[{node}] is not registered for [{name}]")
    };
    Done(text, XmlRpcValue::Int(i32::from(was)))
}

fn state_of(registrations: &Registrations) -> XmlRpcValue {
    let all = registrations.iter().map(|(key, all)| {
        let nodes: Vec<String> = all.iter().map(|one| one.node.clone()).collect();
        XmlRpcValue::List(vec![key.into(), nodes.into()])
    });
    XmlRpcValue::List(all.collect())
}

pub(crate) fn process_id() -> i32 {
    i32::try_from(std::process::id()).unwrap_or(i32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: &str = "http://here:1/";
    const B: &str = "http://here:2/";

    /// Result of a call of text parameters, and the calls because of it.
    #[track_caller]
    fn ask(
        state: &mut MasterState,
        method: &str,
        params: &[&str],
    ) -> (XmlRpcValue, Vec<Notification>) {
        let params = params.iter().map(|text| XmlRpcValue::from(*text)).collect();
        let (answer, out) = state.call(RpcCall { method: method.to_owned(), params });
        let Ok(XmlRpcValue::List(parts)) = answer else { panic!("{answer:?}") };
        assert_eq!(parts[0], XmlRpcValue::Int(1), "{parts:?}");
        (parts[2].clone(), out)
    }

    #[test]
    fn who_meets_at_a_topic_hears_of_the_other() {
        let mut state = MasterState::new("http://here:11311/");
        let (known, out) =
            ask(&mut state, "registerSubscriber", &["/map", "scan", "sensor_msgs/LaserScan", A]);
        assert_eq!((known, out), (XmlRpcValue::List(vec![]), vec![]));
        let (known, out) =
            ask(&mut state, "registerPublisher", &["/lidar", "/scan", "sensor_msgs/LaserScan", B]);
        assert_eq!(known, vec![A].into());
        let update = |publishers: Vec<&str>| Notification {
            address: A.to_owned(),
            call: RpcCall {
                method: "publisherUpdate".to_owned(),
                params: vec!["/master".into(), "/scan".into(), publishers.into()],
            },
        };
        assert_eq!(out, [update(vec![B])]);
        let (types, _) = ask(&mut state, "getPublishedTopics", &["/x", ""]);
        assert_eq!(types, XmlRpcValue::List(vec![vec!["/scan", "sensor_msgs/LaserScan"].into()]));
        let (count, out) = ask(&mut state, "unregisterPublisher", &["/lidar", "/scan", B]);
        assert_eq!((count, out), (XmlRpcValue::Int(1), vec![update(vec![])]));
        let (count, _) = ask(&mut state, "unregisterPublisher", &["/lidar", "/scan", B]);
        assert_eq!(count, XmlRpcValue::Int(0));
        state.drop_idle_nodes();
        let (found, _) = state.call(RpcCall {
            method: "lookupNode".into(),
            params: vec!["/x".into(), "/lidar".into()],
        });
        assert!(matches!(found, Ok(XmlRpcValue::List(parts)) if parts[0] == XmlRpcValue::Int(-1)));
    }

    #[test]
    fn a_second_node_of_a_name_ends_the_first() {
        let mut state = MasterState::new("http://here:11311/");
        ask(&mut state, "registerService", &["/lamp", "on", "rosrpc://here:5", A]);
        let (_, out) =
            ask(&mut state, "registerPublisher", &["/lamp", "state", "std_msgs/Bool", B]);
        assert_eq!(out.len(), 1);
        assert_eq!((out[0].address.as_str(), out[0].call.method.as_str()), (A, "shutdown"));
        let (answer, _) = state.call(RpcCall {
            method: "lookupService".into(),
            params: vec!["/x".into(), "/on".into()],
        });
        assert!(matches!(answer, Ok(XmlRpcValue::List(parts)) if parts[0] == XmlRpcValue::Int(-1)));
    }

    #[test]
    fn parameters_belong_to_namespaces() {
        let mut state = MasterState::new("http://here:11311/");
        let params = vec!["/slam".into(), "~delta".into(), XmlRpcValue::Double(0.05)];
        let _ = state.call(RpcCall { method: "setParam".into(), params });
        assert_eq!(
            ask(&mut state, "getParam", &["/x", "/slam/delta"]).0,
            XmlRpcValue::Double(0.05)
        );
        assert_eq!(ask(&mut state, "hasParam", &["/x", "delta"]).0, XmlRpcValue::Bool(false));
        assert_eq!(ask(&mut state, "searchParam", &["/slam", "delta"]).0, "/slam/delta".into());
        assert_eq!(ask(&mut state, "getParamNames", &["/x"]).0, vec!["/slam/delta"].into());
    }

    #[test]
    fn wrong_calls_are_refused() {
        let mut state = MasterState::new("http://here:11311/");
        let (answer, _) = state.call(RpcCall { method: "fly".into(), params: vec![] });
        assert!(answer.is_err());
        let call = RpcCall { method: "getParam".into(), params: vec![XmlRpcValue::Int(1)] };
        let (answer, _) = state.call(call);
        let text = "ERROR: getParam: got 1 parameters: an integer";
        let expected = vec![XmlRpcValue::Int(-1), text.into(), XmlRpcValue::Int(0)];
        assert_eq!(answer, Ok(XmlRpcValue::List(expected)));
        let params = vec!["/x".into(), "/".into(), XmlRpcValue::Int(1)];
        let (answer, _) = state.call(RpcCall { method: "setParam".into(), params });
        assert!(matches!(answer, Ok(XmlRpcValue::List(parts)) if parts[0] == XmlRpcValue::Int(-1)));
    }
}
