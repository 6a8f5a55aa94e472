//! Scopes of names: properties, blocks, macros.
//!
//! Scopes form a tree: the file, the namespaces of includes, and one scope for each macro call, which is a
//! child of the *caller's* scope. Names are looked up from the inside out.

use std::collections::BTreeMap;
use std::rc::Rc;

use periplus_diagnostics::{ContextId, Origin};
use periplus_xml::{Element, XmlNode};
use smol_str::SmolStr;

use crate::parameters::Parameter;
use periplus_python_expr::Value;

/// Index of a scope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ScopeId(usize);

/// Scope of the file itself.
pub(crate) const TOP: ScopeId = ScopeId(0);

/// Meaning of a name. Names of blocks start with `*` or `**`.
#[derive(Clone, Debug)]
pub(crate) enum Symbol {
    /// A value.
    Value(Value),
    /// Text that is evaluated on first use.
    Lazy(Rc<LazyText>),
    /// Elements for `insert_block`.
    Block(Block),
    /// An include's namespace.
    Namespace(ScopeId),
}

/// Text of a property that has not been evaluated yet.
#[derive(Debug)]
pub(crate) struct LazyText {
    pub(crate) text: SmolStr,
    pub(crate) origin: Origin,
}

/// Elements to insert, and their call context if they were not expanded yet.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub(crate) nodes: Rc<Vec<XmlNode>>,
    pub(crate) context: Option<ContextId>,
}

/// A macro.
#[derive(Debug)]
pub(crate) struct Macro {
    pub(crate) name: SmolStr,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) definition: Element,
}

#[derive(Debug, Default)]
struct Scope {
    parent: Option<ScopeId>,
    is_namespace: bool,
    symbols: BTreeMap<SmolStr, Symbol>,
    macros: BTreeMap<SmolStr, Rc<Macro>>,
}

/// All open scopes.
#[derive(Debug)]
pub(crate) struct Scopes {
    scopes: Vec<Scope>,
}

impl Scopes {
    pub(crate) fn new() -> Self {
        Self { scopes: vec![Scope::default()] }
    }

    /// Opens the scope of a macro call.
    pub(crate) fn open(&mut self, parent: ScopeId) -> ScopeId {
        self.scopes.push(Scope { parent: Some(parent), ..Scope::default() });
        ScopeId(self.scopes.len() - 1)
    }

    /// Closes the scope of a macro call and the namespaces of the includes in it. No reference to them can
    /// exist outside.
    pub(crate) fn close(&mut self, scope: ScopeId) {
        self.scopes.truncate(scope.0);
    }

    /// Opens the namespace of an include and names it in `scope`.
    pub(crate) fn open_namespace(&mut self, scope: ScopeId, name: &str) -> ScopeId {
        self.scopes.push(Scope { parent: Some(scope), is_namespace: true, ..Scope::default() });
        let namespace = ScopeId(self.scopes.len() - 1);
        self.set(scope, name.into(), Symbol::Namespace(namespace));
        namespace
    }

    pub(crate) fn set(&mut self, scope: ScopeId, name: SmolStr, symbol: Symbol) {
        self.scopes[scope.0].symbols.insert(name, symbol);
    }

    pub(crate) fn define(&mut self, scope: ScopeId, definition: Macro) {
        self.scopes[scope.0].macros.insert(definition.name.clone(), Rc::new(definition));
    }

    /// Removes a name from a scope and all scopes around it.
    pub(crate) fn remove(&mut self, scope: ScopeId, name: &str) {
        let mut next = Some(scope);
        while let Some(at) = next {
            self.scopes[at.0].symbols.remove(name);
            next = self.scopes[at.0].parent;
        }
    }

    /// Innermost meaning of a name, and the scope that holds it.
    pub(crate) fn find(&self, scope: ScopeId, name: &str) -> Option<(ScopeId, &Symbol)> {
        self.outwards(scope)
            .find_map(|at| self.scopes[at.0].symbols.get(name).map(|symbol| (at, symbol)))
    }

    /// Member of a namespace, without the scopes around it.
    pub(crate) fn member(&self, namespace: ScopeId, name: &str) -> Option<&Symbol> {
        self.scopes[namespace.0].symbols.get(name)
    }

    /// Names in a namespace, without blocks and without the scopes around it.
    pub(crate) fn member_names(&self, namespace: ScopeId) -> Vec<String> {
        let names = self.scopes[namespace.0].symbols.keys();
        names.filter(|name| !name.starts_with('*')).map(ToString::to_string).collect()
    }

    /// Scope of a property with `scope="parent"`: the next outer scope; from a macro call, the next one
    /// outside all namespaces.
    pub(crate) fn parent(&self, scope: ScopeId) -> Option<ScopeId> {
        let mut parent = self.scopes[scope.0].parent?;
        if !self.scopes[scope.0].is_namespace {
            while self.scopes[parent.0].is_namespace {
                parent = self.scopes[parent.0].parent?;
            }
        }
        Some(parent)
    }

    /// Macro by its name, which may contain namespaces (`ns.name`), and the scope in which its call is
    /// expanded.
    pub(crate) fn find_macro(&self, scope: ScopeId, name: &str) -> Option<(ScopeId, Rc<Macro>)> {
        if let Some(found) = self.nearest_macro(scope, name) {
            return Some((scope, found));
        }
        let mut path: Vec<&str> = name.split('.').collect();
        let name = path.pop()?;
        let mut at = scope;
        for step in path {
            match self.find(at, step)?.1 {
                Symbol::Namespace(namespace) => at = *namespace,
                _ => return None,
            }
        }
        self.nearest_macro(at, name).map(|found| (at, found))
    }

    fn nearest_macro(&self, scope: ScopeId, name: &str) -> Option<Rc<Macro>> {
        self.outwards(scope).find_map(|at| self.scopes[at.0].macros.get(name).cloned())
    }

    /// All visible names, without blocks.
    pub(crate) fn names(&self, scope: ScopeId) -> Vec<String> {
        let names = self.outwards(scope).flat_map(|at| self.scopes[at.0].symbols.keys());
        names.filter(|name| !name.starts_with('*')).map(ToString::to_string).collect()
    }

    /// All visible blocks, without their stars.
    pub(crate) fn block_names(&self, scope: ScopeId) -> Vec<String> {
        let names = self.outwards(scope).flat_map(|at| self.scopes[at.0].symbols.keys());
        names.filter(|name| name.starts_with('*')).map(|name| name.replace('*', "")).collect()
    }

    /// All visible macros.
    pub(crate) fn macro_names(&self, scope: ScopeId) -> Vec<String> {
        let names = self.outwards(scope).flat_map(|at| self.scopes[at.0].macros.keys());
        names.map(ToString::to_string).collect()
    }

    fn outwards(&self, scope: ScopeId) -> impl Iterator<Item = ScopeId> + '_ {
        std::iter::successors(Some(scope), |at| self.scopes[at.0].parent)
    }
}
