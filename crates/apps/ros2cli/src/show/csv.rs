//! All values on one line, separated by commas.

use periplus_msgs::{Count, Number, Numbers, Sink, YamlStyle};

use super::{cut, python, shown};

pub(super) struct Csv<'a> {
    /// The whole, and the columns of each open message and list.
    open: Vec<String>,
    style: &'a YamlStyle,
    /// For each open list: the number of elements left to print, and true if it is truncated.
    lists: Vec<(usize, bool)>,
    /// Depth inside elements that are not printed.
    hidden: usize,
    /// Depth of messages in elements of the innermost list.
    depth: Vec<usize>,
}

impl<'a> Csv<'a> {
    pub(super) fn new(style: &'a YamlStyle) -> Self {
        let (lists, depth) = (Vec::new(), vec![0]);
        Self { open: vec![String::new()], style, lists, hidden: 0, depth }
    }

    /// All columns.
    pub(super) fn finish(self) -> String {
        self.open.concat()
    }

    /// Adds a column. As in `rosidl_runtime_py`, a comma follows non-empty text, so an empty list
    /// is an empty column.
    fn put(&mut self, text: &str) {
        if let Some(columns) = self.open.last_mut() {
            if !columns.is_empty() {
                columns.push(',');
            }
            columns.push_str(text);
        }
    }

    fn close(&mut self) {
        if let Some(columns) = self.open.pop() {
            self.put(&columns);
        }
    }

    /// Returns true if an element that begins now is printed.
    fn element(&mut self) -> bool {
        if self.hidden > 0 || self.depth.last() != Some(&0) {
            return self.hidden == 0;
        }
        match self.lists.last_mut() {
            Some((0, _)) => false,
            Some((left, _)) => {
                *left -= 1;
                true
            }
            None => true,
        }
    }

    fn put_text(&mut self, text: &str) {
        if !self.element() {
            return;
        }
        if self.style.no_texts {
            self.put(&format!("<string length: <{}>>", text.chars().count()));
            return;
        }
        match cut(text, self.style.longest) {
            (text, false) => self.put(text),
            (text, true) => self.put(&format!("{text}...")),
        }
    }
}

impl Sink for Csv<'_> {
    fn begin(&mut self, _: &str) {
        if self.element() {
            self.open.push(String::new());
        } else {
            self.hidden += 1;
        }
        if let Some(depth) = self.depth.last_mut() {
            *depth += 1;
        }
    }

    fn end(&mut self, _: bool) {
        if let Some(depth) = self.depth.last_mut() {
            *depth -= 1;
        }
        if self.hidden > 0 {
            self.hidden -= 1;
        } else {
            self.close();
        }
    }

    fn field(&mut self, _: &str) {}

    fn number(&mut self, number: Number) {
        if self.element() {
            self.put(&python::number(number));
        }
    }

    fn text(&mut self, text: &str, _: Option<u32>) {
        self.put_text(text);
    }

    fn wide_text(&mut self, text: &str, _: Option<u32>) {
        self.put_text(text);
    }

    fn list(&mut self, length: usize, _: Count) {
        self.open.push(String::new());
        let mut shown = shown(length, self.style.longest);
        if self.hidden > 0 {
            shown = 0;
        } else if self.style.no_arrays && length > 0 {
            self.put(&format!("<array length: <{length}>>"));
            shown = 0;
        }
        let is_cut = shown < length && !self.style.no_arrays && self.hidden == 0;
        self.lists.push((shown, is_cut));
        self.depth.push(0);
    }

    fn end_list(&mut self) {
        self.depth.pop();
        if let Some((_, true)) = self.lists.pop() {
            self.put("...");
        }
        if self.hidden > 0 {
            self.open.pop();
        } else {
            self.close();
        }
    }

    fn numbers(&mut self, numbers: Numbers<'_>) {
        let shown = self.lists.last().map_or(0, |(shown, _)| *shown);
        for number in (0..shown).filter_map(|index| numbers.get(index)) {
            self.put(&python::number(number));
        }
    }
}
