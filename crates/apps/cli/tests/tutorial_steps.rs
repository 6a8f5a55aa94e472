//! The table of steps (`docs/tutorials/steps.md`) compared with the tutorials and tests that it names.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, reason = "files of the project are read")]
#![allow(clippy::print_stderr, reason = "skipped tests are reported")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..")
}

/// A row: line numbers in the tutorial, and the cells from the second on.
struct Row {
    lines: Vec<usize>,
    cells: Vec<String>,
}

#[derive(Default)]
struct Table {
    rows: Vec<Row>,
    read_only: Vec<usize>,
}

/// Parses `3`, `5-7`, and lists of them separated by commas.
fn numbers(text: &str) -> Vec<usize> {
    let part = |part: &str| {
        let (first, last) = part.trim().split_once('-').unwrap_or((part.trim(), part.trim()));
        first.parse::<usize>().unwrap()..=last.parse::<usize>().unwrap()
    };
    text.split(',').flat_map(part).collect()
}

fn tables() -> BTreeMap<String, Table> {
    let text = std::fs::read_to_string(root().join("docs/tutorials/steps.md")).unwrap();
    let mut tables: BTreeMap<String, Table> = BTreeMap::new();
    let mut name = String::new();
    for line in text.lines() {
        if let Some(title) = line.strip_prefix("## ") {
            title.clone_into(&mut name);
        } else if let Some(list) = line.strip_prefix("Lines without instructions: ") {
            tables.entry(name.clone()).or_default().read_only = numbers(list.trim_end_matches('.'));
        } else if line.starts_with("| ") && !line.starts_with("| lines") {
            let cells = line.trim_matches('|').split(" | ").map(|cell| cell.trim().to_owned());
            let mut cells: Vec<String> = cells.collect();
            let lines = numbers(&cells.remove(0));
            tables.entry(name.clone()).or_default().rows.push(Row { lines, cells });
        }
    }
    tables
}

#[test]
fn what_works_has_a_test_that_exists() {
    let tables = tables();
    assert_eq!(tables.len(), 3);
    for (name, table) in &tables {
        for row in &table.rows {
            let place = format!("{name}, lines {:?}", row.lines);
            let [_, outcome, ..] = row.cells.as_slice() else {
                panic!("{place}: cells are missing")
            };
            let check = row.cells.get(3).map_or("", String::as_str);
            if outcome.starts_with("not applicable") || outcome == "to come" {
                continue;
            }
            assert!(outcome.starts_with("works"), "{place}: {outcome}");
            let (file, test) =
                check.split_once("` ").unwrap_or_else(|| panic!("{place}: no check"));
            let path = root().join(file.trim_start_matches('`'));
            let text = std::fs::read_to_string(&path);
            let text = text.unwrap_or_else(|_| panic!("{place}: there is no {}", path.display()));
            let written = if file.ends_with(".rs") {
                format!("fn {test}()")
            } else {
                // In quotes of either kind.
                test.to_owned()
            };
            assert!(text.contains(&written), "{place}: {file} has no test `{test}`");
        }
    }
}

#[test]
fn every_line_of_the_tutorials_has_its_place() {
    let folder = root().join("../shared/tutorials");
    if !folder.is_dir() {
        eprintln!("SKIPPED: the tutorials are not in {}", folder.display());
        return;
    }
    for (name, table) in tables() {
        let text = std::fs::read_to_string(folder.join(&name).with_extension("txt")).unwrap();
        let mut places: BTreeMap<usize, usize> = BTreeMap::new();
        let all = table.rows.iter().flat_map(|row| &row.lines).chain(&table.read_only);
        for line in all {
            *places.entry(*line).or_default() += 1;
        }
        for (number, line) in (1..).zip(text.lines()) {
            let count = places.remove(&number).unwrap_or(0);
            let is_empty = line.trim().is_empty();
            assert!(
                count == 1 || is_empty && count == 0,
                "{name}:{number} is in {count} places: {line}"
            );
        }
        assert!(places.is_empty(), "{name}: lines that are not there: {places:?}");
    }
}

#[test]
fn every_printed_command_is_in_a_row() {
    let tables = tables();
    for line in include_str!("tutorials/commands.tsv").lines() {
        if line.starts_with('#') || line.is_empty() {
            continue;
        }
        let mut parts = line.split('\t');
        let (name, number) = (parts.next().unwrap(), parts.next().unwrap().parse().unwrap());
        let is_there = tables[name].rows.iter().any(|row| row.lines.contains(&number));
        assert!(is_there, "{name}:{number} is in no row");
    }
}
