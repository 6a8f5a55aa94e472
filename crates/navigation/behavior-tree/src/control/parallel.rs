//! `Parallel` and `ParallelAll`.

use std::collections::BTreeSet;

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Children that have finished.
#[derive(Default)]
struct Completed {
    children: BTreeSet<usize>,
    successes: usize,
    failures: usize,
}

impl Completed {
    fn insert(&mut self, child: usize, status: NodeStatus) {
        if status.is_completed() {
            self.children.insert(child);
        }
        self.successes += usize::from(status == NodeStatus::Success);
        self.failures += usize::from(status == NodeStatus::Failure);
    }
}

/// Threshold of a port; negative numbers count from the number of children plus one.
fn threshold(run: &NodeRun<'_>, ports: [&str; 2]) -> Result<usize, TreeError> {
    let [alias, port] = ports;
    let number = run.input_i64(alias).or_else(|| run.input_i64(port));
    let number = number.ok_or_else(|| run.missing(port))?;
    let count = i64::try_from(run.child_count()).unwrap_or(i64::MAX);
    let number = if number < 0 { (count + number + 1).max(0) } else { number };
    let number = usize::try_from(number).unwrap_or(usize::MAX);
    if number > run.child_count() {
        let children = run.child_count();
        return Err(run.error(format!("`{port}` is {number}, but there are {children} children")));
    }
    Ok(number)
}

/// Ticks all children that have not finished; done when enough of them have succeeded or failed.
///
/// Source: `parallel_node.cpp`.
#[derive(Default)]
pub(super) struct Parallel {
    completed: Completed,
}

impl BehaviorNode for Parallel {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let success_count = threshold(run, ["success_threshold", "success_count"])?;
        let failure_count = threshold(run, ["failure_threshold", "failure_count"])?;
        let counts_skipped = run.input_i64("success_threshold").or(run.input_i64("success_count"));
        let counts_skipped = counts_skipped.is_some_and(|count| count < 0);
        let count = run.child_count();
        run.set_running();
        let mut skipped = 0;
        for child in 0..count {
            if !self.completed.children.contains(&child) {
                let status = run.tick_child(child)?;
                skipped += usize::from(status == NodeStatus::Skipped);
                self.completed.insert(child, status);
            }
            let Completed { successes, failures, .. } = self.completed;
            let status = if successes >= success_count
                || (counts_skipped && successes + skipped >= success_count)
            {
                NodeStatus::Success
            } else if count - failures < success_count || failures == failure_count {
                NodeStatus::Failure
            } else {
                continue;
            };
            self.completed = Completed::default();
            run.halt_children()?;
            return Ok(status);
        }
        Ok(if skipped == count { NodeStatus::Skipped } else { NodeStatus::Running })
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.completed = Completed::default();
        Ok(())
    }
}

/// Ticks all children until each has finished.
///
/// Source: `parallel_all_node.cpp`.
#[derive(Default)]
pub(super) struct ParallelAll {
    completed: Completed,
}

impl BehaviorNode for ParallelAll {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let max_failures = threshold(run, ["max_failures", "max_failures"])?;
        let count = run.child_count();
        run.set_running();
        let mut skipped = 0;
        for child in 0..count {
            if !self.completed.children.contains(&child) {
                let status = run.tick_child(child)?;
                skipped += usize::from(status == NodeStatus::Skipped);
                self.completed.insert(child, status);
            }
        }
        if skipped == count {
            return Ok(NodeStatus::Skipped);
        }
        if skipped + self.completed.children.len() < count {
            return Ok(NodeStatus::Running);
        }
        run.halt_children()?;
        let has_failed = self.completed.failures >= max_failures;
        self.completed = Completed::default();
        Ok(if has_failed { NodeStatus::Failure } else { NodeStatus::Success })
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.completed = Completed::default();
        Ok(())
    }
}
