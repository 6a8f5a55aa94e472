//! People beside published experiments, and in an office with robots.

use crate::step::{Failed, cargo, run};

/// Prints the tables of the experiments, or runs the office.
pub(crate) fn run_experiments(office: bool) -> Result<(), Failed> {
    let mut command = cargo();
    if office {
        command.args(["test", "--quiet", "--release", "--package", "periplus-crowds", "--test"]);
        command.args(["office", "--", "--ignored", "--nocapture"]);
    } else {
        command.args(["run", "--quiet", "--release", "--package", "periplus-crowds"]);
        command.args(["--example", "experiments"]);
    }
    run(&mut command, "see above")
}
