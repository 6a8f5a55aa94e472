//! `$(find pkg)`, `$(arg name)`, `$(env NAME)`, `$(optenv NAME default)`, `$(dirname)`, `$(cwd)`
//! and `$(eval expression)`.

use std::rc::Rc;

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Origin, closest};

use crate::evaluate::part;
use crate::scopes::ScopeId;
use crate::state::{Failed, State};
use periplus_python_expr::ExpressionDialect;

const COMMANDS: [&str; 7] = ["find", "arg", "env", "optenv", "dirname", "cwd", "eval"];

impl State<'_> {
    /// Replacement text of `$(...)`.
    #[inline(never)]
    pub(crate) fn extension(
        &self,
        text: &str,
        origin: Origin,
        scope: ScopeId,
    ) -> Result<Rc<str>, Failed> {
        if let Some(expression) = text.strip_prefix("eval ") {
            let place = part(origin, text, &(5..text.len()));
            let value = self.expression_value(
                expression,
                place,
                scope,
                ExpressionDialect::SubstitutionArgs,
            )?;
            return self.characters(&value, origin);
        }
        let text = self.text(text, origin, scope)?;
        let words: Vec<&str> = text.split(' ').filter(|word| !word.is_empty()).collect();
        self.substitution(&words, origin)
    }

    /// Replacement text of a command and its words.
    #[inline(never)]
    pub(crate) fn substitution(&self, words: &[&str], origin: Origin) -> Result<Rc<str>, Failed> {
        let (command, words) = words.split_first().unwrap_or((&"", &[]));
        let command = *command;
        let file_name = |path: &std::path::Path| Rc::from(path.to_string_lossy());
        match (command, words) {
            ("arg", [name]) => self.argument(name, origin).map(Rc::from),
            ("find", [package]) => self.package(package, origin).map(|path| file_name(&path)),
            ("env", [name]) => self.setting.host.variable(name).map(Rc::from).ok_or_else(|| {
                self.fail(
                    Diagnostic::error("unset-variable", format!("the environment variable `{name}` is not set"))
                        .at(origin)
                        .help(format!("set it, or write `$(optenv {name} DEFAULT)`")),
                )
            }),
            ("optenv", [name, default @ ..]) => {
                let value = self.setting.host.variable(name);
                Ok(value.unwrap_or_else(|| default.join(" ")).into())
            }
            ("dirname", []) => Ok(file_name(&self.folder())),
            ("cwd", []) => Ok(file_name(&self.setting.working_folder)),
            _ if COMMANDS.contains(&command) => Err(self.fail(
                Diagnostic::error(
                    "extension",
                    format!("`$({command} ...)` does not take {} words", words.len()),
                )
                .at(origin)
                .help("they are $(find PKG), $(arg NAME), $(env NAME), $(optenv NAME DEFAULT), $(dirname), $(cwd), $(eval EXPRESSION)"),
            )),
            _ => {
                let mut diagnostic =
                    Diagnostic::error("extension", format!("`$({command})` is not a substitution"))
                        .at(origin);
                diagnostic = match closest(command, COMMANDS) {
                    Some(near) => diagnostic.help(format!("did you mean `$({near} ...)`?")),
                    None => diagnostic
                        .help(format!("there are {}; write `$$(` for a plain `$(`", COMMANDS.join(", "))),
                };
                Err(self.fail(diagnostic))
            }
        }
    }

    /// The value of an argument of the file.
    #[inline(never)]
    pub(crate) fn argument(&self, name: &str, origin: Origin) -> Result<String, Failed> {
        self.known_arguments.borrow_mut().insert(name.to_owned());
        if let Some(value) = self.arguments.borrow().get(name) {
            return Ok(value.clone());
        }
        let arguments = self.arguments.borrow();
        let mut diagnostic =
            Diagnostic::error("undefined-argument", format!("the argument `{name}` has no value"))
                .caused_by(DiagnosticCause::Undefined)
                .at(origin)
                .help(format!(
                    "give it on the command line as `{name}:=VALUE`, or declare a default: \
             <xacro:arg name=\"{name}\" default=\"...\"/>"
                ));
        if let Some(near) = closest(name, arguments.keys().map(String::as_str)) {
            diagnostic = diagnostic.help(format!("did you mean `{near}`?"));
        }
        Err(self.fail(diagnostic))
    }
}
