//! DEPENDENCIES.md: every library that the workspace takes from elsewhere is named there.

/// The page with the list.
pub(crate) const PAGE: &str = "DEPENDENCIES.md";

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
}
