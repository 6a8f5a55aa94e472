//! YAML in the format of `ros2 topic echo`.
//!
//! The format is PyYAML's block style after `rosidl_runtime_py.message_to_ordereddict`. One difference is
//! deliberate: a text of several lines is one line in double quotes here, so that every field has its own
//! line.

mod flow;

use crate::dynamic::{Element, Layout, Shape, Value};
use crate::{Number, Numbers};

/// Options of the printer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct YamlStyle {
    /// Maximum length of lists and texts (elements or characters); longer ones are truncated. Default 128,
    /// as in `ros2 topic echo`.
    pub longest: Option<usize>,
    /// Prints only the type and length of lists (`--no-arr`).
    pub no_arrays: bool,
    /// Prints only the length of texts (`--no-str`).
    pub no_texts: bool,
    /// Prints all on one line, in braces and brackets (`--flow-style`).
    pub flow: bool,
}

impl Default for YamlStyle {
    fn default() -> Self {
        Self { longest: Some(128), no_arrays: false, no_texts: false, flow: false }
    }
}

pub(crate) fn print(layout: &Layout, values: &[Value], style: &YamlStyle) -> String {
    let mut printer = Printer { out: String::new(), style };
    if style.flow {
        flow::mapping(&mut printer, layout, values);
        printer.out.push('\n');
    } else if layout.fields.is_empty() {
        printer.out.push_str("{}\n");
    } else {
        printer.mapping(layout, values, 0, false);
    }
    printer.out
}

/// Prints a part of a message: a message, a list, or one number or text on a line.
pub(crate) fn print_part(
    element: &Element,
    shape: Shape,
    value: &Value,
    style: &YamlStyle,
) -> String {
    let mut printer = Printer { out: String::new(), style };
    match (value, shape) {
        (Value::Struct(values), _) => {
            if let Element::Struct(layout) = element {
                return print(layout, values, style);
            }
        }
        (value, _) if style.flow => {
            flow::value(&mut printer, element, shape, value);
            printer.out.push('\n');
        }
        (Value::Numbers(numbers), Shape::List(_)) => printer.numbers(numbers.borrow(), element, 0),
        (Value::List(list), Shape::List(_)) => printer.list(list, element, 0),
        (value, _) => printer.scalar(value, element),
    }
    // The separator after a name is not part of the text.
    let text = printer.out;
    text.strip_prefix('\n').or(text.strip_prefix(' ')).map(str::to_owned).unwrap_or(text)
}

struct Printer<'a> {
    out: String,
    style: &'a YamlStyle,
}

impl Printer<'_> {
    fn indent(&mut self, depth: usize) {
        self.out.extend(std::iter::repeat_n(' ', depth));
    }

    /// Prints the fields of a structure; `is_begun` if the first is on a line that is not empty.
    fn mapping(&mut self, layout: &Layout, values: &[Value], depth: usize, mut is_begun: bool) {
        for (field, value) in layout.fields.iter().zip(values) {
            if !is_begun {
                self.indent(depth);
            }
            is_begun = false;
            self.out.push_str(&quoted(&field.name));
            self.out.push(':');
            match (value, field.shape) {
                (Value::Numbers(numbers), Shape::List(_)) => {
                    self.numbers(numbers.borrow(), &field.element, depth);
                }
                (Value::List(list), Shape::List(_)) => self.list(list, &field.element, depth),
                (Value::Struct(values), _) => {
                    if let Element::Struct(layout) = &field.element {
                        let is_empty = layout.fields.is_empty();
                        self.out.push_str(if is_empty { " {}\n" } else { "\n" });
                        self.mapping(layout, values, depth + 2, false);
                    }
                }
                (value, _) => {
                    self.out.push(' ');
                    self.scalar(value, &field.element);
                }
            }
        }
    }

    /// Prints the replacement of a hidden list, or returns the number of elements to print.
    fn shown(&mut self, length: usize, element: &Element) -> Option<usize> {
        match self.stands_for(length, element) {
            Some(text) => {
                self.out.push(' ');
                self.out.push_str(&text);
                self.out.push('\n');
                None
            }
            None => {
                self.out.push('\n');
                Some(self.style.longest.map_or(length, |longest| longest.min(length)))
            }
        }
    }

    /// Replacement of an empty or hidden list.
    fn stands_for(&self, length: usize, element: &Element) -> Option<String> {
        if length == 0 {
            return Some("[]".into());
        }
        if !self.style.no_arrays {
            return None;
        }
        let name = match element {
            Element::Number { is_byte: true, .. } => "byte",
            Element::Number { kind, .. } => kind.name(),
            Element::Text(_) => "string",
            Element::WideText(_) => "wstring",
            Element::Struct(layout) => &layout.type_name,
        };
        let name = name.replace("/msg/", "/");
        Some(format!("'<array type: {name}[{length}]>'"))
    }

    fn rest(&mut self, is_cut: bool, depth: usize) {
        if is_cut {
            self.indent(depth);
            self.out.push_str("- '...'\n");
        }
    }

    fn numbers(&mut self, numbers: Numbers<'_>, element: &Element, depth: usize) {
        let Some(shown) = self.shown(numbers.len(), element) else { return };
        for number in (0..shown).filter_map(|index| numbers.get(index)) {
            self.indent(depth);
            self.out.push_str("- ");
            self.scalar(&Value::Number(number), element);
        }
        self.rest(shown < numbers.len(), depth);
    }

    fn list(&mut self, list: &[Value], element: &Element, depth: usize) {
        let Some(shown) = self.shown(list.len(), element) else { return };
        for value in &list[..shown] {
            self.indent(depth);
            self.out.push_str("- ");
            match (element, value) {
                (Element::Struct(layout), _) if layout.fields.is_empty() => {
                    self.out.push_str("{}\n");
                }
                (Element::Struct(layout), Value::Struct(values)) => {
                    self.mapping(layout, values, depth + 2, true);
                }
                _ => self.scalar(value, element),
            }
        }
        self.rest(shown < list.len(), depth);
    }

    /// Prints a number or a text, and ends the line.
    fn scalar(&mut self, value: &Value, element: &Element) {
        let text = self.scalar_text(value, element);
        self.out.push_str(&text);
        self.out.push('\n');
    }

    fn scalar_text(&self, value: &Value, element: &Element) -> String {
        match value {
            Value::Number(Number::U8(byte))
                if matches!(element, Element::Number { is_byte: true, .. }) =>
            {
                quoted(&char::from(*byte).to_string())
            }
            Value::Number(number) => number_text(*number),
            Value::Text(text) => self.text(text),
            _ => String::new(),
        }
    }

    fn text(&self, text: &str) -> String {
        if self.style.no_texts && !text.is_empty() {
            return format!("'<string length: <{}>>'", text.chars().count());
        }
        match self.style.longest.and_then(|longest| text.char_indices().nth(longest)) {
            Some((end, _)) => quoted(&format!("{}...", &text[..end])),
            None => quoted(text),
        }
    }
}

fn number_text(number: Number) -> String {
    match number {
        Number::Bool(number) => number.to_string(),
        Number::I8(number) => number.to_string(),
        Number::U8(number) => number.to_string(),
        Number::I16(number) => number.to_string(),
        Number::U16(number) => number.to_string(),
        Number::I32(number) => number.to_string(),
        Number::U32(number) => number.to_string(),
        Number::I64(number) => number.to_string(),
        Number::U64(number) => number.to_string(),
        // Python has only one float type, and prints all of its digits.
        Number::F32(number) => float_text(number.into()),
        Number::F64(number) => float_text(number),
    }
}

/// Formats like PyYAML's `represent_float`: Python's `repr`, but always with a point.
fn float_text(number: f64) -> String {
    if number.is_nan() {
        return ".nan".into();
    }
    if number.is_infinite() {
        return if number > 0.0 { ".inf".into() } else { "-.inf".into() };
    }
    let scientific = format!("{number:e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..16).contains(&exponent) {
        let fixed = number.to_string();
        return if fixed.contains('.') { fixed } else { format!("{fixed}.0") };
    }
    let point = if digits.contains('.') { "" } else { ".0" };
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{digits}{point}e{sign}{:02}", exponent.abs())
}

/// Quotes a text if YAML 1.1 would resolve it to another type.
fn quoted(text: &str) -> String {
    // Printable characters of PyYAML (`Emitter.analyze_scalar`).
    let printable = |c: char| match c {
        // Line and page breaks.
        '\u{85}' | '\u{2028}' | '\u{2029}' => false,
        ' '..='~' | '\u{a0}'..='\u{d7ff}' | '\u{10000}'.. => true,
        '\u{e000}'..='\u{fffd}' => c != '\u{feff}',
        _ => false,
    };
    if !text.chars().all(printable) {
        return double_quoted(text);
    }
    if is_plain(text) { text.into() } else { format!("'{}'", text.replace('\'', "''")) }
}

fn double_quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\0' => quoted.push_str("\\0"),
            '\u{7}' => quoted.push_str("\\a"),
            '\u{8}' => quoted.push_str("\\b"),
            '\t' => quoted.push_str("\\t"),
            '\n' => quoted.push_str("\\n"),
            '\u{b}' => quoted.push_str("\\v"),
            '\u{c}' => quoted.push_str("\\f"),
            '\r' => quoted.push_str("\\r"),
            '\u{1b}' => quoted.push_str("\\e"),
            '\u{85}' => quoted.push_str("\\N"),
            '\u{2028}' => quoted.push_str("\\L"),
            '\u{2029}' => quoted.push_str("\\P"),
            '\u{feff}' => quoted.push_str("\\uFEFF"),
            c if (c as u32) < 0x20 || (0x7f..0xa0).contains(&(c as u32)) => {
                quoted.push_str(&format!("\\x{:02X}", c as u32));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// Returns true if a text of printable characters needs no quotes.
fn is_plain(text: &str) -> bool {
    let Some(first) = text.chars().next() else { return false };
    let followed = |at: usize| text[at..].chars().nth(1).is_none_or(|next| next == ' ');
    let start = match first {
        '#' | ',' | '[' | ']' | '{' | '}' | '&' | '*' | '!' | '|' | '>' | '\'' | '"' | '%'
        | '@' | '`' | ' ' => false,
        '?' | ':' | '-' => !followed(0),
        _ => true,
    };
    let middle = text.char_indices().skip(1).all(|(at, character)| match character {
        ':' => !followed(at),
        '#' => !text[..at].ends_with(' '),
        _ => true,
    });
    let document = text.starts_with("---") || text.starts_with("...");
    start && middle && !text.ends_with(' ') && !document && !resolves(text)
}

/// Returns true if YAML 1.1, as resolved by PyYAML, would not read a text.
fn resolves(text: &str) -> bool {
    let lower = text.to_ascii_lowercase();
    let capital = |word: &str| -> String {
        let mut letters = word.chars();
        letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters).collect()
    };
    let is_cased = text == lower || text == text.to_ascii_uppercase() || text == capital(&lower);
    let word = ["yes", "no", "true", "false", "on", "off", "null"].contains(&lower.as_str());
    let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
    let all = |text: &str, test: fn(u8) -> bool| !text.is_empty() && text.bytes().all(test);
    let infinite = [".inf", ".Inf", ".INF"].contains(&unsigned);
    let nan = [".nan", ".NaN", ".NAN"].contains(&text);
    let integer = all(unsigned, |b| b.is_ascii_digit() || b == b'_') && !unsigned.starts_with('_')
        || unsigned
            .strip_prefix("0x")
            .is_some_and(|hex| all(hex, |b| b.is_ascii_hexdigit() || b == b'_'))
        || unsigned.strip_prefix("0b").is_some_and(|bits| all(bits, |b| b"01_".contains(&b)));
    // Numbers with a point, sexagesimal numbers, dates: slightly more than in PyYAML is quoted, which makes
    // no difference to a reader.
    let looks_numeric = unsigned.starts_with(|c: char| c.is_ascii_digit() || c == '.')
        && unsigned.bytes().any(|b| b.is_ascii_digit())
        && unsigned.bytes().all(|b| b.is_ascii_digit() || b".eE+-_:TtZ ".contains(&b));
    word && is_cased
        || matches!(text, "~" | "<<" | "=")
        || infinite
        || nan
        || integer
        || looks_numeric && unsigned.contains(['.', ':', '-'])
}
