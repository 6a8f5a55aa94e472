//! Every robot of the corpus, driven.

use crate::step::{Failed, cargo, run};

/// Drives them in their worlds and prints the results; without the corpus it prints that it was skipped.
pub(crate) fn corpus() -> Result<(), Failed> {
    let mut test = cargo();
    test.args(["test", "--release", "--package", "periplus-sim", "--test", "corpus_drive", "--"]);
    test.args(["every_robot", "--nocapture"]);
    run(&mut test, "unexplained differences are at the end of the table")
}
