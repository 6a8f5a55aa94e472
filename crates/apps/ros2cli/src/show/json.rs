//! JSON on one line, streamed without a tree, for point clouds of many megabytes.

use std::fmt::Write as _;

use periplus_msgs::{Count, Number, Numbers, Sink};

use super::{cut, shown, whole};

pub(super) struct Json {
    pub(super) out: String,
    longest: Option<usize>,
    /// Elements left to print of each open list; `None` for messages.
    open: Vec<Option<usize>>,
    /// Number of open levels inside an element that is not printed.
    hidden: usize,
}

impl Json {
    pub(super) fn new(longest: Option<usize>) -> Self {
        Self { out: String::new(), longest, open: Vec::new(), hidden: 0 }
    }

    /// Returns true if a value that begins now is printed; writes a comma before it.
    fn is_shown(&mut self) -> bool {
        if self.hidden > 0 {
            return false;
        }
        match self.open.last_mut() {
            Some(Some(0)) => return false,
            Some(Some(left)) => *left -= 1,
            _ => return true,
        }
        self.comma();
        true
    }

    fn comma(&mut self) {
        if !self.out.ends_with(['[', '{', ':']) && !self.out.is_empty() {
            self.out.push(',');
        }
    }

    fn put_text(&mut self, text: &str) {
        if !self.is_shown() {
            return;
        }
        let text = match cut(text, self.longest) {
            (text, false) => text.to_owned(),
            (text, true) => format!("{text}..."),
        };
        self.out.push_str(&serde_json::Value::String(text).to_string());
    }

    fn put_number(&mut self, number: Number) {
        let float = match number {
            Number::Bool(truth) => {
                let _ = write!(self.out, "{truth}");
                return;
            }
            Number::F32(number) => f64::from(number),
            Number::F64(number) => number,
            number => {
                let _ = write!(self.out, "{}", whole(number).unwrap_or(0));
                return;
            }
        };
        match serde_json::Number::from_f64(float) {
            Some(number) => {
                let _ = write!(self.out, "{number}");
            }
            None if float.is_nan() => self.out.push_str("\"NaN\""),
            None if float > 0.0 => self.out.push_str("\"Infinity\""),
            None => self.out.push_str("\"-Infinity\""),
        }
    }

    fn close(&mut self, is_shown: bool, end: &str) {
        self.open.pop();
        if is_shown {
            self.out.push_str(end);
        } else {
            self.hidden -= 1;
        }
    }
}

impl Sink for Json {
    fn begin(&mut self, _: &str) {
        if self.is_shown() {
            self.out.push('{');
        } else {
            self.hidden += 1;
        }
        self.open.push(None);
    }

    fn end(&mut self, _: bool) {
        self.close(self.hidden == 0, "}");
    }

    fn field(&mut self, name: &str) {
        if self.hidden == 0 {
            self.comma();
            let _ = write!(self.out, "\"{name}\":");
        }
    }

    fn number(&mut self, number: Number) {
        if self.is_shown() {
            self.put_number(number);
        }
    }

    fn text(&mut self, text: &str, _: Option<u32>) {
        self.put_text(text);
    }

    fn wide_text(&mut self, text: &str, _: Option<u32>) {
        self.put_text(text);
    }

    fn list(&mut self, length: usize, _: Count) {
        if self.is_shown() {
            self.out.push('[');
        } else {
            self.hidden += 1;
        }
        self.open.push(Some(shown(length, self.longest)));
    }

    fn end_list(&mut self) {
        self.close(self.hidden == 0, "]");
    }

    fn numbers(&mut self, numbers: Numbers<'_>) {
        if self.hidden > 0 {
            return;
        }
        let shown = shown(numbers.len(), self.longest);
        for number in (0..shown).filter_map(|index| numbers.get(index)) {
            self.comma();
            self.put_number(number);
        }
    }
}
