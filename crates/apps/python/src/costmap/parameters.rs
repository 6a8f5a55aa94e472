//! Parameters of a costmap from and to Python.

use periplus::costmap::{Layer, LayeredCostmap};
use periplus::diagnostics::closest;
use periplus::params::{ParamValue, ParamValues, Parameter};
use pyo3::IntoPyObjectExt as _;
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyString};

/// Parameters as names with dots, and texts.
pub(super) fn flatten(
    given: &Bound<'_, PyDict>,
    prefix: &str,
    flat: &mut Vec<(String, String)>,
) -> PyResult<()> {
    for (key, value) in given {
        let key: String =
            key.extract().map_err(|_| PyTypeError::new_err("names of parameters must be text"))?;
        let name = if prefix.is_empty() { key } else { format!("{prefix}.{key}") };
        if let Ok(inner) = value.cast::<PyDict>() {
            flatten(inner, &name, flat)?;
        } else {
            let text = text_of(&value, &name)?;
            flat.push((name, text));
        }
    }
    Ok(())
}

/// Value as in a YAML file.
pub(super) fn text_of(value: &Bound<'_, PyAny>, name: &str) -> PyResult<String> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(text.to_string());
    }
    if let Ok(flag) = value.extract::<bool>() {
        return Ok(flag.to_string());
    }
    if let Ok(number) = value.extract::<i64>() {
        return Ok(number.to_string());
    }
    if value.is_instance_of::<PyFloat>()
        || value.hasattr("__float__")? && !value.hasattr("__len__")?
    {
        return Ok(format!("{:?}", value.extract::<f64>()?));
    }
    if value.hasattr("__len__")? || value.hasattr("__iter__")? {
        let items: Vec<String> =
            value.try_iter()?.map(|item| text_of(&item?, name)).collect::<PyResult<_>>()?;
        // Names of sources are separated by blanks.
        return Ok(if name.ends_with("observation_sources") {
            items.join(" ")
        } else {
            format!("[{}]", items.join(", "))
        });
    }
    Err(PyTypeError::new_err(format!(
        "`{name}` must be a number, a text, a list or a dict, not {}",
        value.get_type().name()?
    )))
}

/// Value for Python; None if the parameter is not set.
pub(super) fn to_python(py: Python<'_>, value: Option<ParamValue>) -> PyResult<Bound<'_, PyAny>> {
    match value {
        None => Ok(py.None().into_bound(py)),
        Some(ParamValue::Bool(value)) => value.into_bound_py_any(py),
        Some(ParamValue::Integer(value)) => value.into_bound_py_any(py),
        Some(ParamValue::Number(value)) => value.into_bound_py_any(py),
        Some(ParamValue::Text(value)) => value.into_bound_py_any(py),
        Some(ParamValue::Numbers(values)) => values.into_bound_py_any(py),
        Some(ParamValue::Texts(values)) => values.into_bound_py_any(py),
    }
}

/// Groups of parameters: of the costmap (without a prefix), of its layers, and of their sources.
pub(super) fn groups(node: &ParamValues, costmap: &LayeredCostmap) -> Vec<(String, ParamValues)> {
    let mut groups = vec![(String::new(), node.clone())];
    for layer in costmap.all() {
        if let Some(values) = layer.values() {
            groups.push((format!("{}.", layer.name()), values.clone()));
        }
        for source in layer.sources() {
            groups.push((format!("{}.{}.", layer.name(), source.name), source.values.clone()));
        }
    }
    groups
}

/// Group of a parameter, with a new value; its index counts as in `groups`.
pub(super) fn changed(
    groups: Vec<(String, ParamValues)>,
    name: &str,
    text: &str,
) -> PyResult<(String, ParamValues)> {
    let names: Vec<String> = groups
        .iter()
        .flat_map(|(prefix, values)| values.names().map(move |name| format!("{prefix}{name}")))
        .collect();
    for (prefix, mut values) in groups {
        let Some(own) = name.strip_prefix(&prefix) else { continue };
        let Some(parameter) = values.find(own) else { continue };
        let value = read(parameter, name, text)?;
        values.set(own, value);
        return Ok((prefix, values));
    }
    Err(unknown(name, &names))
}

fn read(parameter: &Parameter, name: &str, text: &str) -> PyResult<ParamValue> {
    ParamValue::read(parameter, text)
        .map_err(|error| PyValueError::new_err(format!("`{name}`: the value {text:?} {error}")))
}

pub(super) fn unknown(name: &str, names: &[String]) -> PyErr {
    let near = closest(name, names.iter().map(String::as_str));
    let hint = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
    PyKeyError::new_err(format!("the costmap has no parameter `{name}`{hint}"))
}

/// Layer with the sources of a group such as `obstacle_layer.scan.`, and the name of the source.
pub(super) fn owner<'a>(
    costmap: &'a mut LayeredCostmap,
    prefix: &str,
) -> Option<(&'a mut dyn Layer, Option<String>)> {
    let name = prefix.trim_end_matches('.');
    let mut found = None;
    for layer in costmap.all() {
        if layer.name() == name {
            found = Some((layer.name().to_owned(), None));
        } else if let Some(source) =
            name.strip_prefix(layer.name()).and_then(|it| it.strip_prefix('.'))
            && layer.sources().iter().any(|known| known.name == source)
        {
            found = Some((layer.name().to_owned(), Some(source.to_owned())));
        }
    }
    let (layer, source) = found?;
    Some((costmap.find_mut(&layer)?, source))
}
