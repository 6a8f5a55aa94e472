//! Number of participants of a domain on this machine, from its UDP ports.
//!
//! A DDS participant receives discovery on a port that follows from the domain and the number of
//! the participant on its machine (RTPS 2.5, 9.6.2.3). Linux lists all bound ports, so that the
//! number of participants is known before any of them has answered.

/// Port base (PB) of RTPS.
const BASE: u32 = 7400;

/// Domain gain (DG) of RTPS.
const DOMAIN_GAIN: u32 = 250;

/// Discovery port of participant 0, relative to the first port of its domain; participants are 2
/// ports apart.
const DISCOVERY_OFFSET: u32 = 10;

/// Counts the participants of a domain, from the text of Linux's `/proc/net/udp`.
#[must_use]
pub fn participants(proc_net_udp: &str, domain_id: u32) -> usize {
    let first = BASE + DOMAIN_GAIN * domain_id + DISCOVERY_OFFSET;
    let ports = first..BASE + DOMAIN_GAIN * (domain_id + 1);
    let mut numbers: Vec<u32> = proc_net_udp
        .lines()
        .filter_map(|line| {
            let (_, port) = line.split_whitespace().nth(1)?.rsplit_once(':')?;
            u32::from_str_radix(port, 16).ok()
        })
        .filter(|port| ports.contains(port) && (port - first).is_multiple_of(2))
        .collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two participants of domain 0 (ports 7410, 7411 and 7412, 7413), the multicast port 7400 of
    /// both, one participant of domain 1 (7660), and a web server.
    const TEXT: &str =
        "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt
  101: 00000000:1CE8 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 1 2 0 0
  101: 00000000:1CE8 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 2 2 0 0
  102: 0100007F:1CF2 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 3 2 0 0
  103: 0100007F:1CF3 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 4 2 0 0
  104: 00000000:1CF4 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 5 2 0 0
  104: 00000000:1CF5 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 6 2 0 0
  105: 00000000:1DEC 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 7 2 0 0
  106: 00000000:0050 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 8 2 0 0
";

    #[test]
    fn participants_are_counted_by_their_ports() {
        assert_eq!(participants(TEXT, 0), 2);
        assert_eq!(participants(TEXT, 1), 1);
        assert_eq!(participants(TEXT, 2), 0);
        assert_eq!(participants("nonsense : 1CF2 x\n:\n", 0), 0);
    }
}
