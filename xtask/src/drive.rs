//! Every robot of the corpus, driven.

use crate::step::{Failed, cargo, run};

/// Drives them in their worlds and prints what came of each; without the corpus it says so.
pub(crate) fn corpus() -> Result<(), Failed> {
    let mut test = cargo();
    test.args(["test", "--release", "--package", "periplus-sim", "--test", "corpus_drive", "--"]);
    test.args(["every_robot", "--nocapture"]);
    run(&mut test, "what is not explained stands at the end of the table")
}
