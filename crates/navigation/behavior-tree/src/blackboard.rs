//! Blackboards: named entries of a tree and its subtrees.

use std::collections::BTreeMap;
use std::fmt;

use crate::TreeValue;
use crate::value::PortType;

/// Maximum number of entries of one blackboard. A script in a loop could create any number.
pub const MAX_BLACKBOARD_ENTRIES: usize = 10_000;

/// Reason for which an entry cannot be set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EntryError {
    /// The value cannot be converted to the type of the entry.
    Type {
        /// Name of the entry.
        key: String,
        /// Type of the entry.
        expected: String,
        /// Type of the value.
        actual: &'static str,
    },
    /// The blackboard has [`MAX_BLACKBOARD_ENTRIES`] entries.
    TooManyEntries,
}

impl fmt::Display for EntryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Type { key, expected, actual } => write!(
                f,
                "entry `{key}` has the type {expected}, and a {actual} cannot be converted to it"
            ),
            Self::TooManyEntries => {
                write!(f, "the blackboard has {MAX_BLACKBOARD_ENTRIES} entries already")
            }
        }
    }
}

impl std::error::Error for EntryError {}

/// Entry of a blackboard.
#[derive(Clone, Debug)]
struct Entry {
    value: Option<TreeValue>,
    port_type: PortType,
    /// Number of writes.
    sequence: u64,
}

/// Blackboard of one tree or subtree.
#[derive(Clone, Debug, Default)]
struct Board {
    parent: Option<usize>,
    entries: BTreeMap<String, Entry>,
    /// Names in this board that are names in the parent's.
    remaps: BTreeMap<String, String>,
    /// All names without a leading `_` are those of the parent.
    is_autoremapped: bool,
}

/// Blackboard of a tree with those of its subtrees.
///
/// An entry belongs to the board in which it was first used, or to a board further up if a subtree remaps
/// its name. A name that begins with `@` is in the board of the root.
///
/// ```
/// use periplus_behavior_tree::{Blackboard, TreeValue};
///
/// let mut blackboard = Blackboard::new();
/// blackboard.set("number_recoveries", TreeValue::Int(0)).unwrap();
/// assert_eq!(blackboard.get("number_recoveries"), Some(&TreeValue::Int(0)));
/// assert_eq!(blackboard.get("goal"), None);
/// ```
#[derive(Clone, Debug)]
pub struct Blackboard {
    boards: Vec<Board>,
}

impl Default for Blackboard {
    fn default() -> Self {
        Self::new()
    }
}

/// Board of the root.
pub(crate) const ROOT: usize = 0;

impl Blackboard {
    /// Returns an empty blackboard.
    #[must_use]
    pub fn new() -> Self {
        Self { boards: vec![Board::default()] }
    }

    /// Value of an entry of the root, if it has one.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&TreeValue> {
        self.get_in(ROOT, key)
    }

    /// Sets an entry of the root; it is created if needed.
    ///
    /// # Errors
    /// When the entry has another type, or there are too many entries.
    pub fn set(&mut self, key: &str, value: impl Into<TreeValue>) -> Result<(), EntryError> {
        self.set_in(ROOT, key, value.into())
    }

    /// Removes an entry of the root.
    pub fn unset(&mut self, key: &str) {
        self.unset_in(ROOT, key);
    }

    /// Names of the entries of the root that have a value, in alphabetical order.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        let entries = self.boards.first().into_iter().flat_map(|board| &board.entries);
        entries.filter(|(_, entry)| entry.value.is_some()).map(|(key, _)| key.as_str())
    }

    /// Values of the root without types, remaps and subtrees: the state that another tree begins with.
    #[must_use]
    pub(crate) fn values_only(&self) -> Self {
        let mut fresh = Self::new();
        for key in self.keys() {
            if let Some(value) = self.get(key) {
                // Fewer entries than here, all untyped.
                let _ = fresh.set(key, value.clone());
            }
        }
        fresh
    }

    /// Adds the board of a subtree.
    pub(crate) fn add_board(&mut self, parent: usize, is_autoremapped: bool) -> usize {
        self.boards.push(Board { parent: Some(parent), is_autoremapped, ..Board::default() });
        self.boards.len() - 1
    }

    pub(crate) fn add_remap(&mut self, board: usize, internal: &str, external: &str) {
        self.boards[board].remaps.insert(internal.to_owned(), external.to_owned());
    }

    /// Creates an entry in this board, also where its name would be one of the parent.
    pub(crate) fn own(&mut self, board: usize, key: &str) {
        let entry = Entry { value: None, port_type: PortType::Any, sequence: 0 };
        self.boards[board].entries.entry(key.to_owned()).or_insert(entry);
    }

    /// Board and name that hold an entry, or would hold it once it is created.
    fn home<'a>(&'a self, mut board: usize, mut key: &'a str) -> (usize, &'a str) {
        loop {
            if let Some(name) = key.strip_prefix('@') {
                return (ROOT, name);
            }
            let here = &self.boards[board];
            let Some(parent) = here.parent else { return (board, key) };
            if here.entries.contains_key(key) {
                return (board, key);
            }
            if let Some(outer) = here.remaps.get(key) {
                (board, key) = (parent, outer);
            } else if here.is_autoremapped && !key.starts_with('_') {
                board = parent;
            } else {
                return (board, key);
            }
        }
    }

    fn entry(&self, board: usize, key: &str) -> Option<&Entry> {
        let (home, name) = self.home(board, key);
        self.boards[home].entries.get(name)
    }

    /// Value of an entry.
    pub(crate) fn get_in(&self, board: usize, key: &str) -> Option<&TreeValue> {
        self.entry(board, key)?.value.as_ref()
    }

    /// True if the entry exists, with or without a value.
    pub(crate) fn exists(&self, board: usize, key: &str) -> bool {
        self.entry(board, key).is_some()
    }

    /// Number of writes of an entry; none if it does not exist.
    pub(crate) fn sequence(&self, board: usize, key: &str) -> Option<u64> {
        Some(self.entry(board, key)?.sequence)
    }

    /// Declares an entry with the type of a port.
    ///
    /// # Errors
    /// The earlier type, when it is another one. Entries of text can be read by ports of every type.
    pub(crate) fn declare(
        &mut self,
        board: usize,
        key: &str,
        port_type: &PortType,
    ) -> Result<(), PortType> {
        let (home, name) = self.home(board, key);
        let name = name.to_owned();
        let entries = &mut self.boards[home].entries;
        match entries.get_mut(&name) {
            None => {
                let entry = Entry { value: None, port_type: port_type.clone(), sequence: 0 };
                entries.insert(name, entry);
                Ok(())
            }
            Some(entry) if entry.port_type == PortType::Text => Ok(()),
            Some(entry) if entry.port_type.agrees(port_type) => Ok(()),
            Some(entry) => Err(entry.port_type.clone()),
        }
    }

    /// Sets an entry that is created if needed.
    pub(crate) fn set_in(
        &mut self,
        board: usize,
        key: &str,
        value: TreeValue,
    ) -> Result<(), EntryError> {
        let (home, name) = self.home(board, key);
        let name = name.to_owned();
        let entries = &mut self.boards[home].entries;
        let is_full = entries.len() >= MAX_BLACKBOARD_ENTRIES;
        match entries.get_mut(&name) {
            Some(entry) => {
                let expected = entry.port_type.name().to_owned();
                let value = converted(value, &entry.port_type).map_err(|value| {
                    EntryError::Type { key: name, expected, actual: value.type_name() }
                })?;
                entry.value = Some(value);
                entry.sequence += 1;
            }
            None if is_full => {
                return Err(EntryError::TooManyEntries);
            }
            None => {
                let entry = Entry { value: Some(value), port_type: PortType::Any, sequence: 1 };
                entries.insert(name, entry);
            }
        }
        Ok(())
    }

    pub(crate) fn unset_in(&mut self, board: usize, key: &str) {
        let (home, name) = self.home(board, key);
        let name = name.to_owned();
        self.boards[home].entries.remove(&name);
    }
}

/// Value as the type of an entry; the value itself if it has no such value.
fn converted(value: TreeValue, port_type: &PortType) -> Result<TreeValue, TreeValue> {
    let converted = match (port_type, &value) {
        (PortType::Any | PortType::List(_) | PortType::Object(_), _) => return Ok(value),
        (PortType::Text | PortType::Status, TreeValue::Text(_)) => return Ok(value),
        (PortType::Text | PortType::Status, _) => None,
        (_, TreeValue::Text(text)) => port_type.parse(text),
        (PortType::Bool, _) => value.as_bool().map(TreeValue::Bool),
        (PortType::Int(_) | PortType::Milliseconds, _) => value.as_i64().map(TreeValue::Int),
        (PortType::Real(_), _) => value.as_f64().map(TreeValue::Real),
    };
    converted.ok_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subtrees_see_what_they_remap() {
        let mut boards = Blackboard::new();
        boards.set("target", "dock").unwrap();
        let sub = boards.add_board(ROOT, false);
        boards.add_remap(sub, "goal", "target");
        assert_eq!(boards.get_in(sub, "goal"), Some(&"dock".into()));
        assert_eq!(boards.get_in(sub, "target"), None);
        assert_eq!(boards.get_in(sub, "@target"), Some(&"dock".into()));
        boards.set_in(sub, "goal", "door".into()).unwrap();
        boards.set_in(sub, "own", TreeValue::Int(1)).unwrap();
        assert_eq!(boards.get("target"), Some(&"door".into()));
        assert_eq!(boards.get("own"), None);
    }

    #[test]
    fn autoremap_shares_all_names_except_private_ones() {
        let mut boards = Blackboard::new();
        let sub = boards.add_board(ROOT, true);
        boards.set_in(sub, "path", TreeValue::Int(1)).unwrap();
        boards.set_in(sub, "_count", TreeValue::Int(2)).unwrap();
        assert_eq!(boards.get("path"), Some(&TreeValue::Int(1)));
        assert_eq!(boards.get("_count"), None);
        assert_eq!(boards.get_in(sub, "_count"), Some(&TreeValue::Int(2)));
    }

    #[test]
    fn types_conflict_unless_one_is_text_or_any() {
        let mut boards = Blackboard::new();
        boards.declare(ROOT, "code", &PortType::uint16()).unwrap();
        assert_eq!(boards.declare(ROOT, "code", &PortType::real()), Err(PortType::uint16()));
        boards.declare(ROOT, "code", &PortType::Any).unwrap();
        boards.declare(ROOT, "name", &PortType::Text).unwrap();
        boards.declare(ROOT, "name", &PortType::int()).unwrap();
        assert!(boards.set("code", TreeValue::Real(0.5)).is_err());
        boards.set("code", "7").unwrap();
        assert_eq!(boards.get("code"), Some(&TreeValue::Int(7)));
    }
}
