//! Position of an expansion: scope and call context.

use periplus_diagnostics::{ContextId, Origin};

use crate::scopes::ScopeId;

/// Position of an expansion: the names that are visible and the calls and includes around it.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    /// Scope in which names are looked up.
    pub(crate) scope: ScopeId,
    /// Macro call or include that is being expanded; `None` keeps the context of the origins themselves.
    pub(crate) context: Option<ContextId>,
}

impl Frame {
    /// Returns the origin with the context of this frame.
    pub(crate) fn seen(self, origin: Origin) -> Origin {
        match self.context {
            Some(context) => Origin(origin.0.map(|span| span.within(context))),
            None => origin,
        }
    }
}
