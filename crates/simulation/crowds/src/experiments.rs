//! Published experiments with people, repeated with a crowd: bottleneck, corridor with two directions, single file, and
//! speed by density in the plane.
//!
//! Each function builds the layout of an experiment, runs it, and returns the quantities that the paper reports. The
//! reference values are constants or functions beside them. `cargo xtask crowds` prints the table.

mod bottleneck;
mod lanes;
mod plane;
mod single_file;

pub use bottleneck::{BottleneckRun, KRETZ_SPECIFIC_FLOW_PER_M_S, bottleneck, seyfried_flow_per_s};
pub use lanes::{LanesRun, lanes};
pub use plane::{plane_speed_m_per_s, weidmann_speed_m_per_s};
pub use single_file::{
    SingleFileRun, chattaraj_speed_m_per_s, seyfried_speed_m_per_s, single_file,
};

use periplus_geometry::Stream;

use crate::agent::PersonSettings;
use glam::DVec2;

/// Free speed of people and its standard deviation (Weidmann 1993) \[m/s\].
const FREE_SPEED_M_PER_S: [f64; 2] = [1.34, 0.26];

/// Free speed of the participants of the laboratory experiments, and its standard deviation (J. Zhang, W. Klingsch, A.
/// Schadschneider, A. Seyfried, J. Stat. Mech. P06004, 2011) \[m/s\].
const STUDENT_SPEED_M_PER_S: [f64; 2] = [1.55, 0.18];

/// Walker at a position, with a free speed from a normal distribution within two standard deviations.
fn walker(position: DVec2, [mean, deviation]: [f64; 2], seed: u64, number: u64) -> PersonSettings {
    let mut stream = Stream::keyed(seed, "experiment walker", number);
    let free_speed = mean + deviation * stream.normal().clamp(-2.0, 2.0);
    PersonSettings::at(position).with_speed(free_speed)
}
