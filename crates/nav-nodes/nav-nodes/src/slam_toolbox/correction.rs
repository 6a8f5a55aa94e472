//! A second beginning of the map in the frame of the first, with a fault of the data undone.

use periplus_geometry::Pose2;
use periplus_slam::{CorrectedInput, MountingCorrection};

/// Pose from which odometry continues in the map: that of the first scan, or the last one set by a client.
pub(crate) struct Anchor {
    map_from_base: Pose2,
    odom_from_base: Pose2,
    /// Odometry since then with every step reversed: the only correction that depends on all steps.
    reversed: CorrectedInput,
}

impl Anchor {
    /// At a scan.
    pub(crate) fn new(map_from_base: Pose2, odom_from_base: Pose2) -> Self {
        let mut reversed = CorrectedInput::new(MountingCorrection::Reverse);
        reversed.odometry(odom_from_base);
        Self { map_from_base, odom_from_base, reversed }
    }

    /// Takes odometry at the next scan.
    pub(crate) fn follow(&mut self, odom_from_base: Pose2) {
        self.reversed.odometry(odom_from_base);
    }

    /// The correction from now on, and the robot's pose in the map by odometry that is corrected since
    /// the anchor: where it would have been without the fault.
    pub(crate) fn corrected(
        &self,
        remedy: MountingCorrection,
        odom_from_base: Pose2,
    ) -> (CorrectedInput, Pose2) {
        let mut cure = CorrectedInput::new(remedy);
        let then = cure.odometry(self.odom_from_base);
        if remedy == MountingCorrection::Reverse {
            cure = self.reversed.clone();
        }
        let now = cure.odometry(odom_from_base);
        (cure, (self.map_from_base * then.inverse() * now).normalized())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A robot that was set at (2, 1), facing along y, and drove 3 m ahead and 1 m to the left.
    #[test]
    fn the_pose_is_the_one_without_the_fault() {
        let said = Pose2::new(2.0, 1.0, std::f64::consts::FRAC_PI_2);
        let (ahead, left) = (Pose2::new(3.0, 0.0, 0.0), Pose2::new(0.0, 1.0, 0.0));
        let check = |remedy: MountingCorrection, wrong: &dyn Fn(Pose2) -> Pose2| {
            let mut anchor = Anchor::new(said, wrong(Pose2::IDENTITY));
            anchor.follow(wrong(ahead));
            anchor.follow(wrong(ahead * left));
            let (_, found) = anchor.corrected(remedy, wrong(ahead * left));
            assert!((found.x_m - 1.0).abs() < 1e-9, "{remedy:?} {found:?}");
            assert!((found.y_m - 4.0).abs() < 1e-9, "{remedy:?} {found:?}");
        };
        check(MountingCorrection::Flip, &|it| it);
        check(MountingCorrection::SwapAxes, &|it| Pose2::new(it.y_m, it.x_m, it.yaw_rad));
        check(MountingCorrection::NegateX, &|it| Pose2::new(-it.x_m, it.y_m, it.yaw_rad));
        check(MountingCorrection::NegateY, &|it| Pose2::new(it.x_m, -it.y_m, it.yaw_rad));
        check(MountingCorrection::Reverse, &|it| Pose2::new(-it.x_m, -it.y_m, it.yaw_rad));
    }
}
