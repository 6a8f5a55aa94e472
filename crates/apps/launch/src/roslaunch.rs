//! ROS 1 launch files, with the rules of `roslaunch`: arguments belong to one file, a group has a
//! scope, parameters are on a server under full names.

mod arguments;
mod node;
mod parameters;
mod substitute;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Origin, Severity};
use periplus_xml::{Attribute, Document, Element};
use serde_json::Value;

use crate::context::within;
use crate::evaluate::{Evaluation, Outcome};
use crate::plan::{PlanVariable, What};
use crate::suggest::Suggest as _;
use crate::truth::truth;

/// Maximum depth of includes.
const MAX_DEPTH: usize = 50;

/// Maximum number of elements of a launch, with repeated includes.
const MAX_ELEMENTS: usize = 100_000;

/// Evaluates a file into a plan.
pub(crate) fn launch(
    evaluation: &mut Evaluation<'_>,
    file: &Path,
    given: &[(String, String)],
) -> Outcome<()> {
    let scope = Scope {
        file: file.to_path_buf(),
        namespace: "/".into(),
        given: given.iter().cloned().collect(),
        ..Scope::default()
    };
    let mut loader = Loader { evaluation, elements: 0, anonymous: BTreeMap::new(), next_step: 0 };
    loader.file(file, scope, 0)
}

/// Scope of a position in a file.
#[derive(Clone, Default)]
struct Scope {
    file: PathBuf,
    /// Absolute namespace.
    namespace: String,
    /// Arguments with a value.
    arguments: BTreeMap<String, String>,
    /// Arguments given by the including file or the command line.
    given: BTreeMap<String, String>,
    /// Depth of includes.
    depth: usize,
    /// True to pass undeclared arguments on silently.
    is_passing_all: bool,
    environment: BTreeMap<String, Option<String>>,
    /// Positions of environment changes, as `file:line`.
    changed_at: BTreeMap<String, String>,
    remaps: Vec<(String, String)>,
    /// Parameters `~name` for all later nodes.
    private: Vec<(String, Value)>,
}

struct Loader<'l, 'e> {
    evaluation: &'l mut Evaluation<'e>,
    elements: usize,
    /// Names of `$(anon ...)`: the same name gives the same result in all files.
    anonymous: BTreeMap<String, String>,
    next_step: usize,
}

impl Loader<'_, '_> {
    fn file(&mut self, path: &Path, mut scope: Scope, depth: usize) -> Outcome<()> {
        if depth == MAX_DEPTH {
            return Err(Diagnostic::error(
                "launch-include",
                format!("includes are nested more than {MAX_DEPTH} levels deep"),
            )
            .help("a file that includes itself needs an `if` that ends the recursion")
            .into());
        }
        let document = self.read(path)?;
        let root = &document.root;
        scope.file = path.to_path_buf();
        scope.depth = depth;
        let before = std::mem::replace(&mut self.evaluation.context.file, path.to_path_buf());
        self.children(root, &mut scope, depth)?;
        self.evaluation.context.file = before;
        if !scope.is_passing_all && depth > 0 {
            for name in scope.given.keys().filter(|name| !scope.arguments.contains_key(*name)) {
                let unused = Diagnostic::warning(
                    "launch-argument",
                    format!("{} has no argument `{name}`", path.display()),
                )
                .suggest(name, scope.arguments.keys().map(String::as_str));
                self.evaluation.found.push(unused);
            }
        }
        Ok(())
    }

    fn read(&mut self, path: &Path) -> Outcome<Document> {
        let text = self.evaluation.read(path)?;
        let (text, slips) = mended(&text);
        let name = path.display().to_string();
        let file = self.evaluation.sources.add(name.as_str(), text);
        for at in slips {
            let slip = Diagnostic::warning("launch-xml", "`/-->` is not the end of a comment")
                .at(self.evaluation.sources.whole(file).part(at + 2, at + 4))
                .help("it is read as `/>`");
            self.evaluation.found.push(slip);
        }
        let mut findings = periplus_diagnostics::Diagnostics::new();
        let document = periplus_xml::parse(file, self.evaluation.sources, &mut findings);
        self.evaluation.found.append(findings);
        match document {
            Some(document) if document.root.local_name() == "launch" => Ok(document),
            Some(document) => Err(Diagnostic::error(
                "launch-root",
                format!("the root element must be `<launch>`, not `<{}>`", document.root.name),
            )
            .at(document.root.name_origin())
            .into()),
            None => Err(Diagnostic::error("launch-xml", format!("{name} is not valid XML"))
                .help("correct the XML error that is shown before this one")
                .into()),
        }
    }

    fn children(&mut self, parent: &Element, scope: &mut Scope, depth: usize) -> Outcome<()> {
        if let Some(deprecated) = parent.value("deprecated") {
            let message =
                Diagnostic::warning("launch-deprecated", deprecated).at(parent.name_origin());
            self.evaluation.found.push(message);
        }
        for element in parent.elements() {
            self.elements += 1;
            if self.elements > MAX_ELEMENTS {
                return Err(Diagnostic::error(
                    "launch-size",
                    format!("this launch has more than {MAX_ELEMENTS} elements"),
                )
                .at(element.name_origin())
                .into());
            }
            if self.is_wanted(element, scope)? {
                self.element(element, scope, depth)?;
            }
        }
        Ok(())
    }

    /// Evaluates `if` and `unless` of an element.
    fn is_wanted(&mut self, element: &Element, scope: &Scope) -> Outcome<bool> {
        let (only_if, unless) = (element.attribute("if"), element.attribute("unless"));
        if only_if.is_some() && unless.is_some() {
            return Err(wrong("launch-condition", "use `if` or `unless`, not both", element));
        }
        for (attribute, wanted) in [(only_if, true), (unless, false)] {
            if let Some(attribute) = attribute {
                return Ok(self.truth(attribute, scope)? == wanted);
            }
        }
        Ok(true)
    }

    fn truth(&mut self, attribute: &Attribute, scope: &Scope) -> Outcome<bool> {
        let said = self.resolved(attribute, scope)?;
        truth(&said).ok_or_else(|| {
            Diagnostic::error(
                "launch-condition",
                format!("`{}` must be `true`, `1`, `false` or `0`, not `{said}`", attribute.name),
            )
            .at(attribute.value_origin)
            .into()
        })
    }

    fn element(&mut self, element: &Element, scope: &mut Scope, depth: usize) -> Outcome<()> {
        match element.local_name() {
            "arg" => self.argument(element, scope),
            "param" => self.parameter(element, scope),
            "rosparam" => self.rosparam(element, scope),
            "remap" => {
                let pair =
                    (self.needed(element, "from", scope)?, self.needed(element, "to", scope)?);
                scope.remaps.push(pair);
                Ok(())
            }
            "env" => {
                let (name, value) =
                    (self.needed(element, "name", scope)?, self.needed(element, "value", scope)?);
                self.set_variable(element, scope, name, value);
                Ok(())
            }
            "group" => {
                let mut inner = scope.clone();
                self.enter(element, &mut inner)?;
                self.children(element, &mut inner, depth)?;
                // The scope of an argument is the whole file.
                scope.arguments = inner.arguments;
                Ok(())
            }
            "include" => self.include(element, scope, depth),
            "node" => self.node(element, scope),
            "machine" => {
                let name = element.value("name").unwrap_or_default();
                self.left(
                    element,
                    &format!(
                        "`<machine name=\"{name}\">` is ignored: programs are not started on other machines; start \
                         them there with `roslaunch`, and open this run to them with `--ros1=network`"
                    ),
                );
                Ok(())
            }
            "test" => {
                self.left(element, "`<test>` is for rostest; a launch does not run it");
                Ok(())
            }
            other => {
                const KNOWN: [&str; 10] = [
                    "arg", "env", "group", "include", "machine", "node", "param", "remap",
                    "rosparam", "test",
                ];
                let unknown =
                    Diagnostic::warning("launch-element", format!("unknown element `<{other}>`"))
                        .at(element.name_origin())
                        .suggest(other, KNOWN);
                self.evaluation.found.push(unknown);
                Ok(())
            }
        }
    }

    /// Namespace and cleared parameters of a group or an included file.
    fn enter(&mut self, element: &Element, scope: &mut Scope) -> Outcome<()> {
        if let Some(namespace) = self.optional(element, "ns", scope)? {
            scope.namespace = within(&scope.namespace, &namespace);
        }
        if let Some(clear) = element.attribute("clear_params")
            && self.truth(clear, scope)?
        {
            let under = format!("{}/", scope.namespace.trim_end_matches('/'));
            self.evaluation.plan.parameters.retain(|name, _| !name.starts_with(&under));
        }
        Ok(())
    }

    fn include(&mut self, element: &Element, scope: &Scope, depth: usize) -> Outcome<()> {
        let file = self.needed(element, "file", scope)?;
        let mut inner = scope.clone();
        self.enter(element, &mut inner)?;
        inner.given = BTreeMap::new();
        inner.is_passing_all = match element.attribute("pass_all_args") {
            Some(attribute) => self.truth(attribute, scope)?,
            None => false,
        };
        if inner.is_passing_all {
            inner.given.extend(scope.given.clone());
            inner.given.extend(scope.arguments.clone());
        }
        for child in element.elements() {
            if !self.is_wanted(child, scope)? {
                continue;
            }
            match child.local_name() {
                "arg" => {
                    let name = self.needed(child, "name", scope)?;
                    let value = match self.optional(child, "value", scope)? {
                        Some(value) => value,
                        None => self.needed(child, "default", scope)?,
                    };
                    inner.given.insert(name, value);
                }
                "env" => {
                    let (name, value) =
                        (self.needed(child, "name", scope)?, self.needed(child, "value", scope)?);
                    self.set_variable(child, &mut inner, name, value);
                }
                other => {
                    let message = format!("unknown element `<{other}>` in `<include>`");
                    let finding =
                        Diagnostic::warning("launch-element", message).at(child.name_origin());
                    self.evaluation.found.push(finding);
                }
            }
        }
        if file.starts_with("package://") {
            let arguments = std::mem::take(&mut inner.given);
            let what = What::Include { file, arguments };
            self.step(element, &inner, what);
            return Ok(());
        }
        let folder = scope.file.parent().map(Path::to_path_buf).unwrap_or_default();
        let path = folder.join(&file);
        if self.evaluation.host.kind(&path).is_none() {
            let (file, origin) = (path.display().to_string(), Some(element.name_origin()));
            self.evaluation.note_missing_file(&file, "the plan has its name only", origin);
            let arguments = std::mem::take(&mut inner.given);
            self.step(element, &inner, What::Include { file, arguments });
            return Ok(());
        }
        inner.arguments = BTreeMap::new();
        self.file(&path, inner, depth + 1).map_err(|mut inside| {
            if inside.span.is_none() && inside.related.is_empty() {
                *inside = inside.clone().at(element.name_origin());
            }
            inside
        })
    }

    fn optional(
        &mut self,
        element: &Element,
        name: &str,
        scope: &Scope,
    ) -> Outcome<Option<String>> {
        element.attribute(name).map(|attribute| self.resolved(attribute, scope)).transpose()
    }

    fn needed(&mut self, element: &Element, name: &str, scope: &Scope) -> Outcome<String> {
        self.optional(element, name, scope)?.ok_or_else(|| {
            wrong("launch-attribute", &format!("`<{}>` needs `{name}`", element.name), element)
        })
    }

    fn left(&mut self, element: &Element, why: &str) {
        let finding = Diagnostic::new(Severity::Hint, "launch-left", why).at(element.name_origin());
        self.evaluation.found.push(finding);
    }

    fn set_variable(&self, element: &Element, scope: &mut Scope, name: String, value: String) {
        if let Some(written) = self.written(element) {
            scope.changed_at.insert(name.clone(), written);
        }
        scope.environment.insert(name, Some(value));
    }

    /// Position of an element: `file:line`.
    fn written(&self, element: &Element) -> Option<String> {
        element.name_origin().0.map(|span| {
            let (file, position) = self.evaluation.sources.locate(span);
            format!("{file}:{}", position.line)
        })
    }

    fn step(&mut self, element: &Element, scope: &Scope, what: What) {
        let id = self.next_step;
        self.next_step += 1;
        let change = |(name, value): (&String, &Option<String>)| {
            let written = scope.changed_at.get(name).cloned();
            (name.clone(), PlanVariable { value: value.clone(), written })
        };
        let environment = scope.environment.iter().map(change).collect();
        let written = self.written(element);
        let step = crate::plan::PlanStep { id, after: Vec::new(), what, written, environment };
        self.evaluation.plan.steps.push(step);
    }
}

fn wrong(code: &'static str, message: &str, element: &Element) -> Box<Diagnostic> {
    Diagnostic::error(code, message).at(element.name_origin()).into()
}

fn wrong_at(code: &'static str, message: String, origin: &Origin) -> Box<Diagnostic> {
    Diagnostic::error(code, message).at(*origin).into()
}

/// Replaces `/-->` outside a comment by `/>`, a typing error of a tutorial; returns the positions.
fn mended(text: &str) -> (String, Vec<usize>) {
    let mut out = text.to_owned();
    let mut slips = Vec::new();
    let mut at = 0;
    while let Some(found) = text[at..].find("/-->") {
        let slip = at + found;
        let is_in_comment =
            text[..slip].rfind("<!--").is_some_and(|open| !text[open..slip].contains("-->"));
        if !is_in_comment {
            out.replace_range(slip..slip + 4, "  />");
            slips.push(slip);
        }
        at = slip + 4;
    }
    (out, slips)
}
