//! Databases in WebAssembly: none can be opened, since SQLite is written in C.

use std::convert::Infallible;
use std::ops::{ControlFlow, Range};
use std::path::Path;

use super::TimeSummary;
use crate::files::BagError;
use crate::files::part::Part;
use crate::files::write::WriteSettings;
use crate::{BagTopic, Message, Selection, Stamp, Stored};

/// Error of a database.
pub(crate) type DatabaseError = Infallible;

pub(crate) struct Database(Infallible);

impl Database {
    pub(crate) fn open(path: &Path) -> Result<Self, BagError> {
        Err(BagError::WithoutDatabases(path.to_owned()))
    }

    pub(crate) fn look(self) -> Result<Part, BagError> {
        match self.0 {}
    }

    pub(crate) fn read(self, _: &Selection) -> Result<Rows, BagError> {
        match self.0 {}
    }
}

pub(crate) struct Rows(Infallible);

impl Rows {
    pub(crate) fn faults(&self) -> &[String] {
        match self.0 {}
    }

    pub(crate) fn peek_ns(&mut self) -> Result<Option<i64>, DatabaseError> {
        match self.0 {}
    }

    pub(crate) fn next(&mut self) -> Result<Option<Message<'_>>, DatabaseError> {
        match self.0 {}
    }
}

pub(crate) struct TimeTable(Infallible);

impl TimeTable {
    pub(crate) fn new(
        database: Database,
        _: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(Self, TimeSummary), BagError> {
        match database.0 {}
    }

    pub(crate) fn topic_ids(&self) -> &[i64] {
        match self.0 {}
    }

    pub(crate) fn newest(
        &self,
        _: i64,
        _: i64,
        _: usize,
        _: &mut dyn FnMut(i64, i64),
    ) -> Result<(), BagError> {
        match self.0 {}
    }

    pub(crate) fn between(
        &self,
        _: i64,
        _: &Range<i64>,
        _: usize,
        _: &mut dyn FnMut(i64, i64) -> ControlFlow<()>,
    ) -> Result<(), BagError> {
        match self.0 {}
    }

    pub(crate) fn load(&self, _: i64, _: &mut Vec<u8>) -> Result<Result<(), String>, BagError> {
        match self.0 {}
    }
}

pub(crate) struct SqliteWriter(Infallible);

impl SqliteWriter {
    pub(crate) fn create(path: &Path, _: &WriteSettings) -> Result<Self, BagError> {
        Err(BagError::WithoutDatabases(path.to_owned()))
    }

    pub(crate) fn topic(&mut self, _: &BagTopic) -> Result<usize, BagError> {
        match self.0 {}
    }

    pub(crate) fn write(&mut self, _: usize, _: Stamp, _: &[u8]) -> Result<(), BagError> {
        match self.0 {}
    }

    pub(crate) fn bytes(&self) -> u64 {
        match self.0 {}
    }

    pub(crate) fn advance_to(&mut self, _: i64) -> Result<(), BagError> {
        match self.0 {}
    }

    pub(crate) fn flush(&mut self) -> Result<(), BagError> {
        match self.0 {}
    }

    pub(crate) fn finish(self, _: &Stored) -> Result<crate::BagInfo, BagError> {
        match self.0 {}
    }
}
