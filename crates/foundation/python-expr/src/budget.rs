//! Limits on the cost of an evaluation, so that no file can hang or exhaust the program.

use super::error::{ExpressionError, Outcome};

/// Maximum nesting depth of an evaluation: operators in operands, lambdas in calls, properties in
/// properties. Each level takes a few hundred bytes of stack; a thread with 2 MiB must be enough.
const MAX_DEPTH: u32 = 220;

/// Remaining cost of an evaluation. Nothing is refunded, so one budget limits the total work of all
/// expressions that use it, including properties that are evaluated while a name is looked up.
#[derive(Debug, Clone)]
pub struct Budget {
    steps_left: u64,
    bytes_left: u64,
    depth: u32,
}

impl Default for Budget {
    /// Two million steps and 64 MiB: far more than any robot needs, about a second at worst.
    fn default() -> Self {
        Self::new(2_000_000, 64 << 20)
    }
}

impl Budget {
    /// Budget with a number of evaluation steps and a size of created values [bytes].
    pub fn new(steps: u64, bytes: u64) -> Self {
        Self { steps_left: steps, bytes_left: bytes, depth: 0 }
    }

    /// Remaining steps.
    pub fn steps_left(&self) -> u64 {
        self.steps_left
    }

    /// Remaining size of created values [bytes].
    pub fn bytes_left(&self) -> u64 {
        self.bytes_left
    }

    /// Charges one step.
    pub(super) fn step(&mut self) -> Outcome<()> {
        self.steps(1)
    }

    /// Charges several steps.
    pub(super) fn steps(&mut self, count: u64) -> Outcome<()> {
        if count > self.steps_left {
            self.steps_left = 0;
            return Err(ExpressionError::new("evaluating this takes too many steps")
                .with_help("shorten the ranges or comprehensions; expressions are bounded so that no file can hang the program"));
        }
        self.steps_left -= count;
        Ok(())
    }

    /// Charges the steps of a search in a text of this length.
    pub(super) fn scan(&mut self, bytes: usize) -> Outcome<()> {
        self.steps(1 + bytes as u64 / 64)
    }

    /// Charges the memory of a new value; called before the allocation.
    pub(super) fn allocate(&mut self, bytes: u128) -> Outcome<()> {
        match u64::try_from(bytes).ok().and_then(|bytes| self.bytes_left.checked_sub(bytes)) {
            Some(left) => {
                self.bytes_left = left;
                Ok(())
            }
            None => Err(ExpressionError::new("evaluating this takes too much memory")
                .with_help("make the strings or lists shorter; expressions are bounded so that no file can exhaust the machine")),
        }
    }

    /// Charges the memory of a list of this length.
    pub(super) fn allocate_values(&mut self, count: usize) -> Outcome<()> {
        self.allocate(count as u128 * size_of::<super::Value>() as u128 + 32)
    }

    /// Enters a nesting level; every success needs a [`Budget::leave`].
    pub(super) fn enter(&mut self) -> Outcome<()> {
        if self.depth >= MAX_DEPTH {
            return Err(ExpressionError::new(format!(
                "this nests more than {MAX_DEPTH} levels deep"
            ))
            .with_help("is a lambda or a property calling itself without end?"));
        }
        self.depth += 1;
        Ok(())
    }

    /// Leaves a nesting level.
    pub(super) fn leave(&mut self) {
        self.depth -= 1;
    }
}
