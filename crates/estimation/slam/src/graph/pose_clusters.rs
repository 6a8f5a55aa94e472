//! Poses that move as one body, so that work and memory of the solver stay bounded.

use periplus_geometry::Stream;

use super::{ConstraintKind, Graph, Size};

/// Approximate maximum number of clusters.
const MAX_CLUSTER_COUNT: usize = 6000;
/// Only steps that are known this well are as if they were stiff: one standard deviation \[m\].
const FIRM_M: f64 = 0.05;

/// Returns the cluster of each pose, numbered in order. Up to some thousand poses each is its own cluster.
/// In a larger map a few consecutive poses are rigidly attached to the first of them: their relative poses
/// are known to a centimetre, and errors to be distributed over kilometres do not need every single step.
///
/// Cluster boundaries are random and change with every turn, so that no step stays rigid. They are random
/// because with alternating pairs a zigzag would hardly ever vanish: every cluster is pulled to both sides.
pub(crate) fn pose_clusters(graph: &Graph, (poses, edges): Size, turn: usize) -> Vec<u32> {
    let together = poses.div_ceil(MAX_CLUSTER_COUNT).max(1);
    let mut is_firm = vec![false; poses];
    for edge in graph.edges[..edges].iter().filter(|edge| edge.weight > 0.0) {
        let is_step = edge.kind == ConstraintKind::Sequential && edge.to == edge.from + 1;
        is_firm[edge.to] |= is_step && edge.covariances[0].largest_shift() < FIRM_M * FIRM_M;
    }
    let mut dice = Stream::keyed(0, "riders", turn as u64);
    let (mut body, mut size) = (0, 0);
    let bodies = is_firm.iter().map(|is_firm| {
        let is_drawn = dice.unit() * (together as f64) < 1.0;
        if size > 0 && (is_drawn || !is_firm || size >= 2 * together) {
            body += 1;
            size = 0;
        }
        size += 1;
        body
    });
    bodies.collect()
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use periplus_scan_matching::Symmetric3;

    use super::*;
    use crate::graph::Edge;

    /// A path of steps of which one is uncertain.
    fn way(poses: usize, loose: usize) -> Graph {
        let mut graph = Graph::default();
        for pose in 0..poses {
            graph.add_pose(Pose2::new(pose as f64, 0.0, 0.0));
            let known = if pose == loose { 1.0 } else { 1e4 };
            let information = Symmetric3::diagonal(known, known, 1e4);
            if pose > 0 {
                let step = Pose2::new(1.0, 0.0, 0.0);
                graph.add_edge(Edge::new(
                    (pose - 1, pose),
                    step,
                    information,
                    ConstraintKind::Sequential,
                ));
            }
        }
        graph
    }

    #[test]
    fn poses_of_small_maps_are_their_own() {
        let graph = way(MAX_CLUSTER_COUNT, 7);
        let bodies = pose_clusters(&graph, (MAX_CLUSTER_COUNT, MAX_CLUSTER_COUNT - 1), 3);
        assert!(bodies.into_iter().eq(0..MAX_CLUSTER_COUNT as u32));
    }

    #[test]
    fn poses_of_large_maps_ride_with_others_and_not_over_loose_steps() {
        let graph = way(3 * MAX_CLUSTER_COUNT, 7);
        let size = (3 * MAX_CLUSTER_COUNT, 3 * MAX_CLUSTER_COUNT - 1);
        let turns = [0, 1].map(|turn| pose_clusters(&graph, size, turn));
        assert_ne!(turns[0], turns[1]);
        for bodies in turns {
            assert_ne!(bodies[6], bodies[7]);
            assert!(bodies.windows(2).all(|it| it[1] == it[0] || it[1] == it[0] + 1));
            assert!(bodies.windows(7).all(|it| it[6] > it[0]));
            let count = bodies[3 * MAX_CLUSTER_COUNT - 1] as usize;
            assert!(
                (MAX_CLUSTER_COUNT * 9 / 10..MAX_CLUSTER_COUNT * 13 / 10).contains(&count),
                "{count}"
            );
        }
    }
}
