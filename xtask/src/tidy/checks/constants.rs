//! Constants without a unit or ratio in their names, and tuples in place of structs.

use super::{Check, Finding};
use crate::tidy::rules::ConstantRules;
use crate::tidy::rust::Kind;
use crate::tidy::source::Rust;

/// Types of numbers.
const NUMBERS: [&str; 14] = [
    "f32", "f64", "i8", "i16", "i32", "i64", "i128", "isize", "u16", "u32", "u64", "u128", "usize",
    "u8",
];

/// Objections to the constants of a file.
pub(crate) fn check(rust: &Rust, rules: &ConstantRules) -> Vec<Finding> {
    if !rules.folders.iter().any(|folder| rust.file.path.starts_with(folder)) {
        return Vec::new();
    }
    (0..rust.tokens.len())
        .filter(|&at| {
            !rust.is_test[at] && (rust.is_ident(at, "const") || rust.is_ident(at, "static"))
        })
        .filter_map(|at| constant(rust, rules, at))
        .collect()
}

fn constant(rust: &Rust, rules: &ConstantRules, at: usize) -> Option<Finding> {
    // Not a parameter of generics, not a pointer.
    let before = at.checked_sub(1).map(|before| rust.text(before));
    if matches!(before, Some("<" | "," | "*")) {
        return None;
    }
    let name_at = at + 1;
    let is_named =
        rust.tokens.get(name_at)?.kind == Kind::Ident && rust.is_punct(name_at + 1, b':');
    // Type of the constant, up to its value.
    let type_start = name_at + 2;
    let value_at = (type_start..rust.tokens.len()).find(|&at| {
        rust.is_punct(at, b'=') || (rust.is_punct(at, b';') && !in_array(rust, type_start, at))
    })?;
    let words: Vec<&str> = (type_start..value_at).map(|at| rust.text(at)).collect();
    let is_parameter = value_at - type_start > 40 || !is_named || words.contains(&"fn");
    let number_of_types = words.iter().filter(|word| NUMBERS.contains(word)).count();
    let is_tuple = words.contains(&"(") && number_of_types > 0;
    let is_number = is_number(&words);
    let name = rust.text(name_at);
    let qualified = format!("{} {name}", rust.file.package);
    if is_parameter || rules.allowed.contains(name) || rules.allowed.contains(&qualified) {
        return None;
    }
    let last_word = name.rsplit('_').next().unwrap_or(name);
    let is_float = words.iter().any(|word| word.starts_with('f') && NUMBERS.contains(word));
    let has_unit = name.contains("_PER_")
        || rules.suffixes.contains(last_word)
        || (!is_float && rules.counts.contains(last_word));
    let advice = if is_tuple {
        "a small struct with documented fields, or one constant for each"
    } else if is_number && !has_unit {
        "a name with a unit (`_M`, `_RAD`, `_S`), a ratio (`_RATIO`, `_FACTOR`) or a kind (`_COUNT`) as its last word"
    } else {
        return None;
    };
    let range = rust.tokens[name_at].range.start..rust.tokens[value_at - 1].range.end;
    let text = format!("{name}: {}", words.concat());
    Some(Finding {
        check: Check::Constants,
        entry: String::new(),
        range,
        text,
        advice: advice.to_owned(),
    })
}

/// True for a number and for arrays and slices of numbers.
fn is_number(words: &[&str]) -> bool {
    match words {
        [single] => NUMBERS.contains(single),
        ["[", inner @ .., "]"] => {
            let element = inner.iter().rposition(|word| *word == ";").unwrap_or(inner.len());
            is_number(&inner[..element])
        }
        ["&", inner @ ..] => is_number(inner),
        _ => false,
    }
}

/// True for the `;` of `[f64; 3]`.
fn in_array(rust: &Rust, from: usize, at: usize) -> bool {
    (from..at).any(|open| rust.is_punct(open, b'[') && rust.closers[open] > at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tidy::source::made_up;

    #[track_caller]
    fn check_text(text: &str, expected: &[&str]) {
        let set = |words: &str| words.split_whitespace().map(str::to_owned).collect();
        let rules = ConstantRules {
            folders: set("crates/slam/"),
            suffixes: set("M RAD RATIO COUNT"),
            counts: set("POINTS"),
            allowed: set("LETHAL"),
        };
        let file = made_up("crates/slam/src/lib.rs", text);
        let found: Vec<_> =
            check(&Rust::new(&file), &rules).into_iter().map(|finding| finding.text).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn numbers_have_units() {
        check_text(
            "const FAR: f64 = 1.0; pub const FAR_M: f64 = 1.0; const M: f64 = 2.0; const BINS_PER_TURN: f64 = 1.0; const LETHAL: u8 = 254;\
             const NAME: &str = \"a\"; impl A { const STEPS: [f64; 3] = [0.0; 3]; } const STEP_RAD: &[f64] = &[];",
            &["FAR: f64", "STEPS: [f64;3]"],
        );
    }

    #[test]
    fn integers_say_what_they_count() {
        check_text(
            "const MAX_POINTS: usize = 1; const FAR: u32 = 1; const FEW_POINTS: f64 = 1.0;",
            &["FAR: u32", "FEW_POINTS: f64"],
        );
    }

    #[test]
    fn tuples_are_structs() {
        check_text(
            "const GATE_M: (f64, f64) = (1.0, 2.0); const A_M: [(f64, f64); 1] = [(0.0, 0.0)];",
            &["GATE_M: (f64,f64)", "A_M: [(f64,f64);1]"],
        );
    }

    #[test]
    fn other_uses_of_const_are_none() {
        check_text(
            "const fn f(x: f64) -> f64 { x } fn g<const N: usize>() {} let p: *const f64 = q; #[cfg(test)] const A: f64 = 1.0;\
             const F: fn(f64) -> f64 = f; trait T { const X: Name; }",
            &[],
        );
    }
}
