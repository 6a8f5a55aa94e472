//! Messages as Python objects.
//!
//! Every message type has a class with one slot for each field. Classes are created on first use from the
//! definitions of the types. A decoded message passes through a [`tape::Tape`], which is filled without the
//! interpreter.

mod build;
mod encode;
mod plan;
mod tape;
mod value;

use std::path::PathBuf;
use std::sync::Arc;

use periplus::msgs::{DynamicMessage, Format, YamlStyle};
use periplus_rosidl::ArrayShape;
use pyo3::exceptions::{PyAttributeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyString, PyType};

pub(crate) use build::{array, build};
pub(crate) use encode::{encode_message, plan_of};
pub(crate) use plan::unknown_type;
pub(crate) use plan::{Element, Plan, PlanField, Style, plan, plan_in, plan_of_style};
pub(crate) use tape::{Tape, TapeReader};
pub(crate) use value::bytes_of;

use crate::errors::{self, value_error};
use crate::work::released;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<TypeHandle>()?;
    module.add_class::<FieldSetter>()?;
    module.add_function(wrap_pyfunction!(load_numpy, module)?)?;
    module.add_function(wrap_pyfunction!(message_types, module)?)?;
    module.add_function(wrap_pyfunction!(message_services, module)?)?;
    module.add_function(wrap_pyfunction!(message_class, module)?)?;
    module.add_function(wrap_pyfunction!(rosidl_handle, module)?)?;
    module.add_function(wrap_pyfunction!(genpy_handle, module)?)?;
    module.add_function(wrap_pyfunction!(init_message, module)?)?;
    module.add_function(wrap_pyfunction!(load_messages, module)?)?;
    module.add_function(wrap_pyfunction!(serialize, module)?)?;
    module.add_function(wrap_pyfunction!(deserialize, module)?)?;
    module.add_function(wrap_pyfunction!(message_to_json, module)?)?;
    module.add_function(wrap_pyfunction!(message_from_json, module)?)?;
    module.add_function(wrap_pyfunction!(message_to_yaml, module)?)?;
    Ok(())
}

/// Returns a CDR message as an object of the class of its type.
///
/// # Errors
/// `ValueError` if the type is unknown or the bytes are not such a message.
#[allow(dead_code, reason = "used by the simulation")]
pub(crate) fn to_python<'py>(
    py: Python<'py>,
    type_name: &str,
    bytes: &[u8],
) -> PyResult<Bound<'py, PyAny>> {
    let plan = plan(type_name).ok_or_else(|| plan::unknown_type(type_name))?;
    decode_message(py, &plan, Format::CDR, bytes)
}

/// Returns the type and the CDR of a message.
///
/// # Errors
/// `TypeError` or `ValueError` that names the field.
#[allow(dead_code, reason = "used by the simulation")]
pub(crate) fn from_python(message: &Bound<'_, PyAny>) -> PyResult<(String, Vec<u8>)> {
    let plan = plan_of(message)?;
    let mut out = Vec::new();
    encode_message(&plan, message, Format::CDR, &mut out)?;
    Ok((plan.type_name.clone(), out))
}

/// Decodes a message to an object.
pub(crate) fn decode_message<'py>(
    py: Python<'py>,
    plan: &Arc<Plan>,
    format: Format,
    bytes: &[u8],
) -> PyResult<Bound<'py, PyAny>> {
    let mut tape = Tape::default();
    let decoded = if bytes.len() < RELEASE_ABOVE_BYTES {
        tape.append(plan, format, bytes)
    } else {
        released(py, "decoding", || tape.append(plan, format, bytes))?
    };
    decoded.map_err(|error| value_error(format!("{}: {error}", plan.type_name)))?;
    build(py, plan, &mut tape.read())
}

/// Size above which a message is decoded without the interpreter [bytes].
const RELEASE_ABOVE_BYTES: usize = 256 << 10;

/// Message type, as its class holds it.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct TypeHandle(pub(crate) Arc<Plan>);

#[pymethods]
impl TypeHandle {
    /// Full name, such as `sensor_msgs/msg/LaserScan`.
    #[getter]
    fn type_name(&self) -> &str {
        &self.0.type_name
    }

    /// Type hash (RIHS01).
    #[getter]
    fn type_hash(&self) -> Option<&str> {
        self.0.hash.as_deref()
    }

    /// Names of the fields with the names of their types.
    #[getter]
    fn fields(&self) -> Vec<(&str, String)> {
        let fields = self.0.fields.iter();
        fields.map(|field| (field.name.as_str(), field.type_text())).collect()
    }

    /// Values of the constants.
    #[getter]
    fn constants<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let constants = PyDict::new(py);
        for (name, value) in &self.0.constants {
            constants.set_item(name, value.to_object(py)?)?;
        }
        Ok(constants)
    }

    /// Values of the fields that have a default in the definition.
    #[getter]
    fn defaults<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let defaults = PyDict::new(py);
        for field in &self.0.fields {
            if let Some(default) = &field.default {
                let value = match field.shape {
                    ArrayShape::One => default.to_object(py)?,
                    _ => default.to_list(py)?.into_any(),
                };
                defaults.set_item(&field.name, value)?;
            }
        }
        Ok(defaults)
    }

    /// Class of the type.
    #[getter]
    fn message_class<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyType>> {
        Ok(self.0.class(py)?.class.bind(py).clone())
    }

    /// Comments of the definition.
    #[getter]
    fn doc(&self) -> &str {
        &self.0.doc
    }

    /// Function that sets a field to a checked value.
    fn setter(&self, index: usize) -> FieldSetter {
        FieldSetter { plan: self.0.clone(), index }
    }
}

/// Sets a field to a checked value.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct FieldSetter {
    plan: Arc<Plan>,
    index: usize,
}

#[pymethods]
impl FieldSetter {
    fn __call__(&self, message: &Bound<'_, PyAny>, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let Some(field) = self.plan.fields.get(self.index) else { return Ok(()) };
        let value = value::checked(field, value)
            .map_err(|fault| fault.within(&field.name).into_error(&self.plan.label))?;
        message.setattr(field.slot(message.py()), value)
    }
}

/// Loads the C interface of numpy. The first array would load it, too, but an interruption at that moment would be a
/// panic.
#[pyfunction]
fn load_numpy(py: Python<'_>) -> PyResult<()> {
    py.import("numpy")?;
    numpy::PyArray1::<f64>::zeros(py, 0, false);
    Ok(())
}

/// Names of all message types, sorted. Services and actions as a whole are none.
#[pyfunction]
fn message_types() -> Vec<String> {
    plan::all_types(|types| {
        let has = |name: &str, part: &str| types.layout(&format!("{name}_{part}")).is_some();
        let is_whole =
            |name: &str| !name.contains("/msg/") && (has(name, "Request") || has(name, "Goal"));
        types.type_names().filter(|name| !is_whole(name)).map(str::to_owned).collect()
    })
}

/// Names of all services and actions, sorted.
#[pyfunction]
fn message_services() -> Vec<String> {
    plan::all_types(|types| {
        let texts = types.registry().interfaces().map(|interface| &interface.name);
        let texts = texts.filter(|name| name.kind != periplus_rosidl::InterfaceKind::Message);
        texts.map(ToString::to_string).collect()
    })
}

/// Class of a message type. Raises ``KeyError`` for an unknown type.
#[pyfunction]
fn message_class<'py>(py: Python<'py>, type_name: &str) -> PyResult<Bound<'py, PyType>> {
    let plan = plan(type_name).ok_or_else(|| plan::unknown_type(type_name))?;
    Ok(plan.class(py)?.class.bind(py).clone())
}

/// Type whose class has the conventions of rosidl. Raises ``KeyError`` for an unknown type.
#[pyfunction]
fn rosidl_handle(type_name: &str) -> PyResult<TypeHandle> {
    let plan = plan_of_style(type_name, Style::Rosidl);
    plan.map(TypeHandle).ok_or_else(|| plan::unknown_type(type_name))
}

/// Type whose class has the conventions of ROS 1. Raises ``KeyError`` for an unknown type.
#[pyfunction]
fn genpy_handle(type_name: &str) -> PyResult<TypeHandle> {
    let plan = plan_of_style(type_name, Style::Genpy);
    plan.map(TypeHandle).ok_or_else(|| plan::unknown_type(type_name))
}

/// Sets all fields of a new message to given or default values.
#[pyfunction]
fn init_message(message: &Bound<'_, PyAny>, fields: &Bound<'_, PyDict>) -> PyResult<()> {
    let py = message.py();
    let plan = plan_of(message)?;
    let mut given = 0;
    for field in &plan.fields {
        let value = match fields.is_empty() {
            true => None,
            false => fields.get_item(field.key(py))?,
        };
        let value = match value {
            Some(value) => {
                given += 1;
                value::checked(field, &value)
                    .map_err(|fault| fault.within(&field.name).into_error(&plan.label))?
            }
            None => build::default(py, field)?,
        };
        message.setattr(field.slot(py), value)?;
    }
    if given == fields.len() {
        return Ok(());
    }
    for name in fields.keys() {
        let name: String = name.extract()?;
        if plan.fields.iter().all(|field| field.name != name) {
            let mut text = format!("{} has no field `{name}`", plan.label);
            let known = plan.fields.iter().map(|field| field.name.as_str());
            match periplus::diagnostics::closest(&name, known) {
                Some(near) => text.push_str(&format!(", did you mean `{near}`?")),
                None => {
                    let known: Vec<&str> =
                        plan.fields.iter().map(|field| field.name.as_str()).collect();
                    text.push_str(&format!("; its fields are: {}", known.join(", ")));
                }
            }
            return Err(PyTypeError::new_err(text));
        }
    }
    Ok(())
}

/// Reads the interface texts of packages; returns the names of the packages.
#[pyfunction]
fn load_messages(py: Python<'_>, folder: PathBuf) -> PyResult<Vec<String>> {
    errors::require_file(&folder)?;
    let machine = periplus::os::Machine;
    let folders = [folder.clone()];
    let loaded = released(py, "reading the interface texts", || {
        periplus::loader::load_interfaces(&machine, &folders)
    })?;
    errors::require_no_errors(py, &loaded.diagnostics, &loaded.sources)?;
    if loaded.packages.is_empty() {
        let why = "no package with msg/*.msg, srv/*.srv or action/*.action";
        return Err(errors::file_error(py, &folder, why));
    }
    let packages = loaded.packages.keys().cloned().collect();
    plan::add_types(loaded.types);
    Ok(packages)
}

/// Serialized form of a message: CDR, little endian, with its header of four bytes, as DDS and bags have it.
///
/// Raises ``TypeError`` or ``ValueError`` that names the field whose value does not fit.
///
/// >>> import periplus
/// >>> from periplus.msgs.std_msgs.msg import String
/// >>> periplus.serialize(String(data="hi"))
/// b'\x00\x01\x00\x00\x03\x00\x00\x00hi\x00'
#[pyfunction]
fn serialize<'py>(message: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyBytes>> {
    let (_, bytes) = from_python(message)?;
    Ok(PyBytes::new(message.py(), &bytes))
}

/// Message of serialized bytes (CDR of either byte order).
///
/// Parameters
/// ----------
/// type : type or str
///     Class of the message, or name such as ``sensor_msgs/msg/LaserScan``.
/// data : bytes-like
///     Serialized message.
///
/// Raises ``KeyError`` for an unknown type and ``ValueError`` if the bytes are not such a message.
///
/// >>> import periplus
/// >>> periplus.deserialize("std_msgs/msg/String", b"\0\1\0\0\3\0\0\0hi\0")
/// std_msgs.msg.String(data='hi')
#[pyfunction]
#[pyo3(signature = (r#type, data))]
fn deserialize<'py>(
    py: Python<'py>,
    r#type: &Bound<'py, PyAny>,
    data: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let plan = plan_of_type(r#type)?;
    if let Ok(bytes) = data.cast::<PyBytes>() {
        return decode_message(py, &plan, Format::CDR, bytes.as_bytes());
    }
    let array = value::bytes_of(data)
        .ok_or_else(|| PyTypeError::new_err("`data` must be bytes, a bytearray or a buffer"))?;
    decode_message(py, &plan, Format::CDR, &array)
}

/// Type hash of a message, service or action.
pub(crate) fn type_hash(type_name: &str) -> Option<String> {
    plan::all_types(|types| types.hash(type_name))
}

/// Type given as a class or as a name.
pub(crate) fn plan_of_type(kind: &Bound<'_, PyAny>) -> PyResult<Arc<Plan>> {
    if let Ok(name) = kind.cast::<PyString>() {
        let name = name.to_str()?;
        return plan(name).ok_or_else(|| plan::unknown_type(name));
    }
    plan_of(kind)
}

/// The message as JSON.
#[pyfunction]
#[pyo3(signature = (message, *, indent=false))]
fn message_to_json(message: &Bound<'_, PyAny>, indent: bool) -> PyResult<String> {
    let json = dynamic(message)?.to_json();
    let text =
        if indent { serde_json::to_string_pretty(&json) } else { serde_json::to_string(&json) };
    text.map_err(value_error)
}

/// Message of a JSON text; fields that are missing have default values.
#[pyfunction]
fn message_from_json<'py>(
    py: Python<'py>,
    r#type: &Bound<'py, PyAny>,
    text: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let plan = plan_of_type(r#type)?;
    let json: serde_json::Value = serde_json::from_str(text).map_err(value_error)?;
    let message = DynamicMessage::from_json(&plan.layout, &json).map_err(value_error)?;
    let mut bytes = Vec::new();
    message.encode(Format::CDR, &mut bytes).map_err(value_error)?;
    decode_message(py, &plan, Format::CDR, &bytes)
}

/// The message as YAML, as ``ros2 topic echo`` prints it.
#[pyfunction]
#[pyo3(signature = (message, *, max_length=None))]
fn message_to_yaml(message: &Bound<'_, PyAny>, max_length: Option<usize>) -> PyResult<String> {
    let style = YamlStyle { longest: max_length, ..YamlStyle::default() };
    Ok(dynamic(message)?.to_yaml(&style))
}

fn dynamic(message: &Bound<'_, PyAny>) -> PyResult<DynamicMessage> {
    let plan = plan_of(message)?;
    let mut bytes = Vec::new();
    encode_message(&plan, message, Format::CDR, &mut bytes)?;
    DynamicMessage::decode(&plan.layout, Format::CDR, &bytes).map_err(value_error)
}

/// Error of a message that lacks a field, because it was deleted.
pub(crate) fn missing(label: &str, field: &str) -> PyErr {
    PyAttributeError::new_err(format!("'{label}' object has no value in `{field}`"))
}

/// Helper for lists of messages.
pub(crate) fn list<'py>(
    py: Python<'py>,
    values: Vec<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    Ok(PyList::new(py, values)?.into_any())
}
