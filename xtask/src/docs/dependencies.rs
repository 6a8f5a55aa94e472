//! DEPENDENCIES.md: every library that the workspace takes from elsewhere is named there, and every part that is
//! written by hand names the tests of its reason.

/// The page with the list.
pub(crate) const PAGE: &str = "DEPENDENCIES.md";

/// Heading of the parts for which a library exists.
const BY_HAND: &str = "## Written by hand";

/// Number of columns of that table; the last one names tests.
const COLUMNS: usize = 4;

/// Checks the list against the manifest of the workspace, both ways.
pub(crate) fn check(manifest: &str, list: &str) -> Vec<String> {
    let used = borrowed(manifest);
    let named: Vec<&str> = named(list);
    let missing = used.iter().filter(|name| !named.contains(name));
    let mut findings: Vec<String> = missing
        .map(|name| {
            format!("{PAGE}: `{name}` of Cargo.toml has no row: add its licence and its reason")
        })
        .collect();
    let gone = named.iter().filter(|name| !used.contains(name));
    findings
        .extend(gone.map(|name| format!("{PAGE}: `{name}` is not in Cargo.toml: remove its row")));
    findings
}

/// Checks that each part written by hand names tests that exist; `read` is the text of a file of this tree.
pub(crate) fn check_tests(list: &str, read: &dyn Fn(&str) -> Option<String>) -> Vec<String> {
    let lines = list.lines().enumerate().skip_while(|(_, line)| !line.starts_with(BY_HAND)).skip(1);
    let rows = lines
        .take_while(|(_, line)| !line.starts_with("## "))
        .filter(|(_, line)| line.starts_with('|'))
        // The head of the table and the line below it.
        .skip(2);
    let mut findings = Vec::new();
    for (index, row) in rows {
        let line = index + 1;
        let cells: Vec<&str> = row.trim().trim_matches('|').split('|').map(str::trim).collect();
        let [.., tests] = cells.as_slice() else { continue };
        let mut names: Vec<&str> = tests.split('`').skip(1).step_by(2).collect();
        let path = names.pop().filter(|path| path.ends_with(".rs"));
        let (Some(path), true, COLUMNS) = (path, !names.is_empty(), cells.len()) else {
            findings.push(format!(
                "{PAGE}:{line}: the row names no test: end it with `name` in `path.rs`"
            ));
            continue;
        };
        let text = read(path).unwrap_or_default();
        let missing = names.iter().filter(|name| !text.contains(&format!("fn {name}(")));
        findings.extend(missing.map(|name| {
            format!("{PAGE}:{line}: {path} has no test `{name}`: name the test of this requirement")
        }));
    }
    findings
}

/// Libraries of `[workspace.dependencies]` that are not crates of this tree.
fn borrowed(manifest: &str) -> Vec<&str> {
    let section = manifest.split("\n[").find(|it| it.starts_with("workspace.dependencies]"));
    let lines = section.unwrap_or_default().lines().skip(1);
    let own = |line: &&str| !line.contains("path = \"");
    let names = lines.filter(own).filter_map(|line| line.split_once('=')?.0.split('.').next());
    names.map(str::trim).filter(|name| !name.is_empty() && !name.starts_with('#')).collect()
}

/// Libraries in the first column of tables.
fn named(list: &str) -> Vec<&str> {
    let rows = list.lines().filter_map(|line| line.strip_prefix("| `")?.split(" |").next());
    rows.flat_map(|cell| cell.split('`').step_by(2)).filter(|name| !name.starts_with(',')).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_and_the_manifest_agree() {
        let manifest = "[a]\nx = \"1\"\n\n[workspace.dependencies]\nown = { path = \"crates/own\" }\n# note\n\
                        one = \"1.2\"\ntwo = { version = \"3\" }\n\n[profile.dev]\nz = 1\n";
        assert_eq!(borrowed(manifest), ["one", "two"]);
        assert_eq!(named("| `one`, `two` | MIT | `x` |\n|---|\n| three | |"), ["one", "two"]);
        assert_eq!(check(manifest, "| `one`, `two` | MIT | why |"), Vec::<String>::new());
        assert_eq!(
            check(manifest, "| `one` | MIT | why |\n| `four` | MIT | why |"),
            [
                "DEPENDENCIES.md: `two` of Cargo.toml has no row: add its licence and its reason",
                "DEPENDENCIES.md: `four` is not in Cargo.toml: remove its row",
            ]
        );
    }
    #[test]
    fn parts_written_by_hand_name_their_tests() {
        let page = |rows: &str| {
            format!(
                "| `x` | MIT | why |\n\n## Written by hand, though\n\n| Part | Library | Reason | Test |\n\
                 |---|---|---|---|\n{rows}\n## Other\n| a | b | c | d |\n"
            )
        };
        let read = |path: &str| (path == "a.rs").then(|| "fn one() {}\nfn two() {}".to_owned());
        let check = |rows: &str| check_tests(&page(rows), &read);
        assert_eq!(check("| P | `x` | why | `one` and `two` in `a.rs` |\n"), Vec::<String>::new());
        assert_eq!(
            check("| P | `x` | why | `one` in `a.rs` |\n| | | why | `three` in `a.rs` |\n"),
            ["DEPENDENCIES.md:8: a.rs has no test `three`: name the test of this requirement"]
        );
        for row in ["| P | `x` | why | none |\n", "| P | `x` | `one` in `a.rs` |\n"] {
            let finding =
                "DEPENDENCIES.md:7: the row names no test: end it with `name` in `path.rs`";
            assert_eq!(check(row), [finding], "{row}");
        }
        assert!(
            check("| P | `x` | why | `one` in `gone.rs` |\n")[0].contains("gone.rs has no test")
        );
    }
}
