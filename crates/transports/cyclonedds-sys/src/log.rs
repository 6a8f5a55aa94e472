//! Log of Cyclone DDS.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

/// Maximum number of stored lines, which bounds the memory of programs that never read them.
const MOST: usize = 200;

/// Categories of Cyclone, `dds/ddsrt/log.h`: fatal and error.
const SERIOUS: u32 = 0b11;
/// Fatal, error and warning.
const WORTH_TELLING: u32 = 0b111;

/// A log line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogLine {
    /// True for errors, false for warnings.
    pub is_error: bool,
    /// Text of the line.
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

/// The last line of this thread since the last error.
pub(crate) fn last_of_this_thread() -> Option<String> {
    LAST.try_with(|last| last.borrow_mut().take()).ok().flatten()
}

/// Returns the lines of all threads since the last call: at most the newest two hundred.
#[must_use]
pub fn take_log() -> Vec<LogLine> {
    let mut lines = LINES.lock().unwrap_or_else(PoisonError::into_inner);
    std::mem::take(&mut *lines).into()
}
