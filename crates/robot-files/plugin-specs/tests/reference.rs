//! `docs/plugins.md` is made from the tables: `UPDATE_EXPECT=1 cargo test -p periplus-plugin-specs`.

use std::fmt::Write as _;

use expect_test::expect_file;
use periplus_plugin_specs::{Family, Support, TopicDirection, known};

#[test]
fn the_reference_says_what_the_tables_say() {
    let mut out = String::from(
        "# Gazebo plugins\n\nPlugins of Gazebo that `periplus check` knows, with their parameters. This page is \
         generated from tables: `UPDATE_EXPECT=1 cargo test -p periplus-plugin-specs reference` rewrites it.\n\
         A parameter that is not listed is not read. \"and more\" marks plugins whose list is incomplete; \
         \"kept, not run\" marks plugins that are preserved in files and not simulated.\n",
    );
    for family in [Family::ClassicRos2, Family::ClassicRos1, Family::Classic, Family::Gz] {
        let _ = writeln!(out, "\n## {family}");
        for plugin in known().filter(|plugin| plugin.family == family) {
            let _ = write!(out, "\n{}", plugin.table.to_markdown());
            let _ = write!(out, "\n`{}`", plugin.filename());
            for class in plugin.classes {
                let _ = write!(out, ", `{class}`");
            }
            if plugin.open {
                out.push_str("; and more");
            }
            if plugin.support == Support::Kept {
                out.push_str("; kept, not run");
            }
            out.push_str(".\n");
            for topic in plugin.topics {
                let way =
                    if topic.flow == TopicDirection::Out { "publishes" } else { "subscribes to" };
                let _ = write!(out, "\n- {way} `{}`", topic.name);
                if let Some(parameter) = topic.set_by {
                    let _ = write!(out, ", or the value of `{parameter}`");
                }
                if let Some(parameter) = topic.when {
                    let _ = write!(out, ", if `{parameter}`");
                }
            }
            if !plugin.topics.is_empty() {
                out.push('\n');
            }
        }
    }
    expect_file!["../../../../docs/plugins.md"].assert_eq(&out);
}
