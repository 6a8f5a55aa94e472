//! What a reader left out or guessed: nothing is dropped silently.

/// One thing the reader did not take over as written, and how often.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// What was left out or assumed, and what to do.
    pub message: String,
    /// How many times it happened in this file.
    pub count: usize,
}

/// More kinds than this in one file tell a person nothing new, and a hostile
/// file could otherwise make one per element.
const KINDS_MAX: usize = 32;

/// Collects notes, equal ones counted together, in order of first appearance.
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
        } else if self.notes.len() < KINDS_MAX {
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
