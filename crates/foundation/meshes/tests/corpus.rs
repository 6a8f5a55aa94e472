//! Every mesh of the shared corpus of real robots and worlds loads.

#![allow(clippy::disallowed_methods, reason = "these files are not part of the repository")]

use std::path::{Path, PathBuf};

use periplus_meshes::{MeshFormat, read};

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../../shared/corpus");

fn meshes_below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a readable folder") {
        let path = entry.expect("a readable entry").path();
        if path.is_dir() {
            meshes_below(&path, found);
            continue;
        }
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if ["stl", "obj", "dae", "gltf", "glb"].contains(&extension.as_str()) {
            found.push(path);
        }
    }
}

#[test]
fn every_mesh_of_the_corpus_loads() {
    if !Path::new(CORPUS).is_dir() {
        println!("SKIPPED: no corpus at {CORPUS}");
        return;
    }
    let mut paths = Vec::new();
    meshes_below(Path::new(CORPUS), &mut paths);
    paths.sort();
    assert!(paths.len() >= 100, "only {} meshes found", paths.len());
    let mut failures = Vec::new();
    for path in &paths {
        let bytes = std::fs::read(path).unwrap();
        let name = path.strip_prefix(CORPUS).unwrap().display();
        let folder = path.parent().unwrap();
        let format = MeshFormat::from_path_and_bytes(&path.to_string_lossy(), &bytes).unwrap();
        match read(&bytes, format, &mut |file| std::fs::read(folder.join(file)).ok()) {
            Ok(mesh) => {
                let bounds = mesh.bounds().unwrap();
                println!(
                    "MESH\t{name}\t{}\t{}\t{:?}\t{:?}",
                    mesh.vertex_count(),
                    mesh.triangle_count(),
                    bounds.min_m,
                    bounds.max_m
                );
                for note in mesh.notes {
                    println!("NOTE\t{name}\t{}\t{}", note.count, note.message);
                }
            }
            Err(error) => failures.push(format!("{name}: {error}")),
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
