//! Matching of service requests and responses, which differs between the implementations of ROS 2.
//!
//! Fast DDS (`rmw_fastrtps`): the payload is the body alone; the inline QoS of the request carries
//! the GUID of the reader that waits for the response, and that of the response carries this GUID
//! and the sequence number of the request. Cyclone DDS (`rmw_cyclonedds`): 16 bytes in front of the
//! body, with the client's id and its sequence number, which the response repeats. Source:
//! `rmw_request.cpp` and `rmw_response.cpp` of `rmw_fastrtps_shared_cpp`; `serdata.cpp` of
//! `rmw_cyclonedds_cpp`.

use periplus_cyclonedds_sys::{DdsSample, Guid, SampleIdentity, Vendor};

/// Location of the request identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mapping {
    /// In the inline QoS (Fast DDS).
    Fast,
    /// In front of the body (Cyclone DDS).
    Cyclone,
}

impl Mapping {
    /// Mapping used by the ROS 2 implementation of a vendor. All but Cyclone DDS follow Fast DDS.
    #[must_use]
    pub fn of(vendor: Vendor) -> Self {
        if vendor == Vendor::CYCLONE { Self::Cyclone } else { Self::Fast }
    }
}

/// Size of Cyclone's header in front of the body \[bytes\].
const HEADER: usize = 16;

/// SampleIdentity that a response must repeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ticket {
    /// For the inline QoS.
    Fast(SampleIdentity),
    /// For the front of the body, as received.
    Cyclone([u8; HEADER]),
}

/// Splits a received request into the identity that the response must repeat, and the body. None if
/// it is too short.
#[must_use]
pub fn read_question(sample: DdsSample) -> Option<(Ticket, Vec<u8>)> {
    match (sample.related, Mapping::of(sample.vendor)) {
        // A sender that sets the inline QoS expects the response there, whatever its vendor.
        (None, Mapping::Cyclone) => {
            let (header, body) = split(sample.bytes)?;
            Some((Ticket::Cyclone(header), body))
        }
        (related, _) => {
            let source = sample.source?;
            let writer = related.map_or(source.writer, |related| related.writer);
            Some((Ticket::Fast(SampleIdentity { writer, ..source }), sample.bytes))
        }
    }
}

/// Encodes a response: its bytes, and the identity for the inline QoS.
#[must_use]
pub fn write_answer(ticket: Ticket, body: &[u8]) -> (Vec<u8>, Option<SampleIdentity>) {
    match ticket {
        Ticket::Fast(identity) => (body.to_vec(), Some(identity)),
        Ticket::Cyclone(header) => (join(header, body), None),
    }
}

/// Encodes a request. `number` is our own sequence number, used by Cyclone's mapping only.
#[must_use]
pub fn write_question(
    mapping: Mapping,
    caller: Guid,
    answers_to: Guid,
    number: i64,
    body: &[u8],
) -> (Vec<u8>, Option<SampleIdentity>) {
    match mapping {
        // "Unknown", as in Fast DDS.
        Mapping::Fast => {
            let sequence = -1 << 32;
            (body.to_vec(), Some(SampleIdentity { writer: answers_to, sequence }))
        }
        Mapping::Cyclone => {
            // Byte order as declared by the body's encapsulation header.
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

/// Returns the sequence number of the request that a response answers: that of DDS, or ours. None
/// if it is for another client.
#[must_use]
pub fn read_answer(
    sample: DdsSample,
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

/// Eight bytes that identify a client: the random part of its participant's GUID, and its entity
/// id.
fn short_name(guid: Guid) -> u64 {
    let half = |from: usize| {
        guid.0[from..from + 4].iter().fold(0, |all, byte| all << 8 | u64::from(*byte))
    };
    (half(4) ^ half(0)) << 32 | (half(8) ^ half(12))
}

/// Removes the header between the encapsulation and the body. The header is 16 bytes, so that the
/// alignment of the body does not change.
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

    fn sample(bytes: Vec<u8>, related: Option<SampleIdentity>, vendor: Vendor) -> DdsSample {
        let source = Some(SampleIdentity { writer: CALLER, sequence: 17 });
        DdsSample { bytes, time_ns: 0, source, vendor, related }
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
            // Fast DDS counts by the sequence number of the sample, Cyclone by the client's own.
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
