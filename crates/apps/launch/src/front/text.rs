//! `$(...)` in XML and YAML.

use periplus_diagnostics::{Diagnostic, Span};

use crate::evaluate::Outcome;
use crate::suggest::Suggest as _;
use crate::tree::{Part, Substitution, Text, plain};

/// Names of substitutions.
const KNOWN: [&str; 25] = [
    "all",
    "and",
    "anon",
    "any",
    "command",
    "dirname",
    "env",
    "equals",
    "eval",
    "exec-in-pkg",
    "file-content",
    "filename",
    "find-exec",
    "find-pkg-prefix",
    "find-pkg-share",
    "if",
    "launch_log_dir",
    "log_dir",
    "not",
    "not-equals",
    "optenv",
    "or",
    "param",
    "path-join",
    "var",
];

/// Maximum nesting of `$(...)`.
const MAX_DEPTH: usize = 40;

/// Parses a text with substitutions.
pub(crate) fn text(written: &str, span: Span) -> Outcome<Text> {
    let mut reader = Reader { rest: written, whole: written, span, depth: 0 };
    reader.text(|_| false)
}

struct Reader<'t> {
    rest: &'t str,
    whole: &'t str,
    span: Span,
    depth: usize,
}

impl Reader<'_> {
    fn next(&mut self) -> Option<char> {
        let mut letters = self.rest.chars();
        let next = letters.next();
        self.rest = letters.as_str();
        next
    }

    fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    /// Reads up to the end, or to a terminating character.
    fn text(&mut self, ends: impl Fn(char) -> bool) -> Outcome<Text> {
        let mut parts = Text::new();
        let mut so_far = String::new();
        while let Some(letter) = self.peek() {
            if ends(letter) {
                break;
            }
            if self.rest.starts_with("$(") {
                if !so_far.is_empty() {
                    parts.push(Part::Plain(std::mem::take(&mut so_far)));
                }
                parts.push(Part::Substitution(Box::new(self.substitution()?)));
                continue;
            }
            self.next();
            if letter == '\\' && matches!(self.peek(), Some('$' | '\'' | '"' | '\\')) {
                so_far.extend(self.next());
            } else {
                so_far.push(letter);
            }
        }
        if !so_far.is_empty() || parts.is_empty() {
            parts.push(Part::Plain(so_far));
        }
        Ok(parts)
    }

    fn substitution(&mut self) -> Outcome<Substitution> {
        let from = self.whole.len() - self.rest.len();
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(self
                .wrong(from, format!("`$(...)` is nested more than {MAX_DEPTH} levels deep"))
                .into());
        }
        self.rest = self.rest[2..].trim_start();
        let end =
            self.rest.find(|c: char| c.is_whitespace() || c == ')').unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(end);
        let name = name.to_owned();
        self.rest = rest;
        let mut words = Vec::new();
        loop {
            self.rest = self.rest.trim_start();
            match self.peek() {
                None => {
                    return Err(self.wrong(from, "unclosed `$(`").help("add `)`").into());
                }
                Some(')') => {
                    self.next();
                    break;
                }
                Some(_) => words.push(self.word()?),
            }
        }
        self.depth -= 1;
        let to = self.whole.len() - self.rest.len();
        meaning(&name, words).map_err(|wrong| wrong.at(self.span_of(from, to)).into())
    }

    /// Argument of a substitution: quoted, or up to a space.
    fn word(&mut self) -> Outcome<Text> {
        let mut parts = Text::new();
        loop {
            match self.peek() {
                Some(quote @ ('\'' | '"')) => {
                    let from = self.whole.len() - self.rest.len();
                    self.next();
                    parts.extend(self.text(|letter| letter == quote)?);
                    if self.next().is_none() {
                        return Err(self.wrong(from, "unclosed quote").into());
                    }
                }
                Some(letter) if letter.is_whitespace() || letter == ')' => return Ok(parts),
                None => return Ok(parts),
                Some(_) => {
                    parts.extend(self.text(|letter| {
                        letter.is_whitespace() || matches!(letter, ')' | '\'' | '"')
                    })?);
                }
            }
        }
    }

    fn span_of(&self, from: usize, to: usize) -> Span {
        // A value that differs from the file's text, because of entities, has no inner positions.
        let is_same = (self.span.end - self.span.start) as usize == self.whole.len();
        if is_same { self.span.part(from, to) } else { self.span }
    }

    fn wrong(&self, from: usize, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error("launch-substitution", message).at(self.span_of(from, self.whole.len()))
    }
}

fn meaning(name: &str, mut words: Vec<Text>) -> Result<Substitution, Box<Diagnostic>> {
    let wrong = |takes: &str| {
        Box::new(Diagnostic::error("launch-substitution", format!("`$({name})` takes {takes}")))
    };
    let given = words.len();
    let mut next = || if words.is_empty() { None } else { Some(words.remove(0)) };
    Ok(match (name, given) {
        ("var", 1 | 2) => {
            Substitution::Configuration { name: next().unwrap_or_default(), default: next() }
        }
        ("var", _) => return Err(wrong("a name and an optional default")),
        ("env", 1 | 2) => {
            Substitution::Environment { name: next().unwrap_or_default(), default: next() }
        }
        ("optenv", 1 | 2) => Substitution::Environment {
            name: next().unwrap_or_default(),
            default: Some(next().unwrap_or_else(|| plain(""))),
        },
        ("env" | "optenv", _) => return Err(wrong("a variable and an optional default")),
        ("find-pkg-share", 1) => {
            Substitution::Package { name: next().unwrap_or_default(), is_prefix: false }
        }
        ("find-pkg-prefix", 1) => {
            Substitution::Package { name: next().unwrap_or_default(), is_prefix: true }
        }
        ("find-pkg-share" | "find-pkg-prefix", _) => return Err(wrong("the name of a package")),
        ("find-exec", 1) => Substitution::Executable { name: next().unwrap_or_default() },
        ("find-exec", _) => return Err(wrong("the name of a program")),
        ("exec-in-pkg", 2) => {
            let executable = next().unwrap_or_default();
            Substitution::ExecutableInPackage { package: next().unwrap_or_default(), executable }
        }
        ("exec-in-pkg", _) => return Err(wrong("a program and its package")),
        ("command", 1 | 2) => {
            Substitution::Command { command: next().unwrap_or_default(), on_stderr: next() }
        }
        ("command", _) => {
            return Err(wrong("a command in quotes and an optional `on_stderr`"));
        }
        ("eval", 1..) => {
            let parts = std::iter::from_fn(next).collect();
            let expression = vec![Part::Substitution(Box::new(Substitution::Join {
                parts,
                separator: Some(plain(" ")),
            }))];
            Substitution::Expression { expression }
        }
        ("eval", _) => return Err(wrong("an expression in quotes")),
        ("dirname", 0) => Substitution::ThisFolder,
        ("filename", 0) => Substitution::ThisFile,
        ("launch_log_dir" | "log_dir", 0) => Substitution::LogFolder,
        ("dirname" | "filename" | "launch_log_dir" | "log_dir", _) => return Err(wrong("nothing")),
        ("anon", 1) => Substitution::Anonymous { name: next().unwrap_or_default() },
        ("anon", _) => return Err(wrong("a name")),
        ("file-content", 1) => Substitution::Content { file: next().unwrap_or_default() },
        ("file-content", _) => return Err(wrong("a file")),
        ("param", 1) => Substitution::Parameter { name: next().unwrap_or_default() },
        ("param", _) => return Err(wrong("the name of a parameter")),
        ("path-join", 1..) => Substitution::Path { parts: std::iter::from_fn(next).collect() },
        ("path-join", _) => return Err(wrong("the parts of a path")),
        ("equals", 2) => {
            Substitution::Equals { a: next().unwrap_or_default(), b: next().unwrap_or_default() }
        }
        ("not-equals", 2) => {
            Substitution::NotEquals { a: next().unwrap_or_default(), b: next().unwrap_or_default() }
        }
        ("equals" | "not-equals", _) => return Err(wrong("two texts")),
        ("and", 2) | ("all", 1..) => Substitution::All { of: std::iter::from_fn(next).collect() },
        ("or", 2) | ("any", 1..) => Substitution::Any { of: std::iter::from_fn(next).collect() },
        ("and" | "or", _) => return Err(wrong("two conditions")),
        ("all" | "any", _) => return Err(wrong("conditions")),
        ("not", 1) => Substitution::Not { of: next().unwrap_or_default() },
        ("not", _) => return Err(wrong("a condition")),
        ("if", 2 | 3) => Substitution::IfElse {
            condition: next().unwrap_or_default(),
            yes: next().unwrap_or_default(),
            no: next().unwrap_or_else(|| plain("")),
        },
        ("if", _) => return Err(wrong("a condition, a text for true and one for false")),
        ("find" | "arg" | "optarg", _) => {
            let instead = if name == "find" { "find-pkg-share" } else { "var" };
            return Err(Diagnostic::error(
                "launch-substitution",
                format!("`$({name} ...)` is ROS 1, and this is a ROS 2 launch file"),
            )
            .help(format!("write `$({instead} ...)`"))
            .into());
        }
        _ => {
            return Err(Diagnostic::error(
                "launch-substitution",
                format!("unknown substitution `$({name})`"),
            )
            .suggest(name, KNOWN)
            .into());
        }
    })
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::SourceMap;

    use super::text;
    use crate::tree::{Part, Substitution, plain};

    fn read(written: &str) -> Result<crate::tree::Text, String> {
        let mut sources = SourceMap::new();
        let file = sources.add("a.xml", written);
        text(written, sources.whole(file)).map_err(|wrong| wrong.message)
    }

    #[test]
    fn substitutions_nest_and_quote() {
        let inner = Part::Substitution(Box::new(Substitution::Configuration {
            name: plain("b"),
            default: None,
        }));
        assert_eq!(
            read("x$(var a$(var b) 'c d')/y").unwrap(),
            [
                Part::Plain("x".into()),
                Part::Substitution(Box::new(Substitution::Configuration {
                    name: vec![Part::Plain("a".into()), inner],
                    default: Some(plain("c d")),
                })),
                Part::Plain("/y".into()),
            ]
        );
        assert_eq!(read(r"\$(no)").unwrap(), plain("$(no)"));
        assert_eq!(read("").unwrap(), plain(""));
        assert_eq!(read("$(var a").unwrap_err(), "unclosed `$(`");
        assert_eq!(read("$(vra a)").unwrap_err(), "unknown substitution `$(vra)`");
        assert_eq!(
            read("$(find p)").unwrap_err(),
            "`$(find ...)` is ROS 1, and this is a ROS 2 launch file"
        );
    }
}
