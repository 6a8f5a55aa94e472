//! Parser of interface texts.
//!
//! The rules are those of `rosidl_adapter`, except that a `#` inside of quotes does not begin a comment
//! here.

mod line;

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, SourceMap, Span};

use crate::{Definition, Interface, InterfaceKind, TypeName};

/// Maximum length of a text [bytes]. The longest in common use has 20 kB.
pub const MAX_TEXT_BYTES: usize = 1 << 20;

/// Dialect of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InterfaceDialect {
    /// ROS 1: `time`, `duration` and `Header` are built in, `byte` is a signed integer, without bounds and
    /// defaults.
    Ros1,
    /// ROS 2.
    Ros2,
}

/// Parses one text. Returns `None` if it cannot be used; then the findings contain at least one error.
pub fn parse(
    name: &TypeName,
    file: FileId,
    sources: &SourceMap,
    dialect: InterfaceDialect,
    diagnostics: &mut Diagnostics,
) -> Option<Interface> {
    part(name, sources.whole(file), sources, dialect, diagnostics)
}

/// Parses the text in a span, which may be one of many in a schema.
pub(crate) fn part(
    name: &TypeName,
    whole: Span,
    sources: &SourceMap,
    dialect: InterfaceDialect,
    diagnostics: &mut Diagnostics,
) -> Option<Interface> {
    let text = sources.text(whole);
    if text.len() > MAX_TEXT_BYTES {
        let message = format!("the definition of `{name}` is longer than {MAX_TEXT_BYTES} bytes");
        diagnostics.push(Diagnostic::error("text-too-long", message).at(whole.part(0, 0)));
        return None;
    }
    let mut found = Diagnostics::new();
    let suffixes: &[&str] = match name.kind {
        InterfaceKind::Message => &[],
        InterfaceKind::Service => &["Request", "Response"],
        InterfaceKind::Action => &["Goal", "Result", "Feedback"],
    };
    let mut names = suffixes.iter().map(|suffix| name.implied(suffix));
    let first = names.next().unwrap_or_else(|| name.clone());
    let mut reader = Reader::new(first, dialect, &mut found);
    let mut parts = Vec::new();
    let mut start = 0;
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let next = at + line.len();
        if line.trim_end() == "---" && !suffixes.is_empty() {
            let Some(name) = names.next() else {
                let message = format!(
                    "a `.{}` text has {} parts, and this line begins another",
                    name.kind.word(),
                    suffixes.len()
                );
                let span = whole.part(at, at + 3);
                reader.found.push(Diagnostic::error("too-many-parts", message).at(span));
                break;
            };
            parts.push(reader.finish(&text[start..at]));
            reader = Reader::new(name, dialect, &mut found);
            start = next;
        } else {
            reader.line(line.trim_end_matches(['\n', '\r']), whole.part(at, next));
        }
        at = next;
    }
    parts.push(reader.finish(&text[start.min(text.len())..]));
    if let Some(missing) = names.next() {
        let message = format!("`{missing}` is missing: the parts are separated by a line `---`");
        let end = whole.part(text.len(), text.len());
        found.push(Diagnostic::error("missing-part", message).at(end));
    }
    let usable = !found.has_errors();
    diagnostics.append(found);
    let doc = parts.first().map(|part| part.doc.clone()).unwrap_or_default();
    usable.then(|| Interface { name: name.clone(), doc, parts })
}

/// Reads the lines of one part.
struct Reader<'a> {
    definition: Definition,
    dialect: InterfaceDialect,
    found: &'a mut Diagnostics,
    /// Comments that belong to the next line, unless an empty line follows.
    comments: Vec<String>,
    /// Location of the first use of each name.
    names: std::collections::BTreeMap<String, Span>,
    /// Set if the last comment was next to a field or constant and may continue.
    beside: Option<Beside>,
}

#[derive(Clone, Copy)]
enum Beside {
    Field,
    Constant,
}

impl<'a> Reader<'a> {
    fn new(name: TypeName, dialect: InterfaceDialect, found: &'a mut Diagnostics) -> Self {
        let definition = Definition {
            name,
            fields: Vec::new(),
            constants: Vec::new(),
            doc: String::new(),
            text: String::new(),
        };
        let names = std::collections::BTreeMap::new();
        Self { definition, dialect, found, comments: Vec::new(), names, beside: None }
    }

    fn line(&mut self, line: &str, span: Span) {
        let (code, comment) = line::without_comment(line);
        if code.trim().is_empty() {
            match comment {
                None => self.blank(),
                Some(comment) if line.starts_with([' ', '\t']) && self.beside.is_some() => {
                    self.go_on(comment);
                }
                Some(comment) => self.comments.push(comment.into()),
            }
            return;
        }
        let mut doc = std::mem::take(&mut self.comments);
        doc.extend(comment.map(str::to_owned));
        self.beside = None;
        let context =
            line::Context { package: &self.definition.name.package, dialect: self.dialect, span };
        match line::read(code, &context) {
            Err(wrong) => self.found.push(*wrong),
            Ok((read, place)) => {
                let doc = doc.join("\n");
                let name = read.name().to_owned();
                if let Some(first) = self.names.get(&name) {
                    let wrong = format!("`{name}` is already defined");
                    let wrong = Diagnostic::error("duplicate-name", wrong).at(place);
                    self.found.push(wrong.related(*first, "first defined here"));
                    return;
                }
                self.names.insert(name, place);
                let has_comment = comment.is_some();
                match read {
                    line::Read::Field(mut field) => {
                        field.doc = doc;
                        self.definition.fields.push(field);
                        self.beside = has_comment.then_some(Beside::Field);
                    }
                    line::Read::Constant(mut constant) => {
                        constant.doc = doc;
                        self.definition.constants.push(constant);
                        self.beside = has_comment.then_some(Beside::Constant);
                    }
                }
            }
        }
    }

    /// An empty line ends a comment; the first comment describes the whole text.
    fn blank(&mut self) {
        let comments = std::mem::take(&mut self.comments);
        let is_first = self.definition.fields.is_empty() && self.definition.constants.is_empty();
        if is_first && self.definition.doc.is_empty() {
            self.definition.doc = comments.join("\n");
        }
        self.beside = None;
    }

    fn go_on(&mut self, comment: &str) {
        let doc = match self.beside {
            Some(Beside::Field) => self.definition.fields.last_mut().map(|field| &mut field.doc),
            Some(Beside::Constant) => self.definition.constants.last_mut().map(|one| &mut one.doc),
            None => None,
        };
        if let Some(doc) = doc {
            doc.push('\n');
            doc.push_str(comment);
        }
    }

    fn finish(mut self, text: &str) -> Definition {
        self.blank();
        // The counter of ROS 1 headers belongs to its serialization, not to the message.
        let name = &self.definition.name;
        let is_header = name.package == "std_msgs" && name.name == "Header";
        if self.dialect == InterfaceDialect::Ros1 && is_header {
            self.definition.fields.retain(|field| field.name != "seq");
        }
        self.definition.text = text.into();
        self.definition
    }
}
