//! Helpers shared by tests of whole files.
#![allow(dead_code, reason = "each test program uses a part")]

use std::path::{Path, PathBuf};

use periplus_diagnostics::{RenderStyle, render};
use periplus_loader::{LoadContext, LoadedFile, describe, load, summarise};
use periplus_os::Machine;
use periplus_resources::{Host, MemoryHost, Resolver};

/// This crate's folder: paths in messages are shown from here.
pub(crate) fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Reads a file with the working directory `folder`.
pub(crate) fn read(host: &dyn Host, folder: &Path, path: &Path, search: &[PathBuf]) -> LoadedFile {
    let resolver = Resolver::new(host, search);
    let setting = LoadContext {
        host,
        resolver: &resolver,
        working_folder: folder.to_owned(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    load(path, &setting)
}

/// Findings and contents of a file, as `periplus check` shows them.
pub(crate) fn shown(loaded: &LoadedFile) -> String {
    let findings =
        loaded.diagnostics.iter().map(|d| render(d, &loaded.sources, RenderStyle::Plain) + "\n");
    let mut out: String = findings.collect();
    if let Some(scene) = &loaded.scene {
        out.push_str(&describe(&summarise(scene)));
    }
    out
}

/// Findings about a file of this crate.
pub(crate) fn said_of(path: &str) -> String {
    shown(&read(&Machine, &folder(), Path::new(path), &[]))
}

/// Findings about a text with a given file name.
pub(crate) fn said_of_text(name: &str, text: &str) -> String {
    let host = MemoryHost::new().with_file(Path::new("/r").join(name), text);
    shown(&read(&host, Path::new("/r"), Path::new(name), &[]))
}
