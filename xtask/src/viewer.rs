//! The page: format, types, tests and build, and comparison of the build with the committed one in
//! `crates/transports/web/page`.

use std::path::PathBuf;
use std::process::Command;

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
    timed("page: build", || npm(&["run", "build"], "the page does not build"))?;
    timed("page: as committed", || {
        npm(
            &["run", "committed"],
            "`cargo xtask viewer build`, then commit crates/transports/web/page",
        )
    })
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
