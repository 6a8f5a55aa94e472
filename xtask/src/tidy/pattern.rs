//! Patterns of words: `so many|much`, `^ who`, `!<person> who`.
//!
//! | element | matches |
//! |---|---|
//! | `word` | this word, in any case |
//! | `a\|b` | one of these words |
//! | `<name>` | one of the words of a class of the data file; allowed among `a\|b` |
//! | `!...` | any atom except these words, also the end of a sentence; context, no part of the finding |
//! | `=...` | these words, as context, no part of the finding |
//! | `_`, `=_` | any word or piece of code; the second is context |
//! | `CODE` | a piece of code or a placeholder |
//! | `^`, `$` | start of a sentence, its end |
//! | `,` `;` `:` `(` `)` | this mark |

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use super::prose::{Atom, Part};

/// Number of a word that patterns name; see [`Words`].
pub(crate) type WordId = u32;

const OTHER: WordId = 0;
const STOP: WordId = 1;
const CODE: WordId = 2;
const COMMA: WordId = 3;
const SEMICOLON: WordId = 4;
const COLON: WordId = 5;
const OPEN: WordId = 6;
const CLOSE: WordId = 7;
const MARK: WordId = 8;
const FIRST_WORD: WordId = 9;

/// Words that patterns name. All others are one to them.
#[derive(Debug, Default)]
pub(crate) struct Words {
    ids: HashMap<String, WordId>,
}

impl Words {
    fn intern(&mut self, word: &str) -> WordId {
        let next =
            FIRST_WORD + WordId::try_from(self.ids.len()).unwrap_or(WordId::MAX - FIRST_WORD);
        *self.ids.entry(word.to_lowercase()).or_insert(next)
    }

    /// Numbers of the atoms of a text.
    pub(crate) fn number(&self, text: &str, atoms: &[Atom], ids: &mut Vec<WordId>) {
        ids.clear();
        let mut lower = String::new();
        ids.extend(atoms.iter().map(|atom| match atom.part {
            Part::Stop => STOP,
            Part::Code => CODE,
            Part::Mark(',') => COMMA,
            Part::Mark(';') => SEMICOLON,
            Part::Mark(':') => COLON,
            Part::Mark('(') => OPEN,
            Part::Mark(')') => CLOSE,
            Part::Mark(_) => MARK,
            Part::Word => {
                lower.clear();
                lower.push_str(&text[atom.range.clone()]);
                lower.make_ascii_lowercase();
                let lower = lower.strip_suffix("'s").unwrap_or(&lower);
                self.ids.get(lower).copied().unwrap_or(OTHER)
            }
        }));
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Test {
    OneOf(Vec<WordId>),
    NoneOf(Vec<WordId>),
    /// A word or a piece of code.
    Word,
    Start,
    End,
}

#[derive(Clone, Debug)]
struct Element {
    test: Test,
    is_context: bool,
}

/// Sequence of words that one atom each must match.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    pub(crate) text: String,
    elements: Vec<Element>,
    /// Index of the element with the fewest words; a text is searched for these.
    anchor: usize,
}

impl Pattern {
    /// Reads a pattern.
    ///
    /// # Errors
    /// A class that is not defined, or no element that names a word.
    pub(crate) fn parse(
        text: &str,
        classes: &BTreeMap<String, Vec<String>>,
        words: &mut Words,
    ) -> Result<Self, String> {
        let elements: Vec<Element> = text
            .split_whitespace()
            .map(|element| parse_element(element, classes, words))
            .collect::<Result<_, String>>()?;
        let size = |element: &Element| match &element.test {
            Test::OneOf(ids) if !element.is_context => ids.len(),
            Test::OneOf(ids) => 1000 + ids.len(),
            _ => usize::MAX,
        };
        let anchor = (0..elements.len()).min_by_key(|&at| size(&elements[at]));
        match anchor {
            Some(anchor) if size(&elements[anchor]) < usize::MAX => {
                Ok(Self { text: text.to_owned(), elements, anchor })
            }
            _ => Err(format!("the pattern `{text}` names no word; write at least one")),
        }
    }

    /// Words by which a text is searched for this pattern.
    pub(crate) fn anchors(&self) -> &[WordId] {
        match &self.elements[self.anchor].test {
            Test::OneOf(ids) => ids,
            _ => &[],
        }
    }

    /// Range of the matched words without context, where the anchor is at an index.
    pub(crate) fn match_at(&self, ids: &[WordId], anchor_at: usize) -> Option<Range<usize>> {
        let id = |index: Option<usize>| index.and_then(|at| ids.get(at)).copied().unwrap_or(STOP);
        let index = |at: usize| (anchor_at + at).checked_sub(self.anchor);
        let is_match = |(at, element): (usize, &Element)| {
            let id = id(index(at));
            match &element.test {
                Test::OneOf(wanted) => wanted.contains(&id),
                Test::NoneOf(unwanted) => !unwanted.contains(&id),
                Test::Word => id == OTHER || id == CODE || id >= FIRST_WORD,
                Test::Start => matches!(id, STOP | COLON),
                Test::End => matches!(id, STOP | SEMICOLON),
            }
        };
        if !self.elements.iter().enumerate().all(is_match) {
            return None;
        }
        let core = |element: &Element| !element.is_context;
        let first = self.elements.iter().position(core)?;
        let last = self.elements.iter().rposition(core)?;
        Some(index(first)?..index(last)? + 1)
    }
}

fn parse_element(
    text: &str,
    classes: &BTreeMap<String, Vec<String>>,
    words: &mut Words,
) -> Result<Element, String> {
    let context = |test| Ok(Element { test, is_context: true });
    match text {
        "^" => return context(Test::Start),
        "$" => return context(Test::End),
        "_" => return Ok(Element { test: Test::Word, is_context: false }),
        "=_" => return context(Test::Word),
        _ => {}
    }
    let list = text.trim_start_matches(['!', '=']);
    let mut ids = Vec::new();
    for word in list.split('|') {
        match word {
            "CODE" => ids.push(CODE),
            "," => ids.push(COMMA),
            ";" => ids.push(SEMICOLON),
            ":" => ids.push(COLON),
            "(" => ids.push(OPEN),
            ")" => ids.push(CLOSE),
            "." => ids.push(STOP),
            _ => match word.strip_prefix('<').and_then(|word| word.strip_suffix('>')) {
                Some(name) => {
                    let class = classes.get(name).ok_or_else(|| {
                        let known: Vec<&str> = classes.keys().map(String::as_str).collect();
                        format!(
                            "the class <{name}> is not defined; known are: {}",
                            known.join(", ")
                        )
                    })?;
                    ids.extend(class.iter().map(|word| words.intern(word)));
                }
                None => ids.push(words.intern(word)),
            },
        }
    }
    if text.starts_with('!') {
        return context(Test::NoneOf(ids));
    }
    Ok(Element { test: Test::OneOf(ids), is_context: text.starts_with('=') })
}

#[cfg(test)]
mod tests {
    use super::super::prose::{Passage, Source, atoms};
    use super::*;

    /// Words that a pattern finds in a text, each finding in brackets.
    fn found(pattern: &str, text: &str) -> String {
        let classes =
            BTreeMap::from([("person".to_owned(), vec!["user".to_owned(), "people".to_owned()])]);
        let mut words = Words::default();
        let pattern = Pattern::parse(pattern, &classes, &mut words).expect("a pattern");
        let mut passage = Passage::new(Source::Doc);
        passage.push(text, 0..text.len());
        let atoms = atoms(&passage);
        let mut ids = Vec::new();
        words.number(text, &atoms, &mut ids);
        let hits = (0..ids.len())
            .filter(|&at| pattern.anchors().contains(&ids[at]))
            .filter_map(|at| pattern.match_at(&ids, at))
            .map(|hit| {
                format!("[{}]", &text[atoms[hit.start].range.start..atoms[hit.end - 1].range.end])
            });
        hits.collect()
    }

    #[test]
    fn alternatives_in_any_case() {
        assert_eq!(found("so many|much", "So many, so\nmuch, so few; many"), "[So many][so\nmuch]");
    }

    #[test]
    fn words_do_not_match_inside_words_or_across_marks() {
        assert_eq!(found("way", "always away way-point way's Way"), "[way's][Way]");
        assert_eq!(found("so many", "so, many. So `many`"), "");
    }

    #[test]
    fn context_is_no_part_of_a_finding() {
        assert_eq!(found("!<person> who", "A user who reads; a node who reads"), "[who]");
        assert_eq!(found("^ who", "Who reads. Those who read: who"), "[Who][who]");
        assert_eq!(found("lies $", "It lies. It lies here"), "[lies]");
        assert_eq!(found("way =_", "A way home. A way"), "[way]");
        assert_eq!(found("=the way _", "the way home, a way out"), "[way home]");
    }

    #[test]
    fn code_is_one_atom() {
        assert_eq!(found("stands in CODE", "It stands in `a b`"), "[stands in `a b`]");
    }

    #[test]
    fn faults_say_what_is_known() {
        let classes = BTreeMap::from([("person".to_owned(), Vec::new())]);
        let parse = |text| Pattern::parse(text, &classes, &mut Words::default()).map(|_| ());
        let expected = "the class <robot> is not defined; known are: person";
        assert_eq!(parse("<robot>"), Err(expected.to_owned()));
        assert!(parse("! _").is_err());
    }
}
