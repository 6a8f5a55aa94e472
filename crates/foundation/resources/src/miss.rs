//! Errors of URIs that cannot be resolved.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Origin};

/// Reason that a URI cannot be resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResolveErrorKind {
    /// The URI is malformed.
    Malformed,
    /// No file or folder exists at any searched path.
    Missing,
    /// There is no package of that name.
    MissingPackage,
    /// The target exists, but is outside the folders that the file may refer to.
    Outside,
}

impl ResolveErrorKind {
    /// True if the target does not exist.
    #[must_use]
    pub const fn is_missing(self) -> bool {
        matches!(self, Self::Missing | Self::MissingPackage)
    }
}

/// URI that cannot be resolved, with the searched paths.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResolveError {
    /// The URI as written.
    pub uri: String,
    /// Type of the failure.
    pub kind: ResolveErrorKind,
    /// Reason, as the second half of a sentence.
    pub reason: String,
    /// Searched paths, in order. A search through a tree of packages is one entry with `**` for the folders
    /// between.
    pub tried: Vec<PathBuf>,
    /// Advice.
    pub help: Vec<String>,
}

impl ResolveError {
    pub(crate) fn malformed(uri: &str, reason: impl Into<String>) -> Self {
        Self::new(uri, ResolveErrorKind::Malformed, reason)
    }

    pub(crate) fn missing(uri: &str, reason: impl Into<String>) -> Self {
        Self::new(uri, ResolveErrorKind::Missing, reason)
    }

    pub(crate) fn missing_package(uri: &str, reason: impl Into<String>) -> Self {
        Self::new(uri, ResolveErrorKind::MissingPackage, reason)
    }

    pub(crate) fn outside(uri: &str, target: &Path) -> Self {
        let folder = target.parent().unwrap_or(target).display();
        Self::new(uri, ResolveErrorKind::Outside, "it leaves the resource paths")
            .tried(target)
            .help(format!("if you trust this file, allow the folder: `--resource-path {folder}`"))
    }

    fn new(uri: &str, kind: ResolveErrorKind, reason: impl Into<String>) -> Self {
        // A hostile file may have a megabyte in place of a name.
        let shown: String = uri.chars().take(MAX_SHOWN_CHARS).collect();
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

    /// Converts to an error at the location of the URI, with the searched paths.
    #[must_use]
    pub fn into_diagnostic(self, origin: impl Into<Origin>) -> Diagnostic {
        let (code, cause) = match self.kind {
            ResolveErrorKind::Malformed => ("bad-uri", None),
            ResolveErrorKind::Missing => ("missing-resource", Some(DiagnosticCause::MissingFile)),
            ResolveErrorKind::MissingPackage => {
                ("missing-resource", Some(DiagnosticCause::MissingPackage))
            }
            ResolveErrorKind::Outside => ("resource-outside", None),
        };
        let message = self.to_string();
        let mut diagnostic = Diagnostic::error(code, message).caused_by(cause).at(origin);
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

/// Maximum length of a URI in messages [characters].
const MAX_SHOWN_CHARS: usize = 200;

impl std::fmt::Display for ResolveError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let verdict = match self.kind {
            ResolveErrorKind::Malformed => "names nothing",
            ResolveErrorKind::Missing | ResolveErrorKind::MissingPackage => "cannot be found",
            ResolveErrorKind::Outside => "may not be used",
        };
        write!(f, "`{}` {verdict}: {}", self.uri, self.reason)
    }
}

impl std::error::Error for ResolveError {}
