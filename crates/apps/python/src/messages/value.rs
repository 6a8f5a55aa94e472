//! Checks and conversions of the values that programs set.

use numpy::{PyArray1, PyUntypedArrayMethods as _};
use periplus::msgs::{Number, NumberKind};
use periplus_rosidl::ArrayShape;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{
    PyBool, PyByteArray, PyBytes, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple,
};

use super::encode::plan_of;
use super::plan::{Element, Plan, PlanField};

/// Value that does not fit a field.
pub(crate) struct Fault {
    /// Path of the field from the message.
    path: String,
    problem: Problem,
}

enum Problem {
    /// Wrong type.
    Type(String),
    /// Right type, but out of range or of the wrong size.
    Value(String),
    /// Exception of Python.
    Raised(PyErr),
}

impl Fault {
    pub(crate) fn of_type(text: impl Into<String>) -> Self {
        Self { path: String::new(), problem: Problem::Type(text.into()) }
    }

    pub(crate) fn of_value(text: impl Into<String>) -> Self {
        Self { path: String::new(), problem: Problem::Value(text.into()) }
    }

    /// Adds an enclosing field.
    pub(crate) fn within(mut self, field: &str) -> Self {
        let dot = if self.path.is_empty() || self.path.starts_with('[') { "" } else { "." };
        self.path = format!("{field}{dot}{}", self.path);
        self
    }

    /// Adds an index in the enclosing list.
    pub(crate) fn within_element(self, index: usize) -> Self {
        self.within(&format!("[{index}]"))
    }

    /// Exception for a message of the class `label`.
    pub(crate) fn into_error(self, label: &str) -> PyErr {
        let path = &self.path;
        match self.problem {
            Problem::Type(text) => PyTypeError::new_err(format!("{label}.{path} {text}")),
            Problem::Value(text) => PyValueError::new_err(format!("{label}.{path} {text}")),
            Problem::Raised(error) => error,
        }
    }
}

impl From<PyErr> for Fault {
    fn from(error: PyErr) -> Self {
        Self { path: String::new(), problem: Problem::Raised(error) }
    }
}

fn name_of(value: &Bound<'_, PyAny>) -> String {
    value.get_type().name().map_or_else(|_| "?".to_owned(), |name| name.to_string())
}

/// Value for a field: converted if that loses nothing, refused otherwise.
pub(crate) fn checked<'py>(
    field: &PlanField,
    value: &Bound<'py, PyAny>,
) -> Result<Bound<'py, PyAny>, Fault> {
    if field.shape == ArrayShape::One {
        return checked_one(&field.element, value);
    }
    if let Some(kind) = field.element.number() {
        return array_of(kind, field.shape, value);
    }
    let list = list_of(&field.element, value)?;
    require_length(field.shape, list.len())?;
    for (index, item) in list.iter().enumerate() {
        let one = checked_one(&field.element, &item).map_err(|it| it.within_element(index))?;
        if !one.is(&item) {
            list.set_item(index, one)?;
        }
    }
    Ok(list.into_any())
}

fn list_of<'py>(element: &Element, value: &Bound<'py, PyAny>) -> Result<Bound<'py, PyList>, Fault> {
    if let Ok(list) = value.cast_exact::<PyList>() {
        return Ok(list.clone());
    }
    let what = match element {
        Element::Message(plan) => plan.label.as_str(),
        _ => "str",
    };
    let wrong = || Fault::of_type(format!("must be a list of {what}, not {}", name_of(value)));
    let is_text = value.is_instance_of::<PyString>() || value.is_instance_of::<PyBytes>();
    if is_text || value.is_instance_of::<PyDict>() {
        return Err(wrong());
    }
    let items = value.try_iter().map_err(|_| wrong())?;
    let items: PyResult<Vec<_>> = items.collect();
    Ok(PyList::new(value.py(), items?)?)
}

fn checked_one<'py>(
    element: &Element,
    value: &Bound<'py, PyAny>,
) -> Result<Bound<'py, PyAny>, Fault> {
    let py = value.py();
    Ok(match element {
        Element::Number(kind) => {
            let number = number_of(*kind, value)?;
            let is_plain = match kind {
                NumberKind::F32 | NumberKind::F64 => value.is_exact_instance_of::<PyFloat>(),
                NumberKind::Bool => value.is_exact_instance_of::<PyBool>(),
                _ => value.is_exact_instance_of::<PyInt>(),
            };
            if is_plain { value.clone() } else { super::build::number(py, number)? }
        }
        Element::Byte => PyBytes::new(py, &[byte_of(value)?]).into_any(),
        Element::Text(limit) => {
            text_of(value, *limit, false)?;
            value.clone()
        }
        Element::WideText(limit) => {
            text_of(value, *limit, true)?;
            value.clone()
        }
        Element::Message(plan) => {
            require_message(plan, value)?;
            value.clone()
        }
    })
}

/// Fails if the value is not a message of this type.
pub(crate) fn require_message(
    plan: &std::sync::Arc<Plan>,
    value: &Bound<'_, PyAny>,
) -> Result<(), Fault> {
    let class = plan.class(value.py())?.class.bind(value.py());
    if value.get_type().is(class) || value.is_instance(class)? {
        return Ok(());
    }
    // Another class of the same type: a definition was loaded again.
    let is_same = plan_of(value)
        .is_ok_and(|other| other.type_name == plan.type_name && other.layout == plan.layout);
    if is_same {
        return Ok(());
    }
    Err(Fault::of_type(format!(
        "must be a message {}, not {}",
        plan.type_name.replace('/', "."),
        name_of(value)
    )))
}

/// Text of a value.
pub(crate) fn text_of<'a>(
    value: &'a Bound<'_, PyAny>,
    limit: Option<u32>,
    is_wide: bool,
) -> Result<std::borrow::Cow<'a, str>, Fault> {
    let text = value
        .cast::<PyString>()
        .map_err(|_| Fault::of_type(format!("must be a str, not {}", name_of(value))))?;
    let text = text
        .to_cow()
        .map_err(|_| Fault::of_value("must be valid Unicode, without lone surrogates"))?;
    if let Some(limit) = limit {
        let length = if is_wide { text.encode_utf16().count() } else { text.len() };
        if length > limit as usize {
            let unit = if is_wide { "UTF-16 units" } else { "bytes" };
            return Err(Fault::of_value(format!("must have at most {limit} {unit}, not {length}")));
        }
    }
    Ok(text)
}

/// Value of a `byte`.
pub(crate) fn byte_of(value: &Bound<'_, PyAny>) -> Result<u8, Fault> {
    if let Ok(bytes) = value.cast::<PyBytes>() {
        return match bytes.as_bytes() {
            [byte] => Ok(*byte),
            bytes => {
                Err(Fault::of_value(format!("must be bytes of length 1, not {}", bytes.len())))
            }
        };
    }
    match number_of(NumberKind::U8, value)? {
        Number::U8(byte) => Ok(byte),
        _ => Ok(0),
    }
}

/// Value of a number.
pub(crate) fn number_of(kind: NumberKind, value: &Bound<'_, PyAny>) -> Result<Number, Fault> {
    macro_rules! integer {
        ($kind:ident $rust:ident) => {{
            let wide = integer_of(value)?;
            let narrow = wide.and_then(|wide| $rust::try_from(wide).ok());
            narrow.map(Number::$kind).ok_or_else(|| {
                Fault::of_value(format!(
                    "must be from {} to {}, not {}",
                    $rust::MIN,
                    $rust::MAX,
                    value.str().map_or_else(|_| "larger".to_owned(), |text| text.to_string())
                ))
            })
        }};
    }
    match kind {
        NumberKind::Bool => {
            if let Ok(truth) = value.cast::<PyBool>() {
                return Ok(Number::Bool(truth.is_true()));
            }
            let is_numpy = name_of(value).starts_with("bool");
            let truth = if is_numpy { value.is_truthy().ok() } else { None };
            let wrong = || Fault::of_type(format!("must be a bool, not {}", name_of(value)));
            truth.map(Number::Bool).ok_or_else(wrong)
        }
        NumberKind::F64 => float_of(value).map(Number::F64),
        NumberKind::F32 => {
            let wide = float_of(value)?;
            #[allow(clippy::cast_possible_truncation, reason = "rounds to the type of the field")]
            let narrow = wide as f32;
            if wide.is_finite() && !narrow.is_finite() {
                return Err(Fault::of_value(format!(
                    "must be in the range of float32, not {wide:e}"
                )));
            }
            Ok(Number::F32(narrow))
        }
        NumberKind::I8 => integer!(I8 i8),
        NumberKind::U8 => integer!(U8 u8),
        NumberKind::I16 => integer!(I16 i16),
        NumberKind::U16 => integer!(U16 u16),
        NumberKind::I32 => integer!(I32 i32),
        NumberKind::U32 => integer!(U32 u32),
        NumberKind::I64 => integer!(I64 i64),
        NumberKind::U64 => integer!(U64 u64),
    }
}

/// Integer of a value; none if it is larger than any type of a field.
fn integer_of(value: &Bound<'_, PyAny>) -> Result<Option<i128>, Fault> {
    let py = value.py();
    if value.is_instance_of::<PyInt>() {
        return Ok(value.extract::<i128>().ok());
    }
    let wrong = || Fault::of_type(format!("must be an int, not {}", name_of(value)));
    // An array of one element has the method, too.
    if value.hasattr(intern!(py, "__len__"))? {
        return Err(wrong());
    }
    let index = value.call_method0(intern!(py, "__index__")).map_err(|_| wrong())?;
    Ok(index.extract::<i128>().ok())
}

fn float_of(value: &Bound<'_, PyAny>) -> Result<f64, Fault> {
    if let Ok(float) = value.cast::<PyFloat>() {
        return Ok(float.value());
    }
    let wrong = || Fault::of_type(format!("must be a float, not {}", name_of(value)));
    let py = value.py();
    let is_truth = value.is_instance_of::<PyBool>() || name_of(value).starts_with("bool");
    if is_truth || value.hasattr(intern!(py, "__len__"))? {
        return Err(wrong());
    }
    let float = value.extract::<f64>().map_err(|error| {
        if error.is_instance_of::<pyo3::exceptions::PyOverflowError>(py) {
            Fault::of_value("must be in the range of float64")
        } else {
            wrong()
        }
    })?;
    if value.is_instance_of::<PyInt>() && float.abs() >= MAX_EXACT_INTEGER {
        let back = value.eq(PyFloat::new(py, float))?;
        if !back {
            return Err(Fault::of_value("is an int that float64 cannot hold exactly"));
        }
    }
    Ok(float)
}

/// Integers up to this one are exact in `f64`.
const MAX_EXACT_INTEGER: f64 = 9_007_199_254_740_992.0;

pub(crate) fn require_length(shape: ArrayShape, length: usize) -> Result<(), Fault> {
    match shape {
        ArrayShape::Fixed(fixed) if length as u64 != fixed => {
            Err(Fault::of_value(format!("must have {fixed} elements, not {length}")))
        }
        ArrayShape::Bounded(limit) if length as u64 > limit => {
            Err(Fault::of_value(format!("must have at most {limit} elements, not {length}")))
        }
        _ => Ok(()),
    }
}

/// Calls a macro with the kind and type of a number.
macro_rules! each_kind {
    ($kind:expr, $macro:ident) => {
        match $kind {
            NumberKind::Bool => $macro!(Bool bool),
            NumberKind::I8 => $macro!(I8 i8),
            NumberKind::U8 => $macro!(U8 u8),
            NumberKind::I16 => $macro!(I16 i16),
            NumberKind::U16 => $macro!(U16 u16),
            NumberKind::I32 => $macro!(I32 i32),
            NumberKind::U32 => $macro!(U32 u32),
            NumberKind::I64 => $macro!(I64 i64),
            NumberKind::U64 => $macro!(U64 u64),
            NumberKind::F32 => $macro!(F32 f32),
            NumberKind::F64 => $macro!(F64 f64),
        }
    };
}
pub(crate) use each_kind;

/// Value as a contiguous array of one dimension of exactly this type.
pub(crate) fn array_of<'py>(
    kind: NumberKind,
    shape: ArrayShape,
    value: &Bound<'py, PyAny>,
) -> Result<Bound<'py, PyAny>, Fault> {
    macro_rules! as_it_is {
        ($kind:ident $rust:ident) => {
            value
                .cast::<PyArray1<$rust>>()
                .ok()
                .filter(|it| it.is_c_contiguous())
                .map(|it| it.len())
        };
    }
    if let Some(length) = each_kind!(kind, as_it_is) {
        require_length(shape, length)?;
        return Ok(value.clone());
    }
    let array = converted(kind, value)?;
    require_length(shape, array.len()?)?;
    Ok(array)
}

fn converted<'py>(kind: NumberKind, value: &Bound<'py, PyAny>) -> Result<Bound<'py, PyAny>, Fault> {
    let py = value.py();
    if kind == NumberKind::U8 {
        if let Some(bytes) = plain_bytes_of(value) {
            return Ok(PyArray1::from_slice(py, &bytes).into_any());
        }
        if let Some(bytes) = joined_bytes(value) {
            return Ok(PyArray1::from_vec(py, bytes).into_any());
        }
    }
    let wrong =
        |found: String| Fault::of_type(format!("must be an array of {}, not {found}", kind.name()));
    let is_text = value.is_instance_of::<PyString>() || value.is_instance_of::<PyBytes>();
    if is_text || value.is_instance_of::<PyByteArray>() || value.is_instance_of::<PyDict>() {
        return Err(wrong(name_of(value)));
    }
    let numpy = py.import(intern!(py, "numpy"))?;
    let array = numpy
        .call_method1(intern!(py, "asarray"), (value,))
        .map_err(|error| wrong(format!("{} ({})", name_of(value), error.value(py))))?;
    let dimensions: usize = array.getattr(intern!(py, "ndim"))?.extract()?;
    if dimensions == 0 {
        return Err(wrong(name_of(value)));
    }
    let found = array.getattr(intern!(py, "dtype"))?;
    let group: char = found.getattr(intern!(py, "kind"))?.extract()?;
    let found = found.str()?.to_string();
    let size: usize = array.getattr(intern!(py, "size"))?.extract()?;
    macro_rules! dtype {
        ($kind:ident $rust:ident) => {
            numpy::dtype::<$rust>(py).into_any()
        };
    }
    let target = each_kind!(kind, dtype);
    if size == 0 {
        return Ok(super::build::array(py, kind.zeros(0)));
    }
    match kind {
        NumberKind::F32 | NumberKind::F64 if matches!(group, 'f' | 'i' | 'u') => {}
        NumberKind::F32 | NumberKind::F64 => return Err(wrong(elements(&found))),
        _ if matches!(group, 'i' | 'u' | 'b') => require_range(kind, &array)?,
        _ => return Err(wrong(elements(&found))),
    }
    let narrow = || -> PyResult<Bound<'py, PyAny>> {
        let settings = PyDict::new(py);
        settings.set_item("over", "ignore")?;
        settings.set_item("invalid", "ignore")?;
        let state = numpy.call_method("errstate", (), Some(&settings))?;
        state.call_method0("__enter__")?;
        let flat = array.call_method1(intern!(py, "reshape"), (-1,));
        let narrow = flat.and_then(|flat| numpy.call_method1("ascontiguousarray", (flat, &target)));
        state.call_method1("__exit__", (py.None(), py.None(), py.None()))?;
        narrow
    };
    let result = narrow()?;
    if kind == NumberKind::F32 && group == 'f' {
        let finite = |array: &Bound<'py, PyAny>| -> PyResult<usize> {
            numpy.call_method1("isfinite", (array,))?.call_method0("sum")?.extract()
        };
        if finite(&array)? != finite(&result)? {
            return Err(Fault::of_value("has values that are out of the range of float32"));
        }
    }
    Ok(result)
}

fn elements(found: &str) -> String {
    match found {
        "object" => "objects or lists of different lengths".to_owned(),
        _ => found.to_owned(),
    }
}

fn require_range(kind: NumberKind, array: &Bound<'_, PyAny>) -> Result<(), Fault> {
    let bound = |method: &str| -> PyResult<i128> {
        array.call_method0(method)?.call_method0("__int__")?.extract()
    };
    let (low, high) = match kind {
        NumberKind::Bool => (0, 1),
        NumberKind::I8 => (i8::MIN.into(), i8::MAX.into()),
        NumberKind::U8 => (0, u8::MAX.into()),
        NumberKind::I16 => (i16::MIN.into(), i16::MAX.into()),
        NumberKind::U16 => (0, u16::MAX.into()),
        NumberKind::I32 => (i32::MIN.into(), i32::MAX.into()),
        NumberKind::U32 => (0, u32::MAX.into()),
        NumberKind::I64 => (i64::MIN.into(), i64::MAX.into()),
        _ => (0, u64::MAX.into()),
    };
    let (min, max) = (bound("min")?, bound("max")?);
    if min < low || max > high {
        let wrong = if min < low { min } else { max };
        return Err(Fault::of_value(format!(
            "has the value {wrong}; {} is from {low} to {high}",
            kind.name()
        )));
    }
    Ok(())
}

/// Bytes of `bytes` and `bytearray`.
fn plain_bytes_of(value: &Bound<'_, PyAny>) -> Option<Vec<u8>> {
    if let Ok(bytes) = value.cast::<PyBytes>() {
        return Some(bytes.as_bytes().to_vec());
    }
    value.cast::<PyByteArray>().ok().map(|bytes| bytes.to_vec())
}

/// Bytes of a list of bytes of length 1.
fn joined_bytes(value: &Bound<'_, PyAny>) -> Option<Vec<u8>> {
    let is_list = value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>();
    if !is_list || !value.get_item(0).ok()?.is_instance_of::<PyBytes>() {
        return None;
    }
    value
        .try_iter()
        .ok()?
        .map(|item| match item.ok()?.cast::<PyBytes>().ok()?.as_bytes() {
            [byte] => Some(*byte),
            _ => None,
        })
        .collect()
}

/// Bytes of anything with a buffer of bytes.
pub(crate) fn bytes_of(value: &Bound<'_, PyAny>) -> Option<Vec<u8>> {
    if let Some(bytes) = plain_bytes_of(value) {
        return Some(bytes);
    }
    if value.is_instance_of::<PyString>() {
        return None;
    }
    let py = value.py();
    let view = py.import("builtins").ok()?.getattr("memoryview").ok()?.call1((value,)).ok()?;
    let bytes = view.call_method0("tobytes").ok()?;
    bytes.cast::<PyBytes>().ok().map(|bytes| bytes.as_bytes().to_vec())
}
