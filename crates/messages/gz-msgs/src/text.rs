//! Protobuf text: the format of `gz topic -e` and `gz topic -p`.
//!
//! Source: Protocol Buffers, "Text Format Language Specification".

use std::fmt::{self, Display, Write as _};
use std::str::FromStr;

use crate::message::Message;
use crate::{DecodeError, bare_name};

/// Maximum nesting depth of messages.
const MAX_DEPTH: u32 = 64;

/// Printer of a message, one field per line.
#[derive(Debug, Default)]
pub struct Printer {
    text: String,
    depth: usize,
}

impl Printer {
    pub(crate) fn into_text(self) -> String {
        self.text
    }

    fn indent(&mut self) {
        self.text.extend(std::iter::repeat_n("  ", self.depth));
    }

    pub(crate) fn value(&mut self, name: &str, value: &(impl Display + ?Sized)) {
        self.indent();
        // Rust prints `NaN`, protobuf `nan`; `inf` is the same.
        let mut shown = value.to_string();
        if shown == "NaN" {
            shown.make_ascii_lowercase();
        }
        let _ = writeln!(self.text, "{name}: {shown}");
    }

    pub(crate) fn quoted(&mut self, name: &str, bytes: &[u8]) {
        self.indent();
        let _ = write!(self.text, "{name}: \"");
        for &byte in bytes {
            match byte {
                b'\n' => self.text.push_str("\\n"),
                b'\r' => self.text.push_str("\\r"),
                b'\t' => self.text.push_str("\\t"),
                b'"' => self.text.push_str("\\\""),
                b'\'' => self.text.push_str("\\'"),
                b'\\' => self.text.push_str("\\\\"),
                b' '..=b'~' => self.text.push(char::from(byte)),
                _ => _ = write!(self.text, "\\{byte:03o}"),
            }
        }
        self.text.push_str("\"\n");
    }

    pub(crate) fn message(&mut self, name: &str, inside: impl FnOnce(&mut Self)) {
        self.indent();
        let _ = writeln!(self.text, "{name} {{");
        self.depth += 1;
        inside(self);
        self.depth -= 1;
        self.indent();
        self.text.push_str("}\n");
    }
}

/// Error of a text, with its location.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    /// Description of the fault, and the expected text.
    pub message: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
}

impl Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}: {}", self.line, self.column, self.message)
    }
}

impl std::error::Error for TextError {}

/// Parser of a text.
#[derive(Debug)]
pub struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: u32,
}

impl<'a> Parser<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self { text, at: 0, depth: 0 }
    }

    fn wrong(&self, message: impl Into<String>) -> TextError {
        let before = &self.text[..self.at];
        let line_start = before.rfind('\n').map_or(0, |place| place + 1);
        TextError {
            message: message.into(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }

    pub(crate) fn unknown(&self, name: &str, known: &[&str]) -> TextError {
        let known: Vec<&str> = known.iter().map(|name| name.trim_start_matches("r#")).collect();
        self.wrong(format!("unknown field `{name}`; known fields: {}", known.join(", ")))
    }

    /// Skips spaces and comments; returns the next character.
    fn peek(&mut self) -> Option<char> {
        loop {
            let rest = &self.text[self.at..];
            let next = rest.chars().next()?;
            if next == '#' {
                self.at += rest.find('\n').unwrap_or(rest.len());
            } else if next.is_whitespace() {
                self.at += next.len_utf8();
            } else {
                return Some(next);
            }
        }
    }

    fn take(&mut self, wanted: char) -> bool {
        let is_there = self.peek() == Some(wanted);
        if is_there {
            self.at += wanted.len_utf8();
        }
        is_there
    }

    /// Name or number.
    fn word(&mut self) -> Result<&'a str, TextError> {
        self.peek();
        let rest = &self.text[self.at..];
        let is_part = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '-' | '+');
        let length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        if length == 0 {
            return Err(self.wrong("a name or a value should be here"));
        }
        self.at += length;
        Ok(&rest[..length])
    }

    fn fields(
        &mut self,
        end: Option<char>,
        mut field: impl FnMut(&str, &mut Self) -> Result<(), TextError>,
    ) -> Result<(), TextError> {
        loop {
            match (self.peek(), end) {
                (None, None) => return Ok(()),
                (None, Some(end)) => return Err(self.wrong(format!("`{end}` is missing"))),
                (Some(next), Some(end)) if next == end => {
                    self.at += end.len_utf8();
                    return Ok(());
                }
                _ => {}
            }
            let name = self.word()?;
            field(name, self)?;
            if !self.take(',') {
                self.take(';');
            }
        }
    }

    pub(crate) fn whole(
        &mut self,
        field: impl FnMut(&str, &mut Self) -> Result<(), TextError>,
    ) -> Result<(), TextError> {
        self.fields(None, field)
    }

    pub(crate) fn message(
        &mut self,
        field: impl FnMut(&str, &mut Self) -> Result<(), TextError>,
    ) -> Result<(), TextError> {
        self.take(':');
        let end = if self.take('{') {
            '}'
        } else if self.take('<') {
            '>'
        } else {
            return Err(self.wrong("a message should be here, in `{ }`"));
        };
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(self.wrong("messages are nested too deeply"));
        }
        self.fields(Some(end), field)?;
        self.depth -= 1;
        Ok(())
    }

    /// One value, or several in `[ ]`.
    pub(crate) fn list(
        &mut self,
        mut one: impl FnMut(&mut Self) -> Result<(), TextError>,
    ) -> Result<(), TextError> {
        let before = self.at;
        self.take(':');
        if !self.take('[') {
            self.at = before;
            return one(self);
        }
        while !self.take(']') {
            one(self)?;
            if !self.take(',') && self.peek() != Some(']') {
                return Err(self.wrong("`,` or `]` should be here"));
            }
        }
        Ok(())
    }

    pub(crate) fn number<T: FromStr>(&mut self) -> Result<T, TextError> {
        self.take(':');
        let word = self.word()?;
        let suffixed = word.strip_suffix(['f', 'F']);
        let value = word.parse().ok().or_else(|| suffixed.and_then(|word| word.parse().ok()));
        value.ok_or_else(|| self.wrong(format!("`{word}` is not a number that the field can hold")))
    }

    pub(crate) fn boolean(&mut self) -> Result<bool, TextError> {
        self.take(':');
        match self.word()? {
            "true" | "True" | "t" | "1" => Ok(true),
            "false" | "False" | "f" | "0" => Ok(false),
            word => Err(self.wrong(format!("`{word}` is neither `true` nor `false`"))),
        }
    }

    pub(crate) fn kind(&mut self, kinds: &[(&str, i32)]) -> Result<i32, TextError> {
        self.take(':');
        let word = self.word()?;
        let named = kinds.iter().find(|(name, _)| *name == word).map(|(_, number)| *number);
        named.or_else(|| word.parse().ok()).ok_or_else(|| {
            let known: Vec<&str> = kinds.iter().map(|(name, _)| *name).collect();
            self.wrong(format!("`{word}` is none of {}", known.join(", ")))
        })
    }

    /// Quoted strings; adjacent ones are concatenated.
    pub(crate) fn string(&mut self) -> Result<Vec<u8>, TextError> {
        self.take(':');
        let mut bytes = Vec::new();
        let mut is_any = false;
        while let Some(quote @ ('"' | '\'')) = self.peek() {
            is_any = true;
            self.at += 1;
            self.quoted(quote, &mut bytes)?;
        }
        if is_any { Ok(bytes) } else { Err(self.wrong("a text in quotes should be here")) }
    }

    fn quoted(&mut self, quote: char, bytes: &mut Vec<u8>) -> Result<(), TextError> {
        loop {
            let Some(next) = self.text[self.at..].chars().next() else {
                return Err(self.wrong(format!("the text has no {quote} at its end")));
            };
            self.at += next.len_utf8();
            if next == quote {
                return Ok(());
            }
            if next == '\\' {
                self.escape(bytes)?;
            } else {
                bytes.extend_from_slice(next.encode_utf8(&mut [0; 4]).as_bytes());
            }
        }
    }

    fn escape(&mut self, bytes: &mut Vec<u8>) -> Result<(), TextError> {
        let rest = &self.text[self.at..];
        let digits = |rest: &'a str, most: usize, radix: u32| {
            let is_digit = |c: &char| c.is_digit(radix);
            let length = rest.chars().take(most).take_while(is_digit).count();
            (u8::from_str_radix(&rest[..length], radix).ok(), length)
        };
        let (byte, length) = match rest.chars().next() {
            Some('n') => (Some(b'\n'), 1),
            Some('r') => (Some(b'\r'), 1),
            Some('t') => (Some(b'\t'), 1),
            Some(c @ ('"' | '\'' | '\\' | '?')) => (u8::try_from(c).ok(), 1),
            Some('x' | 'X') => {
                let (byte, length) = digits(&rest[1..], 2, 16);
                (byte, length + 1)
            }
            Some('0'..='7') => digits(rest, 3, 8),
            _ => (None, 0),
        };
        let byte =
            byte.ok_or_else(|| self.wrong("no such escape; write `\\\\` for a backslash"))?;
        bytes.push(byte);
        self.at += length;
        Ok(())
    }
}

/// Text of a message whose type is known by name only; `None` if the type is unknown.
#[must_use]
pub fn text_of(type_name: &str, bytes: &[u8]) -> Option<Result<String, DecodeError>> {
    struct Text<'a> {
        name: &'a str,
        bytes: &'a [u8],
        found: Option<Result<String, DecodeError>>,
    }
    impl crate::messages::Each for Text<'_> {
        fn message<M: Message>(&mut self) {
            if M::NAME == self.name {
                self.found = Some(M::decode(self.bytes).map(|message| message.text()));
            }
        }
    }
    let name = bare_name(type_name)?;
    if name == "IMU" && crate::Dialect::of(type_name) == Some(crate::Dialect::Ignition) {
        return Some(crate::ImuFortress::decode(bytes).map(|message| message.text()));
    }
    let mut text = Text { name, bytes, found: None };
    crate::messages::each(&mut text);
    text.found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Header, Image, LaserScan, Map, PixelFormat, StringMsg, Time, Twist};

    #[test]
    fn text_has_one_field_per_line_and_is_read_back() {
        let header = Header {
            stamp: Some(Time { sec: 3, nsec: 5 }),
            data: vec![Map { key: "frame_id".into(), value: vec!["a\n\"b\"".into()] }],
        };
        let scan = LaserScan {
            header: Some(header),
            ranges: vec![0.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN],
            ..LaserScan::default()
        };
        let text = scan.text();
        assert_eq!(
            text,
            "header {\n  stamp {\n    sec: 3\n    nsec: 5\n  }\n  data {\n    key: \"frame_id\"\n    \
             value: \"a\\n\\\"b\\\"\"\n  }\n}\nranges: 0.5\nranges: inf\nranges: -inf\nranges: nan\n"
        );
        let read = LaserScan::from_text(&text).expect("its own text");
        assert_eq!(read.header, scan.header);
        assert_eq!(read.ranges[..3], scan.ranges[..3]);
        assert!(read.ranges[3].is_nan());
    }

    #[test]
    fn text_as_typed_for_gz_topic_is_read() {
        let text = "linear: {x: 1.0, y: -2}, angular {z: 0.5f} # turn";
        let twist = Twist::from_text(text).expect("a twist");
        assert_eq!(twist.linear.map(|it| (it.x, it.y)), Some((1.0, -2.0)));
        assert_eq!(twist.angular.map(|it| it.z), Some(0.5));
        let scan = LaserScan::from_text("ranges: [1, 2.5, inf] ranges: 4").expect("a scan");
        assert_eq!(scan.ranges, [1.0, 2.5, f64::INFINITY, 4.0]);
        let text = StringMsg::from_text("data: 'it\\'s ' \"so\\x21\\041\"").expect("a text");
        assert_eq!(text.data, "it's so!!");
        let image = Image::from_text("pixel_format_type: RGB_INT8 width: 3").expect("an image");
        assert_eq!(image.pixel_format_type, PixelFormat::RGB_INT8);
    }

    #[track_caller]
    fn check_wrong(text: &str, line: usize, column: usize, part: &str) {
        let error = Twist::from_text(text).expect_err("it is wrong");
        assert!(error.message.contains(part), "{error}");
        assert_eq!((error.line, error.column), (line, column), "{error}");
    }

    #[test]
    fn slips_are_told_with_their_places() {
        check_wrong("linaer {x: 1}", 1, 7, "unknown field `linaer`; known fields: header, linear");
        check_wrong("linear {\n  x: fast }", 2, 10, "`fast` is not a number");
        check_wrong("linear {x: 1", 1, 13, "`}` is missing");
        check_wrong("linear: 3", 1, 9, "a message should be here");
        check_wrong("linear {header {data {key: '", 1, 29, "no ' at its end");
    }

    #[test]
    fn types_are_found_by_any_of_their_names() {
        let bytes = StringMsg { data: "x".into(), ..StringMsg::default() }.encode();
        for name in ["gz.msgs.StringMsg", "ignition.msgs.StringMsg"] {
            assert_eq!(text_of(name, &bytes), Some(Ok("data: \"x\"\n".into())));
        }
        assert_eq!(text_of("gz.msgs.Unheard", &bytes), None);
    }
}
