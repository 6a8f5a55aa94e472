//! Single finding.

use crate::source::{Origin, Span};

/// Severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Possible improvement.
    Hint,
    /// Works, but probably not as intended.
    Warning,
    /// Content was lost or cannot work.
    Error,
}

impl Severity {
    /// `error`, `warning` or `hint`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Hint => "hint",
        }
    }
}

/// Class of findings to which programs react, apart from their texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiagnosticCause {
    /// A file does not exist.
    MissingFile,
    /// A package does not exist, with all its files.
    MissingPackage,
    /// Nothing defines a macro, property or argument that is used.
    Undefined,
    /// No value is given for an argument without a default.
    MissingArgument,
    /// The inertia of a link is absent or impossible.
    Inertia,
    /// A model has no links.
    NoLinks,
    /// No table has a parameter of this name.
    UnknownParameter,
    /// A map has not been given yet.
    MissingMap,
    /// No initial pose has been given.
    MissingInitialPose,
    /// A map has no occupied cells.
    MapWithoutWalls,
    /// No pose on a map is possible.
    NoPossiblePose,
}

/// Replacement text for a span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replacement {
    /// Span to replace.
    pub span: Span,
    /// New text.
    pub text: String,
    /// Reason, in words: "did you mean `radius`?".
    pub message: String,
}

/// Finding: the fault, its location, and advice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Severity of the finding.
    pub severity: Severity,
    /// Short stable name for scripts and searches, such as `unknown-element`.
    pub code: &'static str,
    /// Class, if programs react to this finding.
    pub cause: Option<DiagnosticCause>,
    /// Description of the fault, in one sentence without a full stop.
    pub message: String,
    /// Location of the fault.
    pub span: Option<Span>,
    /// Label of the marked text.
    pub label: Option<String>,
    /// Other locations that belong to the finding.
    pub related: Vec<(Span, String)>,
    /// Facts that explain it.
    pub notes: Vec<String>,
    /// Advice.
    pub help: Vec<String>,
    /// Correction that a program can apply.
    pub replacement: Option<Replacement>,
}

impl Diagnostic {
    /// Returns a finding without a location.
    #[must_use]
    pub fn new(severity: Severity, code: &'static str, message: impl Into<String>) -> Self {
        Self {
            severity,
            code,
            cause: None,
            message: message.into(),
            span: None,
            label: None,
            related: Vec::new(),
            notes: Vec::new(),
            help: Vec::new(),
            replacement: None,
        }
    }

    /// Returns an error: content was lost or cannot work.
    #[must_use]
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, message)
    }

    /// Returns a warning: it works, but probably not as intended.
    #[must_use]
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, message)
    }

    /// Returns a hint: a possible improvement.
    #[must_use]
    pub fn hint(code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Hint, code, message)
    }

    /// Sets the class to which programs react, if any.
    #[must_use]
    pub fn caused_by(mut self, cause: impl Into<Option<DiagnosticCause>>) -> Self {
        self.cause = cause.into();
        self
    }

    /// Sets the location.
    #[must_use]
    pub fn at(mut self, origin: impl Into<Origin>) -> Self {
        self.span = origin.into().0;
        self
    }

    /// Sets the label of the marked text.
    #[must_use]
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(label.into());
        self
    }

    /// Adds another location that belongs to the finding.
    #[must_use]
    pub fn related(mut self, origin: impl Into<Origin>, label: impl Into<String>) -> Self {
        if let Some(span) = origin.into().0 {
            self.related.push((span, label.into()));
        }
        self
    }

    /// Adds an explanatory fact.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Adds advice.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// Sets a correction of a span.
    #[must_use]
    pub fn replace(
        mut self,
        origin: impl Into<Origin>,
        text: impl Into<String>,
        message: impl Into<String>,
    ) -> Self {
        match origin.into().0 {
            Some(span) => {
                self.replacement =
                    Some(Replacement { span, text: text.into(), message: message.into() });
            }
            None => self.help.push(message.into()),
        }
        self
    }

    /// Offers the most similar of the `known` names as a replacement of `written`, if one is similar
    /// enough.
    #[must_use]
    pub fn did_you_mean<'a>(
        self,
        origin: impl Into<Origin>,
        written: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        match crate::closest(written, known) {
            Some(name) => self.replace(origin, name, format!("did you mean `{name}`?")),
            None => self,
        }
    }
}
