//! `docs/type-hashes.md`: the type hashes that are verified, with their sources. With UPDATE_EXPECT=1 it is
//! rewritten.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use expect_test::expect_file;
use periplus_msgs::TypeRegistry;

/// Source of a hash, the most reliable first, and its name in the table.
const SOURCES: [(&str, &str); 5] = [
    ("running", "a running system"),
    ("jazzy", "build of Jazzy"),
    ("rosidl", "rosidl's code"),
    ("rosbags-jazzy", "rosbags' own types"),
    ("rosbags", "rosbags over our text"),
];

const HEAD: &str = "\
# Messages and type hashes

The messages, services and actions of these packages are built in, from the texts in
`crates/messages/msgs/interfaces`. Types of other packages are read from folders: `--interfaces DIR` and
`AMENT_PREFIX_PATH`.

Since ROS 2 Iron every endpoint publishes the hash of its type (RIHS01). The hashes here are calculated from the
texts and compared with those of other programs (`crates/messages/msgs/tests/oracle.rs`). Sources used to verify the
type hashes, for each type in `crates/messages/msgs/tests/data/hashes.tsv` and `published.tsv`:

- *A running system*: `ros2 topic info -v` and `ros2 service info` of ROS 2 Jazzy.
- *Build of Jazzy*: the JSON that rosidl wrote for the packages on PyPI (`ros-sensor-msgs` and others), which contain
  the binaries of ROS 2 Jazzy.
- *Rosidl's code*: `*__description.c` as rosidl generated it, in public workspaces built with Iron or later.
- *Rosbags' own types*: the types of PyPI's `rosbags` 0.11.9 for Jazzy.
- *Rosbags over our text*: the calculation of `rosbags` on the text of this project. It verifies the calculation, not
  that the text is that of the release: without a stronger source a difference from it would not show here.

Where another distribution has other fields under the same name, its form is in `interfaces_humble` or
`interfaces_main`, with a separate module such as `nav2_msgs_humble`. `variants.tsv` has their hashes over our text.

The table counts types by package and strongest source. A service counts as itself, and by its request, response and
event if they have a source.

";

#[test]
fn the_list_of_checked_hashes_is_true() {
    // Package, then the best source of each type.
    let mut packages: BTreeMap<&str, BTreeMap<&str, usize>> = BTreeMap::new();
    let tables = [include_str!("data/hashes.tsv"), include_str!("data/published.tsv")];
    for line in tables.iter().flat_map(|table| table.lines()) {
        let [name, _, source] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("{line} has not three columns");
        };
        let rank = SOURCES.iter().position(|(known, _)| *known == source).unwrap_or(SOURCES.len());
        assert!(rank < SOURCES.len(), "{line} has a source that is not explained");
        let package = name.split('/').next().unwrap_or_default();
        let best = packages.entry(package).or_default().entry(name).or_insert(rank);
        *best = rank.min(*best);
    }
    let known: BTreeSet<String> = TypeRegistry::builtin()
        .type_names()
        .filter_map(|name| name.split('/').next().map(str::to_owned))
        .collect();
    let checked: BTreeSet<String> = packages.keys().map(|name| (*name).to_owned()).collect();
    let unchecked: Vec<&String> = known.difference(&checked).collect();
    let mut text = HEAD.to_owned();
    let titles: Vec<&str> = SOURCES.iter().map(|(_, title)| *title).collect();
    let _ = writeln!(text, "| Package | {} |\n|---|{}", titles.join(" | "), "---|".repeat(5));
    let mut sums = [0; SOURCES.len()];
    for (package, types) in &packages {
        let mut counts = [0; SOURCES.len()];
        types.values().for_each(|rank| counts[*rank] += 1);
        sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        let _ = writeln!(text, "| `{package}` | {} |", row(&counts));
    }
    let _ = writeln!(text, "| all | {} |", row(&sums));
    if !unchecked.is_empty() {
        let unchecked: Vec<String> = unchecked.iter().map(|name| format!("`{name}`")).collect();
        let _ = writeln!(text, "\nNot verified: {}.", unchecked.join(", "));
    }
    expect_file!["../../../../docs/type-hashes.md"].assert_eq(&text);
}

fn row(counts: &[usize]) -> String {
    let shown = |count: &usize| if *count == 0 { String::new() } else { count.to_string() };
    counts.iter().map(shown).collect::<Vec<_>>().join(" | ")
}
