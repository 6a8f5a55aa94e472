//! Text format of the saved pose.

use std::fmt;

use periplus_geometry::Pose2;

/// Saved pose, in the format of Nav2.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedPose {
    /// Time of the pose \[ns\].
    pub time_ns: i64,
    /// Frame of the pose.
    pub frame: String,
    /// `map_from_base`.
    pub pose: Pose2,
    /// z of the base \[m\].
    pub z_m: f64,
}

/// Error of [`SavedPose::parse`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PoseFileError {
    /// A line is not `name: value`, or its value is invalid.
    Line {
        /// Line number, from 1.
        line: usize,
        /// Text of the line.
        text: String,
        /// Description of the expected text.
        expected: &'static str,
    },
    /// A required name is missing.
    Missing(&'static str),
}

impl fmt::Display for PoseFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line { line, text, expected } => {
                write!(f, "line {line} of the saved pose is `{text}`; expected {expected}")
            }
            Self::Missing(name) => write!(f, "the saved pose has no `{name}:`"),
        }?;
        f.write_str("; remove the file to start without it")
    }
}

impl std::error::Error for PoseFileError {}

const NS_PER_S: i64 = 1_000_000_000;

/// Maximum number of characters of a line in messages.
const SHOWN_COUNT: usize = 60;

impl SavedPose {
    /// Formats the pose. Write it to a temporary file and rename that, so that a reader never sees
    /// half of it.
    #[must_use]
    pub fn to_text(&self) -> String {
        let (seconds, rest) =
            (self.time_ns.div_euclid(NS_PER_S), self.time_ns.rem_euclid(NS_PER_S));
        let Pose2 { x_m, y_m, yaw_rad } = self.pose;
        format!(
            "timestamp: {seconds}.{rest:09}\nframe_id: {}\nx: {x_m:.6}\ny: {y_m:.6}\nz: {:.6}\n\
             yaw: {yaw_rad:.6}\n",
            self.frame, self.z_m
        )
    }

    /// Parses the text of a file. Names may be in any order; unknown names are ignored.
    ///
    /// # Errors
    /// The line that is invalid, or the name that is missing.
    pub fn parse(text: &str) -> Result<Self, PoseFileError> {
        let (mut time_ns, mut frame) = (None, None);
        let mut numbers: [Option<f64>; 4] = [None; 4];
        for (line_index, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let wrong = |expected| PoseFileError::Line {
                line: line_index + 1,
                text: line.chars().take(SHOWN_COUNT).collect(),
                expected,
            };
            let (name, value) =
                line.split_once(':').ok_or_else(|| wrong("a name, a colon and a value"))?;
            let value = value.trim();
            let index = ["x", "y", "z", "yaw"].iter().position(|it| *it == name.trim());
            match (name.trim(), index) {
                ("timestamp", _) => {
                    time_ns = Some(nanoseconds(value).ok_or_else(|| wrong("seconds"))?);
                }
                ("frame_id", _) => frame = Some(value.trim_matches('"').to_owned()),
                (_, Some(index)) => {
                    let number = value.parse().ok().filter(|number: &f64| number.is_finite());
                    numbers[index] = Some(number.ok_or_else(|| wrong("a finite number"))?);
                }
                _ => {}
            }
        }
        let [x, y, z, yaw] = numbers;
        let missing = PoseFileError::Missing;
        Ok(Self {
            time_ns: time_ns.ok_or(missing("timestamp"))?,
            frame: frame.filter(|frame| !frame.is_empty()).ok_or(missing("frame_id"))?,
            pose: Pose2::new(
                x.ok_or(missing("x"))?,
                y.ok_or(missing("y"))?,
                yaw.ok_or(missing("yaw"))?,
            ),
            z_m: z.unwrap_or(0.0),
        })
    }
}

/// Seconds with up to nine decimals.
fn nanoseconds(text: &str) -> Option<i64> {
    let (whole, part) = text.split_once('.').unwrap_or((text, ""));
    if part.len() > 9 || !part.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let rest: i64 = format!("{part:0<9}").parse().ok()?;
    whole.parse::<i64>().ok()?.checked_mul(NS_PER_S)?.checked_add(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_trip() {
        for time_ns in [0, 12_500_000_000, -1, 1_700_000_000_123_456_789] {
            let pose = Pose2::new(1.5, -2.25, 0.5);
            let saved = SavedPose { time_ns, frame: "map".into(), pose, z_m: 0.0 };
            assert_eq!(SavedPose::parse(&saved.to_text()), Ok(saved));
        }
    }

    #[test]
    fn errors_name_the_line() {
        let message = |text: &str| SavedPose::parse(text).unwrap_err().to_string();
        assert!(
            message("timestamp: 1.5\nx: nan").starts_with("line 2 of the saved pose is `x: nan`")
        );
        assert!(message("timestamp: 1.5").starts_with("the saved pose has no `frame_id:`"));
        assert!(message("hello").starts_with("line 1"));
        assert!(message("timestamp: 1.\u{661}").starts_with("line 1"));
    }
}
