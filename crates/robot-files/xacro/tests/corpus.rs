//! The corpus of real files, compared with the output of PyPI's xacro.
//!
//! `cargo xtask corpus` runs the reference and then this test, with the file of its answers in
//! PERIPLUS_XACRO_ORACLE.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a test at the edge"
)]

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_os::Machine;
use periplus_resources::{Host as _, Resolver};
use periplus_xacro::{XacroContext, expand};
use periplus_xml::{canonical, decode, parse};
use serde_json::Value;

/// Files that are expanded here and refused by the reference, with the reasons.
const MORE_LENIENT: &[(&str, &str)] = &[(
    "xacro_tests/test/B.xacro",
    "scope=\"parent\" outside of macros: the reference means to warn, and crashes",
)];

#[test]
fn every_file_that_the_reference_expands_expands_to_the_same() {
    let Ok(answers) = std::env::var("PERIPLUS_XACRO_ORACLE") else {
        println!("SKIPPED: no reference answers; run `cargo xtask corpus`");
        return;
    };
    let answers = std::fs::read_to_string(answers).unwrap();
    let search = std::env::var("PERIPLUS_ORACLE_PATH").unwrap_or_default();
    let search: Vec<PathBuf> = std::env::split_paths(&search).collect();
    let host = Machine;
    let mut resolver = Resolver::new(&host, &search);
    let mut repository = PathBuf::new();
    let (mut same, mut refused_by_both, mut lenient) = (0, 0, 0);
    let mut wrong = Vec::new();
    for line in answers.lines() {
        let answer: Value = serde_json::from_str(line).unwrap();
        let path = PathBuf::from(answer["file"].as_str().unwrap());
        let root = path.ancestors().find(|at| at.parent().is_some_and(|p| p.ends_with("corpus")));
        // The corpus left out what marks a repository, so each is named as a user would name a
        // folder without such marks: `--resource-path`.
        if let Some(root) = root.filter(|root| *root != repository) {
            repository = root.to_owned();
            let folders: Vec<PathBuf> =
                search.iter().cloned().chain([repository.clone()]).collect();
            resolver = Resolver::new(&host, &folders);
        }
        let (ours, said) = run(&path, &host, &resolver);
        let known = MORE_LENIENT.iter().any(|(name, _)| path.ends_with(name));
        match (answer["xml"].as_str(), ours) {
            (Some(theirs), Some(ours)) if theirs == ours => same += 1,
            (Some(theirs), Some(ours)) => {
                wrong.push(format!("{}: differs: {}", path.display(), difference(theirs, &ours)));
            }
            (Some(_), None) => wrong.push(format!("{}: refused:\n{said}", path.display())),
            (None, Some(_)) if known => lenient += 1,
            (None, Some(_)) => {
                wrong.push(format!(
                    "{}: expands, the reference says {}",
                    path.display(),
                    answer["error"]
                ));
            }
            (None, None) => refused_by_both += 1,
        }
    }
    println!(
        "xacro: {same} the same, {refused_by_both} refused by both, {lenient} more lenient, {} wrong",
        wrong.len()
    );
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn run(path: &Path, host: &Machine, resolver: &Resolver<'_>) -> (Option<String>, String) {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let bytes = host.read(path).unwrap();
    let expanded = decode(&bytes).ok().and_then(|text| {
        let file = sources.add(path.display().to_string(), text);
        let document = parse(file, &sources, &mut diagnostics)?;
        let setting = XacroContext {
            path: path.to_owned(),
            working_folder: PathBuf::from("/"),
            arguments: Vec::new(),
            host,
            resolver,
        };
        expand(&document, setting, &mut sources, &mut diagnostics)
    });
    let said = diagnostics.iter().map(|d| render(d, &sources, RenderStyle::Plain)).collect();
    (expanded.map(|expanded| canonical(&expanded.document.root)), said)
}

fn difference(theirs: &str, ours: &str) -> String {
    let at = theirs.bytes().zip(ours.bytes()).position(|(a, b)| a != b);
    let at = at.unwrap_or_else(|| theirs.len().min(ours.len()));
    let cut = |text: &str| {
        let from = (0..=at.saturating_sub(60)).rev().find(|&i| text.is_char_boundary(i)).unwrap();
        text[from..].chars().take(140).collect::<String>()
    };
    format!("\n  theirs ...{}\n  ours   ...{}", cut(theirs), cut(ours))
}
