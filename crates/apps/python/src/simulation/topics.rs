//! Topics, services, parameters and transforms of a simulation.

use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use periplus::graph::{Graph, Qos, RawPublisher};
use periplus::msgs::Service;
use periplus::msgs::rcl_interfaces::{
    GetParameters, GetParametersRequest, ListParameters, ListParametersRequest, Parameter,
    ParameterValue, SetParameters, SetParametersRequest,
};
use pyo3::exceptions::{PyKeyError, PyTimeoutError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyType;

use super::PySimulation;
use super::running::{Delivery, Running};
use super::watch::CallbackWatch;
use crate::errors::{runtime_error, value_error};
use crate::messages::{from_python, plan_of_type, to_python};
use crate::poses::PyPose;
use crate::ros::RosGraph;
use crate::work::lock;

/// Messages that wait for a subscription of Python: enough for any sensor between two looks.
const SUBSCRIPTION_DEPTH: usize = 1000;

/// Functions of Python that messages and requests are for, and publishers by topic.
#[derive(Default)]
pub(crate) struct Callbacks {
    subscriptions: Mutex<BTreeMap<usize, Callback>>,
    services: Mutex<BTreeMap<usize, Callback>>,
    publishers: Mutex<HashMap<String, Arc<RawPublisher>>>,
    watch: CallbackWatch,
    /// Number of subscriptions and services, so that a simulation without any pays nothing.
    count: AtomicUsize,
}

struct Callback {
    function: Py<PyAny>,
    /// Type of the messages, or of the requests.
    type_name: String,
    /// Topic or service.
    name: String,
}

impl Callbacks {
    /// Calls what is due. The first exception ends it; what is left stays due.
    pub(crate) fn run_due(&self, py: Python<'_>, simulation: &PySimulation) -> PyResult<()> {
        if self.count.load(Ordering::Relaxed) == 0 {
            return Ok(());
        }
        while let Some(delivery) = simulation.with(py, |running| running.due.pop_front())? {
            match delivery {
                Delivery::Message(number, sample) => {
                    let Some((function, type_name, name)) = get(py, &self.subscriptions, number)
                    else {
                        continue;
                    };
                    let bytes = sample.cdr().map_err(runtime_error)?;
                    let message = to_python(py, &type_name, bytes)?;
                    self.call(py, &function, &name, (message,))?;
                }
                Delivery::Request(number, call) => {
                    let Some((function, type_name, name)) = get(py, &self.services, number) else {
                        continue;
                    };
                    let bytes = call.request.cdr().map_err(runtime_error)?;
                    let request = to_python(py, &type_name, bytes)?;
                    let response = self.call(py, &function, &name, (request,))?;
                    let (found, cdr) = from_python(response.bind(py))?;
                    let wanted = response_type(&type_name);
                    if found != wanted {
                        return Err(PyTypeError::new_err(format!(
                            "the callback of {name} must return a {wanted}, not a {found}"
                        )));
                    }
                    call.answer(cdr);
                    simulation.with(py, Running::settle)?;
                }
            }
        }
        Ok(())
    }

    /// Calls a function of Python; an exception names the topic or service.
    fn call<'py, A>(
        &self,
        py: Python<'py>,
        function: &Py<PyAny>,
        name: &str,
        arguments: A,
    ) -> PyResult<Py<PyAny>>
    where
        A: pyo3::call::PyCallArgs<'py>,
    {
        let called = format!("the callback of {name}, {},", shown(function.bind(py)));
        let result = self.watch.over(&called, || function.call1(py, arguments));
        result.inspect_err(|error| {
            // Python 3.11 and later show notes in the traceback.
            let _ =
                error.value(py).call_method1("add_note", (format!("in the callback of {name}"),));
        })
    }
}

fn get(
    py: Python<'_>,
    list: &Mutex<BTreeMap<usize, Callback>>,
    number: usize,
) -> Option<(Py<PyAny>, String, String)> {
    let list = lock(list);
    let callback = list.get(&number)?;
    Some((callback.function.clone_ref(py), callback.type_name.clone(), callback.name.clone()))
}

/// Name, file and line of a function: `on_scan (robot.py:12)`.
fn shown(function: &Bound<'_, PyAny>) -> String {
    let name = function.getattr("__qualname__").and_then(|it| it.extract::<String>());
    let name = name.unwrap_or_else(|_| function.to_string());
    let place = function.getattr("__code__").and_then(|code| {
        let file: String = code.getattr("co_filename")?.extract()?;
        let line: u32 = code.getattr("co_firstlineno")?.extract()?;
        Ok(format!("{name} ({file}:{line})"))
    });
    place.unwrap_or(name)
}

/// Name of the type of a service, from its class.
fn service_name(class: &Bound<'_, PyAny>) -> PyResult<String> {
    let request = class.getattr("Request").and_then(|request| plan_of_type(&request));
    let name = request.ok().and_then(|it| it.type_name.strip_suffix("_Request").map(str::to_owned));
    name.ok_or_else(|| {
        PyTypeError::new_err("`service_type` must be the class of a service, such as Trigger")
    })
}

/// `pkg/srv/Type_Request` to `pkg/srv/Type_Response`.
fn response_type(request: &str) -> String {
    request.strip_suffix("_Request").map_or_else(String::new, |base| format!("{base}_Response"))
}

/// A subscription of a simulation.
#[pyclass(name = "Subscription", module = "periplus", frozen)]
pub(crate) struct PySubscription {
    simulation: Py<PySimulation>,
    number: usize,
    #[pyo3(get)]
    /// Full name of the topic.
    topic: String,
    #[pyo3(get)]
    /// Type of its messages, such as ``sensor_msgs/msg/LaserScan``.
    type_name: String,
}

#[pymethods]
impl PySubscription {
    /// End the subscription; messages that wait are dropped.
    fn cancel(&self, py: Python<'_>) -> PyResult<()> {
        let simulation = self.simulation.get();
        simulation.with(py, |running| {
            running.subscriptions[self.number] = None;
        })?;
        // Dropped after the lock: the end of a function of Python may run code of Python.
        let ended = lock(&simulation.callbacks.subscriptions).remove(&self.number);
        drop(ended);
        Ok(())
    }

    fn __repr__(&self) -> String {
        format!("<periplus.Subscription of {} ({})>", self.topic, self.type_name)
    }
}

#[pymethods]
impl PySimulation {
    /// Topics with their types, such as ``{"/scan": "sensor_msgs/msg/LaserScan"}``.
    #[getter]
    fn topics(&self, py: Python<'_>) -> PyResult<BTreeMap<String, String>> {
        self.with(py, |running| topics_of(running.graph()))
    }

    /// Services with their types.
    #[getter]
    fn services(&self, py: Python<'_>) -> PyResult<BTreeMap<String, String>> {
        self.with(py, |running| {
            let services = running.graph().services().into_iter();
            services.map(|service| (service.name, service.type_name)).collect()
        })
    }

    /// Graph of the simulation for nodes of ``rclpy`` in this process, which the fixture ``ros`` of pytest makes.
    ///
    /// ``arguments`` are words after ``--ros-args``, for all nodes.
    #[pyo3(signature = (arguments=Vec::new()))]
    fn ros_graph(&self, py: Python<'_>, arguments: Vec<String>) -> PyResult<RosGraph> {
        let graph = self.with(py, |running| running.graph().clone())?;
        RosGraph::beside(py, graph, &arguments)
    }

    /// Full names of the nodes.
    #[getter]
    fn nodes(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |running| running.graph().nodes().into_iter().map(|node| node.name).collect())
    }

    /// Publish a message. It is delivered before the next step.
    ///
    /// Parameters
    /// ----------
    /// topic : str
    ///     Name of the topic.
    /// message : message
    ///     An object of a class of ``periplus.msgs``.
    /// latched : bool
    ///     True if later subscriptions get the last message too (transient local).
    ///
    /// Raises ``ValueError`` for a name that is not valid or a topic of another type, and an error that names the
    /// field for a value that does not fit.
    #[pyo3(signature = (topic, message, *, latched=false))]
    fn publish(
        &self,
        py: Python<'_>,
        topic: &str,
        message: &Bound<'_, PyAny>,
        latched: bool,
    ) -> PyResult<()> {
        let (type_name, cdr) = from_python(message)?;
        let key = format!("{latched} {type_name} {topic}");
        let known = lock(&self.callbacks.publishers).get(&key).cloned();
        let publisher = match known {
            Some(publisher) => publisher,
            None => {
                let qos = if latched { Qos::latched(1) } else { Qos::reliable(10) };
                let made = self
                    .with(py, |running| running.node.raw_publisher(topic, &type_name, None, qos))?;
                let publisher = Arc::new(made.map_err(value_error)?);
                lock(&self.callbacks.publishers).insert(key, Arc::clone(&publisher));
                publisher
            }
        };
        publisher.publish(cdr);
        Ok(())
    }

    /// Call ``callback(message)`` for each message of a topic, after the step in which it arrives.
    ///
    /// Parameters
    /// ----------
    /// topic : str
    ///     Name of the topic.
    /// callback : callable
    ///     A function of one argument. It may publish, call services and change the world.
    /// message_type : class or str, optional
    ///     Class of the messages or name of their type; default: that of the topic, which must then exist.
    /// latched : bool
    ///     True to get the last message of a latched topic first.
    ///
    /// Returns a ``Subscription``, whose ``cancel()`` ends it.
    #[pyo3(signature = (topic, callback, message_type=None, *, latched=false))]
    fn subscribe(
        slf: Bound<'_, Self>,
        topic: &str,
        callback: Bound<'_, PyAny>,
        message_type: Option<&Bound<'_, PyAny>>,
        latched: bool,
    ) -> PyResult<PySubscription> {
        let py = slf.py();
        let this = slf.get();
        if !callback.is_callable() {
            return Err(PyTypeError::new_err("`callback` must be callable"));
        }
        let type_name = this.type_of(py, topic, message_type)?;
        let qos = match latched {
            true => Qos::latched(SUBSCRIPTION_DEPTH),
            false => Qos::best_effort(SUBSCRIPTION_DEPTH),
        };
        let made = this.with(py, |running| {
            let mailbox = running.node.raw_mailbox(topic, &type_name, None, qos)?;
            let name = mailbox.topic().to_owned();
            running.subscriptions.push(Some(mailbox));
            Ok((running.subscriptions.len() - 1, name))
        })?;
        let (number, name) =
            made.map_err(|error: periplus::graph::GraphError| value_error(error))?;
        let function = callback.unbind();
        let entry = Callback { function, type_name: type_name.clone(), name: name.clone() };
        lock(&this.callbacks.subscriptions).insert(number, entry);
        this.callbacks.count.fetch_add(1, Ordering::Relaxed);
        Ok(PySubscription { simulation: slf.unbind(), number, topic: name, type_name })
    }

    /// Offer a service: ``callback(request)`` returns the response.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Name of the service.
    /// service_type : class
    ///     Class of the service, such as ``periplus.msgs.std_srvs.srv.Trigger``.
    /// callback : callable
    ///     A function from a request to a response.
    fn create_service(
        &self,
        py: Python<'_>,
        name: &str,
        service_type: &Bound<'_, PyAny>,
        callback: Bound<'_, PyAny>,
    ) -> PyResult<()> {
        if !callback.is_callable() {
            return Err(PyTypeError::new_err("`callback` must be callable"));
        }
        let type_name = service_name(service_type)?;
        let made = self.with(py, |running| {
            let calls = running.node.raw_server(name, &type_name, None)?;
            running.services.push(calls);
            Ok(running.services.len() - 1)
        })?;
        let number = made.map_err(|error: periplus::graph::GraphError| value_error(error))?;
        let type_name = format!("{type_name}_Request");
        let entry = Callback { function: callback.unbind(), type_name, name: name.to_owned() };
        lock(&self.callbacks.services).insert(number, entry);
        self.callbacks.count.fetch_add(1, Ordering::Relaxed);
        Ok(())
    }

    /// Call a service and return its response. Services of the simulation answer at the present time; for another
    /// the simulation steps, up to ``timeout_s`` of simulated time.
    ///
    /// Raises ``TimeoutError`` without an answer, ``RuntimeError`` without a server, ``TypeError`` for a request of
    /// another type.
    #[pyo3(signature = (service, request, *, timeout_s=1.0))]
    fn call<'py>(
        &self,
        py: Python<'py>,
        service: &str,
        request: &Bound<'py, PyAny>,
        timeout_s: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (request_type, cdr) = from_python(request)?;
        let Some(base) = request_type.strip_suffix("_Request") else {
            return Err(PyTypeError::new_err(format!(
                "`request` must be a request, such as Trigger.Request(), not a {request_type}"
            )));
        };
        let answer = Arc::new(Mutex::new(None));
        let slot = Arc::clone(&answer);
        let sent = self.with(py, |running| {
            let client = running.node.raw_client(service, base, None)?;
            client.call(cdr, move |response| *lock(&slot) = Some(response));
            running.settle();
            Ok(running.simulation().time_ns())
        })?;
        let start_ns = sent.map_err(|error: periplus::graph::GraphError| value_error(error))?;
        loop {
            self.callbacks.run_due(py, self)?;
            self.with(py, Running::settle)?;
            if let Some(response) = lock(&answer).take() {
                let response = response.map_err(runtime_error)?;
                let bytes = response.cdr().map_err(runtime_error)?;
                return to_python(py, &format!("{base}_Response"), bytes);
            }
            if (self.time_ns(py)? - start_ns) as f64 * 1e-9 >= timeout_s {
                return Err(PyTimeoutError::new_err(format!(
                    "{service} did not answer within {timeout_s} s of simulated time"
                )));
            }
            self.step(py, 1)?;
        }
    }

    /// Transform between two frames of ``/tf``: the pose of ``source`` in ``target``, at a time [s] or the latest.
    /// Those of the last 10 s are known.
    ///
    /// Raises ``LookupError`` with the reason.
    #[pyo3(signature = (target, source, time_s=None))]
    fn lookup_transform(
        &self,
        py: Python<'_>,
        target: &str,
        source: &str,
        time_s: Option<f64>,
    ) -> PyResult<PyPose> {
        let time_ns = time_s.map_or(0, |time_s| (time_s * 1e9).round() as i64);
        let found = self.with(py, |running| {
            let transforms = &mut running.transforms;
            transforms.receive();
            let found = transforms.frames.at(target, source, time_ns);
            found.map(|(pose, _)| pose).map_err(|error| error.to_string())
        })?;
        found.map(PyPose).map_err(pyo3::exceptions::PyLookupError::new_err)
    }

    /// Value of a parameter of a node: bool, int, float, str or a list of them; None if it is not set.
    ///
    /// Raises ``KeyError`` for a node without parameters.
    fn get_parameter<'py>(
        &self,
        py: Python<'py>,
        node: &str,
        name: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let request = GetParametersRequest { names: vec![name.to_owned()] };
        let response = self.ask::<GetParameters>(py, node, "get_parameters", request)?;
        parameter_to_python(py, response.values.first())
    }

    /// Set a parameter of a node.
    ///
    /// Raises ``KeyError`` for a node without parameters, ``ValueError`` with the node's reason if it refuses.
    fn set_parameter(
        &self,
        py: Python<'_>,
        node: &str,
        name: &str,
        value: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let value = parameter_from_python(value)?;
        let parameter = Parameter { name: name.to_owned(), value };
        let request = SetParametersRequest { parameters: vec![parameter] };
        let response = self.ask::<SetParameters>(py, node, "set_parameters", request)?;
        match response.results.first() {
            Some(result) if !result.successful => {
                Err(PyValueError::new_err(format!("{node}: {}", result.reason)))
            }
            _ => Ok(()),
        }
    }

    /// All parameters of a node, by name.
    ///
    /// Raises ``KeyError`` for a node without parameters.
    fn parameters<'py>(
        &self,
        py: Python<'py>,
        node: &str,
    ) -> PyResult<BTreeMap<String, Bound<'py, PyAny>>> {
        let listed = self.ask::<ListParameters>(
            py,
            node,
            "list_parameters",
            ListParametersRequest::default(),
        )?;
        let names = listed.result.names.clone();
        let request = GetParametersRequest { names: names.clone() };
        let response = self.ask::<GetParameters>(py, node, "get_parameters", request)?;
        let values = names.into_iter().zip(&response.values);
        values.map(|(name, value)| Ok((name, parameter_to_python(py, Some(value))?))).collect()
    }
}

impl PySimulation {
    /// Type of a topic: as given, or that of the existing topic.
    fn type_of(
        &self,
        py: Python<'_>,
        topic: &str,
        given: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        if let Some(given) = given {
            return Ok(plan_of_type(given)?.type_name.clone());
        }
        let full = if topic.starts_with('/') { topic.to_owned() } else { format!("/{topic}") };
        let topics = self.topics(py)?;
        topics.get(&full).cloned().ok_or_else(|| {
            let near = periplus::diagnostics::closest(&full, topics.keys().map(String::as_str));
            let near = near.map(|near| format!("; did you mean {near:?}?")).unwrap_or_default();
            PyKeyError::new_err(format!(
                "no topic {full:?}{near} Give `message_type` for a topic that appears later"
            ))
        })
    }

    /// Calls a parameter service of a node at the present time.
    fn ask<S: Service>(
        &self,
        py: Python<'_>,
        node: &str,
        service: &str,
        request: S::Request,
    ) -> PyResult<Arc<S::Response>>
    where
        S::Request: Send,
        S::Response: Send + Sync,
    {
        let full = format!("/{}/{service}", node.trim_matches('/'));
        let answer = self.with(py, |running| {
            let client = running.node.client::<S>(&full).map_err(|error| error.to_string())?;
            let pending = client.call(request);
            running.settle();
            match pending.take() {
                Some(answer) => answer.map_err(|error| error.to_string()),
                None => Err(format!("{full} did not answer")),
            }
        })?;
        answer.map_err(PyKeyError::new_err)
    }
}

fn topics_of(graph: &Graph) -> BTreeMap<String, String> {
    graph.topics().into_iter().map(|topic| (topic.name, topic.type_name)).collect()
}

/// Kinds of parameters, as in `rcl_interfaces/msg/ParameterType`.
const BOOL: u8 = 1;
const INTEGER: u8 = 2;
const DOUBLE: u8 = 3;
const STRING: u8 = 4;
const BYTE_ARRAY: u8 = 5;
const BOOL_ARRAY: u8 = 6;
const INTEGER_ARRAY: u8 = 7;
const DOUBLE_ARRAY: u8 = 8;
const STRING_ARRAY: u8 = 9;

fn parameter_to_python<'py>(
    py: Python<'py>,
    value: Option<&ParameterValue>,
) -> PyResult<Bound<'py, PyAny>> {
    let Some(value) = value else { return Ok(py.None().into_bound(py)) };
    Ok(match value.r#type {
        BOOL => value.bool_value.into_pyobject(py)?.to_owned().into_any(),
        INTEGER => value.integer_value.into_pyobject(py)?.into_any(),
        DOUBLE => value.double_value.into_pyobject(py)?.into_any(),
        STRING => value.string_value.as_str().into_pyobject(py)?.into_any(),
        BYTE_ARRAY => pyo3::types::PyBytes::new(py, &value.byte_array_value).into_any(),
        BOOL_ARRAY => value.bool_array_value.clone().into_pyobject(py)?,
        INTEGER_ARRAY => value.integer_array_value.clone().into_pyobject(py)?,
        DOUBLE_ARRAY => value.double_array_value.clone().into_pyobject(py)?,
        STRING_ARRAY => value.string_array_value.clone().into_pyobject(py)?,
        _ => py.None().into_bound(py),
    })
}

fn parameter_from_python(value: &Bound<'_, PyAny>) -> PyResult<ParameterValue> {
    let mut made = ParameterValue::default();
    if value.is_none() {
        return Ok(made);
    }
    if let Ok(value) = value.extract::<bool>() {
        (made.r#type, made.bool_value) = (BOOL, value);
    } else if let Ok(value) = value.extract::<i64>() {
        (made.r#type, made.integer_value) = (INTEGER, value);
    } else if let Ok(value) = value.extract::<f64>() {
        (made.r#type, made.double_value) = (DOUBLE, value);
    } else if let Ok(value) = value.extract::<String>() {
        (made.r#type, made.string_value) = (STRING, value);
    } else if let Ok(value) = value.extract::<Vec<bool>>() {
        (made.r#type, made.bool_array_value) = (BOOL_ARRAY, value);
    } else if let Ok(value) = value.extract::<Vec<i64>>() {
        (made.r#type, made.integer_array_value) = (INTEGER_ARRAY, value);
    } else if let Ok(value) = value.extract::<Vec<f64>>() {
        (made.r#type, made.double_array_value) = (DOUBLE_ARRAY, value);
    } else if let Ok(value) = value.extract::<Vec<String>>() {
        (made.r#type, made.string_array_value) = (STRING_ARRAY, value);
    } else {
        let kind = value.get_type();
        return Err(PyTypeError::new_err(format!("a parameter cannot be a {}", shown_type(&kind))));
    }
    Ok(made)
}

fn shown_type(kind: &Bound<'_, PyType>) -> String {
    kind.name().map_or_else(|_| "value".to_owned(), |name| name.to_string())
}
