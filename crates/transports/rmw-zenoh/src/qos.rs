//! QoS in the key expression of a liveliness token: the values that differ from the default,
//! separated by colons.
//!
//! `reliability:durability:history,depth:deadline:lifespan:liveliness,lease`; durations are seconds
//! and nanoseconds separated by a comma, policies are the numbers of `rmw`. Source:
//! `qos_to_keyexpr` of `rmw_zenoh_cpp` and the enumerations of `rmw/types.h`.

use std::fmt::Write as _;

use periplus_graph::{Durability, History, Liveliness, Qos, Reliability};

/// Default depth of `rmw_zenoh`.
const DEFAULT_DEPTH: usize = 42;

const SECOND_NS: i64 = 1_000_000_000;

/// Encodes the QoS for a token.
#[must_use]
pub fn write(qos: &Qos) -> String {
    let mut out = String::new();
    if qos.reliability == Reliability::BestEffort {
        out.push('2');
    }
    out.push(':');
    if qos.durability == Durability::TransientLocal {
        out.push('1');
    }
    out.push(':');
    if qos.history == History::KeepAll {
        out.push('2');
    }
    out.push(',');
    if qos.depth != DEFAULT_DEPTH {
        let _ = write!(out, "{}", qos.depth);
    }
    out.push(':');
    write_time(&mut out, qos.deadline_ns);
    out.push(':');
    write_time(&mut out, qos.lifespan_ns);
    out.push(':');
    if qos.liveliness == Liveliness::ManualByTopic {
        out.push('3');
    }
    out.push(',');
    write_time(&mut out, qos.lease_ns);
    out
}

/// An infinite duration is the default.
fn write_time(out: &mut String, time_ns: Option<i64>) {
    match time_ns {
        Some(ns) => {
            let _ = write!(out, "{},{}", ns / SECOND_NS, ns % SECOND_NS);
        }
        None => out.push(','),
    }
}

/// Decodes the QoS; none if it is malformed. Policies of `rmw` without an equivalent map to the
/// closest one.
#[must_use]
pub fn read(text: &str) -> Option<Qos> {
    let mut parts = text.split(':');
    let mut next = || parts.next();
    let reliability = match next()? {
        "" | "0" | "1" => Reliability::Reliable,
        "2" => Reliability::BestEffort,
        _ => return None,
    };
    let durability = match next()? {
        "" | "0" | "2" => Durability::Volatile,
        "1" => Durability::TransientLocal,
        _ => return None,
    };
    let (history, depth) = next()?.split_once(',')?;
    let history = match history {
        "" | "0" | "1" => History::KeepLast,
        "2" => History::KeepAll,
        _ => return None,
    };
    let depth = if depth.is_empty() { DEFAULT_DEPTH } else { depth.parse().ok()? };
    let deadline_ns = read_time(next()?)?;
    let lifespan_ns = read_time(next()?)?;
    let (liveliness, lease) = next()?.split_once(',')?;
    let liveliness = match liveliness {
        "" | "0" | "1" | "5" => Liveliness::Automatic,
        "2" | "3" => Liveliness::ManualByTopic,
        _ => return None,
    };
    let lease_ns = read_time(lease)?;
    next().is_none().then_some(())?;
    Some(Qos {
        reliability,
        durability,
        history,
        depth,
        deadline_ns,
        lifespan_ns,
        liveliness,
        lease_ns,
    })
}

/// The outer option is none if it is malformed, the inner one if it is infinite.
fn read_time(text: &str) -> Option<Option<i64>> {
    let (seconds, rest) = text.split_once(',')?;
    if seconds.is_empty() && rest.is_empty() {
        return Some(None);
    }
    let number = |text: &str, default: i64| match text {
        "" => Some(default),
        text => text.parse().ok().filter(|number| *number >= 0),
    };
    let seconds = number(seconds, i64::MAX / SECOND_NS)?;
    let rest = number(rest, i64::MAX % SECOND_NS)?;
    let ns = seconds.checked_mul(SECOND_NS).and_then(|ns| ns.checked_add(rest));
    // Durations that overflow are infinite.
    Some(ns.filter(|ns| *ns != i64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn it_is_spelled_as_rmw_zenoh_spells_it() {
        // Examples of the design document.
        assert_eq!(write(&Qos::reliable(10)), "::,10:,:,:,,");
        assert_eq!(write(&Qos::reliable(7)), "::,7:,:,:,,");
        assert_eq!(write(&Qos::sensor_data()), "2::,5:,:,:,,");
        assert_eq!(write(&Qos::latched(1)), ":1:,1:,:,:,,");
        assert_eq!(write(&Qos::reliable(42)), "::,:,:,:,,");
        let full = Qos { liveliness: Liveliness::ManualByTopic, ..Qos::reliable(10) }
            .keep_all()
            .with_deadline_ns(1_500_000_000)
            .with_lifespan_ns(20);
        let full = Qos { lease_ns: Some(2_000_000_000), depth: 10, ..full };
        assert_eq!(write(&full), "::2,10:1,500000000:0,20:3,2,0");
        assert_eq!(read("::2,10:1,500000000:0,20:3,2,0"), Some(full));
    }

    #[test]
    fn what_is_none_is_none() {
        for text in [
            "",
            ":",
            "::,10:,:,:,",
            "::,10:,:,:,,:",
            "9::,10:,:,:,,",
            "::,x:,:,:,,",
            "::,1:a,:,:,,",
            "::,1:-1,:,:,,",
        ] {
            assert_eq!(read(text), None, "{text}");
        }
        assert_eq!(read("0:0:0,:9223372036,854775807:,:0,,"), Some(Qos::reliable(42)));
    }

    proptest! {
        #[test]
        fn it_comes_back_the_same(
            depth in 0_usize..100,
            best_effort: bool,
            latched: bool,
            deadline in proptest::option::of(0..i64::MAX),
            lease in proptest::option::of(0..i64::MAX),
        ) {
            let mut qos = Qos { deadline_ns: deadline, lease_ns: lease, ..Qos::reliable(1) };
            qos.depth = depth;
            if best_effort { qos.reliability = Reliability::BestEffort; }
            if latched { qos.durability = Durability::TransientLocal; }
            prop_assert_eq!(read(&write(&qos)), Some(qos));
        }

        #[test]
        fn any_text_is_survived(text in "[0-9:,]{0,40}") {
            let _ = read(&text);
        }
    }
}
