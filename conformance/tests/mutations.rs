//! Every expectation of every case matters: a case in which one of them is changed does not pass.
//!
//! The default run takes a sample of each case. All changes of all cases:
//! `cargo test -p periplus-conformance --test mutations -- --ignored`.

#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a test that reads case files and prints how many it changed"
)]

use std::fs;
use std::path::{Path, PathBuf};

use periplus_conformance::{Setting, Verdict, run_text};
use periplus_os::Machine;
use serde_json::{Value, json};

/// Changes of each case in the default run.
const SAMPLE_COUNT: usize = 24;

/// Members of `expect` that are inputs of the check: with another input something else is expected.
const INPUTS: [&str; 7] = ["dx", "dy", "start", "end", "max_length", "min_length", "new_origin"];

/// Lists whose elements each hold their input and what it leads to.
const INDEPENDENT: [&str; 4] = ["moves", "offsets", "lines", "rays"];

/// A step into a value.
#[derive(Clone, Debug)]
enum Step {
    Key(String),
    Index(usize),
}

/// A change: where, what it becomes, and in words.
struct Change {
    at: Vec<Step>,
    to: Value,
    words: String,
}

fn changes(value: &Value, at: &[Step], out: &mut Vec<Change>) {
    let mut change = |to: Value, words: &str| {
        out.push(Change { at: at.to_vec(), to, words: words.to_owned() });
    };
    match value {
        Value::Null => change(json!(12345), "null becomes a number"),
        Value::Bool(truth) => {
            change(json!(!truth), "flipped");
            change(json!("true"), "becomes a text");
        }
        Value::Number(number) => {
            let number = number.as_f64().unwrap();
            change(json!(number + 1.0), "one more");
            change(json!(number - 1.0), "one less");
            change(json!("x"), "becomes a text");
        }
        Value::String(text) => {
            change(json!(format!("{text}x")), "a letter more");
            change(json!(0), "becomes a number");
        }
        Value::Array(list) => {
            change(
                json!(list.iter().chain([list.last().unwrap_or(&json!(1))]).collect::<Vec<_>>()),
                "longer",
            );
            // Of elements that hold their own input there may be fewer.
            let is_independent =
                matches!(at.last(), Some(Step::Key(name)) if INDEPENDENT.contains(&name.as_str()));
            if let Some((_, rest)) = list.split_last().filter(|_| !is_independent) {
                change(json!(rest), "shorter");
            }
        }
        Value::Object(members) => {
            for name in members.keys().filter(|name| *name != "note") {
                let renamed = |key: &String| {
                    if key == name { format!("{key}_") } else { key.clone() }
                };
                let other: serde_json::Map<String, Value> =
                    members.iter().map(|(key, it)| (renamed(key), it.clone())).collect();
                change(Value::Object(other), &format!("`{name}` is misspelt"));
            }
            if at.is_empty() {
                change(json!({}), "nothing is left");
            }
        }
    }
    let within = |step: Step, value: &Value, out: &mut Vec<Change>| {
        let mut at = at.to_vec();
        at.push(step);
        changes(value, &at, out);
    };
    match value {
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                within(Step::Index(index), value, out);
            }
        }
        Value::Object(members) => {
            for (name, value) in members {
                let is_remark = name == "note" && value.is_string();
                if !is_remark && !INPUTS.contains(&name.as_str()) {
                    within(Step::Key(name.clone()), value, out);
                }
            }
        }
        _ => {}
    }
}

fn place<'v>(value: &'v mut Value, at: &[Step]) -> &'v mut Value {
    at.iter().fold(value, |value, step| match step {
        Step::Key(name) => &mut value[name],
        Step::Index(index) => &mut value[index],
    })
}

/// Changed cases that pass all the same; how many were tried.
fn survivors(folder: &Path, sample: Option<usize>) -> (Vec<String>, usize) {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .map(|entries| entries.map(|entry| entry.unwrap().path()).collect())
        .unwrap_or_default();
    files.retain(|path| path.extension().is_some_and(|it| it == "json"));
    files.sort();
    let setting = Setting { folder, host: &Machine };
    let (mut survivors, mut count) = (Vec::new(), 0);
    for path in files {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let case: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        let mut all = Vec::new();
        changes(&case["expect"], &[], &mut all);
        // Evenly spread, and always the same ones.
        let stride = sample.map_or(1, |sample| all.len().div_ceil(sample).max(1));
        for change in all.iter().step_by(stride) {
            let mut changed = case.clone();
            *place(&mut changed["expect"], &change.at) = change.to.clone();
            count += 1;
            if run_text(&name, &changed.to_string(), &setting).verdict == Verdict::Passed {
                survivors.push(format!("{name}: {:?} {}", change.at, change.words));
            }
        }
    }
    (survivors, count)
}

fn folders() -> [PathBuf; 3] {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    ["cases", "../../shared/cases", "../../shared/nav/cases"].map(|folder| root.join(folder))
}

fn check(sample: Option<usize>) {
    for folder in folders() {
        let (survivors, count) = survivors(&folder, sample);
        if count == 0 {
            println!("SKIPPED: there are no cases in {}", folder.display());
        }
        println!("{count} changed cases of {}", folder.display());
        assert!(
            survivors.is_empty(),
            "{} of {count} changed cases pass:\n{}",
            survivors.len(),
            survivors.join("\n")
        );
    }
}

#[test]
fn no_changed_expectation_passes() {
    check(Some(SAMPLE_COUNT));
}

#[test]
#[ignore = "all changes take minutes; the sample runs by default"]
fn no_changed_expectation_passes_in_full() {
    check(None);
}
