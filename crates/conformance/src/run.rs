//! All cases of a folder.

use std::collections::BTreeSet;
use std::fmt;
use std::path::{Path, PathBuf};

use periplus_resources::{Host, Kind};

use crate::case::Case;
use crate::differences::Differences;
use crate::kinds::{KINDS, Setting};
use crate::report::Report;

/// What came of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// All is as expected.
    Passed,
    /// Something is not.
    Failed,
    /// Nobody checks this kind yet.
    Unknown,
    /// The file is no case, or not one that its check understands.
    Unreadable,
}

/// A case and what came of it.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The name of the file.
    pub file: String,
    /// Its own name; that of the file where it is no case.
    pub id: String,
    /// What is checked; empty where it is no case.
    pub kind: String,
    /// The same in words.
    pub title: String,
    /// What came of it.
    pub verdict: Verdict,
    /// What is wrong, where something is.
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
pub fn run(path: &Path, host: &dyn Host) -> Result<Report, NoCases> {
    let is_file = host.kind(path) == Some(Kind::File);
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
    Ok(Report { results: names.iter().map(|name| one(name, &setting)).collect() })
}

fn one(file: &str, setting: &Setting<'_>) -> Outcome {
    let text = setting.host.read(&setting.folder.join(file));
    let text = text
        .map_err(|error| error.to_string())
        .and_then(|bytes| String::from_utf8(bytes).map_err(|_| "it is no text".to_owned()));
    let case = text.and_then(|text| Case::read(file, &text).map_err(|error| error.0));
    match case {
        Ok(case) => judge(&case, setting),
        Err(words) => Outcome {
            file: file.into(),
            id: file.trim_end_matches(".json").into(),
            kind: String::new(),
            title: String::new(),
            verdict: Verdict::Unreadable,
            differences: vec![words],
        },
    }
}

/// A case is passed when it is for every distribution that it names.
fn judge(case: &Case, setting: &Setting<'_>) -> Outcome {
    let outcome = |verdict, differences| Outcome {
        file: case.file.clone(),
        id: case.id.clone(),
        kind: case.kind.clone(),
        title: case.title.clone(),
        verdict,
        differences,
    };
    let Some((_, check)) = KINDS.iter().find(|(kind, _)| *kind == case.kind) else {
        return outcome(Verdict::Unknown, Vec::new());
    };
    let mut distros = case.applies_to.clone();
    if distros.is_empty() {
        distros.push("main".into());
    }
    let (mut told, mut verdict) = (BTreeSet::new(), Verdict::Passed);
    let mut words = Vec::new();
    for distro in &distros {
        let mut differences = Differences::new(case);
        match check(case, distro, setting, &mut differences) {
            Err(error) => {
                verdict = Verdict::Unreadable;
                words.push(error.0);
                break;
            }
            Ok(()) if differences.is_passed() => {}
            Ok(()) => {
                verdict = verdict.max(Verdict::Failed);
                for difference in differences.into_words() {
                    // Those that all have are said once.
                    if told.insert(difference.clone()) {
                        words.push(format!("{distro}: {difference}"));
                    }
                }
            }
        }
    }
    outcome(verdict, words)
}
