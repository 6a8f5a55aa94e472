//! Ends processes and their children by the programs of Windows, which has no process groups.

use std::process::{Command, Stdio};

use crate::bringup::guard::EndSignal;

/// Asks a process and its children to end, or ends them.
#[cfg(windows)]
pub(super) fn end(process: u32, ending: EndSignal) {
    // A process that has ended meanwhile is no fault.
    let _ = quiet(&ending_words(process, ending)).status();
}

/// Returns true if a process runs.
#[cfg(windows)]
pub(super) fn runs(process: u32) -> bool {
    let output = quiet(&listing_words(process)).stdout(Stdio::piped()).output();
    output.is_ok_and(|output| lists(&String::from_utf8_lossy(&output.stdout), process))
}

#[cfg_attr(not(windows), allow(dead_code, reason = "the words are tested on every system"))]
fn quiet(words: &[String]) -> Command {
    let (program, arguments) = words.split_first().map_or(("", &[][..]), |(p, a)| (p.as_str(), a));
    let mut command = Command::new(program);
    command.args(arguments);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// `/T`: with children. Without `/F` programs with windows get a request, and others none.
fn ending_words(process: u32, ending: EndSignal) -> Vec<String> {
    let mut words = format!("taskkill /PID {process} /T");
    if ending == EndSignal::Kill {
        words += " /F";
    }
    words.split(' ').map(str::to_owned).collect()
}

fn listing_words(process: u32) -> Vec<String> {
    let filter = format!("PID eq {process}");
    ["tasklist", "/NH", "/FO", "CSV", "/FI", &filter].map(str::to_owned).into()
}

/// Returns true if a list in CSV has the process; without one there is a text in the system's language.
fn lists(output: &str, process: u32) -> bool {
    let number = format!("\"{process}\"");
    output.lines().any(|line| line.split(',').nth(1) == Some(number.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_signal_is_by_force() {
        let words = |ending| ending_words(7, ending).join(" ");
        assert_eq!(words(EndSignal::Interrupt), "taskkill /PID 7 /T");
        assert_eq!(words(EndSignal::Kill), "taskkill /PID 7 /T /F");
        assert_eq!(listing_words(7).last().map(String::as_str), Some("PID eq 7"));
    }

    #[test]
    fn a_process_is_found_by_its_number() {
        let list = "\"python.exe\",\"71\",\"Console\",\"1\",\"7,124 K\"\r\n";
        assert!(lists(list, 71));
        assert!(!lists(list, 7));
        assert!(!lists("INFO: No tasks are running which match the specified criteria.\r\n", 7));
    }

    #[cfg(windows)]
    #[test]
    fn a_process_is_ended() {
        let mut words =
            quiet(&["ping".to_owned(), "-n".to_owned(), "60".to_owned(), "127.0.0.1".to_owned()]);
        let mut process = words.spawn().unwrap();
        assert!(runs(process.id()));
        end(process.id(), EndSignal::Kill);
        assert!(!process.wait().unwrap().success());
        assert!(!runs(process.id()));
    }
}
