//! The xacro language: macros, properties and expressions over XML.
//!
//! [`expand`] turns a document into plain XML. Every node of the result keeps its source location and the
//! macro calls and includes that produced it, so that later readers report the right line.
//!
//! Written from the behaviour of the reference implementation (`ros/xacro` 2.1), not from its code. One
//! deliberate difference: braces inside `${...}` and parentheses inside `$(eval ...)` may nest, which the
//! regular expressions of the reference do not support.
//!
//! ```
//! use periplus_diagnostics::{Diagnostics, SourceMap};
//! use periplus_resources::{MemoryHost, Resolver};
//! use periplus_xacro::{XacroContext, expand};
//!
//! let text = "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'>
//!     <xacro:property name='radius' value='0.1'/><wheel diameter='${2 * radius}'/></robot>";
//! let (mut sources, mut diagnostics, host) = (SourceMap::new(), Diagnostics::new(), MemoryHost::new());
//! let file = sources.add("/cart.xacro", text);
//! let document = periplus_xml::parse(file, &sources, &mut diagnostics).expect("XML");
//! let (resolver, folder) = (Resolver::new(&host, &[]), "/".into());
//! let (path, arguments) = ("/cart.xacro".into(), Vec::new());
//! let context = XacroContext { path, working_folder: folder, arguments, host: &host, resolver: &resolver };
//! let robot = expand(&document, context, &mut sources, &mut diagnostics).expect("no errors");
//! assert_eq!(robot.document.root.child("wheel").and_then(|it| it.value("diameter")), Some("0.2"));
//! ```

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
