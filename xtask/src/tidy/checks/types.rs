//! Names of public types that are defined more than once.

use std::collections::BTreeMap;
use std::ops::Range;

use super::{Check, Finding};
use crate::tidy::rules::TypeRules;
use crate::tidy::rust::Kind;
use crate::tidy::source::Rust;

/// Public type with where its name is.
#[derive(Clone, Debug)]
pub(crate) struct Type {
    pub(crate) name: String,
    /// Index of its file.
    pub(crate) file: usize,
    pub(crate) range: Range<usize>,
}

/// Public types of a file: `pub struct`, `enum`, `trait`, `type`, `union`.
pub(crate) fn types(rust: &Rust, rules: &TypeRules, file: usize) -> Vec<Type> {
    if rust.file.is_tool() || rules.exempt.contains(&rust.file.package) {
        return Vec::new();
    }
    let kinds = ["struct", "enum", "trait", "type", "union"];
    (0..rust.tokens.len())
        .filter(|&at| !rust.is_test[at] && rust.is_ident(at, "pub"))
        .filter_map(|at| {
            let qualifiers = ["unsafe", "auto"];
            let skipped =
                (at + 1..).take_while(|&at| qualifiers.iter().any(|word| rust.is_ident(at, word)));
            let kind_at = at + 1 + skipped.count();
            let is_type = kinds.iter().any(|kind| rust.is_ident(kind_at, kind));
            let name =
                rust.tokens.get(kind_at + 1).filter(|name| is_type && name.kind == Kind::Ident)?;
            let range = name.range.clone();
            Some(Type { name: rust.text(kind_at + 1).to_owned(), file, range })
        })
        .collect()
}

/// Objections to names that are defined more than once, each with the index of its file.
///
/// `shown` names a file by its index.
pub(crate) fn check(
    types: &[Type],
    rules: &TypeRules,
    shown: impl Fn(usize) -> String,
) -> Vec<(usize, Finding)> {
    let mut by_name: BTreeMap<&str, Vec<&Type>> = BTreeMap::new();
    for one in types.iter().filter(|one| !rules.shared.contains(&one.name)) {
        by_name.entry(&one.name).or_default().push(one);
    }
    let repeated = by_name.into_values().filter(|types| types.len() > 1);
    let findings = repeated.flat_map(|types| {
        let findings = types.iter().map(|one| {
            let others = types.iter().filter(|other| !std::ptr::eq(**other, *one));
            let files: Vec<String> = others.map(|other| shown(other.file)).collect();
            let advice = format!("a specific name; others are in {}", files.join(", "));
            let finding = Finding {
                check: Check::Types,
                entry: String::new(),
                range: one.range.clone(),
                text: one.name.clone(),
                advice,
            };
            (one.file, finding)
        });
        findings.collect::<Vec<_>>()
    });
    findings.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tidy::source::made_up;

    #[test]
    fn names_are_unique_in_the_workspace() {
        let set = |words: &str| words.split_whitespace().map(str::to_owned).collect();
        let rules = TypeRules { shared: set("Error"), exempt: set("msgs") };
        let texts = [
            (
                "crates/a/src/lib.rs",
                "pub struct Kind; pub enum Error {} pub unsafe trait Tap {} pub(crate) struct Own;",
            ),
            (
                "crates/b/src/lib.rs",
                "pub type Kind = u8; pub enum Error {} struct Tap; #[cfg(test)] mod t { pub struct Tap; }",
            ),
            ("crates/msgs/src/lib.rs", "pub struct Kind;"),
            ("xtask/x/src/lib.rs", "pub struct Kind;"),
        ];
        let files = texts.map(|(path, text)| made_up(path, text));
        let found: Vec<Type> = files
            .iter()
            .enumerate()
            .flat_map(|(at, file)| types(&Rust::new(file), &rules, at))
            .collect();
        let findings = check(&found, &rules, |file| files[file].path.clone());
        let shown: Vec<String> = findings
            .iter()
            .map(|(file, finding)| format!("{file} {} -> {}", finding.text, finding.advice))
            .collect();
        assert_eq!(
            shown,
            [
                "0 Kind -> a specific name; others are in crates/b/src/lib.rs",
                "1 Kind -> a specific name; others are in crates/a/src/lib.rs",
            ]
        );
    }
}
