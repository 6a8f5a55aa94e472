//! Messages in the format of Python's `repr`, which `ros2 topic pub` and `ros2 service call` print.

use periplus_msgs::{Count, DynamicMessage, Number, NumberKind, Numbers, Part, Sink};

use super::whole;

/// Text such as `geometry_msgs.msg.Vector3(x=1.0, y=0.0, z=0.0)`.
#[must_use]
pub fn repr(message: &DynamicMessage) -> String {
    let mut sink = Repr { out: String::new() };
    message.write(&mut sink);
    sink.out
}

/// Number in Python syntax.
pub(crate) fn number(number: Number) -> String {
    match number {
        Number::Bool(true) => "True".into(),
        Number::Bool(false) => "False".into(),
        // Python has only one float type, and prints all digits.
        Number::F32(number) => float(number.into()),
        Number::F64(number) => float(number),
        number => whole(number).unwrap_or(0).to_string(),
    }
}

/// Python's `repr` of a float.
pub(crate) fn float(number: f64) -> String {
    if number.is_nan() {
        return "nan".into();
    }
    if number.is_infinite() {
        return if number > 0.0 { "inf".into() } else { "-inf".into() };
    }
    let scientific = format!("{number:e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..16).contains(&exponent) {
        let fixed = number.to_string();
        return if fixed.contains('.') { fixed } else { format!("{fixed}.0") };
    }
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{digits}e{sign}{:02}", exponent.abs())
}

/// Python's `repr` of a string.
pub(crate) fn text(text: &str) -> String {
    let quote = if text.contains('\'') && !text.contains('"') { '"' } else { '\'' };
    let mut out = String::from(quote);
    for character in text.chars() {
        match character {
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            c if c == quote => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() && (c as u32) < 0x100 => {
                out.push_str(&format!("\\x{:02x}", c as u32));
            }
            c => out.push(c),
        }
    }
    out.push(quote);
    out
}

/// Python's `str` of a sequence field: numbers are in an `array`.
pub(super) fn sequence(part: &Part<'_>) -> String {
    let mut sink = Repr { out: String::new() };
    part.write(&mut sink);
    let code = match part.number_kind() {
        Some(NumberKind::I8) => 'b',
        Some(NumberKind::U8) => 'B',
        Some(NumberKind::I16) => 'h',
        Some(NumberKind::U16) => 'H',
        Some(NumberKind::I32) => 'i',
        Some(NumberKind::U32) => 'I',
        Some(NumberKind::I64) => 'q',
        Some(NumberKind::U64) => 'Q',
        Some(NumberKind::F32) => 'f',
        Some(NumberKind::F64) => 'd',
        // Booleans, `byte`, strings and messages.
        Some(NumberKind::Bool) | None => return sink.out,
    };
    match sink.out.as_str() {
        "[]" => format!("array('{code}')"),
        numbers => format!("array('{code}', {numbers})"),
    }
}

struct Repr {
    out: String,
}

impl Repr {
    fn comma(&mut self) {
        if !self.out.is_empty() && !self.out.ends_with(['(', '[', '=']) {
            self.out.push_str(", ");
        }
    }
}

impl Sink for Repr {
    fn begin(&mut self, type_name: &str) {
        self.comma();
        self.out.push_str(&type_name.replace('/', "."));
        self.out.push('(');
    }

    fn end(&mut self, _: bool) {
        self.out.push(')');
    }

    fn field(&mut self, name: &str) {
        self.comma();
        self.out.push_str(name);
        self.out.push('=');
    }

    fn number(&mut self, number: Number) {
        self.comma();
        self.out.push_str(&self::number(number));
    }

    fn text(&mut self, text: &str, _: Option<u32>) {
        self.comma();
        self.out.push_str(&self::text(text));
    }

    fn wide_text(&mut self, text: &str, limit: Option<u32>) {
        self.text(text, limit);
    }

    fn list(&mut self, _: usize, _: Count) {
        self.comma();
        self.out.push('[');
    }

    fn end_list(&mut self) {
        self.out.push(']');
    }

    fn numbers(&mut self, numbers: Numbers<'_>) {
        for number in (0..numbers.len()).filter_map(|index| numbers.get(index)) {
            self.number(number);
        }
    }
}
