//! Camera projections: from pixels to directions.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

use periplus_scene::{Camera, CameraKind, DVec3, Distortion, Element};

/// Maximum number of pixels of a camera: 8192 by 8192.
const MAX_PIXELS: u64 = 1 << 26;
/// Maximum number of iterations of the inverse distortion.
const MAX_ITERATIONS: usize = 64;

/// A camera projection with its image size. Its frame has x along the optical axis, y to the left, z up.
#[derive(Clone, Debug, PartialEq)]
pub struct Lens {
    width: u32,
    height: u32,
    kind: LensKind,
}

#[derive(Clone, Debug, PartialEq)]
enum LensKind {
    /// Focal length in pixels.
    Pinhole(f64),
    /// Direction of every pixel; `None` outside the lens's field of view.
    Table(Vec<Option<DVec3>>),
}

/// Slopes of the pixels of a pinhole: y and z per unit of x.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PinholeSlopes {
    focal_px: f64,
    /// Principal point from the upper left corner \[px\].
    middle: [f64; 2],
}

impl PinholeSlopes {
    pub(crate) fn left(&self, column: u32) -> f64 {
        -(f64::from(column) + 0.5 - self.middle[0]) / self.focal_px
    }

    pub(crate) fn up(&self, row: u32) -> f64 {
        -(f64::from(row) + 0.5 - self.middle[1]) / self.focal_px
    }
}

/// Property of a camera that no lens can have.
#[derive(Clone, Debug, PartialEq)]
pub enum LensError {
    /// An image without pixels, or with too many.
    ImageSize {
        /// Width \[px\].
        width: u32,
        /// Height \[px\].
        height: u32,
    },
    /// A horizontal field of view \[rad\] that a pinhole cannot have.
    PinholeFieldOfView(f64),
    /// A field of view \[rad\] that no camera can have.
    WideFieldOfView(f64),
    /// A distortion with a number that is not finite.
    Distortion,
    /// A field of view that this type of lens cannot cover.
    Coverage {
        /// Type of the lens.
        kind: String,
        /// Field of view \[rad\].
        fov_rad: f64,
    },
    /// An unknown type of lens.
    Type(String),
    /// An unknown function of a custom lens.
    Function(String),
    /// A constant of a custom lens that is not a number.
    FunctionConstants,
}

impl fmt::Display for LensError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ImageSize { width, height } => {
                write!(f, "an image of {width} by {height} pixels is not supported")
            }
            Self::PinholeFieldOfView(fov_rad) => write!(
                f,
                "a horizontal field of view of {fov_rad} rad is not possible with a pinhole: it has to \
                 be more than 0 and less than π"
            ),
            Self::WideFieldOfView(fov_rad) => {
                write!(f, "a field of view of {fov_rad} rad is not possible")
            }
            Self::Coverage { kind, fov_rad } => {
                write!(f, "a {kind} lens cannot cover {fov_rad} rad")
            }
            Self::Distortion => write!(f, "the distortion has a number that is not finite"),
            Self::Type(kind) => write!(
                f,
                "lens type `{kind}` is not known here; use gnomonical, stereographic, equidistant, \
                 equisolid_angle, orthographic or custom"
            ),
            Self::Function(function) => {
                write!(f, "lens function `{function}` is not supported: use sin, tan or id")
            }
            Self::FunctionConstants => write!(f, "c2 or c3 of the lens is not a valid number"),
        }
    }
}

impl std::error::Error for LensError {}

impl Lens {
    /// Returns an ideal pinhole: focal length `width / (2 tan(fov / 2))` pixels, principal point at
    /// the centre of the image.
    ///
    /// # Errors
    /// When the image has no pixels or too many, or the angle is not between 0 and π.
    pub fn pinhole(width: u32, height: u32, horizontal_fov_rad: f64) -> Result<Self, LensError> {
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 || pixels > MAX_PIXELS {
            return Err(LensError::ImageSize { width, height });
        }
        if !(1e-6..PI - 1e-6).contains(&horizontal_fov_rad) {
            return Err(LensError::PinholeFieldOfView(horizontal_fov_rad));
        }
        let focal_px = f64::from(width) / (2.0 * libm::tan(horizontal_fov_rad / 2.0));
        Ok(Self { width, height, kind: LensKind::Pinhole(focal_px) })
    }

    /// Returns the projection of a camera: pinhole, pinhole with Brown's distortion, or wide angle.
    ///
    /// # Errors
    /// The invalid property of the camera.
    pub fn of(camera: &Camera) -> Result<Self, LensError> {
        let (width, height, fov) = (camera.width, camera.height, camera.horizontal_fov_rad);
        if camera.kind == CameraKind::WideAngle {
            return wide_angle(camera);
        }
        let lens = Self::pinhole(width, height, fov)?;
        let distortion =
            camera.distortion.filter(|d| [d.k1, d.k2, d.k3, d.p1, d.p2].iter().any(|&k| k != 0.0));
        let (Some(distortion), LensKind::Pinhole(focal_px)) = (distortion, &lens.kind) else {
            return Ok(lens);
        };
        let [center_x, center_y] = distortion.center;
        let numbers = [
            distortion.k1,
            distortion.k2,
            distortion.k3,
            distortion.p1,
            distortion.p2,
            center_x,
            center_y,
        ];
        if numbers.iter().any(|number| !number.is_finite()) {
            return Err(LensError::Distortion);
        }
        let middle = [center_x * f64::from(width), center_y * f64::from(height)];
        let off = [
            (middle[0] - f64::from(width) / 2.0) / focal_px,
            (middle[1] - f64::from(height) / 2.0) / focal_px,
        ];
        let table = pixels(width, height).map(|[u, v]| {
            let distorted = [(u - middle[0]) / focal_px, (v - middle[1]) / focal_px];
            let [x, y] = undistort(&distortion, distorted)?;
            Some(DVec3::new(1.0, -(x + off[0]), -(y + off[1])))
        });
        Ok(Self { width, height, kind: LensKind::Table(table.collect()) })
    }

    /// Width of the image \[px\].
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height of the image \[px\].
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns the slopes of a pinhole; `None` for other lenses.
    pub(crate) fn slopes(&self) -> Option<PinholeSlopes> {
        let LensKind::Pinhole(focal_px) = self.kind else { return None };
        let middle = [f64::from(self.width) / 2.0, f64::from(self.height) / 2.0];
        Some(PinholeSlopes { focal_px, middle })
    }

    /// Returns the image of a point in front of the camera \[m\], from the upper left corner of the image \[px\]; `None`
    /// for lenses that are not a pinhole.
    #[must_use]
    pub fn project(&self, point_in_camera_m: DVec3) -> Option<[f64; 2]> {
        let slopes = self.slopes()?;
        let DVec3 { x, y, z } = point_in_camera_m;
        let [middle_x, middle_y] = slopes.middle;
        Some([middle_x - slopes.focal_px * y / x, middle_y - slopes.focal_px * z / x])
    }

    /// Returns the focal length \[px\] and the principal point \[px\] of a pinhole; `None` for other lenses.
    #[must_use]
    pub fn pinhole_px(&self) -> Option<(f64, [f64; 2])> {
        self.slopes().map(|slopes| (slopes.focal_px, slopes.middle))
    }

    /// Returns the direction of a pixel's centre in the frame of the camera, of any length. For a
    /// pinhole the x component is 1, so that distances in multiples of it are depths.
    #[must_use]
    pub fn direction(&self, column: u32, row: u32) -> Option<DVec3> {
        match &self.kind {
            LensKind::Pinhole(_) => {
                let slopes = self.slopes()?;
                Some(DVec3::new(1.0, slopes.left(column), slopes.up(row)))
            }
            LensKind::Table(table) => {
                *table.get(row as usize * self.width as usize + column as usize)?
            }
        }
    }
}

/// Returns the centres of all pixels, row by row.
fn pixels(width: u32, height: u32) -> impl Iterator<Item = [f64; 2]> {
    (0..height).flat_map(move |row| {
        (0..width).map(move |column| [f64::from(column) + 0.5, f64::from(row) + 0.5])
    })
}

/// Distorts a point of the image plane at distance 1 by Brown's model.
fn distort(d: &Distortion, [x, y]: [f64; 2]) -> [f64; 2] {
    let r2 = x * x + y * y;
    let radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
    [
        x * radial + 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x),
        y * radial + d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y,
    ]
}

/// Inverts [`distort`] by fixed-point iteration. Returns `None` where the distortion is not
/// injective.
fn undistort(d: &Distortion, distorted: [f64; 2]) -> Option<[f64; 2]> {
    let mut point = distorted;
    for _ in 0..MAX_ITERATIONS {
        let tried = distort(d, point);
        let off = [distorted[0] - tried[0], distorted[1] - tried[1]];
        point = [point[0] + off[0], point[1] + off[1]];
        if off[0].abs().max(off[1].abs()) < 1e-12 {
            return Some(point);
        }
        if !(point[0].is_finite() && point[1].is_finite()) {
            return None;
        }
    }
    None
}

/// A function from angles to image radii, or its inverse.
type RadiusFunction = fn(f64) -> f64;

/// SDF's `<custom_function>`: the image radius of an angle θ is `c1 f fun(θ / c2 + c3)`. The image
/// is scaled to its field of view, so `c1` and `f` cancel out.
#[derive(Clone, Copy)]
struct CustomProjection {
    c2: f64,
    c3: f64,
    radius_of_angle: RadiusFunction,
    angle_of_radius: RadiusFunction,
}

impl CustomProjection {
    fn read(function: Option<&Element>) -> Result<Self, LensError> {
        let text = |name: &str| {
            let child = function.and_then(|it| it.elements().find(|e| e.name == name));
            child.map(|child| child.text().trim().to_owned())
        };
        let number = |name: &str, usual: f64| match text(name) {
            Some(text) => text.parse().ok().filter(|number: &f64| number.is_finite()),
            None => Some(usual),
        };
        let (radius_of_angle, angle_of_radius): (RadiusFunction, RadiusFunction) =
            match text("fun").as_deref() {
                None | Some("tan") => (libm::tan, libm::atan),
                Some("sin") => (libm::sin, libm::asin),
                Some("id") => (|a| a, |r| r),
                Some(other) => {
                    return Err(LensError::Function(other.to_owned()));
                }
            };
        match (number("c2", 1.0).filter(|c2| *c2 != 0.0), number("c3", 0.0)) {
            (Some(c2), Some(c3)) => Ok(Self { c2, c3, radius_of_angle, angle_of_radius }),
            _ => Err(LensError::FunctionConstants),
        }
    }

    fn seen(self, angle_rad: f64) -> f64 {
        (self.radius_of_angle)(angle_rad / self.c2 + self.c3)
    }

    fn angle(self, seen: f64) -> f64 {
        ((self.angle_of_radius)(seen) - self.c3) * self.c2
    }
}

/// Returns the projection of SDF's `<lens>` by its name, with the image radius of an angle θ in
/// focal lengths.
fn wide_angle(camera: &Camera) -> Result<Lens, LensError> {
    let (width, height, fov) = (camera.width, camera.height, camera.horizontal_fov_rad);
    // Also checks the number of pixels.
    let Lens { .. } = Lens::pinhole(width, height, 1.0)?;
    if !(1e-6..=2.0 * PI).contains(&fov) {
        return Err(LensError::WideFieldOfView(fov));
    }
    let lens = camera.extra.iter().find(|element| element.name == "lens");
    let child = |name: &str| lens.and_then(|lens| lens.elements().find(|e| e.name == name));
    let text = |name: &str| child(name).map(Element::text);
    let kind =
        text("type").map_or_else(|| "stereographic".to_owned(), |text| text.trim().to_owned());
    let cutoff =
        text("cutoff_angle").and_then(|text| text.trim().parse().ok()).unwrap_or(FRAC_PI_2);
    type BoxedFunction = Box<dyn Fn(f64) -> f64>;
    let (seen, angle): (BoxedFunction, BoxedFunction) = match kind.as_str() {
        "gnomonical" => (Box::new(libm::tan), Box::new(libm::atan)),
        "stereographic" => {
            (Box::new(|a| 2.0 * libm::tan(a / 2.0)), Box::new(|r| 2.0 * libm::atan(r / 2.0)))
        }
        "equidistant" => (Box::new(|a| a), Box::new(|r| r)),
        "equisolid_angle" => {
            (Box::new(|a| 2.0 * libm::sin(a / 2.0)), Box::new(|r| 2.0 * libm::asin(r / 2.0)))
        }
        "orthographic" => (Box::new(libm::sin), Box::new(libm::asin)),
        "custom" => {
            let custom = CustomProjection::read(child("custom_function"))?;
            (Box::new(move |a| custom.seen(a)), Box::new(move |r| custom.angle(r)))
        }
        _ => return Err(LensError::Type(kind)),
    };
    let scale = seen(fov / 2.0);
    if !(scale.is_finite() && scale > 0.0) {
        return Err(LensError::Coverage { kind, fov_rad: fov });
    }
    let focal_px = f64::from(width) / 2.0 / scale;
    let (middle_u, middle_v) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
    let table = pixels(width, height).map(|[u, v]| {
        let (right, down) = ((u - middle_u) / focal_px, (v - middle_v) / focal_px);
        let radius = libm::sqrt(right * right + down * down);
        let theta = angle(radius);
        // The inverse may have no angle for this radius.
        if theta.is_nan() || theta > f64::min(cutoff, PI) {
            return None;
        }
        let (sine, cosine) = libm::sincos(theta);
        let side = if radius > 0.0 { sine / radius } else { 1.0 };
        Some(DVec3::new(cosine, -right * side, -down * side))
    });
    Ok(Lens { width, height, kind: LensKind::Table(table.collect()) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_angle_ends_at_the_rim() {
        // f = 2 px; the centres of the outer pixels are half a pixel from the border.
        let lens = Lens::pinhole(4, 2, FRAC_PI_2).unwrap();
        let first = lens.direction(0, 0).unwrap();
        assert!((first - DVec3::new(1.0, 0.75, 0.25)).length() < 1e-12, "{first}");
        assert!(Lens::pinhole(0, 2, 1.0).is_err());
        assert!(Lens::pinhole(2, 2, PI).is_err());
        assert!(Lens::pinhole(2, 2, f64::NAN).is_err());
        assert!(Lens::pinhole(1 << 20, 1 << 20, 1.0).is_err());
    }

    #[test]
    fn bending_undoes_straightening() {
        let d =
            Distortion { k1: -0.25, k2: 0.12, k3: 0.01, p1: 0.001, p2: -0.002, center: [0.5, 0.5] };
        for point in [[0.0, 0.0], [0.4, -0.3], [-0.5, 0.5]] {
            let [x, y] = distort(&d, undistort(&d, point).unwrap());
            assert!((x - point[0]).abs() < 1e-11 && (y - point[1]).abs() < 1e-11);
        }
    }
}
