//! Tests of the source tree: sizes, forbidden words, lints, the map in ARCHITECTURE.md.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::step::root;

/// No file of the tree is larger; bytes.
const LARGEST: u64 = 1 << 20;

/// Text that no file may contain, in two parts here so that this file does not contain it either, and why.
const FORBIDDEN: [(&str, &str); 3] = [
    (concat!("/wo", "rk/"), "a path of one machine"),
    (concat!("/tmp/", "target"), "a path of one machine"),
    (concat!("TO", "DO"), "name the owner: (name) must follow, or open an issue"),
];

/// Words with a slash that are not paths.
const NOT_PATHS: [&str; 6] = ["m/s", "m/s2", "rad/s", "and/or", "N/m", "I/O"];

/// All tracked files.
fn files() -> Vec<String> {
    let output = Command::new("git")
        .current_dir(root())
        .args(["ls-files", "-z"])
        .output()
        .expect("git lists the files of the tree");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let names = String::from_utf8(output.stdout).expect("file names are UTF-8");
    let exists = |name: &&str| !name.is_empty() && root().join(name).is_file();
    names.split('\0').filter(exists).map(str::to_owned).collect()
}

fn text(name: &str) -> Option<String> {
    String::from_utf8(fs::read(root().join(name)).ok()?).ok()
}

fn architecture() -> String {
    text("ARCHITECTURE.md").expect("ARCHITECTURE.md is missing: it is the map of the source tree")
}

#[track_caller]
fn none(faults: &[String]) {
    assert!(faults.is_empty(), "\n{}\n", faults.join("\n"));
}

/// The folders in a folder of the tree, as paths from its root.
fn folders(of: &str) -> Vec<String> {
    let entries = fs::read_dir(root().join(of)).unwrap_or_else(|error| panic!("{of}: {error}"));
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    names.map(|name| format!("{of}/{name}")).filter(|path| root().join(path).is_dir()).collect()
}

/// The folders of the workspace's crates, by wing, and of those beside the product.
fn members() -> Vec<String> {
    let mut members: Vec<String> =
        folders("crates").iter().flat_map(|wing| folders(wing)).collect();
    members.extend(["conformance", "xtask", "benches"].map(String::from));
    members.retain(|member| root().join(member).join("Cargo.toml").is_file());
    members.sort();
    members
}

#[test]
fn files_are_small() {
    let size = |name: &str| fs::metadata(root().join(name)).map_or(0, |data| data.len());
    let large = files().into_iter().filter(|name| size(name) > LARGEST);
    none(&large.map(|name| format!("{name} is over 1 MiB")).collect::<Vec<_>>());
}

#[test]
fn no_line_ends_in_space() {
    let mut faults = Vec::new();
    for name in files().iter().filter(|name| name.ends_with(".rs") || name.ends_with(".md")) {
        let text = text(name).unwrap_or_else(|| panic!("{name} is not UTF-8"));
        let lines = text.lines().enumerate();
        let untidy = lines.filter(|(_, line)| line.ends_with([' ', '\t', '\r']));
        faults.extend(untidy.map(|(at, _)| format!("{name}:{}: space at the end", at + 1)));
    }
    none(&faults);
}

/// True for a line with a forbidden word; a marked task with its owner is allowed.
fn says(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(at, _)| !line[at + word.len()..].starts_with('('))
}

#[test]
fn no_forbidden_words() {
    let mut faults = Vec::new();
    for name in files() {
        for (at, line) in text(&name).unwrap_or_default().lines().enumerate() {
            for (word, why) in FORBIDDEN.into_iter().filter(|(word, _)| says(line, word)) {
                faults.push(format!("{name}:{}: `{word}`: {why}", at + 1));
            }
        }
    }
    none(&faults);
}

/// Crates with vector instructions, C, or a C interface: they repeat the common lints, and deny unsafe code where the
/// others forbid it, so that modules can be let off. (Cargo has no way to inherit and differ.)
const WITH_UNSAFE: [&str; 3] =
    ["crates/transports/cyclonedds-sys", "crates/simulation/raycast", "crates/apps/tab"];

#[test]
fn every_crate_takes_the_common_lints() {
    let root = text("Cargo.toml").unwrap_or_default();
    let common: Vec<&str> = root
        .split("\n[")
        .filter(|section| section.starts_with("workspace.lints."))
        .flat_map(|section| section.lines().skip(1))
        .filter(|line| line.contains('=') && !line.starts_with("unsafe_code"))
        .collect();
    assert!(common.len() > 5, "the common lints are not found in Cargo.toml");
    let mut faults = Vec::new();
    for member in members() {
        let manifest = text(&format!("{member}/Cargo.toml")).unwrap_or_default();
        let manifest = manifest.replace("\r\n", "\n");
        if WITH_UNSAFE.contains(&member.as_str()) {
            let wanted = common.iter().copied().chain(["unsafe_code = \"deny\""]);
            let missing = wanted.filter(|lint| !manifest.lines().any(|line| line == *lint));
            faults.extend(missing.map(|lint| format!("{member}/Cargo.toml lacks `{lint}`")));
        } else if !manifest.contains("[lints]\nworkspace = true") {
            faults
                .push(format!("{member}/Cargo.toml: `[lints]` with `workspace = true` is missing"));
        }
    }
    none(&faults);
}

#[test]
fn the_map_names_every_crate() {
    let map = architecture();
    let named: BTreeSet<&str> =
        code_spans(&map).map(|(_, span)| span.trim_end_matches('/')).collect();
    let is_named = |member: &String| {
        let short = member.rsplit('/').next().unwrap_or(member);
        let package = format!("periplus-{short}");
        [member.as_str(), short, &package].iter().any(|name| named.contains(name))
    };
    let missing = members().into_iter().filter(|member| !is_named(member));
    let fault = |member| format!("ARCHITECTURE.md does not name `{member}`");
    none(&missing.map(fault).collect::<Vec<_>>());
}

#[test]
fn the_map_names_only_what_is_there() {
    let map = architecture();
    let wings = folders("crates");
    let there = |path: &String| {
        root().join(path).exists()
            || root().join("crates").join(path).exists()
            || wings.iter().any(|wing| root().join(wing).join(path).exists())
    };
    let named = named_paths(&map);
    assert!(named.len() > 3, "no paths were recognised in ARCHITECTURE.md: {named:?}");
    let gone = named.into_iter().filter(|path| !there(path));
    let fault = |path| format!("ARCHITECTURE.md names `{path}`, which is not there");
    none(&gone.map(fault).collect::<Vec<_>>());
}

/// The pieces of a Markdown text between single backticks, each with its line; not in code blocks.
fn code_spans(markdown: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut in_block = false;
    let prose = markdown.lines().filter(move |line| {
        let fence = line.trim_start().starts_with("```");
        in_block ^= fence;
        !in_block && !fence
    });
    prose.flat_map(|line| line.split('`').skip(1).step_by(2).map(move |span| (line, span)))
}

/// Paths that a Markdown text names: code with a slash, and under the heading "Code map" the
/// first piece of code of each entry.
fn named_paths(markdown: &str) -> BTreeSet<String> {
    let map_at = markdown.find("Code map\n").unwrap_or(markdown.len());
    let map_len = markdown[map_at..].find("\n## ").unwrap_or(markdown.len() - map_at);
    let entries = markdown[map_at..map_at + map_len].lines().filter_map(|line| {
        let entry = line.trim_start().trim_start_matches(['-', '*', '|', '#', ' ']);
        let is_entry = line.trim_start().starts_with(['-', '*', '|', '#']);
        entry.strip_prefix('`').filter(|_| is_entry)?.split('`').next()
    });
    let with_slash = code_spans(markdown).map(|(_, span)| span).filter(|span| span.contains('/'));
    with_slash.chain(entries).filter(|span| is_path(span)).map(str::to_owned).collect()
}

/// Not a command, a URI, a topic, a message type, a unit or a pattern.
fn is_path(span: &str) -> bool {
    let plain = |c: char| c.is_alphanumeric() || "/._-".contains(c);
    let first =
        Path::new(span).components().next().map(|first| first.as_os_str().to_string_lossy());
    span.chars().all(plain)
        && !span.starts_with(['/', '.']) | span.starts_with(".c")
        && !first.is_some_and(|first| first.ends_with("msgs") || first.ends_with("_srvs"))
        && !NOT_PATHS.contains(&span)
}

#[test]
fn paths_are_told_from_other_words() {
    let map = "Run `cargo xtask ci`, see `docs/a.md`, `/scan`, `std_msgs/String`, `m/s`, `a://b`.\n\
        ```\nnot/this\n```\n## Code map\n- `base`: `Pose`\n| `crates/foundation/xml/` | `Node` |\n\n## Else\n\
        - `word`\n";
    let named: Vec<String> = named_paths(map).into_iter().collect();
    assert_eq!(named, ["base", "crates/foundation/xml/", "docs/a.md"]);
}

#[test]
fn owners_are_seen() {
    let word = FORBIDDEN[2].0;
    assert!(says(&format!("// {word} later"), word));
    assert!(!says(&format!("// {word}(ada): later"), word));
}
