//! Shapes of zones.

use std::f64::consts::PI;
use std::fmt;

use periplus_costmap::{Footprint, FootprintError};

use crate::outline::{inside_m, is_in_polygon};

/// Number of corners with which a circle is published; the value of Nav2.
const CIRCLE_CORNER_COUNT: usize = 16;

/// Shape of a zone, in the base frame \[m\].
#[derive(Clone, Debug, PartialEq)]
pub enum MonitorShape {
    /// Polygon of corners, in order.
    Polygon(Vec<[f64; 2]>),
    /// Circle around the base.
    Circle {
        /// Radius \[m\].
        radius_m: f64,
    },
}

impl MonitorShape {
    /// True if a point \[m\] is inside. The border of a circle is outside of it; of a polygon, the
    /// sides that a ray along x leaves through are outside.
    #[must_use]
    pub fn contains(&self, x_m: f64, y_m: f64) -> bool {
        match self {
            Self::Polygon(corners) => is_in_polygon(corners, x_m, y_m),
            Self::Circle { radius_m } => x_m * x_m + y_m * y_m < radius_m * radius_m,
        }
    }

    /// Distance of a point inside from the outline \[m\]; 0 outside.
    pub(super) fn depth_m(&self, x_m: f64, y_m: f64) -> f64 {
        let inside_m = match self {
            Self::Polygon(corners) => inside_m(corners, x_m, y_m),
            Self::Circle { radius_m } => radius_m - libm::hypot(x_m, y_m),
        };
        inside_m.max(0.0)
    }

    /// Corners for display \[m\].
    #[must_use]
    pub fn outline(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Polygon(corners) => corners.clone(),
            Self::Circle { radius_m } => (0..CIRCLE_CORNER_COUNT)
                .map(|index| {
                    let angle_rad = 2.0 * PI * index as f64 / CIRCLE_CORNER_COUNT as f64;
                    let (sine, cosine) = libm::sincos(angle_rad);
                    [radius_m * cosine, radius_m * sine]
                })
                .collect(),
        }
    }
}

/// Mistake in a list of corners.
#[derive(Clone, Debug, PartialEq)]
pub enum PointsError {
    /// The text is not a list of corners.
    Unreadable(FootprintError),
    /// A value of a flat list is not a number.
    NotNumber(String),
    /// A flat list has an x without its y.
    OddCount(usize),
    /// There are not enough corners.
    TooFew {
        /// Number of corners.
        count: usize,
        /// Number that is needed.
        min: usize,
    },
}

impl fmt::Display for PointsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(error) => write!(f, "{error}"),
            Self::NotNumber(word) => write!(f, "`{word}` is not a finite number"),
            Self::OddCount(count) => {
                write!(f, "it has {count} numbers, and corners are pairs of x and y")
            }
            Self::TooFew { count, min } => {
                write!(f, "it has {count} corners, and at least {min} are needed")
            }
        }
    }
}

impl std::error::Error for PointsError {}

/// Parses corners: `[[x, y], ...]`, or the flat list `[x, y, ...]` of Humble.
///
/// # Errors
/// The first mistake, or fewer than `min` corners.
pub fn read_corners(text: &str, min: usize) -> Result<Vec<[f64; 2]>, PointsError> {
    let inner = text.trim().trim_start_matches('[').trim_start();
    let is_nested = text.trim().starts_with('[') && text.matches('[').count() > 1;
    let corners = if is_nested {
        match Footprint::read(text) {
            Ok(footprint) => footprint.points().to_vec(),
            Err(FootprintError::TooFewCorners(count)) => {
                return Err(PointsError::TooFew { count, min });
            }
            Err(error) => return Err(PointsError::Unreadable(error)),
        }
    } else {
        read_pairs(inner.trim_end_matches(']'))?
    };
    let count = corners.len();
    if count < min { Err(PointsError::TooFew { count, min }) } else { Ok(corners) }
}

fn read_pairs(text: &str) -> Result<Vec<[f64; 2]>, PointsError> {
    let words = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty());
    let numbers: Vec<f64> = words
        .map(|word| {
            let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| PointsError::NotNumber(word.to_owned()))
        })
        .collect::<Result<_, _>>()?;
    let (pairs, rest) = numbers.as_chunks::<2>();
    if rest.is_empty() { Ok(pairs.to_vec()) } else { Err(PointsError::OddCount(numbers.len())) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn points_are_inside_or_outside() {
        let square =
            MonitorShape::Polygon(vec![[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]]);
        let circle = MonitorShape::Circle { radius_m: 1.0 };
        assert!(square.contains(0.9, 0.9) && !circle.contains(0.9, 0.9));
        assert!(!square.contains(1.1, 0.0) && !square.contains(0.0, -1.1));
        assert!(circle.contains(0.0, 0.99) && !circle.contains(0.0, 1.0));
        // The sides at the lower y and at the lower x belong to the square.
        assert!(!square.contains(1.0, 0.0) && square.contains(-1.0, 0.0));
        assert!(!MonitorShape::Polygon(Vec::new()).contains(0.0, 0.0));
        let hollow = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]];
        assert!(is_in_polygon(&hollow, 2.0, 0.5) && !is_in_polygon(&hollow, 2.0, 2.0));
    }

    #[test]
    fn depths_are_distances_from_the_outline() {
        let check = |shape: &MonitorShape, at: [f64; 2], expected_m: f64| {
            let depth_m = shape.depth_m(at[0], at[1]);
            assert!((depth_m - expected_m).abs() < 1e-12, "{depth_m}, expected {expected_m}");
        };
        let square =
            MonitorShape::Polygon(vec![[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]]);
        let circle = MonitorShape::Circle { radius_m: 1.0 };
        check(&square, [0.0, 0.0], 1.0);
        check(&square, [0.9, 0.5], 0.1);
        check(&square, [-0.3, -0.8], 0.2);
        check(&square, [1.5, 0.0], 0.0);
        check(&circle, [0.0, -0.7], 0.3);
        check(&circle, [0.0, 2.0], 0.0);
    }

    #[test]
    fn corners_are_read_nested_and_flat() {
        let expected = vec![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0]];
        let nested = read_corners("[[1, 2], [3.0, 4], [5, 6], [7, 8]]", 4).unwrap();
        assert_eq!(nested, expected);
        assert_eq!(read_corners("[1.0, 2, 3, 4, 5, 6, 7, 8]", 4).unwrap(), expected);
        let wrong = |text| read_corners(text, 4).unwrap_err().to_string();
        assert_eq!(
            wrong("[[1, 2], [3, 4], [5, 6]]"),
            "it has 3 corners, and at least 4 are needed"
        );
        assert_eq!(wrong("[[1, 2]]"), "it has 1 corners, and at least 4 are needed");
        assert_eq!(wrong("[1, 2, 3]"), "it has 3 numbers, and corners are pairs of x and y");
        assert_eq!(wrong("[1, x]"), "`x` is not a finite number");
        assert_eq!(wrong(""), "it has 0 corners, and at least 4 are needed");
    }

    proptest! {
        #[test]
        fn any_text_gives_corners_or_a_reason(text: String) {
            if let Err(error) = read_corners(&text, 4) {
                prop_assert!(!error.to_string().is_empty());
            }
        }

        #[test]
        fn a_circle_holds_its_outline_when_shrunk(radius_m in 0.1..5.0f64, scale in 0.0..0.99f64) {
            let circle = MonitorShape::Circle { radius_m };
            for [x, y] in circle.outline() {
                prop_assert!(circle.contains(x * scale, y * scale));
            }
        }
    }
}
