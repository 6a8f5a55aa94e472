//! The xacro language, one file a theme.
//!
//! Every result was compared with that of PyPI's xacro 2.1.1. Where this one accepts more, a
//! test calls `check_lenient` and gives the reason; where it refuses more, a comment does.
#![allow(clippy::unwrap_used, reason = "a test that panics is a test that fails")]

#[path = "language/blocks.rs"]
mod blocks;
#[path = "language/comments.rs"]
mod comments;
#[path = "language/conditions.rs"]
mod conditions;
#[path = "language/diagnostics.rs"]
mod diagnostics;
#[path = "language/elements.rs"]
mod elements;
#[path = "language/example.rs"]
mod example;
#[path = "language/extensions.rs"]
mod extensions;
#[path = "language/hostile.rs"]
mod hostile;
#[path = "language/includes.rs"]
mod includes;
#[path = "language/invariants.rs"]
mod invariants;
#[path = "language/macros.rs"]
mod macros;
#[path = "language/parameters.rs"]
mod parameters;
#[path = "language/properties.rs"]
mod properties;
#[path = "language/texts.rs"]
mod texts;
#[path = "language/yaml.rs"]
mod yaml;
