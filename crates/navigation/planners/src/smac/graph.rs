//! Nodes of Hybrid-A*, by cell and heading.

use crate::cell_index::CellIndex;

/// Node of no parent, and slot of no node.
const NONE_INDEX: u32 = u32::MAX;

/// State of the search at a cell and heading.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SmacNode {
    /// Position \[cells\].
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// Heading \[bins\].
    pub(crate) bin: u16,
    /// Motion that leads here; none at the start and at goals.
    pub(crate) motion: Option<u16>,
    pub(crate) is_visited: bool,
    /// Cost from the start.
    pub(crate) g: f32,
    parent: u32,
}

impl SmacNode {
    /// Creates a node that no path has reached.
    pub(crate) fn new(x: f64, y: f64, bin: usize) -> Self {
        Self {
            x,
            y,
            bin: bin as u16,
            motion: None,
            is_visited: false,
            g: f32::INFINITY,
            parent: NONE_INDEX,
        }
    }

    /// Returns the node before it on the path.
    pub(crate) fn parent(&self) -> Option<usize> {
        (self.parent != NONE_INDEX).then_some(self.parent as usize)
    }

    /// Returns the node as it is reached by a motion.
    pub(crate) fn reached(self, g: f32, motion: u16, parent: usize) -> Self {
        Self { g, motion: Some(motion), parent: parent as u32, ..self }
    }
}

/// All nodes of a search. Memory is used for reached cells only.
#[derive(Debug, Default)]
pub(crate) struct SmacGraph {
    bin_count: usize,
    /// Block of a cell.
    blocks: CellIndex,
    /// Node by block and heading.
    by_bin: Vec<u32>,
    pub(crate) nodes: Vec<SmacNode>,
}

impl SmacGraph {
    /// Removes all nodes.
    pub(crate) fn reset(&mut self, cell_count: usize, bin_count: usize) {
        self.bin_count = bin_count;
        self.blocks.reset(cell_count);
        self.by_bin.clear();
        self.nodes.clear();
    }

    /// Returns the node at a cell and heading, which is created if there is none.
    pub(crate) fn node_at(&mut self, cell: usize, bin: usize, new: SmacNode) -> usize {
        let block = self.blocks.get(cell).unwrap_or_else(|| {
            let block = self.by_bin.len() / self.bin_count;
            self.by_bin.resize(self.by_bin.len() + self.bin_count, NONE_INDEX);
            self.blocks.insert(cell, block);
            block
        });
        let slot = &mut self.by_bin[block * self.bin_count + bin];
        if *slot == NONE_INDEX {
            *slot = self.nodes.len() as u32;
            self.nodes.push(new);
        }
        *slot as usize
    }

    /// Returns the nodes from one back to the start.
    pub(crate) fn backtrace(&self, from: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(from), |at| self.nodes[*at].parent()).take(self.nodes.len())
    }
}
