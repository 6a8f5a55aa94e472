//! All cases of a folder.

use std::collections::BTreeSet;
use std::fmt;
use std::path::{Path, PathBuf};

use periplus_resources::{EntryKind, Host};

use crate::case::Case;
use crate::differences::Differences;
use crate::kinds::{KINDS, Setting};
use crate::report::ConformanceReport;

/// Result of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// All is as expected.
    Passed,
    /// Something is not.
    Failed,
    /// No check has this kind.
    Unknown,
    /// The file is not a case, or not one that its check understands.
    Unreadable,
}

/// A case and what came of it.
#[derive(Clone, Debug)]
pub struct CaseOutcome {
    /// The name of the file.
    pub file: String,
    /// Its own name; that of the file where it is not a case.
    pub id: String,
    /// Kind of the case; empty if the file is not a case.
    pub kind: String,
    /// The same in words.
    pub title: String,
    /// Result of the case.
    pub verdict: Verdict,
    /// Differences, if any.
    pub differences: Vec<String>,
}

/// A folder in which no cases are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoCases(PathBuf);

impl fmt::Display for NoCases {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there are no case files (*.json) in `{}`", self.0.display())
    }
}

impl std::error::Error for NoCases {}

/// Runs every case file of a folder, in the order of their names; or one, by its path.
///
/// # Errors
/// When there is none.
pub fn run(path: &Path, host: &dyn Host) -> Result<ConformanceReport, NoCases> {
    let is_file = host.kind(path) == Some(EntryKind::File);
    let folder = if is_file { path.parent().unwrap_or(Path::new("")) } else { path };
    let names = match path.file_name().filter(|_| is_file) {
        Some(name) => vec![name.to_string_lossy().into_owned()],
        None => host.list(folder),
    };
    let names: Vec<String> = names.into_iter().filter(|name| name.ends_with(".json")).collect();
    if names.is_empty() {
        return Err(NoCases(path.to_owned()));
    }
    let setting = Setting { folder, host };
    Ok(ConformanceReport { results: names.iter().map(|name| one(name, &setting)).collect() })
}

fn one(file: &str, setting: &Setting<'_>) -> CaseOutcome {
    let text = setting.host.read(&setting.folder.join(file));
    let text = text
        .map_err(|error| error.to_string())
        .and_then(|bytes| String::from_utf8(bytes).map_err(|_| "it is not text".to_owned()));
    match text {
        Ok(text) => run_text(file, &text, setting),
        Err(words) => no_case(file, words),
    }
}

/// Runs the case that a text holds, as a file of that name would.
#[must_use]
pub fn run_text(file: &str, text: &str, setting: &Setting<'_>) -> CaseOutcome {
    match Case::read(file, text) {
        Ok(case) => judge(&case, setting),
        Err(error) => no_case(file, error.0),
    }
}

fn no_case(file: &str, words: String) -> CaseOutcome {
    CaseOutcome {
        file: file.into(),
        id: file.trim_end_matches(".json").into(),
        kind: String::new(),
        title: String::new(),
        verdict: Verdict::Unreadable,
        differences: vec![words],
    }
}

/// Distributions that cases may name.
const DISTROS: [&str; 11] = [
    "kinetic",
    "melodic",
    "noetic",
    "humble",
    "iron",
    "jazzy-1.3.10",
    "jazzy",
    "kilted",
    "lyrical",
    "rolling",
    "main",
];

/// A case is passed when it is for every distribution that it names, and when nothing in it has gone
/// without influence.
fn judge(case: &Case, setting: &Setting<'_>) -> CaseOutcome {
    let outcome = |verdict, differences| CaseOutcome {
        file: case.file.clone(),
        id: case.id.clone(),
        kind: case.kind.clone(),
        title: case.title.clone(),
        verdict,
        differences,
    };
    let Some((_, check)) = KINDS.iter().find(|(kind, _)| *kind == case.kind) else {
        let known: Vec<&str> = KINDS.iter().map(|(kind, _)| *kind).collect();
        let words = format!("the kind `{}` is not known; known: {}", case.kind, known.join(", "));
        return outcome(Verdict::Unknown, vec![words]);
    };
    let (mut puzzles, mut words, mut is_empty) = (BTreeSet::new(), Vec::new(), true);
    if case.applies_to.is_empty() {
        puzzles.insert("`applies_to` (or `distro`) names no distribution".to_owned());
    }
    for distro in &case.applies_to {
        if !DISTROS.contains(&distro.as_str()) {
            puzzles.insert(format!(
                "the distribution `{distro}` is not known; known: {}",
                DISTROS.join(", ")
            ));
            continue;
        }
        let mut differences = Differences::new(case);
        if let Err(error) = check(case, distro, setting, &mut differences) {
            puzzles.insert(error.0);
            continue;
        }
        is_empty &= differences.is_empty();
        puzzles.extend(differences.unknown().iter().map(|name| format!("unknown name: {name}")));
        words.extend(differences.into_words().into_iter().map(|it| format!("{distro}: {it}")));
    }
    // What a check does not get to because it gives up is not news.
    if puzzles.is_empty() {
        puzzles.extend(case.unused().iter().map(|path| format!("nothing reads `{path}`")));
        if is_empty {
            puzzles.insert("nothing was compared".to_owned());
        }
    }
    if !puzzles.is_empty() {
        return outcome(Verdict::Unreadable, puzzles.into_iter().chain(words).collect());
    }
    let verdict = if words.is_empty() { Verdict::Passed } else { Verdict::Failed };
    outcome(verdict, words)
}
