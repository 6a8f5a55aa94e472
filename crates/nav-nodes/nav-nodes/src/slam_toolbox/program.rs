//! Programs of `slam_toolbox` and `gmapping`.

use std::fmt;
use std::str::FromStr;

use periplus_params::Table;
use periplus_slam::Method;

/// A program of `slam_toolbox`, or `slam_gmapping`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Program {
    /// `async_slam_toolbox_node`: in live mode the newest scan is used, and older ones are skipped.
    Async,
    /// `sync_slam_toolbox_node`: every scan is used; scans are queued.
    Sync,
    /// `localization_slam_toolbox_node`: the robot is localized on a stored graph, which is not
    /// changed.
    Localization,
    /// `lifelong_slam_toolbox_node`: scans are removed when newer ones cover the same area.
    Lifelong,
    /// `slam_gmapping` of ROS 1.
    Gmapping,
}

impl Program {
    /// All programs.
    pub const ALL: [Self; 5] =
        [Self::Async, Self::Sync, Self::Localization, Self::Lifelong, Self::Gmapping];

    /// Name on the command line.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Async => "async",
            Self::Sync => "sync",
            Self::Localization => "localization",
            Self::Lifelong => "lifelong",
            Self::Gmapping => "gmapping",
        }
    }

    /// The name of the executable.
    #[must_use]
    pub const fn executable(self) -> &'static str {
        match self {
            Self::Async => "async_slam_toolbox_node",
            Self::Sync => "sync_slam_toolbox_node",
            Self::Localization => "localization_slam_toolbox_node",
            Self::Lifelong => "lifelong_slam_toolbox_node",
            Self::Gmapping => "slam_gmapping",
        }
    }

    /// Name of the node in its launch files.
    #[must_use]
    pub const fn node_name(self) -> &'static str {
        if self.is_toolbox() { "slam_toolbox" } else { "slam_gmapping" }
    }

    /// True for the programs of `slam_toolbox`.
    #[must_use]
    pub const fn is_toolbox(self) -> bool {
        !matches!(self, Self::Gmapping)
    }

    /// Returns its mapping method.
    #[must_use]
    pub const fn method(self) -> Method {
        if self.is_toolbox() { Method::Graph } else { Method::Gmapping }
    }

    /// Its parameters.
    #[must_use]
    pub fn table(self) -> &'static Table {
        self.method().table()
    }
}

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for Program {
    type Err = String;

    /// Returns the program of a name on the command line or of an executable.
    fn from_str(word: &str) -> Result<Self, String> {
        let named = |program: &Self| program.word() == word || program.executable() == word;
        Self::ALL.into_iter().find(named).ok_or_else(|| {
            let words: Vec<&str> = Self::ALL.iter().map(|it| it.word()).collect();
            format!("`{word}` is not a mapping program; there are {}", words.join(", "))
        })
    }
}
