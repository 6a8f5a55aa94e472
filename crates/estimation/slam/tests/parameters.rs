//! `docs/slam-parameters.md` is made from the tables: `UPDATE_EXPECT=1 cargo test -p periplus-slam`.

use std::fmt::Write as _;

use expect_test::expect_file;
use periplus_slam::{Method, tables};

#[test]
fn the_reference_is_up_to_date() {
    let mut out =
        "# Parameters of mapping\n\nWhat `periplus slam` and the nodes for mapping read, \
                   by the names that the programs of ROS have for it. Made from the tables in \
                   `crates/estimation/slam/src/tables`.\nWhere a default is not that of the original it is \
                   the one with which maps come out best here.\n"
            .to_owned();
    for method in Method::ALL {
        let _ = write!(
            out,
            "\n## `--method {method}`\n\n{}\n#### What changes nothing\n\nThese are read, so that files \
             can be taken as they are. A warning tells when one is set to something else than its \
             default.\n\n",
            method.table().to_markdown()
        );
        for (names, because) in tables::reasons(method) {
            let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            let _ = writeln!(out, "- {}: {because}.", names.join(", "));
        }
    }
    expect_file!["../../../../docs/slam-parameters.md"].assert_eq(&out);
}
