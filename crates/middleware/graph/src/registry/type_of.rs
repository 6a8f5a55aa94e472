//! Types of topics and services, by name and hash.

use crate::{GraphError, TypeClash};

/// The type of a topic or service.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TypeOf {
    pub(crate) name: String,
    pub(crate) hash: Option<String>,
}

impl TypeOf {
    /// Refuses another type. Hashes are compared if both are known.
    pub(super) fn check(
        &self,
        what: &'static str,
        name: &str,
        from: &str,
        asked: &Self,
        node: &str,
    ) -> Result<(), GraphError> {
        let same_hash = match (&self.hash, &asked.hash) {
            (Some(has), Some(asked)) => has == asked,
            _ => true,
        };
        if self.name == asked.name && same_hash {
            return Ok(());
        }
        let describe = |type_of: &Self| match (&type_of.hash, same_hash) {
            (Some(hash), false) if self.name == asked.name => {
                format!("{} with the hash {hash}", type_of.name)
            }
            _ => type_of.name.clone(),
        };
        Err(GraphError::Type(Box::new(TypeClash {
            what,
            name: name.to_owned(),
            has: describe(self),
            has_node: from.to_owned(),
            asked: describe(asked),
            asked_node: node.to_owned(),
        })))
    }
}
