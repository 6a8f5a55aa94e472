//! Calls to the master.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use crate::rpc::{self, RpcError};
use crate::tcpros::{ServiceConnection, ServiceEnd};
use crate::xmlrpc::{RpcCall, XmlRpcValue};

/// Timeout of a call to the master.
const PATIENCE: Duration = Duration::from_secs(3);

/// A master, called in the name of a node.
#[derive(Clone, Debug)]
pub struct MasterClient {
    uri: String,
    caller: String,
}

/// Nodes at topics and services, by name.
pub type NodesByName = Vec<(String, Vec<String>)>;

/// Everything that is registered.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SystemState {
    /// Publishers of each topic.
    pub publishers: NodesByName,
    /// Subscribers of each topic.
    pub subscribers: NodesByName,
    /// Nodes that serve each service.
    pub services: NodesByName,
    /// Type of each topic.
    pub topic_types: BTreeMap<String, String>,
}

impl SystemState {
    /// Without the nodes of these names, and what only they have.
    #[must_use]
    pub fn without(mut self, nodes: &BTreeSet<String>) -> Self {
        for all in [&mut self.publishers, &mut self.subscribers, &mut self.services] {
            for (_, names) in all.iter_mut() {
                names.retain(|name| !nodes.contains(name));
            }
            all.retain(|(_, names)| !names.is_empty());
        }
        self
    }
}

impl MasterClient {
    /// Client of the master at `uri` in the name of the node `caller`.
    #[must_use]
    pub fn new(uri: &str, caller: &str) -> Self {
        Self { uri: uri.to_owned(), caller: caller.to_owned() }
    }

    /// Address of the master.
    #[must_use]
    pub fn uri(&self) -> &str {
        &self.uri
    }

    /// Calls a method with the name of the caller before these parameters.
    ///
    /// # Errors
    /// When the master does not answer or refuses.
    pub fn ask(&self, method: &str, params: Vec<XmlRpcValue>) -> Result<XmlRpcValue, RpcError> {
        let mut all = vec![self.caller.as_str().into()];
        all.extend(params);
        rpc::ask(&self.uri, method, all, PATIENCE)
    }

    /// Address of a node.
    ///
    /// # Errors
    /// As [`MasterClient::ask`], also if there is no such node.
    pub fn node(&self, name: &str) -> Result<String, RpcError> {
        let uri = self.ask("lookupNode", vec![name.into()])?;
        Ok(uri.text().unwrap_or_default().to_owned())
    }

    /// Address of a service.
    ///
    /// # Errors
    /// As [`MasterClient::ask`], also if no node serves it.
    pub fn service(&self, name: &str) -> Result<String, RpcError> {
        let uri = self.ask("lookupService", vec![name.into()])?;
        Ok(uri.text().unwrap_or_default().to_owned())
    }

    /// Type of a service, as its server states it.
    ///
    /// # Errors
    /// As [`MasterClient::service`], and if the server does not answer.
    pub fn service_type(&self, name: &str) -> Result<String, RpcError> {
        let uri = self.service(name)?;
        let connection = ServiceConnection::open(&uri, &self.caller, name, "*", true);
        let connection = connection.map_err(|end| match end {
            ServiceEnd::Lost(why) => RpcError::Unreachable(format!("{uri} does not answer: {why}")),
            ServiceEnd::Refused(why) => RpcError::Refused(why),
        })?;
        Ok(connection.header.get("type").to_owned())
    }

    /// Sets a parameter by its full name.
    ///
    /// # Errors
    /// As [`MasterClient::ask`].
    pub fn set_parameter(&self, key: &str, value: XmlRpcValue) -> Result<(), RpcError> {
        self.ask("setParam", vec![key.into(), value]).map(drop)
    }

    /// Sets parameters in one request.
    ///
    /// # Errors
    /// As [`MasterClient::ask`].
    pub fn set_parameters(&self, parameters: Vec<(String, XmlRpcValue)>) -> Result<(), RpcError> {
        if parameters.is_empty() {
            return Ok(());
        }
        let calls = parameters.into_iter().map(|(key, value)| {
            let params = XmlRpcValue::List(vec![self.caller.as_str().into(), key.into(), value]);
            let members =
                [("methodName".to_owned(), "setParam".into()), ("params".to_owned(), params)];
            XmlRpcValue::Struct(members.into())
        });
        let params = vec![XmlRpcValue::List(calls.collect())];
        let call = RpcCall { method: "system.multicall".to_owned(), params };
        rpc::call(&self.uri, &call, PATIENCE).map(drop)
    }

    /// Everything that is registered.
    ///
    /// # Errors
    /// As [`MasterClient::ask`].
    pub fn system_state(&self) -> Result<SystemState, RpcError> {
        let state = self.ask("getSystemState", Vec::new())?;
        let types = self.ask("getTopicTypes", Vec::new())?;
        let part = |index: usize| {
            let rows = state.list().and_then(|parts| parts.get(index)).and_then(XmlRpcValue::list);
            let rows = rows.unwrap_or_default().iter().filter_map(|row| match row.list()? {
                [name, nodes] => {
                    let nodes = nodes.list()?.iter().filter_map(XmlRpcValue::text);
                    Some((name.text()?.to_owned(), nodes.map(str::to_owned).collect()))
                }
                _ => None,
            });
            rows.collect()
        };
        let pairs = types.list().unwrap_or_default().iter().filter_map(|row| match row.list()? {
            [name, of] => Some((name.text()?.to_owned(), of.text()?.to_owned())),
            _ => None,
        });
        Ok(SystemState {
            publishers: part(0),
            subscribers: part(1),
            services: part(2),
            topic_types: pairs.collect(),
        })
    }
}
