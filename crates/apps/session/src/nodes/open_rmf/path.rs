//! Path that a fleet adapter has requested.

use periplus_geometry::Pose2;
use periplus_msgs::rmf_fleet_msgs::Location;
use periplus_sim::{FleetPathError, fleet_path_from, fleet_point_distance_m};

/// Distance at which a point that others follow counts as passed \[m\], the default of Nav2's `RemovePassedGoals`.
const PASSED_M: f64 = 0.5;

/// Points that are not reached yet.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct RequestedPath {
    rest: Vec<Location>,
    /// Number of points that were sent to the navigator, from the first.
    sent: usize,
}

impl RequestedPath {
    /// Path of a request, whose first point is where the robot is.
    ///
    /// # Errors
    /// When the robot is not there, or a number is not finite.
    pub(super) fn new(points: &[Location], pose: Pose2) -> Result<Self, FleetPathError> {
        let rest = fleet_path_from(points, pose)?;
        Ok(Self { rest: rest.to_vec(), sent: 0 })
    }

    pub(super) fn rest(&self) -> &[Location] {
        &self.rest
    }

    /// Points to send: all, or up to the first that has at least this index, where the robot waits.
    pub(super) fn send(&mut self, checkpoint: Option<u64>) -> &[Location] {
        let stop = checkpoint.and_then(|index| self.rest.iter().position(|it| it.index >= index));
        self.sent = stop.map_or(self.rest.len(), |stop| stop + 1);
        &self.rest[..self.sent]
    }

    /// True if the robot waits at a checkpoint that it has reached.
    pub(super) fn is_held_at(&self, checkpoint: u64, pose: Pose2) -> bool {
        let next = self.rest.first();
        next.is_some_and(|next| {
            next.index > checkpoint
                || next.index == checkpoint && fleet_point_distance_m(pose, next) < PASSED_M
        })
    }

    /// Removes points that the robot has passed on its way to others.
    pub(super) fn pass(&mut self, pose: Pose2) {
        while self.sent > 1
            && self.rest.first().is_some_and(|next| fleet_point_distance_m(pose, next) < PASSED_M)
        {
            self.rest.remove(0);
            self.sent -= 1;
        }
    }

    /// Removes the points that were sent: the navigator has reached the last of them.
    pub(super) fn arrive(&mut self) {
        self.rest.drain(..self.sent);
        self.sent = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f32, index: u64) -> Location {
        Location { x, index, ..Location::default() }
    }

    #[test]
    fn points_are_sent_passed_and_reached() {
        let points = [at(0.0, 3), at(1.0, 4), at(2.0, 7), at(3.0, 9)];
        let mut path = RequestedPath::new(&points, Pose2::IDENTITY).unwrap();
        assert_eq!(path.send(None).len(), 3);
        path.pass(Pose2::new(0.8, 0.0, 0.0));
        assert_eq!(path.rest().len(), 2);
        // The last point is reached by the navigator alone.
        path.pass(Pose2::new(2.9, 0.0, 0.0));
        path.pass(Pose2::new(2.0, 0.0, 0.0));
        assert_eq!(path.rest(), [at(3.0, 9)]);
        path.arrive();
        assert!(path.rest().is_empty());
    }

    #[test]
    fn a_checkpoint_ends_the_first_part() {
        let points = [at(0.0, 3), at(1.0, 4), at(2.0, 7), at(3.0, 9)];
        let mut path = RequestedPath::new(&points, Pose2::IDENTITY).unwrap();
        assert_eq!(path.send(Some(7)).len(), 2);
        assert!(!path.is_held_at(7, Pose2::IDENTITY));
        path.arrive();
        assert!(path.is_held_at(7, Pose2::new(2.0, 0.0, 0.0)));
        assert_eq!(path.send(None).len(), 1);
    }

    #[test]
    fn impossible_paths_are_refused() {
        let check = |points: &[Location], why: &str| {
            let refused = RequestedPath::new(points, Pose2::IDENTITY);
            assert_eq!(refused.map_err(|error| error.to_string()), Err(why.to_owned()));
        };
        check(&[], "it has no points");
        check(&[at(4.0, 0)], "it begins 4.0 m from the robot");
        check(&[at(f32::NAN, 0)], "a number is not finite");
    }
}
