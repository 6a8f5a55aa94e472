//! Any text: a tree or located findings, in bounded time; no panic, and nothing runs after a halt.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "helpers of tests, which read shared files"
)]

mod support;

use periplus_behavior_tree::{Blackboard, NodeStatus, Script, ScriptEnums, TreeFiles, TreeValue};
use proptest::prelude::*;
use support::{Scripted, registry};

fn check_tree(xml: &str) {
    let scripted = Scripted::default();
    scripted.set("Leaf", "RFSRRSF");
    let registry = registry(&scripted);
    let files = TreeFiles::parse("t.xml", xml, &registry);
    let Ok(mut tree) = files.tree("", &registry, Blackboard::new()) else { return };
    for tick in 0..10 {
        if tree.tick(tick * 50_000_000, &mut ()).is_err() {
            break;
        }
    }
    // Errors of scripts `_onHalted` do not keep a node running.
    let _ = tree.halt(1_000_000_000, &mut ());
    assert!(tree.nodes().all(|node| node.status != NodeStatus::Running), "{xml}");
}

fn check_script(text: &str) {
    let outcome = Script::parse(text).and_then(|script| {
        let mut blackboard = Blackboard::new();
        blackboard.set("a", TreeValue::Int(i64::MIN)).unwrap();
        blackboard.set("b", TreeValue::Real(0.0)).unwrap();
        blackboard.set("c", "text").unwrap();
        script.run(&mut blackboard, &ScriptEnums::new())
    });
    if let Err(error) = outcome {
        assert!(text.get(error.range.clone()).is_some(), "{error:?} in {text:?}");
    }
}

/// Nested nodes of all kinds, with any mixture of attributes.
fn nodes() -> impl Strategy<Value = String> {
    let attributes = prop::sample::select(vec![
        "",
        "name='n'",
        "_skipIf='a == 1'",
        "_while='a != 2'",
        "_onHalted='a := 3'",
        "_failureIf='('",
        "_post='b = 1'",
    ]);
    let leaf = prop::sample::select(vec![
        "<Leaf/>",
        "<AlwaysSuccess/>",
        "<AlwaysFailure/>",
        "<Sleep msec='70'/>",
        "<Sleep/>",
        "<Script code='a := 1'/>",
        "<Script code='a += 1'/>",
        "<ScriptCondition code='a &gt; 2'/>",
        "<SetBlackboard output_key='a' value='7'/>",
        "<UnsetBlackboard key='a'/>",
        "<GoalUpdated/>",
        "<TimeExpired seconds='0.1'/>",
        "<WasEntryUpdated entry='{a}'/>",
        "<SubTree ID='U'/>",
    ]);
    let parent = prop::sample::select(vec![
        "Sequence",
        "Fallback",
        "SequenceWithMemory",
        "ReactiveSequence",
        "ReactiveFallback",
        "Parallel",
        "ParallelAll",
        "IfThenElse",
        "WhileDoElse",
        "TryCatch catch_on_halt='true'",
        "Switch2 variable='{a}'",
        "PipelineSequence",
        "RecoveryNode",
        "RoundRobin",
        "RoundRobin wrap_around='true'",
        "NonblockingSequence",
        "PersistentSequence current_child_idx='{a}'",
        "Inverter",
        "ForceSuccess",
        "KeepRunningUntilFailure",
        "Repeat num_cycles='-1'",
        "RetryUntilSuccessful num_attempts='3'",
        "Timeout msec='120'",
        "Delay delay_msec='60'",
        "RunOnce",
        "RateController hz='8'",
        "SingleTrigger",
        "GoalUpdatedController",
        "Precondition if='a == 1'",
        "SkipUnlessUpdated entry='{a}'",
    ]);
    let leaf = leaf.prop_map(str::to_owned);
    leaf.prop_recursive(4, 24, 3, move |inner| {
        let children = prop::collection::vec(inner, 1..4);
        (parent.clone(), attributes.clone(), children).prop_map(|(parent, attributes, children)| {
            let name = parent.split(' ').next().unwrap_or_default();
            let children = children.concat();
            format!("<{parent} {attributes}>{children}</{name}>")
        })
    })
}

/// Regression test: below a node that had not become running, a child went on after an error of its sibling.
#[test]
fn nothing_runs_after_an_error_and_a_halt() {
    let root = "<Parallel><NonblockingSequence><Leaf/><Sleep/></NonblockingSequence></Parallel>";
    check_tree(&format!("<root><BehaviorTree ID='T'>{root}</BehaviorTree></root>"));
}

proptest! {
    #[test]
    fn any_tree_ends_and_halts(root in nodes(), other in nodes()) {
        check_tree(&format!(
            "<root BTCPP_format='4' main_tree_to_execute='T'><BehaviorTree ID='T'>{root}</BehaviorTree>
             <BehaviorTree ID='U'>{other}</BehaviorTree></root>"
        ));
    }

    #[test]
    fn any_single_child_tree_ends_and_halts(root in nodes()) {
        // Without subtrees and with one child per decorator most trees are valid.
        let root = root.replace("<SubTree ID='U'/>", "<Leaf/>");
        check_tree(&format!("<root><BehaviorTree ID='T'>{root}</BehaviorTree></root>"));
    }

    #[test]
    fn any_script_has_a_value_or_a_located_error(
        text in "(([abcx]|[0-9]{1,3}|'[a-z]*'|true|0x[0-9a-f]*|1e9|é)[ ]?(:=|\\+|-|\\*|/|\\.\\.|&&|\\|\\||!|~|&|\\^|==|!=|<=|>|=|\\+=|\\?|:|;|\\(|\\))[ ]?){0,12}[abc]?"
    ) {
        check_script(&text);
    }

    #[test]
    fn any_text_is_read(text in ".{0,60}") {
        check_script(&text);
        check_tree(&text);
        check_tree(&format!("<root><BehaviorTree ID='T'>{text}</BehaviorTree></root>"));
    }
}
