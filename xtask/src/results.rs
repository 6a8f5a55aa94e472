//! Tables of `benches/RESULTS.md`.

use crate::step::{Failed, root};

/// Puts a table where the old one of this name was, or at the end. `command` is the benchmark that writes it.
pub(crate) fn write(name: &str, command: &str, table: &str) -> Result<(), Failed> {
    let start = format!("<!-- {name}: written by `cargo xtask bench {command}` -->\n");
    let end = format!("<!-- end of {name} -->\n");
    let path = root().join("benches/RESULTS.md");
    let failed = |error| Failed(format!("{}: {error}", path.display()));
    let text = std::fs::read_to_string(&path).map_err(failed)?;
    let (before, after) = match (text.split_once(&start), text.split_once(&end)) {
        (Some((before, _)), Some((_, after))) => (before, after),
        _ => (&*text, ""),
    };
    std::fs::write(&path, format!("{before}{start}\n{table}\n{end}{after}")).map_err(failed)
}
