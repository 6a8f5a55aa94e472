//! Where an expansion stands.

use periplus_diagnostics::{ContextId, Origin};

use crate::scopes::ScopeId;

/// Where an expansion stands: the names it sees, and how it came there.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    /// Where names are looked up.
    pub(crate) scope: ScopeId,
    /// The macro call or include; none keeps what places say of theirs.
    pub(crate) context: Option<ContextId>,
}

impl Frame {
    /// A place as seen from here.
    pub(crate) fn seen(self, origin: Origin) -> Origin {
        match self.context {
            Some(context) => Origin(origin.0.map(|span| span.within(context))),
            None => origin,
        }
    }
}
