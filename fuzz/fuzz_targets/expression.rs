//! Any text as an expression: a value, or an error with a position in the text, within the budget.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_python_expr::{Budget, EmptyScope, Expression, evaluate};

fuzz_target!(|text: &str| {
    let mut budget = Budget::new(100_000, 8 << 20);
    let outcome = Expression::parse(text).and_then(|expression| {
        let value = evaluate(&expression, &EmptyScope, &mut budget)?;
        value.to_text(&mut budget).map_err(|mut error| {
            error.range = 0..text.len();
            error
        })
    });
    if let Err(error) = outcome {
        assert!(text.get(error.range.clone()).is_some(), "{error:?} in {text:?}");
    }
});
