//! Queues of the cells that wait for an update.

/// The cells of the current block, of the next block, and those above the threshold.
#[derive(Debug, Default)]
pub(super) struct Front {
    current: Vec<u32>,
    next: Queue,
    over: Queue,
    /// Cells that were deferred, with their potentials; see [`key`].
    deferred: Vec<u64>,
    /// Cells to resume, the lowest potential last.
    resumed: Vec<u64>,
    /// Cells whose priority is not below it wait until the lower ones are done.
    pub(crate) threshold: f32,
}

/// Queue that is appended without a branch. NavFn loses cells beyond 10,000 in a queue; this one does not.
#[derive(Debug, Default)]
pub(super) struct Queue {
    cells: Vec<u32>,
    len: usize,
}

/// Key of a cell by its potential: the bits of numbers that are not negative have their order.
fn key(potential: f32, cell: u32) -> u64 {
    (u64::from(potential.to_bits()) << 32) | u64::from(cell)
}

/// Space that [`Front::queue_for`] ensures: one for each neighbour.
const PUSH_COUNT: usize = 4;

impl Queue {
    /// Appends a cell if a condition holds. At most [`PUSH_COUNT`] cells after each [`Front::queue_for`].
    #[inline(always)]
    pub(crate) fn push_if(&mut self, cell: u32, condition: bool) {
        if let Some(slot) = self.cells.get_mut(self.len) {
            *slot = cell;
            self.len += usize::from(condition);
        }
    }

    /// Appends cells whose condition holds, at most once after each [`Front::queue_for`].
    #[inline(always)]
    pub(crate) fn push_all(&mut self, cells: [u32; PUSH_COUNT], conditions: [bool; PUSH_COUNT]) {
        let Some(slots) = self.cells[self.len..].first_chunk_mut::<PUSH_COUNT>() else { return };
        let mut count = 0;
        for (cell, condition) in cells.into_iter().zip(conditions) {
            slots[count % PUSH_COUNT] = cell;
            count += usize::from(condition);
        }
        self.len += count;
    }

    fn take(&mut self, spare: Vec<u32>) -> Vec<u32> {
        let mut cells = std::mem::replace(&mut self.cells, spare);
        cells.truncate(self.len);
        self.len = 0;
        cells
    }
}

impl Front {
    /// Empties all queues.
    pub(crate) fn reset(&mut self, threshold: f32) {
        self.current.clear();
        (self.next.len, self.over.len) = (0, 0);
        self.deferred.clear();
        self.resumed.clear();
        self.threshold = threshold;
    }

    /// Keeps a cell of a potential for [`Self::resume`].
    pub(crate) fn defer(&mut self, potential: f32, cell: u32) {
        self.deferred.push(key(potential, cell));
    }

    /// Returns true if cells are deferred.
    pub(crate) fn has_deferred(&self) -> bool {
        !self.deferred.is_empty()
    }

    /// Starts again with the deferred cells, in the order of their potentials. Cells that still wait follow
    /// where the threshold is now, or are dropped.
    pub(crate) fn resume(&mut self, keeps_waiting: bool) {
        let mut resumed = std::mem::take(&mut self.resumed);
        resumed.append(&mut self.deferred);
        if keeps_waiting {
            resumed.extend(self.waiting().map(|cell| key(self.threshold, cell)));
        }
        resumed.sort_unstable_by(|a, b| b.cmp(a));
        self.reset(0.0);
        self.resumed = resumed;
        self.take_resumed();
    }

    /// Moves resumed cells below the threshold to the current block; raises it to the first if no other waits.
    fn take_resumed(&mut self) {
        let potential = |key: u64| f32::from_bits((key >> 32) as u32);
        if let (true, Some(first)) = (self.current.is_empty(), self.resumed.last()) {
            self.threshold = self.threshold.max(potential(*first).next_up());
        }
        while let Some(last) = self.resumed.pop_if(|last| potential(*last) < self.threshold) {
            self.current.push(last as u32);
        }
    }

    /// Adds a cell to the first block.
    pub(crate) fn seed(&mut self, cell: u32) {
        self.current.push(cell);
    }

    /// Returns true if the current and the next block are empty.
    pub(crate) fn is_empty(&self) -> bool {
        self.current.is_empty() && self.next.len == 0
    }

    /// Iterates over all cells that wait.
    pub(crate) fn waiting(&self) -> impl Iterator<Item = u32> {
        let queues = [&self.next, &self.over].into_iter();
        let waiting = queues.flat_map(|queue| &queue.cells[..queue.len]);
        waiting.chain(&self.current).copied()
    }

    /// Takes the cells of the current block.
    pub(crate) fn begin_block(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.current)
    }

    /// Makes the next block the current one; where it is empty, the cells above the threshold, which rises.
    /// Gets the cells of the last block, whose memory is used again.
    pub(crate) fn end_block(&mut self, done: Vec<u32>, threshold_step: f32) {
        self.current = self.next.take(done);
        if self.current.is_empty() {
            self.threshold += threshold_step;
            let spare = std::mem::take(&mut self.current);
            self.current = self.over.take(spare);
            self.take_resumed();
        }
    }

    /// Returns the queue for cells that a cell of this priority offers, with space for [`PUSH_COUNT`].
    #[inline(always)]
    pub(crate) fn queue_for(&mut self, priority: f32) -> &mut Queue {
        let queue = if priority < self.threshold { &mut self.next } else { &mut self.over };
        if queue.len + PUSH_COUNT > queue.cells.len() {
            grow(queue);
        }
        queue
    }
}

#[cold]
fn grow(queue: &mut Queue) {
    let count = (2 * queue.cells.len()).max(queue.cells.capacity()).max(1024);
    queue.cells.resize(count, 0);
}
