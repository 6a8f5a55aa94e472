//! The frames of one model or world by name.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, MOST_KEPT};
use periplus_geometry::Pose;

use super::graph::Vertex;
use crate::pose::Reference;

/// The frames of one model or world, and of the models in it.
#[derive(Debug)]
pub(crate) struct Scope {
    /// `__model__` or `world`.
    pub(crate) root: &'static str,
    poses: BTreeMap<String, Pose>,
    nested: BTreeMap<String, Scope>,
}

impl Scope {
    pub(crate) fn new(root: &'static str) -> Self {
        Self { root, poses: BTreeMap::new(), nested: BTreeMap::new() }
    }

    pub(super) fn fill(&mut self, vertices: &[Vertex<'_>], poses: &[Pose]) {
        for (vertex, pose) in vertices.iter().zip(poses) {
            // Of a link and a joint of the same name the link, which comes first, counts.
            self.poses.entry(vertex.name.to_owned()).or_insert(*pose);
        }
    }

    pub(super) fn nest(&mut self, name: &str, scope: Self) {
        self.nested.insert(name.to_owned(), scope);
    }

    /// The pose of a frame by its scoped name, as seen from this model or world.
    pub(crate) fn parent_from(&self, name: &str) -> Option<Pose> {
        if name == self.root {
            return Some(Pose::IDENTITY);
        }
        if let Some(pose) = self.poses.get(name) {
            return Some(*pose);
        }
        splits(name).find_map(|(model, rest)| {
            let inner = self.nested.get(model)?.parent_from(rest)?;
            Some(*self.poses.get(model)? * inner)
        })
    }

    /// The pose of what something is relative to; told and this scope's own frame where it is
    /// not known.
    pub(super) fn base(
        &self,
        relative_to: &Option<Reference>,
        diagnostics: &mut Diagnostics,
    ) -> Pose {
        let Some(frame) = relative_to else { return Pose::IDENTITY };
        self.parent_from(&frame.name).unwrap_or_else(|| {
            tell_unknown(frame, self, diagnostics);
            Pose::IDENTITY
        })
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.root).chain(self.poses.keys().map(String::as_str))
    }
}

/// `a::b::c` as `(a, b::c)`, then `(a::b, c)`.
pub(super) fn splits(name: &str) -> impl Iterator<Item = (&str, &str)> {
    // Models are never deeper in each other than this.
    name.match_indices("::").take(64).map(|(at, _)| (&name[..at], &name[at + 2..]))
}

pub(super) fn tell_unknown(frame: &Reference, scope: &Scope, diagnostics: &mut Diagnostics) {
    let told =
        Diagnostic::error("unknown-frame", format!("there is no frame `{}` here", frame.name))
            .at(frame.origin);
    // Looking for near names takes a while, and more than so many findings are only counted.
    let told =
        if diagnostics.errors() < MOST_KEPT { with_candidates(told, frame, scope) } else { told };
    diagnostics.push(told);
}

/// Names at most so many frames in a message.
const MOST_NAMED: usize = 12;

pub(super) fn with_candidates(told: Diagnostic, frame: &Reference, scope: &Scope) -> Diagnostic {
    let names: Vec<&str> = scope.names().take(MOST_NAMED + 1).collect();
    let shown = names.iter().take(MOST_NAMED).map(|name| format!("`{name}`"));
    let mut list = shown.collect::<Vec<_>>().join(", ");
    if names.len() > MOST_NAMED {
        list.push_str(", ...");
    }
    told.note(format!("frames here are {list}")).did_you_mean(
        frame.origin,
        &frame.name,
        scope.names().take(1000),
    )
}
