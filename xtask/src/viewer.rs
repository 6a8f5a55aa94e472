//! The page: format, types, tests and build, and comparison of the build with the committed one in
//! `crates/transports/web/page`.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use crate::step::{Failed, build_program, root, run, timed};

/// Advice of every failure for want of Node.
const NEEDS_NODE: &str = "it needs Node 20 or newer with npm; see viewer/README.md";

/// Builds the page into the server's folder.
pub(crate) fn build() -> Result<(), Failed> {
    install()?;
    npm(&["run", "build"], "the page does not build")
}

/// Builds the page without a server into `target/tab/page`.
pub(crate) fn build_tab() -> Result<(), Failed> {
    install()?;
    npm(&["run", "--silent", "build:tab"], "the page does not build")?;
    npm(&["run", "--silent", "pack:tab"], "see above")
}

/// Checks and tests the page, and that the committed one is what its sources give.
pub(crate) fn check() -> Result<(), Failed> {
    install()?;
    timed("page: format", || {
        npm(&["run", "format"], "`npx prettier --write .` in viewer mends it")
    })?;
    timed("page: types", || npm(&["run", "check"], "see above"))?;
    timed("page: tests", || npm(&["test"], "see above"))?;
    timed("page: build", || {
        keeping_times(&root().join("crates/transports/web/page"), || {
            npm(&["run", "build"], "the page does not build")
        })
    })?;
    timed("page: as committed", || {
        npm(
            &["run", "committed"],
            "`cargo xtask viewer build`, then commit crates/transports/web/page",
        )
    })
}

/// Runs something that writes a folder again, and gives back their times to files that are as before: cargo would
/// compile again what includes them.
fn keeping_times(folder: &Path, write: impl FnOnce() -> Result<(), Failed>) -> Result<(), Failed> {
    let before = entries(folder);
    write()?;
    let after: BTreeMap<PathBuf, Entry> = entries(folder).into_iter().collect();
    // Inner folders after their files, and the outermost last.
    for (path, entry) in before.into_iter().rev() {
        let is_same = after.get(&path).is_some_and(|now| now.bytes == entry.bytes);
        if is_same && let (Ok(file), Some(changed)) = (File::open(&path), entry.changed) {
            // Without the right to set times there is only more to compile.
            let _ = file.set_modified(changed);
        }
    }
    Ok(())
}

/// File or folder.
struct Entry {
    /// Content of a file, or the names in a folder.
    bytes: Vec<u8>,
    changed: Option<SystemTime>,
}

/// A folder and all that is in it, folders before their files.
fn entries(folder: &Path) -> Vec<(PathBuf, Entry)> {
    let changed = |path: &Path| path.metadata().and_then(|it| it.modified()).ok();
    let mut names: Vec<PathBuf> = fs::read_dir(folder)
        .map(|entries| entries.filter_map(|entry| Some(entry.ok()?.path())).collect())
        .unwrap_or_default();
    names.sort();
    let listed = names.iter().map(|name| name.display().to_string()).collect::<Vec<_>>().join("\n");
    let own = Entry { bytes: listed.into_bytes(), changed: changed(folder) };
    let mut found = vec![(folder.to_owned(), own)];
    for path in names {
        if path.is_dir() {
            found.extend(entries(&path));
        } else {
            let bytes = fs::read(&path).unwrap_or_default();
            let entry = Entry { bytes, changed: changed(&path) };
            found.push((path, entry));
        }
    }
    found
}

/// Drives the page in a browser against a running `periplus`, where there is a browser.
pub(crate) fn in_browser() -> Result<(), Failed> {
    with_browser("page: in a browser", &["run", "e2e"])
}

/// Checks the main states of the page by the rules of axe, where there is a browser.
pub(crate) fn axe() -> Result<(), Failed> {
    with_browser("page: axe", &["run", "e2e", "--", "axe"])
}

/// Measures the time from the prompt to the first picture, and the size of the page.
pub(crate) fn bench() -> Result<(), Failed> {
    with_browser("page: first picture", &["run", "--silent", "bench:first"])
}

/// Checks the documentation site in a browser, where there is one.
pub(crate) fn site() -> Result<(), Failed> {
    install()?;
    if has_browser() { npm(&["run", "--silent", "e2e:site"], "see above") } else { Ok(()) }
}

fn with_browser(name: &str, words: &[&str]) -> Result<(), Failed> {
    install()?;
    if !has_browser() {
        return Ok(());
    }
    timed("page: periplus", build_program)?;
    timed(name, || npm(words, "see above"))
}

/// True if there is a Chromium; otherwise it prints what is skipped.
fn has_browser() -> bool {
    let is_there = browser().is_some();
    if !is_there {
        println!("SKIPPED: no Chromium to open pages with; apt-get install chromium");
    }
    is_there
}

fn install() -> Result<(), Failed> {
    let changed = |name: &str| folder().join(name).metadata().and_then(|file| file.modified()).ok();
    let installed = changed("node_modules/.package-lock.json");
    let is_current = installed.is_some() && installed >= changed("package-lock.json");
    if is_current { Ok(()) } else { npm(&["ci", "--no-audit", "--no-fund"], NEEDS_NODE) }
}

fn npm(words: &[&str], help: &str) -> Result<(), Failed> {
    run(Command::new("npm").args(words).current_dir(folder()), help)
}

fn folder() -> PathBuf {
    root().join("viewer")
}

/// A Chromium that the tests can drive.
fn browser() -> Option<PathBuf> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let usual = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
    named.into_iter().chain(usual.map(PathBuf::from)).find(|program| program.exists())
}
