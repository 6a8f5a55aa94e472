//! Large recordings, against the wall.

use crate::step::{Failed, cargo, run};

/// Writes, converts and plays a recording of two gigabytes, beside `rosbags-convert`, and takes it
/// away again. Needs six gigabytes in the folder for temporary files.
pub(crate) fn bench() -> Result<(), Failed> {
    let mut speed = cargo();
    speed.args(["run", "--quiet", "--release", "--package", "periplus-bags"]);
    run(speed.args(["--example", "file_speed"]), "see that the folder for temporary files has room")
}
