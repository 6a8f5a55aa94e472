//! Trajectories in the text format of the TUM RGB-D benchmark.

use std::fmt;
use std::fmt::Write as _;

use periplus_geometry::{DQuat, DVec3, Pose, Pose2};

use crate::trajectory::{StampedPose, Trajectory};

/// Maximum number of poses of a file: eleven days at 10 Hz, a gigabyte of memory.
pub const MAX_POSE_COUNT: usize = 10_000_000;

/// Number of words of a line.
const WORD_COUNT: usize = 8;

/// Number of words of a line in the plane.
const PLANAR_WORD_COUNT: usize = 4;

/// Line that is not a pose.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TumError {
    /// Line, from 1.
    pub line: usize,
    /// Column of the first character, from 1.
    pub column: usize,
    /// Fault of the line.
    pub fault: TumFault,
}

/// Fault of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TumFault {
    /// The line has another number of words than 8.
    WordCount(usize),
    /// A word is no finite number.
    Number(String),
    /// The quaternion has length zero.
    ZeroQuaternion,
    /// There are more than [`MAX_POSE_COUNT`] poses.
    TooMany,
}

impl fmt::Display for TumError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: ", self.line, self.column)?;
        match &self.fault {
            TumFault::WordCount(count) => write!(
                f,
                "the line has {count} words; a pose has {WORD_COUNT}: stamp x y z qx qy qz qw (s, m)"
            ),
            TumFault::Number(word) => write!(f, "`{word}` is not a finite number"),
            TumFault::ZeroQuaternion => {
                f.write_str("the quaternion is zero; no rotation is `0 0 0 1`")
            }
            TumFault::TooMany => {
                write!(f, "the file has more than {MAX_POSE_COUNT} poses; split it")
            }
        }
    }
}

impl std::error::Error for TumError {}

impl Trajectory {
    /// Reads a trajectory in TUM format: a line `stamp x y z qx qy qz qw` for each pose, in seconds and
    /// metres, separated by spaces or tabs. `#` begins a comment; empty lines are skipped.
    ///
    /// # Errors
    /// The first line that is not a pose.
    pub fn from_tum(text: &str) -> Result<Self, TumError> {
        read(text, false)
    }

    /// Reads a trajectory in TUM format, or with lines `stamp x y yaw` in seconds, metres and radians, as
    /// `periplus slam` writes them. Both may be in one file.
    ///
    /// # Errors
    /// The first line that is not a pose.
    pub fn from_text(text: &str) -> Result<Self, TumError> {
        read(text, true)
    }

    /// Returns the trajectory in TUM format. Numbers are written so that they read back exactly.
    #[must_use]
    pub fn to_tum(&self) -> String {
        let mut text = String::from("# stamp x y z qx qy qz qw (s, m)\n");
        for StampedPose { stamp_s, pose } in self.poses() {
            let (DVec3 { x, y, z }, q) = (pose.translation, pose.rotation);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{stamp_s} {x} {y} {z} {} {} {} {}", q.x, q.y, q.z, q.w);
        }
        text
    }
}

fn read(text: &str, allows_planar: bool) -> Result<Trajectory, TumError> {
    let mut poses = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        if line.trim().is_empty() {
            continue;
        }
        let error = |column, fault| TumError { line: index + 1, column, fault };
        if poses.len() == MAX_POSE_COUNT {
            return Err(error(1, TumFault::TooMany));
        }
        poses.push(pose(line, allows_planar).map_err(|(column, fault)| error(column, fault))?);
    }
    Ok(Trajectory::new(poses))
}

fn pose(line: &str, allows_planar: bool) -> Result<StampedPose, (usize, TumFault)> {
    let mut numbers = [0.0; WORD_COUNT];
    let mut count = 0;
    for word in line.split_whitespace() {
        if let Some(number) = numbers.get_mut(count) {
            *number = match word.parse::<f64>() {
                Ok(number) if number.is_finite() => number,
                _ => return Err((column(line, word), TumFault::Number(excerpt(word)))),
            };
        }
        count += 1;
    }
    let start = column(line, line.trim_start());
    if allows_planar && count == PLANAR_WORD_COUNT {
        let [stamp_s, x_m, y_m, yaw_rad, ..] = numbers;
        return Ok(StampedPose::planar(stamp_s, Pose2::new(x_m, y_m, yaw_rad)));
    }
    if count != WORD_COUNT {
        return Err((start, TumFault::WordCount(count)));
    }
    let [stamp_s, x, y, z, qx, qy, qz, qw] = numbers;
    let rotation = DQuat::from_xyzw(qx, qy, qz, qw);
    // Tiny or huge numbers have a square of zero or infinity.
    if !rotation.length_recip().is_finite() || rotation.length_recip() == 0.0 {
        return Err((start, TumFault::ZeroQuaternion));
    }
    Ok(StampedPose { stamp_s, pose: Pose::from_xyz_quaternion([x, y, z], rotation) })
}

/// Column of a part of a line, in characters from 1.
fn column(line: &str, part: &str) -> usize {
    let offset = part.as_ptr() as usize - line.as_ptr() as usize;
    line.get(..offset).map_or(1, |before| before.chars().count() + 1)
}

fn excerpt(word: &str) -> String {
    const MAX_CHAR_COUNT: usize = 40;
    word.chars().take(MAX_CHAR_COUNT).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn poses_and_comments() {
        let text = "# a comment\n\n2 1 2 3 0 0 0 1 # another\n1.5\t0 0 0  0 0 2 0\r\n";
        let read = Trajectory::from_tum(text).unwrap();
        let expected = [
            StampedPose {
                stamp_s: 1.5,
                pose: Pose::from_xyz_quaternion([0.0; 3], DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0)),
            },
            StampedPose { stamp_s: 2.0, pose: Pose::from_xyz(1.0, 2.0, 3.0) },
        ];
        assert_eq!(read.poses(), expected);
    }

    #[test]
    fn errors_name_the_line_and_column() {
        let check = |text: &str, line: usize, column: usize, fault: TumFault| {
            let error = Trajectory::from_tum(text).unwrap_err();
            assert_eq!(error, TumError { line, column, fault });
        };
        check("0 0 0 0 0 0 0 1\n 1 2 3", 2, 2, TumFault::WordCount(3));
        check("0 0 0 0 0 0 0 1 9", 1, 1, TumFault::WordCount(9));
        check("0 0 ä 0 0 0 0 1", 1, 5, TumFault::Number("ä".into()));
        check("0 inf 0 0 0 0 0 1", 1, 3, TumFault::Number("inf".into()));
        check("0 0 0 0 0 0 0 0", 1, 1, TumFault::ZeroQuaternion);
        check("0 0 0 0 0 0 0 1e-200", 1, 1, TumFault::ZeroQuaternion);
        let message = Trajectory::from_tum("x").unwrap_err().to_string();
        assert_eq!(message, "1:1: `x` is not a finite number");
    }

    #[test]
    fn planar_lines_are_read_where_they_are_allowed() {
        let read = Trajectory::from_text("1 2 3 0\n2 0 0 0 0 0 0 1\n").unwrap();
        assert_eq!(read.poses()[0].pose, Pose::from_xyz(2.0, 3.0, 0.0));
        let error = Trajectory::from_tum("1 2 3 0").unwrap_err();
        assert_eq!(error.fault, TumFault::WordCount(4));
    }

    proptest! {
        #[test]
        fn trajectories_come_back(numbers in prop::collection::vec(prop::array::uniform4(-1e9..1e9), 0..9)) {
            let pose = |[stamp_s, x, y, yaw]: [f64; 4]| {
                StampedPose::planar(stamp_s, periplus_geometry::Pose2::new(x, y, yaw))
            };
            let trajectory = Trajectory::new(numbers.into_iter().map(pose));
            prop_assert_eq!(Trajectory::from_tum(&trajectory.to_tum()), Ok(trajectory));
        }

        #[test]
        fn no_text_panics(text in ".{0,80}") {
            let _ = Trajectory::from_tum(&text);
        }
    }
}
