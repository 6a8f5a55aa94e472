//! Numbers in the texts of a robot.

use std::collections::BTreeMap;
use std::path::PathBuf;

use periplus_diagnostics::{Diagnostics, FileId, Origin, SourceMap, Span, TextEdit, apply_edits};
use periplus_loader::LoadContext;
use periplus_xml::{Element, XmlNode, parse};

use super::document::location;

/// Significant digits of written numbers.
const DIGIT_COUNT: usize = 6;

/// Number in a text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Site {
    pub(super) path: PathBuf,
    pub(super) file: FileId,
    /// Bytes of the number.
    pub(super) start: u32,
    pub(super) end: u32,
    pub(super) value: f64,
    /// `FILE:LINE:COLUMN`.
    pub(super) location: String,
    /// True for a property, an argument's default, or a parameter of a macro: other numbers may depend on it.
    pub(super) is_indirect: bool,
    text: String,
}

impl Site {
    /// Text of the file with another number.
    pub(super) fn replaced(&self, value: f64, digit_count: usize) -> String {
        let (start, end) = (self.start as usize, self.end as usize);
        let number = number_text(value, digit_count);
        format!("{}{number}{}", &self.text[..start], &self.text[end..])
    }
}

/// Decimal text of a number with some significant digits.
pub(super) fn number_text(value: f64, digit_count: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let magnitude = libm::log10(value.abs()).floor() as i32 + 1;
    let places = usize::try_from(digit_count as i32 - magnitude).unwrap_or(0).min(12);
    let text = format!("{value:.places$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    };
    if text == "-0" { "0".to_owned() } else { text }
}

/// All numbers of the texts that were read, once each.
pub(super) fn all(sources: &SourceMap, context: &LoadContext<'_>) -> Vec<Site> {
    let mut sites = Vec::new();
    let mut seen: Vec<PathBuf> = Vec::new();
    for file in sources.files() {
        let source = sources.file(file);
        let path = context.working_folder.join(&source.name);
        let Some(path) = context.host.canonical(&path) else { continue };
        if seen.contains(&path) {
            continue;
        }
        seen.push(path.clone());
        let Some(document) = parse(file, sources, &mut Diagnostics::new()) else { continue };
        let mut collected = Vec::new();
        collect(&document.root, &mut collected);
        for (span, is_indirect) in collected {
            for (from, to, value) in numbers(sources.text(span)) {
                let span = span.part(from, to);
                sites.push(Site {
                    path: path.clone(),
                    file,
                    start: span.start,
                    end: span.end,
                    value,
                    location: location(span, sources),
                    is_indirect,
                    text: sources.text(sources.whole(file)).to_owned(),
                });
            }
        }
    }
    sites
}

/// Attributes and texts below an element; true for those of xacro's own elements.
fn collect(element: &Element, spans: &mut Vec<(Span, bool)>) {
    let is_xacro = element.prefix() == Some("xacro");
    let mut add = |origin: Origin| spans.extend(origin.0.map(|span| (span, is_xacro)));
    element.attributes.iter().for_each(|it| add(it.value_origin));
    for child in &element.children {
        if let XmlNode::Text(text) = child {
            add(text.origin);
        }
    }
    element.elements().for_each(|child| collect(child, spans));
}

/// Bytes and values of the words of a text that are numbers, also after `:=` or `=` as in the parameters of a macro.
fn numbers(text: &str) -> Vec<(usize, usize, f64)> {
    let mut found = Vec::new();
    let mut at = 0;
    for word in text.split_inclusive(char::is_whitespace) {
        let trimmed = word.trim_end();
        let offset = trimmed.rfind('=').map_or(0, |it| it + 1);
        if let Ok(value) = trimmed[offset..].parse::<f64>()
            && value.is_finite()
        {
            found.push((at + offset, at + trimmed.len(), value));
        }
        at += word.len();
    }
    found
}

/// Texts with edited numbers, before and after.
pub(super) fn edited(
    sites: &[Site],
    edits: &BTreeMap<usize, f64>,
    sources: &SourceMap,
) -> BTreeMap<PathBuf, (String, String)> {
    let mut by_path: BTreeMap<&PathBuf, (FileId, Vec<TextEdit>)> = BTreeMap::new();
    for (number, value) in edits {
        let site = &sites[*number];
        let (_, of_file) = by_path.entry(&site.path).or_insert_with(|| (site.file, Vec::new()));
        let range = site.start as usize..site.end as usize;
        of_file.push(TextEdit { range, text: number_text(*value, DIGIT_COUNT) });
    }
    let mut texts = BTreeMap::new();
    for (path, (file, of_file)) in by_path {
        let before = sources.text(sources.whole(file)).to_owned();
        // Sites are numbers of this text, each once.
        if let Some(after) = apply_edits(&before, of_file) {
            texts.insert(path.clone(), (before, after));
        }
    }
    texts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_six_digits_without_zeros_at_the_end() {
        let texts = [0.1, 0.123_456_78, -12.5, 1_234.567_8, 0.0, 1e-9, 3.0]
            .map(|it| number_text(it, DIGIT_COUNT));
        assert_eq!(texts, ["0.1", "0.123457", "-12.5", "1234.57", "0", "0.000000001", "3"]);
    }

    #[test]
    fn numbers_are_words() {
        assert_eq!(numbers("0 -1.5 ${x} 2"), [(0, 1, 0.0), (2, 6, -1.5), (12, 13, 2.0)]);
        assert_eq!(numbers("name radius:=0.1 *origin"), [(13, 16, 0.1)]);
        assert_eq!(numbers("\n 7\n"), [(2, 3, 7.0)]);
    }
}
