//! `<xacro:include>` and other files that a file loads.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Diagnostics, Expansion, Origin};
use periplus_resources::{EntryKind, ResolveErrorKind};
use periplus_xml::{Element, decode, parse};

use crate::attributes::value_origin;
use crate::frame::Frame;
use crate::output::Output;
use crate::state::{Failed, State};
use crate::yaml;
use periplus_python_expr::{EmptyScope, Expression, Value, evaluate};

/// Maximum depth of nested includes.
const MAX_INCLUDE_DEPTH: usize = 40;

/// Budget cost of a file, in elements.
const NODES_PER_FILE: usize = 100;

/// Maximum number of files that match one pattern.
const MAX_MATCHED_FILES: usize = 2_000;

/// Maximum number of bytes that an expansion reads; a file included twice counts twice.
const MAX_READ_BYTES: usize = 64 << 20;

impl State<'_> {
    /// Puts the content of the included files into `out`.
    #[inline(never)]
    pub(crate) fn include(
        &self,
        element: &Element,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.check_attributes(element, &["filename"], &["filename", "ns", "optional"], frame)?;
        let file_origin = value_origin(element, "filename", frame);
        let name = self.attribute(element, "filename", frame)?.unwrap_or_default();
        let optional = self.flag(element, "optional", frame)?.unwrap_or(false);
        self.check_childless(element, frame);
        let scope = match self.attribute(element, "ns", frame)? {
            Some(namespace) => self.scopes.borrow_mut().open_namespace(frame.scope, &namespace),
            None => frame.scope,
        };
        let path = self.absolute(&name);
        let paths = if name.contains(['*', '?', '[']) {
            let found = self.glob(&path, file_origin)?;
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
            self.include_file(&path, element, file_origin, Frame { scope, ..frame }, out)?;
        }
        Ok(())
    }

    #[inline(never)]
    fn include_file(
        &self,
        path: &Path,
        element: &Element,
        file_origin: Origin,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        let open = self.files.borrow().len();
        let repeated = self.files.borrow().iter().filter(|file| *file == path).count();
        // A file may include itself under a condition, so a few rounds are allowed.
        if repeated > 3 || open > MAX_INCLUDE_DEPTH {
            let shown = self.setting.shown(path);
            let message = if repeated > 3 {
                format!("`{shown}` includes itself without end")
            } else {
                format!("files include each other more than {MAX_INCLUDE_DEPTH} deep")
            };
            return Err(self.give_up(
                Diagnostic::error("include-cycle", message)
                    .at(file_origin)
                    .help("move what both files need into a third, or include under <xacro:if>"),
            ));
        }
        self.count(NODES_PER_FILE, file_origin)?;
        let text = self.read(path, file_origin)?;
        let at = frame.seen(element.origin).0;
        let (document, inner) = {
            let mut sources = self.sources.borrow_mut();
            let file = sources.add(self.setting.shown(path), text);
            let inner = at.map(|at| sources.expand(Expansion::Include { at }));
            let mut found = Diagnostics::new();
            let document = parse(file, &sources, &mut found);
            for mut diagnostic in found.iter().cloned() {
                diagnostic.span =
                    diagnostic.span.map(|span| inner.map_or(span, |inner| span.within(inner)));
                self.report(diagnostic);
            }
            (document.ok_or(Failed)?, inner)
        };
        self.note_file(path);
        self.files.borrow_mut().push(path.to_owned());
        let frame = Frame { context: inner.or(frame.context), ..frame };
        self.adopt_namespaces(&document.root, frame, out);
        let result = self.expand_nodes(&document.root.children, frame, out);
        self.files.borrow_mut().pop();
        result
    }

    /// The value of a YAML file.
    #[inline(never)]
    pub(crate) fn load_yaml(&self, name: &str, origin: Origin) -> Result<Value, Failed> {
        let path = self.absolute(name);
        if let Some(value) = self.yaml.borrow().get(&path) {
            return Ok(value.clone());
        }
        let text = self.read(&path, origin)?;
        self.note_file(&path);
        let mut evaluate = |text: &str| {
            // As in the reference implementation, unit tags see xacro's own names (`!degrees 90/2`, `pi`)
            // but no properties.
            let mut budget = self.budget.take();
            let value = Expression::parse(text)
                .and_then(|expression| evaluate(&expression, &EmptyScope, &mut budget));
            self.budget.replace(budget);
            match value {
                Ok(Value::Float(float)) => Ok(float),
                #[expect(clippy::cast_precision_loss, reason = "as Python's float() does")]
                Ok(Value::Int(int)) => Ok(int as f64),
                Ok(_) => Err(format!("`{text}` is not a number")),
                Err(error) => Err(format!("`{text}` is not a number: {}", error.message)),
            }
        };
        let value = yaml::load(&text, &mut evaluate).map(Value::dotted).map_err(|error| {
            let place = {
                let mut sources = self.sources.borrow_mut();
                let byte = byte_at(&text, error.line, error.column);
                let file = sources.add(self.setting.shown(&path), text);
                sources.whole(file).part(byte, byte + 1)
            };
            let diagnostic = Diagnostic::error("yaml", error.message).at(place);
            self.fail(diagnostic.related(origin, "loaded here"))
        })?;
        self.yaml.borrow_mut().insert(path, value.clone());
        Ok(value)
    }

    /// Records a file for [`crate::Expanded::includes`].
    fn note_file(&self, path: &Path) {
        let mut includes = self.includes.borrow_mut();
        if !includes.iter().any(|known| known == path) {
            includes.push(path.to_owned());
        }
    }

    /// The folder of a package.
    #[inline(never)]
    pub(crate) fn package(&self, name: &str, origin: Origin) -> Result<PathBuf, Failed> {
        let from = self.files.borrow().last().cloned().unwrap_or_default();
        self.setting
            .resolver
            .find_package(name, &from)
            .map_err(|miss| self.fail(miss.into_diagnostic(origin)))
    }

    fn absolute(&self, name: &str) -> PathBuf {
        // `join` returns an absolute name unchanged.
        self.folder().join(name)
    }

    #[inline(never)]
    fn read(&self, path: &Path, origin: Origin) -> Result<String, Failed> {
        let from = self.files.borrow().first().cloned().unwrap_or_default();
        let found =
            self.setting.resolver.resolve(&path.to_string_lossy(), &from).map_err(|miss| {
                let missing = miss.kind.is_missing();
                let mut diagnostic = miss.into_diagnostic(origin);
                if missing {
                    // The name in the file is relative or starts with `$(find ...)`, so the advice about
                    // absolute paths does not apply.
                    let shown = self.setting.shown(path);
                    diagnostic.message =
                        format!("`{shown}` cannot be found: there is no such file");
                    diagnostic.help.retain(|help| help.starts_with("did you mean"));
                }
                self.fail(diagnostic)
            })?;
        let cannot = |why: String, cause: Option<DiagnosticCause>| {
            let message = format!("`{}` cannot be read: {why}", self.setting.shown(path));
            self.fail(Diagnostic::error("unreadable-file", message).caused_by(cause).at(origin))
        };
        let bytes = self
            .setting
            .host
            .read(&found)
            .map_err(|error| cannot(error.to_string(), error.cause()))?;
        self.read.set(self.read.get() + bytes.len());
        if self.read.get() > MAX_READ_BYTES {
            return Err(self.give_up(
                Diagnostic::error(
                    "too-large",
                    format!("included files come to more than {} MiB", MAX_READ_BYTES >> 20),
                )
                .at(origin)
                .help("is one of them included repeatedly?"),
            ));
        }
        decode(&bytes)
            .map(std::borrow::Cow::into_owned)
            .map_err(|error| cannot(error.to_string(), None))
    }

    /// Files whose path matches a pattern of `*`, `?` and `[...]`, sorted.
    ///
    /// Folders outside the resource paths are not listed.
    #[inline(never)]
    fn glob(&self, pattern: &Path, origin: Origin) -> Result<Vec<PathBuf>, Failed> {
        let from = self.files.borrow().first().cloned().unwrap_or_default();
        let open =
            |folder: &PathBuf| self.setting.resolver.resolve(&folder.to_string_lossy(), &from);
        let mut found = vec![PathBuf::new()];
        let mut is_certain = true;
        for component in pattern.components() {
            let name = component.as_os_str().to_string_lossy();
            let is_pattern = name.contains(['*', '?', '[']);
            if is_pattern && is_certain {
                is_certain = false;
                // The user named this folder, so report the reason that nothing in it is found.
                if let Some(Err(miss)) = found.first().map(&open)
                    && miss.kind == ResolveErrorKind::Outside
                {
                    return Err(self.fail(miss.into_diagnostic(origin)));
                }
            }
            let mut next = Vec::new();
            for folder in &found {
                if is_pattern {
                    if open(folder).is_err() {
                        continue;
                    }
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
                if next.len() > MAX_MATCHED_FILES {
                    break;
                }
            }
            found = next;
        }
        found.retain(|path| self.setting.host.kind(path) == Some(EntryKind::File));
        found.sort();
        Ok(found)
    }
}

/// Byte offset of a line and a column, both from 1, columns in characters.
fn byte_at(text: &str, line: usize, column: usize) -> usize {
    let before = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let line: &str = &text[before..];
    let offset = line.char_indices().nth(column.saturating_sub(1)).map(|(at, _)| at);
    before + offset.unwrap_or(line.len())
}

/// Returns true if a name matches a shell pattern.
fn matches(pattern: &str, name: &str) -> bool {
    let pattern: Vec<char> = pattern.chars().collect();
    let name: Vec<char> = name.chars().collect();
    // Greedy matching with one position to backtrack to: linear in practice, quadratic at worst.
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

/// Length of `[a-z]` or `[!a-z]` at the start of a pattern, and true if the class contains the character.
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
