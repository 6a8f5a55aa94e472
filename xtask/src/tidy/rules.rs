//! Data file of the language: words with their replacements, units, exceptions.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use periplus_diagnostics::SourceMap;
use periplus_yaml::YamlNode;

use super::pattern::{Pattern, WordId, Words};
use crate::step::Failed;

/// Word or phrase that has a better term.
#[derive(Debug)]
pub(crate) struct Entry {
    /// Name in tables; the first pattern without one.
    pub(crate) name: String,
    pub(crate) patterns: Vec<Pattern>,
    /// Phrases in which it is right.
    pub(crate) allowed: Vec<Pattern>,
    replacement: String,
    reason: String,
}

impl Entry {
    /// Replacement and reason in one line.
    pub(crate) fn advice(&self) -> String {
        format!("{} ({})", self.replacement, self.reason)
    }
}

/// Rules for names of constants.
#[derive(Debug, Default)]
pub(crate) struct ConstantRules {
    /// Folders that are checked.
    pub(crate) folders: BTreeSet<String>,
    /// Last words of names that are a unit or a kind.
    pub(crate) suffixes: BTreeSet<String>,
    /// Last words of names of integers: the things that are counted.
    pub(crate) counts: BTreeSet<String>,
    /// Names that are right without, as `package name` or `name`.
    pub(crate) allowed: BTreeSet<String>,
}

/// Rules for names of public types.
#[derive(Debug, Default)]
pub(crate) struct TypeRules {
    /// Names that each crate may define.
    pub(crate) shared: BTreeSet<String>,
    /// Packages whose types are named by others.
    pub(crate) exempt: BTreeSet<String>,
}

/// Content of the data file.
#[derive(Debug)]
pub(crate) struct Rules {
    pub(crate) words: Words,
    pub(crate) openings: Entry,
    pub(crate) entries: Vec<Entry>,
    pub(crate) constants: ConstantRules,
    pub(crate) types: TypeRules,
    /// Parts of paths of files that are not checked.
    exempt_paths: Vec<String>,
    /// Entries and their patterns by the words that anchor them.
    by_word: HashMap<WordId, Vec<(usize, usize)>>,
}

impl Rules {
    /// Reads the data file.
    ///
    /// # Errors
    /// Text that is not YAML, names that are missing or unknown, patterns that cannot be read; each with
    /// its line.
    pub(crate) fn parse(path: &str, text: &str) -> Result<Self, Failed> {
        let mut sources = SourceMap::default();
        let file = sources.add(path, text);
        let node = periplus_yaml::parse(file, &sources)
            .map_err(|fault| Failed(format!("{path}: {}", fault.message)))?
            .ok_or_else(|| {
                Failed(format!("{path} is empty; restore it with `git checkout {path}`"))
            })?;
        let mut reader = Reader { path, text, classes: BTreeMap::new(), words: Words::default() };
        reader.names(&node, &["exempt", "classes", "openings", "words", "constants", "types"])?;
        let exempt_paths = reader.texts(reader.get(&node, "exempt")?)?;
        for (name, class) in reader.get(&node, "classes")?.entries().unwrap_or_default() {
            let name = name.text().unwrap_or_default().to_owned();
            let class = class.text().unwrap_or_default().split_whitespace().map(str::to_owned);
            let class = class.collect();
            reader.classes.insert(name, class);
        }
        let openings = reader.entry(reader.get(&node, "openings")?)?;
        let mut entries = Vec::new();
        for entry in reader.get(&node, "words")?.list().unwrap_or_default() {
            entries.push(reader.entry(entry)?);
        }
        let constants = reader.get(&node, "constants")?;
        reader.names(constants, &["folders", "suffixes", "counts", "allow"])?;
        let constants = ConstantRules {
            folders: reader.set(constants, "folders")?,
            suffixes: reader.set(constants, "suffixes")?,
            counts: reader.set(constants, "counts")?,
            allowed: reader.set(constants, "allow")?,
        };
        let types = reader.get(&node, "types")?;
        reader.names(types, &["shared", "allow", "exempt"])?;
        let mut shared = reader.set(types, "shared")?;
        shared.extend(reader.set(types, "allow")?);
        let types = TypeRules { shared, exempt: reader.set(types, "exempt")? };
        let mut by_word: HashMap<WordId, Vec<(usize, usize)>> = HashMap::new();
        for (at, entry) in entries.iter().enumerate() {
            for (pattern_at, pattern) in entry.patterns.iter().enumerate() {
                for &word in pattern.anchors() {
                    by_word.entry(word).or_default().push((at, pattern_at));
                }
            }
        }
        Ok(Self { words: reader.words, openings, entries, constants, types, exempt_paths, by_word })
    }

    /// True for files that are not checked: generated code and text of others.
    pub(crate) fn is_exempt(&self, path: &str) -> bool {
        self.exempt_paths.iter().any(|part| path.contains(part))
    }

    /// Patterns that are anchored at a word, each with its entry.
    pub(crate) fn patterns_with(&self, word: WordId) -> impl Iterator<Item = (&Entry, &Pattern)> {
        let found = self.by_word.get(&word).map(Vec::as_slice).unwrap_or_default();
        found.iter().map(|&(at, pattern)| (&self.entries[at], &self.entries[at].patterns[pattern]))
    }
}

struct Reader<'a> {
    path: &'a str,
    text: &'a str,
    classes: BTreeMap<String, Vec<String>>,
    words: Words,
}

impl Reader<'_> {
    fn fault(&self, node: &YamlNode, what: &str) -> Failed {
        let (line, column) = super::source::line_and_column(self.text, node.span.start as usize);
        Failed(format!("{}:{line}:{column}: {what}", self.path))
    }

    /// Refuses names that are not known.
    fn names(&self, node: &YamlNode, known: &[&str]) -> Result<(), Failed> {
        for (name, _) in node.entries().unwrap_or_default() {
            if !name.text().is_some_and(|name| known.contains(&name)) {
                let what = format!("unknown name; known are: {}", known.join(", "));
                return Err(self.fault(name, &what));
            }
        }
        Ok(())
    }

    fn get<'n>(&self, node: &'n YamlNode, name: &str) -> Result<&'n YamlNode, Failed> {
        node.get(name).ok_or_else(|| self.fault(node, &format!("`{name}` is missing; add it")))
    }

    /// Texts of a list, or names of a mapping to reasons.
    fn texts(&self, node: &YamlNode) -> Result<Vec<String>, Failed> {
        let text = |node: &YamlNode| {
            let text = node.text().filter(|text| !text.is_empty());
            text.map(str::to_owned).ok_or_else(|| self.fault(node, "a text is expected here"))
        };
        match (node.list(), node.entries()) {
            (Some(list), _) => list.iter().map(text).collect(),
            (_, Some(entries)) => {
                entries.iter().map(|(name, reason)| text(reason).and_then(|_| text(name))).collect()
            }
            _ => Ok(vec![text(node)?]),
        }
    }

    fn set(&self, node: &YamlNode, name: &str) -> Result<BTreeSet<String>, Failed> {
        let texts = self.texts(self.get(node, name)?)?;
        Ok(texts.iter().flat_map(|text| text.split_whitespace()).map(str::to_owned).collect())
    }

    fn patterns(&mut self, node: &YamlNode) -> Result<Vec<Pattern>, Failed> {
        let texts = self.texts(node)?;
        let patterns =
            texts.iter().map(|text| Pattern::parse(text, &self.classes, &mut self.words));
        let patterns: Result<Vec<_>, String> = patterns.collect();
        patterns.map_err(|what| self.fault(node, &what))
    }

    fn entry(&mut self, node: &YamlNode) -> Result<Entry, Failed> {
        self.names(node, &["words", "write", "why", "allow", "name"])?;
        let patterns = self.patterns(self.get(node, "words")?)?;
        let allowed = match node.get("allow") {
            Some(allow) => self.patterns(allow)?,
            None => Vec::new(),
        };
        let text = |name: &str| {
            let node = self.get(node, name)?;
            Ok(node.text().unwrap_or_default().to_owned())
        };
        let (replacement, reason) = (text("write")?, text("why")?);
        let name = match node.get("name").and_then(YamlNode::text) {
            Some(name) => name.to_owned(),
            None => patterns.first().map(|pattern| pattern.text.clone()).unwrap_or_default(),
        };
        Ok(Entry { name, patterns, allowed, replacement, reason })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Message for a data file that is wrong.
    fn fault(text: &str) -> String {
        Rules::parse("words.yaml", text).expect_err("a fault").0
    }

    #[test]
    fn faults_have_line_and_column() {
        assert_eq!(
            fault("words: []\nwrod: []"),
            "words.yaml:2:1: unknown name; known are: exempt, classes, openings, words, constants, types"
        );
        assert_eq!(
            fault("exempt: {}\nclasses: {}\nopenings: {words: [_], write: a, why: b}"),
            "words.yaml:3:19: the pattern `_` names no word; write at least one"
        );
        assert_eq!(fault("classes: {}"), "words.yaml:1:1: `exempt` is missing; add it");
        assert!(fault("").starts_with("words.yaml is empty"));
        assert!(fault("a: [").starts_with("words.yaml: "));
    }
}
