//! The pose that outlives a restart, as text.

use std::fmt;

use periplus_geometry::Pose2;

/// A pose as it is saved; the form is that of Nav2.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedPose {
    /// When it held \[ns\].
    pub time_ns: i64,
    /// The frame in which it is.
    pub frame: String,
    /// Where the robot was.
    pub pose: Pose2,
    /// How high it was \[m\].
    pub z_m: f64,
}

/// A text that is no saved pose.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PoseFileError {
    /// A line of it is not `name: value`, or its value cannot be read.
    Line {
        /// Which, from 1.
        line: usize,
        /// What it says.
        text: String,
        /// What it should say.
        wanted: &'static str,
    },
    /// A name is missing.
    Missing(&'static str),
}

impl fmt::Display for PoseFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line { line, text, wanted } => {
                write!(f, "line {line} of the saved pose is `{text}`; it must be {wanted}")
            }
            Self::Missing(name) => write!(f, "the saved pose has no `{name}:`"),
        }?;
        f.write_str("; remove the file to start without it")
    }
}

impl std::error::Error for PoseFileError {}

const NANOSECONDS: i64 = 1_000_000_000;

/// Longer lines are shown in part.
const SHOWN: usize = 60;

impl SavedPose {
    /// The text of the file. Who writes it puts it beside and renames it, so that no half of it is
    /// ever read.
    #[must_use]
    pub fn to_text(&self) -> String {
        let (seconds, rest) =
            (self.time_ns.div_euclid(NANOSECONDS), self.time_ns.rem_euclid(NANOSECONDS));
        let Pose2 { x_m, y_m, yaw_rad } = self.pose;
        format!(
            "timestamp: {seconds}.{rest:09}\nframe_id: {}\nx: {x_m:.6}\ny: {y_m:.6}\nz: {:.6}\n\
             yaw: {yaw_rad:.6}\n",
            self.frame, self.z_m
        )
    }

    /// Reads the text of a file. Names may come in any order, and unknown ones are passed over.
    ///
    /// # Errors
    /// Which line cannot be read, or what is missing.
    pub fn read(text: &str) -> Result<Self, PoseFileError> {
        let (mut time_ns, mut frame) = (None, None);
        let mut numbers: [Option<f64>; 4] = [None; 4];
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let wrong = |wanted| PoseFileError::Line {
                line: index + 1,
                text: line.chars().take(SHOWN).collect(),
                wanted,
            };
            let (name, value) =
                line.split_once(':').ok_or_else(|| wrong("a name, a colon and a value"))?;
            let value = value.trim();
            let place = ["x", "y", "z", "yaw"].iter().position(|it| *it == name.trim());
            match (name.trim(), place) {
                ("timestamp", _) => {
                    time_ns = Some(nanoseconds(value).ok_or_else(|| wrong("seconds"))?);
                }
                ("frame_id", _) => frame = Some(value.trim_matches('"').to_owned()),
                (_, Some(place)) => {
                    let number = value.parse().ok().filter(|number: &f64| number.is_finite());
                    numbers[place] = Some(number.ok_or_else(|| wrong("a finite number"))?);
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
    whole.parse::<i64>().ok()?.checked_mul(NANOSECONDS)?.checked_add(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        for time_ns in [0, 12_500_000_000, -1, 1_700_000_000_123_456_789] {
            let pose = Pose2::new(1.5, -2.25, 0.5);
            let saved = SavedPose { time_ns, frame: "map".into(), pose, z_m: 0.0 };
            assert_eq!(SavedPose::read(&saved.to_text()), Ok(saved));
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let told = |text: &str| SavedPose::read(text).unwrap_err().to_string();
        assert!(told("timestamp: 1.5\nx: nan").starts_with("line 2 of the saved pose is `x: nan`"));
        assert!(told("timestamp: 1.5").starts_with("the saved pose has no `frame_id:`"));
        assert!(told("hello").starts_with("line 1"));
        assert!(told("timestamp: 1.\u{661}").starts_with("line 1"));
    }
}
