//! Resolution of substitutions.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Origin, Severity};
use periplus_python_expr::{Budget, EmptyScope, Expression, evaluate};
use periplus_resources::EntryKind;
use serde_json::json;

use crate::evaluate::{Evaluation, Outcome};
use crate::outside::{MissingInput, Printed};
use crate::rewrite;
use crate::suggest::Suggest as _;
use crate::tree::{Part, Substitution, Text};
use crate::truth::truth;
use crate::words;

/// Limits of work and memory for one expression: launch files compare strings.
const MAX_STEPS: u64 = 100_000;
const MAX_BYTES: u64 = 1 << 20;

/// Maximum length of a text: robot descriptions have some hundred thousand bytes.
pub(crate) const MAX_TEXT_BYTES: usize = 16 << 20;

/// Consequence of a missing file that a launch would rewrite.
pub(crate) const UNCHANGED: &str = "the plan names the file itself";

/// Maximum length of a path [bytes].
const MAX_PATH_BYTES: usize = 4096;

impl Evaluation<'_> {
    /// Resolves a text.
    pub(crate) fn perform(&mut self, text: &Text) -> Outcome<String> {
        let mut whole = String::new();
        for part in text {
            match part {
                Part::Plain(plain) => whole.push_str(plain),
                Part::Substitution(substitution) => whole.push_str(&self.substitute(substitution)?),
            }
            if whole.len() > MAX_TEXT_BYTES {
                return Err(self
                    .error("launch-size", format!("a text has more than {MAX_TEXT_BYTES} bytes"))
                    .help("check for a text that contains itself")
                    .into());
            }
        }
        Ok(self.in_sources_if_path(whole))
    }

    /// Resolves a text; the path of a file that a package's build would install becomes the path in
    /// its sources.
    fn in_sources_if_path(&self, text: String) -> String {
        // Python joins paths with one slash where a URI has two.
        if let Some(rest) = text.strip_prefix("package:/").filter(|rest| !rest.starts_with('/')) {
            return format!("package://{rest}");
        }
        let is_path = text.starts_with('/') && text.len() < MAX_PATH_BYTES && !text.contains('\n');
        if is_path { self.in_sources(&text) } else { text }
    }

    /// Resolves an optional text.
    pub(crate) fn perform_some(&mut self, text: Option<&Text>) -> Outcome<Option<String>> {
        text.map(|text| self.perform(text)).transpose()
    }

    /// Resolves texts.
    pub(crate) fn perform_all(&mut self, texts: &[Text]) -> Outcome<Vec<String>> {
        texts.iter().map(|text| self.perform(text)).collect()
    }

    /// Resolves pairs of texts.
    pub(crate) fn perform_pairs(
        &mut self,
        pairs: &[(Text, Text)],
    ) -> Outcome<Vec<(String, String)>> {
        pairs.iter().map(|(a, b)| Ok((self.perform(a)?, self.perform(b)?))).collect()
    }

    /// Resolves a text as a Boolean.
    pub(crate) fn truth_of(&mut self, text: &Text) -> Outcome<bool> {
        let said = self.perform(text)?;
        truth(&said).ok_or_else(|| {
            self.error(
                "launch-condition",
                format!("a condition must be `true`, `1`, `false` or `0`, not `{said}`"),
            )
            .into()
        })
    }

    fn substitute(&mut self, substitution: &Substitution) -> Outcome<String> {
        Ok(match substitution {
            Substitution::Configuration { name, default } => {
                let name = self.perform(name)?;
                match (self.context.configurations.get(&name), default) {
                    (Some(value), _) => value.clone(),
                    (None, Some(default)) => self.perform(default)?,
                    (None, None) => return Err(self.no_configuration(&name)),
                }
            }
            Substitution::Environment { name, default } => {
                let name = self.perform(name)?;
                match (self.context.variable(&name, self.host), default) {
                    (Some(value), _) => value,
                    (None, Some(default)) => self.perform(default)?,
                    (None, None) => {
                        return Err(self
                            .error(
                                "launch-environment",
                                format!("the environment variable `{name}` is not set"),
                            )
                            .help(format!(
                                "set it for the launch, `{name}=VALUE periplus launch ...`, or give \
                                 the text a default: `$(env {name} VALUE)`"
                            ))
                            .into());
                    }
                }
            }
            Substitution::Join { parts, separator } => {
                let between = self.perform_some(separator.as_ref())?.unwrap_or_default();
                self.perform_all(parts)?.join(&between)
            }
            Substitution::Path { parts } => join_path(&self.perform_all(parts)?),
            Substitution::Package { name, is_prefix } => {
                let name = self.perform(name)?;
                self.package(&name, *is_prefix)
            }
            Substitution::Command { command, on_stderr } => {
                let line = self.perform(command)?;
                let on_stderr = self.perform_some(on_stderr.as_ref())?;
                self.command(&line, on_stderr.as_deref().unwrap_or("fail"))?
            }
            Substitution::Executable { name } => {
                let name = self.perform(name)?;
                self.find_program(&name)
            }
            Substitution::ExecutableInPackage { package, executable } => {
                let (package, executable) = (self.perform(package)?, self.perform(executable)?);
                format!("{}/lib/{package}/{executable}", self.package(&package, true))
            }
            Substitution::Expression { expression } => {
                let expression = self.perform(expression)?;
                self.expression(&expression)?
            }
            Substitution::Content { file } => {
                let file = self.perform(file)?;
                let instead = "its content is left empty in the plan";
                self.read_or_miss(Path::new(&file), instead, None)?.unwrap_or_default()
            }
            Substitution::Anonymous { name } => {
                let name = self.perform(name)?;
                self.anonymous(&name)
            }
            Substitution::Equals { a, b } => word(self.same(a, b)?),
            Substitution::NotEquals { a, b } => word(!self.same(a, b)?),
            Substitution::All { of } => {
                // All are evaluated: a value that is not a Boolean is an error in any position.
                let truths: Vec<bool> =
                    of.iter().map(|text| self.truth_of(text)).collect::<Outcome<_>>()?;
                word(truths.into_iter().all(|is| is))
            }
            Substitution::Any { of } => {
                let truths: Vec<bool> =
                    of.iter().map(|text| self.truth_of(text)).collect::<Outcome<_>>()?;
                word(truths.into_iter().any(|is| is))
            }
            Substitution::Not { of } => word(!self.truth_of(of)?),
            Substitution::IfElse { condition, yes, no } => {
                let chosen = if self.truth_of(condition)? { yes } else { no };
                self.perform(chosen)?
            }
            Substitution::Parameter { name } => {
                let name = self.perform(name)?;
                self.parameter_for_all(&name)?
            }
            Substitution::ThisFile => self.context.file.display().to_string(),
            Substitution::ThisFolder => self.folder().display().to_string(),
            Substitution::LogFolder => {
                self.context.variable("ROS_LOG_DIR", self.host).unwrap_or_else(|| {
                    let home = self.context.variable("HOME", self.host).unwrap_or_default();
                    let ros = self.context.variable("ROS_HOME", self.host);
                    format!("{}/log", ros.unwrap_or_else(|| format!("{home}/.ros")))
                })
            }
            Substitution::RewrittenYaml {
                file,
                rewrites,
                key_rewrites,
                value_rewrites,
                root,
                convert,
            } => {
                let file = self.perform(file)?;
                let rewriting = rewrite::Rewriting {
                    values_by_key: self.perform_pairs(rewrites)?,
                    keys: self.perform_pairs(key_rewrites)?,
                    values: self.perform_pairs(value_rewrites)?,
                    root: self.perform_some(root.as_ref())?,
                    convert: *convert,
                };
                let text = self.read_or_miss(Path::new(&file), UNCHANGED, None)?;
                let Some(text) = text else { return Ok(file) };
                let content = self.yaml(&file, &text)?;
                let rewritten = rewriting.apply(&content);
                let text = serde_json::to_string_pretty(&rewritten).unwrap_or_default();
                self.scratch(&file, &text)?
            }
            Substitution::ReplacedText { file, replacements, condition } => {
                let file = self.perform(file)?;
                let is_wanted = match condition {
                    Some(condition) => self.holds(condition)?,
                    None => true,
                };
                if !is_wanted {
                    return Ok(file);
                }
                let text = self.read_or_miss(Path::new(&file), UNCHANGED, None)?;
                let Some(mut text) = text else { return Ok(file) };
                for (from, to) in self.perform_pairs(replacements)? {
                    text = text.replace(&from, &to);
                }
                self.scratch(&file, &text)?
            }
            Substitution::HasNodeParameters { file, node } => {
                let (file, node) = (self.perform(file)?, self.perform(node)?);
                let instead = "the plan takes it to have no parameters of the node";
                let text = self.read_or_miss(Path::new(&file), instead, None)?;
                let Some(text) = text else { return Ok(word(false)) };
                let content = self.yaml(&file, &text)?;
                word(rewrite::has_node(&content, &node))
            }
            Substitution::Truth { name } => {
                let name = self.perform(name)?;
                let said = self.context.configurations.get(&name).cloned();
                let Some(said) = said else { return Err(self.no_configuration(&name)) };
                word(
                    truth(&said)
                        .unwrap_or(matches!(said.trim().to_lowercase().as_str(), "on" | "yes")),
                )
            }
            Substitution::Python { id } => {
                let answer = self.ask_python(json!({"ask": "perform", "id": id}))?;
                answer.as_str().unwrap_or_default().to_owned()
            }
        })
    }

    fn same(&mut self, a: &Text, b: &Text) -> Outcome<bool> {
        let (a, b) = (self.perform(a)?, self.perform(b)?);
        // Booleans and numbers are equal in any notation.
        if let (Some(a), Some(b)) = (truth(&a), truth(&b)) {
            return Ok(a == b);
        }
        Ok(match (a.trim().parse::<f64>(), b.trim().parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= 1e-9 * a.abs().max(b.abs()),
            _ => a == b,
        })
    }

    fn no_configuration(&self, name: &str) -> Box<Diagnostic> {
        let known = self.context.configurations.keys().map(String::as_str);
        self.error("launch-configuration", format!("the launch configuration `{name}` is not set"))
            .suggest(name, known)
            .help(format!("declare the argument `{name}` before its use, or pass `{name}:=VALUE`"))
            .into()
    }

    /// Folder of a package, or a placeholder for a missing one.
    pub(crate) fn package(&mut self, name: &str, is_prefix: bool) -> String {
        match self.resolver.find_package(name, &self.context.file) {
            Ok(folder) if is_prefix => crate::python::prefix(&folder),
            Ok(folder) => folder.display().to_string(),
            Err(_) => {
                if self.missing_packages.insert(name.to_owned()) {
                    let missing = self
                        .note(
                            "launch-package",
                            format!("the package `{name}` is not on this machine"),
                        )
                        .note(format!(
                            "its files are written as `package://{name}/...` in the plan"
                        ))
                        .help(
                            "if it is on this machine, give its folder: `--resource-path FOLDER`",
                        );
                    self.found.push(missing);
                }
                format!("package://{name}")
            }
        }
    }

    /// Output of a program; empty, with a warning, when it or a file that it is given is in a
    /// missing package.
    pub(crate) fn command(&mut self, line: &str, on_stderr: &str) -> Outcome<String> {
        let printed = match self.ran(line)? {
            Ok(printed) => printed,
            Err(why) => {
                self.note_not_run(line, why, "its output is left empty in the plan", None);
                return Ok(String::new());
            }
        };
        let heard = self
            .warning("launch-command", format!("`{}` wrote to its standard error", short(line)))
            .note(printed.errors.trim().to_owned());
        match on_stderr {
            "fail" if !printed.errors.is_empty() => {
                let wrong = Diagnostic { severity: Severity::Error, ..heard };
                Err(wrong
                    .help("pass `on_stderr='warn'` to `Command` to continue nevertheless")
                    .into())
            }
            "warn" if !printed.errors.is_empty() => {
                self.found.push(heard);
                Ok(printed.output)
            }
            "capture" => Ok(printed.output + &printed.errors),
            _ => Ok(printed.output),
        }
    }

    /// Warns of a command that was not run. `instead` describes the consequence for the plan.
    pub(crate) fn note_not_run(
        &mut self,
        line: &str,
        why: NotRun,
        instead: &str,
        origin: Option<Origin>,
    ) {
        match why {
            NotRun::Refused(why) => {
                let finding = self
                    .warning("launch-command", format!("`{}` is not run: {why}", short(line)))
                    .note(instead);
                self.found.push(match origin {
                    Some(origin) => finding.at(origin),
                    None => finding,
                });
            }
            NotRun::Missing(input, why, errors) => {
                let message = format!("`{}` has no output: {why}; {instead}", short(line));
                self.note_missing(input, message, origin, &errors);
            }
        }
    }

    /// Output of a command; the reason when it cannot be run here.
    ///
    /// # Errors
    /// When it is not a command, or it fails.
    pub(crate) fn ran(&mut self, line: &str) -> Outcome<Result<Printed, NotRun>> {
        let Some(mut words) = words::split(line).filter(|words| !words.is_empty()) else {
            return Err(self
                .error("launch-command", format!("cannot parse the command `{line}`"))
                .help("close every quote")
                .into());
        };
        // The program may be built in.
        if let Some(word) = words[1..].iter().find(|word| word.starts_with("package://")) {
            let package = word["package://".len()..].split('/').next().unwrap_or_default();
            let why = format!("the package `{package}` is not on this machine");
            return Ok(Err(NotRun::Missing(MissingInput::Package, why, String::new())));
        }
        for word in &mut words[1..] {
            *word = self.in_sources(word);
        }
        let printed = match self.outside.run(&words) {
            Ok(printed) => printed,
            Err(error) => return Ok(Err(NotRun::Refused(error.to_string()))),
        };
        if let Some(missing) = printed.missing {
            let why = match missing {
                MissingInput::Package => "a package that it needs is not on this machine",
                MissingInput::File => "a file that it needs does not exist",
            };
            let errors = printed.errors.trim().to_owned();
            return Ok(Err(NotRun::Missing(missing, why.to_owned(), errors)));
        }
        if !printed.is_success {
            return Err(self
                .error("launch-command", format!("`{}` failed", short(line)))
                .note(printed.errors.trim().to_owned())
                .into());
        }
        Ok(Ok(printed))
    }

    fn find_program(&self, name: &str) -> String {
        let path = self.context.variable("PATH", self.host).unwrap_or_default();
        path.split(':')
            .map(|folder| Path::new(folder).join(name))
            .find(|program| self.host.kind(program) == Some(EntryKind::File))
            // The runner knows built-in programs, and reports missing ones.
            .map_or_else(|| name.to_owned(), |program| program.display().to_string())
    }

    /// Value of a Python expression, as text.
    pub(crate) fn expression(&mut self, expression: &str) -> Outcome<String> {
        let mut budget = Budget::new(MAX_STEPS, MAX_BYTES);
        let value = Expression::parse(expression)
            .and_then(|parsed| evaluate(&parsed, &EmptyScope, &mut budget))
            .and_then(|value| value.to_text(&mut budget));
        let error = match value {
            Ok(text) => return Ok(text),
            Err(error) => error,
        };
        // Python has more than the evaluator of xacro, which needs no interpreter.
        if !self.is_asking()
            && let Ok(answer) =
                self.ask_python(json!({"ask": "expression", "expression": expression}))
            && let Some(text) = answer.as_str()
        {
            return Ok(text.to_owned());
        }
        let mut wrong = self.error(
            "launch-expression",
            format!("cannot evaluate `{expression}`: {}", error.message),
        );
        if let Some(help) = error.help {
            wrong = wrong.help(help);
        }
        Err(wrong.into())
    }

    fn folder(&self) -> PathBuf {
        self.context.file.parent().map(Path::to_path_buf).unwrap_or_default()
    }

    pub(crate) fn scratch(&mut self, like: &str, text: &str) -> Outcome<String> {
        let name = Path::new(like).file_name().and_then(|name| name.to_str()).unwrap_or("file");
        match self.outside.scratch(name, text) {
            Ok(path) => Ok(path.display().to_string()),
            Err(why) => Err(self
                .error("launch-file", format!("cannot write a copy of {like}: {why}"))
                .into()),
        }
    }
}

/// Reason of a command without output.
pub(crate) enum NotRun {
    /// The program is not on this machine, or must not run.
    Refused(String),
    /// An input is missing on this machine: the reason, and its own errors.
    Missing(MissingInput, String, String),
}

/// Command with collapsed white space, for messages.
pub(crate) fn short(line: &str) -> String {
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Boolean in Python syntax, as launch files pass it on.
fn word(truth: bool) -> String {
    if truth { "True".into() } else { "False".into() }
}

/// Joins parts of a path as Python does: an absolute part restarts the path.
fn join_path(parts: &[String]) -> String {
    let mut whole = String::new();
    for part in parts {
        if part.starts_with('/') {
            whole.clear();
        } else if !whole.is_empty() && !whole.ends_with('/') {
            whole.push('/');
        }
        whole.push_str(part);
    }
    whole
}
