//! Files of an archive: the program with completions, manual pages, robots, worlds and terms.

use std::path::Path;
use std::process::Command;

use super::archive::{Files, PackedFile};
use super::licenses;
use super::packages;
use super::target::Target;
use super::{Sources, make_folder, read};
use crate::step::{Failed, build_native, root, run};

/// Folders of examples.
const FOLDERS: [&str; 2] = ["robots", "worlds"];

/// Texts at the top.
const TEXTS: [&str; 3] = ["README.md", "LICENSE", "CHANGELOG.md"];

/// Shells, and the names under which they look for completions.
const SHELLS: [(&str, &str); 4] = [
    ("bash", "completions/periplus.bash"),
    ("zsh", "completions/_periplus"),
    ("fish", "completions/periplus.fish"),
    ("powershell", "completions/periplus.ps1"),
];

/// Gathers the files for a target whose program is built.
pub(super) fn gather(sources: &Sources, target: &Target, program: &Path) -> Result<Files, Failed> {
    let source = &sources.folder;
    let mut files = Files::new();
    let packed = PackedFile { bytes: read(program)?, is_executable: true };
    files.insert(target.executable("periplus"), packed);
    for name in TEXTS {
        files.insert(name.to_owned(), PackedFile::data(read(&source.join(name))?));
    }
    for name in tracked(&FOLDERS)? {
        let file = PackedFile::data(read(&source.join(&name))?);
        files.insert(name, file);
    }
    let terms = PackedFile::data(terms(source, target)?);
    files.insert("THIRD-PARTY-LICENSES.txt".to_owned(), terms);
    let page = unpacked(&source.join("crates/transports/web/page/licenses.md.br"))?;
    files.insert("THIRD-PARTY-LICENSES-page.md".to_owned(), PackedFile::data(page));
    let native = match &sources.native {
        _ if target.is_native() => program.to_path_buf(),
        Some(native) => native.clone(),
        None => build_native()?,
    };
    generated(target, &native, &mut files)?;
    Ok(files)
}

/// Terms of all libraries in the program.
pub(super) fn terms(source: &Path, target: &Target) -> Result<String, Failed> {
    let packages = packages::of(source, "periplus-cli", target)?;
    let apache = String::from_utf8_lossy(&read(&source.join("LICENSE"))?).into_owned();
    licenses::text(&packages, &apache)
}

/// Completions and manual pages by a program that runs on this machine; they are equal on all targets.
fn generated(target: &Target, native: &Path, files: &mut Files) -> Result<(), Failed> {
    for (shell, path) in SHELLS {
        let output = Command::new(native).args(["completions", shell]).output();
        let output = output.map_err(|error| Failed(format!("{}: {error}", native.display())))?;
        if !output.status.success() || output.stdout.is_empty() {
            return Err(Failed(format!("`periplus completions {shell}` printed no script")));
        }
        files.insert(path.to_owned(), PackedFile::data(output.stdout));
    }
    if target.is_windows() {
        return Ok(());
    }
    let folder = root().join("target/distribution/man");
    if folder.exists() {
        std::fs::remove_dir_all(&folder)
            .map_err(|error| Failed(format!("cannot remove {}: {error}", folder.display())))?;
    }
    make_folder(&folder)?;
    run(Command::new(native).arg("man").arg(&folder), "see the error above")?;
    let entries = std::fs::read_dir(&folder)
        .map_err(|error| Failed(format!("cannot read {}: {error}", folder.display())))?;
    for entry in entries.filter_map(Result::ok) {
        let name = entry.file_name().to_string_lossy().into_owned();
        files.insert(format!("man/man1/{name}"), PackedFile::data(read(&entry.path())?));
    }
    Ok(())
}

/// Files that git tracks in some folders.
fn tracked(folders: &[&str]) -> Result<Vec<String>, Failed> {
    let mut command = Command::new("git");
    command.args(["ls-files", "-z", "--"]).args(folders).current_dir(root());
    let output = command.output().map_err(|error| Failed(format!("git: {error}")))?;
    let names = String::from_utf8_lossy(&output.stdout).into_owned();
    let names: Vec<String> = names.split_terminator('\0').map(str::to_owned).collect();
    if names.is_empty() {
        return Err(Failed("git lists no robots and worlds: build from a clone".to_owned()));
    }
    Ok(names)
}

/// Content of a file that is packed with Brotli.
fn unpacked(path: &Path) -> Result<Vec<u8>, Failed> {
    let packed = read(path)?;
    let mut bytes = Vec::new();
    std::io::Read::read_to_end(
        &mut brotli_decompressor::Decompressor::new(packed.as_slice(), 4096),
        &mut bytes,
    )
    .map_err(|error| Failed(format!("{}: {error}", path.display())))?;
    Ok(bytes)
}
