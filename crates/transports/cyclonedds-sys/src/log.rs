//! What Cyclone says beside its answers.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

/// As many lines wait; a program that never looks must not grow.
const MOST: usize = 200;

/// Categories of Cyclone, `dds/ddsrt/log.h`: fatal and error.
const SERIOUS: u32 = 0b11;
/// Fatal, error and warning.
const WORTH_TELLING: u32 = 0b111;

/// A line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogLine {
    /// Whether it is an error and not only a warning.
    pub is_error: bool,
    /// What it says.
    pub text: String,
}

static LINES: Mutex<VecDeque<LogLine>> = Mutex::new(VecDeque::new());

thread_local! {
    static LAST: RefCell<Option<String>> = const { RefCell::new(None) };
}

pub(crate) fn note(category: u32, text: &str) {
    if category & WORTH_TELLING == 0 {
        return;
    }
    let text = text.trim().to_owned();
    let _ = LAST.try_with(|last| *last.borrow_mut() = Some(text.clone()));
    let mut lines = LINES.lock().unwrap_or_else(PoisonError::into_inner);
    if lines.len() == MOST {
        lines.pop_front();
    }
    lines.push_back(LogLine { is_error: category & SERIOUS != 0, text });
}

/// What it said in this thread since the last error.
pub(crate) fn last_of_this_thread() -> Option<String> {
    LAST.try_with(|last| last.borrow_mut().take()).ok().flatten()
}

/// What it said since the last call, in all threads: at most the newest two hundred lines.
#[must_use]
pub fn take_log() -> Vec<LogLine> {
    let mut lines = LINES.lock().unwrap_or_else(PoisonError::into_inner);
    std::mem::take(&mut *lines).into()
}
