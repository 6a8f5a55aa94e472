//! Notes about content that a reader left out or assumed.

/// Note with the number of its occurrences.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Content that was left out or assumed, and advice.
    pub message: String,
    /// Number of occurrences in this file.
    pub count: usize,
}

/// Maximum number of different notes. More are of no use, and a hostile file could otherwise cause one per
/// element.
const MAX_NOTES: usize = 32;

/// Collects notes in order of first appearance and counts equal ones.
#[derive(Default)]
pub(crate) struct Notes {
    notes: Vec<Note>,
    left_out: usize,
}

impl Notes {
    pub(crate) fn add(&mut self, message: impl Into<String>) {
        let mut message: String = message.into();
        if message.len() > 400 {
            message = message.chars().take(400).chain("...".chars()).collect();
        }
        if let Some(note) = self.notes.iter_mut().find(|note| note.message == message) {
            note.count += 1;
        } else if self.notes.len() < MAX_NOTES {
            self.notes.push(Note { message, count: 1 });
        } else {
            self.left_out += 1;
        }
    }

    pub(crate) fn finish(mut self) -> Vec<Note> {
        if self.left_out > 0 {
            let message = "further notes on this file left out".to_owned();
            self.notes.push(Note { message, count: self.left_out });
        }
        self.notes
    }
}
