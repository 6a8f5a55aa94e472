//! Bounds on what evaluating may cost, so that no file can hang or exhaust the program.

use super::error::{ExpressionError, Outcome};

/// How deep evaluation may nest: operators in operands, lambdas in calls, properties in properties.
/// Each level costs a few hundred bytes of stack; threads of 2 MiB must hold them all.
const MAX_DEPTH: u32 = 220;

/// What is left to spend on evaluating. Nothing is given back, so one budget bounds the total work of all
/// expressions it is handed to, including properties that are evaluated while looking up a name.
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
    /// A budget of so many evaluation steps and so many bytes of created values.
    pub fn new(steps: u64, bytes: u64) -> Self {
        Self { steps_left: steps, bytes_left: bytes, depth: 0 }
    }

    /// Steps not yet spent.
    pub fn steps_left(&self) -> u64 {
        self.steps_left
    }

    /// Bytes not yet spent.
    pub fn bytes_left(&self) -> u64 {
        self.bytes_left
    }

    /// Spends one step.
    pub(super) fn step(&mut self) -> Outcome<()> {
        self.steps(1)
    }

    /// Spends several steps.
    pub(super) fn steps(&mut self, count: u64) -> Outcome<()> {
        if count > self.steps_left {
            self.steps_left = 0;
            return Err(ExpressionError::new("evaluating this takes too many steps")
                .with_help("shorten the ranges or comprehensions; expressions are bounded so that no file can hang the program"));
        }
        self.steps_left -= count;
        Ok(())
    }

    /// Spends the steps of looking through so many bytes of text.
    pub(super) fn scan(&mut self, bytes: usize) -> Outcome<()> {
        self.steps(1 + bytes as u64 / 64)
    }

    /// Spends the memory of a new value; to be called before allocating it.
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

    /// Spends the memory of a list of so many values.
    pub(super) fn allocate_values(&mut self, count: usize) -> Outcome<()> {
        self.allocate(count as u128 * size_of::<super::Value>() as u128 + 32)
    }

    /// Goes one level deeper; every success needs a [`Budget::leave`].
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

    /// Comes back from a level.
    pub(super) fn leave(&mut self) {
        self.depth -= 1;
    }
}
