//! State shared by all parts of an expansion.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap};
use smol_str::SmolStr;

use crate::scopes::{ScopeId, Scopes};
use crate::setting::XacroContext;
use periplus_python_expr::{Budget, Value};

/// Maximum number of steps of all expressions of a file together. The PR2, one of the largest robots, takes
/// some ten thousand.
const MAX_STEPS: u64 = 1_000_000;

/// Maximum size of the values made by all expressions of a file together [bytes].
const MAX_VALUE_BYTES: u64 = 256 << 20;

/// Number of errors after which an expansion ends: later ones are mostly consequences.
const MAX_ERRORS: usize = 30;

/// State shared by all parts of an expansion.
pub(crate) struct State<'a> {
    pub(crate) setting: XacroContext<'a>,
    pub(crate) sources: RefCell<&'a mut SourceMap>,
    pub(crate) diagnostics: RefCell<&'a mut Diagnostics>,
    pub(crate) scopes: RefCell<Scopes>,
    pub(crate) arguments: RefCell<BTreeMap<String, String>>,
    /// Arguments that the file declares or reads.
    pub(crate) known_arguments: RefCell<BTreeSet<String>>,
    /// The files being read, outermost first.
    pub(crate) files: RefCell<Vec<PathBuf>>,
    pub(crate) includes: RefCell<Vec<PathBuf>>,
    /// Lazy properties being evaluated, outermost first.
    pub(crate) resolving: RefCell<Vec<Resolving>>,
    pub(crate) depth: Cell<usize>,
    pub(crate) budget: RefCell<Budget>,
    /// Number of nodes visited.
    pub(crate) parts: Cell<usize>,
    /// Number of open elements, macros and includes.
    pub(crate) nesting: Cell<usize>,
    /// Bytes of text written.
    pub(crate) written: Cell<usize>,
    /// Bytes of files read.
    pub(crate) read: Cell<usize>,
    /// YAML files that were loaded.
    pub(crate) yaml: RefCell<BTreeMap<PathBuf, Value>>,
    /// Set when a limit was reached and the expansion must end.
    pub(crate) given_up: Cell<bool>,
    /// Origin of the text being evaluated, for warnings from inside expressions.
    pub(crate) place: Cell<Origin>,
}

/// A lazy property that is being evaluated.
pub(crate) struct Resolving {
    pub(crate) holder: ScopeId,
    pub(crate) name: SmolStr,
    pub(crate) origin: Origin,
}

/// Error token: an evaluation failed and the diagnostic is recorded.
#[derive(Debug)]
pub(crate) struct Failed;

impl<'a> State<'a> {
    pub(crate) fn new(
        setting: XacroContext<'a>,
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
            budget: RefCell::new(Budget::new(MAX_STEPS, MAX_VALUE_BYTES)),
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

    /// Reports an error and returns the error token.
    #[inline(never)]
    pub(crate) fn fail(&self, diagnostic: Diagnostic) -> Failed {
        self.report(diagnostic);
        Failed
    }

    /// Reports an error that ends the whole expansion: a limit was reached, and the next element would
    /// reach it again.
    #[inline(never)]
    pub(crate) fn give_up(&self, diagnostic: Diagnostic) -> Failed {
        self.given_up.set(true);
        self.fail(diagnostic)
    }

    /// Returns true if the expansion must end.
    pub(crate) fn has_given_up(&self) -> bool {
        self.given_up.get() || self.diagnostics.borrow().errors() >= MAX_ERRORS
    }

    /// Folder that relative names in the current file refer to.
    pub(crate) fn folder(&self) -> PathBuf {
        let files = self.files.borrow();
        files.last().and_then(|file| file.parent()).map(PathBuf::from).unwrap_or_default()
    }

    /// Runs code that may evaluate texts, on the budget of the expression that called it.
    pub(crate) fn with_budget<T>(&self, budget: &mut Budget, run: impl FnOnce() -> T) -> T {
        self.budget.replace(std::mem::take(budget));
        let result = run();
        *budget = self.budget.take();
        result
    }
}
