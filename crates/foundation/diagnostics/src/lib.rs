//! Findings with location (`file:line:column`) and advice.
//!
//! A reader never fails on broken input: it returns the content that it could read together with
//! [`Diagnostics`]. Each [`Diagnostic`] refers to a [`SourceMap`] by [`Span`], which also records the macro
//! calls and includes that produced the text.
//!
//! ```
//! use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};
//!
//! let mut sources = SourceMap::new();
//! let file = sources.add("robot.urdf", "<robot nam='cart'/>");
//! let mut findings = Diagnostics::new();
//! let span = sources.whole(file).part(7, 10);
//! findings.push(Diagnostic::error("unknown-attribute", "`nam` is unknown").at(span));
//! assert!(findings.has_errors());
//! ```

mod collect;
mod diagnostic;
mod json;
mod machine_words;
mod render;
mod source;
mod spelling;
mod text_edit;
mod unified_diff;

pub use collect::{Diagnostics, MAX_FINDINGS};
pub use diagnostic::{Diagnostic, DiagnosticCause, Replacement, Severity};
pub use json::to_json;
pub use machine_words::plain_words;
pub use render::{RenderStyle, render};
pub use source::{ContextId, Expansion, FileId, Origin, Position, SourceFile, SourceMap, Span};
pub use spelling::closest;
pub use text_edit::{TextEdit, apply_edits};
pub use unified_diff::unified_diff;
