//! Counts of findings that the tree may still have; they only fall.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use clap::ValueEnum;
use periplus_diagnostics::SourceMap;

use super::checks::Check;
use crate::step::Failed;

/// Numbers of findings by check and package.
pub(crate) type Counts = BTreeMap<Check, BTreeMap<String, usize>>;

/// Count that is higher than the committed one.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Rise {
    pub(crate) check: Check,
    pub(crate) package: String,
    pub(crate) allowed: usize,
    pub(crate) found: usize,
}

/// Reads committed counts.
///
/// # Errors
/// Text that is not of the form `check: {package: count}`.
pub(crate) fn parse(path: &str, text: &str) -> Result<Counts, Failed> {
    let fault =
        |what: &str| Failed(format!("{path}: {what}; restore it with `git checkout {path}`"));
    let mut sources = SourceMap::default();
    let file = sources.add(path, text);
    let node = periplus_yaml::parse(file, &sources).map_err(|why| fault(&why.message))?;
    let mut counts = Counts::new();
    for (name, packages) in node.iter().flat_map(|node| node.entries().unwrap_or_default()) {
        let name = name.text().unwrap_or_default();
        let check = Check::from_str(name, false)
            .map_err(|_| fault(&format!("no check is called `{name}`")))?;
        for (package, count) in packages.entries().unwrap_or_default() {
            let package = package.text().unwrap_or_default();
            let count = count.integer().and_then(|count| usize::try_from(count).ok());
            let count =
                count.ok_or_else(|| fault(&format!("`{name}` of `{package}` is not a count")))?;
            counts.entry(check).or_default().insert(package.to_owned(), count);
        }
    }
    Ok(counts)
}

/// Text of the committed file, which [`parse`] reads. Empty when nothing is left.
pub(crate) fn render(counts: &Counts) -> String {
    let mut text = String::new();
    for (check, packages) in counts {
        let left: Vec<_> = packages.iter().filter(|(_, count)| **count > 0).collect();
        if !left.is_empty() {
            let _ = writeln!(text, "{check}:");
        }
        for (package, count) in left {
            let _ = writeln!(text, "  {package}: {count}");
        }
    }
    if text.is_empty() {
        return text;
    }
    format!(
        "# Findings of `cargo xtask tidy` that the tree still has, by check and package. They only fall:\n\
         # `cargo xtask tidy --update` writes this file. After a conflict take the file of the main branch and\n\
         # update it again.\n{text}"
    )
}

fn of(counts: &Counts, check: Check) -> impl Iterator<Item = (&String, usize)> {
    counts.get(&check).into_iter().flatten().map(|(package, count)| (package, *count))
}

/// Counts above the allowed ones.
///
/// What packages were allowed that are gone counts for the others, so that a package may be renamed or
/// merged into another.
pub(crate) fn rises(allowed: &Counts, found: &Counts, packages: &BTreeSet<String>) -> Vec<Rise> {
    let mut rises = Vec::new();
    for check in Check::ALL {
        let of_gone = of(allowed, check).filter(|(package, _)| !packages.contains(*package));
        let spare: usize = of_gone.map(|(_, count)| count).sum();
        let limit = |package: &String| allowed.get(&check).and_then(|of| of.get(package)).copied();
        let above: Vec<Rise> = of(found, check)
            .map(|(package, found)| {
                let allowed = limit(package).unwrap_or(0);
                Rise { check, package: package.clone(), allowed, found }
            })
            .filter(|rise| rise.found > rise.allowed)
            .collect();
        if above.iter().map(|rise| rise.found - rise.allowed).sum::<usize>() > spare {
            rises.extend(above);
        }
    }
    rises
}

/// Counts to commit in place of the allowed ones.
///
/// With `moved`, a package may have more when the others have as many fewer: code moved between them.
///
/// # Errors
/// Those counts that would rise.
pub(crate) fn lowered(
    allowed: &Counts,
    found: &Counts,
    packages: &BTreeSet<String>,
    moved: bool,
) -> Result<Counts, Vec<Rise>> {
    let total = |counts: &Counts, check| of(counts, check).map(|(_, count)| count).sum::<usize>();
    let mut rises = rises(allowed, found, packages);
    rises.retain(|rise| !moved || total(found, rise.check) > total(allowed, rise.check));
    if rises.is_empty() { Ok(found.clone()) } else { Err(rises) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(text: &str) -> Counts {
        parse("ratchet.yaml", text).expect("counts")
    }

    #[track_caller]
    fn check(allowed: &str, found: &str, expected: &[&str]) {
        let packages = ["a", "b"].map(str::to_owned).into();
        let rises = rises(&counts(allowed), &counts(found), &packages);
        let shown = |rise: &Rise| {
            format!("{} {} {} > {}", rise.check, rise.package, rise.found, rise.allowed)
        };
        assert_eq!(rises.iter().map(shown).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn counts_only_fall() {
        check("words: {a: 3}", "words: {a: 3}", &[]);
        check("words: {a: 3}", "words: {a: 2}", &[]);
        check("words: {a: 3, b: 9}", "words: {a: 4, b: 0}", &["words a 4 > 3"]);
        check("words: {a: 3}", "types: {b: 1}", &["types b 1 > 0"]);
    }

    #[test]
    fn renamed_and_merged_packages_keep_their_counts() {
        check("words: {old: 3}", "words: {a: 3}", &[]);
        check("words: {old: 3, a: 1}", "words: {a: 2, b: 2}", &[]);
        check("words: {old: 3, a: 1}", "words: {a: 3, b: 2}", &["words a 3 > 1", "words b 2 > 0"]);
    }

    #[test]
    fn updates_never_raise_a_total() {
        let packages: BTreeSet<String> = ["a", "b"].map(str::to_owned).into();
        let allowed = counts("words: {a: 3, b: 1}");
        let update = |found: &str, moved| {
            lowered(&allowed, &counts(found), &packages, moved).map_err(|rises| rises.len())
        };
        assert_eq!(update("words: {a: 2}", false), Ok(counts("words: {a: 2}")));
        assert_eq!(update("words: {a: 2, b: 2}", false), Err(1));
        assert_eq!(update("words: {a: 2, b: 2}", true), Ok(counts("words: {a: 2, b: 2}")));
        assert_eq!(update("words: {a: 3, b: 2}", true), Err(1));
    }

    #[test]
    fn what_is_written_is_read() {
        let all = counts("words: {a: 3, b: 0}\ntypes: {b: 1}");
        let text = render(&all);
        assert!(text.ends_with("words:\n  a: 3\ntypes:\n  b: 1\n"), "{text}");
        assert_eq!(render(&counts(&text)), text);
        assert_eq!(render(&counts("words: {a: 0}")), "");
    }

    #[test]
    fn faults_say_what_to_do() {
        let fault = |text| parse("ratchet.yaml", text).expect_err("a fault").0;
        assert_eq!(
            fault("word: {a: 1}"),
            "ratchet.yaml: no check is called `word`; restore it with `git checkout ratchet.yaml`"
        );
        assert!(fault("words: {a: x}").contains("`words` of `a` is not a count"));
    }
}
