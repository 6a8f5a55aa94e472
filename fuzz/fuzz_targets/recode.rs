//! Any bytes as a message of any type, in CDR or ROS 1, and made into the other: what is a message is
//! one there too, with the same values.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_msgs::{Adaptation, DynamicMessage, Encapsulation, Format, TypeRegistry, recode};

fuzz_target!(|input: (u16, bool, &[u8])| {
    let (number, is_ros1, bytes) = input;
    let types = TypeRegistry::builtin();
    let names: Vec<&str> = types.type_names().collect();
    let name = names[usize::from(number) % names.len()];
    let layout = types.layout(name).expect("it is one of them");
    let from = if is_ros1 { Format::Ros1 } else { Format::CDR };
    let message = DynamicMessage::decode(layout, from, bytes).ok();
    for to in [Format::CDR, Format::Cdr(Encapsulation::BigEndian), Format::Ros1] {
        let mut out = Vec::new();
        let recoded = recode(layout, from, bytes, to, &mut out);
        let Some(message) = &message else { continue };
        recoded.expect("what is a message is one elsewhere");
        let mut expected = Vec::new();
        message.encode(to, &mut expected).expect("it was short enough");
        assert_eq!(out, expected);
    }
    if let (Some(message), Some(old)) = (message, TypeRegistry::ros1().layout(name)) {
        let mut out = Vec::new();
        let adapted = Adaptation::new(layout, old).apply(message);
        adapted.encode(Format::Ros1, &mut out).expect("it was short enough");
        DynamicMessage::decode(old, Format::Ros1, &out).expect("it is of that revision");
    }
});
