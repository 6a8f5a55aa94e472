//! Slots of the cells that a search has reached.

/// Slot of a cell that was not reached.
const NO_SLOT: u32 = 0;

/// Map from cells to the nodes of a search, without a cost for cells that the search does not reach: only
/// these are cleared before the next search.
#[derive(Debug, Default)]
pub(crate) struct CellIndex {
    /// One more than the node, by cell.
    slots: Vec<u32>,
    reached: Vec<u32>,
}

impl CellIndex {
    /// Prepares for a search on a grid of this number of cells.
    pub(crate) fn reset(&mut self, cell_count: usize) {
        if self.slots.len() == cell_count {
            for cell in self.reached.drain(..) {
                self.slots[cell as usize] = NO_SLOT;
            }
        } else {
            // Zeroed memory costs nothing until it is used.
            self.slots = vec![NO_SLOT; cell_count];
            self.reached.clear();
        }
    }

    /// Returns the node of a cell.
    #[inline]
    pub(crate) fn get(&self, cell: usize) -> Option<usize> {
        (self.slots[cell] as usize).checked_sub(1)
    }

    /// Sets the node of a cell that has none.
    #[inline]
    pub(crate) fn insert(&mut self, cell: usize, node: usize) {
        self.slots[cell] = node as u32 + 1;
        self.reached.push(cell as u32);
    }
}
