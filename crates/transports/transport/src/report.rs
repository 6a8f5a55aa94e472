//! Reports of incompatible local and remote endpoints.

use periplus_diagnostics::Diagnostic;

/// One of the two endpoints.
#[derive(Clone, Copy, Debug)]
pub struct Party<'a> {
    /// Full name of the node.
    pub node: &'a str,
    /// Type.
    pub type_name: &'a str,
    /// Type hash, if known.
    pub type_hash: Option<&'a str>,
}

/// Two endpoints of a topic with different types.
#[must_use]
pub fn other_type(topic: &str, ours: Party<'_>, theirs: Party<'_>) -> Diagnostic {
    let (Party { node, type_name, .. }, other) = (ours, theirs.node);
    let message = format!(
        "on the topic `{topic}` `{node}` has the type {type_name}, and `{other}` {}",
        theirs.type_name
    );
    Diagnostic::warning("type-mismatch", message)
        .help("no messages are exchanged; rename the topic of one, or use the same type for both")
}

/// Two endpoints of a topic with different definitions of a type.
#[must_use]
pub fn other_hash(topic: &str, ours: Party<'_>, theirs: Party<'_>) -> Diagnostic {
    let (Party { node, type_name, type_hash }, other) = (ours, theirs.node);
    let message = format!(
        "on the topic `{topic}` `{node}` and `{other}` both use {type_name}, but with two \
         definitions: {} and {}",
        type_hash.unwrap_or("?"),
        theirs.type_hash.unwrap_or("?")
    );
    Diagnostic::warning("type-hash-mismatch", message)
        .help("compare both with `ros2 interface show`; check that both come from the same release")
}
