//! Models that the program itself inserts into a running world, like `spawn_entity.py`.

use periplus_geometry::Pose;

use super::reading::{Search, Source};
use super::spawn::{SpawnError, SpawnPose, SpawnRequest, spawn};
use crate::Simulation;

/// A model or light to insert.
#[derive(Clone, Debug)]
pub struct ModelInsertion<'a> {
    /// Source.
    pub from: InsertionSource<'a>,
    /// Name; empty for that of the text.
    pub name: &'a str,
    /// True if a number may be appended to a name that is in use.
    pub may_rename: bool,
    /// Namespace of all its topics; empty is none.
    pub namespace: &'a str,
    /// Pose of insertion; the pose of the text is relative to it.
    pub world_from_here: Pose,
    /// True if a URDF gets a `robot_state_publisher`.
    pub with_frames: bool,
}

/// Source of a model.
#[derive(Clone, Copy, Debug)]
pub enum InsertionSource<'a> {
    /// A text, and its name in findings, such as a topic; empty for the default.
    Text(&'a str, &'a str),
    /// A file, by path or URI.
    File(&'a str),
}

/// Result of an insertion.
#[derive(Clone, Debug)]
pub struct InsertionResult {
    /// Name in the world.
    pub name: String,
    /// Problems found; empty for none.
    pub notes: String,
}

impl ModelInsertion<'_> {
    /// Inserts the model or light.
    ///
    /// # Errors
    /// When the description cannot be read, the name is in use, or the model cannot be simulated.
    pub fn bring(
        &self,
        simulation: &mut Simulation,
        search: &Search,
    ) -> Result<InsertionResult, SpawnError> {
        let source = match self.from {
            InsertionSource::Text(text, called) => Source::Text(text, called),
            InsertionSource::File(file) => Source::File(file),
        };
        let wish = SpawnRequest {
            source,
            name: self.name,
            may_rename: self.may_rename,
            namespace: self.namespace,
            standing: SpawnPose::AsSeenFrom(self.world_from_here),
            with_frames: self.with_frames,
        };
        let spawned = spawn(simulation, search, &wish)?;
        simulation.exclude_from_changes(&spawned.name);
        Ok(InsertionResult { name: spawned.name, notes: spawned.notes })
    }
}
