//! Terminal, processors, memory.

use std::io::IsTerminal as _;
use std::path::Path;

use periplus_os::Machine;
use periplus_resources::Host as _;

use super::SelfCheck;

/// Available memory below which large worlds and maps may not fit \[bytes\].
const MIN_MEMORY_BYTES: u64 = 1 << 30;

/// Minimum width of a terminal for tables \[columns\].
const MIN_COLUMNS: u16 = 60;

pub(super) fn all() -> [SelfCheck; 3] {
    let size = std::io::stdout().is_terminal().then(|| crossterm::terminal::size().ok()).flatten();
    let table = Machine.read(Path::new("/proc/meminfo")).ok();
    let table = table.map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    [
        terminal(std::io::stdin().is_terminal(), size),
        processors(periplus_os::processors()),
        memory(table.as_deref().and_then(available_bytes)),
    ]
}

fn terminal(has_keys: bool, size: Option<(u16, u16)>) -> SelfCheck {
    let Some((columns, rows)) = size else {
        return SelfCheck::ok("terminal", "output is no terminal: no colours, no progress bars");
    };
    let found = format!("{columns} x {rows} characters");
    if !has_keys {
        let advice = "`periplus teleop` reads keys: do not redirect its input";
        return SelfCheck::warning("terminal", format!("{found}, input is no terminal"), advice);
    }
    if columns < MIN_COLUMNS {
        return SelfCheck::warning("terminal", found, format!("widen it to {MIN_COLUMNS} columns"));
    }
    SelfCheck::ok("terminal", found)
}

fn processors(count: usize) -> SelfCheck {
    if count == 1 {
        let advice = "rays, maps and recordings are computed in parallel: allow at least two";
        return SelfCheck::warning("processors", "1", advice);
    }
    SelfCheck::ok("processors", count.to_string())
}

fn memory(available_bytes: Option<u64>) -> SelfCheck {
    let Some(bytes) = available_bytes else {
        return SelfCheck::ok("memory", "this system does not report it in a file");
    };
    let found = format!("{:.1} GB available", bytes as f64 * 1e-9);
    if bytes < MIN_MEMORY_BYTES {
        let advice = "close other programs: large worlds and maps need 1 GB";
        return SelfCheck::warning("memory", found, advice);
    }
    SelfCheck::ok("memory", found)
}

/// Available memory of `/proc/meminfo` (proc_meminfo(5)).
fn available_bytes(table: &str) -> Option<u64> {
    let line = table.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}

#[cfg(test)]
mod tests {
    use super::super::CheckStatus;
    use super::*;

    #[test]
    fn limits_of_the_machine() {
        assert_eq!(processors(1).status, CheckStatus::Warning);
        assert_eq!(processors(2).status, CheckStatus::Ok);
        let table = "MemTotal:       2097152 kB\nMemAvailable:   1048576 kB\n";
        assert_eq!(available_bytes(table), Some(1 << 30));
        assert_eq!(memory(Some(1 << 30)).status, CheckStatus::Ok);
        assert_eq!(memory(Some((1 << 30) - 1)).status, CheckStatus::Warning);
        assert_eq!(memory(available_bytes("")).status, CheckStatus::Ok);
    }

    #[test]
    fn a_narrow_terminal_and_redirected_input_are_reported() {
        assert_eq!(terminal(true, Some((80, 24))).status, CheckStatus::Ok);
        assert_eq!(terminal(true, Some((59, 24))).status, CheckStatus::Warning);
        assert_eq!(terminal(false, Some((80, 24))).status, CheckStatus::Warning);
        assert_eq!(terminal(false, None).status, CheckStatus::Ok);
    }
}
