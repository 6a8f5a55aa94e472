//! `cargo xtask workflows`: the files of GitHub's runners: actionlint, and the tests of the action `periplus-check`.

use std::process::Command;

use crate::step::{Failed, build_program, root, run};

/// Checks the workflows, and the action with the release program. Missing tools are reported.
pub(crate) fn check() -> Result<(), Failed> {
    if Command::new("actionlint").arg("-version").output().is_ok() {
        run(Command::new("actionlint").current_dir(root()), "see the findings above")?;
        println!("actionlint: no findings");
    } else {
        let install = "go install github.com/rhysd/actionlint/cmd/actionlint@latest";
        eprintln!("SKIPPED: there is no actionlint: `{install}`");
    }
    build_program()?;
    let mut tests = Command::new("python3");
    tests.args(["-B", "-m", "unittest"]);
    tests.current_dir(root().join(".github/actions/periplus-check"));
    tests.env("PERIPLUS_PROGRAM", root().join("target/release/periplus"));
    run(&mut tests, "see the failures above; it needs Python 3.11")
}
