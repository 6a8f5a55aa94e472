//! Any bytes as a message of any type of ours: refused with a reason, or read, and then the same
//! again after CDR, ROS 1 and JSON; and it can be shown.
//!
//! The first line names the type, or chooses one by its letters when there is no such; the next byte
//! chooses the format.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use periplus_msgs::{DynamicMessage, Encapsulation, Format, TypeRegistry, YamlStyle};

static NAMES: LazyLock<Vec<&str>> =
    LazyLock::new(|| TypeRegistry::builtin().type_names().collect());

fuzz_target!(|bytes: &[u8]| {
    let types = TypeRegistry::builtin();
    let Some(end) = bytes.iter().position(|&byte| byte == b'\n') else { return };
    let (line, rest) = bytes.split_at(end);
    let [_, which, bytes @ ..] = rest else { return };
    let sum: usize = line.iter().map(|&letter| usize::from(letter)).sum();
    let named = std::str::from_utf8(line).ok().and_then(|name| types.layout(name));
    let layout = named.or_else(|| types.layout(NAMES[sum % NAMES.len()])).expect("a known name");
    let name = layout.type_name();
    let format = if which % 2 == 0 { Format::CDR } else { Format::Ros1 };
    let message = match DynamicMessage::decode(layout, format, bytes) {
        Ok(message) => message,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    // Bytes and not values are compared: what is not a number is not equal to itself.
    let written = |message: &DynamicMessage, format| {
        let mut out = Vec::new();
        message.encode(format, &mut out).expect("what was read keeps to its bounds");
        out
    };
    let little = written(&message, Format::CDR);
    for format in [Format::Cdr(Encapsulation::BigEndian), Format::Ros1] {
        let again = DynamicMessage::decode(layout, format, &written(&message, format))
            .expect("what was written can be read");
        assert_eq!(written(&again, Format::CDR), little, "{name} {format:?}");
    }
    let json = message.to_json();
    let again = DynamicMessage::from_json(layout, &json).expect("what was written can be read");
    assert_eq!(again.to_json(), json, "{name}");
    assert!(message.to_yaml(&YamlStyle::default()).ends_with('\n'));
});
