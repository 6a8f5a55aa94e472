//! Poses along chains of frames.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;

use super::scope::{Scope, report_unknown, splits};
use crate::pose::Reference;

/// Frame that a pose is relative to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Base<'a> {
    /// The model or world itself.
    Root,
    /// A frame by name.
    Frame(&'a Reference),
}

impl<'a> Base<'a> {
    pub(super) fn or_root(relative_to: &'a Option<Reference>) -> Self {
        relative_to.as_ref().map_or(Self::Root, Self::Frame)
    }
}

/// Named frame with its pose as written.
#[derive(Clone, Debug)]
pub(super) struct Vertex<'a> {
    pub(super) name: &'a str,
    pub(super) local: Pose,
    pub(super) base: Base<'a>,
    /// Nested frames, if it is a model.
    pub(super) inside: Option<&'a Scope>,
}

impl<'a> Vertex<'a> {
    pub(super) fn new(name: &'a str, local: Pose, base: Base<'a>) -> Self {
        Self { name, local, base, inside: None }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    /// On the path from the frame that is being resolved.
    Open,
    Done,
}

/// Pose of every vertex in the model or world frame. Every vertex has at most one base, so a chain is
/// followed to its end and back, without recursion: files may be hostile.
pub(super) fn resolve(
    scope: &Scope,
    vertices: &[Vertex<'_>],
    diagnostics: &mut Diagnostics,
) -> Vec<Pose> {
    let mut index = BTreeMap::new();
    for (at, vertex) in vertices.iter().enumerate() {
        index.entry(vertex.name).or_insert(at);
    }
    let mut poses: Vec<Pose> = vertices.iter().map(|vertex| vertex.local).collect();
    let mut states = vec![State::New; vertices.len()];
    let mut chain = Vec::new();
    let mut named = None;
    for start in 0..vertices.len() {
        if states[start] == State::New {
            states[start] = State::Open;
            chain.push(start);
        }
        while let Some(&at) = chain.last() {
            let vertex = &vertices[at];
            match find(vertex.base, scope, vertices, &index) {
                Found::Vertex(base, inside) => match states[base] {
                    State::New => {
                        states[base] = State::Open;
                        chain.push(base);
                        continue;
                    }
                    State::Open => report_cycle(&chain, base, vertices, diagnostics),
                    State::Done => poses[at] = poses[base] * inside * vertex.local,
                },
                Found::Root => {}
                Found::Nothing(frame) => {
                    // The names are not in the scope yet; they are used as suggestions only.
                    let named = named.get_or_insert_with(|| {
                        let mut named = Scope::new(scope.root);
                        named.fill(vertices, &poses);
                        named
                    });
                    report_unknown(frame, named, diagnostics);
                }
            }
            states[at] = State::Done;
            chain.pop();
        }
    }
    poses
}

enum Found<'a> {
    Root,
    /// Vertex, and the frame's pose in it if it is a frame of a nested model.
    Vertex(usize, Pose),
    Nothing(&'a Reference),
}

fn find<'a>(
    base: Base<'a>,
    scope: &Scope,
    vertices: &[Vertex<'_>],
    index: &BTreeMap<&str, usize>,
) -> Found<'a> {
    let Base::Frame(frame) = base else { return Found::Root };
    if frame.name == scope.root {
        return Found::Root;
    }
    if let Some(&at) = index.get(&*frame.name) {
        return Found::Vertex(at, Pose::IDENTITY);
    }
    let nested = splits(&frame.name).find_map(|(model, rest)| {
        let at = *index.get(model)?;
        Some(Found::Vertex(at, vertices[at].inside?.parent_from(rest)?))
    });
    nested.unwrap_or(Found::Nothing(frame))
}

fn report_cycle(
    chain: &[usize],
    back_to: usize,
    vertices: &[Vertex<'_>],
    diagnostics: &mut Diagnostics,
) {
    let start = chain.iter().position(|at| *at == back_to).unwrap_or(0);
    let circle = &chain[start..];
    let shown = circle.iter().take(10).chain([&back_to]);
    let names = shown.map(|at| format!("`{}`", vertices[*at].name)).collect::<Vec<_>>();
    let mut finding = Diagnostic::error("frame-cycle", "these frames form a cycle")
        .note(format!("{} depends on itself", names.join(" -> ")));
    if let Some(Base::Frame(last)) = chain.last().map(|at| vertices[*at].base) {
        finding = finding.at(last.origin);
    }
    // The finding is located at the last frame of the circle.
    for at in circle.iter().take(circle.len() - 1).take(10) {
        if let Base::Frame(frame) = vertices[*at].base {
            finding =
                finding.related(frame.origin, format!("`{}` depends on this", vertices[*at].name));
        }
    }
    diagnostics.push(finding);
}
