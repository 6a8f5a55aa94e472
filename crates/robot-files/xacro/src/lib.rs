//! The xacro language: macros, properties and expressions over XML.
//!
//! [`expand`] turns a document into plain XML. Every node of the result keeps its source location and the
//! macro calls and includes that produced it, so that later readers report the right line.
//!
//! Written from the behaviour of the reference implementation (`ros/xacro` 2.1), not from its code. One
//! deliberate difference: braces inside `${...}` and parentheses inside `$(eval ...)` may nest, which the
//! regular expressions of the reference do not support.

mod attributes;
mod call;
mod evaluate;
mod expand;
mod extension;
mod frame;
mod include;
mod literal;
mod names;
mod output;
mod parameters;
mod property;
mod scopes;
mod setting;
mod state;
mod text;
mod yaml;

pub use expand::{Expanded, expand};
pub use setting::XacroContext;

/// The namespace that marks a file as xacro.
pub const NAMESPACE: &str = "http://www.ros.org/wiki/xacro";

/// Returns true if a document uses xacro: its root declares the prefix, or the root or one of its children
/// uses it. Deeper elements are not searched, because world files can have megabytes.
#[must_use]
pub fn is_xacro(document: &periplus_xml::Document) -> bool {
    let root = &document.root;
    let declares = |name: &str| name == "xmlns:xacro" || name.starts_with("xmlns:xacro:");
    root.attributes.iter().any(|attribute| declares(&attribute.name))
        || root.prefix() == Some("xacro")
        || root.elements().any(|child| child.prefix() == Some("xacro"))
}
