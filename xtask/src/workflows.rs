//! `cargo xtask workflows`: the files of GitHub's runners: actionlint, and the tests of the action `periplus-check`.

use std::path::Path;
use std::process::Command;

use crate::step::{Failed, build_native, root, run};

/// Checks the workflows, and the action with a program. Missing tools are reported.
pub(crate) fn check(program: Option<&Path>) -> Result<(), Failed> {
    if Command::new("actionlint").arg("-version").output().is_ok() {
        run(Command::new("actionlint").current_dir(root()), "see the findings above")?;
        println!("actionlint: no findings");
    } else {
        let install = "go install github.com/rhysd/actionlint/cmd/actionlint@latest";
        eprintln!("SKIPPED: there is no actionlint: `{install}`");
    }
    let program = match program {
        Some(program) => root().join(program),
        None => build_native()?,
    };
    let mut tests = Command::new("python3");
    tests.args(["-B", "-m", "unittest"]);
    tests.current_dir(root().join(".github/actions/periplus-check"));
    tests.env("PERIPLUS_PROGRAM", program);
    run(&mut tests, "see the failures above; it needs Python 3.11")
}

#[test]
fn the_recipe_of_conda_has_the_version_of_the_workspace() {
    let recipe = include_str!("../../packaging/conda/recipe.yaml");
    assert!(recipe.contains(concat!("\n  version: ", env!("CARGO_PKG_VERSION"), "\n")));
}
