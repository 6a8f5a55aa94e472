//! Calls in a Python source, found without a Python parser: brackets, strings and comments decide.

use std::ops::Range;

/// A call with its arguments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct PythonCall {
    /// Bytes from the name to the closing parenthesis.
    pub(super) range: Range<usize>,
    pub(super) arguments: Vec<PythonArgument>,
}

/// An argument of a call, or an item of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct PythonArgument {
    pub(super) keyword: Option<String>,
    /// Bytes of the value.
    pub(super) value: Range<usize>,
}

impl PythonCall {
    pub(super) fn keyword(&self, name: &str) -> Option<&PythonArgument> {
        self.arguments.iter().find(|argument| argument.keyword.as_deref() == Some(name))
    }
}

/// All calls of a function by its plain name, also as an attribute.
pub(super) fn calls(source: &str, name: &str) -> Vec<PythonCall> {
    let mut calls = Vec::new();
    let mut at = 0;
    while at < source.len() {
        let Some(skipped) = skip(source, at) else { break };
        if skipped > at {
            at = skipped;
            continue;
        }
        let rest = &source[at..];
        let before = source[..at].chars().next_back();
        let is_start = before.is_none_or(|c| !(c.is_alphanumeric() || c == '_'));
        if is_start && rest.starts_with(name) {
            let after = &rest[name.len()..];
            let blank = after.len() - after.trim_start().len();
            if after[blank..].starts_with('(') {
                let open = at + name.len() + blank;
                if let Some(close) = closing(source, open) {
                    let arguments = items(source, open + 1..close);
                    calls.push(PythonCall { range: at..close + 1, arguments });
                }
            }
        }
        at += rest.chars().next().map_or(1, char::len_utf8);
    }
    calls
}

/// Items between brackets, separated by commas.
pub(super) fn items(source: &str, inner: Range<usize>) -> Vec<PythonArgument> {
    let mut items = Vec::new();
    let mut start = inner.start;
    let mut at = inner.start;
    while at < inner.end {
        let Some(skipped) = skip(source, at) else { break };
        if skipped > at {
            at = skipped;
            continue;
        }
        match source.as_bytes()[at] {
            b'(' | b'[' | b'{' => match closing(source, at) {
                Some(close) => at = close + 1,
                None => break,
            },
            b',' => {
                items.extend(item(source, start..at));
                at += 1;
                start = at;
            }
            _ => at += source[at..].chars().next().map_or(1, char::len_utf8),
        }
    }
    items.extend(item(source, start..inner.end));
    items
}

fn item(source: &str, range: Range<usize>) -> Option<PythonArgument> {
    let mut range = range;
    // Comments before the value.
    loop {
        let text = &source[range.clone()];
        range.start += text.len() - text.trim_start().len();
        if !source[range.clone()].starts_with('#') {
            break;
        }
        let line = source[range.clone()].find('\n').map_or(range.len(), |end| end + 1);
        range.start += line;
    }
    let text = source[range.clone()].trim_end();
    if text.is_empty() {
        return None;
    }
    range.end = range.start + text.len();
    let name: String = text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    let rest = &text[name.len()..];
    let equals = rest.trim_start();
    if !name.is_empty() && equals.starts_with('=') && !equals.starts_with("==") {
        let value = equals[1..].trim_start();
        let start = range.end - value.len();
        return Some(PythonArgument { keyword: Some(name), value: start..range.end });
    }
    Some(PythonArgument { keyword: None, value: range })
}

/// End of the string or comment at a position; the position itself if there is none. `None` for an unfinished string.
fn skip(source: &str, at: usize) -> Option<usize> {
    let rest = &source[at..];
    if rest.starts_with('#') {
        return Some(at + rest.find('\n').unwrap_or(rest.len()));
    }
    for quote in ["\"\"\"", "'''"] {
        if let Some(inner) = rest.strip_prefix(quote) {
            return inner.find(quote).map(|end| at + end + 6);
        }
    }
    let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''));
    let Some(quote) = quote else { return Some(at) };
    let mut is_escaped = false;
    for (index, character) in rest.char_indices().skip(1) {
        match character {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            _ if character == quote => return Some(at + index + 1),
            _ => {}
        }
    }
    None
}

/// Position of the bracket that closes the one at a position.
pub(super) fn closing(source: &str, open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    let mut at = open;
    while at < source.len() {
        let skipped = skip(source, at)?;
        if skipped > at {
            at = skipped;
            continue;
        }
        match source.as_bytes()[at] {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ => {}
        }
        at += source[at..].chars().next().map_or(1, char::len_utf8);
    }
    None
}

/// Value of a plain string literal.
pub(super) fn literal(text: &str) -> Option<&str> {
    let quote = text.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let inner = text.strip_prefix(quote)?.strip_suffix(quote)?;
    (!inner.contains([quote, '\\'])).then_some(inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_have_their_arguments() {
        let source =
            "x = Node(  # a, b\n  package='a,(b', arguments=['-x', f(1, 2)],\n)\nMyNode(1)";
        let found = calls(source, "Node");
        assert_eq!(found.len(), 1);
        let values: Vec<&str> =
            found[0].arguments.iter().map(|argument| &source[argument.value.clone()]).collect();
        assert_eq!(values, ["'a,(b'", "['-x', f(1, 2)]"]);
        assert_eq!(found[0].arguments[1].keyword.as_deref(), Some("arguments"));
        assert_eq!(literal(values[0]), Some("a,(b"));
    }

    #[test]
    fn unfinished_sources_give_no_calls() {
        assert!(calls("Node('", "Node").is_empty());
        assert!(calls("Node(", "Node").is_empty());
    }
}
