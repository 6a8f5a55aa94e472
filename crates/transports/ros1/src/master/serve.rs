//! A master on a port.

use std::net::{IpAddr, TcpStream};
use std::sync::{Arc, Mutex};

use periplus_transport::lock;

use super::notify::Notifier;
use super::rosout::Rosout;
use super::state::MasterState;
use crate::error::Ros1Error;
use crate::rpc::uri_host;
use crate::server::{Handler, Server};
use crate::xmlrpc::{RpcCall, RpcFault, XmlRpcValue};

/// A master with a parameter server and the node `/rosout`, until this is dropped.
pub struct Master {
    uri: String,
    // Declared first, so that it leaves the master before that ends.
    _rosout: Rosout,
    _server: Server,
}

struct MasterHandler {
    state: Mutex<MasterState>,
    notifier: Notifier,
}

impl Handler for MasterHandler {
    fn call(&self, call: RpcCall) -> Result<XmlRpcValue, RpcFault> {
        let is_removal = call.method.starts_with("unregister");
        let mut state = lock(&self.state);
        let (answer, out) = state.call(call);
        if is_removal {
            state.drop_idle_nodes();
        }
        // Under the lock, so that updates are sent in the order of the changes.
        self.notifier.send(out);
        answer
    }

    fn connect(&self, _: [u8; 4], _: TcpStream) {
        // A master has no topics; the connection is closed.
    }
}

impl Master {
    /// Serves a master at an address. `host` is the name by which other programs reach it.
    ///
    /// # Errors
    /// When the port is taken.
    pub fn open(address: IpAddr, host: &str, port: u16) -> Result<Self, Ros1Error> {
        let handler = |uri: &str| {
            let state = Mutex::new(MasterState::new(uri));
            Arc::new(MasterHandler { state, notifier: Notifier::default() })
        };
        let shown = uri_host(host);
        // A free port is known only afterwards.
        let serving = handler(&format!("http://{shown}:{port}/"));
        let server = Server::open(address, port, serving.clone()).map_err(|error| {
            Ros1Error::Port { address: format!("{address}:{port}"), why: error.to_string() }
        })?;
        let uri = format!("http://{shown}:{}/", server.port());
        *lock(&serving.state) = MasterState::new(&uri);
        let setting = |key: &str, value: &str| {
            let params = vec!["/master".into(), key.into(), value.into()];
            let _ = serving.call(RpcCall { method: "setParam".to_owned(), params });
        };
        setting("/rosdistro", "noetic\n");
        setting("/rosversion", "1.16.0\n");
        let rosout = Rosout::open(address, host, &uri)?;
        Ok(Self { uri, _rosout: rosout, _server: server })
    }

    /// Address, such as `http://localhost:11311/`.
    #[must_use]
    pub fn uri(&self) -> &str {
        &self.uri
    }
}
