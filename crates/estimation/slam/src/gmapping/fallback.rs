//! Replacement of the particles' trajectory by the graph's where the particles do not close loops that the
//! graph closes.
//!
//! An offer is weighted by likelihood, and likelihood prefers the unknown: a torn trajectory that leads
//! through unseen space never contradicts earlier scans. Where the floor slopes or furniture has moved,
//! scans of the closed loop contradict each other here and there, and the torn trajectory wins. The
//! closures of the graph have their own evidence: independent witnesses, and an audit of the whole map.
//! They decide at the end, unless the audit contradicts the graph itself.

use periplus_geometry::Pose2;

use super::{Gmapping, Particle, offers};
use crate::engine::ConstraintKind;
use crate::local::apart;
use crate::remark::{Remark, RemarkKind};

/// A closure or tie is violated when the trajectory has its ends elsewhere, relative to each other, by more than
/// this \[m, rad\]. Twice the error that loops may have.
const VIOLATED_M: f64 = 0.4;
const VIOLATED_RAD: f64 = 0.2;

impl Gmapping {
    /// Gives the graph's trajectory to all particles if that of the best one violates its closures.
    pub(super) fn fall_back(&mut self) {
        let (Some(last), Some(best)) = (self.nodes.last(), self.particles.get(self.best)) else {
            return;
        };
        let is_doubtful = |it: &Remark| {
            matches!(
                it.kind,
                RemarkKind::Contradiction(..)
                    | RemarkKind::Disconnected(_)
                    | RemarkKind::UnmatchedScans(_)
            )
        };
        if self.front.remarks().iter().any(is_doubtful) {
            return;
        }
        let time_ns = last.node.time_ns;
        let way: Vec<Pose2> = self.nodes.iter().map(|it| self.front.pose_of(&it.node)).collect();
        let own = self.ways.to(best.tip);
        let violated = self.violated(&way, &own);
        if violated == 0 {
            return;
        }
        let drawn = offers::draw(&self.nodes, &way, &self.settings, &mut self.traces[0]);
        let (log, log_of_way) = (best.log, best.log_of_way);
        let tip = self.ways.along(&way);
        for number in 0..self.particles.len() {
            if number > 0 {
                self.ways.share(tip);
            }
            let before = &self.particles[number];
            self.ways.end(before.tip);
            self.particles[number] = Particle {
                map_from_base: way[way.len() - 1],
                cells: drawn.cells.clone(),
                tip,
                log,
                log_of_way,
                is_matched: true,
                lasting: before.lasting,
            };
        }
        self.offered.accepted_count += 1;
        self.remarks.push(Remark { time_ns, kind: RemarkKind::GraphFollowed(violated) });
    }

    /// Closures and ties of the graph that a trajectory violates.
    fn violated(&self, way: &[Pose2], own: &[Pose2]) -> usize {
        let keyframes = self.front.poses();
        // Where both have a kept scan: as seen from the nearest scan that was used.
        let both = |keyframe: usize| {
            let after = self.nodes.partition_point(|it| it.node.keyframe < keyframe);
            let near = [after.checked_sub(1), Some(after)].into_iter().flatten();
            let near = near.filter(|&it| it < self.nodes.len());
            let node = near.min_by_key(|&it| self.nodes[it].node.keyframe.abs_diff(keyframe))?;
            let (keyframe, way, own) = (keyframes.get(keyframe)?, way.get(node)?, own.get(node)?);
            Some((*keyframe, *own * (way.inverse() * *keyframe)))
        };
        let is_violated = |(old, new): (usize, usize)| {
            let (Some(old), Some(new)) = (both(old), both(new)) else { return false };
            let (metres, radians) = apart(old.0.inverse() * new.0, old.1.inverse() * new.1);
            metres > VIOLATED_M || radians > VIOLATED_RAD
        };
        let returns = self.front.links().filter(|(_, _, link)| *link != ConstraintKind::Sequential);
        returns.filter(|&(old, new, _)| is_violated((old, new))).count()
    }
}

#[cfg(test)]
#[path = "../../tests/worlds/mod.rs"]
mod worlds;

#[cfg(test)]
mod tests {
    use super::super::{GmappingSettings, Mapper};
    use super::worlds::{ROBOT, Robot, World};
    use super::*;

    #[test]
    fn closures_of_the_graph_decide_over_a_torn_map_that_explains_more() {
        let world = World::ring(50.0, 30.0, 2.4, 3);
        let corners = [
            (6.0, 0.0),
            (50.0, 0.0),
            (50.0, 30.0),
            (0.0, 30.0),
            (0.0, 0.0),
            (6.0, 0.0),
            (20.0, 0.0),
        ];
        let bad = Robot { way_error: 0.1, turn_error: 0.1, bias_rad_per_m: 0.03, ..ROBOT };
        let moments = world.drive(&corners, 0.5, &bad, 1);
        let mut slam = Gmapping::new(GmappingSettings { particles: 2, ..Default::default() });
        for moment in &moments {
            let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
        }
        // From the middle on 20 m aside, in the unknown, where nothing contradicts it.
        let mut torn = slam.ways.to(slam.particles[slam.best].tip);
        let middle = torn.len() / 2;
        for pose in &mut torn[middle..] {
            pose.y_m += 20.0;
        }
        for index in 0..slam.particles.len() {
            let tip = slam.ways.along(&torn);
            slam.ways.end(slam.particles[index].tip);
            slam.particles[index].tip = tip;
            slam.particles[index].map_from_base.y_m += 20.0;
            slam.particles[index].log_of_way = f64::INFINITY;
        }
        slam.finish();

        let truth_from_map = moments[0].truth * slam.trajectory()[0].1.inverse();
        let last = truth_from_map * slam.map_from_base();
        let (metres, _) = apart(last, moments[moments.len() - 1].truth);
        assert!(metres < 0.35, "{metres}");
        let is_told =
            |it: &Remark| matches!(it.kind, RemarkKind::GraphFollowed(count) if count > 0);
        assert!(slam.remarks().iter().any(is_told), "{:?}", slam.remarks());
        // Once: the map is that of the graph now.
        slam.finish();
        assert_eq!(slam.remarks().iter().filter(|it| is_told(it)).count(), 1);
    }
}
