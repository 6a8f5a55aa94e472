//! Doors: walls that open.

use crate::wall::Wall;

/// Number of a door, in the order in which doors were added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DoorId(pub usize);

/// Door of a floor. Routes lead through doors, open or closed; people queue in front of a closed one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Door {
    /// The leaf, when closed.
    pub leaf: Wall,
    /// True while people can pass.
    pub is_open: bool,
    /// Operation of the door.
    pub control: DoorControl,
}

/// Operation of a door.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DoorControl {
    /// Opened and closed by the program.
    Manual,
    /// Opens a while after a person came within a range, and closes when the range is empty.
    Automatic {
        /// Distance from the leaf \[m\].
        range_m: f64,
        /// Time from the request until the door is open \[s\].
        opening_s: f64,
    },
}

/// Door with its clock.
#[derive(Clone, Debug)]
pub(crate) struct DoorRecord {
    pub(crate) door: Door,
    /// Time since the request of an automatic door \[s\].
    pub(crate) requested_s: f64,
}

impl DoorRecord {
    /// Advances an automatic door by a step.
    pub(crate) fn step(&mut self, nearest_agent_m: f64, body_m: f64, step_s: f64) {
        let DoorControl::Automatic { range_m, opening_s } = self.door.control else { return };
        if nearest_agent_m <= range_m {
            self.requested_s += step_s;
            if self.requested_s >= opening_s {
                self.door.is_open = true;
            }
        } else if nearest_agent_m > body_m {
            self.requested_s = 0.0;
            self.door.is_open = false;
        }
    }
}
