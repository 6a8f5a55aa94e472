//! Graphs as g2o reads them.

use std::fmt::Write as _;

use crate::engine::Slam;

impl Slam {
    /// Sum of the squared Mahalanobis distances of the active edges.
    #[must_use]
    pub fn chi2(&self) -> f64 {
        let graph = self.graph();
        graph.edges.iter().map(|edge| edge.weight * edge.chi2(&graph.poses)).sum()
    }

    /// The graph as text for g2o: a `VERTEX_SE2` for each key scan, an `EDGE_SE2` with its information
    /// for everything that is known between two, and `FIX 0`. Poses are those of the map as it is
    /// now. Edges that were found wrong and do not count are left out.
    ///
    /// g2o measures errors along the axes of where an edge leads, and this engine along those of
    /// where it begins: the information is turned accordingly.
    ///
    /// Source: `g2o/types/slam2d/edge_se2.h` and `vertex_se2.cpp`.
    #[must_use]
    pub fn to_g2o(&self) -> String {
        let graph = self.graph();
        let mut text = String::new();
        for (keyframe, pose) in graph.poses.iter().enumerate() {
            let _ =
                writeln!(text, "VERTEX_SE2 {keyframe} {} {} {}", pose.x_m, pose.y_m, pose.yaw_rad);
        }
        if !graph.poses.is_empty() {
            text.push_str("FIX 0\n");
        }
        for edge in graph.edges.iter().filter(|edge| edge.weight > 0.0) {
            let pose = edge.from_from_to;
            let at = (edge.information * edge.weight).turned(-pose.yaw_rad);
            let _ = writeln!(
                text,
                "EDGE_SE2 {} {} {} {} {} {} {} {} {} {} {}",
                edge.from,
                edge.to,
                pose.x_m,
                pose.y_m,
                pose.yaw_rad,
                at.xx,
                at.xy,
                at.xt,
                at.yy,
                at.yt,
                at.tt
            );
        }
        text
    }
}
