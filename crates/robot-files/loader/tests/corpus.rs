//! Every file of the corpus: no panic, no hang; it loads or fails with a located error.
#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "a test at the edge")]

mod common;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use periplus_diagnostics::Severity;
use periplus_os::Machine;

use common::{folder, read};

/// Maximum time per file. Test machines are shared, and tests are built with little
/// optimisation; a release build is ten times faster.
const MAX_TIME: Duration = Duration::from_secs(2);

#[test]
fn every_file_loads_or_says_where_it_cannot() {
    let corpus = folder().join("../../../../shared/corpus");
    if !corpus.is_dir() {
        println!("SKIPPED: ../shared/corpus is not here");
        return;
    }
    let mut files = Vec::new();
    collect(&corpus, &mut files);
    files.sort();
    let mut table: BTreeMap<String, [usize; 4]> = BTreeMap::new();
    let mut wrong = Vec::new();
    for file in &files {
        let started = Instant::now();
        let loaded =
            read(&Machine, &corpus, file, std::slice::from_ref(&corpus.join("gazebo_models")));
        let took = started.elapsed();
        let name = file.strip_prefix(&corpus).unwrap_or(file).display();
        if took > MAX_TIME {
            wrong.push(format!("{name}: took {took:?}"));
        }
        let errors = loaded.diagnostics.errors();
        let has_result = loaded.document.is_some() || loaded.mesh.is_some();
        if !has_result && errors == 0 {
            wrong.push(format!("{name}: neither a result nor an error"));
        }
        let is_xml = loaded.mesh.is_none() && !name.to_string().to_lowercase().ends_with("stl");
        for finding in loaded.diagnostics.iter().filter(|d| d.severity == Severity::Error) {
            if finding.span.is_none() && is_xml {
                wrong.push(format!("{name}: an error without a place: {}", finding.message));
            }
        }
        let row = table.entry(loaded.language.name().to_owned()).or_default();
        row[0] += 1;
        row[1] += usize::from(errors == 0);
        row[2] += usize::from(errors > 0);
        row[3] += usize::from(loaded.diagnostics.is_empty());
    }
    println!("{:16} {:>6} {:>6} {:>6} {:>10}", "language", "files", "load", "errors", "no finding");
    for (language, [all, load, errors, clean]) in &table {
        println!("{language:16} {all:6} {load:6} {errors:6} {clean:10}");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn collect(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the corpus can be listed").flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, into);
        } else if wanted(&path) {
            into.push(path);
        }
    }
}

fn wanted(path: &Path) -> bool {
    const EXTENSIONS: [&str; 12] = [
        "xacro", "urdf", "sdf", "world", "gazebo", "launch", "config", "stl", "dae", "obj", "gltf",
        "glb",
    ];
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    EXTENSIONS.iter().any(|known| extension.eq_ignore_ascii_case(known))
}
