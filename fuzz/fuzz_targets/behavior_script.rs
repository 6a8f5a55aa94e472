//! Any text as a script of a behavior tree: a value, or an error with a range of the text.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_behavior_tree::{Blackboard, Script, ScriptEnums, TreeValue};

fuzz_target!(|text: &str| {
    let script = match Script::parse(text) {
        Ok(script) => script,
        Err(error) => {
            assert!(text.get(error.range.clone()).is_some(), "{error:?} in {text:?}");
            return;
        }
    };
    let mut blackboard = Blackboard::new();
    for (name, value) in [("a", TreeValue::Int(3)), ("b", TreeValue::Real(0.5)), ("c", "text".into())] {
        blackboard.set(name, value).expect("an empty blackboard");
    }
    let enums = ScriptEnums::from([("RED".to_owned(), 1)]);
    for _ in 0..3 {
        if let Err(error) = script.run(&mut blackboard, &enums) {
            assert!(text.get(error.range.clone()).is_some(), "{error:?} in {text:?}");
        }
    }
});
