//! Force-torque sensors of joints.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DQuat, DVec3, Stream};
use periplus_scene::NoiseSpec;

use crate::navsat::apply_bias_and_noise;
use crate::{NoiseModel, Streams};

/// A force and a torque about a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force [N].
    pub force_n: DVec3,
    /// Torque about the point [N m].
    pub torque_n_m: DVec3,
}

impl Wrench {
    /// Rotates the wrench into other axes.
    #[must_use]
    pub fn turned(self, rotation: DQuat) -> Self {
        Self { force_n: rotation * self.force_n, torque_n_m: rotation * self.torque_n_m }
    }
}

/// Frame of a sensor's reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceFrame {
    /// Frame of the child link.
    Child,
    /// Frame of the parent link.
    Parent,
    /// Frame of the sensor.
    Sensor,
}

/// A force-torque sensor of a joint.
#[derive(Clone, Debug)]
pub struct ForceTorque {
    frame: ForceFrame,
    child_to_parent: bool,
    force: [NoiseModel; 3],
    torque: [NoiseModel; 3],
}

impl ForceTorque {
    /// Creates a sensor with SDF's `<frame>` and `<measure_direction>`, and noise along x, y, z.
    ///
    /// # Errors
    /// When frame or direction are not values of SDF.
    pub fn new(
        frame: &str,
        measure_direction: &str,
        force: &[NoiseSpec; 3],
        torque: &[NoiseSpec; 3],
        streams: &Streams,
    ) -> Result<Self, Box<Diagnostic>> {
        let unknown = |what: &str, written: &str, known: &[&str]| {
            let error = Diagnostic::error(
                "unknown-type",
                format!("`{written}` is not a {what} of a force-torque sensor"),
            );
            Box::new(error.help(format!("one of {}", known.join(", "))))
        };
        let frame = match frame {
            "child" => ForceFrame::Child,
            "parent" => ForceFrame::Parent,
            "sensor" => ForceFrame::Sensor,
            other => return Err(unknown("frame", other, &["child", "parent", "sensor"])),
        };
        let child_to_parent = match measure_direction {
            "child_to_parent" => true,
            "parent_to_child" => false,
            other => {
                let known = ["child_to_parent", "parent_to_child"];
                return Err(unknown("direction", other, &known));
            }
        };
        let three = |noises: &[NoiseSpec; 3], group: &str| {
            [(0, "x"), (1, "y"), (2, "z")].map(|(axis, name)| {
                NoiseModel::new(&noises[axis], streams, &format!("{group}/{name}"))
            })
        };
        let (force, torque) = (three(force, "force"), three(torque, "torque"));
        Ok(Self { frame, child_to_parent, force, torque })
    }

    /// Returns the frame of the readings.
    #[must_use]
    pub fn frame(&self) -> ForceFrame {
        self.frame
    }

    /// Returns the current reading, `dt_s` after the last. Inputs: the wrench of the parent on the
    /// child at the joint, in world axes, and the rotation of [`Self::frame`] in the world.
    pub fn measure(
        &mut self,
        parent_on_child: Wrench,
        world_from_frame: DQuat,
        dt_s: f64,
        stream: &mut Stream,
    ) -> Wrench {
        let sign = if self.child_to_parent { -1.0 } else { 1.0 };
        let Wrench { force_n, torque_n_m } = parent_on_child.turned(world_from_frame.conjugate());
        Wrench {
            force_n: apply_bias_and_noise(&mut self.force, force_n * sign, dt_s, stream),
            torque_n_m: apply_bias_and_noise(&mut self.torque, torque_n_m * sign, dt_s, stream),
        }
    }

    /// Resets to the initial state.
    pub fn reset(&mut self) {
        self.force.iter_mut().chain(&mut self.torque).for_each(NoiseModel::reset);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: [NoiseSpec; 3] = [NoiseSpec {
        kind: periplus_scene::NoiseKind::None,
        mean: 0.0,
        stddev: 0.0,
        bias_mean: 0.0,
        bias_stddev: 0.0,
        dynamic_bias_stddev: 0.0,
        dynamic_bias_correlation_time_s: 0.0,
        precision: 0.0,
    }; 3];

    /// A parent that supports 1 kg: 9.8 N upwards on the child, 9.8 N downwards on the parent.
    #[test]
    fn a_hanging_weight_pulls_down() {
        let streams = Streams::new(0, "ft");
        let held = Wrench { force_n: DVec3::Z * 9.8, torque_n_m: DVec3::ZERO };
        let read = |direction: &str| {
            let mut sensor = ForceTorque::new("child", direction, &NONE, &NONE, &streams).unwrap();
            sensor.measure(held, DQuat::IDENTITY, 0.0, &mut streams.tick(0)).force_n
        };
        assert_eq!(read("child_to_parent"), DVec3::new(-0.0, -0.0, -9.8));
        assert_eq!(read("parent_to_child"), DVec3::new(0.0, 0.0, 9.8));
    }

    #[test]
    fn unknown_values_are_rejected() {
        let streams = Streams::new(0, "ft");
        assert!(ForceTorque::new("world", "child_to_parent", &NONE, &NONE, &streams).is_err());
        assert!(ForceTorque::new("child", "up", &NONE, &NONE, &streams).is_err());
    }
}
