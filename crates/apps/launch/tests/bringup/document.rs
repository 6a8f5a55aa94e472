//! The table in the documentation equals that of the program.

use std::path::Path;

#[test]
fn the_documentation_has_the_table() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/launch.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let table = periplus_launch::bringup::table();
    assert!(text.contains(&table), "docs/launch.md is to contain:\n{table}");
}
