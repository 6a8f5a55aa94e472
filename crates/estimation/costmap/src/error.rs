//! Errors.

use std::fmt;

/// Mistake in the text of a footprint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FootprintError {
    /// Fewer than three corners.
    TooFewCorners(usize),
    /// A corner that has not two numbers; with their count.
    CornerLength(usize),
    /// Brackets that nest deeper than two.
    TooDeep,
    /// A bracket that closes and was not opened.
    UnopenedBracket,
    /// A bracket that is not closed.
    UnclosedBracket,
    /// A text outside the brackets of a corner.
    OutsideCorner(String),
    /// A text that is not a number.
    NotNumber(String),
    /// A number that is not finite.
    NotFinite(String),
}

impl fmt::Display for FootprintError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewCorners(count) => {
                write!(f, "it has {count} corners, and a footprint needs at least three")
            }
            Self::CornerLength(count) => {
                write!(f, "a corner needs x and y, and one has {count} numbers")
            }
            Self::TooDeep => write!(f, "brackets nest deeper than two"),
            Self::UnopenedBracket => write!(f, "a bracket closes that was not opened"),
            Self::UnclosedBracket => write!(f, "a bracket is not closed"),
            Self::OutsideCorner(word) => {
                write!(f, "`{word}` is outside the brackets of a corner")
            }
            Self::NotNumber(word) => write!(f, "`{word}` is not a number"),
            Self::NotFinite(word) => write!(f, "`{word}` is not a finite number"),
        }
    }
}

impl std::error::Error for FootprintError {}

/// Reason for which a static layer rejects a map or an update of its map.
#[derive(Clone, Debug, PartialEq)]
pub enum MapError {
    /// The map has no frame.
    NoFrame,
    /// The resolution is not finite or too small \[m\].
    Resolution(f64),
    /// The origin is not finite.
    Origin,
    /// The map has another number of cells than its size requires.
    CellCount {
        /// Number of cells.
        count: usize,
        /// Width \[cells\].
        width: usize,
        /// Height \[cells\].
        height: usize,
    },
    /// The map has no cells.
    NoCells,
    /// An update arrived before a map.
    NoMap,
    /// An update extends beyond the map.
    BeyondMap {
        /// Cell after the upper right corner of the update.
        end: (usize, usize),
        /// Size of the map \[cells\].
        size: (usize, usize),
    },
    /// An update is in another frame than the map.
    OtherFrame {
        /// Frame of the update.
        update: String,
        /// Frame of the map.
        map: String,
    },
    /// An update has another number of cells than its window.
    UpdateCellCount {
        /// Number of cells.
        count: usize,
        /// Width of the window \[cells\].
        width: usize,
        /// Height of the window \[cells\].
        height: usize,
    },
}

impl fmt::Display for MapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoFrame => write!(f, "the map has no frame (`header.frame_id`)"),
            Self::Resolution(resolution_m) => {
                write!(f, "the resolution of the map is {resolution_m} m")
            }
            Self::Origin => write!(f, "the origin of the map is not finite"),
            Self::CellCount { count, width, height } => {
                write!(f, "the map has {count} cells and should have {width} x {height}")
            }
            Self::NoCells => write!(f, "the map has no cells"),
            Self::NoMap => write!(f, "there is no map yet"),
            Self::BeyondMap { end: (x, y), size: (width, height) } => write!(
                f,
                "the update extends to ({x}, {y}), and the map has {width} x {height} cells"
            ),
            Self::OtherFrame { update, map } => {
                write!(f, "the update is in frame `{update}`, and the map in `{map}`")
            }
            Self::UpdateCellCount { count, width, height } => {
                write!(f, "the update has {count} cells and should have {width} x {height}")
            }
        }
    }
}

impl std::error::Error for MapError {}

/// Reason for which a parameter cannot change while the costmap runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ChangeError {
    /// This parameter never changes while the costmap runs.
    Fixed(&'static str),
    /// `publish_frequency` would not be positive.
    PublishFrequency,
    /// `restore_cleared_footprint` would change while the footprint is not cleared.
    RestoreWithoutClearing,
    /// A base frame without a transform would stop all updates.
    NoRobotTransform {
        /// The new base frame.
        base: String,
        /// Frame of the costmap.
        global: String,
        /// The present base frame.
        kept: String,
    },
    /// The footprint cannot be read.
    Footprint(FootprintError),
}

impl fmt::Display for ChangeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(name) => {
                write!(f, "`{name}` cannot be changed while the costmap runs")
            }
            Self::PublishFrequency => {
                write!(f, "`publish_frequency` must be above 0 while the costmap runs")
            }
            Self::RestoreWithoutClearing => write!(
                f,
                "`restore_cleared_footprint` cannot be changed while `footprint_clearing_enabled` is \
                 false; set that first"
            ),
            Self::NoRobotTransform { base, global, kept } => write!(
                f,
                "there is no transform from `{base}` to `{global}`; `robot_base_frame` stays `{kept}`"
            ),
            Self::Footprint(error) => write!(f, "`footprint`: {error}"),
        }
    }
}

impl std::error::Error for ChangeError {}

/// Layers for which nothing was cleared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClearError {
    /// Names of requested layers that do not exist or are not clearable, in the order of the request.
    pub layers: Vec<UnclearableLayer>,
    /// Names of the clearable layers.
    pub clearable: Vec<String>,
}

/// Layer that cannot be cleared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnclearableLayer {
    /// There is no layer of this name.
    Unknown(String),
    /// The layer has no observations to clear.
    NotClearable(String),
}

impl fmt::Display for ClearError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let layers: Vec<String> = self.layers.iter().map(ToString::to_string).collect();
        let clearable = self.clearable.join(", ");
        let clearable = if clearable.is_empty() { "none" } else { &clearable };
        write!(f, "nothing was cleared: {}; clearable layers: {clearable}", layers.join(", "))
    }
}

impl fmt::Display for UnclearableLayer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => write!(f, "there is no layer `{name}`"),
            Self::NotClearable(name) => write!(f, "layer `{name}` is not clearable"),
        }
    }
}

impl std::error::Error for ClearError {}

/// Plugin that is not a supported layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownPlugin(pub String);

impl fmt::Display for UnknownPlugin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is not a supported layer", self.0)
    }
}

impl std::error::Error for UnknownPlugin {}
