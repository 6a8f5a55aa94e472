//! People beside published experiments, and in an office with robots.

use crate::step::{Failed, cargo, run};

/// Experiment with people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CrowdExperiment {
    /// Published experiments.
    Published,
    /// Two hundred people and ten robots in an office.
    Office,
    /// AMCL, SLAM and costmaps of a robot among people.
    Accuracy,
}

/// Runs an experiment, and prints its tables.
pub(crate) fn run_experiment(experiment: CrowdExperiment) -> Result<(), Failed> {
    let mut command = cargo();
    match experiment {
        CrowdExperiment::Office => {
            command.args(["test", "--quiet", "--release", "--package", "periplus-crowds"]);
            command.args(["--test", "office", "--", "--ignored", "--nocapture"]);
        }
        CrowdExperiment::Published => {
            command.args(["run", "--quiet", "--release", "--package", "periplus-crowds"]);
            command.args(["--example", "experiments"]);
        }
        CrowdExperiment::Accuracy => {
            command.args(["run", "--quiet", "--release", "--package", "periplus-session"]);
            command.args(["--example", "people"]);
        }
    }
    run(&mut command, "see above")
}
