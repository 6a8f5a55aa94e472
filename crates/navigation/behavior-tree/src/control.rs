//! Control nodes of BehaviorTree.CPP.

mod conditional;
mod parallel;
mod reactive;
mod sequence;
mod try_catch;

use crate::value::PortType;
use crate::{NodeKind, NodeModel, NodeRegistry};

use conditional::{IfThenElse, Switch, WhileDoElse};
use parallel::{Parallel, ParallelAll};
use reactive::Reactive;
use sequence::{OnEnd, Sequence};
use try_catch::TryCatch;

/// Numbers of cases for which there are `Switch` nodes.
const SWITCH_CASES: std::ops::RangeInclusive<usize> = 2..=6;

pub(crate) fn register(registry: &mut NodeRegistry) {
    let control = |name: &str| NodeModel::new(name, NodeKind::Control);
    let text = || PortType::Text;
    registry.register(control("Sequence"), || Sequence::new(OnEnd::SUCCESS));
    registry.register(control("Fallback"), || Sequence::new(OnEnd::FALLBACK));
    registry.register(control("AsyncSequence"), || Sequence::new(OnEnd::SUCCESS.yielding()));
    registry.register(control("AsyncFallback"), || Sequence::new(OnEnd::FALLBACK.yielding()));
    let with_memory = || Sequence::new(OnEnd::SUCCESS.yielding().with_memory());
    registry.register(control("SequenceWithMemory"), with_memory);
    registry.register(control("SequenceStar"), with_memory);
    registry.register(control("ReactiveSequence"), || Reactive::SEQUENCE);
    registry.register(control("ReactiveFallback"), || Reactive::FALLBACK);
    let parallel = control("Parallel")
        .input_or("success_count", PortType::int(), "-1")
        .input_or("failure_count", PortType::int(), "1")
        // Names of format 3.
        .input("success_threshold", PortType::int())
        .input("failure_threshold", PortType::int());
    registry.register(parallel, Parallel::default);
    let parallel_all = control("ParallelAll").input_or("max_failures", PortType::int(), "1");
    registry.register(parallel_all, ParallelAll::default);
    registry.register(control("IfThenElse"), IfThenElse::default);
    registry.register(control("WhileDoElse"), || WhileDoElse);
    let try_catch = control("TryCatch").input_or("catch_on_halt", PortType::Bool, "false");
    registry.register(try_catch, TryCatch::default);
    for cases in SWITCH_CASES {
        let mut model = control(&format!("Switch{cases}")).input("variable", text());
        for case in 1..=cases {
            model = model.input(&format!("case_{case}"), text());
        }
        registry.register(model, move || Switch::new(cases));
    }
}
