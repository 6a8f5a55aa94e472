//! Names of nodes, topics and services.
//!
//! Source of the rules: ROS 2's design article "Topic and Service name mapping to DDS", and the
//! checks in `rmw/validate_full_topic_name.c`, `validate_node_name.c` and `validate_namespace.c`.

use crate::GraphError;

/// Maximum length of the full name of a topic or service \[bytes\]: the limit of DDS less the
/// prefix of ROS.
pub const MAX_TOPIC_NAME_BYTES: usize = 247;

/// Maximum length of a node name \[bytes\].
pub const MAX_NODE_NAME_BYTES: usize = 255;

/// Maximum length of a namespace \[bytes\]: that of a topic, less a slash and one letter.
pub const MAX_NAMESPACE_BYTES: usize = 245;

/// Checks a node name, without namespace.
///
/// # Errors
/// When ROS 2 would refuse it.
pub fn check_node(name: &str) -> Result<(), GraphError> {
    let fail = |reason: String| Err(refused("node", name, reason, Some(valid_node_name(name))));
    if name.is_empty() {
        return fail("is empty".into());
    }
    if name.len() > MAX_NODE_NAME_BYTES {
        return fail(format!(
            "has {} bytes, at most {MAX_NODE_NAME_BYTES} are allowed",
            name.len()
        ));
    }
    if let Some(letter) = name.chars().find(|letter| !is_letter(*letter)) {
        let reason = format!("has `{letter}`; only letters, digits and `_` are allowed");
        return fail(reason);
    }
    if name.starts_with(|first: char| first.is_ascii_digit()) {
        return fail("begins with a digit".into());
    }
    Ok(())
}

/// Checks a namespace: `/` or a full name.
///
/// # Errors
/// When ROS 2 would refuse it.
pub fn check_namespace(name: &str) -> Result<(), GraphError> {
    if name == "/" { Ok(()) } else { check_full("namespace", name, MAX_NAMESPACE_BYTES) }
}

/// Checks the full name of a topic or service; `what` names the kind in the error.
///
/// # Errors
/// When ROS 2 would refuse it.
pub fn check_topic(what: &'static str, name: &str) -> Result<(), GraphError> {
    check_full(what, name, MAX_TOPIC_NAME_BYTES)
}

fn check_full(what: &'static str, name: &str, longest: usize) -> Result<(), GraphError> {
    let reason = if name.is_empty() {
        "is empty".into()
    } else if !name.starts_with('/') {
        "does not begin with `/`".into()
    } else if name.ends_with('/') {
        "ends with `/`".into()
    } else if name.contains("//") {
        "has two `/` in a row".into()
    } else if let Some(letter) = name.chars().find(|c| !is_letter(*c) && *c != '/') {
        format!("has `{letter}`; only letters, digits, `_` and `/` are allowed")
    } else if let Some(part) = name.split('/').find(|part| part.starts_with(is_digit)) {
        format!("has a part that begins with a digit, `{part}`")
    } else if name.len() > longest {
        format!("has {} bytes, at most {longest} are allowed", name.len())
    } else {
        return Ok(());
    };
    Err(refused(what, name, reason, Some(valid_topic_name(name))))
}

fn refused(what: &'static str, name: &str, reason: String, help: Option<String>) -> GraphError {
    let longest = if what == "node" { MAX_NODE_NAME_BYTES } else { MAX_TOPIC_NAME_BYTES };
    let help = help.filter(|help| help.len() <= longest && help != name);
    GraphError::Name { what, name: name.to_owned(), reason, help }
}

fn is_letter(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_'
}

fn is_digit(letter: char) -> bool {
    letter.is_ascii_digit()
}

/// Converts a Gazebo topic name to a valid ROS 2 topic name: every character other than a letter,
/// digit, `_` or `/` becomes `_`; a part that begins with a digit gets a leading `_`; repeated
/// slashes are merged, and a trailing one is removed. A leading `/` or `~` is kept. An empty name
/// becomes `_`. Valid names are not changed.
///
/// `/model/robot-1/link/base::lidar` becomes `/model/robot_1/link/base__lidar`.
#[must_use]
pub fn valid_topic_name(name: &str) -> String {
    let (head, rest) = match name.strip_prefix('~') {
        Some(rest) => ("~/", rest),
        None if name.starts_with('/') => ("/", name),
        None => ("", name),
    };
    let parts: Vec<String> =
        rest.split('/').filter(|part| !part.is_empty()).map(valid_node_name).collect();
    match (head, parts.is_empty()) {
        ("~/", true) => "~".into(),
        (_, true) => format!("{head}_"),
        (_, false) => format!("{head}{}", parts.join("/")),
    }
}

/// Converts any text to a valid node name by the rule of [`valid_topic_name`]; `/` becomes `_` as
/// well.
#[must_use]
pub fn valid_node_name(name: &str) -> String {
    let mut valid: String = name.chars().map(|c| if is_letter(c) { c } else { '_' }).collect();
    if valid.is_empty() || valid.starts_with(is_digit) {
        valid.insert(0, '_');
    }
    valid
}

/// Expands a name as written by a node, before remapping: `/x` is absolute, `x` is relative to the
/// namespace, `~/x` and `~` are private to the node; `{node}`, `{ns}` and `{namespace}` are
/// replaced by the names of the node.
///
/// # Errors
/// When ROS 2 would refuse it.
pub(crate) fn expand(
    what: &'static str,
    name: &str,
    node: &str,
    namespace: &str,
) -> Result<String, GraphError> {
    let fail = |reason: &str, help: Option<String>| Err(refused(what, name, reason.into(), help));
    if name.is_empty() {
        return fail("is empty", None);
    }
    let base = namespace.trim_end_matches('/');
    let mut full = if let Some(rest) = name.strip_prefix('~') {
        if !(rest.is_empty() || rest.starts_with('/')) {
            return fail("has no `/` after its `~`", Some(format!("~/{rest}")));
        }
        format!("{base}/{node}{rest}")
    } else if name.starts_with('/') || name.starts_with("{ns}") || name.starts_with("{namespace}") {
        name.to_owned()
    } else {
        format!("{base}/{name}")
    };
    if full.contains('{') {
        full = full.replace("{node}", node).replace("{ns}", base).replace("{namespace}", base);
    }
    if full.contains(['{', '}']) {
        return fail(
            "has braces; only the substitutions `{node}`, `{ns}` and `{namespace}` exist",
            None,
        );
    }
    if full[1..].contains('~') {
        return fail("` that is not its beginning~` that is not its beginning", None);
    }
    check_topic(what, &full).map_err(|error| match error {
        GraphError::Name { what, reason, .. } => {
            refused(what, name, reason, Some(valid_topic_name(name)))
        }
        other => other,
    })?;
    Ok(full)
}
