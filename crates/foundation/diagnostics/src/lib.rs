//! What is wrong, where (`file:line:column`), and what to do about it.
//!
//! A reader never fails on broken input: it returns what it could make of it together with
//! [`Diagnostics`]. Each [`Diagnostic`] points into a [`SourceMap`] by [`Span`], and a span also
//! knows through which macro calls and includes its text came to be where it is.

mod collect;
mod diagnostic;
mod json;
mod machine_words;
mod render;
mod source;
mod spelling;

pub use collect::{Diagnostics, MOST_KEPT};
pub use diagnostic::{Diagnostic, Replacement, Severity};
pub use json::to_json;
pub use machine_words::plain_words;
pub use render::{Style, render};
pub use source::{ContextId, Expansion, FileId, Origin, Position, SourceFile, SourceMap, Span};
pub use spelling::closest;
