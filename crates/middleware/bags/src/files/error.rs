//! Errors of bags.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use crate::{ReadError, WriteError};
use periplus_diagnostics::plain_words;
use periplus_graph::GraphError;

use crate::files::sqlite::DatabaseError;

/// Reason for which a bag cannot be opened, read or written.
#[derive(Debug)]
#[non_exhaustive]
pub enum BagError {
    /// A file or folder cannot be opened or created.
    File(PathBuf, io::Error),
    /// There is no bag at the path.
    NoBag(PathBuf, String),
    /// A file became unreadable.
    Read(PathBuf, ReadError),
    /// A database cannot be read or written.
    Database(PathBuf, DatabaseError),
    /// This build has no SQLite: it runs in a browser tab.
    WithoutDatabases(PathBuf),
    /// A compressed file or message cannot be decompressed.
    Unpack(PathBuf, String),
    /// A file cannot be written.
    Write(PathBuf, WriteError),
    /// The output exists already.
    Exists(PathBuf),
    /// The settings are contradictory.
    Settings(String),
    /// The graph refused an endpoint.
    Graph(GraphError),
}

impl BagError {
    pub(crate) fn file(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |error| Self::File(path, error)
    }

    pub(crate) fn read(path: &Path) -> impl FnOnce(ReadError) -> Self {
        let path = path.to_owned();
        move |error| Self::Read(path, error)
    }

    pub(crate) fn write(path: &Path) -> impl FnOnce(WriteError) -> Self {
        let path = path.to_owned();
        move |error| Self::Write(path, error)
    }

    pub(crate) fn database(path: &Path) -> impl FnOnce(DatabaseError) -> Self {
        let path = path.to_owned();
        move |error| Self::Database(path, error)
    }
}

impl fmt::Display for BagError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path, error) => {
                write!(f, "`{}`: {}", path.display(), plain_words(error))
            }
            Self::NoBag(path, why) => write!(f, "`{}` is not a bag: {why}", path.display()),
            Self::Read(path, error) => write!(f, "`{}`: {error}", path.display()),
            Self::Database(path, error) => {
                write!(f, "`{}`: the database cannot be used: {error}", path.display())
            }
            Self::WithoutDatabases(path) => write!(
                f,
                "`{}`: databases of SQLite cannot be used in a browser tab; convert it with \
                 `periplus bag convert BAG -o BAG.mcap`, or use `periplus view`",
                path.display()
            ),
            Self::Unpack(path, why) => {
                write!(f, "`{}` cannot be decompressed: {why}", path.display())
            }
            Self::Write(path, error) => write!(f, "`{}`: {error}", path.display()),
            Self::Exists(path) => {
                write!(f, "`{}` already exists; remove it or choose another path", path.display())
            }
            Self::Settings(why) => f.write_str(why),
            Self::Graph(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for BagError {}

impl From<GraphError> for BagError {
    fn from(error: GraphError) -> Self {
        Self::Graph(error)
    }
}
