//! Work that is waiting, in a session.

use super::{Solving, Work};
use crate::graph::{Graph, Solver};
use crate::session::{Bytes, Fault, Pack, Reader, packed};

packed!(Work {
    proximity,
    prunable,
    proximity_m,
    solving,
    loose,
    is_strained,
    solved_at,
    proximity_count,
    searches,
    slices,
    map_revision,
    solves,
});

impl Pack for Solving {
    fn pack(&self, out: &mut Bytes) {
        let Self { solver, resumed, steps, size, trial } = self;
        solver.as_ref().map(Solver::state).or_else(|| resumed.clone()).pack(out);
        steps.pack(out);
        size.pack(out);
        trial.pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        Ok(Self {
            solver: None,
            resumed: Pack::unpack(from)?,
            steps: Pack::unpack(from)?,
            size: Pack::unpack(from)?,
            trial: Pack::unpack(from)?,
        })
    }
}

impl Work {
    /// True if all referenced keyframes and edges exist.
    pub(in crate::engine) fn fits(&self, graph: &Graph) -> bool {
        let (keyframes, edges) = (graph.poses.len(), graph.edges.len());
        self.proximity.iter().chain(&self.prunable).all(|&keyframe| keyframe < keyframes)
            && self.solving.iter().all(|it| {
                let (poses, count) = it.size;
                let edges = graph.edges.get(..count).unwrap_or_default();
                poses <= keyframes
                    && edges.len() == count
                    && edges.iter().all(|edge| edge.from.max(edge.to) < poses)
            })
            && self.solving.iter().flat_map(|it| &it.trial).all(|(poses, trial)| {
                poses.len() <= keyframes && trial.iter().all(|&edge| edge < edges)
            })
    }
}
