//! Two participants of one program, connected over the loopback interface.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test with a network waits")]

use std::time::{Duration, Instant};

use periplus_cyclonedds_sys::{
    BuiltinTopic, Bytes, DataReader, DataWriter, DdsDurability, DdsQos, DdsSample, DiscoverySample,
    Guid, Participant, ParticipantConfig, SampleIdentity, Vendor,
};

const TYPE: &str = "std_msgs::msg::dds_::UInt8MultiArray_";

/// A separate domain for each test, and separate topics for each run.
struct Net {
    domain_id: u32,
}

impl Net {
    fn participant(&self) -> Participant {
        let config =
            ParticipantConfig { domain_id: self.domain_id, ..ParticipantConfig::default() };
        Participant::open(&config, b"enclave=/;").unwrap()
    }
}

fn topic() -> String {
    format!("rt/p{}", std::process::id())
}

/// Polls until there is a value; a timeout fails the test.
fn wait<T>(what: &str, mut poll: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = poll() {
            return found;
        }
        assert!(start.elapsed() < Duration::from_secs(20), "timeout while waiting for {what}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn pair(net: &Net, qos: &DdsQos) -> (DataWriter, DataReader) {
    let writer = net.participant().writer(&topic(), TYPE, qos, b"").unwrap();
    let reader = net.participant().reader(&topic(), TYPE, qos, b"").unwrap();
    wait("the two to match", || (writer.readers() == 1 && reader.writers() == 1).then_some(()));
    (writer, reader)
}

fn cdr(size: usize) -> Vec<u8> {
    let mut bytes = vec![0, 1, 0, 0];
    bytes.extend((4..size).map(|i| (i % 251) as u8));
    bytes
}

fn receive(reader: &DataReader) -> DdsSample {
    wait("a sample", || reader.take().unwrap())
}

#[test]
fn bytes_arrive_with_their_source() {
    let (writer, reader) = pair(&Net { domain_id: 60 }, &DdsQos::default());
    for size in [4, 5, 6, 7, 8, 1000, 64_999, 65_000, 65_001, 300_001] {
        let sequence = writer.write(cdr(size), None).unwrap();
        let sample = receive(&reader);
        assert_eq!(sample.bytes[..size], cdr(size));
        // The content of a packet is padded to a multiple of four; that of fragments has an exact
        // size.
        assert!(sample.bytes.len() <= size.next_multiple_of(4));
        assert!(sample.bytes[size..].iter().all(|byte| *byte == 0));
        assert_eq!(sample.source, Some(SampleIdentity { writer: writer.guid(), sequence }));
        assert_eq!((sample.vendor, sample.related), (Vendor::CYCLONE, None));
    }
}

#[test]
fn answers_name_their_request() {
    let (writer, reader) = pair(&Net { domain_id: 61 }, &DdsQos::default());
    let guid = Guid([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]);
    let request = SampleIdentity { writer: guid, sequence: 0x1_2345_6789 };
    // In one packet and in several.
    for size in [20, 200_000] {
        writer.write(cdr(size), Some(request)).unwrap();
        assert_eq!(receive(&reader).related, Some(request));
    }
}

#[test]
fn a_latecomer_gets_what_is_latched() {
    let net = Net { domain_id: 62 };
    let qos =
        DdsQos { durability: DdsDurability::TransientLocal, depth: Some(2), ..DdsQos::default() };
    let writer = net.participant().writer(&topic(), TYPE, &qos, b"").unwrap();
    for size in [100, 200, 4000 * 4000 + 100] {
        writer.write(cdr(size), None).unwrap();
    }
    let reader = net.participant().reader(&topic(), TYPE, &qos, b"").unwrap();
    let start = Instant::now();
    assert_eq!(receive(&reader).bytes.len(), 200);
    assert_eq!(receive(&reader).bytes, cdr(4000 * 4000 + 100));
    assert!(start.elapsed() < Duration::from_secs(20), "it took {:?}", start.elapsed());
}

#[test]
fn who_comes_and_goes_is_told() {
    let net = Net { domain_id: 63 };
    let here = net.participant();
    let readers = here.discovery(BuiltinTopic::Readers).unwrap();
    let waitset = here.waitset().unwrap();
    let watched = waitset.watch_discovery(&readers).unwrap();
    let there = net.participant();
    let qos = DdsQos {
        is_reliable: false,
        deadline_ns: Some(250_000_000),
        lease_ns: Some(3_000_000_000),
        ..DdsQos::default()
    };
    let reader = there.reader(&topic(), TYPE, &qos, b"typehash=RIHS01_00;").unwrap();
    let foreign = |found: &DiscoverySample| found.participant == there.guid();
    let found = wait("the reader", || {
        assert!(waitset.wait(1_000_000_000).unwrap().iter().all(|token| *token == watched));
        std::iter::from_fn(|| readers.take().unwrap()).find(foreign)
    });
    assert_eq!((found.guid, found.is_alive), (reader.guid(), true));
    assert_eq!((found.topic, found.type_name), (topic(), TYPE.to_owned()));
    assert_eq!(found.user_data, b"typehash=RIHS01_00;");
    assert_eq!(found.vendor, Vendor::CYCLONE);
    assert_eq!(found.qos.deadline_ns, Some(250_000_000));
    assert_eq!(found.qos.lease_ns, Some(3_000_000_000));
    assert!(!found.qos.is_reliable);
    assert_eq!(reader.guid().participant(), there.guid());

    drop(reader);
    let gone = wait("its end", || readers.take().unwrap());
    assert_eq!((gone.guid, gone.is_alive), (found.guid, false));
}

#[test]
fn bytes_are_given_back_when_nobody_needs_them() {
    struct Counted(Vec<u8>, std::sync::mpsc::Sender<()>);
    impl Bytes for Counted {
        fn bytes(&self) -> &[u8] {
            &self.0
        }
    }
    impl Drop for Counted {
        fn drop(&mut self) {
            let _ = self.1.send(());
        }
    }
    let (writer, reader) = pair(&Net { domain_id: 64 }, &DdsQos::default());
    let (send, gone) = std::sync::mpsc::channel();
    for _ in 0..100 {
        writer.write(Counted(cdr(999), send.clone()), None).unwrap();
        receive(&reader);
    }
    // An invalid sample is returned at once.
    assert!(writer.write(Counted(vec![0; 3], send.clone()), None).is_err());
    drop((writer, reader, send));
    let count = std::iter::from_fn(|| gone.recv_timeout(Duration::from_secs(20)).ok()).count();
    assert_eq!(count, 101);
}

#[test]
fn a_waker_ends_the_sleep() {
    let participant = Net { domain_id: 65 }.participant();
    let waitset = participant.waitset().unwrap();
    let waker = waitset.waker();
    waker.wake();
    let start = Instant::now();
    assert_eq!(waitset.wait(10_000_000_000).unwrap(), Vec::new());
    assert!(start.elapsed() < Duration::from_secs(9));
    // Exactly once.
    let start = Instant::now();
    assert_eq!(waitset.wait(50_000_000).unwrap(), Vec::new());
    assert!(start.elapsed() >= Duration::from_millis(45));
}

#[test]
fn what_is_wrong_is_said() {
    let config = ParticipantConfig {
        domain_id: 66,
        more: "<CycloneDDS><Nonsense/>".into(),
        ..ParticipantConfig::default()
    };
    let error = Participant::open(&config, b"").map(drop).unwrap_err().to_string();
    assert!(error.contains("join domain 66"), "{error}");
    let config = ParticipantConfig { domain_id: 100_000, ..ParticipantConfig::default() };
    let error = Participant::open(&config, b"").map(drop).unwrap_err().to_string();
    assert!(error.contains("join domain 100000"), "{error}");
    let participant = Net { domain_id: 66 }.participant();
    let error = participant.writer("a\0b", TYPE, &DdsQos::default(), b"").map(drop).unwrap_err();
    assert!(error.to_string().contains("zero byte"), "{error}");
}

/// Regression test: the status of a writer was never read after the first call of a service, so
/// that the event kept the thread awake and used a full core.
#[test]
fn an_event_is_reported_once() {
    let net = Net { domain_id: 67 };
    let (here, there) = (net.participant(), net.participant());
    let waitset = here.waitset().unwrap();
    let writer = here.writer(&topic(), TYPE, &DdsQos::default(), b"").unwrap();
    let back = format!("{}b", topic());
    let reader = here.reader(&back, TYPE, &DdsQos::default(), b"").unwrap();
    let watched =
        [waitset.watch_writer(&writer), waitset.watch_reader(&reader)].map(Result::unwrap);
    let other = there.reader(&topic(), TYPE, &DdsQos::default(), b"").unwrap();
    let talker = there.writer(&back, TYPE, &DdsQos::default(), b"").unwrap();
    wait("both to match", || (other.writers() == 1 && talker.readers() == 1).then_some(()));
    talker.write(cdr(100), None).unwrap();
    let mut seen = Vec::new();
    wait("both events", || {
        seen.extend(waitset.wait(1_000_000).unwrap());
        watched.iter().all(|token| seen.contains(token)).then_some(())
    });
    // No sample was taken and no status was read.
    for _ in 0..3 {
        let start = Instant::now();
        assert_eq!(waitset.wait(100_000_000).unwrap(), Vec::new());
        assert!(start.elapsed() >= Duration::from_millis(90), "it does not sleep");
    }
    // The next sample is an event again.
    drop(other);
    wait("the reader to go", || {
        waitset.wait(1_000_000).unwrap().contains(&watched[0]).then_some(())
    });
    talker.write(cdr(100), None).unwrap();
    wait("a sample", || waitset.wait(1_000_000).unwrap().contains(&watched[1]).then_some(()));
    assert!(reader.take().unwrap().is_some() && reader.take().unwrap().is_some());
}

#[test]
fn a_sample_for_one_participant_comes_to_it_alone() {
    let net = Net { domain_id: 68 };
    let here = net.participant();
    let qos = DdsQos { depth: None, ..DdsQos::default() };
    let writer = here.writer(&topic(), TYPE, &qos, b"").unwrap();
    assert!(!writer.reaches(Guid::default()));
    assert_eq!(writer.write_to(Guid::default(), cdr(10), None).unwrap(), None);
    let there = [(); 3].map(|()| net.participant());
    let readers = there.each_ref().map(|one| one.reader(&topic(), TYPE, &qos, b"").unwrap());
    let second = there[0].reader(&topic(), TYPE, &qos, b"").unwrap();
    wait("all to match", || {
        let all = readers.iter().chain([&second]).all(|one| one.writers() == 1);
        (writer.readers() == 4 && all).then_some(())
    });
    assert!(there.iter().all(|one| writer.reaches(one.guid())));
    let related = SampleIdentity { writer: readers[0].guid(), sequence: 5 };
    // In one packet and in several, faster than acknowledgements.
    let mut expected = [const { Vec::new() }; 3];
    for round in 0..60_usize {
        let (to, size) = (round * 7 % 3, if round % 10 == 0 { 200_000 } else { 100 + round });
        let participant = there[to].guid();
        let sequence = writer.write_to(participant, cdr(size), Some(related)).unwrap().unwrap();
        expected[to].push((sequence, size));
    }
    // One for all readers after the others: a reader that waits for a sample of another reader
    // would never get this.
    let sequence = writer.write(cdr(50), None).unwrap();
    for (reader, of) in readers.iter().chain([&second]).zip([0, 1, 2, 0]) {
        for (sequence, size) in &expected[of] {
            let sample = receive(reader);
            assert_eq!(sample.source.unwrap().sequence, *sequence);
            assert_eq!(sample.bytes[..*size], cdr(*size));
            assert_eq!(sample.related, Some(related));
        }
        assert_eq!(receive(reader).source.unwrap().sequence, sequence);
        assert_eq!(reader.take().unwrap(), None);
    }
    let start = Instant::now();
    assert!(writer.wait_acknowledged(20_000_000_000), "not all acknowledged");
    assert!(start.elapsed() < Duration::from_secs(5), "it took {:?}", start.elapsed());
}
