//! Processes that must end before a world can be loaded.

use std::collections::BTreeSet;

use crate::Trigger;

use crate::bringup::parts::{Part, Work};

/// Additional time for a process that writes the world file, once the file exists \[ns\].
pub(crate) const MAX_WAIT_NS: i64 = 2_000_000_000;

/// Indices of the parts that run before the world is loaded: those whose end or output the world
/// waits for, those that have its file among their arguments, and those that these wait for. Only
/// commands; nodes need the world.
pub(crate) fn of_world(parts: &[&Part], world: usize) -> BTreeSet<usize> {
    let mut wanted = BTreeSet::new();
    let mut open = waited_for(parts, parts[world]);
    if let Work::World(wish) = &parts[world].work
        && let Some(file) = wish.file.as_deref()
    {
        let names_it = |index: &usize| words(parts[*index]).iter().any(|word| word.contains(file));
        open.extend((0..parts.len()).filter(names_it));
    }
    while let Some(index) = open.pop() {
        if index != world && is_command(parts[index]) && wanted.insert(index) {
            open.extend(waited_for(parts, parts[index]));
        }
    }
    // Parts that wait for a node, or for the world itself, come later.
    loop {
        let is_possible = |index: &usize| {
            parts[*index].after.iter().all(|trigger| match step_of(trigger) {
                Wait::Time => true,
                Wait::Step(step) => wanted.iter().any(|other| parts[*other].step == step),
                Wait::Other => false,
            })
        };
        let possible: BTreeSet<usize> = wanted.iter().copied().filter(is_possible).collect();
        if possible.len() == wanted.len() {
            return wanted;
        }
        wanted = possible;
    }
}

/// Dependency of a trigger.
enum Wait {
    Time,
    Step(usize),
    Other,
}

fn step_of(trigger: &Trigger) -> Wait {
    match trigger {
        Trigger::Seconds(_) => Wait::Time,
        Trigger::Started(Some(step))
        | Trigger::Ended(Some(step))
        | Trigger::Printed(Some(step)) => Wait::Step(*step),
        _ => Wait::Other,
    }
}

fn waited_for(parts: &[&Part], part: &Part) -> Vec<usize> {
    let is_waited_for = |index: &usize| {
        let step = parts[*index].step;
        part.after.iter().any(|trigger| matches!(step_of(trigger), Wait::Step(of) if of == step))
    };
    (0..parts.len()).filter(is_waited_for).collect()
}

fn is_command(part: &Part) -> bool {
    match &part.work {
        Work::Program(program) => !program.is_node && program.python.is_none(),
        Work::Xacro(_) => true,
        _ => false,
    }
}

fn words(part: &Part) -> &[String] {
    match &part.work {
        Work::Program(program) | Work::Xacro(program) => &program.words,
        _ => &[],
    }
}
