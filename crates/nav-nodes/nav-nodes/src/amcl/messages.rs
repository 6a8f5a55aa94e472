//! Messages with the particles of localization.

use periplus_geometry::Pose2;
use periplus_localization::Particles;
use periplus_msgs::geometry_msgs;
use periplus_msgs::nav2_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_tf_ros::pose;

pub(crate) fn particle_cloud(
    particles: &Particles,
    time_ns: i64,
    frame: &str,
) -> nav2_msgs::ParticleCloud {
    let particle = |index: usize| nav2_msgs::Particle {
        pose: pose(particles.pose(index)),
        weight: particles.weight[index],
    };
    nav2_msgs::ParticleCloud {
        header: Header::at(time_ns, frame),
        particles: (0..particles.len()).map(particle).collect(),
    }
}

pub(crate) fn pose_array(
    all: impl Iterator<Item = Pose2>,
    time_ns: i64,
    frame: &str,
) -> geometry_msgs::PoseArray {
    geometry_msgs::PoseArray { header: Header::at(time_ns, frame), poses: all.map(pose).collect() }
}
