//! Geodetic coordinates.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DQuat, DVec3, Rpy, parse_number, quaternion_from_rpy};
use periplus_scene::{Element, SphericalCoordinates};

/// Geodetic coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeodeticPosition {
    /// Latitude, north positive [rad].
    pub latitude_rad: f64,
    /// Longitude, east positive [rad].
    pub longitude_rad: f64,
    /// Height above the ellipsoid [m].
    pub altitude_m: f64,
}

/// An ellipsoid of revolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Semi-major axis [m].
    pub equatorial_m: f64,
    /// Semi-minor axis [m].
    pub polar_m: f64,
}

impl Ellipsoid {
    /// The Earth (WGS 84).
    pub const EARTH: Self = Self { equatorial_m: 6_378_137.0, polar_m: 6_356_752.314_245 };
    /// The Moon as in Gazebo's `MOON_SCS` (radii from NASA's fact sheet).
    pub const MOON: Self = Self { equatorial_m: 1_738_100.0, polar_m: 1_736_000.0 };

    /// Square of the first eccentricity.
    fn eccentricity_squared(self) -> f64 {
        1.0 - (self.polar_m * self.polar_m) / (self.equatorial_m * self.equatorial_m)
    }

    /// Converts to Earth-centred coordinates: x through the prime meridian, z through the north pole
    /// [m].
    #[must_use]
    pub fn to_ecef(self, position: GeodeticPosition) -> DVec3 {
        let (sine, cosine) = libm::sincos(position.latitude_rad);
        let (sine_east, cosine_east) = libm::sincos(position.longitude_rad);
        let squared = self.eccentricity_squared();
        let normal_m = self.equatorial_m / (1.0 - squared * sine * sine).sqrt();
        let out_m = (normal_m + position.altitude_m) * cosine;
        DVec3::new(
            out_m * cosine_east,
            out_m * sine_east,
            (normal_m * (1.0 - squared) + position.altitude_m) * sine,
        )
    }

    /// Converts to geodetic coordinates by three of Bowring's steps on the reduced latitude (Bowring
    /// 1976, "Transformation from spatial to geographical coordinates"); the error is below a
    /// micrometre from deep below to far above the surface.
    #[must_use]
    pub fn from_ecef(self, ecef_m: DVec3) -> GeodeticPosition {
        let Self { equatorial_m: a, polar_m: b } = self;
        let squared = self.eccentricity_squared();
        let second_squared = (a * a - b * b) / (b * b);
        let out_m = libm::hypot(ecef_m.x, ecef_m.y);
        let mut reduced = libm::atan2(ecef_m.z * a, out_m * b);
        let mut latitude_rad = 0.0;
        for _ in 0..3 {
            let (sine, cosine) = libm::sincos(reduced);
            latitude_rad = libm::atan2(
                ecef_m.z + second_squared * b * sine * sine * sine,
                out_m - squared * a * cosine * cosine * cosine,
            );
            let (sine, cosine) = libm::sincos(latitude_rad);
            reduced = libm::atan2(b * sine, a * cosine);
        }
        let (sine, cosine) = libm::sincos(latitude_rad);
        // Along the normal; accurate at the equator and at the poles.
        let altitude_m =
            out_m * cosine + ecef_m.z * sine - a * (1.0 - squared * sine * sine).sqrt();
        GeodeticPosition {
            latitude_rad,
            longitude_rad: libm::atan2(ecef_m.y, ecef_m.x),
            altitude_m,
        }
    }
}

/// Returns the axes of east, north and up in Earth-centred coordinates.
fn east_north_up(latitude_rad: f64, longitude_rad: f64) -> [DVec3; 3] {
    let (sine, cosine) = libm::sincos(latitude_rad);
    let (sine_east, cosine_east) = libm::sincos(longitude_rad);
    [
        DVec3::new(-sine_east, cosine_east, 0.0),
        DVec3::new(-sine * cosine_east, -sine * sine_east, cosine),
        DVec3::new(cosine * cosine_east, cosine * sine_east, sine),
    ]
}

/// A local tangent frame of a world on an ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalTangentFrame {
    ellipsoid: Ellipsoid,
    origin_m: DVec3,
    east_north_up: [DVec3; 3],
    enu_from_world: DQuat,
    heading_rad: f64,
}

impl LocalTangentFrame {
    /// Creates the frame from the world's spherical coordinates.
    ///
    /// # Errors
    /// When the surface or its axes are unknown, or a value is not finite.
    pub fn new(spherical: &SphericalCoordinates) -> Result<Self, Box<Diagnostic>> {
        let ellipsoid = match spherical.surface_model.as_str() {
            "EARTH_WGS84" => Ellipsoid::EARTH,
            "MOON_SCS" => Ellipsoid::MOON,
            "CUSTOM_SURFACE" => Ellipsoid {
                equatorial_m: axis(&spherical.extra, "surface_axis_equatorial")?,
                polar_m: axis(&spherical.extra, "surface_axis_polar")?,
            },
            other => {
                return Err(Diagnostic::error(
                    "unknown-surface",
                    format!("`{other}` is not a surface model"),
                )
                .help("one of EARTH_WGS84, MOON_SCS, CUSTOM_SURFACE")
                .into());
            }
        };
        let position = GeodeticPosition {
            latitude_rad: spherical.latitude_rad,
            longitude_rad: spherical.longitude_rad,
            altitude_m: spherical.elevation_m,
        };
        let heading_rad = spherical.heading_rad;
        let numbers =
            [position.latitude_rad, position.longitude_rad, position.altitude_m, heading_rad];
        if numbers.iter().any(|number| !number.is_finite()) {
            return Err(Diagnostic::error(
                "bad-value",
                "the world's spherical coordinates are not finite",
            )
            .into());
        }
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let turn = match spherical.frame_orientation.as_str() {
            // Half a turn about the line between east and north.
            "NED" => DQuat::from_xyzw(half, half, 0.0, 0.0),
            "NWU" => DQuat::from_xyzw(0.0, 0.0, half, half),
            _ => DQuat::IDENTITY,
        };
        let heading = quaternion_from_rpy(Rpy { roll: 0.0, pitch: 0.0, yaw: heading_rad });
        Ok(Self {
            ellipsoid,
            origin_m: ellipsoid.to_ecef(position),
            east_north_up: east_north_up(position.latitude_rad, position.longitude_rad),
            enu_from_world: heading * turn,
            heading_rad,
        })
    }

    /// Returns the heading of the world's x axis, counterclockwise from east [rad].
    #[must_use]
    pub fn heading_rad(&self) -> f64 {
        self.heading_rad
    }

    /// Converts a point of the world [m] to Earth-centred coordinates [m].
    #[must_use]
    pub fn to_ecef(&self, point_in_world_m: DVec3) -> DVec3 {
        self.origin_m + self.turned(point_in_world_m)
    }

    /// Converts a point of the world [m] to geodetic coordinates.
    #[must_use]
    pub fn position(&self, point_in_world_m: DVec3) -> GeodeticPosition {
        self.ellipsoid.from_ecef(self.to_ecef(point_in_world_m))
    }

    /// Converts a velocity in world axes to east, north, up at geodetic coordinates.
    #[must_use]
    pub fn velocity(&self, position: GeodeticPosition, velocity_in_world: DVec3) -> DVec3 {
        let enu_velocity = self.turned(velocity_in_world);
        let axes = east_north_up(position.latitude_rad, position.longitude_rad);
        DVec3::from_array(axes.map(|axis| axis.dot(enu_velocity)))
    }

    /// Moves geodetic coordinates east, north and up by distances in metres.
    #[must_use]
    pub fn offset_by(&self, position: GeodeticPosition, by_m: DVec3) -> GeodeticPosition {
        let [east, north, up] = east_north_up(position.latitude_rad, position.longitude_rad);
        let shift = east * by_m.x + north * by_m.y + up * by_m.z;
        self.ellipsoid.from_ecef(self.ellipsoid.to_ecef(position) + shift)
    }

    fn turned(&self, in_world: DVec3) -> DVec3 {
        let [east, north, up] = self.east_north_up;
        let enu = self.enu_from_world * in_world;
        east * enu.x + north * enu.y + up * enu.z
    }
}

fn axis(extra: &[Element], name: &str) -> Result<f64, Box<Diagnostic>> {
    let Some(element) = extra.iter().find(|element| element.name == name) else {
        return Err(Diagnostic::error(
            "missing-element",
            format!("a custom surface needs `<{name}>`"),
        )
        .help(format!("add `<{name}>` with a length in metres"))
        .into());
    };
    match parse_number(element.text().trim()) {
        Some(length_m) if length_m > 0.0 && length_m.is_finite() => Ok(length_m),
        _ => Err(Diagnostic::error("bad-value", format!("`<{name}>` must be a length above 0"))
            .at(element.text_origin())
            .into()),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn spherical(latitude: f64, longitude: f64, heading_rad: f64) -> SphericalCoordinates {
        SphericalCoordinates {
            surface_model: "EARTH_WGS84".into(),
            frame_orientation: "ENU".into(),
            latitude_rad: latitude.to_radians(),
            longitude_rad: longitude.to_radians(),
            elevation_m: 100.0,
            heading_rad,
            extra: Vec::new(),
        }
    }

    /// Distances east and north of coordinates near the origin [m].
    fn offset(frame: &LocalTangentFrame, position: GeodeticPosition) -> [f64; 2] {
        let origin = frame.position(DVec3::ZERO);
        let offset_m = frame.ellipsoid.to_ecef(position) - frame.origin_m;
        let axes = east_north_up(origin.latitude_rad, origin.longitude_rad);
        [axes[0].dot(offset_m), axes[1].dot(offset_m)]
    }

    /// A degree of latitude at the equator is 110.574 km, one of longitude 111.320 km (WGS 84).
    #[test]
    fn a_degree_is_as_long_as_it_should_be() {
        let at = |latitude: f64, longitude: f64| {
            Ellipsoid::EARTH.to_ecef(GeodeticPosition {
                latitude_rad: latitude.to_radians(),
                longitude_rad: longitude.to_radians(),
                altitude_m: 0.0,
            })
        };
        assert!((at(-0.5, 0.0).distance(at(0.5, 0.0)) - 110_574.0).abs() < 2.0);
        assert!((at(0.0, 0.0).distance(at(0.0, 1.0)) - 111_319.5).abs() < 2.0);
        assert!((at(90.0, 0.0).z - 6_356_752.314_245).abs() < 1e-6);
    }

    #[test]
    fn the_origin_comes_back() {
        let frame = LocalTangentFrame::new(&spherical(47.4, 8.5, 0.3)).unwrap();
        let position = frame.position(DVec3::ZERO);
        assert!((position.latitude_rad.to_degrees() - 47.4).abs() < 1e-12);
        assert!((position.longitude_rad.to_degrees() - 8.5).abs() < 1e-12);
        assert!((position.altitude_m - 100.0).abs() < 1e-8);
    }

    #[test]
    fn heading_turns_the_world_from_east_to_north() {
        let east = LocalTangentFrame::new(&spherical(47.4, 8.5, 0.0)).unwrap();
        let [x, y] = offset(&east, east.position(DVec3::X * 10.0));
        assert!((x - 10.0).abs() < 1e-6 && y.abs() < 1e-6, "{x} {y}");
        let north =
            LocalTangentFrame::new(&spherical(47.4, 8.5, std::f64::consts::FRAC_PI_2)).unwrap();
        let position = north.position(DVec3::X * 10.0);
        let [x, y] = offset(&north, position);
        assert!(x.abs() < 1e-6 && (y - 10.0).abs() < 1e-6, "{x} {y}");
        let velocity = north.velocity(position, DVec3::new(2.0, 0.0, 0.5));
        assert!(velocity.distance(DVec3::new(0.0, 2.0, 0.5)) < 1e-5, "{velocity}");
    }

    #[test]
    fn other_frames_and_surfaces() {
        let ned =
            SphericalCoordinates { frame_orientation: "NED".into(), ..spherical(0.0, 0.0, 0.0) };
        let frame = LocalTangentFrame::new(&ned).unwrap();
        assert!(frame.position(DVec3::X * 1000.0).latitude_rad > 1e-4);
        assert!((frame.position(DVec3::Z * 5.0).altitude_m - 95.0).abs() < 1e-6);
        let mut moon = SphericalCoordinates { surface_model: "MOON_SCS".into(), ..ned };
        let position = LocalTangentFrame::new(&moon).unwrap().position(DVec3::X * 1000.0);
        assert!(
            (position.latitude_rad - 1000.0 / (libm::pow(1_736_000.0_f64, 2.0) / 1_738_100.0))
                .abs()
                < 1e-6
        );
        moon.surface_model = "CUSTOM_SURFACE".into();
        assert!(LocalTangentFrame::new(&moon).is_err());
        let axis = |name: &str| Element::new(name).with_text("1000");
        moon.extra = vec![axis("surface_axis_equatorial"), axis("surface_axis_polar")];
        let ball = LocalTangentFrame::new(&moon).unwrap();
        assert!((ball.to_ecef(DVec3::ZERO).x - 1100.0).abs() < 1e-9);
        moon.surface_model = "MARS".into();
        assert!(LocalTangentFrame::new(&moon).is_err());
    }

    proptest! {
        #[test]
        fn places_come_back(
            latitude_rad in -1.57..1.57_f64,
            longitude_rad in -3.1..3.1_f64,
            altitude_m in -10_000.0..1_000_000.0_f64,
        ) {
            let position = GeodeticPosition { latitude_rad, longitude_rad, altitude_m };
            for ellipsoid in [Ellipsoid::EARTH, Ellipsoid::MOON] {
                let again = ellipsoid.from_ecef(ellipsoid.to_ecef(position));
                prop_assert!((again.latitude_rad - latitude_rad).abs() < 1e-12, "{again:?}");
                prop_assert!((again.altitude_m - altitude_m).abs() < 1e-5, "{again:?}");
                prop_assert!(ellipsoid.to_ecef(again).distance(ellipsoid.to_ecef(position)) < 1e-5);
            }
        }
    }
}
