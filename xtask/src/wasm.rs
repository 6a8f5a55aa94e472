//! The simulator in WebAssembly: the crates that must compile for it, the module of the browser tab, and its bag,
//! which must be that of the native program byte for byte.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Failed, build_program, cargo, root, run, timed};

/// Target without an operating system, as browsers run it.
const TARGET: &str = "wasm32-unknown-unknown";

/// Crates that stay free of threads, sockets and files where they are compiled for [`TARGET`]: those that the tab
/// uses, and libraries that are useful in a page.
const CRATES: [&str; 12] = [
    "periplus-tab",
    "periplus-session",
    "periplus-sim",
    "periplus-nav-nodes",
    "periplus-web",
    "periplus-bags",
    "periplus-loader",
    "periplus-crowds",
    "periplus-environments",
    "periplus-evaluation",
    "periplus-calibration",
    "periplus-faults",
];

/// Checks the crates where the standard library of the target is installed, and reports it where it is not.
pub(crate) fn check_if_installed() -> Result<(), Failed> {
    let printed =
        Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]).output();
    let is_installed = printed.is_ok_and(|output| {
        Path::new(String::from_utf8_lossy(&output.stdout).trim()).join("").is_dir()
    });
    if !is_installed {
        eprintln!("SKIPPED: {TARGET} is not installed; `rustup target add {TARGET}` adds it");
        return Ok(());
    }
    check()
}

/// Checks that all crates of the tab compile for WebAssembly.
pub(crate) fn check() -> Result<(), Failed> {
    let mut command = cargo();
    command.args(["check", "--quiet", "--target", TARGET]);
    command.args(CRATES.iter().flat_map(|name| ["-p", name]));
    run(
        &mut command,
        "these crates must compile for WebAssembly; `rustup target add wasm32-unknown-unknown` adds the target",
    )
}

fn build_module() -> Result<(), Failed> {
    let words = ["build", "--quiet", "--profile", "wasm", "--target", TARGET];
    run(cargo().args(words).args(["-p", "periplus-tab"]), "see the errors above")
}

/// Builds the page without a server into `target/tab/page`: static files, each beside its copy with Brotli.
pub(crate) fn page() -> Result<(), Failed> {
    timed("wasm: module", build_module)?;
    timed("wasm: page", crate::viewer::build_tab)
}

/// Builds the module, and compares the demo in it with that of the native program for some simulated seconds.
pub(crate) fn all(seconds: u32) -> Result<(), Failed> {
    timed("wasm: crates", check)?;
    timed("wasm: module", build_module)?;
    if Command::new("node").arg("--version").output().is_err() {
        println!("SKIPPED: no node to run the module with; it needs Node 20 or newer");
        return Ok(());
    }
    timed("wasm: periplus", build_program)?;
    timed("wasm: the same bag as the native program", || same_bag(seconds))?;
    timed("wasm: sessions from files, checks, archives and maps", same_files)
}

/// A log of an old scanner, with loops; it is outside of the repository.
const LOG: &str = "../shared/datasets/intel/raw.clf";

/// Runs files of the repository in the module and in the native program, and compares the results.
fn same_files() -> Result<(), Failed> {
    let mut command = Command::new("node");
    command.arg(root().join("crates/apps/tab/scripts/files.mjs")).arg(module());
    command
        .arg(root().join("target/release/periplus"))
        .arg(root())
        .arg(root().join("target/tab/files"));
    let log = root().join(LOG);
    if log.is_file() {
        command.arg(log);
    } else {
        println!("SKIPPED: no {LOG} to map");
    }
    run(&mut command, "the results must be equal; see above")
}

/// Path of the module.
fn module() -> PathBuf {
    root().join("target").join(TARGET).join("wasm/periplus_tab.wasm")
}

fn same_bag(seconds: u32) -> Result<(), Failed> {
    let out = root().join("target/tab");
    std::fs::create_dir_all(&out)
        .map_err(|error| Failed(format!("cannot create {}: {error}", out.display())))?;
    let seconds = seconds.to_string();
    let native = out.join("native");
    let mut command = Command::new(root().join("target/release/periplus"));
    command.args(["demo", "--headless", "--bag-compression", "none", "--duration", &seconds]);
    run(command.arg("--out").arg(&native), "see above")?;
    let module = module();
    let mut command = Command::new("node");
    command.arg(root().join("crates/apps/tab/scripts/demo.mjs")).arg(&module).arg(&seconds);
    command.arg(out.join("tab.mcap")).arg(native.join("demo.mcap"));
    run(
        &mut command,
        "the bags must be equal: a function differs by platform, such as `f64::sin` in place of `libm::sin`",
    )?;
    sizes(&module)
}

/// Prints the size of the module, raw and with Brotli.
fn sizes(module: &Path) -> Result<(), Failed> {
    let script = "const {readFileSync} = require('fs'), z = require('zlib'); \
        const bytes = readFileSync(process.argv[1]); \
        const packed = z.brotliCompressSync(bytes, {params: \
            {[z.constants.BROTLI_PARAM_SIZE_HINT]: bytes.length, [z.constants.BROTLI_PARAM_LGWIN]: 24}}); \
        console.log(`${bytes.length} bytes, ${packed.length} bytes with Brotli 11`)";
    run(Command::new("node").args(["-e", script]).arg(module), "see above")
}
