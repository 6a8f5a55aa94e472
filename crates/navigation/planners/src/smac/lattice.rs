//! State lattices: motions between headings that end in the middle of cells.
//!
//! The file format is that of `nav2_smac_planner/lattice_primitives`. Source of the method: M. Pivtoraiko,
//! R. A. Knepper, A. Kelly, "Differentially constrained mobile robot motion planning in state lattices", 2009.

use std::fmt;

use periplus_geometry::Pose2;
use serde_json::Value;

/// Maximum number of primitives, and of poses of one of them, in a file.
const MAX_LIST_COUNT: usize = 100_000;
/// Directions of the headings in the first quadrant \[cells\]: multiples of them end in the middle of cells.
const FIRST_QUADRANT: [[i32; 2]; 4] = [[1, 0], [2, 1], [1, 1], [1, 2]];
/// Largest displacement of a generated primitive, in multiples of the turning radius.
const MAX_REACH_RATIO: f64 = 2.0;
/// Minimum length of a straight primitive \[cells\].
const MIN_STRAIGHT_CELLS: f64 = 2.0;

/// Motion from the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct LatticePrimitive {
    /// Heading at the start, as an index.
    pub start_bin: usize,
    /// Heading at the end.
    pub end_bin: usize,
    /// True for turns to the left.
    pub is_left: bool,
    /// Length \[m\]; 0 for a rotation in place.
    pub length_m: f64,
    /// Length of its arc \[m\].
    pub arc_length_m: f64,
    /// Poses along it, from the start to the end, in the frame of the costmap around the start.
    pub poses: Vec<Pose2>,
}

/// Headings and motions of a State Lattice planner.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    /// Side length of a cell \[m\].
    pub resolution_m: f64,
    /// Minimum turning radius \[m\].
    pub radius_m: f64,
    /// Angles of the headings \[rad\], rising from 0.
    pub headings_rad: Vec<f64>,
    /// Motions, in any order.
    pub primitives: Vec<LatticePrimitive>,
}

/// Reason why a lattice file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LatticeError(String);

impl fmt::Display for LatticeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the lattice file is not usable: {}", self.0)
    }
}

impl std::error::Error for LatticeError {}

fn number(at: &Value, name: &str) -> Result<f64, LatticeError> {
    let number = at.get(name).and_then(Value::as_f64).filter(|number| number.is_finite());
    number.ok_or_else(|| LatticeError(format!("`{name}` is not a number")))
}

fn list<'v>(at: &'v Value, name: &str) -> Result<&'v [Value], LatticeError> {
    let list = at.get(name).and_then(Value::as_array);
    let list = list.ok_or_else(|| LatticeError(format!("`{name}` is not a list")))?;
    if list.len() > MAX_LIST_COUNT {
        return Err(LatticeError(format!("`{name}` has more than {MAX_LIST_COUNT} elements")));
    }
    Ok(list)
}

fn read_pose(value: &Value) -> Result<Pose2, LatticeError> {
    let part = |index: usize| value.get(index).and_then(Value::as_f64);
    match (part(0), part(1), part(2)) {
        (Some(x_m), Some(y_m), Some(yaw_rad)) => Ok(Pose2::new(x_m, y_m, yaw_rad)),
        _ => Err(LatticeError("a pose of `poses` is not [x, y, heading]".to_owned())),
    }
}

fn read_primitive(value: &Value, heading_count: usize) -> Result<LatticePrimitive, LatticeError> {
    let bin = |name: &str| {
        let bin = number(value, name)?;
        let is_heading = bin >= 0.0 && bin < heading_count as f64;
        is_heading
            .then_some(bin as usize)
            .ok_or_else(|| LatticeError(format!("`{name}` {bin} is not one of the headings")))
    };
    let poses: Result<Vec<Pose2>, _> = list(value, "poses")?.iter().map(read_pose).collect();
    let poses = poses?;
    if poses.is_empty() {
        return Err(LatticeError("a primitive has no `poses`".to_owned()));
    }
    Ok(LatticePrimitive {
        start_bin: bin("start_angle_index")?,
        end_bin: bin("end_angle_index")?,
        is_left: value.get("left_turn").and_then(Value::as_bool).unwrap_or(false),
        length_m: number(value, "trajectory_length")?,
        arc_length_m: number(value, "arc_length")?,
        poses,
    })
}

impl Lattice {
    /// Reads a file of primitives in JSON.
    ///
    /// # Errors
    /// The first part of the file that is not as expected.
    pub fn read_json(text: &str) -> Result<Self, LatticeError> {
        let file: Value =
            serde_json::from_str(text).map_err(|error| LatticeError(error.to_string()))?;
        let metadata = file
            .get("lattice_metadata")
            .ok_or_else(|| LatticeError("there is no `lattice_metadata`".to_owned()))?;
        let headings_rad: Option<Vec<f64>> =
            list(metadata, "heading_angles")?.iter().map(Value::as_f64).collect();
        let headings_rad = headings_rad
            .filter(|angles| !angles.is_empty() && angles.len() <= usize::from(u8::MAX))
            .ok_or_else(|| LatticeError("`heading_angles` are not 1 to 255 numbers".to_owned()))?;
        let positive = |name: &str| {
            let value = number(metadata, name)?;
            let is_positive = value > 0.0;
            is_positive
                .then_some(value)
                .ok_or_else(|| LatticeError(format!("`{name}` is not positive")))
        };
        let count = headings_rad.len();
        let primitives: Result<Vec<LatticePrimitive>, _> =
            list(&file, "primitives")?.iter().map(|value| read_primitive(value, count)).collect();
        Ok(Self {
            resolution_m: positive("grid_resolution")?,
            radius_m: positive("turning_radius")?,
            headings_rad,
            primitives: primitives?,
        })
    }

    /// Generates the lattice of a car with 16 headings: for each heading a straight motion, and the shortest
    /// turn to each adjacent heading, of a straight part and an arc that is not tighter than the radius.
    #[must_use]
    pub fn ackermann(resolution_m: f64, radius_m: f64) -> Self {
        let directions = directions();
        let angle = |direction: &[i32; 2]| {
            let angle = libm::atan2(f64::from(direction[1]), f64::from(direction[0]));
            if angle < 0.0 { angle + 2.0 * std::f64::consts::PI } else { angle }
        };
        let headings_rad: Vec<f64> = directions.iter().map(angle).collect();
        let count = directions.len();
        let radius = radius_m / resolution_m;
        let mut primitives = Vec::new();
        for (start, direction) in directions.iter().enumerate() {
            primitives.push(straight(start, *direction, headings_rad[start], resolution_m));
            for (end, is_left) in
                [((start + 1) % count, true), ((start + count - 1) % count, false)]
            {
                let headings = [(start, headings_rad[start]), (end, headings_rad[end])];
                primitives.extend(turn(headings, is_left, radius, resolution_m));
            }
        }
        Self { resolution_m, radius_m, headings_rad, primitives }
    }
}

/// Directions of all headings, counterclockwise from the x axis.
fn directions() -> Vec<[i32; 2]> {
    let rotate = |[x, y]: [i32; 2], quadrant: usize| match quadrant {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    };
    (0..4)
        .flat_map(|quadrant| FIRST_QUADRANT.map(|direction| rotate(direction, quadrant)))
        .collect()
}

fn straight(bin: usize, [x, y]: [i32; 2], yaw_rad: f64, resolution_m: f64) -> LatticePrimitive {
    let length = libm::hypot(f64::from(x), f64::from(y));
    let count = libm::ceil(MIN_STRAIGHT_CELLS / length - 1e-9);
    let step_count = libm::ceil(count * length) as usize;
    let pose = |step: usize| {
        let ratio = count * resolution_m * step as f64 / step_count as f64;
        Pose2::new(ratio * f64::from(x), ratio * f64::from(y), yaw_rad)
    };
    LatticePrimitive {
        start_bin: bin,
        end_bin: bin,
        is_left: false,
        length_m: count * length * resolution_m,
        arc_length_m: 0.0,
        poses: (0..=step_count).map(pose).collect(),
    }
}

/// Straight part, arc, straight part, in cells.
struct Turn {
    before: f64,
    radius: f64,
    after: f64,
    angle_rad: f64,
}

impl Turn {
    fn length(&self) -> f64 {
        self.before + self.radius * self.angle_rad + self.after
    }
}

/// Returns the shortest turn between two headings that ends in the middle of a cell.
fn turn(
    [(start_bin, start_rad), (end_bin, end_rad)]: [(usize, f64); 2],
    is_left: bool,
    radius: f64,
    resolution_m: f64,
) -> Option<LatticePrimitive> {
    let side = if is_left { 1.0 } else { -1.0 };
    let angle_rad = periplus_geometry::normalize_angle(end_rad - start_rad).abs();
    let reach = libm::ceil(MAX_REACH_RATIO * radius) as i32;
    let (sin_start, cos_start) = libm::sincos(start_rad);
    let (sin_end, cos_end) = libm::sincos(end_rad);
    let cross = cos_start * sin_end - sin_start * cos_end;
    let mut best: Option<Turn> = None;
    for (x, y) in (-reach..=reach).flat_map(|x| (-reach..=reach).map(move |y| (x, y))) {
        let (x, y) = (f64::from(x), f64::from(y));
        // The lines of both headings meet at these distances from start and end.
        let from_start = (x * sin_end - y * cos_end) / cross;
        let to_end = (y * cos_start - x * sin_start) / cross;
        let tangent = from_start.min(to_end);
        let arc_radius = tangent / libm::tan(angle_rad / 2.0);
        if arc_radius < radius {
            continue;
        }
        let turn = Turn {
            before: from_start - tangent,
            radius: arc_radius,
            after: to_end - tangent,
            angle_rad,
        };
        if best.as_ref().is_none_or(|best| turn.length() < best.length() - 1e-9) {
            best = Some(turn);
        }
    }
    let turn = best?;
    let step_count = libm::ceil(turn.length()) as usize;
    let pose = |step: usize| {
        let at = turn.length() * step as f64 / step_count as f64;
        let arc = turn.radius * turn.angle_rad;
        let (before, on_arc) = (at.min(turn.before), (at - turn.before).clamp(0.0, arc));
        let after = (at - turn.before - arc).max(0.0);
        let yaw_rad = start_rad + side * on_arc / turn.radius;
        let (sine, cosine) = libm::sincos(yaw_rad);
        let x = before * cos_start + side * turn.radius * (sine - sin_start) + after * cosine;
        let y = before * sin_start + side * turn.radius * (cos_start - cosine) + after * sine;
        Pose2::new(x * resolution_m, y * resolution_m, yaw_rad)
    };
    Some(LatticePrimitive {
        start_bin,
        end_bin,
        is_left,
        length_m: turn.length() * resolution_m,
        arc_length_m: turn.radius * turn.angle_rad * resolution_m,
        poses: (0..=step_count).map(pose).collect(),
    })
}

#[cfg(test)]
mod tests {
    use periplus_geometry::normalize_angle;

    use super::*;

    #[test]
    fn motions_end_in_the_middle_of_cells_with_their_heading() {
        let lattice = Lattice::ackermann(0.05, 0.5);
        assert_eq!((lattice.headings_rad.len(), lattice.primitives.len()), (16, 48));
        for primitive in &lattice.primitives {
            let last = primitive.poses[primitive.poses.len() - 1];
            for at in [last.x_m, last.y_m] {
                assert!((at / 0.05 - libm::round(at / 0.05)).abs() < 1e-9, "{primitive:?}");
            }
            let wanted = lattice.headings_rad[primitive.end_bin];
            assert!(normalize_angle(last.yaw_rad - wanted).abs() < 1e-9);
            assert!(primitive.length_m >= 0.09 && primitive.length_m < 1.0, "{primitive:?}");
        }
    }

    #[test]
    fn files_are_read_or_explained() {
        let text = r#"{"lattice_metadata": {"turning_radius": 0.5, "grid_resolution": 0.05,
            "heading_angles": [0.0, 1.5]}, "primitives": [{"start_angle_index": 0, "end_angle_index": 1,
            "left_turn": true, "trajectory_length": 0.8, "arc_length": 0.7, "poses": [[0, 0, 0], [0.5, 0.5, 1.5]]}]}"#;
        let lattice = Lattice::read_json(text).unwrap();
        assert_eq!(lattice.primitives[0].end_bin, 1);
        let wrong = |text: &str| Lattice::read_json(text).unwrap_err().to_string();
        assert!(wrong("{}").ends_with("there is no `lattice_metadata`"));
        assert!(
            wrong(&text.replace("index\": 1", "index\": 2")).contains("not one of the headings")
        );
        assert!(wrong(&text.replace("0.05", "0")).contains("`grid_resolution` is not positive"));
    }
}
