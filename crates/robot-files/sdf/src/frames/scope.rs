//! Frames of one model or world by name.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, MAX_FINDINGS};
use periplus_geometry::Pose;

use super::graph::Vertex;
use crate::pose::Reference;

/// Frames of one model or world and of nested models.
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
            // If a link and a joint share a name, the link, which comes first, is used.
            self.poses.entry(vertex.name.to_owned()).or_insert(*pose);
        }
    }

    pub(super) fn nest(&mut self, name: &str, scope: Self) {
        self.nested.insert(name.to_owned(), scope);
    }

    /// Pose of a frame by its scoped name, in this model's or world's frame.
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

    /// Pose of the base frame of a pose. An unknown frame is reported and replaced by this scope's own
    /// frame.
    pub(super) fn base(
        &self,
        relative_to: &Option<Reference>,
        diagnostics: &mut Diagnostics,
    ) -> Pose {
        let Some(frame) = relative_to else { return Pose::IDENTITY };
        self.parent_from(&frame.name).unwrap_or_else(|| {
            report_unknown(frame, self, diagnostics);
            Pose::IDENTITY
        })
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.root).chain(self.poses.keys().map(String::as_str))
    }
}

/// `a::b::c` as `(a, b::c)`, then `(a::b, c)`.
pub(super) fn splits(name: &str) -> impl Iterator<Item = (&str, &str)> {
    // Models are never nested deeper than this.
    name.match_indices("::").take(64).map(|(at, _)| (&name[..at], &name[at + 2..]))
}

pub(super) fn report_unknown(frame: &Reference, scope: &Scope, diagnostics: &mut Diagnostics) {
    let finding =
        Diagnostic::error("unknown-frame", format!("there is no frame `{}` here", frame.name))
            .at(frame.origin);
    // The search for similar names takes time, and further findings are only counted.
    let finding = if diagnostics.errors() < MAX_FINDINGS {
        with_candidates(finding, frame, scope)
    } else {
        finding
    };
    diagnostics.push(finding);
}

/// Maximum number of frames listed in a message.
const MAX_LISTED_FRAMES: usize = 12;

pub(super) fn with_candidates(finding: Diagnostic, frame: &Reference, scope: &Scope) -> Diagnostic {
    let names: Vec<&str> = scope.names().take(MAX_LISTED_FRAMES + 1).collect();
    let shown = names.iter().take(MAX_LISTED_FRAMES).map(|name| format!("`{name}`"));
    let mut list = shown.collect::<Vec<_>>().join(", ");
    if names.len() > MAX_LISTED_FRAMES {
        list.push_str(", ...");
    }
    finding.note(format!("frames here are {list}")).did_you_mean(
        frame.origin,
        &frame.name,
        scope.names().take(1000),
    )
}
