//! `<xacro:include>` and other files that a file asks for.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{ContextId, Diagnostic, Diagnostics, Expansion, Origin};
use periplus_resources::Kind;
use periplus_xml::{Element, decode, parse};

use crate::evaluate::{Failed, State};
use crate::expand::Output;
use crate::expression::{Dialect, Value};
use crate::scopes::{ScopeId, TOP};
use crate::yaml;

/// How deep files may include files.
const DEEPEST: usize = 40;

/// How many files an expansion may include.
const MOST_FILES: usize = 2_000;

impl State<'_> {
    /// Puts the content of the included files into `out`.
    pub(crate) fn include(
        &self,
        element: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.check_attributes(element, &["filename"], &["filename", "ns", "optional"])?;
        let file_origin = self.value_origin(element, "filename");
        let name = self.attribute(element, "filename", scope)?.unwrap_or_default();
        let optional = self.flag(element, "optional", scope)?.unwrap_or(false);
        let scope = match self.attribute(element, "ns", scope)? {
            Some(namespace) => self.scopes.borrow_mut().open_namespace(scope, &namespace),
            None => scope,
        };
        let path = self.absolute(&name);
        let paths = if name.contains(['*', '?', '[']) {
            let found = self.glob(&path);
            if found.is_empty() {
                self.report(
                    Diagnostic::warning("no-match", format!("no file matches `{name}`"))
                        .at(file_origin)
                        .note(format!("looked for {}", path.display())),
                );
            }
            found
        } else if optional && self.setting.host.kind(&path).is_none() {
            return Ok(());
        } else {
            vec![path]
        };
        for path in paths {
            self.include_file(&path, element, file_origin, scope, context, out)?;
        }
        Ok(())
    }

    fn include_file(
        &self,
        path: &Path,
        element: &Element,
        file_origin: Origin,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        let open = self.files.borrow().len();
        let repeated = self.files.borrow().iter().filter(|file| *file == path).count();
        // A file may include itself under a condition, so a few rounds are allowed.
        if repeated > 3 || open > DEEPEST || self.includes.borrow().len() >= MOST_FILES {
            let chain: Vec<String> = self
                .files
                .borrow()
                .iter()
                .rev()
                .take(5)
                .map(|file| file.display().to_string())
                .collect();
            return Err(self.fail(
                Diagnostic::error(
                    "include-cycle",
                    format!(
                        "`{}` is included by itself, or too many files include each other",
                        path.display()
                    ),
                )
                .at(file_origin)
                .note(format!("included from {}", chain.join(", from ")))
                .help("move what both need into a third file"),
            ));
        }
        let text = self.read(path, file_origin)?;
        let at = element.origin.0.map(|span| context.map_or(span, |context| span.within(context)));
        let (document, inner) = {
            let mut sources = self.sources.borrow_mut();
            let file = sources.add(self.setting.shown(path), text);
            let inner = at.map(|at| sources.expand(Expansion::Include { at }));
            let mut found = Diagnostics::new();
            let document = parse(file, &sources, &mut found);
            self.diagnostics.borrow_mut().append(found);
            (document.ok_or(Failed)?, inner)
        };
        self.includes.borrow_mut().push(path.to_owned());
        self.files.borrow_mut().push(path.to_owned());
        out.adopt_namespaces(&document.root);
        let result = self.expand_nodes(&document.root.children, scope, inner.or(context), out);
        self.files.borrow_mut().pop();
        result
    }

    /// The value of a YAML file.
    pub(crate) fn load_yaml(
        &self,
        name: &str,
        origin: Origin,
        _scope: ScopeId,
    ) -> Result<Value, Failed> {
        let path = self.absolute(name);
        let text = self.read(&path, origin)?;
        self.includes.borrow_mut().push(path.clone());
        let mut evaluate = |expression: &str| {
            let value = self.expression_value(expression, origin, TOP, Dialect::Xacro);
            match value {
                Ok(Value::Float(float)) => Ok(float),
                #[expect(clippy::cast_precision_loss, reason = "as Python's float() does")]
                Ok(Value::Int(int)) => Ok(int as f64),
                _ => Err(format!("`{expression}` is not a number")),
            }
        };
        yaml::load(&text, &mut evaluate).map(Value::dotted).map_err(|error| {
            let mut sources = self.sources.borrow_mut();
            let file = sources.add(self.setting.shown(&path), text.as_str());
            let start: usize =
                text.lines().take(error.line.saturating_sub(1)).map(|line| line.len() + 1).sum();
            let place = sources.whole(file).part(start + error.column - 1, start + error.column);
            drop(sources);
            self.fail(
                Diagnostic::error("yaml", error.message).at(place).related(origin, "loaded here"),
            )
        })
    }

    /// The folder of a package.
    pub(crate) fn package(&self, name: &str, origin: Origin) -> Result<PathBuf, Failed> {
        let from = self.files.borrow().last().cloned().unwrap_or_default();
        self.setting
            .resolver
            .find_package(name, &from)
            .map_err(|miss| self.fail(miss.into_diagnostic(origin)))
    }

    fn absolute(&self, name: &str) -> PathBuf {
        // `join` keeps an absolute name as it is.
        self.folder().join(name)
    }

    fn read(&self, path: &Path, origin: Origin) -> Result<String, Failed> {
        let from = self.files.borrow().first().cloned().unwrap_or_default();
        let name = path.to_string_lossy();
        let found = self
            .setting
            .resolver
            .resolve(&name, &from)
            .map_err(|miss| self.fail(miss.into_diagnostic(origin)))?;
        let cannot = |why: String| {
            let message = format!("`{}` cannot be read: {why}", self.setting.shown(path));
            self.fail(Diagnostic::error("unreadable-file", message).at(origin))
        };
        let bytes = self.setting.host.read(&found).map_err(|error| cannot(error.to_string()))?;
        decode(&bytes).map(std::borrow::Cow::into_owned).map_err(cannot)
    }

    /// Files whose path matches a pattern of `*`, `?` and `[...]`, sorted.
    fn glob(&self, pattern: &Path) -> Vec<PathBuf> {
        let mut found = vec![PathBuf::new()];
        for component in pattern.components() {
            let name = component.as_os_str().to_string_lossy();
            let mut next = Vec::new();
            for folder in &found {
                if name.contains(['*', '?', '[']) {
                    let names = self.setting.host.list(folder);
                    let hidden = |name: &str| name.starts_with('.');
                    next.extend(
                        names
                            .iter()
                            .filter(|other| !hidden(other) && matches(&name, other))
                            .map(|other| folder.join(other)),
                    );
                } else {
                    next.push(folder.join(component));
                }
                if next.len() > MOST_FILES {
                    break;
                }
            }
            found = next;
        }
        found.retain(|path| self.setting.host.kind(path) == Some(Kind::File));
        found.sort();
        found
    }
}

/// Whether a name matches a shell pattern.
fn matches(pattern: &str, name: &str) -> bool {
    let pattern: Vec<char> = pattern.chars().collect();
    let name: Vec<char> = name.chars().collect();
    // Greedy matching with one place to come back to: linear in practice, quadratic at worst.
    let (mut p, mut n) = (0, 0);
    let mut star = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
                continue;
            }
            Some('[') => {
                if let Some((end, hit)) = class(&pattern[p..], name[n]) {
                    if hit {
                        p += end;
                        n += 1;
                        continue;
                    }
                } else if name[n] == '[' {
                    p += 1;
                    n += 1;
                    continue;
                }
            }
            Some('?') => {
                p += 1;
                n += 1;
                continue;
            }
            Some(&same) if same == name[n] => {
                p += 1;
                n += 1;
                continue;
            }
            _ => {}
        }
        match star {
            Some((at, from)) => {
                star = Some((at, from + 1));
                p = at + 1;
                n = from + 1;
            }
            None => return false,
        }
    }
    pattern[p..].iter().all(|&rest| rest == '*')
}

/// The length of `[a-z]` or `[!a-z]` at the start of a pattern, and whether it holds a character.
fn class(pattern: &[char], character: char) -> Option<(usize, bool)> {
    let negated = matches!(pattern.get(1), Some('!' | '^'));
    let from = if negated { 2 } else { 1 };
    let end = from + 1 + pattern.get(from + 1..)?.iter().position(|&c| c == ']')?;
    let mut inside = false;
    let mut at = from;
    while at < end {
        if at + 2 < end && pattern[at + 1] == '-' {
            inside |= (pattern[at]..=pattern[at + 2]).contains(&character);
            at += 3;
        } else {
            inside |= pattern[at] == character;
            at += 1;
        }
    }
    Some((end + 1, inside != negated))
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn shell_patterns() {
        assert!(matches("*.xacro", "a.xacro"));
        assert!(matches("include[1-3].x?cro", "include2.xacro"));
        assert!(!matches("include[!1-3].xacro", "include2.xacro"));
        assert!(matches("a*b*c", "aXbYbZc"));
        assert!(!matches("a*b", "abc"));
        assert!(matches("[", "["));
    }
}
