//! Nodes.

use std::sync::{Arc, Mutex};

use periplus::graph::{Arguments, Node, NodeNames, NodeSettings};
use periplus_lockstep::NodeWords;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::arguments::{self, parameter_object};
use super::backend::{Backend, Shared, link_error};
use super::endpoints::{RosClient, RosPublisher, RosServer, RosSubscription};
use super::qos::{self, QosWords, Side};
use crate::errors::{runtime_error, value_error};
use crate::messages::{Style, TypeHandle, plan_of_style};
use crate::work::{lock, released};

create_exception!(
    periplus,
    RosNameError,
    PyValueError,
    "Name of a node, topic or service that ROS 2 does not allow."
);

/// The node in its backend.
pub(crate) enum Place {
    Live(Node),
    Lockstep(u32),
    Closed,
}

/// A node: names, and the endpoints that it creates.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct RosNode {
    shared: Arc<Shared>,
    names: NodeNames,
    own: Arguments,
    takes_global: bool,
    place: Mutex<Place>,
}

pub(crate) fn new_node(
    py: Python<'_>,
    shared: &Arc<Shared>,
    name: &str,
    namespace: &str,
    takes_global: bool,
    words: &[String],
) -> PyResult<RosNode> {
    let own = arguments::read(py, words)?;
    let mut settings = NodeSettings::new(name).namespace(namespace).with_arguments(&own);
    if takes_global {
        settings = settings.with_arguments(&shared.arguments);
    }
    let names = settings.names().map_err(|error| RosNameError::new_err(error.to_string()))?;
    let place = match &shared.backend {
        Backend::Live { graph, .. } => {
            let settings = NodeSettings::new(names.name()).namespace(names.namespace());
            let settings = settings.bare().keep_names().share_name();
            Place::Live(graph.node(settings).map_err(runtime_error)?)
        }
        Backend::Lockstep(client) => {
            let words = NodeWords {
                name: names.name().to_owned(),
                namespace: names.namespace().to_owned(),
            };
            let made = released(py, "creating a node", || client.node(&words))?;
            Place::Lockstep(made.map_err(link_error)?)
        }
    };
    Ok(RosNode { shared: shared.clone(), names, own, takes_global, place: Mutex::new(place) })
}

#[pymethods]
impl RosNode {
    /// Name without namespace.
    #[getter]
    fn name(&self) -> &str {
        self.names.name()
    }

    /// Namespace; `/` is the root.
    #[getter]
    fn namespace(&self) -> &str {
        self.names.namespace()
    }

    /// Number of the log level that the arguments give; 0 for none.
    #[getter]
    fn log_level(&self) -> u8 {
        let logger = self.names.full_name().trim_start_matches('/').replace('/', ".");
        let own = self.own.given_level_of(&logger);
        let level = own.or_else(|| self.shared.arguments.given_level_of(&logger));
        level.map_or(0, |level| level.number())
    }

    /// True if the node logs to `/rosout`.
    #[getter]
    fn logs_to_rosout(&self) -> bool {
        self.shared.arguments.logs_to_rosout() && self.own.logs_to_rosout()
    }

    /// Values of parameters that the arguments give.
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let full = self.names.full_name();
        let mut all = match self.takes_global {
            true => self.shared.arguments.parameters_of(&full),
            false => Default::default(),
        };
        all.extend(self.own.parameters_of(&full));
        let values = PyDict::new(py);
        for (name, value) in &all {
            values.set_item(name, parameter_object(py, value)?)?;
        }
        Ok(values)
    }

    /// Full name of a topic or service.
    #[pyo3(signature = (name, *, service=false, remap=true))]
    fn resolve(&self, name: &str, service: bool, remap: bool) -> PyResult<String> {
        let full = match (service, remap) {
            (false, true) => self.names.topic(name),
            (true, true) => self.names.service(name),
            (false, false) => self.names.expanded_topic(name),
            (true, false) => self.names.expanded_service(name),
        };
        full.map_err(|error| RosNameError::new_err(error.to_string()))
    }

    /// Creates a publisher of a topic, by its full name.
    fn publisher(
        &self,
        py: Python<'_>,
        topic: &str,
        type_name: &str,
        qos: QosWords,
    ) -> PyResult<RosPublisher> {
        let qos = qos::read(qos, Side::Publisher)?;
        let hash = hash_of(type_name);
        RosPublisher::new(py, &self.shared, &lock(&self.place), topic, (type_name, hash), qos)
    }

    /// Creates a subscription to a topic, by its full name.
    #[pyo3(signature = (topic, type_name, qos, *, style="rosidl"))]
    fn subscription(
        &self,
        py: Python<'_>,
        topic: &str,
        type_name: &str,
        qos: QosWords,
        style: &str,
    ) -> PyResult<RosSubscription> {
        let qos = qos::read(qos, Side::Subscription)?;
        let plan = plan_for(type_name, style)?;
        RosSubscription::new(py, &self.shared, &lock(&self.place), topic, plan, qos)
    }

    /// Creates a client of a service, by its full name.
    #[pyo3(signature = (service, type_name, *, style="rosidl"))]
    fn client(
        &self,
        py: Python<'_>,
        service: &str,
        type_name: &str,
        style: &str,
    ) -> PyResult<RosClient> {
        let response = plan_for(&format!("{type_name}_Response"), style)?;
        let kind = (type_name, hash_of(type_name));
        RosClient::new(py, &self.shared, &lock(&self.place), service, kind, response)
    }

    /// Creates a server of a service, by its full name.
    #[pyo3(signature = (service, type_name, *, style="rosidl"))]
    fn server(
        &self,
        py: Python<'_>,
        service: &str,
        type_name: &str,
        style: &str,
    ) -> PyResult<RosServer> {
        let request = plan_for(&format!("{type_name}_Request"), style)?;
        let kind = (type_name, hash_of(type_name));
        RosServer::new(py, &self.shared, &lock(&self.place), service, kind, request)
    }

    /// Removes the node; its endpoints stay until they are closed.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let place = std::mem::replace(&mut *lock(&self.place), Place::Closed);
        let shared = &self.shared;
        released(py, "removing a node", || match (place, &shared.backend) {
            (Place::Lockstep(id), Backend::Lockstep(client)) => client.remove(id),
            (place, _) => drop(place),
        })
    }
}

/// Type hash of a message or service.
fn hash_of(type_name: &str) -> Option<String> {
    crate::messages::type_hash(type_name)
}

fn plan_for(type_name: &str, style: &str) -> PyResult<TypeHandle> {
    let style = match style {
        "rosidl" => Style::Rosidl,
        "genpy" => Style::Genpy,
        _ => return Err(value_error("`style` must be 'rosidl' or 'genpy'")),
    };
    let plan = plan_of_style(type_name, style);
    plan.map(TypeHandle).ok_or_else(|| crate::messages::unknown_type(type_name))
}
