//! Models that the program itself brings into a running world, as `spawn_entity.py` does.

use periplus_geometry::Pose;

use super::reading::{Search, Source};
use super::spawn::{Standing, Wish, spawn};
use crate::Simulation;

/// A model or light that is to come.
#[derive(Clone, Debug)]
pub struct Arrival<'a> {
    /// What it is.
    pub from: ArrivalFrom<'a>,
    /// Its name; empty: as in the text.
    pub name: &'a str,
    /// Whether a number may be put behind a name that is taken.
    pub may_rename: bool,
    /// Of all its topics; empty is none.
    pub namespace: &'a str,
    /// Where it comes in; the pose in the text is as seen from there.
    pub world_from_here: Pose,
    /// Whether it gets a `robot_state_publisher` when it is a URDF.
    pub with_frames: bool,
}

/// Where the text of a model is.
#[derive(Clone, Copy, Debug)]
pub enum ArrivalFrom<'a> {
    /// Here, and its name in findings, such as a topic; empty for the usual one.
    Text(&'a str, &'a str),
    /// In a file, by its path or URI.
    File(&'a str),
}

/// What came.
#[derive(Clone, Debug)]
pub struct Arrived {
    /// What it is called.
    pub name: String,
    /// What was found wrong with it; empty when nothing was.
    pub notes: String,
}

impl Arrival<'_> {
    /// Brings it in.
    ///
    /// # Errors
    /// Why it is not there.
    pub fn bring(&self, simulation: &mut Simulation, search: &Search) -> Result<Arrived, String> {
        let source = match self.from {
            ArrivalFrom::Text(text, called) => Source::Text(text, called),
            ArrivalFrom::File(file) => Source::File(file),
        };
        let wish = Wish {
            source,
            name: self.name,
            may_rename: self.may_rename,
            namespace: self.namespace,
            standing: Standing::AsSeenFrom(self.world_from_here),
            with_frames: self.with_frames,
        };
        let spawned = spawn(simulation, search, &wish)?;
        Ok(Arrived { name: spawned.name, notes: spawned.notes })
    }
}
