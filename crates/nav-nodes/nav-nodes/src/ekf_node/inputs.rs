//! Subscriptions of the filter.

use periplus_diagnostics::Diagnostic;
use periplus_ekf::{Ekf, Intake, Kind, Source};
use periplus_geometry::Pose;
use periplus_graph::{Actor, GraphError, Qos};
use periplus_msgs::geometry_msgs::{PoseWithCovarianceStamped, TwistWithCovarianceStamped};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::sensor_msgs::Imu;
use periplus_tf_ros::{Frames, plain};

use crate::ekf_node::messages::{of_imu, of_pose, of_twist};
use crate::ekf_node::node::State;

/// Subscribes to the topic of the input with an index.
pub(crate) fn hear(
    actor: &mut Actor<State>,
    source: &Source,
    number: usize,
) -> Result<(), GraphError> {
    let (topic, qos) = (source.topic.as_str(), Qos::best_effort(source.queue));
    match source.kind {
        Kind::Odometry => actor.subscribe::<Odometry>(topic, qos, move |state, message, io| {
            state.take(number, io.node(), |desk| desk.odometry(&message));
        }),
        Kind::Pose => {
            actor.subscribe::<PoseWithCovarianceStamped>(topic, qos, move |state, message, io| {
                state.take(number, io.node(), |desk| {
                    let (time_ns, frame) = (message.header.stamp.ns(), &message.header.frame_id);
                    desk.pose(&message.pose, time_ns, frame)
                });
            })
        }
        Kind::Twist => {
            actor.subscribe::<TwistWithCovarianceStamped>(topic, qos, move |state, message, io| {
                state.take(number, io.node(), |desk| {
                    let (time_ns, frame) = (message.header.stamp.ns(), &message.header.frame_id);
                    desk.twist(&message.twist, time_ns, frame)
                });
            })
        }
        Kind::Imu => actor.subscribe::<Imu>(topic, qos, move |state, message, io| {
            state.take(number, io.node(), |desk| desk.imu(&message));
        }),
    }
}

/// Converter from the messages of an input to measurements.
pub(crate) struct Desk<'a> {
    pub(crate) intake: &'a mut Intake,
    pub(crate) ekf: &'a mut Ekf,
    pub(crate) frames: &'a Frames,
    pub(crate) world: &'a str,
    pub(crate) base: &'a str,
}

type Taken = Result<(), Box<Diagnostic>>;

impl Desk<'_> {
    fn odometry(&mut self, message: &Odometry) -> Taken {
        let time_ns = message.header.stamp.ns();
        self.pose(&message.pose, time_ns, &message.header.frame_id)?;
        self.twist(&message.twist, time_ns, &message.child_frame_id)
    }

    fn pose(
        &mut self,
        message: &periplus_msgs::geometry_msgs::PoseWithCovariance,
        time_ns: i64,
        frame: &str,
    ) -> Taken {
        if !self.intake.source().mask[..6].contains(&true) {
            return Ok(());
        }
        // Differences between poses are the same in every frame.
        let is_differential = self.intake.source().is_differential;
        let world_from_frame = match is_differential {
            true => Pose::IDENTITY,
            false => self.between(self.world, frame, time_ns, "world_frame")?,
        };
        let Some(reading) = of_pose(message, time_ns, world_from_frame) else {
            return Err(self.broken("its quaternion has no length"));
        };
        if let Some(measurement) = self.intake.pose(&reading) {
            self.ekf.push(measurement);
        }
        Ok(())
    }

    fn twist(
        &mut self,
        message: &periplus_msgs::geometry_msgs::TwistWithCovariance,
        time_ns: i64,
        frame: &str,
    ) -> Taken {
        if !self.intake.source().mask[6..12].contains(&true) {
            return Ok(());
        }
        let base_from_sensor = self.between(self.base, frame, time_ns, "base_link_frame")?;
        let reading = of_twist(message, time_ns, base_from_sensor);
        if let Some(measurement) = self.intake.twist(&reading, self.ekf.estimate()) {
            self.ekf.push(measurement);
        }
        Ok(())
    }

    fn imu(&mut self, message: &Imu) -> Taken {
        let (time_ns, frame) = (message.header.stamp.ns(), &message.header.frame_id);
        let base_from_sensor = self.between(self.base, frame, time_ns, "base_link_frame")?;
        let gravity_mps2 = self.ekf.settings().gravity_mps2;
        let reading = of_imu(message, base_from_sensor);
        let lacks = |from: usize, to: usize| {
            self.intake.source().mask[from..to].contains(&true)
                && match from {
                    3 => reading.world_from_sensor.is_none(),
                    9 => reading.angular.is_none(),
                    _ => reading.acceleration.is_none(),
                }
        };
        let what = [(3, 6, "attitude"), (9, 12, "turn rate"), (12, 15, "acceleration")];
        let missing = what.into_iter().find(|(from, to, _)| lacks(*from, *to));
        for measurement in self.intake.imu(&reading, self.ekf.estimate(), gravity_mps2) {
            self.ekf.push(measurement);
        }
        let name = &self.intake.source().name;
        missing.map_or(Ok(()), |(.., what)| {
            Err(Box::new(
                Diagnostic::warning("imu-without", format!("`{name}` tells no {what}")).help(
                    format!("its covariance begins with -1; leave it out of `{name}_config`"),
                ),
            ))
        })
    }

    /// Returns the transform of the frame of a message; an empty frame is the target frame.
    fn between(
        &self,
        target: &str,
        frame: &str,
        time_ns: i64,
        parameter: &str,
    ) -> Result<Pose, Box<Diagnostic>> {
        if plain(frame).is_empty() || plain(frame) == plain(target) {
            return Ok(Pose::IDENTITY);
        }
        let found =
            self.frames.at(target, frame, time_ns).or_else(|_| self.frames.at(target, frame, 0));
        found.map(|(pose, _)| pose).map_err(|_| {
            let Source { name, topic, .. } = self.intake.source();
            let why = self.frames.missing(target, frame);
            Box::new(
                Diagnostic::error(
                    "no-input-transform",
                    format!("`{name}` ({topic}) is dropped: no transform from `{frame}` to `{target}`: {why}"),
                )
                .help(format!(
                    "start robot_state_publisher or a static transform, or set `{parameter}`"
                )),
            )
        })
    }

    fn broken(&self, why: &str) -> Box<Diagnostic> {
        let Source { name, topic, .. } = self.intake.source();
        let words = format!("a message of `{name}` ({topic}) is dropped: {why}");
        Box::new(Diagnostic::error("broken-input", words))
    }
}
