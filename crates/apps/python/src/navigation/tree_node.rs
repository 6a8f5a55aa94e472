//! Tree nodes that are classes of Python.

use std::sync::Arc;

use periplus::behavior_tree::{
    BehaviorNode, NodeKind, NodeModel, NodeRun, NodeStatus, PortDirection, PortType, TreeError,
    TreeValue,
};
use periplus::msgs::Message;
use periplus::msgs::geometry_msgs::PoseStamped;
use periplus::msgs::nav_msgs::{Goals, Path};
use periplus::nav_nodes::navigation_plugins::NavigationPlugins;
use pyo3::exceptions::{PyStopIteration, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};

use super::plugin::{PluginError, Raised};
use crate::messages::{from_python, to_python};
use crate::work::in_plugin;

/// Registers a class of tree nodes, by its name.
///
/// # Errors
/// `TypeError` or `ValueError` for a class without a kind, ports or `tick`.
pub(super) fn add(
    plugins: NavigationPlugins,
    class: &Bound<'_, PyAny>,
    raised: &Raised,
) -> PyResult<NavigationPlugins> {
    let is_class = class.is_callable() && class.hasattr("tick")?;
    if !is_class {
        return Err(PyTypeError::new_err(format!(
            "`tree_nodes` has {}, which is no class with a method `tick`: derive it from \
             periplus.navigation.TreeNode",
            class.repr()?
        )));
    }
    let model = model(class)?;
    let (class, raised) = (Arc::new(class.clone().unbind()), raised.clone());
    Ok(plugins.tree_nodes(move |registry| {
        let (class, raised, ports) = (Arc::clone(&class), raised.clone(), model.clone());
        registry.register(model.clone(), move || PythonNode {
            class: Arc::clone(&class),
            object: None,
            model: ports.clone(),
            raised: raised.clone(),
        });
    }))
}

/// Name, kind and ports of a class.
fn model(class: &Bound<'_, PyAny>) -> PyResult<NodeModel> {
    let name: String = class.getattr("__name__")?.extract()?;
    let kind: String = class.getattr("kind")?.extract()?;
    let node_kind = match kind.as_str() {
        "action" => NodeKind::Action,
        "condition" => NodeKind::Condition,
        "control" => NodeKind::Control,
        "decorator" => NodeKind::Decorator,
        _ => {
            return Err(PyValueError::new_err(format!(
                "`{name}.kind` must be \"action\", \"condition\", \"control\" or \"decorator\", \
                 not {kind:?}"
            )));
        }
    };
    let mut model = NodeModel::new(&name, node_kind);
    for port in class.getattr("ports")?.try_iter()? {
        let port = port?;
        let port_name: String = port.getattr("name")?.extract()?;
        let type_name: String = port.getattr("type")?.extract()?;
        let port_type = PortType::of_cpp(&type_name);
        let direction: String = port.getattr("direction")?.extract()?;
        let default: Option<String> = port.getattr("default")?.extract()?;
        model = match (direction.as_str(), default) {
            ("input", None) => model.input(&port_name, port_type),
            ("input", Some(default)) => model.input_or(&port_name, port_type, &default),
            ("output", None) => model.output(&port_name, port_type),
            ("inout", None) => model.in_out(&port_name, port_type),
            ("output" | "inout", Some(_)) => {
                return Err(PyValueError::new_err(format!(
                    "the port `{port_name}` of `{name}` is no input, and has a default"
                )));
            }
            _ => {
                return Err(PyValueError::new_err(format!(
                    "the direction of the port `{port_name}` of `{name}` must be \"input\", \
                     \"output\" or \"inout\", not {direction:?}"
                )));
            }
        };
    }
    Ok(model)
}

struct PythonNode {
    class: Arc<Py<PyAny>>,
    /// Object of this use in a tree, from the first tick on.
    object: Option<Py<PyAny>>,
    model: NodeModel,
    raised: Raised,
}

/// Failure of a tick: an exception, or an error of a child.
enum TickError {
    Python(PyErr),
    Tree(TreeError),
}

impl From<PyErr> for TickError {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<TreeError> for TickError {
    fn from(error: TreeError) -> Self {
        Self::Tree(error)
    }
}

impl PythonNode {
    fn error(&self, py: Python<'_>, error: TickError, run: &NodeRun<'_>) -> TreeError {
        match error {
            TickError::Tree(error) => error,
            TickError::Python(error) => {
                run.error(PluginError::new(py, error, &self.raised).to_string())
            }
        }
    }

    fn run(&mut self, py: Python<'_>, run: &mut NodeRun<'_>) -> Result<NodeStatus, TickError> {
        let object = match &self.object {
            Some(object) => object.bind(py).clone(),
            None => {
                let object = in_plugin(|| self.class.bind(py).call0())?;
                self.object = Some(object.clone().unbind());
                object
            }
        };
        let ports = PyDict::new(py);
        let mut given = Vec::new();
        for port in self.model.ports.iter().filter(|it| it.direction != PortDirection::Output) {
            if let Some(value) = run.input(&port.name) {
                let value = tree_to_python(py, &value)?;
                ports.set_item(&port.name, &value)?;
                given.push((port.name.as_str(), value));
            }
        }
        let has_children = matches!(self.model.kind, NodeKind::Control | NodeKind::Decorator);
        if has_children {
            run.set_running();
        }
        let time_s = run.now_ns() as f64 * 1e-9;
        let ticked = in_plugin(|| object.call_method1("tick", (time_s, &ports)))?;
        let ticked = if ticked.hasattr("send")? { drive(&ticked, run)? } else { ticked };
        let status = status(&ticked)?;
        for port in self.model.ports.iter().filter(|it| it.direction != PortDirection::Input) {
            let Some(value) = ports.get_item(&port.name)? else { continue };
            let is_unchanged =
                given.iter().any(|(name, given)| *name == port.name && given.is(&value));
            if !is_unchanged {
                run.set_output(&port.name, tree_from_python(&value, &port.name)?)?;
            }
        }
        if has_children && status != NodeStatus::Running {
            run.halt_children()?;
        }
        Ok(status)
    }
}

impl BehaviorNode for PythonNode {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        Python::attach(|py| self.run(py, run).map_err(|error| self.error(py, error, run)))
    }

    fn halt(&mut self, run: &mut NodeRun<'_>) -> Result<(), TreeError> {
        let Some(object) = &self.object else { return Ok(()) };
        Python::attach(|py| {
            let halted = in_plugin(|| match object.bind(py).getattr_opt("halt")? {
                Some(halt) => halt.call0().map(drop),
                None => Ok(()),
            });
            halted.map_err(|error| self.error(py, error.into(), run))
        })
    }
}

/// Ticks the children that a generator yields, and returns what the generator returns.
fn drive<'py>(
    generator: &Bound<'py, PyAny>,
    run: &mut NodeRun<'_>,
) -> Result<Bound<'py, PyAny>, TickError> {
    let py = generator.py();
    let mut answer: Bound<'py, PyAny> = py.None().into_bound(py);
    loop {
        let yielded = in_plugin(|| generator.call_method1("send", (&answer,)));
        let child = match yielded {
            Ok(child) => child,
            Err(error) if error.is_instance_of::<PyStopIteration>(py) => {
                return Ok(error.value(py).getattr("value")?);
            }
            Err(error) => return Err(error.into()),
        };
        let child: usize = child
            .extract()
            .map_err(|_| PyTypeError::new_err("`tick` yields the index of a child, from 0"))?;
        if run.child_status(child).is_completed() {
            run.halt_child(child)?;
        }
        let status = run.tick_child(child)?;
        let class = py.import("periplus.navigation")?.getattr("Status")?;
        answer = class.call1((status.name(),))?;
    }
}

/// Status that a node returns.
fn status(value: &Bound<'_, PyAny>) -> PyResult<NodeStatus> {
    let text: Option<String> = if value.is_instance_of::<PyString>() {
        // The text of an enumeration is that of its member.
        value.getattr_opt("value")?.unwrap_or_else(|| value.clone()).extract().ok()
    } else {
        None
    };
    let status = text.as_deref().and_then(NodeStatus::of_name);
    status.filter(|status| *status != NodeStatus::Idle).ok_or_else(|| {
        PyTypeError::new_err(format!(
            "`tick` must return a periplus.navigation.Status, not {}",
            value.repr().map_or_else(|_| String::new(), |it| it.to_string())
        ))
    })
}

/// Types of messages on the blackboard, with lists of poses.
macro_rules! messages {
    ($($type:ty),*) => {
        fn message_to_python<'py>(
            py: Python<'py>,
            value: &TreeValue,
        ) -> PyResult<Option<Bound<'py, PyAny>>> {
            $(if let Some(message) = value.get::<$type>() {
                return encoded(py, message).map(Some);
            })*
            Ok(None)
        }

        fn message_from_python(type_name: &str, cdr: &[u8]) -> Option<TreeValue> {
            $(if type_name == <$type as Message>::TYPE_NAME {
                return <$type as Message>::decode_cdr(cdr).ok().map(TreeValue::object);
            })*
            None
        }
    };
}

messages!(PoseStamped, Path, Goals);

fn encoded<'py, T: Message>(py: Python<'py>, message: &T) -> PyResult<Bound<'py, PyAny>> {
    let cdr = message.to_cdr().map_err(crate::errors::runtime_error)?;
    to_python(py, T::TYPE_NAME, &cdr)
}

/// Value of a port for Python: a truth value, number, text, message or list of poses.
fn tree_to_python<'py>(py: Python<'py>, value: &TreeValue) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        TreeValue::Bool(value) => value.into_pyobject(py)?.to_owned().into_any(),
        TreeValue::Int(value) => value.into_pyobject(py)?.into_any(),
        TreeValue::Real(value) => value.into_pyobject(py)?.into_any(),
        TreeValue::Text(value) => (**value).into_pyobject(py)?.into_any(),
        TreeValue::Object(object) => {
            if let Some(message) = message_to_python(py, value)? {
                message
            } else if let Some(poses) = value.get::<Vec<PoseStamped>>() {
                let poses: Vec<_> =
                    poses.iter().map(|pose| encoded(py, pose)).collect::<PyResult<_>>()?;
                poses.into_pyobject(py)?
            } else {
                return Err(PyTypeError::new_err(format!(
                    "a value of the type `{}` has no counterpart in Python",
                    object.type_name()
                )));
            }
        }
    })
}

/// Value that Python has set for a port.
fn tree_from_python(value: &Bound<'_, PyAny>, port: &str) -> PyResult<TreeValue> {
    if value.is_instance_of::<PyBool>() {
        return Ok(TreeValue::Bool(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(TreeValue::Int(value.extract()?));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(TreeValue::Real(value.extract()?));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(text.to_str()?.into());
    }
    let message = from_python(value).ok();
    message.and_then(|(type_name, cdr)| message_from_python(&type_name, &cdr)).ok_or_else(|| {
        let kind = value.get_type().name().map_or_else(|_| String::new(), |it| it.to_string());
        PyTypeError::new_err(format!(
            "the port `{port}` cannot have a {kind}: it has a bool, int, float, str, PoseStamped, \
             Path or Goals"
        ))
    })
}
