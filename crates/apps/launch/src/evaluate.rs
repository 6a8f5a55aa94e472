//! Evaluation of a launch file into a plan: conditions, substitutions and includes, in the order of
//! the file.

mod node;
mod parameters;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Diagnostics, Origin, Severity, SourceMap};
use periplus_resources::{Host, Resolver, in_sources, package_of};
use serde_json::{Value, json};

use crate::context::{Context, within};
use crate::ending::ShutdownHandlers;
use crate::front;
use crate::outside::{Interpreter, MissingInput, Outside};
use crate::plan::{Argument, LaunchPlan, PlanParameters, PlanStep, Trigger, What};
use crate::python;
use crate::suggest::Suggest as _;
use crate::tree::{Action, ActionKind, Condition, Event, Given, Names, Place, Text};
use crate::truth::value_of;

/// Maximum depth of includes.
const MAX_DEPTH: usize = 50;

/// Maximum number of actions of a launch: real ones have hundreds.
const MAX_ACTIONS: usize = 100_000;

/// Maximum nesting of actions: real ones have about ten levels. Stops functions that return
/// themselves and groups in groups before the stack overflows.
const MAX_NESTING: usize = 150;

pub(crate) type Outcome<T> = Result<T, Box<Diagnostic>>;

/// State of evaluating one launch.
pub(crate) struct Evaluation<'a> {
    pub(crate) host: &'a dyn Host,
    pub(crate) resolver: &'a Resolver<'a>,
    pub(crate) outside: &'a mut dyn Outside,
    pub(crate) sources: &'a mut SourceMap,
    pub(crate) found: Diagnostics,
    pub(crate) plan: LaunchPlan,
    pub(crate) context: Context,
    pub(crate) missing_packages: BTreeSet<String>,
    python: Option<Box<dyn Interpreter>>,
    /// True while the interpreter handles a request.
    is_asking: bool,
    /// Event handlers, in order of registration.
    later: VecDeque<EventHandler>,
    /// Functions of the launch file to call at shutdown.
    at_end: Vec<Value>,
    /// Position of the current action.
    place: Place,
    /// Triggers of the current actions.
    after: Vec<Trigger>,
    /// Step indices of actions, by action number.
    steps: BTreeMap<u64, usize>,
    next_step: usize,
    next_name: usize,
    depth: usize,
    nesting: usize,
    actions: usize,
    is_over: bool,
}

/// Actions that wait for an event.
struct EventHandler {
    after: Vec<Trigger>,
    actions: Vec<Action>,
    /// Launch file that contains them.
    file: PathBuf,
    /// Configurations at registration, for those that are gone at the event.
    configurations: Names,
}

impl<'a> Evaluation<'a> {
    pub(crate) fn new(
        host: &'a dyn Host,
        resolver: &'a Resolver<'a>,
        outside: &'a mut dyn Outside,
        sources: &'a mut SourceMap,
    ) -> Self {
        Self {
            host,
            resolver,
            outside,
            sources,
            found: Diagnostics::new(),
            plan: LaunchPlan::default(),
            context: Context::default(),
            missing_packages: BTreeSet::new(),
            python: None,
            is_asking: false,
            later: VecDeque::new(),
            at_end: Vec::new(),
            place: Place::default(),
            after: Vec::new(),
            steps: BTreeMap::new(),
            next_step: 0,
            next_name: 0,
            depth: 0,
            nesting: 0,
            actions: 0,
            is_over: false,
        }
    }

    /// Evaluates a launch file of ROS 2.
    pub(crate) fn launch(&mut self, file: &Path, given: &[(String, String)]) -> Outcome<()> {
        if self.depth == MAX_DEPTH {
            return Err(self
                .error(
                    "launch-include",
                    format!("includes are nested more than {MAX_DEPTH} levels deep"),
                )
                .help("a file that includes itself needs a condition that ends the recursion")
                .into());
        }
        let before = std::mem::replace(&mut self.context.file, file.to_path_buf());
        self.depth += 1;
        let outcome = self.actions_of(file).and_then(|actions| {
            self.missing_arguments(&actions, file, given)?;
            self.run_all(&actions)
        });
        self.depth -= 1;
        self.context.file = before;
        outcome
    }

    /// Evaluates event handlers: as in `launch`, after all other actions, with the configurations,
    /// environment and scopes of that time.
    pub(crate) fn events(&mut self) -> Outcome<()> {
        while let Some(EventHandler { after, actions, file, configurations }) =
            self.later.pop_front()
        {
            let is_at_end = after.contains(&Trigger::Shutdown);
            if self.is_over && !is_at_end {
                continue;
            }
            self.after = after;
            self.context.file = file;
            for (name, value) in configurations {
                self.context.configurations.entry(name).or_insert(value);
            }
            self.run_all(&actions)?;
        }
        self.after.clear();
        Ok(())
    }

    /// Interpreter with the functions to call at shutdown.
    pub(crate) fn ending(&mut self) -> ShutdownHandlers {
        let calls = std::mem::take(&mut self.at_end);
        ShutdownHandlers { interpreter: self.python.take().filter(|_| !calls.is_empty()), calls }
    }

    /// Actions of a file.
    pub(crate) fn actions_of(&mut self, file: &Path) -> Outcome<Vec<Action>> {
        if file.extension().is_some_and(|extension| extension == "py") {
            let file = file.display().to_string();
            let answer = self.ask_python(json!({"ask": "load", "file": file}))?;
            return self.decode(answer);
        }
        let text = self.read(file)?;
        front::read(file, &text, self.sources, &mut self.found)
    }

    /// Reports required arguments that were not given, before anything runs.
    fn missing_arguments(
        &mut self,
        actions: &[Action],
        file: &Path,
        given: &[(String, String)],
    ) -> Outcome<()> {
        for action in actions {
            let ActionKind::Declare { name, default: None, description, .. } = &action.action_kind
            else {
                continue;
            };
            if self.context.configurations.contains_key(name) || action.condition.is_some() {
                continue;
            }
            self.place = action.place.clone();
            let description = self.perform_some(description.as_ref())?;
            let names: Vec<&str> = given.iter().map(|(name, _)| name.as_str()).collect();
            let mut wrong = self.error(
                "launch-argument",
                format!("{} requires the argument `{name}`", file.display()),
            );
            wrong = wrong.caused_by(DiagnosticCause::MissingArgument);
            if let Some(description) = description.filter(|text| !text.is_empty()) {
                wrong = wrong.note(format!("description: {description}"));
            }
            if !names.is_empty() {
                wrong = wrong.note(format!("given: {}", names.join(", ")));
            }
            return Err(wrong.help(format!("add `{name}:=VALUE`")).into());
        }
        Ok(())
    }

    pub(crate) fn run_all(&mut self, actions: &[Action]) -> Outcome<()> {
        if self.nesting == MAX_NESTING {
            return Err(self
                .error(
                    "launch-size",
                    format!("actions are nested more than {MAX_NESTING} levels deep"),
                )
                .help(
                    "a function or group that returns itself needs a condition that ends the recursion",
                )
                .into());
        }
        self.nesting += 1;
        let outcome = self.run_each(actions);
        self.nesting -= 1;
        outcome
    }

    fn run_each(&mut self, actions: &[Action]) -> Outcome<()> {
        for action in actions {
            if self.is_over {
                break;
            }
            self.actions += 1;
            if self.actions > MAX_ACTIONS {
                return Err(self
                    .error(
                        "launch-size",
                        format!("this launch has more than {MAX_ACTIONS} actions"),
                    )
                    .into());
            }
            self.place = action.place.clone();
            let holds = match &action.condition {
                Some(condition) => self.holds(condition)?,
                None => true,
            };
            if holds {
                self.run(action)?;
            }
        }
        Ok(())
    }

    /// Evaluates a condition.
    pub(crate) fn holds(&mut self, condition: &Condition) -> Outcome<bool> {
        match condition {
            Condition::If { text } => self.truth_of(text),
            Condition::Unless { text } => Ok(!self.truth_of(text)?),
            Condition::Configuration { name, equals, is_negated } => {
                let wanted = self.perform_some(equals.as_ref())?;
                let value = self.context.configurations.get(name);
                let holds = match wanted {
                    Some(wanted) => value == Some(&wanted),
                    None => value.is_some(),
                };
                Ok(holds != *is_negated)
            }
            Condition::Python { id } => {
                let answer = self.ask_python(json!({"ask": "holds", "id": id}))?;
                Ok(answer.as_bool().unwrap_or_default())
            }
        }
    }

    fn run(&mut self, action: &Action) -> Outcome<()> {
        match &action.action_kind {
            ActionKind::Declare { name, default, description, choices } => {
                self.declare(name, default.as_ref(), description.as_ref(), choices)?;
            }
            ActionKind::Configure { name, value } => {
                let (name, value) = (self.perform(name)?, self.perform(value)?);
                self.context.configurations.insert(name, value);
            }
            ActionKind::Forget { name } => {
                let name = self.perform(name)?;
                self.context.configurations.remove(&name);
            }
            ActionKind::ForgetAll { keep } => {
                let kept = self.perform_pairs(keep)?;
                self.context.configurations = kept.into_iter().collect();
            }
            ActionKind::Environment { name, value } => {
                let (name, value) = (self.perform(name)?, self.perform(value)?);
                self.set_variable(name, Some(value));
            }
            ActionKind::Append { name, value, separator, prepend } => {
                let (name, value) = (self.perform(name)?, self.perform(value)?);
                let separator =
                    self.perform_some(separator.as_ref())?.unwrap_or_else(|| ":".into());
                let joined = match self.context.variable(&name, self.host) {
                    Some(there) if !there.is_empty() && *prepend => {
                        format!("{value}{separator}{there}")
                    }
                    Some(there) if !there.is_empty() => format!("{there}{separator}{value}"),
                    _ => value,
                };
                self.set_variable(name, Some(joined));
            }
            ActionKind::Unset { name } => {
                let name = self.perform(name)?;
                self.set_variable(name, None);
            }
            ActionKind::ResetEnvironment => {
                self.context.environment.clear();
                self.context.changed_at.clear();
            }
            ActionKind::Group { actions, is_scoped, is_forwarding, configurations } => {
                self.group(actions, *is_scoped, *is_forwarding, configurations)?;
            }
            ActionKind::ForEach { function } => {
                let answer = self.ask_python(json!({"ask": "for_each", "id": function}))?;
                let actions: Vec<Action> = self.decode(answer)?;
                self.run_all(&actions)?;
            }
            ActionKind::Include { file, arguments } => self.include(file, arguments)?,
            // Runs at shutdown, when the results of the launch are no longer needed.
            ActionKind::Call { function } if self.after.contains(&Trigger::Shutdown) => {
                let context = json!(self.context.snapshot());
                self.at_end.push(json!({"ask": "call", "id": function, "context": context}));
            }
            ActionKind::Call { function } => {
                let answer = self.ask_python(json!({"ask": "call", "id": function}))?;
                let actions: Vec<Action> = self.decode(answer)?;
                self.run_all(&actions)?;
            }
            ActionKind::PushNamespace { namespace } => {
                let namespace = self.perform(namespace)?;
                self.context.namespace = within(&self.context.namespace, &namespace);
            }
            ActionKind::SetParameter { name, value } => {
                let (name, value) = (self.perform(name)?, self.value(value)?);
                self.context
                    .parameters
                    .push(PlanParameters::Values(BTreeMap::from([(name, value)])));
            }
            ActionKind::SetParametersFromFile { file, node: _ } => {
                let file = self.perform(file)?;
                self.context.parameters.push(PlanParameters::File(file));
            }
            ActionKind::SetRemap { from, to } => {
                let pair = (self.perform(from)?, self.perform(to)?);
                self.context.remaps.push(pair);
            }
            ActionKind::Node(node) => {
                let id = self.step_of(action.id);
                let what = self.node(node)?;
                self.push(id, what);
                self.at_end_of(id, &node.running.on_exit);
            }
            ActionKind::Load { container, components } => {
                let what = self.load(container, components)?;
                let id = self.step_of(action.id);
                self.push(id, what);
            }
            ActionKind::Process(process) => {
                let id = self.step_of(action.id);
                let what = self.process(process)?;
                self.push(id, what);
                self.at_end_of(id, &process.running.on_exit);
            }
            ActionKind::Log { text, level } => {
                let text = self.perform(text)?;
                let level = self.perform_some(level.as_ref())?;
                let id = self.step_of(action.id);
                let level = level.map_or_else(|| "info".into(), |level| level.to_lowercase());
                self.push(id, What::Log { level, text });
            }
            ActionKind::Shutdown { reason } => {
                let reason = self.perform_some(reason.as_ref())?.unwrap_or_default();
                let id = self.step_of(action.id);
                self.push(id, What::Shutdown { reason });
                // Actions after it are not reached; event handlers may never run.
                self.is_over = self.after.is_empty();
            }
            ActionKind::Transition { target, transition } => {
                let step = target.map(|target| self.step_of(Some(target)));
                let id = self.step_of(action.id);
                self.push(id, What::Transition { step, transition: transition.clone() });
            }
            ActionKind::Timer { seconds, actions } => {
                let seconds = self.perform(seconds)?;
                let Some(seconds) = seconds.trim().parse().ok().filter(|s: &f64| *s >= 0.0) else {
                    return Err(self
                        .error("launch-timer", format!("`{seconds}` is not a number of seconds"))
                        .into());
                };
                self.run_after(Trigger::Seconds(seconds), actions);
            }
            ActionKind::When { event, actions } => {
                let trigger = match event {
                    Event::Started { of } => Trigger::Started(of.map(|of| self.step_of(Some(of)))),
                    Event::Ended { of } => Trigger::Ended(of.map(|of| self.step_of(Some(of)))),
                    Event::Printed { of } => Trigger::Printed(of.map(|of| self.step_of(Some(of)))),
                    Event::Reached { of, from, to } => Trigger::Reached {
                        step: of.map(|of| self.step_of(Some(of))),
                        from: from.clone(),
                        to: to.clone(),
                    },
                    Event::Shutdown => Trigger::Shutdown,
                };
                self.run_after(trigger, actions);
            }
            ActionKind::Left { what } => {
                let left = self
                    .warning("launch-left", format!("{what} is not part of the plan"))
                    .note("the rest of the file is");
                self.found.push(left);
            }
        }
        Ok(())
    }

    fn declare(
        &mut self,
        name: &str,
        default: Option<&Text>,
        description: Option<&Text>,
        choices: &[String],
    ) -> Outcome<()> {
        let default = self.perform_some(default)?;
        let description = self.perform_some(description)?.filter(|text| !text.is_empty());
        let given = self.context.configurations.get(name).cloned();
        let Some(value) = given.or_else(|| default.clone()) else {
            return Err(self
                .error("launch-argument", format!("the argument `{name}` was not given"))
                .caused_by(DiagnosticCause::MissingArgument)
                .help(format!("add `{name}:=VALUE`"))
                .into());
        };
        if !choices.is_empty() && !choices.contains(&value) {
            return Err(self
                .error(
                    "launch-argument",
                    format!(
                        "the argument `{name}` must be one of {}, not `{value}`",
                        choices.join(", ")
                    ),
                )
                .suggest(&value, choices.iter().map(String::as_str))
                .into());
        }
        self.context.configurations.insert(name.to_owned(), value.clone());
        if self.plan.arguments.iter().all(|known| known.name != name) {
            self.plan.arguments.push(Argument {
                name: name.to_owned(),
                description,
                default,
                choices: choices.to_vec(),
                value: Some(value),
            });
        }
        Ok(())
    }

    fn group(
        &mut self,
        actions: &[Action],
        is_scoped: bool,
        is_forwarding: bool,
        configurations: &[(Text, Text)],
    ) -> Outcome<()> {
        let configurations = self.perform_pairs(configurations)?;
        if !is_scoped {
            self.context.configurations.extend(configurations);
            return self.run_all(actions);
        }
        let before = self.context.clone();
        if !is_forwarding {
            self.context.configurations.clear();
        }
        self.context.configurations.extend(configurations);
        let outcome = self.run_all(actions);
        self.context = before;
        outcome
    }

    /// Includes a file. Its declarations and settings stay in effect, as in `launch`.
    fn include(&mut self, file: &Text, arguments: &[(Text, Text)]) -> Outcome<()> {
        let file = self.perform(file)?;
        let arguments = self.perform_pairs(arguments)?;
        let path = match self.context.file.parent() {
            Some(folder) if !file.starts_with("package://") => folder.join(&file),
            _ => Path::new(&file).to_path_buf(),
        };
        let (path, file) = match self.unbuilt(&path) {
            Some(generated) => (path, generated),
            None => (path, file),
        };
        if file.starts_with("package://") {
            let id = self.step_of(None);
            let arguments = arguments.into_iter().collect();
            self.push(id, What::Include { file, arguments });
            return Ok(());
        }
        if self.host.kind(&path).is_none() {
            let file = path.display().to_string();
            self.note_missing_file(&file, "the plan has its name only", None);
            let id = self.step_of(None);
            let arguments = arguments.into_iter().collect();
            self.push(id, What::Include { file, arguments });
            return Ok(());
        }
        let place = self.place.clone();
        self.context.configurations.extend(arguments.iter().cloned());
        self.launch(&path, &arguments)?;
        self.place = place;
        Ok(())
    }

    /// Package and name of a file that only a build creates, from `FILE.in` beside it, so that a
    /// built-in replacement can be found.
    pub(crate) fn unbuilt(&self, path: &Path) -> Option<String> {
        if self.host.kind(path).is_some() {
            return None;
        }
        let mut template = path.as_os_str().to_owned();
        template.push(".in");
        self.host.kind(Path::new(&template))?;
        let (package, inner) = package_of(self.host, path)?;
        Some(format!("package://{package}/{inner}"))
    }

    /// Records an input that is missing on this machine. Planning continues without it; a launch
    /// that is to run refuses to start.
    pub(crate) fn note_missing(
        &mut self,
        input: MissingInput,
        message: String,
        origin: Option<Origin>,
        errors: &str,
    ) {
        let mut finding = self.warning(input.code(), message).caused_by(input.cause());
        if let Some(origin) = origin {
            finding = finding.at(origin);
        }
        if !errors.is_empty() {
            finding = finding.note(errors.to_owned());
        }
        let finding = finding.help(match input {
            MissingInput::Package => {
                "give the folder that contains the package with `--resource-path FOLDER`, or add it to the \
                 workspace"
            }
            MissingInput::File => "check the path; a generated file must exist before the launch",
        });
        // A file needed by several actions is reported for each of them.
        if self.found.iter().all(|known| *known != finding) {
            self.found.push(finding);
        }
    }

    /// Records that a file is missing on this machine.
    pub(crate) fn note_missing_file(&mut self, file: &str, instead: &str, origin: Option<Origin>) {
        let rest = file.strip_prefix("package:/").map(|rest| rest.trim_start_matches('/'));
        let package = rest.and_then(|rest| rest.split('/').next());
        let (input, why) = match package {
            Some(package) => {
                (MissingInput::Package, format!("the package `{package}` is not on this machine"))
            }
            None => (MissingInput::File, "there is no such file".to_owned()),
        };
        self.note_missing(input, format!("{file} cannot be read: {why}; {instead}"), origin, "");
    }

    /// Text of a file; `None`, with a warning, if it is missing. `instead` describes the
    /// consequence for the plan.
    pub(crate) fn read_or_miss(
        &mut self,
        file: &Path,
        instead: &str,
        origin: Option<Origin>,
    ) -> Outcome<Option<String>> {
        let found = in_sources(self.host, file);
        let file = found.as_deref().unwrap_or(file);
        if self.host.kind(file).is_some() {
            return self.read(file).map(Some);
        }
        self.note_missing_file(&file.display().to_string(), instead, origin);
        Ok(None)
    }

    /// Path of a file in the sources of its package, if the build of the package would install it
    /// at this path.
    pub(crate) fn in_sources(&self, path: &str) -> String {
        let found = in_sources(self.host, Path::new(path));
        found.map_or_else(|| path.to_owned(), |found| found.display().to_string())
    }

    fn run_after(&mut self, trigger: Trigger, actions: &[Action]) {
        let mut after = self.after.clone();
        after.push(trigger);
        self.later.push_back(EventHandler {
            after,
            actions: actions.to_vec(),
            file: self.context.file.clone(),
            configurations: self.context.configurations.clone(),
        });
    }

    /// Sets an environment variable, and records the position.
    fn set_variable(&mut self, name: String, value: Option<String>) {
        if let Some(written) = self.written() {
            self.context.changed_at.insert(name.clone(), written);
        }
        self.context.environment.insert(name, value);
    }

    /// Sets the position of findings, and returns the previous one.
    pub(crate) fn set_place(&mut self, place: Place) -> Place {
        std::mem::replace(&mut self.place, place)
    }

    /// Position of the current action: `file:line`.
    fn written(&self) -> Option<String> {
        match &self.place {
            Place { line: Some(line), .. } => Some(line.clone()),
            Place { span: Some(span), .. } => {
                let (file, position) = self.sources.locate(*span);
                Some(format!("{file}:{}", position.line))
            }
            _ => None,
        }
    }

    fn at_end_of(&mut self, id: usize, actions: &[Action]) {
        if !actions.is_empty() {
            self.run_after(Trigger::Ended(Some(id)), actions);
        }
    }

    /// Step index of an action, also of a later one.
    fn step_of(&mut self, action: Option<u64>) -> usize {
        let next = self.next_step;
        let id = match action {
            Some(action) => *self.steps.entry(action).or_insert(next),
            None => next,
        };
        self.next_step = self.next_step.max(id + 1);
        id
    }

    fn push(&mut self, id: usize, what: What) {
        let step = PlanStep {
            id,
            after: self.after.clone(),
            what,
            written: self.written(),
            environment: self.context.changes(),
        };
        self.plan.steps.push(step);
    }

    /// Unique name in this launch; the same in every launch.
    pub(crate) fn anonymous(&mut self, name: &str) -> String {
        self.next_name += 1;
        format!("{name}_{}", self.next_name)
    }

    pub(crate) fn parameter_for_all(&mut self, name: &str) -> Outcome<String> {
        let set = self.context.parameters.iter().rev().find_map(|parameters| match parameters {
            PlanParameters::Values(values) => values.get(name),
            PlanParameters::File(_) => None,
        });
        match set {
            Some(Value::String(text)) => Ok(text.clone()),
            Some(value) => Ok(value.to_string()),
            None => Err(self
                .error("launch-parameter", format!("no global parameter `{name}` was set"))
                .help("set it with `SetParameter` before this line")
                .into()),
        }
    }

    pub(crate) fn read(&mut self, file: &Path) -> Outcome<String> {
        let found = in_sources(self.host, file);
        let file = found.as_deref().unwrap_or(file);
        let bytes = self.host.read(file).map_err(|why| {
            let shown = file.display().to_string();
            let wrong = self.error("launch-file", format!("{shown} cannot be read: {why}"));
            match shown.strip_prefix("package://").and_then(|rest| rest.split('/').next()) {
                Some(package) => wrong.help(format!(
                    "the package `{package}` is not on this machine: give its folder, \
                     `--resource-path FOLDER`"
                )),
                None => wrong,
            }
        })?;
        String::from_utf8(bytes).map_err(|_| {
            self.error("launch-file", format!("{} is not UTF-8 text", file.display())).into()
        })
    }

    pub(crate) fn yaml(&mut self, name: &str, text: &str) -> Outcome<Value> {
        let file = self.sources.add(name, text);
        Ok(periplus_yaml::parse(file, self.sources)?.map_or(Value::Null, |node| value_of(&node)))
    }

    /// Sends a request to the Python interpreter with the current scope; applies its changes.
    pub(crate) fn ask_python(&mut self, mut request: Value) -> Outcome<Value> {
        if self.is_asking {
            // It is waiting for our answer, and cannot handle a request.
            return Err(self
                .error("launch-python", "an object defined in the launch file depends on itself")
                .help("a substitution or condition must not evaluate itself")
                .into());
        }
        let mut python = match self.python.take() {
            Some(python) => python,
            None => self
                .outside
                .python()
                .map_err(|error| self.error("launch-python", error.to_string()))?,
        };
        request["context"] = json!(self.context.snapshot());
        self.is_asking = true;
        let answer = python.ask(request, &mut |question| python::answer(self, &question));
        self.is_asking = false;
        self.python = Some(python);
        let answer = answer.map_err(|why| python::complaint(self, &why))?;
        if let Some(configurations) = answer.get("configurations") {
            self.context.configurations = self.decode(configurations.clone())?;
        }
        if let Some(environment) = answer.get("environment") {
            let changed: BTreeMap<String, Option<String>> = self.decode(environment.clone())?;
            let before = std::mem::take(&mut self.context.environment);
            // A file sets variables while it is loaded, and its functions where they are called.
            let written = self.written().unwrap_or_else(|| self.context.file.display().to_string());
            for (name, value) in &changed {
                if before.get(name) != Some(value) {
                    self.context.changed_at.insert(name.clone(), written.clone());
                }
            }
            self.context.environment = changed;
        }
        Ok(answer.get("answer").cloned().unwrap_or(Value::Null))
    }

    /// True while the Python interpreter handles a request, and accepts no other.
    pub(crate) const fn is_asking(&self) -> bool {
        self.is_asking
    }

    pub(crate) fn decode<T: serde::de::DeserializeOwned>(&self, value: Value) -> Outcome<T> {
        serde_json::from_value(value).map_err(|why| {
            self.error(
                "launch-python",
                format!("this launch file creates an unsupported object: {why}"),
            )
            .into()
        })
    }

    pub(crate) fn value(&mut self, given: &Given) -> Outcome<Value> {
        parameters::value(self, given)
    }

    pub(crate) fn error(&self, code: &'static str, message: impl Into<String>) -> Diagnostic {
        self.finding(Severity::Error, code, message.into())
    }

    pub(crate) fn warning(&self, code: &'static str, message: impl Into<String>) -> Diagnostic {
        self.finding(Severity::Warning, code, message.into())
    }

    pub(crate) fn note(&self, code: &'static str, message: impl Into<String>) -> Diagnostic {
        self.finding(Severity::Hint, code, message.into())
    }

    fn finding(&self, severity: Severity, code: &'static str, message: String) -> Diagnostic {
        let finding = Diagnostic::new(severity, code, message);
        match &self.place {
            Place { span: Some(span), .. } => finding.at(*span),
            Place { line: Some(line), .. } => finding.note(format!("written at {line}")),
            _ => finding,
        }
    }
}
