//! Errors with the messages of tf2, since users search for them.

use std::fmt;

/// Reason for which a transform is rejected.
#[derive(Clone, Debug, PartialEq)]
pub enum RejectedTransform {
    /// A frame is its own parent: `TF_SELF_TRANSFORM`.
    SelfTransform(String),
    /// The child frame is missing: `TF_NO_CHILD_FRAME_ID`.
    NoChild,
    /// The parent frame is missing: `TF_NO_FRAME_ID`; the child.
    NoParent(String),
    /// A component is NaN or infinite: `TF_NAN_INPUT`; the child.
    NotANumber(String),
    /// The quaternion is not of unit length: `TF_DENORMALIZED_QUATERNION`; child and quaternion.
    Denormalized(String, [f64; 4]),
    /// The transform is older than all cached samples: `TF_OLD_DATA`; child and stamp \[ns\].
    OldData(String, i64),
}

impl RejectedTransform {
    /// Returns the name under which tf2 logs it.
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

impl fmt::Display for RejectedTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name())?;
        match self {
            Self::SelfTransform(frame) => {
                write!(f, "frame `{frame}` is published as its own parent")
            }
            Self::NoChild => write!(f, "a transform has no child frame"),
            Self::NoParent(child) => write!(f, "the transform of `{child}` has no parent frame"),
            Self::NotANumber(child) => {
                write!(f, "the transform of `{child}` contains NaN or infinity")
            }
            Self::Denormalized(child, [x, y, z, w]) => write!(
                f,
                "the rotation of `{child}` is not a unit quaternion: ({x:.6} {y:.6} {z:.6} {w:.6})"
            ),
            Self::OldData(child, stamp_ns) => write!(
                f,
                "the transform of `{child}` at time {} is older than all cached samples",
                crate::display_time(*stamp_ns)
            ),
        }
    }
}

impl std::error::Error for RejectedTransform {}

/// Class of a lookup error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LookupErrorKind {
    /// A frame is unknown, or the tree contains a loop.
    Lookup,
    /// The two frames are in different trees.
    Connectivity,
    /// There is a single sample, with another stamp.
    NoDataForExtrapolation,
    /// The time is later than the newest sample.
    Forward,
    /// The time is earlier than the oldest sample.
    Backward,
    /// A frame name is empty or begins with a slash.
    InvalidArgument,
}

impl LookupErrorKind {
    /// Returns the exception class of tf2.
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

    /// Returns true if the requested time is the reason: these three are `ExtrapolationException`
    /// in Humble.
    #[must_use]
    pub fn is_extrapolation(self) -> bool {
        matches!(self, Self::NoDataForExtrapolation | Self::Forward | Self::Backward)
    }
}

/// Reason for which there is no transform, with the message of tf2.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LookupError {
    /// Class of the error.
    pub kind: LookupErrorKind,
    /// Message of tf2.
    pub message: String,
}

impl LookupError {
    pub(crate) fn new(kind: LookupErrorKind, message: String) -> Self {
        Self { kind, message }
    }
}

impl fmt::Display for LookupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for LookupError {}
