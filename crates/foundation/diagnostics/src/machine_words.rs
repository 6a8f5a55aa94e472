//! Plain descriptions of operating system errors.

use std::io::{Error, ErrorKind};

/// Returns a plain description of an operating system error, without its number.
///
/// Errors created by a program keep their message.
#[must_use]
pub fn plain_words(error: &Error) -> String {
    if error.raw_os_error().is_none() {
        return error.to_string();
    }
    let words = match error.kind() {
        ErrorKind::NotFound => "there is no such file or folder",
        ErrorKind::PermissionDenied => "permission is denied",
        ErrorKind::AlreadyExists => "it exists already",
        ErrorKind::StorageFull => "the disk is full",
        ErrorKind::QuotaExceeded => "the disk quota is used up",
        ErrorKind::ReadOnlyFilesystem => "the file system is read-only",
        ErrorKind::FileTooLarge => "the file would be too large",
        ErrorKind::IsADirectory => "this is a folder, not a file",
        ErrorKind::NotADirectory => "a part of the path is a file, not a folder",
        ErrorKind::DirectoryNotEmpty => "the folder is not empty",
        ErrorKind::InvalidFilename => "the name is too long or not valid here",
        ErrorKind::AddrInUse => "another program uses this port",
        ErrorKind::AddrNotAvailable => "this machine has no such address",
        ErrorKind::ConnectionRefused => "the connection was refused",
        ErrorKind::ConnectionReset => "the connection was reset",
        ErrorKind::TimedOut => "no response within the timeout",
        ErrorKind::ExecutableFileBusy => "the program is being written by another",
        ErrorKind::OutOfMemory => "there is not enough memory",
        ErrorKind::BrokenPipe => "the reader has closed the pipe",
        _ => return without_number(&error.to_string()),
    };
    words.to_owned()
}

/// Removes ` (os error N)`.
fn without_number(words: &str) -> String {
    let cut = words.rfind(" (os error ").filter(|_| words.ends_with(')'));
    cut.map_or(words, |at| &words[..at]).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_error_of_the_system_shows_its_number() {
        for code in 1..134 {
            let words = plain_words(&Error::from_raw_os_error(code));
            assert!(!words.contains("os error") && !words.is_empty(), "{code}: {words}");
        }
        let of = |code| plain_words(&Error::from_raw_os_error(code));
        assert_eq!(of(2), "there is no such file or folder");
        assert_eq!(of(28), "the disk is full");
        assert_eq!(plain_words(&Error::other("(os error is mine)")), "(os error is mine)");
    }
}
