//! Python source of launch actions.

/// Names to import: module, name.
type Imports = Vec<(&'static str, &'static str)>;

/// An action as Python source.
#[derive(Clone, Debug)]
pub(super) enum ActionText {
    /// A call with its arguments.
    Call { function: String, arguments: Vec<String> },
    /// A call with a list of actions.
    Group { function: String, actions: Vec<ActionText>, condition: Option<String> },
}

pub(super) fn call(function: impl Into<String>, arguments: Vec<String>) -> ActionText {
    ActionText::Call { function: function.into(), arguments }
}

/// Maximum length of a line.
const MAX_COLUMNS: usize = 100;

impl ActionText {
    pub(super) fn group(
        function: impl Into<String>,
        actions: Vec<Self>,
        condition: Option<String>,
    ) -> Self {
        Self::Group { function: function.into(), actions, condition }
    }

    /// Writes the action at a level of four spaces, with a comma.
    pub(super) fn write(&self, level: usize, out: &mut String) {
        let indent = "    ".repeat(level);
        match self {
            Self::Call { function, arguments } => {
                let line = format!("{indent}{function}({}),\n", arguments.join(", "));
                if line.len() <= MAX_COLUMNS {
                    out.push_str(&line);
                    return;
                }
                out.push_str(&format!("{indent}{function}(\n"));
                for argument in arguments {
                    out.push_str(&format!("{indent}    {argument},\n"));
                }
                out.push_str(&format!("{indent}),\n"));
            }
            Self::Group { function, actions, condition } => {
                out.push_str(&format!("{indent}{function}([\n"));
                for action in actions {
                    action.write(level + 1, out);
                }
                match condition {
                    Some(condition) => out.push_str(&format!("{indent}], {condition}),\n")),
                    None => out.push_str(&format!("{indent}]),\n")),
                }
            }
        }
    }
}

/// String literal.
pub(super) fn quoted(text: &str) -> String {
    let text = text.replace('\\', "\\\\").replace('\n', " ");
    if text.contains('\'') && !text.contains('"') {
        format!("\"{text}\"")
    } else {
        format!("'{}'", text.replace('\'', "\\'"))
    }
}

/// Parts of a text: literals and substitutions of roslaunch.
pub(super) enum LaunchPart<'a> {
    Literal(&'a str),
    /// Inner text of `$(...)`.
    Substitution(&'a str),
}

/// Splits a text at its substitutions.
pub(super) fn parts(text: &str) -> Vec<LaunchPart<'_>> {
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find("$(") {
        let Some(length) = closing(&rest[start + 2..]) else { break };
        if start > 0 {
            parts.push(LaunchPart::Literal(&rest[..start]));
        }
        parts.push(LaunchPart::Substitution(&rest[start + 2..start + 2 + length]));
        rest = &rest[start + 3 + length..];
    }
    if !rest.is_empty() {
        parts.push(LaunchPart::Literal(rest));
    }
    parts
}

/// Length up to the closing parenthesis.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, character) in text.char_indices() {
        match character {
            '(' => depth += 1,
            ')' if depth == 0 => return Some(at),
            ')' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// A text as a Python expression: a literal, a substitution, or a list of both; with the names that it needs.
///
/// `known` are the arguments of the file, which `$(eval ...)` can use by their names alone.
pub(super) fn expression(text: &str, known: &[&str]) -> (String, Imports) {
    let mut imports = Vec::new();
    let parts = parts(text);
    let mut written: Vec<String> = Vec::new();
    for part in parts {
        match part {
            LaunchPart::Literal(text) => written.push(quoted(text)),
            LaunchPart::Substitution(inner) => {
                let (python, names) = substitution(inner, known);
                written.push(python);
                imports.extend(names);
            }
        }
    }
    let python = match written.as_slice() {
        [] => "''".to_owned(),
        [only] => only.clone(),
        _ => format!("[{}]", written.join(", ")),
    };
    (python, imports)
}

const SUBSTITUTIONS: &str = "launch.substitutions";

fn substitution(inner: &str, known: &[&str]) -> (String, Imports) {
    let (kind, rest) = inner.trim().split_once(char::is_whitespace).unwrap_or((inner.trim(), ""));
    let rest = rest.trim();
    match kind {
        "arg" => (
            format!("LaunchConfiguration({})", quoted(rest)),
            vec![(SUBSTITUTIONS, "LaunchConfiguration")],
        ),
        "find" => (
            format!("FindPackageShare({})", quoted(rest)),
            vec![("launch_ros.substitutions", "FindPackageShare")],
        ),
        "env" => (
            format!("EnvironmentVariable({})", quoted(rest)),
            vec![(SUBSTITUTIONS, "EnvironmentVariable")],
        ),
        "optenv" => {
            let (name, default) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
            (
                format!(
                    "EnvironmentVariable({}, default_value={})",
                    quoted(name),
                    quoted(default.trim())
                ),
                vec![(SUBSTITUTIONS, "EnvironmentVariable")],
            )
        }
        "anon" => (format!("AnonName({})", quoted(rest)), vec![(SUBSTITUTIONS, "AnonName")]),
        "dirname" => ("ThisLaunchFileDir()".to_owned(), vec![(SUBSTITUTIONS, "ThisLaunchFileDir")]),
        "eval" => evaluated(rest, known),
        _ => (quoted(&format!("$({inner})")), Vec::new()),
    }
}

/// `$(eval ...)` with `arg('x')`, or a bare `x`, as quoted text of the configuration: roslaunch passes strings.
fn evaluated(text: &str, known: &[&str]) -> (String, Imports) {
    let mut written: Vec<String> = Vec::new();
    let mut imports = vec![(SUBSTITUTIONS, "PythonExpression")];
    let mut plain = String::new();
    let mut at = 0;
    while let Some(character) = text[at..].chars().next() {
        let rest = &text[at..];
        if matches!(character, '\'' | '"') {
            let end = rest[1..].find(character).map_or(rest.len(), |end| end + 2);
            plain.push_str(&rest[..end]);
            at += end;
            continue;
        }
        let word: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        if word.is_empty() {
            plain.push(character);
            at += character.len_utf8();
            continue;
        }
        at += word.len();
        let call = text[at..].strip_prefix('(').filter(|_| word == "arg");
        let argument = call.and_then(|inner| {
            let end = inner.find(')')?;
            Some((inner[..end].trim().trim_matches(['\'', '"']).to_owned(), end + 2))
        });
        let (name, length) = match argument {
            Some((name, length)) => (Some(name), length),
            None => (known.contains(&word.as_str()).then(|| word.clone()), 0),
        };
        at += length;
        let Some(name) = name else {
            plain.push_str(&word);
            continue;
        };
        plain.push('\'');
        written.push(quoted(&std::mem::take(&mut plain)));
        written.push(format!("LaunchConfiguration({})", quoted(&name)));
        imports.push((SUBSTITUTIONS, "LaunchConfiguration"));
        plain.push('\'');
    }
    if !plain.is_empty() {
        written.push(quoted(&plain));
    }
    (format!("PythonExpression([{}])", written.join(", ")), imports)
}

/// Helper for arguments of nodes whose values have several words.
pub(super) const WORDS: &str = "

def words(context, text):
    \"\"\"Return the words of a text with substitutions.\"\"\"
    parts = text if isinstance(text, list) else [text]
    return shlex.split(''.join(
        part if isinstance(part, str) else part.perform(context) for part in parts))
";
