//! What to say when a URI leads nowhere.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Origin};

/// How a look-up failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MissKind {
    /// The URI itself is broken.
    Malformed,
    /// Nothing stands at any of the places tried.
    Missing,
    /// Something stands there, but outside the folders that this file may name.
    Outside,
}

/// A URI that leads nowhere, and every place where it was looked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Miss {
    /// The URI as written.
    pub uri: String,
    /// How the look-up failed.
    pub kind: MissKind,
    /// Why, as the second half of a sentence.
    pub reason: String,
    /// The places tried, in their order. A search through a tree of packages is one entry with
    /// `**` for the folders between.
    pub tried: Vec<PathBuf>,
    /// What to do.
    pub help: Vec<String>,
}

impl Miss {
    pub(crate) fn malformed(uri: &str, reason: impl Into<String>) -> Self {
        Self::new(uri, MissKind::Malformed, reason)
    }

    pub(crate) fn missing(uri: &str, reason: impl Into<String>) -> Self {
        Self::new(uri, MissKind::Missing, reason)
    }

    pub(crate) fn outside(uri: &str, target: &Path) -> Self {
        let folder = target.parent().unwrap_or(target).display();
        Self::new(uri, MissKind::Outside, "it leaves the resource paths")
            .tried(target)
            .help(format!("if you trust this file, allow the folder: `--resource-path {folder}`"))
    }

    fn new(uri: &str, kind: MissKind, reason: impl Into<String>) -> Self {
        // A hostile file may write a megabyte where a name belongs.
        let shown: String = uri.chars().take(MOST_SHOWN).collect();
        let uri = if shown.len() < uri.len() { format!("{shown}…") } else { shown };
        Self { uri, kind, reason: reason.into(), tried: Vec::new(), help: Vec::new() }
    }

    pub(crate) fn tried(mut self, place: impl Into<PathBuf>) -> Self {
        self.tried.push(place.into());
        self
    }

    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// The miss as an error at the place that mentions the URI, with every place tried.
    #[must_use]
    pub fn into_diagnostic(self, origin: impl Into<Origin>) -> Diagnostic {
        let code = match self.kind {
            MissKind::Malformed => "bad-uri",
            MissKind::Missing => "missing-resource",
            MissKind::Outside => "resource-outside",
        };
        let message = self.to_string();
        let mut diagnostic = Diagnostic::error(code, message).at(origin);
        if !self.tried.is_empty() {
            let mut note = String::from("tried");
            for place in &self.tried {
                let _ = write!(note, "\n  {}", place.display());
            }
            diagnostic = diagnostic.note(note);
        }
        self.help.into_iter().fold(diagnostic, Diagnostic::help)
    }
}

/// Of a URI, at most this many characters are repeated in messages.
const MOST_SHOWN: usize = 200;

impl std::fmt::Display for Miss {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let verdict = match self.kind {
            MissKind::Malformed => "names nothing",
            MissKind::Missing => "cannot be found",
            MissKind::Outside => "may not be used",
        };
        write!(f, "`{}` {verdict}: {}", self.uri, self.reason)
    }
}

impl std::error::Error for Miss {}
