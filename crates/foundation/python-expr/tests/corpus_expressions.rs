//! Every expression of the robots and worlds in ../shared/corpus parses.
#![allow(clippy::disallowed_methods, reason = "reads the shared corpus, where there is one")]
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use periplus_python_expr::Expression;

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| {
            ["xacro", "urdf", "gazebo", "xml", "launch", "yaml"]
                .iter()
                .any(|wanted| extension == *wanted)
        }) {
            found.push(path);
        }
    }
}

/// Texts between the delimiters, as split by xacro's lexer: up to the first closing delimiter.
fn between<'a>(text: &'a str, open: &'a str, close: char) -> impl Iterator<Item = &'a str> {
    text.split(open)
        .skip(1)
        .filter_map(move |rest| rest.split_once(close).map(|(inside, _)| inside))
}

#[test]
fn every_expression_of_the_corpus_parses() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/corpus");
    if !corpus.is_dir() {
        println!("SKIPPED: {} is missing", corpus.display());
        return;
    }
    let mut paths = Vec::new();
    files(&corpus, &mut paths);
    let mut expressions = BTreeSet::new();
    for path in paths {
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let text = text
            .replace("&quot;", "\"")
            .replace("&lt;", "<")
            .replace("&gt;", ">")
            .replace("&amp;", "&");
        // Other expressions in them are replaced before they are parsed, and only by text.
        let marked = text.replace("$(arg ", "$(ARG ");
        for inside in between(&text, "${", '}') {
            if inside.contains("$(") {
                continue;
            }
            expressions.insert((inside.trim().to_owned(), path.clone()));
        }
        for inside in between(&marked, "$(eval ", '"') {
            if let Some((inside, _)) = inside.rsplit_once(')')
                && !inside.contains("$(")
            {
                expressions.insert((inside.trim().to_owned(), path.clone()));
            }
        }
    }
    let failed: Vec<String> = expressions
        .iter()
        .filter_map(|(expression, path)| {
            Expression::parse(expression)
                .err()
                .map(|error| format!("{}: {expression}\n    {error}", path.display()))
        })
        .collect();
    assert!(expressions.len() > 600, "only {} expressions found", expressions.len());
    assert!(
        failed.is_empty(),
        "{} of {} do not parse:\n{}",
        failed.len(),
        expressions.len(),
        failed.join("\n")
    );
}
