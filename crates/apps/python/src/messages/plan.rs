//! Message types with their classes.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex};

use periplus::msgs::{Layout, NumberKind, TypeRegistry};
use periplus_rosidl::{ArrayShape, ElementType, Literal, Scalar, TypeName};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyList, PyString, PyTuple, PyType};

use super::TypeHandle;
use crate::work::lock;

/// Conventions of the classes of messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// Arrays of numbers are numpy arrays: `periplus.msgs`.
    Numpy,
    /// Those of rosidl: arrays of numbers are `array.array`, and numpy arrays if their length is fixed.
    Rosidl,
    /// Those of genpy, of ROS 1: arrays of numbers are tuples, of bytes `bytes`.
    Genpy,
}

impl Style {
    /// All, in the order of their numbers.
    const ALL: [Self; 3] = [Self::Numpy, Self::Rosidl, Self::Genpy];

    /// Module that makes the classes.
    fn module(self) -> &'static str {
        match self {
            Self::Numpy => "periplus.msgs._base",
            Self::Rosidl => "periplus.ros._rosidl",
            Self::Genpy => "periplus.ros._genpy",
        }
    }
}

/// Message type: its fields, and its class once it is needed.
pub(crate) struct Plan {
    pub(crate) style: Style,
    /// Full name, such as `geometry_msgs/msg/Point`.
    pub(crate) type_name: String,
    /// Name of the class, such as `Point`.
    pub(crate) label: String,
    pub(crate) fields: Vec<PlanField>,
    pub(crate) constants: Vec<(String, Constant)>,
    pub(crate) doc: String,
    pub(crate) hash: Option<String>,
    pub(crate) layout: Arc<Layout>,
    /// Schema text, for bags.
    pub(crate) schema: String,
    /// Minimum size of a value in a binary format [bytes].
    pub(crate) min_bytes: usize,
    class: PyOnceLock<MessageClass>,
}

/// Class of a message type.
pub(crate) struct MessageClass {
    pub(crate) class: Py<PyType>,
    /// `object.__new__`, and its arguments.
    new: (Py<PyAny>, Py<PyTuple>),
}

/// Field of a message type.
pub(crate) struct PlanField {
    pub(crate) name: String,
    pub(crate) element: Element,
    pub(crate) shape: ArrayShape,
    pub(crate) default: Option<Constant>,
    key: PyOnceLock<Py<PyString>>,
    slot: PyOnceLock<Py<PyString>>,
}

/// Type of an element of a field.
#[derive(Clone)]
pub(crate) enum Element {
    Number(NumberKind),
    /// `byte`: bytes of length 1.
    Byte,
    Text(Option<u32>),
    WideText(Option<u32>),
    Message(Arc<Plan>),
}

/// Value of a constant or default.
#[derive(Clone)]
pub(crate) struct Constant {
    literal: Literal,
    element: Element,
}

impl Plan {
    /// Class of the type.
    pub(crate) fn class(self: &Arc<Self>, py: Python<'_>) -> PyResult<&MessageClass> {
        self.class.get_or_try_init(py, || {
            let handle = Bound::new(py, TypeHandle(self.clone()))?;
            let base = py.import(self.style.module())?;
            let class = base.getattr("make_class")?.call1((handle,))?.cast_into::<PyType>()?;
            let new = py.import("builtins")?.getattr("object")?.getattr("__new__")?;
            let arguments = PyTuple::new(py, [&class])?;
            Ok(MessageClass { class: class.unbind(), new: (new.unbind(), arguments.unbind()) })
        })
    }
}

impl MessageClass {
    /// New message without values.
    pub(crate) fn new_object<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (new, arguments) = &self.new;
        new.bind(py).call1(arguments.bind(py))
    }
}

impl PlanField {
    /// Name of the field.
    pub(crate) fn key<'py>(&self, py: Python<'py>) -> &Bound<'py, PyString> {
        self.key.get_or_init(py, || PyString::intern(py, &self.name).unbind()).bind(py)
    }

    /// Name of the slot.
    pub(crate) fn slot<'py>(&self, py: Python<'py>) -> &Bound<'py, PyString> {
        let make = || PyString::intern(py, &format!("_{}", self.name)).unbind();
        self.slot.get_or_init(py, make).bind(py)
    }

    /// Name of the type, as rosidl gives it: `sequence<float>`, `double[36]`, `std_msgs/Header`.
    pub(crate) fn type_text(&self) -> String {
        let element = self.element.type_text();
        match self.shape {
            ArrayShape::One => element,
            ArrayShape::Fixed(length) => format!("{element}[{length}]"),
            ArrayShape::Bounded(limit) => format!("sequence<{element}, {limit}>"),
            ArrayShape::Unbounded => format!("sequence<{element}>"),
        }
    }

    pub(crate) fn min_bytes(&self) -> usize {
        match self.shape {
            ArrayShape::One => self.element.min_bytes(),
            ArrayShape::Fixed(length) => self
                .element
                .min_bytes()
                .saturating_mul(usize::try_from(length).unwrap_or(usize::MAX)),
            _ => 4,
        }
    }
}

impl Element {
    /// Type of the numbers, if it is one.
    pub(crate) fn number(&self) -> Option<NumberKind> {
        match self {
            Self::Number(kind) => Some(*kind),
            Self::Byte => Some(NumberKind::U8),
            _ => None,
        }
    }

    pub(crate) fn min_bytes(&self) -> usize {
        match self {
            Self::Number(kind) => kind.size(),
            Self::Byte => 1,
            Self::Text(_) | Self::WideText(_) => 4,
            Self::Message(plan) => plan.min_bytes,
        }
    }

    fn type_text(&self) -> String {
        let bounded = |name: &str, limit: &Option<u32>| match limit {
            Some(limit) => format!("{name}<{limit}>"),
            None => name.to_owned(),
        };
        match self {
            Self::Number(NumberKind::Bool) => "boolean".into(),
            Self::Number(NumberKind::F32) => "float".into(),
            Self::Number(NumberKind::F64) => "double".into(),
            Self::Number(kind) => kind.name().into(),
            Self::Byte => "octet".into(),
            Self::Text(limit) => bounded("string", limit),
            Self::WideText(limit) => bounded("wstring", limit),
            Self::Message(plan) => plan.type_name.replace("/msg/", "/"),
        }
    }
}

impl Constant {
    pub(crate) fn to_object<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        scalar_object(py, &self.literal, &self.element)
    }

    /// The elements of a list.
    pub(crate) fn to_list<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let Literal::List(list) = &self.literal else { return Ok(PyList::empty(py)) };
        let values: PyResult<Vec<_>> =
            list.iter().map(|literal| scalar_object(py, literal, &self.element)).collect();
        PyList::new(py, values?)
    }
}

fn scalar_object<'py>(
    py: Python<'py>,
    literal: &Literal,
    element: &Element,
) -> PyResult<Bound<'py, PyAny>> {
    Ok(match (literal, element) {
        (Literal::Int(value), Element::Byte) => {
            let byte = u8::try_from(*value & 0xff).unwrap_or_default();
            PyBytes::new(py, &[byte]).into_any()
        }
        (Literal::Int(value), Element::Number(NumberKind::F32 | NumberKind::F64)) => {
            (*value as f64).into_pyobject(py)?.into_any()
        }
        (Literal::Float(value), Element::Number(NumberKind::F32)) => {
            #[allow(clippy::cast_possible_truncation, reason = "rounds to the type of the field")]
            let value = f64::from(*value as f32);
            value.into_pyobject(py)?.into_any()
        }
        (Literal::Bool(value), _) => value.into_pyobject(py)?.to_owned().into_any(),
        (Literal::Int(value), _) => value.into_pyobject(py)?.into_any(),
        (Literal::Float(value), _) => value.into_pyobject(py)?.into_any(),
        (Literal::Text(text), _) => text.into_pyobject(py)?.into_any(),
        (Literal::List(_), _) => py.None().into_bound(py),
    })
}

/// Types that Python knows: built-in ones, and those that programs have added.
struct Known {
    /// Added types, which replace built-in ones.
    added: Option<Arc<TypeRegistry>>,
    /// By style.
    plans: [HashMap<String, Arc<Plan>>; Style::ALL.len()],
}

static KNOWN: LazyLock<Mutex<Known>> =
    LazyLock::new(|| Mutex::new(Known { added: None, plans: Default::default() }));

/// Type of this name, as programs import it.
pub(crate) fn plan(type_name: &str) -> Option<Arc<Plan>> {
    plan_of_style(type_name, Style::Numpy)
}

/// Type of this name with the classes of a style.
pub(crate) fn plan_of_style(type_name: &str, style: Style) -> Option<Arc<Plan>> {
    let mut known = lock(&KNOWN);
    if let Some(plan) = known.plans[style as usize].get(type_name) {
        return Some(plan.clone());
    }
    let full_name = TypeName::read(type_name)?.to_string();
    let added = known.added.clone();
    let types = added.as_deref().unwrap_or_else(|| TypeRegistry::builtin());
    make(types, &full_name, style, &mut known.plans[style as usize])
}

/// Type of this name in a registry, such as that of the schemas of a bag. Types that are equal to known ones
/// have the same class.
pub(crate) fn plan_in(types: &TypeRegistry, type_name: &str) -> Option<Arc<Plan>> {
    let mut own = HashMap::new();
    make_equal(types, type_name, &mut own)
}

/// Returns true if two types have the same fields with the same bytes. Bounds and default values may differ, as
/// between ROS 1 and ROS 2.
fn is_same(a: &Layout, b: &Layout) -> bool {
    fn same_names(a: &Layout, b: &Layout) -> bool {
        a.fields().eq(b.fields())
            && a.fields().all(|field| match (a.nested(field), b.nested(field)) {
                (Some(a), Some(b)) => same_names(a, b),
                (a, b) => a.is_none() && b.is_none(),
            })
    }
    a == b || a.has_bytes_of(b) && same_names(a, b)
}

fn make_equal(
    types: &TypeRegistry,
    type_name: &str,
    own: &mut HashMap<String, Arc<Plan>>,
) -> Option<Arc<Plan>> {
    let layout = types.layout(type_name)?;
    if let Some(known) = plan(type_name).filter(|known| is_same(&known.layout, layout)) {
        return Some(known);
    }
    if let Some(known) = own.get(type_name) {
        return Some(known.clone());
    }
    let definition = types.registry().get(&TypeName::read(type_name)?)?;
    for field in &definition.fields {
        if let ElementType::Nested(nested) = &field.r#type.element {
            let nested = nested.to_string();
            let plan = make_equal(types, &nested, own)?;
            own.insert(nested, plan);
        }
    }
    make(types, type_name, Style::Numpy, own)
}

/// Adds the types of a registry, which includes the built-in ones. Classes of types that have changed are
/// created again.
pub(crate) fn add_types(types: TypeRegistry) {
    let mut known = lock(&KNOWN);
    for plans in &mut known.plans {
        plans.retain(|name, plan| types.layout(name) == Some(&plan.layout));
    }
    known.added = Some(Arc::new(types));
}

/// Calls a function with all types.
pub(crate) fn all_types<T>(get: impl FnOnce(&TypeRegistry) -> T) -> T {
    let added = lock(&KNOWN).added.clone();
    get(added.as_deref().unwrap_or_else(|| TypeRegistry::builtin()))
}

pub(crate) fn unknown_type(type_name: &str) -> PyErr {
    let near = all_types(|types| {
        periplus::diagnostics::closest(type_name, types.type_names()).map(str::to_owned)
    });
    let mut text = format!("there is no message type `{type_name}`");
    if let Some(near) = near {
        text.push_str(&format!(", did you mean `{near}`?"));
    }
    PyKeyError::new_err(text)
}

fn make(
    types: &TypeRegistry,
    type_name: &str,
    style: Style,
    made: &mut HashMap<String, Arc<Plan>>,
) -> Option<Arc<Plan>> {
    if let Some(known) = made.get(type_name) {
        return Some(known.clone());
    }
    let name = TypeName::read(type_name)?;
    let layout = types.layout(type_name)?.clone();
    let definition = types.registry().get(&name)?;
    let mut fields = Vec::new();
    for field in &definition.fields {
        let element = element(types, &field.r#type.element, style, made)?;
        let default = field
            .default
            .as_ref()
            .map(|literal| Constant { literal: literal.clone(), element: element.clone() });
        fields.push(PlanField {
            name: field.name.clone(),
            element,
            shape: field.r#type.shape,
            default,
            key: PyOnceLock::new(),
            slot: PyOnceLock::new(),
        });
    }
    let mut constants = Vec::new();
    for constant in &definition.constants {
        let element = element(types, &constant.element, style, made)?;
        let value = Constant { literal: constant.value.clone(), element };
        constants.push((constant.name.clone(), value));
    }
    let plan = Arc::new(Plan {
        style,
        type_name: type_name.to_owned(),
        label: name.name.clone(),
        min_bytes: fields.iter().map(PlanField::min_bytes).fold(0, usize::saturating_add),
        fields,
        constants,
        doc: definition.doc.clone(),
        hash: types.hash(type_name),
        layout,
        schema: types.schema_text(type_name).unwrap_or_default().to_owned(),
        class: PyOnceLock::new(),
    });
    made.insert(type_name.to_owned(), plan.clone());
    Some(plan)
}

fn element(
    types: &TypeRegistry,
    element: &ElementType,
    style: Style,
    made: &mut HashMap<String, Arc<Plan>>,
) -> Option<Element> {
    let narrow = |limit: &u64| u32::try_from(*limit).unwrap_or(u32::MAX);
    Some(match element {
        ElementType::Scalar(Scalar::Byte) => Element::Byte,
        ElementType::Scalar(scalar) => Element::Number(kind(*scalar)),
        ElementType::String(limit) => Element::Text(limit.as_ref().map(narrow)),
        ElementType::WString(limit) => Element::WideText(limit.as_ref().map(narrow)),
        ElementType::Nested(nested) => {
            Element::Message(make(types, &nested.to_string(), style, made)?)
        }
    })
}

fn kind(scalar: Scalar) -> NumberKind {
    match scalar {
        Scalar::Bool => NumberKind::Bool,
        Scalar::Byte | Scalar::Char | Scalar::U8 => NumberKind::U8,
        Scalar::I8 | Scalar::Ros1Byte => NumberKind::I8,
        Scalar::I16 => NumberKind::I16,
        Scalar::U16 => NumberKind::U16,
        Scalar::I32 => NumberKind::I32,
        Scalar::U32 => NumberKind::U32,
        Scalar::I64 => NumberKind::I64,
        Scalar::U64 => NumberKind::U64,
        Scalar::F32 => NumberKind::F32,
        Scalar::F64 => NumberKind::F64,
    }
}
