//! JSON: objects with the names of the fields, arrays, numbers, strings.
//!
//! Numbers that JSON does not have are written as `"NaN"`, `"Infinity"` and `"-Infinity"`; `null` is read
//! as NaN too. Bytes are arrays of numbers.

use serde_json::{Map, Value};

use crate::{
    Codec, Count, DecodeError, Number, NumberKind, Numbers, NumbersMut, Problem, Sink, Source,
};

/// Converts a value to JSON.
pub fn to_json<T: Codec>(value: &T) -> Value {
    let mut writer = Writer::default();
    value.write(&mut writer, None);
    writer.done
}

/// Parses a value from JSON. Missing fields have their default values.
///
/// # Errors
/// If the JSON does not match the type.
pub fn from_json<T: Codec>(json: &Value) -> Result<T, DecodeError> {
    let mut value = T::blank();
    value.read(&mut Reader::new(json), None)?;
    Ok(value)
}

#[derive(Default)]
pub(crate) struct Writer {
    /// Open structures and lists, innermost last.
    open: Vec<Open>,
    pub(crate) done: Value,
}

enum Open {
    Object(Map<String, Value>, String),
    Array(Vec<Value>),
}

impl Writer {
    fn put(&mut self, value: Value) {
        match self.open.last_mut() {
            Some(Open::Object(object, field)) => {
                object.insert(std::mem::take(field), value);
            }
            Some(Open::Array(array)) => array.push(value),
            None => self.done = value,
        }
    }

    fn close(&mut self) {
        match self.open.pop() {
            Some(Open::Object(object, _)) => self.put(Value::Object(object)),
            Some(Open::Array(array)) => self.put(Value::Array(array)),
            None => {}
        }
    }
}

impl Sink for Writer {
    fn begin(&mut self, _: &str) {
        self.open.push(Open::Object(Map::new(), String::new()));
    }

    fn end(&mut self, _: bool) {
        self.close();
    }

    fn field(&mut self, name: &str) {
        if let Some(Open::Object(_, field)) = self.open.last_mut() {
            name.clone_into(field);
        }
    }

    fn number(&mut self, number: Number) {
        self.put(number_to_json(number));
    }

    fn text(&mut self, text: &str, _: Option<u32>) {
        self.put(text.into());
    }

    fn wide_text(&mut self, text: &str, _: Option<u32>) {
        self.put(text.into());
    }

    fn list(&mut self, length: usize, _: Count) {
        self.open.push(Open::Array(Vec::with_capacity(length)));
    }

    fn end_list(&mut self) {
        self.close();
    }

    fn numbers(&mut self, numbers: Numbers<'_>) {
        let all = (0..numbers.len()).filter_map(|index| numbers.get(index));
        if let Some(Open::Array(array)) = self.open.last_mut() {
            array.extend(all.map(number_to_json));
        }
    }
}

fn number_to_json(number: Number) -> Value {
    let float = |number: f64| match serde_json::Number::from_f64(number) {
        Some(number) => Value::Number(number),
        None if number.is_nan() => "NaN".into(),
        None if number > 0.0 => "Infinity".into(),
        None => "-Infinity".into(),
    };
    match number {
        Number::Bool(number) => number.into(),
        Number::I8(number) => number.into(),
        Number::U8(number) => number.into(),
        Number::I16(number) => number.into(),
        Number::U16(number) => number.into(),
        Number::I32(number) => number.into(),
        Number::U32(number) => number.into(),
        Number::I64(number) => number.into(),
        Number::U64(number) => number.into(),
        Number::F32(number) => float(number.into()),
        Number::F64(number) => float(number),
    }
}

pub(crate) struct Reader<'a> {
    /// Current value, after the values that contain it.
    path: Vec<&'a Value>,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(json: &'a Value) -> Self {
        Self { path: vec![json] }
    }

    fn here(&self) -> &'a Value {
        self.path.last().copied().unwrap_or(&Value::Null)
    }

    fn array(&self) -> Result<&'a Vec<Value>, DecodeError> {
        self.here().as_array().ok_or_else(|| unexpected("an array", self.here()))
    }
}

fn unexpected(expected: impl Into<String>, found: &Value) -> DecodeError {
    let problem = Problem::Json { expected: expected.into(), found: describe(found) };
    DecodeError::new(problem, 0)
}

fn not_a_string(found: &Value) -> DecodeError {
    DecodeError::new(Problem::NotAString { found: describe(found) }, 0)
}

/// Value as it is named in messages.
fn describe(value: &Value) -> String {
    match value {
        Value::Null => "null".into(),
        Value::Bool(value) => value.to_string(),
        Value::Number(value) => value.to_string(),
        Value::String(text) => format!("the text {:?}", text.chars().take(40).collect::<String>()),
        Value::Array(_) => "an array".into(),
        Value::Object(_) => "an object".into(),
    }
}

impl Source for Reader<'_> {
    fn begin(
        &mut self,
        _: &str,
        fields: &mut dyn Iterator<Item = &str>,
    ) -> Result<(), DecodeError> {
        let object = self.here().as_object().ok_or_else(|| unexpected("an object", self.here()))?;
        let known: Vec<&str> = fields.collect();
        match object.keys().find(|key| !known.contains(&key.as_str())) {
            None => Ok(()),
            Some(stranger) => {
                let known = known.into_iter().map(String::from).collect();
                Err(DecodeError::new(Problem::Unknown { name: stranger.clone(), known }, 0))
            }
        }
    }

    fn end(&mut self, _: bool) -> Result<(), DecodeError> {
        Ok(())
    }

    fn enter(&mut self, name: &str) -> Result<bool, DecodeError> {
        let value = self.here().get(name);
        self.path.extend(value);
        Ok(value.is_some())
    }

    fn enter_element(&mut self, index: usize) -> Result<(), DecodeError> {
        self.path.push(self.here().get(index).unwrap_or(&Value::Null));
        Ok(())
    }

    fn leave(&mut self) {
        self.path.pop();
    }

    fn number(&mut self, kind: NumberKind) -> Result<Number, DecodeError> {
        number_from_json(self.here(), kind)
    }

    fn text(&mut self, limit: Option<u32>) -> Result<String, DecodeError> {
        let text = self.here().as_str().ok_or_else(|| not_a_string(self.here()))?;
        bounded(text.len(), limit.map(|limit| limit as usize))?;
        Ok(text.into())
    }

    fn wide_text(&mut self, limit: Option<u32>) -> Result<String, DecodeError> {
        let text = self.text(None)?;
        bounded(text.encode_utf16().count(), limit.map(|limit| limit as usize))?;
        Ok(text)
    }

    fn list(&mut self, count: Count, _: usize) -> Result<usize, DecodeError> {
        let length = self.array()?.len();
        match count {
            Count::Fixed(fixed) if fixed != length => {
                let expected = format!("{fixed} elements");
                Err(DecodeError::new(Problem::Json { expected, found: length.to_string() }, 0))
            }
            Count::AtMost(limit) => bounded(length, Some(limit)).map(|()| length),
            _ => Ok(length),
        }
    }

    fn numbers(&mut self, mut numbers: NumbersMut<'_>) -> Result<(), DecodeError> {
        let kind = numbers.kind();
        for (index, value) in self.array()?.iter().enumerate() {
            let number = number_from_json(value, kind);
            numbers.set(index, number.map_err(|error| error.within_element(index))?);
        }
        Ok(())
    }
}

fn bounded(count: usize, limit: Option<usize>) -> Result<(), DecodeError> {
    match limit {
        Some(limit) if count > limit => Err(DecodeError::new(Problem::Bound { count, limit }, 0)),
        _ => Ok(()),
    }
}

fn number_from_json(value: &Value, kind: NumberKind) -> Result<Number, DecodeError> {
    fn whole<T: TryFrom<i128>>(value: &Value) -> Option<T> {
        let number = value.as_i64().map(i128::from).or_else(|| value.as_u64().map(i128::from))?;
        T::try_from(number).ok()
    }
    let float = || match value {
        Value::Number(number) => number.as_f64(),
        Value::Null => Some(f64::NAN),
        Value::String(text) => match text.as_str() {
            "NaN" => Some(f64::NAN),
            "Infinity" => Some(f64::INFINITY),
            "-Infinity" => Some(f64::NEG_INFINITY),
            _ => None,
        },
        _ => None,
    };
    #[allow(clippy::cast_possible_truncation, reason = "a float32 is the nearest to what is given")]
    let single = || float().map(|wide| (wide, wide as f32));
    let number = match kind {
        NumberKind::Bool => value.as_bool().map(Number::Bool),
        NumberKind::I8 => whole(value).map(Number::I8),
        NumberKind::U8 => whole(value).map(Number::U8),
        NumberKind::I16 => whole(value).map(Number::I16),
        NumberKind::U16 => whole(value).map(Number::U16),
        NumberKind::I32 => whole(value).map(Number::I32),
        NumberKind::U32 => whole(value).map(Number::U32),
        NumberKind::I64 => whole(value).map(Number::I64),
        NumberKind::U64 => whole(value).map(Number::U64),
        NumberKind::F32 => single()
            .filter(|(wide, single)| single.is_finite() || !wide.is_finite())
            .map(|(_, single)| Number::F32(single)),
        NumberKind::F64 => float().map(Number::F64),
    };
    number.ok_or_else(|| unexpected(format!("a value of type {}", kind.name()), value))
}
