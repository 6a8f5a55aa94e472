//! What is shared by all of an expansion.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap};
use smol_str::SmolStr;

use crate::scopes::{ScopeId, Scopes};
use crate::setting::Setting;
use periplus_python_expr::{Budget, Value};

/// Steps that all expressions of a file may take together; the PR2, as large as robots get, takes
/// some ten thousand.
const MOST_STEPS: u64 = 1_000_000;

/// Bytes of values that all expressions of a file may make together.
const MOST_BYTES: u64 = 256 << 20;

/// Errors after which an expansion gives up: what follows is mostly echo.
const MOST_ERRORS: usize = 30;

/// What is shared by all of an expansion.
pub(crate) struct State<'a> {
    pub(crate) setting: Setting<'a>,
    pub(crate) sources: RefCell<&'a mut SourceMap>,
    pub(crate) diagnostics: RefCell<&'a mut Diagnostics>,
    pub(crate) scopes: RefCell<Scopes>,
    pub(crate) arguments: RefCell<BTreeMap<String, String>>,
    /// Names of arguments that the file declares or reads.
    pub(crate) known_arguments: RefCell<BTreeSet<String>>,
    /// The files being read, outermost first.
    pub(crate) files: RefCell<Vec<PathBuf>>,
    pub(crate) includes: RefCell<Vec<PathBuf>>,
    /// Lazy properties being evaluated, outermost first.
    pub(crate) resolving: RefCell<Vec<Resolving>>,
    pub(crate) depth: Cell<usize>,
    pub(crate) budget: RefCell<Budget>,
    /// Nodes looked at so far.
    pub(crate) parts: Cell<usize>,
    /// Elements, macros and includes that are open.
    pub(crate) nesting: Cell<usize>,
    /// Bytes of text put together so far.
    pub(crate) written: Cell<usize>,
    /// Bytes of files read so far.
    pub(crate) read: Cell<usize>,
    /// YAML files read so far.
    pub(crate) yaml: RefCell<BTreeMap<PathBuf, Value>>,
    /// Whether going on makes no sense: a limit was reached.
    pub(crate) given_up: Cell<bool>,
    /// The place of the text being evaluated: where warnings from within expressions belong.
    pub(crate) place: Cell<Origin>,
}

/// A lazy property that is being evaluated.
pub(crate) struct Resolving {
    pub(crate) holder: ScopeId,
    pub(crate) name: SmolStr,
    pub(crate) origin: Origin,
}

/// An evaluation failed, and a diagnostic says so.
#[derive(Debug)]
pub(crate) struct Failed;

impl<'a> State<'a> {
    pub(crate) fn new(
        setting: Setting<'a>,
        sources: &'a mut SourceMap,
        diagnostics: &'a mut Diagnostics,
    ) -> Self {
        let arguments = setting.arguments.iter().cloned().collect();
        let file = setting.path.clone();
        Self {
            setting,
            sources: RefCell::new(sources),
            diagnostics: RefCell::new(diagnostics),
            scopes: RefCell::new(Scopes::new()),
            arguments: RefCell::new(arguments),
            known_arguments: RefCell::default(),
            files: RefCell::new(vec![file]),
            includes: RefCell::default(),
            resolving: RefCell::default(),
            depth: Cell::new(0),
            budget: RefCell::new(Budget::new(MOST_STEPS, MOST_BYTES)),
            parts: Cell::new(0),
            nesting: Cell::new(0),
            written: Cell::new(0),
            read: Cell::new(0),
            yaml: RefCell::default(),
            given_up: Cell::new(false),
            place: Cell::new(Origin::default()),
        }
    }

    pub(crate) fn report(&self, diagnostic: Diagnostic) {
        self.diagnostics.borrow_mut().push(diagnostic);
    }

    /// Reports an error and gives the token of failure.
    #[inline(never)]
    pub(crate) fn fail(&self, diagnostic: Diagnostic) -> Failed {
        self.report(diagnostic);
        Failed
    }

    /// Reports an error after which the whole expansion ends: a limit was reached, and what comes
    /// next would reach it again.
    #[inline(never)]
    pub(crate) fn give_up(&self, diagnostic: Diagnostic) -> Failed {
        self.given_up.set(true);
        self.fail(diagnostic)
    }

    /// Whether the expansion shall end here.
    pub(crate) fn has_given_up(&self) -> bool {
        self.given_up.get() || self.diagnostics.borrow().errors() >= MOST_ERRORS
    }

    /// The folder that relative names in the file being read start from.
    pub(crate) fn folder(&self) -> PathBuf {
        let files = self.files.borrow();
        files.last().and_then(|file| file.parent()).map(PathBuf::from).unwrap_or_default()
    }

    /// Runs something that may evaluate texts, on the budget of the expression that asked for it.
    pub(crate) fn with_budget<T>(&self, budget: &mut Budget, run: impl FnOnce() -> T) -> T {
        self.budget.replace(std::mem::take(budget));
        let result = run();
        *budget = self.budget.take();
        result
    }
}
