//! What goes wrong, in the words of tf2: people search for them.

use std::fmt;

/// Why a transform is not taken.
#[derive(Clone, Debug, PartialEq)]
pub enum Refused {
    /// A frame would be its own parent: `TF_SELF_TRANSFORM`.
    SelfTransform(String),
    /// It has no child: `TF_NO_CHILD_FRAME_ID`.
    NoChild,
    /// It has no parent: `TF_NO_FRAME_ID`; the child.
    NoParent(String),
    /// A number is none: `TF_NAN_INPUT`; the child.
    NotANumber(String),
    /// The quaternion is far from unit length: `TF_DENORMALIZED_QUATERNION`; child and quaternion.
    Denormalized(String, [f64; 4]),
    /// It is older than all that is kept: `TF_OLD_DATA`; child and stamp \[ns\].
    OldData(String, i64),
}

impl Refused {
    /// The name by which tf2 logs it.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::SelfTransform(_) => "TF_SELF_TRANSFORM",
            Self::NoChild => "TF_NO_CHILD_FRAME_ID",
            Self::NoParent(_) => "TF_NO_FRAME_ID",
            Self::NotANumber(_) => "TF_NAN_INPUT",
            Self::Denormalized(..) => "TF_DENORMALIZED_QUATERNION",
            Self::OldData(..) => "TF_OLD_DATA",
        }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name())?;
        match self {
            Self::SelfTransform(frame) => {
                write!(f, "`{frame}` is said to be the parent of itself")
            }
            Self::NoChild => write!(f, "a transform names no child frame"),
            Self::NoParent(child) => write!(f, "the transform of `{child}` names no parent frame"),
            Self::NotANumber(child) => {
                write!(f, "the transform of `{child}` has a number that is none")
            }
            Self::Denormalized(child, [x, y, z, w]) => write!(
                f,
                "the rotation of `{child}` is no unit quaternion: ({x:.6} {y:.6} {z:.6} {w:.6})"
            ),
            Self::OldData(child, stamp_ns) => write!(
                f,
                "the transform of `{child}` at time {} is older than all that is kept",
                crate::display_time(*stamp_ns)
            ),
        }
    }
}

impl std::error::Error for Refused {}

/// Why there is no transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unreachable {
    /// A frame is not known, or frames run in a circle.
    Lookup,
    /// No chain leads from one to the other.
    Connectivity,
    /// There is one sample only, and its time is another.
    NoDataForExtrapolation,
    /// The time is later than the newest sample.
    Forward,
    /// The time is earlier than the oldest sample.
    Backward,
    /// A name is empty or begins with a slash.
    InvalidArgument,
}

impl Unreachable {
    /// The class that tf2 throws.
    #[must_use]
    pub fn exception(self) -> &'static str {
        match self {
            Self::Lookup => "LookupException",
            Self::Connectivity => "ConnectivityException",
            Self::NoDataForExtrapolation => "NoDataForExtrapolationException",
            Self::Forward => "ForwardExtrapolationException",
            Self::Backward => "BackwardExtrapolationException",
            Self::InvalidArgument => "InvalidArgumentException",
        }
    }

    /// Whether a time is the reason: these three are one class in humble, `ExtrapolationException`.
    #[must_use]
    pub fn is_extrapolation(self) -> bool {
        matches!(self, Self::NoDataForExtrapolation | Self::Forward | Self::Backward)
    }
}

/// Why there is no transform, and tf2's words for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LookupError {
    /// The kind.
    pub kind: Unreachable,
    /// The words.
    pub message: String,
}

impl LookupError {
    pub(crate) fn new(kind: Unreachable, message: String) -> Self {
        Self { kind, message }
    }
}

impl fmt::Display for LookupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for LookupError {}
