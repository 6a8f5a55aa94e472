//! One finding.

use crate::source::{Origin, Span};

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// It works, and could be better.
    Hint,
    /// It works, but hardly as meant.
    Warning,
    /// Something was lost or cannot work.
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

/// A text to put in the place of a span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replacement {
    /// What to replace.
    pub span: Span,
    /// What to write instead.
    pub text: String,
    /// Why, in words: "did you mean `radius`?".
    pub message: String,
}

/// One finding: what is wrong, where, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// A short stable name for scripts and searches, such as `unknown-element`.
    pub code: &'static str,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// Where it is wrong.
    pub span: Option<Span>,
    /// What to say beside the marked text.
    pub label: Option<String>,
    /// Other places that belong to the finding.
    pub related: Vec<(Span, String)>,
    /// Facts that explain it.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Vec<String>,
    /// A correction that a program could make.
    pub replacement: Option<Replacement>,
}

impl Diagnostic {
    /// A finding without a place yet.
    #[must_use]
    pub fn new(severity: Severity, code: &'static str, message: impl Into<String>) -> Self {
        Self {
            severity,
            code,
            message: message.into(),
            span: None,
            label: None,
            related: Vec::new(),
            notes: Vec::new(),
            help: Vec::new(),
            replacement: None,
        }
    }

    /// Something was lost or cannot work.
    #[must_use]
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, message)
    }

    /// It works, but hardly as meant.
    #[must_use]
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, message)
    }

    /// It works, and could be better.
    #[must_use]
    pub fn hint(code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Hint, code, message)
    }

    /// Places the finding.
    #[must_use]
    pub fn at(mut self, origin: impl Into<Origin>) -> Self {
        self.span = origin.into().0;
        self
    }

    /// Says something beside the marked text.
    #[must_use]
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(label.into());
        self
    }

    /// Points to another place that belongs to the finding.
    #[must_use]
    pub fn related(mut self, origin: impl Into<Origin>, label: impl Into<String>) -> Self {
        if let Some(span) = origin.into().0 {
            self.related.push((span, label.into()));
        }
        self
    }

    /// Adds a fact.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Says what to do.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// Offers a correction of a piece of text.
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

    /// Offers the nearest of the `known` names in the place of `written`, if one is near.
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
