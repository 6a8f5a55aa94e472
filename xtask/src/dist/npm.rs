//! The package for npm: the module of the browser tab with a class of JavaScript and its types.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::{build, licenses, packages};
use super::{make_folder, read, version, write};
use crate::step::{Failed, cargo, root, run};

/// Folder of the files that only the package has.
const OWN: &str = "crates/apps/tab/npm";

/// Target without an operating system, as browsers run it.
const TARGET: &str = "wasm32-unknown-unknown";

/// Files of the package: name, and path in the tree.
const FILES: [(&str, &str); 4] = [
    ("core.mjs", "crates/apps/tab/scripts/core.mjs"),
    ("core.d.mts", "crates/apps/tab/scripts/core.d.mts"),
    ("README.md", "crates/apps/tab/npm/README.md"),
    ("LICENSE", "LICENSE"),
];

/// Packs the package into `out`, installs it into an empty folder, and runs the demo by it.
pub(super) fn pack(out: &Path) -> Result<(), Failed> {
    if Command::new("npm").arg("--version").output().is_err() {
        return Err(Failed("there is no npm: install Node 20 or newer".to_owned()));
    }
    let mut command = cargo();
    command.args(["build", "--quiet", "--locked", "--profile", "wasm", "--target", TARGET]);
    build::environment(&mut command, &root(), build::Profile::Dist)?;
    // C is not compiled for this target.
    command.env_remove("CFLAGS");
    let help = format!("see the errors above; `rustup target add {TARGET}` adds the target");
    run(command.args(["--package", "periplus-tab"]), &help)?;
    let folder = root().join("target/distribution/npm");
    if folder.exists() {
        std::fs::remove_dir_all(&folder)
            .map_err(|error| Failed(format!("cannot remove {}: {error}", folder.display())))?;
    }
    let (package, clean) = (folder.join("package"), folder.join("clean"));
    make_folder(&package)?;
    make_folder(&clean)?;
    for (name, path) in FILES {
        write(&package.join(name), &read(&root().join(path))?)?;
    }
    let module = root().join("target").join(TARGET).join("wasm/periplus_tab.wasm");
    let packages = packages::of_triple(&root(), "periplus-tab", TARGET)?;
    let apache = String::from_utf8_lossy(&read(&root().join("LICENSE"))?).into_owned();
    let terms = licenses::text(&packages, &apache)?;
    write(&package.join("THIRD-PARTY-LICENSES.txt"), terms.as_bytes())?;
    write(&package.join("periplus.wasm"), &read(&module)?)?;
    write(&package.join("package.json"), manifest()?.as_bytes())?;
    let mut packing = Command::new("npm");
    packing.args(["pack", "--silent", "--pack-destination"]).arg(out).current_dir(&package);
    run(&mut packing, "see the errors above")?;
    let archive = out.join(format!("periplus-core-{}.tgz", version()));
    let bytes = read(&archive)?.len();
    println!("{}: {:.1} MB", archive.display(), bytes as f64 * 1e-6);
    write(&clean.join("package.json"), b"{ \"private\": true }\n")?;
    let mut installing = Command::new("npm");
    installing.args(["install", "--silent", "--no-audit", "--no-fund", "--offline"]);
    run(installing.arg(&archive).current_dir(&clean), "see the errors above")?;
    write(&clean.join("use.mjs"), &read(&root().join(OWN).join("use.mjs"))?)?;
    run(Command::new("node").arg("use.mjs").current_dir(&clean), "see the failure above")
}

/// The manifest with the version of the workspace.
fn manifest() -> Result<String, Failed> {
    let path = root().join(OWN).join("package.json");
    let mut manifest: Value = serde_json::from_slice(&read(&path)?)
        .map_err(|error| Failed(format!("{}: {error}", path.display())))?;
    manifest["version"] = version().into();
    serde_json::to_string_pretty(&manifest)
        .map(|text| text + "\n")
        .map_err(|error| Failed(format!("{}: {error}", path.display())))
}
