//! Terminal that returns each key as it is pressed.

use std::io::{self, Write};
use std::time::Duration;

use crossterm::event::{Event, KeyCode, KeyEventKind, KeyModifiers, poll, read};
use crossterm::terminal::{disable_raw_mode, enable_raw_mode};

/// Ctrl-C as a character.
const END_OF_TEXT: char = '\u{3}';

/// Terminal in raw mode, until dropped.
pub(super) struct RawTerminal;

impl RawTerminal {
    pub(super) fn open() -> io::Result<Self> {
        enable_raw_mode()?;
        Ok(Self)
    }

    /// Writes text; raw mode needs a carriage return at the end of a line.
    pub(super) fn write(&self, text: &str) -> io::Result<()> {
        let mut out = io::stdout().lock();
        out.write_all(text.replace('\n', "\r\n").as_bytes())?;
        out.flush()
    }

    /// Returns the next key, if one is pressed within the time.
    pub(super) fn key(&self, wait: Duration) -> io::Result<Option<char>> {
        if !poll(wait)? {
            return Ok(None);
        }
        let Event::Key(event) = read()? else { return Ok(None) };
        if event.kind == KeyEventKind::Release {
            return Ok(None);
        }
        Ok(Some(match event.code {
            KeyCode::Char('c' | 'C') if event.modifiers.contains(KeyModifiers::CONTROL) => {
                END_OF_TEXT
            }
            KeyCode::Char(key) => key,
            // Arrow keys and others stop the robot, as every unknown key.
            _ => '\0',
        }))
    }
}

impl Drop for RawTerminal {
    fn drop(&mut self) {
        let _ = disable_raw_mode();
    }
}
