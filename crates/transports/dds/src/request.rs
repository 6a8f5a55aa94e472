//! How a question and its answer find each other. The implementations of ROS 2 do not agree on it.
//!
//! Fast DDS (`rmw_fastrtps`): the body alone; beside it, in the inline QoS, the question carries the
//! name of the reader that waits for the answer, and the answer carries that name and the number of
//! the question. Cyclone DDS (`rmw_cyclonedds`): 16 bytes in front of the body, the caller's name
//! and its number of the question, which the answer repeats. Source: `rmw_request.cpp` and
//! `rmw_response.cpp` of `rmw_fastrtps_shared_cpp`; `serdata.cpp` of `rmw_cyclonedds_cpp`.

use periplus_cyclonedds_sys::{Guid, Identity, Sample, Vendor};

/// Which of the two ways.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mapping {
    /// In the inline QoS.
    Fast,
    /// In front of the body.
    Cyclone,
}

impl Mapping {
    /// That of the ROS that runs on this DDS. All but Cyclone's are like Fast DDS's.
    #[must_use]
    pub fn of(vendor: Vendor) -> Self {
        if vendor == Vendor::CYCLONE { Self::Cyclone } else { Self::Fast }
    }
}

/// Bytes in front of the body, in Cyclone's way.
const HEADER: usize = 16;

/// What an answer must repeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ticket {
    /// In the inline QoS.
    Fast(Identity),
    /// In front of the body, as it came.
    Cyclone([u8; HEADER]),
}

/// Splits a question that arrived: what the answer must repeat, and the body. None when it is too
/// short to be one.
#[must_use]
pub fn read_question(sample: Sample) -> Option<(Ticket, Vec<u8>)> {
    match (sample.related, Mapping::of(sample.vendor)) {
        // Who says in the inline QoS where the answer goes wants it so, whoever it is.
        (None, Mapping::Cyclone) => {
            let (header, body) = split(sample.bytes)?;
            Some((Ticket::Cyclone(header), body))
        }
        (related, _) => {
            let source = sample.source?;
            let writer = related.map_or(source.writer, |related| related.writer);
            Some((Ticket::Fast(Identity { writer, ..source }), sample.bytes))
        }
    }
}

/// An answer as it is sent: its bytes, and what goes in the inline QoS.
#[must_use]
pub fn write_answer(ticket: Ticket, body: &[u8]) -> (Vec<u8>, Option<Identity>) {
    match ticket {
        Ticket::Fast(identity) => (body.to_vec(), Some(identity)),
        Ticket::Cyclone(header) => (join(header, body), None),
    }
}

/// A question as it is sent. `number` is ours and only Cyclone's way has it.
#[must_use]
pub fn write_question(
    mapping: Mapping,
    caller: Guid,
    answers_to: Guid,
    number: i64,
    body: &[u8],
) -> (Vec<u8>, Option<Identity>) {
    match mapping {
        // "Unknown", as Fast DDS has it.
        Mapping::Fast => {
            let sequence = -1 << 32;
            (body.to_vec(), Some(Identity { writer: answers_to, sequence }))
        }
        Mapping::Cyclone => {
            // Bytes are in the order that the body says it has.
            let is_little = body.get(1).is_none_or(|low| low & 1 == 1);
            let (name, number) = if is_little {
                (short_name(caller).to_le_bytes(), number.to_le_bytes())
            } else {
                (short_name(caller).to_be_bytes(), number.to_be_bytes())
            };
            let mut header = [0; HEADER];
            header[..8].copy_from_slice(&name);
            header[8..].copy_from_slice(&number);
            (join(header, body), None)
        }
    }
}

/// Which of our questions an answer is for: by the number that DDS gave it, or by ours. None when it
/// is for somebody else.
#[must_use]
pub fn read_answer(
    sample: Sample,
    caller: Guid,
    answers_to: Guid,
) -> Option<(Mapping, i64, Vec<u8>)> {
    if let Some(related) = sample.related {
        let is_ours = related.writer == answers_to || related.writer == caller;
        return is_ours.then_some((Mapping::Fast, related.sequence, sample.bytes));
    }
    let is_little = sample.bytes.get(1)? & 1 == 1;
    let (header, body) = split(sample.bytes)?;
    let (name, number) = header.split_at(8);
    let (name, number) = (name.try_into().ok()?, number.try_into().ok()?);
    let (name, number) = if is_little {
        (u64::from_le_bytes(name), i64::from_le_bytes(number))
    } else {
        (u64::from_be_bytes(name), i64::from_be_bytes(number))
    };
    (name == short_name(caller)).then_some((Mapping::Cyclone, number, body))
}

/// Eight bytes that name a caller: the random part of its participant's name, and which of its
/// entities it is.
fn short_name(guid: Guid) -> u64 {
    let half = |from: usize| {
        guid.0[from..from + 4].iter().fold(0, |all, byte| all << 8 | u64::from(*byte))
    };
    (half(4) ^ half(0)) << 32 | (half(8) ^ half(12))
}

/// Takes the header out from between the encapsulation and the body. The header is 16 bytes, so what
/// stands behind it stays aligned.
fn split(mut bytes: Vec<u8>) -> Option<([u8; HEADER], Vec<u8>)> {
    let header = bytes.get(4..4 + HEADER)?.try_into().ok()?;
    bytes.drain(4..4 + HEADER);
    Some((header, bytes))
}

fn join(header: [u8; HEADER], body: &[u8]) -> Vec<u8> {
    let (encapsulation, rest) = body.split_at(body.len().min(4));
    [encapsulation, &header, rest].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CALLER: Guid = Guid([1, 16, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 1, 3]);
    const ANSWERS: Guid = Guid([1, 16, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 2, 4]);
    const BODY: [u8; 8] = [0, 1, 0, 0, 42, 0, 0, 0];

    fn sample(bytes: Vec<u8>, related: Option<Identity>, vendor: Vendor) -> Sample {
        let source = Some(Identity { writer: CALLER, sequence: 17 });
        Sample { bytes, time_ns: 0, source, vendor, related }
    }

    #[test]
    fn an_answer_finds_its_question_in_both_ways() {
        for (mapping, vendor) in
            [(Mapping::Fast, Vendor::FAST), (Mapping::Cyclone, Vendor::CYCLONE)]
        {
            let (bytes, related) = write_question(mapping, CALLER, ANSWERS, 5, &BODY);
            let (ticket, body) = read_question(sample(bytes, related, vendor)).unwrap();
            assert_eq!(body, BODY);
            let (bytes, related) = write_answer(ticket, &BODY);
            let answer = sample(bytes, related, vendor);
            // Fast DDS counts by the number of the sample, Cyclone by the caller's own.
            let number = if mapping == Mapping::Fast { 17 } else { 5 };
            assert_eq!(
                read_answer(answer.clone(), CALLER, ANSWERS),
                Some((mapping, number, BODY.to_vec()))
            );
            assert_eq!(read_answer(answer, Guid([9; 16]), Guid([8; 16])), None);
        }
    }

    #[test]
    fn a_short_question_is_none() {
        for size in 0..20 {
            assert_eq!(read_question(sample(vec![0; size], None, Vendor::CYCLONE)), None);
            assert_eq!(
                read_answer(sample(vec![0; size], None, Vendor::CYCLONE), CALLER, ANSWERS),
                None
            );
        }
    }
}
