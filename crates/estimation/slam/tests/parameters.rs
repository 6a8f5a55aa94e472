//! `docs/slam-parameters.md` is made from the tables: `UPDATE_EXPECT=1 cargo test -p periplus-slam`.

use std::fmt::Write as _;

use expect_test::expect_file;
use periplus_slam::{Method, tables};

#[test]
fn the_reference_is_up_to_date() {
    let mut out =
        "# SLAM parameters\n\nParameters of `periplus slam` and of the SLAM nodes, with the names that the ROS \
                   programs have for them. This page is generated from tables: `UPDATE_EXPECT=1 cargo \
                   test -p periplus-slam --test parameters` rewrites it.\nWhere a default differs \
                   from that of the original, it gives better maps here.\n"
            .to_owned();
    for method in Method::ALL {
        let _ = write!(
            out,
            "\n## `--method {method}`\n\n{}\n#### Parameters without effect\n\nThese are accepted, so that existing files can be used unchanged. A \
             warning reports a value other than the default.\n\n",
            method.table().to_markdown()
        );
        for (names, because) in tables::reasons(method) {
            let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            let _ = writeln!(out, "- {}: {because}.", names.join(", "));
        }
    }
    expect_file!["../../../../docs/slam-parameters.md"].assert_eq(&out);
}
