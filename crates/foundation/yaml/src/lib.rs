//! YAML trees with source locations.
//!
//! The caller determines the type of a scalar: `1e5` is a number for [`YamlNode::number`] and a text for
//! [`YamlNode::text`]. Anchors and aliases are supported; merge keys (`<<`) are not and are ordinary names.
//!
//! ```
//! use periplus_diagnostics::SourceMap;
//!
//! let mut sources = SourceMap::new();
//! let file = sources.add("nav2.yaml", "amcl:\n  max_particles: 2000\n");
//! let tree = periplus_yaml::parse(file, &sources).expect("YAML").expect("a value");
//! let value = tree.get("amcl").and_then(|amcl| amcl.get("max_particles")).expect("a parameter");
//! assert_eq!(value.integer(), Some(2000));
//! assert_eq!(sources.locate(value.span).1.line, 2);
//! ```

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, FileId, SourceMap, Span};
use saphyr_parser::{Event, Marker, Parser, ScalarStyle, StrInput};

/// Maximum nesting depth of lists and mappings.
const MAX_DEPTH: usize = 60;

/// Maximum number of values in a file; each use of an alias counts.
const MAX_VALUES: usize = 1_000_000;

/// Value with its source location.
#[derive(Clone, Debug, PartialEq)]
pub struct YamlNode {
    /// Source location.
    pub span: Span,
    /// Value.
    pub value: YamlValue,
    /// True for a scalar with the tag `!!binary`: its text is base64, in which line breaks are ignored.
    pub is_binary: bool,
}

/// YAML value.
#[derive(Clone, Debug, PartialEq)]
pub enum YamlValue {
    /// Text, number, boolean or null, as written.
    Scalar {
        /// Text without quotes.
        text: String,
        /// True if it is written without quotes.
        is_plain: bool,
    },
    /// A list.
    List(Vec<YamlNode>),
    /// Names and values, in file order. A name may occur twice.
    Map(Vec<(YamlNode, YamlNode)>),
}

impl YamlNode {
    /// Text of a scalar.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match &self.value {
            YamlValue::Scalar { text, .. } => Some(text),
            _ => None,
        }
    }

    fn plain(&self) -> Option<&str> {
        match &self.value {
            YamlValue::Scalar { text, is_plain: true } => Some(text),
            _ => None,
        }
    }

    /// Returns true for null: an empty value, `~` or `null`.
    #[must_use]
    pub fn is_null(&self) -> bool {
        self.plain().is_some_and(|text| matches!(text, "" | "~" | "null" | "Null" | "NULL"))
    }

    /// Decimal number without quotes. `.inf` and `.nan` are not accepted.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        let text = self.plain()?;
        // Rust accepts "inf" and "nan" too, which are texts in YAML.
        let is_number = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
        text.parse().ok().filter(|number: &f64| is_number && number.is_finite())
    }

    /// Decimal integer without quotes.
    #[must_use]
    pub fn integer(&self) -> Option<i64> {
        self.plain()?.parse().ok()
    }

    /// Boolean, by the names of YAML 1.1.
    #[must_use]
    pub fn truth(&self) -> Option<bool> {
        match self.plain()?.to_ascii_lowercase().as_str() {
            "true" | "yes" | "on" => Some(true),
            "false" | "no" | "off" => Some(false),
            _ => None,
        }
    }

    /// Elements of a list.
    #[must_use]
    pub fn list(&self) -> Option<&[YamlNode]> {
        match &self.value {
            YamlValue::List(list) => Some(list),
            _ => None,
        }
    }

    /// Names and values of a mapping.
    #[must_use]
    pub fn entries(&self) -> Option<&[(YamlNode, YamlNode)]> {
        match &self.value {
            YamlValue::Map(entries) => Some(entries),
            _ => None,
        }
    }

    /// First value of a name in a mapping.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&YamlNode> {
        self.entries()?.iter().find(|(key, _)| key.text() == Some(name)).map(|(_, value)| value)
    }

    /// Type of the value, in words for messages.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match &self.value {
            YamlValue::Scalar { .. } if self.is_null() => "nothing",
            YamlValue::Scalar { .. } if self.number().is_some() => "a number",
            YamlValue::Scalar { .. } if self.truth().is_some() => "a truth value",
            YamlValue::Scalar { .. } => "a text",
            YamlValue::List(_) => "a list",
            YamlValue::Map(_) => "a mapping",
        }
    }
}

/// Parses the first document of a text; `None` if it is empty.
///
/// # Errors
/// If the text is not YAML.
pub fn parse(file: FileId, sources: &SourceMap) -> Result<Option<YamlNode>, Box<Diagnostic>> {
    let whole = sources.whole(file);
    let text = sources.text(whole);
    let mut reader = Reader {
        parser: Parser::new_from_str(text),
        text,
        whole,
        at: (0, 0),
        anchors: BTreeMap::new(),
        values: 0,
    };
    loop {
        match reader.next()? {
            (Event::DocumentStart(_), _) => {
                let (event, span) = reader.next()?;
                return reader.node(event, span, 0).map(Some);
            }
            (Event::StreamEnd, _) => return Ok(None),
            _ => {}
        }
    }
}

struct Reader<'t> {
    parser: Parser<'t, StrInput<'t>>,
    text: &'t str,
    whole: Span,
    /// Position in characters and in bytes.
    at: (usize, usize),
    anchors: BTreeMap<usize, (YamlNode, usize)>,
    values: usize,
}

impl<'t> Reader<'t> {
    /// Byte offset of a marker, which counts characters. Markers hardly ever go back, so this is linear in
    /// the text.
    fn byte(&mut self, marker: &Marker) -> usize {
        let (mut index, mut byte) = self.at;
        while index < marker.index() {
            let Some(character) = self.text[byte..].chars().next() else { break };
            (index, byte) = (index + 1, byte + character.len_utf8());
        }
        while index > marker.index() {
            let Some(character) = self.text[..byte].chars().next_back() else { break };
            (index, byte) = (index - 1, byte - character.len_utf8());
        }
        self.at = (index, byte);
        byte
    }

    fn next(&mut self) -> Result<(Event<'t>, Span), Box<Diagnostic>> {
        match self.parser.next_event() {
            Some(Ok((event, span))) => {
                let start = self.byte(&span.start);
                let end = self.byte(&span.end);
                Ok((event, self.whole.part(start, end)))
            }
            Some(Err(error)) => {
                let at = self.byte(error.marker());
                let wrong = format!("this is not YAML: {}", error.info());
                Err(bad(&wrong, self.whole.part(at, at + 1)))
            }
            None => Ok((Event::StreamEnd, self.whole)),
        }
    }

    fn node(
        &mut self,
        event: Event<'t>,
        span: Span,
        depth: usize,
    ) -> Result<YamlNode, Box<Diagnostic>> {
        let fail = |message: &str| Err(bad(message, span));
        self.values += 1;
        if depth > MAX_DEPTH || self.values > MAX_VALUES {
            return fail("the file is nested too deeply or too large");
        }
        let before = self.values;
        let mut is_binary = false;
        let (value, anchor, span) = match event {
            Event::Scalar(text, style, anchor, tag) => {
                is_binary =
                    tag.is_some_and(|tag| tag.is_yaml_core_schema() && tag.suffix == "binary");
                let is_plain = style == ScalarStyle::Plain;
                (YamlValue::Scalar { text: text.into_owned(), is_plain }, anchor, span)
            }
            Event::SequenceStart(anchor, _) => {
                let mut items = Vec::new();
                let end = loop {
                    match self.next()? {
                        (Event::SequenceEnd, end) => break end,
                        (event, span) => items.push(self.node(event, span, depth + 1)?),
                    }
                };
                (YamlValue::List(items), anchor, around(span, end))
            }
            Event::MappingStart(anchor, _) => {
                let mut entries = Vec::new();
                let end = loop {
                    match self.next()? {
                        (Event::MappingEnd, end) => break end,
                        (event, span) => {
                            let key = self.node(event, span, depth + 1)?;
                            let (event, span) = self.next()?;
                            entries.push((key, self.node(event, span, depth + 1)?));
                        }
                    }
                };
                (YamlValue::Map(entries), anchor, around(span, end))
            }
            Event::Alias(anchor) => {
                let Some((node, size)) = self.anchors.get(&anchor).cloned() else {
                    return fail("an alias names an anchor that is still open");
                };
                // The value is counted at each use.
                self.values += size;
                return Ok(YamlNode { span, ..node });
            }
            _ => return fail("a value is missing here"),
        };
        let node = YamlNode { span, value, is_binary };
        if anchor != 0 {
            self.anchors.insert(anchor, (node.clone(), 1 + self.values - before));
        }
        Ok(node)
    }
}

fn bad(message: &str, span: Span) -> Box<Diagnostic> {
    Box::new(Diagnostic::error("bad-yaml", message).at(span))
}

fn around(start: Span, end: Span) -> Span {
    Span { end: end.end.max(start.end), ..start }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn read(text: &str) -> (SourceMap, Result<Option<YamlNode>, Box<Diagnostic>>) {
        let mut sources = SourceMap::new();
        let file = sources.add("a.yaml", text);
        let node = parse(file, &sources);
        (sources, node)
    }

    #[test]
    fn every_node_knows_its_place() {
        let (sources, node) = read("- {at: 0.5, ü: [1, two]}\n- 'é': \"x\"\n");
        let node = node.unwrap().unwrap();
        let list = node.list().unwrap();
        let shown = |node: &YamlNode| sources.text(node.span).to_owned();
        assert_eq!(shown(list[0].get("at").unwrap()), "0.5");
        assert_eq!(shown(list[0].get("ü").unwrap()), "[1, two]");
        assert_eq!(shown(&list[0]), "{at: 0.5, ü: [1, two]}");
        assert_eq!(shown(list[1].get("é").unwrap()), "\"x\"");
        assert_eq!(list[0].get("at").unwrap().number(), Some(0.5));
        assert_eq!(sources.locate(list[1].get("é").unwrap().span).1.line, 2);
    }

    #[test]
    fn scalars_are_what_they_are_asked_for() {
        let (_, node) = read("[1e5, .inf, '1', yes, ~, nan, -3]");
        let node = node.unwrap().unwrap();
        let list = node.list().unwrap();
        let numbers: Vec<_> = list.iter().map(YamlNode::number).collect();
        assert_eq!(numbers, [Some(1e5), None, None, None, None, None, Some(-3.0)]);
        let kinds: Vec<_> = list.iter().map(YamlNode::kind).collect();
        let text = "a text";
        assert_eq!(kinds, ["a number", text, text, "a truth value", "nothing", text, "a number"]);
        assert_eq!(list[3].truth(), Some(true));
        assert_eq!(list[6].integer(), Some(-3));
    }

    #[test]
    fn binary_scalars_are_known_by_their_tag() {
        let (_, node) = read("[!!binary AQ==, !!binary |\n AQ==\n, AQ==, !!str AQ==]");
        let node = node.unwrap().unwrap();
        let are_binary: Vec<bool> = node.list().unwrap().iter().map(|one| one.is_binary).collect();
        assert_eq!(are_binary, [true, true, false, false]);
    }

    #[test]
    fn mistakes_have_a_place() {
        let (sources, node) = read("a: 1\nb: [1, 2\n");
        let wrong = node.unwrap_err();
        assert!(sources.locate(wrong.span.unwrap()).1.line >= 2, "{wrong:?}");
        assert_eq!(read("").1, Ok(None));
        assert_eq!(read("# nothing\n").1, Ok(None));
    }

    #[test]
    fn an_alias_bomb_is_refused() {
        let mut text = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
        for level in 1..12 {
            let before = level - 1;
            text += &format!("a{level}: &a{level} [{}]\n", format!("*a{before}, ").repeat(10));
        }
        assert!(read(&text).1.unwrap_err().message.contains("too large"));
    }

    proptest! {
        #[test]
        fn no_text_is_too_strange(text in "[a-z0-9:{}\\[\\], &*!'\"#\n\r\té|>-]{0,60}") {
            if let (sources, Ok(Some(node))) = read(&text) {
                prop_assert!(node.span.end as usize <= text.len());
                let _ = sources.text(node.span);
            }
        }
    }
}
