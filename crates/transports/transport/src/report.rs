//! What does not fit between one of ours and one elsewhere, in words.

use periplus_diagnostics::Diagnostic;

/// One of the two.
#[derive(Clone, Copy, Debug)]
pub struct Party<'a> {
    /// Full name of the node.
    pub node: &'a str,
    /// The type that it means.
    pub type_name: &'a str,
    /// The hash of its type, as far as known.
    pub type_hash: Option<&'a str>,
}

/// They mean two types on one topic.
#[must_use]
pub fn other_type(topic: &str, ours: Party<'_>, theirs: Party<'_>) -> Diagnostic {
    let (Party { node, type_name, .. }, other) = (ours, theirs.node);
    let message = format!(
        "on the topic `{topic}` `{node}` has the type {type_name}, and `{other}` {}",
        theirs.type_name
    );
    Diagnostic::warning("type-mismatch", message)
        .help("nothing flows between them; rename the topic of one, or give both one type")
}

/// They mean two definitions of one type.
#[must_use]
pub fn other_hash(topic: &str, ours: Party<'_>, theirs: Party<'_>) -> Diagnostic {
    let (Party { node, type_name, type_hash }, other) = (ours, theirs.node);
    let message = format!(
        "on the topic `{topic}` `{node}` and `{other}` both say {type_name}, and mean two \
         definitions: {} and {}",
        type_hash.unwrap_or("?"),
        theirs.type_hash.unwrap_or("?")
    );
    Diagnostic::warning("type-hash-mismatch", message)
        .help("compare both with `ros2 interface show`; see that both come from the same release")
}
