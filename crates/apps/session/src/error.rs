//! Errors of sessions.

use std::error::Error;
use std::fmt::{self, Display};
use std::io;
use std::path::PathBuf;

use periplus_diagnostics::plain_words;
use periplus_graph::GraphError;
use periplus_sim::{Diverged, DriveError, RecordError};

use crate::files::FileError;
use crate::network::{DdsError, GzTransportError, Ros1Error};
use crate::page::PageError;

/// Reasons that a session or one of its parts cannot start.
#[derive(Debug)]
pub enum RunError {
    /// A file of the world has nothing to simulate.
    Empty(PathBuf),
    /// The world cannot be stepped.
    Diverged(Diverged),
    /// The graph refused a name, a type or a parameter.
    Graph(GraphError),
    /// The recording cannot start.
    Recording {
        /// File or folder of the recording.
        path: PathBuf,
        /// Reason.
        error: RecordError,
    },
    /// The velocity script does not fit the world.
    Script(DriveError),
    /// The services of the world cannot be offered.
    Services(GraphError),
    /// The topics of the page cannot be published.
    Display(GraphError),
    /// The ROS 2 network cannot be joined by a simulation.
    Ros2(DdsError),
    /// The ROS 2 network cannot be joined by a live graph.
    Join(DdsError),
    /// The Zenoh network cannot be joined.
    #[cfg(feature = "zenoh")]
    Zenoh(periplus_rmw_zenoh::ZenohError),
    /// This build has no Zenoh.
    WithoutZenoh,
    /// The ROS 1 network cannot be joined.
    Ros1(Ros1Error),
    /// The Gazebo Transport network cannot be joined.
    Gazebo(GzTransportError),
    /// The page cannot be opened.
    Page(PageError),
    /// A node cannot start.
    Node {
        /// Name of the node or of its task.
        name: String,
        /// Reason.
        error: Box<RunError>,
    },
    /// A file cannot be read or written.
    File(FileError),
    /// A file has no parameters for the nodes that it is meant for.
    NoParameters(String),
    /// A result does not exist.
    NoData(&'static str),
    /// The robot lacks something that the requested nodes need.
    Robot(&'static str),
    /// Two robots have the same topics.
    SharedNamespace {
        /// Namespace of both.
        namespace: String,
        /// Their names.
        robots: [String; 2],
    },
    /// Errors in a file, which are printed already.
    Reported,
    /// A failed write to stdout or stderr.
    Output(io::Error),
}

impl RunError {
    /// Error of a node.
    pub(crate) fn node(name: impl Into<String>, error: impl Into<RunError>) -> Self {
        Self::Node { name: name.into(), error: Box::new(error.into()) }
    }
}

impl Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty(path) => write!(f, "{} has nothing to simulate", path.display()),
            Self::Diverged(error) => error.fmt(f),
            Self::Graph(error) => error.fmt(f),
            Self::Recording { path, error } => {
                write!(f, "cannot record to {}: {error}", path.display())
            }
            Self::Script(error) => write!(f, "cannot run the script: {error}"),
            Self::Services(error) => {
                write!(f, "cannot offer the services of the world: {error}")
            }
            Self::Display(error) => write!(f, "the world cannot be shown: {error}"),
            Self::Ros2(error) => error.fmt(f),
            Self::Join(error) => write!(f, "cannot join ROS 2: {error}"),
            #[cfg(feature = "zenoh")]
            Self::Zenoh(error) => error.fmt(f),
            Self::WithoutZenoh => f.write_str(
                "this periplus was built without Zenoh, which needs 200 more crates; build one \
                 with `cargo build --release --features zenoh`",
            ),
            Self::Ros1(error) => error.fmt(f),
            Self::Gazebo(error) => error.fmt(f),
            Self::Page(error) => error.fmt(f),
            Self::Node { name, error } => write!(f, "{name} cannot run: {error}"),
            Self::File(error) => error.fmt(f),
            Self::NoParameters(message) => f.write_str(message),
            Self::NoData(message) | Self::Robot(message) => f.write_str(message),
            Self::SharedNamespace { namespace, robots: [one, other] } => write!(
                f,
                "the robots `{one}` and `{other}` have the same namespace `{namespace}`, and with it the same topics: \
                 give one of them another with `--namespace`"
            ),
            Self::Reported => f.write_str("a file has errors"),
            Self::Output(error) => {
                write!(f, "cannot write the output: {}", plain_words(error))
            }
        }
    }
}

impl Error for RunError {}

macro_rules! from {
    ($($error:ty => $variant:ident),* $(,)?) => {
        $(impl From<$error> for RunError {
            fn from(error: $error) -> Self {
                Self::$variant(error)
            }
        })*
    };
}

from! {
    Diverged => Diverged,
    GraphError => Graph,
    DdsError => Ros2,
    Ros1Error => Ros1,
    GzTransportError => Gazebo,
    PageError => Page,
    FileError => File,
    io::Error => Output,
}
