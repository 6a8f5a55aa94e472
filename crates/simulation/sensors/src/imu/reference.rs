//! Reference frames of an IMU's orientation.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DQuat, DVec3, Rpy, parse_numbers, quaternion_from_rpy};
use periplus_scene::Element;

/// Reference frame of an IMU's orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OrientationReference {
    /// The initial orientation of the sensor, rotated.
    Start {
        /// `start_from_reference`.
        start_from_reference: DQuat,
    },
    /// A frame fixed in the world.
    World {
        /// `world_from_reference`.
        world_from_reference: DQuat,
    },
}

/// Element of SDF.
const ELEMENT: &str = "orientation_reference_frame";

impl OrientationReference {
    /// The initial orientation: gz-sensors' default.
    pub const START: Self = Self::Start { start_from_reference: DQuat::IDENTITY };
    /// The world frame: required by REP 145 and used by ROS plugins.
    pub const WORLD: Self = Self::World { world_from_reference: DQuat::IDENTITY };

    /// Reads SDF's `<localization>`; returns `None` if it is absent. `heading_rad` is the heading of
    /// the world's x axis, counterclockwise from east.
    ///
    /// # Errors
    /// When the elements do not define a frame.
    pub fn read(
        imu: &periplus_scene::ImuSpec,
        heading_rad: f64,
        gravity_m_s2: DVec3,
    ) -> Result<Option<Self>, Box<Diagnostic>> {
        let Some(localization) = &imu.localization else { return Ok(None) };
        let rotation = |roll, pitch, yaw| quaternion_from_rpy(Rpy { roll, pitch, yaw });
        let world_from_enu = rotation(0.0, 0.0, -heading_rad);
        let frame = imu.extra.iter().find(|element| element.name == ELEMENT);
        let world_from_reference = match localization.as_str() {
            "ENU" => world_from_enu,
            // x north, y west, z up.
            "NWU" => rotation(0.0, 0.0, std::f64::consts::FRAC_PI_2 - heading_rad),
            // x north, y east, z down: half a turn about the line between east and north.
            "NED" => {
                let half = std::f64::consts::FRAC_1_SQRT_2;
                world_from_enu * DQuat::from_xyzw(half, half, 0.0, 0.0)
            }
            "GRAV_UP" => by_gravity(-gravity_m_s2, frame)?,
            "GRAV_DOWN" => by_gravity(gravity_m_s2, frame)?,
            "CUSTOM" => return custom(frame).map(Some),
            other => {
                return Err(Diagnostic::error(
                    "unknown-localization",
                    format!("`{other}` is not an orientation reference of an IMU"),
                )
                .help("one of CUSTOM, ENU, NED, NWU, GRAV_UP, GRAV_DOWN")
                .into());
            }
        };
        Ok(Some(Self::World { world_from_reference }))
    }
}

/// Z along `z`, x along the projection of `<grav_dir_x>`.
fn by_gravity(z: DVec3, frame: Option<&Element>) -> Result<DQuat, Box<Diagnostic>> {
    let child = frame.and_then(|frame| frame.child("grav_dir_x"));
    let ahead = match child {
        Some(child) => three(child)?,
        None => DVec3::X,
    };
    let z = z.normalize_or_zero();
    let x = (ahead - z * ahead.dot(z)).normalize_or_zero();
    if z == DVec3::ZERO || x == DVec3::ZERO {
        let mut error = Diagnostic::error(
            "no-reference-frame",
            "gravity and `<grav_dir_x>` do not define a frame: one is zero, or they are parallel",
        );
        if let Some(child) = child {
            error = error.at(child.origin);
        }
        return Err(error.help("use a direction across gravity, such as 1 0 0").into());
    }
    // First rotate z, then rotate about it until x fits.
    let upright = DQuat::from_rotation_arc(DVec3::Z, z);
    let start = upright * DVec3::X;
    let (sine, cosine) = libm::sincos(libm::atan2(start.cross(x).dot(z), start.dot(x)) / 2.0);
    let about_z = DQuat::from_xyzw(z.x * sine, z.y * sine, z.z * sine, cosine);
    Ok((about_z * upright).normalize())
}

/// Reads `<custom_rpy parent_frame="">`: relative to the initial orientation, or to the world.
fn custom(frame: Option<&Element>) -> Result<OrientationReference, Box<Diagnostic>> {
    let Some(child) = frame.and_then(|frame| frame.child("custom_rpy")) else {
        return Ok(OrientationReference::START);
    };
    let [roll, pitch, yaw] = three(child)?.to_array();
    let turn = quaternion_from_rpy(Rpy { roll, pitch, yaw });
    match child.value("parent_frame").unwrap_or_default() {
        "" => Ok(OrientationReference::Start { start_from_reference: turn }),
        "world" => Ok(OrientationReference::World { world_from_reference: turn }),
        other => Err(Diagnostic::error(
            "unknown-parent-frame",
            format!("an orientation relative to `{other}` is not supported"),
        )
        .at(child.origin)
        .help("leave `parent_frame` empty (initial orientation of the sensor), or use `world`")
        .into()),
    }
}

fn three(element: &Element) -> Result<DVec3, Box<Diagnostic>> {
    let numbers = parse_numbers(&element.text()).unwrap_or_default();
    match <[f64; 3]>::try_from(numbers) {
        Ok(numbers) if numbers.iter().all(|number| number.is_finite()) => {
            Ok(DVec3::from_array(numbers))
        }
        _ => Err(Diagnostic::error(
            "bad-value",
            format!("`<{}>` must be three numbers", element.name),
        )
        .at(element.text_origin())
        .into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn imu(localization: &str, child: Option<Element>) -> periplus_scene::ImuSpec {
        let none = [periplus_scene::NoiseSpec::default(); 3];
        let frame = child.map(|child| Element::new(ELEMENT).with_child(child));
        periplus_scene::ImuSpec {
            angular_velocity: none,
            linear_acceleration: none,
            enable_orientation: true,
            localization: Some(localization.into()),
            extra: frame.into_iter().collect(),
        }
    }

    const DOWN: DVec3 = DVec3::new(0.0, 0.0, -9.8);

    /// Axes x, y, z of the reference in the world.
    fn axes(localization: &str, child: Option<Element>, heading_rad: f64) -> [[f64; 3]; 3] {
        let read = OrientationReference::read(&imu(localization, child), heading_rad, DOWN);
        let Ok(Some(OrientationReference::World { world_from_reference })) = read else {
            panic!("{read:?}")
        };
        [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
            (world_from_reference * axis).to_array().map(|x| (x * 1e9).round() / 1e9 + 0.0)
        })
    }

    const EAST: [f64; 3] = [1.0, 0.0, 0.0];
    const NORTH: [f64; 3] = [0.0, 1.0, 0.0];
    const UP: [f64; 3] = [0.0, 0.0, 1.0];
    const WEST: [f64; 3] = [-1.0, 0.0, 0.0];
    const BELOW: [f64; 3] = [0.0, 0.0, -1.0];

    #[test]
    fn letters_name_the_axes() {
        assert_eq!(axes("ENU", None, 0.0), [EAST, NORTH, UP]);
        assert_eq!(axes("NWU", None, 0.0), [NORTH, WEST, UP]);
        assert_eq!(axes("NED", None, 0.0), [NORTH, EAST, BELOW]);
        // The world's x points north: east is to its right.
        let right = [0.0, -1.0, 0.0];
        assert_eq!(axes("ENU", None, std::f64::consts::FRAC_PI_2), [right, EAST, UP]);
    }

    #[test]
    fn gravity_makes_a_frame_with_a_direction_ahead() {
        assert_eq!(axes("GRAV_UP", None, 0.0), [EAST, NORTH, UP]);
        let ahead = Element::new("grav_dir_x").with_text("0 2 5");
        assert_eq!(axes("GRAV_UP", Some(ahead.clone()), 0.0), [NORTH, WEST, UP]);
        assert_eq!(axes("GRAV_DOWN", Some(ahead), 0.0), [NORTH, EAST, BELOW]);
    }

    #[test]
    fn invalid_frames_are_rejected() {
        let up = Element::new("grav_dir_x").with_text("0 0 1");
        for imu in [imu("GRAV_UP", Some(up)), imu("UPSIDE", None)] {
            assert!(OrientationReference::read(&imu, 0.0, DOWN).is_err());
        }
        assert!(OrientationReference::read(&imu("GRAV_UP", None), 0.0, DVec3::ZERO).is_err());
    }

    #[test]
    fn a_custom_frame_is_against_the_start_or_the_world() {
        let element = Element::new("custom_rpy").with_text("0 0 0");
        let read =
            |element: Element| OrientationReference::read(&imu("CUSTOM", Some(element)), 0.0, DOWN);
        assert_eq!(read(element.clone()), Ok(Some(OrientationReference::START)));
        let world = element.clone().with_attribute("parent_frame", "world");
        assert_eq!(read(world), Ok(Some(OrientationReference::WORLD)));
        assert!(read(element.with_attribute("parent_frame", "arm::link")).is_err());
    }
}
