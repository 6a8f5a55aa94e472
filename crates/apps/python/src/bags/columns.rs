//! Fields of messages as arrays over time.

use std::sync::Arc;

use periplus::diagnostics::closest;
use periplus::msgs::{Number, NumberVec};
use periplus_rosidl::ArrayShape;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PySlice};

use super::prefetch::Prefetch;
use super::source::{Source, Wanted};
use crate::errors::{runtime_error, value_error};
use crate::messages::{Element, Plan, PlanField, TapeReader, array};
use crate::work::released;

/// Dictionary of the columns.
pub(super) fn to_numpy<'py>(
    py: Python<'py>,
    source: Arc<Source>,
    wanted: Wanted,
    topic: &str,
    fields: Option<Vec<String>>,
) -> PyResult<Bound<'py, PyDict>> {
    let known: Vec<_> =
        source.topics().iter().filter(|data| data.topic.name == topic && data.count > 0).collect();
    let known = known
        .first()
        .copied()
        .or_else(|| source.topics().iter().find(|data| data.topic.name == topic));
    let Some(known) = known else {
        return Err(PyValueError::new_err(format!("the bag has no topic `{topic}`")));
    };
    let (plan, _) = known
        .plan
        .as_ref()
        .map_err(|why| value_error(format!("the messages of `{topic}` cannot be read: {why}")))?;
    let is_same = |data: &super::source::TopicData| {
        data.topic.name != topic
            || data.plan.as_ref().is_ok_and(|(other, _)| Arc::ptr_eq(other, plan))
    };
    if !source.topics().iter().all(is_same) {
        return Err(PyValueError::new_err(format!("`{topic}` has messages of several types")));
    }
    let paths = fields.unwrap_or_else(|| {
        let mut paths = Vec::new();
        all_paths(plan, "", &mut paths);
        paths
    });
    let mut table = Table { select: vec![Select::Skip; plan.fields.len()], columns: Vec::new() };
    for path in &paths {
        table.add(plan, path).map_err(value_error)?;
    }
    let mut prefetch = Prefetch::start(&source, &wanted, false)?;
    let mut times_ns: Vec<i64> = Vec::new();
    while let Some(batch) = prefetch.next(py)? {
        let (table, times_ns) = (&mut table, &mut times_ns);
        released(py, "reading the fields", move || {
            let mut tape = batch.tape.read();
            for entry in &batch.entries {
                times_ns.push(entry.time_ns);
                let Table { select, columns } = &mut *table;
                message(plan, Some(select), &mut tape, columns).map_err(|error| match error {
                    Stop::Short => "a message has fewer values than its type".to_owned(),
                    Stop::NoElement(path) => format!(
                        "message {} of `{topic}` has no element `{path}`",
                        times_ns.len() - 1
                    ),
                })?;
            }
            Ok::<(), String>(())
        })?
        .map_err(value_error)?;
    }
    if let Some(fault) = prefetch.faults.first() {
        let text = std::ffi::CString::new(fault.as_str()).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<pyo3::exceptions::PyUserWarning>(), &text, 1)?;
    }
    let count = times_ns.len();
    let result = PyDict::new(py);
    result.set_item("time_ns", array(py, NumberVec::I64(times_ns)))?;
    for (path, column) in paths.iter().zip(table.columns) {
        result.set_item(path, column.into_object(py, count)?)?;
    }
    Ok(result)
}

/// Selected part of a field.
#[derive(Clone)]
enum Select {
    Skip,
    /// The value goes to columns.
    Columns(Vec<usize>),
    /// Parts of a message, by field, and columns for it as a time.
    Message(Vec<Select>, Vec<usize>),
    /// Elements of a list.
    Elements(Vec<(usize, Select)>, Vec<usize>),
}

struct Table {
    select: Vec<Select>,
    columns: Vec<Column>,
}

struct Column {
    path: String,
    data: ColumnData,
}

enum ColumnData {
    Numbers(NumberVec),
    Texts(Vec<String>),
    TextLists(Vec<Vec<String>>),
    /// Values of all arrays, and the length of each.
    Arrays(NumberVec, Vec<usize>),
}

enum Stop {
    Short,
    NoElement(String),
}

const TIMES: [&str; 2] = ["builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration"];

fn is_time(plan: &Plan) -> bool {
    TIMES.contains(&plan.type_name.as_str())
}

/// Paths of all fields that are not within lists of messages.
fn all_paths(plan: &Plan, prefix: &str, paths: &mut Vec<String>) {
    for field in &plan.fields {
        let path = format!("{prefix}{}", field.name);
        match (&field.element, field.shape) {
            (Element::Message(inner), ArrayShape::One) if !is_time(inner) => {
                all_paths(inner, &format!("{path}."), paths);
            }
            (Element::Message(_), ArrayShape::One) => paths.push(path),
            (Element::Message(_), _) => {}
            _ => paths.push(path),
        }
    }
}

/// Step of a path: a name, and an index.
fn steps(path: &str) -> Result<Vec<(&str, Option<usize>)>, String> {
    let step = |text| match str::split_once(text, '[') {
        None => Some((text, None)),
        Some((name, rest)) => Some((name, Some(rest.strip_suffix(']')?.parse::<usize>().ok()?))),
    };
    let steps: Option<Vec<_>> = path.split('.').map(step).collect();
    steps.ok_or_else(|| format!("`{path}` is not a path of a field, such as `pose.position.x`"))
}

impl Table {
    fn add(&mut self, plan: &Arc<Plan>, path: &str) -> Result<(), String> {
        let steps = steps(path)?;
        let column = self.columns.len();
        let data = extend(&mut self.select, plan, &steps, column, path)?;
        self.columns.push(Column { path: path.to_owned(), data });
        Ok(())
    }
}

/// Adds a path to the selection of a message. Returns its empty column.
fn extend(
    select: &mut [Select],
    plan: &Arc<Plan>,
    steps: &[(&str, Option<usize>)],
    column: usize,
    path: &str,
) -> Result<ColumnData, String> {
    let Some(((name, index), rest)) = steps.split_first() else {
        return Err(format!("`{path}` is not a field"));
    };
    let Some(at) = plan.fields.iter().position(|field| field.name == *name) else {
        let names = || plan.fields.iter().map(|field| field.name.as_str());
        let near = match closest(name, names()) {
            Some(near) => format!(", did you mean `{near}`?"),
            None => format!("; its fields are: {}", names().collect::<Vec<_>>().join(", ")),
        };
        return Err(format!("{} has no field `{name}`{near}", plan.type_name));
    };
    let field = &plan.fields[at];
    let own = &mut select[at];
    match (field.shape, index) {
        (ArrayShape::One, Some(_)) => Err(format!("`{name}` in `{path}` is not a list")),
        (ArrayShape::One, None) => extend_one(own, &field.element, rest, column, path),
        (_, Some(index)) => {
            if matches!(own, Select::Skip) {
                *own = Select::Elements(Vec::new(), Vec::new());
            } else if let Select::Columns(whole) = own {
                *own = Select::Elements(Vec::new(), std::mem::take(whole));
            }
            let Select::Elements(elements, _) = own else {
                return Err(format!("`{path}` cannot be selected"));
            };
            let at = match elements.iter().position(|(at, _)| at == index) {
                Some(at) => at,
                None => {
                    elements.push((*index, Select::Skip));
                    elements.len() - 1
                }
            };
            extend_one(&mut elements[at].1, &field.element, rest, column, path)
        }
        (_, None) => {
            if !rest.is_empty() || matches!(field.element, Element::Message(_)) {
                return Err(format!(
                    "`{name}` in `{path}` is a list; give an element, such as `{name}[0]`"
                ));
            }
            match own {
                Select::Columns(columns) | Select::Elements(_, columns) => columns.push(column),
                own => *own = Select::Columns(vec![column]),
            }
            Ok(match field.element.number() {
                Some(kind) => ColumnData::Arrays(kind.zeros(0), Vec::new()),
                None => ColumnData::TextLists(Vec::new()),
            })
        }
    }
}

fn extend_one(
    own: &mut Select,
    element: &Element,
    rest: &[(&str, Option<usize>)],
    column: usize,
    path: &str,
) -> Result<ColumnData, String> {
    if let Element::Message(inner) = element {
        if matches!(own, Select::Skip) {
            *own = Select::Message(vec![Select::Skip; inner.fields.len()], Vec::new());
        }
        let Select::Message(fields, whole) = own else {
            return Err(format!("`{path}` cannot be selected"));
        };
        if rest.is_empty() && is_time(inner) {
            whole.push(column);
            return Ok(ColumnData::Numbers(NumberVec::I64(Vec::new())));
        }
        if rest.is_empty() {
            let names: Vec<&str> = inner.fields.iter().map(|field| field.name.as_str()).collect();
            return Err(format!("`{path}` is a message; give a field: {}", names.join(", ")));
        }
        return extend(fields, inner, rest, column, path);
    }
    if !rest.is_empty() {
        return Err(format!("`{path}` goes on behind a number or text"));
    }
    match own {
        Select::Columns(columns) => columns.push(column),
        own => *own = Select::Columns(vec![column]),
    }
    Ok(match element.number() {
        Some(kind) => ColumnData::Numbers(kind.zeros(0)),
        None => ColumnData::Texts(Vec::new()),
    })
}

/// Takes a message from the tape.
fn message(
    plan: &Plan,
    select: Option<&[Select]>,
    tape: &mut TapeReader,
    columns: &mut [Column],
) -> Result<(), Stop> {
    for (at, field) in plan.fields.iter().enumerate() {
        let select = select.map_or(&Select::Skip, |select| &select[at]);
        self::field(field, select, tape, columns)?;
    }
    Ok(())
}

fn field(
    field: &PlanField,
    select: &Select,
    tape: &mut TapeReader,
    columns: &mut [Column],
) -> Result<(), Stop> {
    if field.shape == ArrayShape::One {
        return one(&field.element, select, tape, columns);
    }
    let (elements, whole): (&[_], &[usize]) = match select {
        Select::Elements(elements, whole) => (elements, whole),
        Select::Columns(whole) => (&[], whole),
        _ => (&[], &[]),
    };
    if field.element.number().is_some() {
        let numbers = tape.arrays.next().ok_or(Stop::Short)?;
        for (index, select) in elements {
            if let Select::Columns(own) = select {
                for column in own {
                    let missing = || Stop::NoElement(columns[*column].path.clone());
                    let number = numbers.borrow().get(*index).ok_or_else(missing)?;
                    columns[*column].push(number);
                }
            }
        }
        for column in whole {
            if let ColumnData::Arrays(all, lengths) = &mut columns[*column].data {
                lengths.push(numbers.borrow().len());
                append(all, &numbers);
            }
        }
        return Ok(());
    }
    let length = tape.lengths.next().ok_or(Stop::Short)?;
    if let Some((_, missing)) = elements.iter().find(|(index, _)| *index >= length) {
        let column = first_column(missing).unwrap_or_default();
        return Err(Stop::NoElement(columns[column].path.clone()));
    }
    let mut texts = Vec::new();
    for index in 0..length {
        let chosen = elements.iter().find(|(at, _)| *at == index);
        let is_text = matches!(field.element, Element::Text(_) | Element::WideText(_));
        if is_text && !whole.is_empty() {
            let text = tape.texts.next().ok_or(Stop::Short)?;
            if let Some((_, Select::Columns(own))) = chosen {
                own.iter().for_each(|column| columns[*column].push_text(&text));
            }
            texts.push(text);
        } else {
            let select = chosen.map_or(&Select::Skip, |(_, select)| select);
            one(&field.element, select, tape, columns)?;
        }
    }
    for column in whole {
        if let ColumnData::TextLists(all) = &mut columns[*column].data {
            all.push(texts.clone());
        }
    }
    Ok(())
}

fn first_column(select: &Select) -> Option<usize> {
    match select {
        Select::Skip => None,
        Select::Columns(columns) => columns.first().copied(),
        Select::Message(fields, whole) => {
            whole.first().copied().or_else(|| fields.iter().find_map(first_column))
        }
        Select::Elements(elements, whole) => {
            let first = || elements.iter().find_map(|(_, select)| first_column(select));
            whole.first().copied().or_else(first)
        }
    }
}

fn one(
    element: &Element,
    select: &Select,
    tape: &mut TapeReader,
    columns: &mut [Column],
) -> Result<(), Stop> {
    match element {
        Element::Number(_) | Element::Byte => {
            let number = tape.numbers.next().ok_or(Stop::Short)?;
            if let Select::Columns(own) = select {
                own.iter().for_each(|column| columns[*column].push(number));
            }
        }
        Element::Text(_) | Element::WideText(_) => {
            let text = tape.texts.next().ok_or(Stop::Short)?;
            if let Select::Columns(own) = select {
                own.iter().for_each(|column| columns[*column].push_text(&text));
            }
        }
        Element::Message(plan) => match select {
            Select::Message(fields, whole) => {
                if let ([_, ..], [Number::I32(sec), Number::U32(nanosec), ..]) =
                    (whole.as_slice(), tape.numbers.as_slice())
                {
                    let time_ns = i64::from(*sec) * 1_000_000_000 + i64::from(*nanosec);
                    whole.iter().for_each(|column| columns[*column].push(Number::I64(time_ns)));
                }
                message(plan, Some(fields), tape, columns)?;
            }
            _ => message(plan, None, tape, columns)?,
        },
    }
    Ok(())
}

/// Calls a macro with all kinds of numbers.
macro_rules! kinds {
    ($macro:ident) => {
        $macro!(Bool I8 U8 I16 U16 I32 U32 I64 U64 F32 F64)
    };
}

fn append(all: &mut NumberVec, more: &NumberVec) {
    macro_rules! append {
        ($($kind:ident)*) => {
            match (all, more) {
                $((NumberVec::$kind(all), NumberVec::$kind(more)) => all.extend_from_slice(more),)*
                // A column has the type of its field.
                _ => {}
            }
        };
    }
    kinds!(append);
}

impl Column {
    fn push(&mut self, number: Number) {
        macro_rules! push {
            ($($kind:ident)*) => {
                match (&mut self.data, number) {
                    $((ColumnData::Numbers(NumberVec::$kind(all)), Number::$kind(number)) => {
                        all.push(number);
                    })*
                    // A column has the type of its field.
                    _ => {}
                }
            };
        }
        kinds!(push);
    }

    fn push_text(&mut self, text: &str) {
        if let ColumnData::Texts(all) = &mut self.data {
            all.push(text.to_owned());
        }
    }

    fn into_object(self, py: Python<'_>, count: usize) -> PyResult<Bound<'_, PyAny>> {
        let objects = |values: Vec<Bound<'_, PyAny>>| -> PyResult<Py<PyAny>> {
            let array = numpy::PyArray1::<Py<PyAny>>::from_vec(
                py,
                values.into_iter().map(Bound::unbind).collect(),
            );
            Ok(array.into_any().unbind())
        };
        match self.data {
            ColumnData::Numbers(numbers) => Ok(array(py, numbers)),
            ColumnData::Texts(texts) => {
                let texts: PyResult<Vec<_>> =
                    texts.into_iter().map(|text| Ok(text.into_pyobject(py)?.into_any())).collect();
                Ok(objects(texts?)?.into_bound(py))
            }
            ColumnData::TextLists(lists) => {
                let lists: PyResult<Vec<_>> =
                    lists.into_iter().map(|list| Ok(PyList::new(py, list)?.into_any())).collect();
                Ok(objects(lists?)?.into_bound(py))
            }
            ColumnData::Arrays(values, lengths) => {
                if lengths.len() != count {
                    return Err(runtime_error("a column is not complete"));
                }
                let flat = array(py, values);
                let width = lengths.first().copied().unwrap_or_default();
                if lengths.iter().all(|length| *length == width) {
                    return flat.call_method1("reshape", ((count, width),));
                }
                let mut at = 0;
                let mut parts = Vec::new();
                for length in lengths {
                    let (start, end) = (isize::try_from(at)?, isize::try_from(at + length)?);
                    parts.push(flat.get_item(PySlice::new(py, start, end, 1))?);
                    at += length;
                }
                Ok(objects(parts)?.into_bound(py))
            }
        }
    }
}
