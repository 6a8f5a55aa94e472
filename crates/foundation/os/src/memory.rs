//! Memory use of this process.

use std::path::Path;

use periplus_resources::Host as _;

use crate::Machine;

/// Returns the peak resident memory of this process, memory-mapped files included \[bytes\]; `None` where
/// the system does not report it.
///
/// On Linux it is read from `/proc/self/status` (proc_pid_status(5), `VmHWM`), because `ru_maxrss` of
/// getrusage(2) includes the time before exec. Other systems have only the latter.
#[must_use]
pub fn peak_memory_bytes() -> Option<u64> {
    let status = Machine.read(Path::new("/proc/self/status")).ok();
    status.and_then(|status| high_water_mark(&String::from_utf8_lossy(&status))).or_else(largest)
}

fn high_water_mark(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}

#[cfg(unix)]
fn largest() -> Option<u64> {
    use nix::sys::resource::{UsageWho, getrusage};
    // Kilobytes, except on Apple systems.
    let unit = if cfg!(target_vendor = "apple") { 1 } else { 1024 };
    let usage = getrusage(UsageWho::RUSAGE_SELF).ok()?;
    u64::try_from(usage.max_rss()).ok().map(|count| unit * count)
}

#[cfg(not(unix))]
fn largest() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_of_the_peak_is_read() {
        let status = "Name:\tx\nVmPeak:\t  900 kB\nVmHWM:\t  130 kB\nVmRSS:\t  120 kB\n";
        assert_eq!(high_water_mark(status), Some(130 * 1024));
        assert_eq!(high_water_mark("Name:\tx\n"), None);
        assert_eq!(high_water_mark("VmHWM:\t many kB\n"), None);
    }

    #[cfg(unix)]
    #[test]
    fn what_was_held_and_given_back_counts() {
        const HELD: usize = 96 << 20;
        let before = peak_memory_bytes().unwrap();
        let block = vec![1_u8; HELD];
        assert_eq!(block.iter().map(|&it| usize::from(it)).sum::<usize>(), HELD);
        drop(block);
        let after = peak_memory_bytes().unwrap();
        assert!(after >= before && after >= HELD as u64, "{before} {after}");
        assert!(largest().unwrap() >= HELD as u64);
    }
}
