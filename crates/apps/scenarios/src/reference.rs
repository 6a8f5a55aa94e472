//! Reference of scenario files in Markdown.
//! `UPDATE_EXPECT=1 cargo test -p periplus-scenarios reference` rewrites the page and the published schema.

use periplus_faults::FaultKind;
use periplus_params::Table;

use crate::tables::{ASSERTIONS, EVENTS, NODES, ROBOT, SCENARIO, TRIGGER};

/// Markdown with a section for each part of a scenario file, from the declarations that the reader uses.
#[must_use]
pub fn reference_markdown() -> String {
    let mut out = String::from(
        "# Scenario files\n\nThis page is generated from the declarations that the reader uses: `UPDATE_EXPECT=1 cargo \
         test -p periplus-scenarios reference` rewrites it. [Test with scenarios](scenarios.md) has examples, \
         `periplus scenario --schema` prints the same as a JSON schema. A scalar or a list in place of a mapping is the \
         value of the required parameter: `min_clearance: 0.2`.\n\n",
    );
    let mut part = |title: &str, intro: &str, tables: &[&Table]| {
        out.push_str(&format!("## {title}\n\n{intro}\n\n"));
        for table in tables {
            out.push_str(&table.to_markdown().replace("\\[", "[").replace("\\]", "]"));
            out.push('\n');
        }
    };
    part("Top level", "Values and sections of the file.", &[&SCENARIO, &ROBOT]);
    part("Nodes", "The section `nodes`: a list of words, or a mapping with parameters.", &NODES);
    part(
        "Events",
        "The section `events`: a list. Each event has an action and at most one condition.",
        &[&TRIGGER],
    );
    part("Actions", "An event has one of these, or `fault` with one of the faults.", &EVENTS);
    part(
        "Assertions",
        "The section `assertions`: a list of words with their parameters.",
        &ASSERTIONS,
    );
    part(
        "Faults",
        "The section `faults`, and the action `fault` of an event.",
        FaultKind::tables(),
    );
    out.truncate(out.trim_end().len());
    out.push('\n');
    out
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use expect_test::expect_file;

    use super::*;

    /// `docs` at the root of the tree.
    fn docs() -> PathBuf {
        let own = Path::new(env!("CARGO_MANIFEST_DIR"));
        let root = own.ancestors().find(|folder| folder.join("Cargo.lock").is_file());
        root.unwrap().join("docs")
    }

    #[test]
    fn the_reference_page_is_up_to_date() {
        expect_file![docs().join("scenario-reference.md")].assert_eq(&reference_markdown());
    }

    #[test]
    fn the_reference_schema_is_up_to_date() {
        let schema = format!("{:#}\n", crate::json_schema());
        expect_file![docs().join("scenario.schema.json")].assert_eq(&schema);
    }
}
