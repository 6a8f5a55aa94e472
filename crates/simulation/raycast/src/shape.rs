//! Shapes with closed-form ray intersections, in double precision.

use std::fmt;

use periplus_geometry::DVec3;

use crate::quadric::{Crossing, Quadric};

/// A shape centred on its own frame, its axis along z. Lengths in metres. The number after a face's
/// name is its [`crate::Hit::primitive`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RaycastShape {
    /// The plane z = 0, infinite or a rectangle of this size about the origin. One face, 0.
    Plane {
        /// Lengths along x and y.
        size_m: Option<[f64; 2]>,
    },
    /// A box. Faces: -x 0, +x 1, -y 2, +y 3, -z 4, +z 5.
    Box {
        /// Edge lengths.
        size_m: DVec3,
    },
    /// A sphere. One face, 0.
    Sphere {
        /// Radius.
        radius_m: f64,
    },
    /// A cylinder with both ends. Faces: round 0, lower 1, upper 2.
    Cylinder {
        /// Radius.
        radius_m: f64,
        /// Length along z.
        length_m: f64,
    },
    /// A cylinder with a hemisphere at either end. Faces: round 0, lower 1, upper 2.
    Capsule {
        /// Radius.
        radius_m: f64,
        /// Length of the cylinder without the ends.
        length_m: f64,
    },
    /// A cone, its base at -length/2, its tip at length/2. Faces: round 0, base 1.
    Cone {
        /// Radius of the base.
        radius_m: f64,
        /// Height.
        length_m: f64,
    },
    /// An ellipsoid. One face, 0.
    Ellipsoid {
        /// Half axes.
        radii_m: DVec3,
    },
}

/// Error for a size that is not finite, is negative, or exceeds 1e9 m, and for a half axis, radius
/// or height of zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeSizeError {
    /// The size.
    pub size_m: f64,
}

impl fmt::Display for ShapeSizeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} m is not a valid size of a shape; use a value from 0 to 1e9 m", self.size_m)
    }
}

impl std::error::Error for ShapeSizeError {}

/// A shape with the terms of its intersection tests precomputed.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Solid {
    Plane { half: Option<[f64; 2]> },
    Box { half: DVec3 },
    Round(Quadric),
    Cylinder { side: Quadric, half: f64 },
    Capsule { side: Quadric, half: f64, lower: Quadric, upper: Quadric },
    Cone { side: Quadric, half: f64 },
}

/// The part of a line inside a convex solid, and the faces at its ends.
#[derive(Clone, Copy, Debug)]
struct Span {
    enter: f64,
    enter_face: u32,
    leave: f64,
    leave_face: u32,
}

impl Span {
    const WHOLE: Self =
        Self { enter: f64::NEG_INFINITY, enter_face: 0, leave: f64::INFINITY, leave_face: 0 };

    fn of(crossing: Crossing, face: u32) -> Option<Self> {
        let (enter, leave) = match crossing {
            Crossing::Outside | Crossing::Beyond(..) => return None,
            Crossing::Inside => (f64::NEG_INFINITY, f64::INFINITY),
            Crossing::Between(enter, leave) => (enter, leave),
        };
        Some(Self { enter, enter_face: face, leave, leave_face: face })
    }

    /// Intersects with `-half..=half` along one axis.
    #[inline]
    fn slab(self, half: f64, origin: f64, direction: f64, faces: [u32; 2]) -> Option<Self> {
        if direction == 0.0 {
            return (origin.abs() <= half).then_some(self);
        }
        let (low, high) = ((-half - origin) / direction, (half - origin) / direction);
        let own = if direction > 0.0 {
            Self { enter: low, enter_face: faces[0], leave: high, leave_face: faces[1] }
        } else {
            Self { enter: high, enter_face: faces[1], leave: low, leave_face: faces[0] }
        };
        self.common(own)
    }

    /// Returns the intersection of both.
    #[inline]
    fn common(self, other: Self) -> Option<Self> {
        let mut both = self;
        if other.enter > both.enter {
            (both.enter, both.enter_face) = (other.enter, other.enter_face);
        }
        if other.leave < both.leave {
            (both.leave, both.leave_face) = (other.leave, other.leave_face);
        }
        (both.enter <= both.leave).then_some(both)
    }

    /// Returns the interval over both, for overlapping solids whose union is convex.
    #[inline]
    fn joined(a: Option<Self>, b: Option<Self>) -> Option<Self> {
        let (Some(mut all), Some(b)) = (a, b) else { return a.or(b) };
        if b.enter < all.enter {
            (all.enter, all.enter_face) = (b.enter, b.enter_face);
        }
        if b.leave > all.leave {
            (all.leave, all.leave_face) = (b.leave, b.leave_face);
        }
        Some(all)
    }
}

impl Solid {
    pub(crate) fn new(shape: &RaycastShape) -> Result<Self, ShapeSizeError> {
        let length = |size_m: f64| {
            if (0.0..=1e9).contains(&size_m) { Ok(size_m) } else { Err(ShapeSizeError { size_m }) }
        };
        // Divisors of the quadric must not be zero.
        let some = |size_m: f64| {
            if size_m >= 1e-9 { length(size_m) } else { Err(ShapeSizeError { size_m }) }
        };
        Ok(match *shape {
            RaycastShape::Plane { size_m: None } => Self::Plane { half: None },
            RaycastShape::Plane { size_m: Some([x, y]) } => {
                Self::Plane { half: Some([length(x)? / 2.0, length(y)? / 2.0]) }
            }
            RaycastShape::Box { size_m } => {
                size_m.to_array().into_iter().try_for_each(|size| length(size).map(drop))?;
                Self::Box { half: size_m / 2.0 }
            }
            RaycastShape::Sphere { radius_m } => Self::Round(Quadric::sphere(some(radius_m)?, 0.0)),
            RaycastShape::Cylinder { radius_m, length_m } => Self::Cylinder {
                side: Quadric::cylinder(some(radius_m)?),
                half: length(length_m)? / 2.0,
            },
            RaycastShape::Capsule { radius_m, length_m } => {
                let (radius, half) = (some(radius_m)?, length(length_m)? / 2.0);
                Self::Capsule {
                    side: Quadric::cylinder(radius),
                    half,
                    lower: Quadric::sphere(radius, -half),
                    upper: Quadric::sphere(radius, half),
                }
            }
            RaycastShape::Cone { radius_m, length_m } => {
                let (radius, height) = (some(radius_m)?, some(length_m)?);
                let half = height / 2.0;
                Self::Cone { side: Quadric::cone(radius, height, half), half }
            }
            RaycastShape::Ellipsoid { radii_m } => {
                radii_m.to_array().into_iter().try_for_each(|size| some(size).map(drop))?;
                Self::Round(Quadric::ellipsoid(radii_m))
            }
        })
    }

    /// Returns the distance and face of the nearest surface in `min..=max` along a ray.
    #[inline]
    pub(crate) fn cast(&self, o: DVec3, d: DVec3, min: f64, max: f64) -> Option<(f64, u32)> {
        let within = |t: f64| min <= t && t <= max;
        if let Self::Plane { half } = self {
            let t = -o.z / d.z;
            let inside =
                |[x, y]: [f64; 2]| (o.x + t * d.x).abs() <= x && (o.y + t * d.y).abs() <= y;
            return (within(t) && half.is_none_or(inside)).then_some((t, 0));
        }
        let span = self.span(o, d)?;
        if within(span.enter) {
            Some((span.enter, span.enter_face))
        } else if within(span.leave) {
            Some((span.leave, span.leave_face))
        } else {
            None
        }
    }

    #[inline]
    fn span(&self, o: DVec3, d: DVec3) -> Option<Span> {
        match self {
            Self::Plane { .. } => None,
            Self::Box { half } => Span::WHOLE
                .slab(half.x, o.x, d.x, [0, 1])?
                .slab(half.y, o.y, d.y, [2, 3])?
                .slab(half.z, o.z, d.z, [4, 5]),
            Self::Round(quadric) => Span::of(quadric.crossing(o, d), 0),
            Self::Cylinder { side, half } => {
                // The end caps are cheaper to reject.
                let ends = Span::WHOLE.slab(*half, o.z, d.z, [1, 2])?;
                Span::of(side.crossing(o, d), 0)?.common(ends)
            }
            Self::Capsule { side, half, lower, upper } => {
                let ends = Span::WHOLE.slab(*half, o.z, d.z, [0, 0]);
                let round = Span::of(side.crossing(o, d), 0);
                let body = ends.zip(round).and_then(|(ends, round)| round.common(ends));
                let low = Span::of(lower.crossing(o, d), 1);
                let high = Span::of(upper.crossing(o, d), 2);
                Span::joined(body, Span::joined(low, high))
            }
            Self::Cone { side, half } => {
                let ends = Span::WHOLE.slab(*half, o.z, d.z, [1, 0])?;
                let round = match side.crossing(o, d) {
                    // Two half lines: one in the cone, one in its mirror image above the tip.
                    Crossing::Beyond(first, second) => {
                        // The half line that goes down is in the cone.
                        let own = if d.z > 0.0 {
                            Span { leave: first, ..Span::WHOLE }
                        } else {
                            Span { enter: second, ..Span::WHOLE }
                        };
                        Some(own)
                    }
                    crossing => Span::of(crossing, 0),
                }?;
                round.common(ends)
            }
        }
    }

    /// Returns the outward normal of a flat face; `None` for a curved face.
    pub(crate) fn flat_normal(&self, face: u32) -> Option<DVec3> {
        let along_z = |up: bool| if up { DVec3::Z } else { DVec3::NEG_Z };
        match self {
            Self::Plane { .. } => Some(DVec3::Z),
            Self::Box { .. } => {
                let axis = [DVec3::X, DVec3::Y, DVec3::Z][(face / 2) as usize % 3];
                Some(if face.is_multiple_of(2) { -axis } else { axis })
            }
            Self::Cylinder { .. } => (face != 0).then(|| along_z(face == 2)),
            Self::Cone { .. } => (face != 0).then_some(DVec3::NEG_Z),
            Self::Round(_) | Self::Capsule { .. } => None,
        }
    }

    /// Returns the outward normal at a point of a face.
    pub(crate) fn normal(&self, point: DVec3, face: u32) -> DVec3 {
        if let Some(normal) = self.flat_normal(face) {
            return normal;
        }
        let normal = match self {
            Self::Round(side) | Self::Cylinder { side, .. } | Self::Cone { side, .. } => {
                side.gradient(point)
            }
            Self::Capsule { side, lower, upper, .. } => {
                [side, lower, upper][face as usize % 3].gradient(point)
            }
            Self::Plane { .. } | Self::Box { .. } => DVec3::Z,
        };
        normal.try_normalize().unwrap_or(DVec3::Z)
    }

    /// Returns the half extents of the bounding box; `None` for an infinite plane.
    pub(crate) fn half_extents(shape: &RaycastShape) -> Option<DVec3> {
        Some(match *shape {
            RaycastShape::Plane { size_m } => {
                let [x, y] = size_m?;
                DVec3::new(x, y, 0.0) / 2.0
            }
            RaycastShape::Box { size_m } => size_m / 2.0,
            RaycastShape::Sphere { radius_m } => DVec3::splat(radius_m),
            RaycastShape::Cylinder { radius_m, length_m }
            | RaycastShape::Cone { radius_m, length_m } => {
                DVec3::new(radius_m, radius_m, length_m / 2.0)
            }
            RaycastShape::Capsule { radius_m, length_m } => {
                DVec3::new(radius_m, radius_m, length_m / 2.0 + radius_m)
            }
            RaycastShape::Ellipsoid { radii_m } => radii_m,
        })
    }
}
