//! Any bytes as discovery data of other programs on the ROS 2 network: their nodes, types and topic names,
//! and service requests and responses; over DDS and Zenoh.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_cyclonedds_sys::{Guid, SampleIdentity, DdsSample, Vendor};
use periplus_dds::{entities, names, request, user_data};
use periplus_rmw_zenoh::EntityToken;
use periplus_rmw_zenoh::attachment::Attachment;

fuzz_target!(|bytes: &[u8]| {
    if let Some((said, form)) = entities::decode(bytes) {
        // Nothing is made up: what came out was there.
        let length: usize = said
            .nodes
            .iter()
            .map(|node| node.name.len() - 1 + 16 * (node.readers.len() + node.writers.len()))
            .sum();
        assert!(length <= bytes.len());
        let again = entities::decode(&entities::encode(&said, form));
        let (again, _) = again.expect("what was written");
        assert_eq!(again.participant, said.participant);
        assert_eq!(again.nodes.len(), said.nodes.len());
    }
    for key in ["typehash", "enclave", ""] {
        let _ = user_data::value(bytes, key);
    }
    if let Some(hash) = user_data::hash_of(bytes) {
        assert_eq!(user_data::hash_of(&user_data::type_hash(&hash)), Some(hash));
    }
    if let Ok(text) = std::str::from_utf8(bytes) {
        if let Some((_, name)) = names::of_ros(text) {
            assert!(name.starts_with('/') && text.contains(name));
        }
        if let Some(name) = names::message(text) {
            assert_eq!(names::message(&names::type_of(&name)).as_deref(), Some(&*name));
        }
        let _ = names::service_of(text);
        if let Some(token) = EntityToken::read(text) {
            assert_eq!(EntityToken::read(&token.write()), Some(token));
        }
    }
    if let Some(beside) = Attachment::read(bytes) {
        assert_eq!(beside.write(), bytes);
    }
    let (caller, reader) = (Guid([1; 16]), Guid([2; 16]));
    for vendor in [Vendor::CYCLONE, Vendor::FAST] {
        for related in [None, Some(SampleIdentity { writer: reader, sequence: 3 })] {
            let source = Some(SampleIdentity { writer: caller, sequence: 3 });
            let sample = DdsSample { bytes: bytes.to_vec(), time_ns: 0, source, vendor, related };
            let _ = request::read_answer(sample.clone(), caller, reader);
            if let Some((ticket, body)) = request::read_question(sample) {
                let (answer, _) = request::write_answer(ticket, &body);
                assert_eq!(answer, bytes);
            }
        }
    }
});
